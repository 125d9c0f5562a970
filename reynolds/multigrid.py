"""Multigrid for films on logically rectangular meshes, at a cost in proportion to the unknowns.

Rows are relaxed as a whole, odd ones and even ones in turn, and every second one is coarsened away; weights and
coarse operators follow from the entries of the matrix alone (semicoarsening: Dendy, McCormick, Ruge, Russell and
Schaffer 1989; Schaffer 1998). So cells of any aspect ratio, films that jump, nodes that are held and cavities
(rows of the identity) need no word about them. The cycle is symmetric positive definite and preconditions
conjugate gradients.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from reynolds import coarsening_kernels, grid_kernels
from reynolds import multigrid_kernels as kernels
from reynolds.errors import FilmInputError
from reynolds.grid import Grid
from reynolds.line_kernels import Levels
from reynolds.mesh import Array

MAX_STEPS = 60  # some 10 are usual: beyond these the operator is not one for multigrid
CACHED = 200_000  # unknowns: below this all stays in cache, and the longer rows are the faster ones


@dataclass(frozen=True)
class Effort:
    """What a solve took: steps of conjugate gradients, and what is left of the load, |A x - b| / |b|."""

    steps: int
    left: float


class Multigrid:
    """The operator of one grid on all its levels: `update` with new entries, then `solve` any number of times.

    Memory: 21 doubles an unknown, 23 where the rows close on themselves.
    """

    def __init__(self, grid: Grid, upper: csc_array) -> None:
        """`upper` has the pattern of the upper triangles to come.

        Raises FilmInputError where it couples unknowns that are not neighbours on the grid.
        """
        longer = grid.rows > grid.columns and grid.unknowns.size < CACHED
        self._grid = grid.turned if longer else grid
        self._levels, self._stencils = _levels(self._grid)
        self._places = _places(self._grid, upper, self._stencils.shape[1])
        self._work = np.zeros((2, self._grid.rows + 2, self._grid.columns + 2))

    @property
    def parts(self) -> tuple[Levels, NDArray[np.int32]]:
        """The levels and their unknowns in rows, for kernels that cycle themselves."""
        return self._levels, self._grid.unknowns

    def update(self, data: Array) -> bool:
        """Take the entries of the upper triangle; False where the matrix is not positive definite on some row."""
        kernels.spread(data, self._places, self._stencils)
        return bool(coarsening_kernels.set_up(self._levels))

    def solve(self, load: Array, tolerance: float) -> tuple[Array, Effort]:
        """x with |A x - load| <= tolerance |load|, (n,), or as near as round-off and MAX_STEPS let it come."""
        kernels.to_rows(load, self._grid.unknowns, self._levels.load)
        steps, size = kernels.conjugate_gradients(self._levels, *self._work, tolerance, MAX_STEPS)
        if size == 0.0:
            return np.zeros(len(load)), Effort(0, 0.0)
        kernels.to_rows(load, self._grid.unknowns, self._levels.load)
        left = kernels.left_of(self._levels, self._work[0])
        return self._taken(self._work[0]), Effort(steps, float(left / size))

    def residual(self, load: Array, x: Array) -> Array:
        """load - A x, (n,)."""
        unknowns = self._grid.unknowns
        kernels.to_rows(load, unknowns, self._levels.load)
        kernels.to_rows(x, unknowns, self._work[0])
        kernels.left_of(self._levels, self._work[0])
        return self._taken(self._levels.load)

    def full_pass(self, load: Array) -> Array:
        """x to about the error of the mesh, (n,): one pass of full multigrid (Brandt 1977), without a check."""
        kernels.to_rows(load, self._grid.unknowns, self._levels.load)
        kernels.full_cycle(self._levels)
        return self._taken(self._levels.answer)

    def cycle(self, load: Array) -> Array:
        """M load, (n,): the preconditioner, one V-cycle from nothing."""
        kernels.to_rows(load, self._grid.unknowns, self._levels.load)
        kernels.cycle(self._levels)
        return self._taken(self._levels.answer)

    def _taken(self, rows: Array) -> Array:
        values = np.empty(self._grid.unknowns.size)
        kernels.from_rows(rows, self._grid.unknowns, values)
        return values


def _levels(grid: Grid) -> tuple[Levels, Array]:
    """All levels, empty, and their stencils as one array (5, all rows, columns + 2)."""
    counts = [grid.rows]
    while counts[-1] > 1:
        counts.append((counts[-1] + 1) // 2)
    rows = np.array(counts, dtype=np.int64)
    total, width = int(np.sum(rows + 2)), grid.columns + 2
    stencils, vectors = np.zeros((5, total, width)), np.zeros((3, total, width))
    levels = Levels(
        centre=stencils[0],
        east=stencils[1],
        north=stencils[2],
        north_east=stencils[3],
        north_west=stencils[4],
        pivot=vectors[0],
        closing=np.zeros((total if grid.around_x else 0, width)),
        answer=vectors[1],
        load=vectors[2],
        first=np.cumsum(rows + 2) - (rows + 2),
        rows=rows,
        around_x=grid.around_x,
        around_y=grid.around_y,
    )
    return levels, stencils


def _places(grid: Grid, upper: csc_array, total: int) -> NDArray[np.int32]:
    """Where each entry of the upper triangle stands in the flattened stencils."""
    row_of, column_of = np.empty((2, grid.unknowns.size), dtype=np.int32)
    row_of[grid.unknowns], column_of[grid.unknowns] = np.indices(grid.unknowns.shape, dtype=np.int32)
    places = np.empty(len(upper.indices), dtype=np.int32)
    neighbours = grid_kernels.find_places(
        upper.indptr, upper.indices, column_of, row_of, grid.columns, grid.rows, grid.around_x, grid.around_y,
        total, places,
    )  # fmt: skip
    if not neighbours:
        raise FilmInputError("matrix", "couplings beyond the next unknowns of the grid", "nine-point stencils")
    return places
