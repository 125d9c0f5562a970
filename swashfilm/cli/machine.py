"""Examination of this machine: interpreter, packages, caches, memory, graphics."""

import os
import platform
import re
import sys
import tempfile
from collections.abc import Iterable
from ctypes.util import find_library
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, requires, version
from math import isinf
from pathlib import Path

from reynolds.bodies.memory import physical_memory
from swashfilm.output.scenes.picture3d import REMEDY, Frame, draw
from swashfilm.runs.export.fmu.compiler import REMEDY as COMPILER, targets
from system.work.processes import cores

LEAST_MEMORY = 2e9  # bytes; a run with films needs half of it
_NEEDED = re.compile(r"[A-Za-z0-9_.\-]+")
_TRIANGLE = """<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid>
<Piece NumberOfPoints="3" NumberOfCells="1"><PointData Scalars="film_pressure [Pa]">
<DataArray type="Float64" Name="film_pressure [Pa]" format="ascii">0 1 2</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>
"""


@dataclass(frozen=True)
class Finding:
    """One examined item: its name, its state, and the remedy where the state is bad (else empty).

    `needed`: every run needs the item.
    """

    what: str
    text: str
    remedy: str = ""
    needed: bool = False


def examine() -> list[Finding]:
    """Return the findings on this machine; write only a temporary folder."""
    return [
        Finding("python", f"{platform.python_version()} ({sys.executable})"),
        Finding("system", f"{platform.system()} {platform.release()} {platform.machine()}"),
        *_packages(),
        Finding("cores", str(cores())),
        _memory(),
        Finding("threads a run uses", os.environ.get("OMP_NUM_THREADS", "not set")),
        *_kernels(),
        _compiler(),
        *_graphics(),
    ]


def is_well(findings: Iterable[Finding]) -> bool:
    """Return True when no requirement of a run is missing."""
    return not any(finding.remedy and finding.needed for finding in findings)


def _packages() -> list[Finding]:
    """Return findings on Swashfilm and its requirements, with their versions."""
    try:
        lines = [line for line in requires("swashfilm") or [] if "extra ==" not in line]
        found = [Finding("swashfilm", version("swashfilm"))]
    except PackageNotFoundError:
        return [Finding("swashfilm", "not installed", "make install, or pip install .", needed=True)]
    for line in sorted(lines):
        match = _NEEDED.match(line)
        name = match[0] if match else line
        try:
            found.append(Finding(name, version(name)))
        except PackageNotFoundError:
            found.append(Finding(name, "missing", f"pip install '{line}'", needed=True))
    return found


def _memory() -> Finding:
    size = physical_memory()
    if isinf(size):
        return Finding("memory", "not known")
    remedy = f"a run with films needs {LEAST_MEMORY / 1e9:g} GB" if size < LEAST_MEMORY else ""
    return Finding("memory", f"{size / 1e9:.1f} GB", remedy)


def _kernels() -> list[Finding]:
    """Return findings on numba's folders of compiled kernels, beside each module or in NUMBA_CACHE_DIR."""
    import gaps
    import reynolds
    import system

    if own := os.environ.get("NUMBA_CACHE_DIR"):
        return [_kept_kernels("compiled kernels", Path(own))]
    packages = (reynolds, gaps, system)
    return [_kept_kernels(f"compiled kernels, {one.__name__}", Path(str(one.__file__)).parent) for one in packages]


def _kept_kernels(what: str, home: Path) -> Finding:
    """Return number of kernels in a folder, and write access."""
    kept = len(list(home.rglob("*.nbi")))
    state = f"{kept} kept in {home}" if kept else f"none yet in {home}: the first run compiles, about a minute"
    nearest = next(folder for folder in (home, *home.parents) if folder.exists())
    writable = os.access(nearest, os.W_OK)
    remedy = "" if writable else "set NUMBA_CACHE_DIR to a writable folder; without it every run compiles again"
    return Finding(what, state, remedy)


def _compiler() -> Finding:
    """Return the finding on a C compiler, which compiles the binaries of an exported FMU."""
    found = [target.platform for target in targets()]
    if not found:
        return Finding("C compiler", "none", f"{COMPILER} (without one an exported FMU has sources alone)")
    return Finding("C compiler", f"for FMUs on {', '.join(found)}")


def _graphics() -> list[Finding]:
    """Return findings on graphics libraries and on a 3D picture drawn in a child process."""
    libraries = [name for name in ("EGL", "GL", "OSMesa") if find_library(name)]
    with tempfile.TemporaryDirectory() as folder:
        film = Path(folder, "film.vtu")
        film.write_text(_TRIANGLE, encoding="utf-8")
        pictures = draw({Path(folder, "film.png"): [Frame([film])]})
    drawn = "drawn" if pictures.paths else pictures.reason.removesuffix(f"; {REMEDY}")
    return [
        Finding("graphics libraries", ", ".join(libraries) or "none"),
        Finding("3D picture", drawn, "" if pictures.paths else f"{REMEDY} (runs work without the picture)"),
    ]
