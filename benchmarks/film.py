"""Time of a film: the finite journal bearing (L/D 1, eccentricity ratio 0.6), beside plain scikit-fem.

    python benchmarks/film.py          about 1e4, 1e5 and 1e6 unknowns; a few minutes
    python benchmarks/film.py --quick  without scikit-fem and spsolve at 1e6 unknowns: minutes and GB less

One thread. Each time is the least of the repeats, after compilation. `set-up` builds unknowns and sparsity
pattern, once per mesh; `solve` is all that one film takes after that, from its formula on, with its assembly and every
step of the active set; `total` is the two together. The load is compared with verified values: Reynolds' condition with
the converged Sommerfeld number 1.31598, the full film with a Richardson extrapolation over quadratic elements.
"""

from __future__ import annotations

import argparse
import platform
from dataclasses import dataclass
from typing import Any

import numpy as np
import skfem
from journal_case import ECCENTRICITY, ROUND, least, one_thread, rows
from rich.console import Console
from rich.table import Table
from scipy.sparse.linalg import spsolve
from skfem.helpers import dot, grad

from reynolds.equation.balance import stiffness
from reynolds.equation.coefficients import isotropic
from reynolds.fem.mesh import Cell, FilmMesh, rectangle
from reynolds.fem.space import FilmSpace, film_space
from reynolds.problem import ZERO, Cavitation, FilmProblem, Held, film
from reynolds.solve.loads import point_fields
from reynolds.solve.solver import FilmSolver

CELLS = (250, 790, 2530)  # round the bearing
SPSOLVE_LIMIT = 300_000


@dataclass(frozen=True)
class Timing:
    """Seconds and load of one solver on one mesh."""

    solver: str
    unknowns: int
    setup: float
    assembly: float
    solve: float
    steps: int
    load: float
    verified: float


def journal_mesh(n: int) -> FilmMesh:
    """Half of the bearing, radius one: x round it from the largest film, y from midplane to side."""
    return rectangle((ROUND, 1.0), (n, rows(n)), cell=Cell.QUADRILATERAL)


def journal(space: FilmSpace, cavitation: Cavitation) -> FilmProblem:
    """Clearance, viscosity and surface speed one; pressure zero at the largest film and at the side."""
    thickness = space.sample_ruled(lambda x, y: 1.0 + ECCENTRICITY * np.cos(x))
    posed = film(thickness, 1.0, velocity_moving=(np.ones((1, 1)), ZERO))
    return FilmProblem(space, posed, {name: Held(0.0) for name in ("left", "right", "top")}, cavitation)


def sommerfeld_number(pressure: np.ndarray, angle: np.ndarray, area: np.ndarray) -> float:
    """So = F psi^2/(mu omega B D) of the whole bearing from half of it."""
    return float(np.hypot(np.sum(pressure * np.cos(angle) * area), np.sum(pressure * np.sin(angle) * area)) / 2.0)


def full_film_load() -> float:
    """Sommerfeld number of the full film: Richardson extrapolation of Q2, whose load has the fourth order."""
    coarse, fine = (_solve_once(film_space(journal_mesh(n), degree=2), Cavitation.NONE) for n in (80, 160))
    return fine + (fine - coarse) / 15.0


def _solve_once(space: FilmSpace, cavitation: Cavitation) -> float:
    solution = FilmSolver(space).solve(journal(space, cavitation))
    return sommerfeld_number(point_fields(solution).pressure, space.points[0], space.area)


def time_swashfilm(n: int, cavitation: Cavitation, verified: float, repeats: int) -> Timing:
    """Set-up, one assembly, and a cold solve with a fresh factorisation."""
    mesh = journal_mesh(n)
    setup = least(lambda: film_space(mesh), repeats)
    space = film_space(mesh)
    problem = journal(space, cavitation)
    conductance = problem.film.thickness**3 / (12.0 * problem.film.viscosity)
    solution = FilmSolver(space).solve(problem)
    load = sommerfeld_number(point_fields(solution).pressure, space.points[0], space.area)
    return Timing(
        f"reynolds, {'full film' if cavitation is Cavitation.NONE else 'with rupture'}",
        space.size,
        setup,
        least(lambda: stiffness(space, isotropic(conductance)), repeats),
        least(lambda: FilmSolver(space).solve(journal(space, cavitation)), repeats),
        solution.iterations,
        load,
        verified,
    )


