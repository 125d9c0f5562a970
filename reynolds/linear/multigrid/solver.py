"""Multigrid for films on logically rectangular meshes, at a cost in proportion to the unknowns.

Lines are relaxed as a whole, odd ones and even ones in turn, and every second one is coarsened away; weights and
coarse operators follow from the entries of the matrix alone (semicoarsening: Dendy, McCormick, Ruge, Russell and
Schaffer 1989; Schaffer 1998). So cells of any aspect ratio, films that jump, nodes that are held and cavities
(rows of the identity) need no special treatment. The cycle is symmetric positive definite and preconditions
conjugate gradients. All of it is in single precision, unless a film jumps beyond its range or the caller
asks for double; the residual and the steps are in double.
"""

from dataclasses import dataclass
from enum import Enum
from math import log10
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from reynolds.errors import FilmInputError
from reynolds.linear.multigrid import coarsening_kernels, cycle_kernels as kernels, grid_kernels
from reynolds.linear.multigrid.coarsest_kernels import SQUARE, Coarsest
from reynolds.linear.multigrid.grid import Grid
from reynolds.linear.multigrid.line_kernels import GridLevels
from reynolds.numerics.arrays import Array
from reynolds.numerics.lanes import WIDTH

MAX_STEPS = 60  # some 10 are usual: beyond these the operator is not suited to multigrid
IN_CACHE = 200_000  # unknowns: above, the finest level is kept once, in double precision, to hold less memory
SPARE = 2  # steps beyond one a digit after which levels of single precision are made anew in double


@dataclass(frozen=True)
class IterationRecord:
    """Record of a solve: steps of conjugate gradients, and the residual, |A x - b| / |b|."""

    steps: int
    left: float


class Precision(Enum):
    """Precision of the cycle, which only preconditions. DOUBLE: linear to better than 1e-7."""

    SINGLE = "single"
    DOUBLE = "double"


