"""Binaries of the unit: C compilers of this machine, and the platforms that they compile for."""

from __future__ import annotations

import platform
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from shutil import which

from swashfilm.runs.export.fmu.description import COMPILED

COMPILERS = ("cc", "gcc", "clang")
"""Sought on the path, in this order."""
ZIG = "ziglang"
ZIG_TARGETS = {
    "x86_64-linux": "x86_64-linux-gnu.2.17",
    "aarch64-linux": "aarch64-linux-gnu.2.17",
    "x86_64-windows": "x86_64-windows-gnu",
    "x86_64-darwin": "x86_64-macos",
    "aarch64-darwin": "aarch64-macos",
}
"""Zig's target by the platform's name in FMI."""
ENDINGS = {"linux": ".so", "windows": ".dll", "darwin": ".dylib"}
MACHINES = {"amd64": "x86_64", "arm64": "aarch64"}
"""Names of processors that differ in FMI."""
SYSTEMS = {"win32": "windows"}
OPTIONS = ("-std=c99", "-O2", "-g0", "-shared", "-fvisibility=hidden", "-DFMI3_OVERRIDE_FUNCTION_PREFIX")
REMEDY = f"install {' or '.join(COMPILERS[1:])}, or pip install 'swashfilm[fmu]' ({ZIG}: for all platforms)"
NONE = f"no C compiler: the unit has sources and no binary, its importer has to compile it; {REMEDY}"


class CompilerFault(Exception):
    """A compiler without a binary, with its message."""


@dataclass(frozen=True)
class Target:
    """A platform by its name in FMI, and the command that compiles for it."""

    platform: str
    command: tuple[str, ...]

    @property
    def ending(self) -> str:
        """Ending of a shared library there."""
        return ENDINGS[self.platform.partition("-")[2]]

    @property
    def own(self) -> tuple[str, ...]:
        """Further options there: Windows has relocatable code in any case."""
        return () if self.ending == ENDINGS["windows"] else ("-fPIC",)


def targets() -> tuple[Target, ...]:
    """Return the platforms that this machine compiles for: five with ziglang, its own with another compiler."""
    if find_spec(ZIG):
        zig = (sys.executable, "-m", ZIG, "cc", "-target")
        return tuple(Target(name, (*zig, target)) for name, target in ZIG_TARGETS.items())
    found = next(filter(None, map(which, COMPILERS)), None)
    return (Target(host(), (found,)),) if found and _system() in ENDINGS else ()


def host() -> str:
    """Return the name of this platform in FMI: x86_64-linux, aarch64-darwin, .."""
    machine = platform.machine().lower()
    return f"{MACHINES.get(machine, machine)}-{_system()}"


def _system() -> str:
    return SYSTEMS.get(sys.platform, sys.platform)


def compiled(target: Target, sources: Path, headers: Path, place: Path) -> bytes:
    """Return the shared library of the sources, made at a place; raise CompilerFault with the compiler's message."""
    command = (*target.command, *OPTIONS, *target.own, f"-I{headers}", str(sources / COMPILED), "-o", str(place))
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as reason:
        raise CompilerFault(f"{target.command[0]}: {reason.strerror}") from None
    if done.returncode or not place.is_file():
        raise CompilerFault(_first(done.stderr.splitlines()) or f"{target.command[0]} ends with {done.returncode}")
    return place.read_bytes()


def _first(lines: Sequence[str]) -> str:
    """Return the first line with an error, else the first line."""
    return next((line for line in lines if "error" in line.lower()), lines[0] if lines else "")
