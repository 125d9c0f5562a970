"""This solver beside its peers on one film: the finite journal bearing of `journal_case.py`, full film.

    python benchmarks/peers.py                            about 1e2, 1e3, 1e4 and 1e5 unknowns; a few minutes
    python benchmarks/peers.py --quick                    up to about 1e4
    python benchmarks/peers.py --page docs/benchmarks.md  writes the page too

Each peer is a script in `benchmarks/peers`, run on one thread as a process of its own, once per mesh; `peer.py`
there says what is timed. Those that are not of this environment run in a Debian 13 of their own, `build/peers/debian`,
which chroot enters (as root). A peer that is not installed is named with the way to install it, and left out.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from journal_case import ECCENTRICITY, THREADS, rows
from journal_series import force
from rich.console import Console
from rich.table import Table

HERE = Path(__file__).resolve().parent
DEBIAN = HERE.parent / "build" / "peers" / "debian"
WITHIN = Path("tmp") / "peers"
"""The scripts' place in it."""
ROSS = Path("/opt/ross")
CELLS = {1: (24, 80, 250, 790), 2: (12, 40, 126, 396)}
"""Cells round the bearing: as many unknowns with either order. Their numbers are even, so that no cell lies across the
least film, where the load's integrand has a kink: its integral would err more than the film."""
SIZES = ("1e2", "1e3", "1e4", "1e5")
REPEATS = (60, 40, 15, 5)
ERRORS = (1e-3, 1e-4)
GOAL = 2  # place in SIZES of the mesh of this solver whose error the peers are to reach too
TIMEOUT = 240.0


@dataclass(frozen=True)
class Peer:
    """A solver as its users run it: elements, program and script, Python module it needs (FreeFEM none).

    debian: whether the program is that of DEBIAN.
    """

    name: str
    elements: str
    degree: int
    debian: bool
    program: str
    script: str
    module: str
    method: str
    install: str


@dataclass(frozen=True)
class Measured:
    """One peer on one mesh; `size` is the place of the mesh in CELLS."""

    peer: Peer
    size: int
    version: str
    unknowns: int
    solve_s: float
    load: float
    attitude_deg: float


def _peers() -> tuple[Peer, ...]:
    inside, own = f"chroot {DEBIAN.relative_to(HERE.parent)}", sys.executable
    debian = f"debootstrap --variant=minbase trixie {DEBIAN.relative_to(HERE.parent)} http://deb.debian.org/debian"
    apt = f"{debian}; {inside} apt-get install --no-install-recommends"
    dolfinx, freefem = f"{apt} python3-dolfinx", f"{apt} freefem++"
    found = []
    for degree in (1, 2):
        quads, triangles, python = f"Q{degree}", f"P{degree}", "/usr/bin/python3"
        found += [
            Peer("this solver", quads, degree, False, own, "run_swashfilm.py", "reynolds", "", "make install"),
            Peer("scikit-fem + spsolve", quads, degree, False, own, "run_scikit_fem.py", "skfem", "", "make install"),
            Peer("dolfinx, Cholesky", quads, degree, True, python, "run_dolfinx.py", "dolfinx", "direct", dolfinx),
            Peer("dolfinx, CG + GAMG", quads, degree, True, python, "run_dolfinx.py", "dolfinx", "multigrid", dolfinx),
        ]
        for method in ("UMFPACK", "CHOLMOD"):
            name = f"FreeFEM, {method}"
            found.append(Peer(name, triangles, degree, True, "FreeFem++-nw", "run_freefem.edp", "", method, freefem))
    pip = f"{inside} sh -c 'python3 -m venv {ROSS} && {ROSS}/bin/pip install ross-rotordynamics'"
    ross = f"{apt} python3-venv; {pip}"
    found.append(Peer("ROSS", "Q1", 1, True, str(ROSS / "bin" / "python"), "run_ross.py", "ross", "", ross))
    return tuple(found)


def program(peer: Peer) -> list[str]:
    """Start of the peer's command line."""
    return ["chroot", str(DEBIAN.resolve()), peer.program] if peer.debian else [peer.program]


def scripts(peer: Peer) -> Path:
    """Folder of the scripts as the peer's program sees it."""
    return Path("/") / WITHIN if peer.debian else HERE


def lend_scripts() -> None:
    """Copy the scripts to where programs of DEBIAN see them."""
    if DEBIAN.exists():
        shutil.copytree(HERE / "peers", DEBIAN / WITHIN / "peers", dirs_exist_ok=True)
        shutil.copy(HERE / "journal_case.py", DEBIAN / WITHIN)


def installed(peer: Peer) -> bool:
    """Whether the peer's program and the module that it needs are installed."""
    if peer.debian and (not DEBIAN.exists() or shutil.which("chroot") is None):
        return False
    probe = f"import importlib.util, sys; sys.exit(importlib.util.find_spec({peer.module!r}) is None)"
    asked = [*program(peer), "-c", probe] if peer.module else [*program(peer)[:-1], "which", peer.program]
    return subprocess.run(asked, check=False, capture_output=True).returncode == 0