class Multigrid:
    """The operator of one grid on all its levels: `update` with new entries, then `solve` any number of times.

    Memory: 21 doubles an unknown, 18 in single precision, 17 above IN_CACHE.
    """

    def __init__(self, grid: Grid, upper: csc_array, precision: Precision = Precision.SINGLE) -> None:
        """`upper` has the pattern of the upper triangles to come.

        Raises FilmInputError where it couples unknowns that are not neighbours on the grid.
        """
        self._grid, lines = grid, [len(grid.unknowns)]
        while lines[-1] > WIDTH:
            lines.append((lines[-1] + 1) // 2)
        self._lines = np.array(lines, dtype=np.int64)
        self._fine, self._entries = _levels(self._grid, self._lines[:1], np.float64)
        large = grid.unknowns.size > IN_CACHE
        self._take_levels(Precision.SINGLE if large else precision)
        self._slots, self._places = _places(self._grid, upper, self._fine)
        self._work = np.zeros((2, self._fine.load.size))

    @property
    def fine(self) -> GridLevels:
        """The finest level in double precision."""
        return self._fine

    @property
    def levels(self) -> tuple[GridLevels, GridLevels, Coarsest]:
        """The cycle: its finest level, the others and the solver of the last, for kernels that cycle themselves."""
        return self._top, self._coarse, self._coarsest

    @property
    def slots(self) -> NDArray[np.int32]:
        """Index of each unknown in the vectors of the finest level."""
        return self._slots

    def update(self, data: Array) -> bool:
        """Set the entries of the upper triangle; False where the matrix is not positive definite on some line."""
        return (
            bool(coarsening_kernels.take_in(data, self._places, self._entries, self._fine, *self.levels))
            or self._precise()
        )

    def _precise(self) -> bool:
        """All levels in double precision from now on; False where they are already, or do not help."""
        if self._coarse.load.dtype == np.float64:
            return False
        self._take_levels(Precision.DOUBLE)
        return bool(coarsening_kernels.set_up(self._fine, *self.levels))

    def _take_levels(self, precision: Precision) -> None:
        single = precision is Precision.SINGLE
        dtype: type[np.floating[Any]] = np.float32 if single else np.float64
        twice = single and self._grid.unknowns.size <= IN_CACHE
        self._top = _levels(self._grid, self._lines[:1], dtype)[0] if twice else self._fine
        self._coarse, _ = _levels(self._grid, self._lines[1:], dtype)
        blocks = self._fine.length + 2
        inverse, onward, back = np.zeros((3, blocks * SQUARE), dtype=dtype)
        self._coarsest = Coarsest(inverse, onward, back, np.zeros(blocks * WIDTH, dtype=dtype))

    def solve(self, load: Array, tolerance: float, start: Array | None = None) -> tuple[Array, IterationRecord]:
        """x with |A x - load| <= tolerance |load|, (n,), or as near as round-off and MAX_STEPS allow.

        From `start` (n,), or from nothing.
        """
        answer, effort = self._iterated(load, tolerance, start)
        # Single precision may round off the only coupling of a wide pocket between thin lands.
        if effort.steps > SPARE - log10(tolerance) and self._precise():
            answer, more = self._iterated(load, tolerance, answer)
            effort = IterationRecord(effort.steps + more.steps, more.left)
        return answer, effort

    def _iterated(self, load: Array, tolerance: float, start: Array | None) -> tuple[Array, IterationRecord]:
        x = np.empty(len(load)) if start is None else np.array(start, dtype=float)
        steps, left = kernels.solve(
            self._fine, *self.levels, self._slots, load, x, start is not None, self._work, tolerance, MAX_STEPS
        )
        return x, IterationRecord(steps, left)

    def full_pass(self, load: Array) -> Array:
        """x to about the error of the mesh, (n,): one pass of full multigrid (Brandt 1977), without a check."""
        kernels.put(load, self._slots, self._top.load)
        kernels.full_cycle(*self.levels)
        return self._taken(self._top.answer)

    def cycle(self, load: Array) -> Array:
        """M load, (n,): the preconditioner, one V-cycle from nothing."""
        kernels.put(load, self._slots, self._top.load)
        kernels.cycle(*self.levels)
        return self._taken(self._top.answer)

    def _taken(self, flat: NDArray[np.floating[Any]]) -> Array:
        values = np.empty(len(self._slots))
        kernels.take(flat, self._slots, values)
        return values


def _levels(
    grid: Grid, lines: NDArray[np.int64], precision: type[np.floating[Any]]
) -> tuple[GridLevels, NDArray[np.floating[Any]]]:
    """Levels of so many lines each, empty, and all their stencils as one flat array."""
    # Two registers of even lines for one of the next level; a pad before the odd lines, and one after any.
    slots = -(-lines // (4 * WIDTH)) * 2 * WIDTH + 2
    sizes = np.repeat((grid.unknowns.shape[1] + 2) * slots, 2)
    total = -(-int(sizes.sum()) // WIDTH) * WIDTH
    stencils, vectors = np.zeros((5, total), dtype=precision), np.zeros((3, total), dtype=precision)
    stencils[0] = 1.0
    centre, east, north, north_east, north_west = stencils
    pivot, answer, load = vectors
    levels = GridLevels(
        centre, east, north, north_east, north_west, pivot, answer, load,
        start=(np.cumsum(sizes) - sizes).reshape(-1, 2), slots=slots,
        lines=lines, length=grid.unknowns.shape[1], around=grid.around,
    )  # fmt: skip
    return levels, stencils.reshape(-1)


def _places(grid: Grid, upper: csc_array, fine: GridLevels) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Index of each unknown in a vector of the finest level, and of each entry of `upper` in the stencils."""
    line_of, along = np.empty((2, grid.unknowns.size), dtype=np.int32)
    line_of[grid.unknowns], along[grid.unknowns] = np.indices(grid.unknowns.shape, dtype=np.int32)
    odd = line_of % 2
    slot = fine.start[0][odd] + (along + 1) * fine.slots[0] + line_of // 2 + odd
    place_of, places = slot.astype(np.int32), np.empty(len(upper.indices), dtype=np.int32)
    neighbours = grid_kernels.find_places(
        upper.indptr, upper.indices, along, line_of, place_of, len(grid.unknowns), grid.around, fine.load.size,
        places,
    )  # fmt: skip
    if not neighbours:
        raise FilmInputError("matrix", "couplings beyond the next unknowns of the grid", "nine-point stencils")
    return place_of, places
