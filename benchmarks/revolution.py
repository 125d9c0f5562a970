"""Time floating gaps over a turn: `python benchmarks/revolution.py [--gap GAP] [--growth] [--before COMMIT] ..`.

Prints for each gap of ref90 at 35 MPa (rigid, isothermal, JFO, rough) what the periodic turn costs (of
the block the pitch after which all repeats) and where the time goes; with --growth how that grows with reported
angles, and with the mesh at 72 of them. --save keeps positions and loads of the periodic turn as DIR/<gap>.npz,
against which a change of the program can be held. --before runs the program of another commit (of this file's history)
first, with the same pump and meshes. Nothing in it runs in parallel; times are those of the process,
the first turn of a smaller mesh having compiled everything.
"""

import argparse
import cProfile
import os
import pstats
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from rich.console import Console
from rich.table import Table

from gaps.films.block import floating_block
from gaps.films.physics import Physics
from gaps.films.piston import floating_piston
from gaps.films.reports import GapReport, block_report, piston_report, slipper_report
from gaps.films.slipper import floating_slipper
from gaps.revolution.march import GapRevolution, run_revolution
from gaps.revolution.schedule import evenly
from reynolds.floating.problem import Floating
from reynolds.floating.stage import FloatingStage
from reynolds.numerics.arrays import Array
from reynolds.solve.solver import FilmSolver
from system.films.drives import drives, no_rubbing
from system.films.parts import floating_parts
from system.films.problems import block_film, piston_film, slipper_film
from system.films.rotor import rotor
from system.points.floating_gaps import FINER, MARCHED, FloatingOptions
from system.points.lumped import lumped_point
from system.pump.operating import operating_point
from system.pump_file.file import load_pump, resolved_toml

PUMP, PRESSURE = "ref90", "35 MPa"
Cells = tuple[int, int]


def cells_by_gap(finer: float) -> dict[str, Cells]:
    """Return the cells of each gap's film, `finer` times the usual both ways."""
    options = FloatingOptions(finer=finer)
    return {"slipper": options.slipper_cells, "piston": options.piston_cells, "block": options.block_cells}


CELLS, COARSE, FINE = (cells_by_gap(times * FINER) for times in (1.0, 0.5, 2.0))
"""Default meshes of floating gaps, half and twice as fine."""
FEW_ANGLES = 72  # a turn: for timing on several meshes
REPEATS = {"slipper": 1, "piston": 1, "block": 9}  # a turn: with equal chambers the block's film repeats every pitch
HEADS = ("gap", "cells", "held", "angles", "turns", "steps", "films", "film / ms", "process / s")
PARTS = {
    "linear solves": ("reynolds/linear/", "qdldl", "superlu"),
    "laws of oil, roughness and contact": ("reynolds/laws/", "contact_kernels.py", "rough_overlap.py"),
    "assembly": ("reynolds/equation/", "reynolds/fem/", "reynolds/compiled/"),
    "loads": ("solve/loads.py", "solve/rubbing.py"),
    "iteration of a film": ("reynolds/solve/", "reynolds/problem.py"),
    "motion": ("reynolds/floating/", "dirk.py", "shooting.py", "gaps/"),
}
"""Parts of the program by marks in the paths of their modules; the first that fits counts."""


Look = Callable[[FloatingStage], GapReport]


def floating_gap(gap: str, cells: Cells) -> tuple[Floating, Look, Array, float]:
    """A gap of the pump, its report, the start (k,) m of its search, and the shaft's speed rad/s."""
    pump = load_pump(PUMP, {"operating.pressure": PRESSURE})
    point = operating_point(pump)
    parts, shaft = floating_parts(pump), rotor(pump, point)
    cycle = lumped_point(pump, point).cycle
    drive = drives(shaft, parts, cycle.shaft_angle, cycle.pressure, no_rubbing(len(cycle.shaft_angle)))
    physics = Physics(elastic_walls=False, pressure_viscosity=False)
    if gap == "slipper":
        slipper = slipper_film(shaft, parts, drive.slipper, physics, cells)
        start = np.array([10e-6, 0.0, 0.0])
        return floating_slipper(slipper), partial(slipper_report, slipper), start, point.shaft_speed
    if gap == "piston":
        piston = piston_film(shaft, parts, drive.piston, physics, cells)
        return floating_piston(piston), partial(piston_report, piston), np.zeros(4), point.shaft_speed
    block = block_film(shaft, parts, drive.block, physics, cells)
    return floating_block(block), partial(block_report, block), np.array([8e-6, 0.0, 0.0]), point.shaft_speed


