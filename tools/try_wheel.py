"""Build the wheel and run the first examples of README.md with it alone, in an empty environment and folder.

    python tools/try_wheel.py [--python 3.13] [--lowest] [--folder DIR]

--python: version or path of the interpreter, as uv takes it; --lowest: the oldest packages that pyproject.toml allows.
Needs uv (in .venv) and a package index. Prints the versions that ran; the exit code is 1 where an example fails.
"""

from __future__ import annotations

import argparse
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
README = ROOT / "README.md"
SHOWN = ("numpy", "numba", "scipy", "vtk", "xarray")
COMMANDS = (
    "swashfilm run ref90 --speed 2100rpm --pressure 35MPa --displacement 1.0 --fidelity lumped -o run",
    "swashfilm report run",
    "swashfilm new film slider -o slider.toml",
    "swashfilm film slider.toml -o film",
    "swashfilm map ref90 --fidelity lumped --speeds 1000,2000rpm --pressures 10,30MPa --displacements 1 -o map",
    "swashfilm export map --to csv -o map.csv",
    "swashfilm schema run.pump",
    "swashfilm doctor",
)
VERSIONS = "import sys; from importlib.metadata import version as v; print('Python', sys.version.split()[0], end='')"


def main(words: Sequence[str]) -> int:
    """Build, install and run; return the exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--python", default=f"{sys.version_info.major}.{sys.version_info.minor}")
    parser.add_argument("--lowest", action="store_true")
    parser.add_argument("--folder", type=Path, help="where environment and results stay")
    asked = parser.parse_args(words)
    with tempfile.TemporaryDirectory(prefix="swashfilm-wheel-") as own:
        place = (asked.folder or Path(own)).resolve()
        programs = installed(place, asked.python, asked.lowest)
        shown = "".join(f"; print(', {name}', v('{name}'), end='')" for name in SHOWN)
        call(["python", "-c", VERSIONS + shown + "; print()"], place, programs, told=True)
        faults = [*failed(place / "work", programs)]
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"{len(faults)} examples failed" if faults else "every example ran")
    return 1 if faults else 0


def installed(place: Path, python: str, lowest: bool) -> Path:
    """Return the folder of the programs of a new environment with the wheel and its requirements."""
    uv = ROOT / ".venv" / "bin" / "uv"
    tool = str(uv) if uv.is_file() else shutil.which("uv") or "uv"
    wheels, venv = place / "wheels", place / "venv"
    shutil.rmtree(wheels, ignore_errors=True)
    run([tool, "build", "--quiet", "--wheel", "--out-dir", str(wheels), str(ROOT)])
    run([tool, "venv", "--quiet", "--clear", "--python", python, str(venv)])
    install = [tool, "pip", "install", "--quiet", "--python", str(venv / "bin" / "python"), "--only-binary", ":all:"]
    if lowest:
        run([*install, "--resolution", "lowest-direct", "-r", str(ROOT / "pyproject.toml")])
    run([*install, *map(str, wheels.glob("*.whl"))])
    return venv / "bin"


def failed(work: Path, programs: Path) -> list[str]:
    """Run every command and the README's Python, each from the empty folder `work`; return the failures."""
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    faults = []
    new_pump = re.search(r"^swashfilm new pump .+$", README.read_text("utf-8"), re.MULTILINE)
    own = (new_pump[0], "swashfilm run my_pump.toml --fidelity lumped -o own") if new_pump else ()
    for command in (*COMMANDS, *own):
        code, text = call(shlex.split(command), work, programs)
        faults += [f"{command}\n{text[-2000:]}"] if code else []
    for source, printed in re.findall(r"```python\n(.+?)```.+?```text\n(.+?)```", README.read_text("utf-8"), re.DOTALL):
        code, text = call(["python", "-c", source], work, programs)
        faults += [f"{source}\n{text[-2000:]}\nexpected:\n{printed}"] if code or text != printed else []
    return faults


def call(words: list[str], work: Path, programs: Path, told: bool = False) -> tuple[int, str]:
    """Return exit code and output of a program of the environment, without any other folder of Python modules."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    work.mkdir(parents=True, exist_ok=True)
    done = subprocess.run(
        [str(programs / words[0]), *words[1:]], cwd=work, env=kept, text=True, check=False,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip
    if told:
        print(done.stdout.rstrip())
    return done.returncode, done.stdout


def run(words: list[str]) -> None:
    """Run a command of the setup; raise CalledProcessError where it fails."""
    subprocess.run(words, check=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