def measure(peer: Peer, size: int) -> Measured | str:
    """The peer's line for one mesh, or the reason of its absence in words."""
    cells, folder = CELLS[peer.degree][size], scripts(peer)
    arguments = {
        "degree": peer.degree, "cells": cells, "rows": rows(cells), "repeats": REPEATS[size],
        "eccentricity": ECCENTRICITY, "method": peer.method or "default",
    }  # fmt: skip
    quiet = [] if peer.module else ["-v", "0"]
    command = [*program(peer), *quiet, str(folder / "peers" / peer.script)]
    command += [text for name, value in arguments.items() for text in (f"-{name}", str(value))]
    alone = os.environ | dict.fromkeys(THREADS, "1") | {"PYTHONPATH": str(folder)}
    try:
        run = subprocess.run(command, env=alone, capture_output=True, text=True, timeout=TIMEOUT, check=False)
    except subprocess.TimeoutExpired:
        return f"not done after {TIMEOUT:.0f} s"
    lines = [line for line in run.stdout.splitlines() if line.startswith('{"')]
    if run.returncode != 0 or not lines:
        said = (run.stderr.strip() or run.stdout.strip() or "nothing").splitlines()[-1]
        return f"failed (exit {run.returncode}): {said}"
    return Measured(peer, size, **json.loads(lines[-1]))


def error(row: Measured, load: float) -> float:
    """Relative error of the load."""
    return abs(row.load / load - 1.0)


def time_to(target: float, rows: Sequence[Measured], load: float) -> tuple[str, float]:
    """Seconds to a relative error of the load: between two meshes, a power law of the error.

    With a sign: "<" where the coarsest mesh is better already, "never" (and the best error) where none is.
    """
    errors = [error(row, load) for row in rows]
    first = next((i for i, found in enumerate(errors) if found <= target), None)
    if first is None:
        return "never", min(errors)
    if first == 0:
        return "<", rows[0].solve_s
    share = math.log(target / errors[first - 1]) / math.log(errors[first] / errors[first - 1])
    return "", rows[first - 1].solve_s * (rows[first].solve_s / rows[first - 1].solve_s) ** share


Lines = list[tuple[str, ...]]
MESHES = ("solver", "elements", "unknowns", "time / ms", "x this solver", "load", "error / %", "attitude / deg")
TARGETS = (*(f"{100 * e:g} %" for e in ERRORS), f"own error at {SIZES[GOAL]}")
EQUAL = ("solver", "elements", *(f"{what}{target}{unit}" for target in TARGETS for what, unit in
         (("time to ", " / ms"), ("x this solver, ", ""))))  # fmt: skip


def _ms(seconds: float) -> str:
    """Milliseconds to three digits, without an exponent."""
    return f"{1e3 * seconds:.3g}" if seconds < 1.0 else f"{1e3 * seconds:.0f}"


def mesh_lines(measured: Sequence[Measured], load: float) -> Lines:
    """One line per peer and mesh; the ratio is to this solver with the same order and number of unknowns."""
    own = {(row.peer.degree, row.size): row.solve_s for row in measured if row.peer.module == "reynolds"}
    lines: Lines = []
    for row in measured:
        base = own.get((row.peer.degree, row.size))
        lines.append((
            row.peer.name, row.peer.elements, str(row.unknowns), _ms(row.solve_s),
            "" if base is None else f"{row.solve_s / base:.2g}", f"{row.load:.6f}",
            f"{100 * (row.load / load - 1.0):+.2g}", f"{row.attitude_deg:.3f}",
        ))  # fmt: skip
    return lines


def equal_lines(measured: Sequence[Measured], load: float) -> Lines:
    """One line per peer: time to each error, and its ratio to this solver with the same order of elements.

    The last error is that of this solver, with the same order of elements, on the mesh of GOAL.
    """
    groups = {peer: [row for row in measured if row.peer == peer] for peer in dict.fromkeys(r.peer for r in measured)}
    own = {peer.degree: group for peer, group in groups.items() if peer.module == "reynolds"}
    lines: Lines = []
    for peer, group in groups.items():
        cells = [peer.name, peer.elements]
        own_error = next((error(row, load) for row in own.get(peer.degree, ()) if row.size == GOAL), 0.0)
        for target in (*ERRORS, own_error):
            sign, found = time_to(target, group, load)
            own_sign, base = time_to(target, own[peer.degree], load) if peer.degree in own else ("never", 0.0)
            if sign == "never":
                cells += [f"not reached, best {100 * found:.2g} %", ""]
            else:
                comparable = own_sign == sign
                cells += [f"{sign} {_ms(found)}".strip(), f"{found / base:.2g}" if comparable else ""]
        lines.append(tuple(cells))
    return lines


