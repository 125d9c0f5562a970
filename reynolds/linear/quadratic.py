"""Linear solver of a quadratic film on a grid, at a cost in proportion to the unknowns.

Conjugate gradients; the preconditioner is a multigrid cycle of the linear film on the same nodes
(`reynolds.equation.companion`): some 15 to 20 steps to 1e-11 on any mesh, where a film jumps along sides of cells
alone. A film that trebles inside cells takes 45 steps; one that grows twentyfold there stalls.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from reynolds.linear import quadratic_kernels as kernels
from reynolds.linear.multigrid.grid import Grid
from reynolds.linear.multigrid.solver import IterationRecord, Multigrid
from reynolds.numerics.array_kernels import norm
from reynolds.numerics.arrays import Array

MAX_STEPS = 80


class QuadraticFilm:
    """The matrix of a quadratic film: `update` with new entries and those of its companion, then `solve`."""

    def __init__(self, grid: Grid, linear: csc_array, unknowns: NDArray[np.int32]) -> None:
        """`grid` and `linear`: grid and pattern of the companion; unknowns (size,): its unknown of each of the film's.

        Raises FilmInputError as `Multigrid` does.
        """
        self._cycle = Multigrid(grid, linear)
        self._slots = self._cycle.slots[unknowns]
        self._work = np.zeros((2, len(unknowns)))
        self._matrix: csc_array | None = None

    def update(self, upper: csc_array, linear: Array) -> bool:
        """Set the upper triangle and the companion's entries; False where that is not positive definite."""
        self._matrix = upper
        return self._cycle.update(linear)

    def solve(self, load: Array, tolerance: float) -> tuple[Array, IterationRecord]:
        """x with |A x - load| <= tolerance |load|, (n,), or as near as round-off and MAX_STEPS allow."""
        assert self._matrix is not None
        size, answer = norm(load), np.zeros(len(load))
        if size == 0.0:
            return answer, IterationRecord(0, 0.0)
        parts, image = (self._matrix.indptr, self._matrix.indices, self._matrix.data), self._work[1]
        steps = kernels.conjugate_gradients(
            *parts, self._cycle.levels, self._slots, load.copy(), answer, self._work, tolerance * size, MAX_STEPS
        )
        # That of the recurrence falls on where round-off holds the answer's.
        kernels.apply(*parts, answer, image)
        return answer, IterationRecord(steps, norm(load - image) / size)
