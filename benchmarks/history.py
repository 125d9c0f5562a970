"""Speed over the history of the program: times as ratios to plain scikit-fem in the same run, so machines compare.

    python benchmarks/history.py           measures and prints what got slower by more than 15 %; a minute
    python benchmarks/history.py --keep    also appends the run to benchmarks/history.csv (a clean commit only)

The reference is assembly of the journal bearing's full film on 1e4 unknowns by scikit-fem and `spsolve`. Each ratio is
the least processor time of a case over the least time of the reference, both measured in turn, one thread. A case is
slower where its ratio exceeds the median of its last five runs in the file by 15 %; the exit code is then 1.
"""

from __future__ import annotations

import argparse
import csv
import os
import platform
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from statistics import median

from journal_case import least, one_thread
from rich.console import Console
from rich.table import Table

HERE = Path(__file__).resolve().parent
HISTORY = HERE / "history.csv"
HEADS = ("date", "commit", "machine", "case", "time [ms]", "reference [ms]", "ratio [1]")
SLOWER = 1.15
LAST = 5  # runs of a case that the new one is compared with
ROUNDS = 5


@dataclass(frozen=True)
class Run:
    """Time of a case and of the reference beside it, s."""

    case: str
    time: float
    reference: float

    @property
    def ratio(self) -> float:
        """Time of the case over that of the reference."""
        return self.time / self.reference


def cases() -> dict[str, tuple[Callable[[], object], int]]:
    """Each case by its name: its function, and its repeats in a round."""
    from film import journal, journal_mesh

    from reynolds.fem.space import film_space
    from reynolds.problem import Cavitation
    from reynolds.solve.solver import FilmSolver
    from system.points.lumped import lumped_point
    from system.pump.operating import operating_point
    from system.pump_file.file import load_pump

    def solved(cells: int, degree: int, cavitation: Cavitation) -> Callable[[], object]:
        space = film_space(journal_mesh(cells), degree=degree)
        solver = FilmSolver(space)
        return lambda: solver.solve(journal(space, cavitation))

    pump = load_pump("ref90")
    point = operating_point(pump)
    return {
        "full film, 130 unknowns": (solved(25, 1, Cavitation.NONE), 60),
        "full film, 1e4 unknowns": (solved(250, 1, Cavitation.NONE), 10),
        "full film, 1e5 unknowns": (solved(790, 1, Cavitation.NONE), 2),
        "quadratic film, 1e3 unknowns": (solved(40, 2, Cavitation.NONE), 30),
        "quadratic film, 1e5 unknowns": (solved(395, 2, Cavitation.NONE), 2),
        "Reynolds' condition, 1e4 unknowns": (solved(250, 1, Cavitation.REYNOLDS), 5),
        "JFO, 1e3 unknowns": (solved(80, 1, Cavitation.JFO), 10),
        "JFO, 1e4 unknowns": (solved(250, 1, Cavitation.JFO), 3),
        "lumped point of ref90": (lambda: lumped_point(pump, point), 30),
    }


def reference() -> Callable[[], object]:
    """Assembly and solution of the full film by plain scikit-fem."""
    import skfem
    from film import couette, journal_mesh, poiseuille
    from scipy.sparse.linalg import spsolve

    basis = skfem.Basis(journal_mesh(250).mesh, skfem.ElementQuad1(), intorder=3)
    held = basis.get_dofs(["left", "right", "top"])

    def solved() -> object:
        matrix, load = poiseuille.assemble(basis), couette.assemble(basis)
        return skfem.solve(*skfem.condense(matrix, load, D=held), solver=spsolve)

    return solved


def measured() -> list[Run]:
    """Every case and the reference in turn; the first call of each, which compiles, does not count."""
    known, plain = cases(), reference()
    plain()
    for work, _ in known.values():
        work()
    found = []
    for name, (work, repeats) in known.items():
        rounds = [(least(work, repeats, time.process_time), least(plain, 1, time.process_time)) for _ in range(ROUNDS)]
        found.append(Run(name, min(own for own, _ in rounds), min(other for _, other in rounds)))
    return found


def earlier() -> dict[str, list[float]]:
    """Ratios of each case in the file, in its order."""
    ratios: dict[str, list[float]] = {}
    if HISTORY.is_file():
        with HISTORY.open(newline="", encoding="utf-8") as lines:
            for row in csv.DictReader(lines):
                ratios.setdefault(row["case"], []).append(float(row["ratio [1]"]))
    return ratios


def keep(runs: list[Run]) -> None:
    """Append the runs to the file under the commit; refuse a working tree with changes."""
    if _git("status", "--porcelain", "--untracked-files=no"):
        raise SystemExit("history.py --keep: the working tree has changes; commit them, so that the row names its code")
    new, commit = not HISTORY.is_file(), _git("rev-parse", "--short=10", "HEAD")
    machine = f"{_processor()}, {os.cpu_count()} cores, Python {platform.python_version()}"
    with HISTORY.open("a", newline="", encoding="utf-8") as lines:
        rows = csv.writer(lines, lineterminator="\n")
        if new:
            rows.writerow(HEADS)
        for one in runs:
            times = f"{1e3 * one.time:.4g}", f"{1e3 * one.reference:.4g}", f"{one.ratio:.4g}"
            rows.writerow((date.today().isoformat(), commit, machine, one.case, *times))


def _git(*words: str) -> str:
    return subprocess.run(["git", *words], cwd=HERE, capture_output=True, text=True, check=True).stdout.strip()


def _processor() -> str:
    info = Path("/proc/cpuinfo")
    names = [line for line in info.read_text().splitlines() if "model name" in line] if info.is_file() else []
    return names[0].partition(":")[2].strip() if names else platform.processor() or platform.machine()


def main() -> int:
    """Measure, print, keep if asked; 1 where a case is slower than before."""
    one_thread()
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--keep", action="store_true", help="append the run to history.csv")
    wanted = arguments.parse_args()
    before, runs, slower = earlier(), measured(), 0
    table = Table(title="Time over that of scikit-fem and spsolve, 1e4 unknowns")
    for head in ("case", "time / ms", "ratio", f"median of the last {LAST}", "change"):
        table.add_column(head, justify="left" if head == "case" else "right")
    for one in runs:
        last = before.get(one.case, [])[-LAST:]
        change = one.ratio / median(last) if last else None
        slower += change is not None and change > SLOWER
        told = "first run" if change is None else f"{100.0 * (change - 1.0):+.0f} %"
        mark = " slower" if change is not None and change > SLOWER else ""
        usual = f"{median(last):.4g}" if last else ""
        table.add_row(one.case, f"{1e3 * one.time:.3g}", f"{one.ratio:.4g}", usual, told + mark)
    Console(width=120).print(table)
    if wanted.keep:
        keep(runs)
    return int(slower > 0)


if __name__ == "__main__":
    sys.exit(main())