def shown(title: str, head: Sequence[str], lines: Lines) -> Table:
    """Lines as a table for the terminal."""
    table = Table(title=title)
    for i, name in enumerate(head):
        table.add_column(name, justify="left" if i < 2 else "right", no_wrap=i < 2)
    for before, line in zip([("",), *lines], lines, strict=False):
        if before[:2] != line[:2] and len(head) == len(MESHES) and before != ("",):
            table.add_section()
        table.add_row(*line)
    return table


def markdown(head: Sequence[str], lines: Lines) -> str:
    """Lines as a table of Markdown."""
    rule = "|" + "|".join("---" if i < 2 else "---:" for i in range(len(head))) + "|"
    return "\n".join(["| " + " | ".join(head) + " |", rule, *("| " + " | ".join(line) + " |" for line in lines)])


def machine() -> str:
    """Processor, cores and Python of this machine."""
    cpuinfo = Path("/proc/cpuinfo")
    lines = cpuinfo.read_text(encoding="utf-8").splitlines() if cpuinfo.exists() else []
    model = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), platform.machine())
    return f"{model}, {os.cpu_count()} cores, {platform.system()}, Python {platform.python_version()}"


def code() -> str:
    """Commit of this checkout, and whether files of the solver differ from it."""

    def git(*words: str) -> str | None:
        run = subprocess.run(["git", *words], cwd=HERE, capture_output=True, text=True, check=False)
        return run.stdout.strip() if run.returncode == 0 else None

    if shutil.which("git") is None or (commit := git("rev-parse", "--short", "HEAD")) is None:
        return "no checkout"
    changed = git("status", "--porcelain", "--", str(HERE.parent / "reynolds"))
    return f"{commit}, with uncommitted changes in reynolds: provisional" if changed else commit


def multigrid_work(quick: bool) -> str:
    """Lines of `multigrid.py`: work units and share of the memory's bandwidth of this solver's multigrid."""
    command = [sys.executable, str(HERE / "multigrid.py"), *(["--quick"] if quick else [])]
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=TIMEOUT).stdout


def page(
    measured: Sequence[Measured], left_out: Sequence[str], load: float, attitude: float, state: str, work: str
) -> str:
    """docs/benchmarks.md; `state` is the code before the run, `work` the table of `multigrid.py`."""
    versions = dict.fromkeys(f"{row.peer.name.split(',')[0].split(' +')[0]} {row.version}" for row in measured)
    text = (HERE / "peers" / "page.md").read_text(encoding="utf-8")
    return text.format(
        date=date.today().isoformat(),
        machine=machine(),
        code=state,
        busy=f"{os.getloadavg()[0]:.1f}",
        versions=", ".join(versions),
        load=f"{load:.6f}",
        attitude=f"{attitude:.3f}",
        meshes=markdown(MESHES, mesh_lines(measured, load)),
        equal=markdown(EQUAL, equal_lines(measured, load)),
        work=work.rstrip(),
        left_out="\n".join(f"- {line}" for line in left_out) or "- nothing",
    )


def run_all(console: Console, sizes: Sequence[int]) -> tuple[list[Measured], list[str]]:
    """Every peer on every mesh, and those left out with the reason."""
    measured: list[Measured] = []
    left_out: list[str] = []
    lend_scripts()
    for peer in _peers():
        if not installed(peer):
            left_out.append(f"{peer.name} {peer.elements}: not installed; to install it: `{peer.install}`")
            continue
        for size in sizes:
            with console.status(f"{peer.name} {peer.elements}, {SIZES[size]} unknowns"):
                found = measure(peer, size)
            if isinstance(found, str):
                left_out.append(f"{peer.name} {peer.elements}, {SIZES[size]} unknowns: {found}")
            else:
                measured.append(found)
    return measured, left_out


def main() -> None:
    """Run the peers, print both tables, write the page where asked to."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="no mesh of 1e5 unknowns")
    parser.add_argument("--page", type=Path, help="write the results to this file")
    asked = parser.parse_args()
    console = Console(width=140)
    along, across = force()
    load, attitude = math.hypot(along, across), math.degrees(math.atan2(across, -along))
    state = code()
    measured, left_out = run_all(console, range(3 if asked.quick else 4))
    console.print(shown("Assembly and solve of one film, one thread", MESHES, mesh_lines(measured, load)))
    console.print(shown("At equal error of the load", EQUAL, equal_lines(measured, load)))
    console.print(f"verified: load {load:.6f}, attitude {attitude:.3f} deg (series, without finite elements)")
    console.print(f"{machine()}; code {state}")
    for line in left_out:
        console.print(f"left out: {line}")
    work = multigrid_work(asked.quick)
    print(work)
    if asked.page is not None:
        asked.page.write_text(page(measured, left_out, load, attitude, state, work), encoding="utf-8")


if __name__ == "__main__":
    main()