def turned(gap: str, cells: Cells, angles: int, step: float) -> Callable[[], GapRevolution[GapReport]]:
    """The search of the gap's periodic turn, ready to run."""
    floating, look, start, speed = floating_gap(gap, cells)
    solver = FilmSolver(floating.shape_at(0.0).space)
    return lambda: run_revolution(
        solver,
        floating,
        evenly(speed, angles // REPEATS[gap], 2.0 * np.pi / REPEATS[gap]),
        start,
        look,
        accuracy=replace(MARCHED, step=step),
    )


def timed(work: Callable[[], GapRevolution[GapReport]]) -> tuple[GapRevolution[GapReport], float]:
    """The result and the process time it took, s."""
    began = time.process_time()
    found = work()
    return found, time.process_time() - began


def shares(work: Callable[[], object]) -> dict[str, float]:
    """Share of the time by parts of the program; of other libraries, by their caller."""
    profile = cProfile.Profile()
    profile.runcall(work)
    spent: Counter[str] = Counter()
    for (file, _, name), (_, _, own, _, callers) in pstats.Stats(profile).stats.items():  # type: ignore[attr-defined]
        if (part := part_of(f"{file}:{name}")) or not callers:
            spent[part or "other"] += own
            continue
        for (caller, _, by), (_, _, theirs, _) in callers.items():
            spent[part_of(f"{caller}:{by}") or "other"] += theirs
    total = sum(spent.values())
    return {part: seconds / total for part, seconds in spent.most_common()}


def part_of(place: str) -> str | None:
    """The part of the program to which a function belongs, by its file and name."""
    return next((part for part, marks in PARTS.items() if any(mark in place for mark in marks)), None)


def row_of(gap: str, cells: Cells, found: GapRevolution[GapReport], seconds: float) -> list[str]:
    """One line of the table of costs."""
    unknowns = len(found.turn.last.held)
    steps, turns = len(found.turn.times), found.closing.turns
    each = 1e3 * seconds / found.films_solved
    numbers = (unknowns, len(found.angles), turns, steps, found.films_solved)
    return [gap, f"{cells[0]} x {cells[1]}", *map(str, numbers), f"{each:.2f}", f"{seconds:.1f}"]


def save(found: GapRevolution[GapReport], file: Path) -> None:
    """The periodic turn: angles rad, positions m, forces N, least film m, pressure Pa, leakage m3/s, heat W."""
    instants = found.turn.instants
    np.savez(
        file,
        angle=found.angles,
        position=found.positions,
        film_force=np.array([at.film_force for at in instants]),
        contact_force=np.array([at.contact_force for at in instants]),
        least_film=np.array([at.film_thickness_min for at in instants]),
        pressure_max=np.array([at.pressure_max for at in instants]),
        leakage=np.array([at.report.leakage for at in instants]),
        heat=np.array([at.report.heat.total for at in instants]),
    )


def time_before(commit: str, words: list[str]) -> None:
    """Print the same tables by the program of another commit, in a process of its own."""
    with TemporaryDirectory() as folder:
        checkout, pump = Path(folder) / "checkout", Path(folder) / f"{PUMP}.toml"
        pump.write_text(resolved_toml(load_pump(PUMP)), "utf-8")
        subprocess.run(["git", "worktree", "add", "--detach", "--quiet", checkout, commit], check=True)
        run = (
            "import benchmarks.revolution as old\n"
            f"old.PUMP, old.CELLS, old.COARSE = {str(pump)!r}, {CELLS!r}, {COARSE!r}\n"
            "old.main()"
        )
        try:
            subprocess.run(
                [sys.executable, "-c", run, *words],
                cwd=checkout,
                check=True,
                env=os.environ | {"PYTHONPATH": str(checkout)},
            )
        finally:
            subprocess.run(["git", "worktree", "remove", "--force", checkout], check=True)


def main() -> None:
    """Time the gaps named, all without one, and print them."""
    parser = argparse.ArgumentParser(description="Time the floating gaps of a pump over a turn.")
    parser.add_argument("--gap", choices=list(CELLS), action="append", help="one of the gaps, and so on")
    parser.add_argument("--angles", type=int, default=360, help="reported angles a turn, a multiple of 9")
    parser.add_argument("--step", type=float, default=1e-2, help="error a step may make, of the least film")
    parser.add_argument("--growth", action="store_true", help="also other meshes and angles")
    parser.add_argument("--save", type=Path, help="folder for the periodic turns")
    parser.add_argument("--before", metavar="COMMIT", help="the program of another commit first")
    asked = parser.parse_args()
    if asked.before:
        words = [word for gap in asked.gap or () for word in ("--gap", gap)]
        time_before(asked.before, [*words, "--angles", str(asked.angles), "--step", str(asked.step)])
    gaps, console = asked.gap or list(CELLS), Console()
    costs = Table(title=f"{PUMP} at {PRESSURE}: the periodic turn")
    for head in HEADS:
        costs.add_column(head, justify="right")
    where = Table(title="where the time goes")
    for head in ("part", *gaps):
        where.add_column(head, justify="right")
    parts: dict[str, dict[str, float]] = {}
    for gap in gaps:
        turned(gap, COARSE[gap], 4 * REPEATS[gap], 0.1)()
        series = [(CELLS[gap], asked.angles)]
        if asked.growth:
            series += [(cells, FEW_ANGLES) for cells in (COARSE[gap], CELLS[gap], FINE[gap])]
        for cells, angles in series:
            found, seconds = timed(turned(gap, cells, angles, asked.step))
            row = row_of(gap, cells, found, seconds)
            costs.add_row(*row)
            console.log(", ".join(f"{head} {cell}" for head, cell in zip(HEADS, row, strict=True)))
            if asked.save and cells == CELLS[gap] and angles == asked.angles:
                save(found, asked.save / f"{gap}.npz")
        parts[gap] = shares(turned(gap, CELLS[gap], FEW_ANGLES, asked.step))
    for part in [*PARTS, "other"]:
        where.add_row(part, *(f"{parts[gap].get(part, 0.0):.0%}" for gap in gaps))
    console.print(costs)
    console.print(where)


if __name__ == "__main__":
    main()
