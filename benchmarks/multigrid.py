"""Cost of multigrid on grids: set-up, solve, steps and work units over films and mesh sizes.

    python benchmarks/multigrid.py          2e3, 1e4, 1e5 and 1e6 unknowns; about a minute
    python benchmarks/multigrid.py --quick  up to 1e4

One thread; each time is the least of the repeats, after compilation, without assembly. The film is a journal
bearing unwrapped, closed round, pressure zero at both sides. `set-up` takes new entries and builds all levels;
`solve` is to a residual of 1e-8 of the load, from nothing. A work unit is the time of one residual evaluation on
the finest mesh. `pass` is one pass of full multigrid, `error` what it differs from the solution over the largest
pressure. `warm` is set-up and solve to 1e-6 for a film whose eccentricity ratio has grown by 0.001, started from
the pressure before. `bandwidth` is the share of what the triad a = b + s c reaches, for the numbers that a step of
conjugate gradients must move: 32 for each unknown of all levels in a cycle, 20 for each of the finest beside it.
Above 100 %, some of them stay in the last cache.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from journal_case import ROUND, least, one_thread
from numba import njit
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from reynolds.equation.balance import stiffness
from reynolds.equation.coefficients import isotropic
from reynolds.fem import kernels
from reynolds.fem.mesh import Cell, rectangle
from reynolds.fem.space import FilmSpace, film_space
from reynolds.linear.multigrid import cycle_kernels as multigrid_kernels
from reynolds.linear.multigrid.grid import grid_of
from reynolds.linear.multigrid.solver import Multigrid

Array = NDArray[np.float64]
CELLS = (72, 160, 500, 1600)  # round the bearing; 0.4 of it over the width
CYCLE_NUMBERS, FINEST_NUMBERS = 32, 20
GROWTH = 0.001
CACHED = 200_000  # unknowns: below, all stays in cache


@dataclass(frozen=True)
class Case:
    """A film thickness over angle and place across the width (0 to 1), by eccentricity ratio."""

    name: str
    thickness: Callable[[Array, Array, float], Array]
    eccentricity: float = 0.6
    width: float = 1.0
    cavity: bool = False


def journal(x: Array, y: Array, eccentricity: float) -> Array:
    """Film thickness over the clearance at angle x and place y across the width, as are the next two."""
    return 1.0 + eccentricity * np.cos(x)


def pocket(x: Array, y: Array, eccentricity: float) -> Array:
    """A pocket in the thin film."""
    inside = (np.abs(x - 3.0) < 1.0) & (np.abs(y - 0.5) < 0.2)
    return np.where(inside, 50.0, 1.0) * journal(x, y, eccentricity)


def grooves(x: Array, y: Array, eccentricity: float) -> Array:
    """Grooves across, open to one side."""
    return np.where((np.sin(8.0 * x) > 0.6) & (y < 0.8), 20.0, 1.0) * journal(x, y, eccentricity)


CASES = (
    Case("journal .6", journal),
    Case("journal .95", journal, eccentricity=0.95),
    Case("pocket x 50", pocket),
    Case("grooves x 20", grooves),
    Case("aspect 20", journal, width=0.05),
    Case("ruptured", journal, cavity=True),
)


@njit(error_model="numpy")
def _triad(a: Array, b: Array, c: Array) -> None:
    for i in range(a.shape[0]):
        a[i] = b[i] + 3.0 * c[i]


def bandwidth() -> float:
    """Memory traffic of one thread in the triad, bytes/s."""
    a, b, c = np.ones((3, 10_000_000))  # pages of zeros never written would be one page
    _triad(a, b, c)
    return 24.0 * len(a) / least(lambda: _triad(a, b, c), 60)


def operator(space: FilmSpace, case: Case, eccentricity: float) -> tuple[Array, Array]:
    """Entries of the upper triangle and right-hand side of div h^3 grad p = dh/dx, the identity where fixed."""
    x, y = space.points
    h = case.thickness(x, y / case.width, eccentricity)
    entries = stiffness(space, isotropic(h**3))
    fixed = np.zeros(space.size, dtype=bool)
    fixed[np.concatenate([space.edge_dofs["bottom"], space.edge_dofs["top"]])] = True
    where = np.empty(space.size)
    where[space.vertex_dofs] = space.vertices[:, 0]
    if case.cavity:
        fixed |= where > 1.2 * np.pi
    data, pattern = np.empty_like(entries), space.pattern
    kernels.hold(pattern.indptr, pattern.indices, entries, 1.0 / entries.max(), fixed, np.zeros(space.size), data)
    return data, np.where(fixed, 0.0, eccentricity * np.sin(where) / space.size)


def row(case: Case, cells: int, triad: float) -> tuple[str, ...]:
    """One line of the table."""
    mesh = rectangle((ROUND, case.width), (cells, int(0.4 * cells)), cell=Cell.QUADRILATERAL, periodic_x=True)
    space = film_space(mesh)
    data, load = operator(space, case, case.eccentricity)
    grid = grid_of(space)
    assert grid is not None
    multigrid = Multigrid(grid, space.matrix(data))
    multigrid.update(data)
    multigrid.solve(load, 1e-8)  # settles the precision of the levels
    answer, effort = multigrid.solve(load, 1e-8)
    exact, _ = multigrid.solve(load, 1e-12)
    error = np.abs(multigrid.full_pass(load) - exact).max() / np.abs(exact).max()
    in_memory = space.size > CACHED
    repeats = 15 if in_memory else 40
    fine, (top, coarse, coarsest) = multigrid.fine, multigrid.levels
    field, image = np.zeros((2, fine.load.size))
    multigrid_kernels.put(answer, multigrid.slots, field)
    unit = least(lambda: multigrid_kernels.left_of(fine, field, image), repeats)
    setup = least(lambda: multigrid.update(data), repeats)
    solve = least(lambda: multigrid.solve(load, 1e-8), repeats)
    once = least(lambda: multigrid.full_pass(load), repeats)
    # All coarse levels together have as many unknowns as the finest.
    per_unknown = 8.0 * FINEST_NUMBERS + (top.load.itemsize + coarse.load.itemsize) * CYCLE_NUMBERS
    moved = per_unknown * space.size * effort.steps
    changed, new_load = operator(space, case, case.eccentricity + GROWTH)
    warm = least(lambda: warm_step(multigrid, changed, new_load, answer), repeats)
    levels = (fine, coarse) if top is fine else (fine, top, coarse)
    held = (
        sum(array.nbytes for level in levels for array in level[:8])
        + sum(array.nbytes for array in coarsest)
        + field.nbytes
        + image.nbytes
    )
    return (
        case.name, f"{space.size}", f"{1e3 * setup:.3g}", f"{1e3 * solve:.3g}", f"{effort.steps}",
        f"{solve / unit:.0f}", f"{1e3 * once:.3g}", f"{once / unit:.0f}", f"{error:.1e}", f"{1e3 * warm:.3g}",
        f"{moved / solve / triad:.0%}" if in_memory else "cached",
        f"{(held + 4.0 * (len(data) + space.size)) / 1e6:.3g}",
    )  # fmt: skip


def warm_step(multigrid: Multigrid, data: Array, load: Array, start: Array) -> Array:
    """The answer for changed entries from an old one, to 1e-6 of the load."""
    multigrid.update(data)
    return multigrid.solve(load, 1e-6, start)[0]


def main() -> None:
    """Print the table."""
    one_thread()
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="up to 1e4 unknowns")
    quick = parser.parse_args().quick
    triad = bandwidth()
    table = Table(title=f"Multigrid on grids, one thread; triad {triad / 1e9:.1f} GB/s")
    heads = (
        "film", "unknowns", "set-up ms", "solve ms", "steps", "work units", "pass ms", "work units", "error",
        "warm ms", "bandwidth", "MB",
    )  # fmt: skip
    for head in heads:
        table.add_column(head, justify="left" if head == "film" else "right")
    for cells in CELLS[:2] if quick else CELLS:
        for case in CASES:
            table.add_row(*row(case, cells, triad))
        table.add_section()
    Console(width=140).print(table)


if __name__ == "__main__":
    main()
