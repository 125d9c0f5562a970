"""Set up `.venv` in this checkout, with only Python and its standard library on the machine.

Debian's `python3` has neither pip nor ensurepip, so a pip wheel is in this folder. pip has its package index from its
own configuration, so that this repository has no addresses, and fetches uv; uv puts `requirements.lock` into `.venv` in
seconds and removes packages that the lock does not name. Where uv cannot reach the packages (its index and certificates
are configured apart from pip's), pip does the same work in about a minute. Every file fetched is checked against a hash
of a lock, and nothing is compiled from source: no compiler is needed.

A stamp inside `.venv` states its locks and its folder; while it is valid, a second call does nothing.
"""

from __future__ import annotations

import hashlib
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
PYTHON = VENV / "bin" / "python"
STAMP = VENV / "made-for"
PIP_WHEEL = ROOT / "tools" / "pip-26.2.1-py3-none-any.whl"
UV_LOCK = ROOT / "tools" / "uv-requirements.lock"
LOCK = ROOT / "requirements.lock"
OLDEST_PYTHON = (3, 11)


class SetupError(Exception):
    """`.venv` cannot be set up; the message states the reason and the remedy."""


def main() -> int:
    """Leave a `.venv` that matches the locks, or print the obstacle to stderr and return 1."""
    try:
        check_python()
        set_up()
    except (SetupError, OSError) as error:
        print(f"\nswashfilm could not be set up: {error}", file=sys.stderr)
        return 1
    return 0


def check_python() -> None:
    """Raise SetupError unless this Python is new enough and able to make a virtual environment."""
    if sys.version_info < OLDEST_PYTHON:
        found = ".".join(map(str, sys.version_info[:3]))
        raise SetupError(
            f"{sys.executable} is Python {found}; 3.11 or newer is needed. "
            "Name another with `make PYTHON=/path/to/python3.11 install`."
        )


def set_up() -> None:
    """Make `.venv`, or bring it up to date, unless its stamp states that it already is."""
    if PYTHON.exists() and read_stamp() == (str(ROOT), fingerprint()):
        print(".venv is up to date.")
        return
    start = time.monotonic()
    make_environment()
    install_locked_packages()
    install_swashfilm()
    STAMP.write_text(f"{ROOT}\n{fingerprint()}\n")
    print(f".venv is ready ({time.monotonic() - start:.0f} s).")


def fingerprint() -> str:
    """SHA-256 over every file that determines the content of `.venv`."""
    deciding = (LOCK, UV_LOCK, PIP_WHEEL, ROOT / "pyproject.toml")
    return hashlib.sha256(b"".join(path.read_bytes() for path in deciding)).hexdigest()


def read_stamp() -> tuple[str, str] | None:
    """Folder and fingerprint that `.venv` was last completed for; None if it never was."""
    if not STAMP.exists():
        return None
    folder, made_for = STAMP.read_text().splitlines()
    return folder, made_for


def make_environment() -> None:
    """Leave a virtual environment with pip in `.venv`, emptied first if its scripts name another folder."""
    try:
        import venv
    except ModuleNotFoundError:
        raise SetupError(
            f"{sys.executable} lacks the standard module `venv`. Install Debian's package `python3`, "
            "not only `python3-minimal`."
        ) from None
    stamp = read_stamp()
    moved = stamp is not None and stamp[0] != str(ROOT)
    print(f"Making .venv with {sys.executable} ...", flush=True)
    venv.create(VENV, with_pip=False, symlinks=True, clear=moved or not PYTHON.exists())
    STAMP.unlink(missing_ok=True)
    pip = str(PIP_WHEEL / "pip")  # a wheel of pip runs without installation
    if not succeeds(str(PYTHON), pip, "install", "--quiet", "--no-index", str(PIP_WHEEL)):
        raise SetupError(f"{PIP_WHEEL.name} could not be installed into .venv; see above.")


def install_locked_packages() -> None:
    """Leave in `.venv` the packages of `requirements.lock`, by uv where possible and by pip otherwise."""
    print("Installing the locked packages (1.6 GB on disk) ...", flush=True)
    hashed = ("--require-hashes", "--only-binary", ":all:")
    if succeeds(*pip_install(), *hashed, "--requirement", str(UV_LOCK)):
        uv = (str(VENV / "bin" / "uv"), "pip", "sync", "--quiet", "--python", str(PYTHON))
        if succeeds(*uv, *hashed, "--compile-bytecode", str(LOCK)):
            return
    print("uv did not get there (see above); pip takes over, which lasts a minute or two ...", flush=True)
    if not succeeds(*pip_install(), *hashed, "--requirement", str(LOCK)):
        raise SetupError(
            "the locked packages could not be fetched; see above. Is there a network, and does pip know an "
            f"index it can reach and trust? It uses: `{PYTHON} -m pip config list`."
        )


def install_swashfilm() -> None:
    """Leave this checkout importable from `.venv` in place, with its `swashfilm` command."""
    offline = ("--no-index", "--no-deps", "--no-build-isolation")
    if not succeeds(*pip_install(), *offline, "--editable", str(ROOT)):
        raise SetupError("the checkout itself could not be installed; see above. Is pyproject.toml whole?")


def pip_install() -> tuple[str, ...]:
    """The command that installs with the pip of `.venv`, for arguments to follow."""
    return (str(PYTHON), "-m", "pip", "install", "--quiet", "--disable-pip-version-check")


def succeeds(*command: str) -> bool:
    """Run a command with its output shown; whether it ended well."""
    return subprocess.run(command, cwd=ROOT, check=False).returncode == 0


if __name__ == "__main__":
    sys.exit(main())