@skfem.BilinearForm
def poiseuille(p: Any, f: Any, w: Any) -> Any:
    """int h^3/12 grad p . grad f."""
    return (1.0 + ECCENTRICITY * np.cos(w.x[0])) ** 3 / 12.0 * dot(grad(p), grad(f))


@skfem.LinearForm
def couette(f: Any, w: Any) -> Any:
    """int h/2 df/dx."""
    return 0.5 * (1.0 + ECCENTRICITY * np.cos(w.x[0])) * grad(f)[0]


def time_scikit_fem(n: int, verified: float, repeats: int) -> Timing:
    """The same full film as a scikit-fem user would write it: basis, two forms, spsolve."""
    mesh = journal_mesh(n).mesh

    def basis() -> skfem.Basis:
        return skfem.Basis(mesh, skfem.ElementQuad1(), intorder=3)

    made = basis()
    matrix, load = poiseuille.assemble(made), couette.assemble(made)
    held = made.get_dofs(["left", "right", "top"])
    pressure = skfem.solve(*skfem.condense(matrix, load, D=held), solver=spsolve)
    return Timing(
        "scikit-fem + spsolve, full film",
        made.N,
        least(basis, repeats),
        assembly := least(lambda: (poiseuille.assemble(made), couette.assemble(made)), repeats),
        assembly + least(lambda: skfem.solve(*skfem.condense(matrix, load, D=held), solver=spsolve), repeats),
        1,
        sommerfeld_number(made.interpolate(pressure).value, made.global_coordinates().value[0], made.dx),
        verified,
    )


def table(timings: list[Timing]) -> Table:
    """One line per solver and mesh; error of the load against the verified value."""
    shown = Table(title="Finite journal bearing, L/D 1, eccentricity ratio 0.6, one thread")
    shown.add_column("solver")
    for name in (
        "unknowns", "set-up s", "assembly s", "solve s", "total s", "steps", "So", "verified So", "error %",
    ):  # fmt: skip
        shown.add_column(name, justify="right")
    for row in timings:
        shown.add_row(
            row.solver, f"{row.unknowns}", f"{row.setup:.3f}", f"{row.assembly:.3f}", f"{row.solve:.3f}",
            f"{row.setup + row.solve:.3f}", f"{row.steps}", f"{row.load:.6f}", f"{row.verified:.6f}",
            f"{100.0 * (row.load / row.verified - 1.0):+.4f}",
        )  # fmt: skip
    return shown


def main() -> None:
    """Run it anew with one thread, which the numerical libraries read as they are loaded; print the table."""
    one_thread()
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--quick", action="store_true", help="no spsolve at 1e6 unknowns")
    everything = not arguments.parse_args().quick
    console = Console(width=140)
    console.print(f"Python {platform.python_version()}, scikit-fem {skfem.__version__}, {platform.machine()}")
    verified = {Cavitation.NONE: full_film_load(), Cavitation.REYNOLDS: 1.31598}
    timings = []
    for n in CELLS:
        repeats = 5 if n < 300 else 3 if n < 1000 else 1
        for cavitation in verified:
            timings.append(time_swashfilm(n, cavitation, verified[cavitation], repeats))
        if everything or timings[-1].unknowns < SPSOLVE_LIMIT:
            timings.append(time_scikit_fem(n, verified[Cavitation.NONE], repeats))
        else:
            console.print(f"spsolve left out at {timings[-1].unknowns} unknowns")
    console.print(table(timings))


if __name__ == "__main__":
    main()
