"""The linear solve of a film whose cavities carry oil, on a grid, at a cost in proportion to the unknowns.

Columns of the film are symmetric, those of the cavity are transport downstream. GMRES (Saad and Schultz 1986) is
preconditioned by blocks: the cavity unknown by unknown in the order of its flow, a multigrid cycle on the film
with what the cavity carries into it, and the cavity once more with what the film pushes there. The film's block
leaves out what a cavity returns to the film beyond its next unknown: 7 to 11 steps to 1e-10 in journal bearings
of 7e2 to 6e4 unknowns; a long front where a film reforms takes 14 to 50, more on finer meshes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from reynolds import carried_kernels as kernels
from reynolds.grid import Grid
from reynolds.mesh import Array
from reynolds.multigrid import Effort, Multigrid
from reynolds.triangles import both_triangles

DIRECTIONS = 30  # of GMRES, kept between restarts
ROUNDS = 3


class CarriedFilm:
    """The matrix of a film with cavities on one grid: `update` with new entries and cavity, then `solve`.

    Memory: some 70 doubles an unknown.
    """

    def __init__(self, grid: Grid, upper: csc_array) -> None:
        """`upper` has the pattern to come. Raises FilmInputError as `Multigrid` does."""
        size = grid.unknowns.size
        self._film = Multigrid(grid, upper)
        self._upper = upper
        self._both = both_triangles(upper)
        self._part = np.empty(len(upper.indices))
        self._order, self._waits = np.empty((2, size), dtype=np.int32)
        self._returned = np.empty(size)
        self._basis = np.zeros((DIRECTIONS + 3, size))
        self._entries = np.empty(0)
        self._cavity = np.zeros(size, dtype=bool)
        self._count = 0

    def update(self, upper: Array, lower: Array, cavity: NDArray[np.bool_]) -> bool:
        """Take the entries of the upper triangle, their mirror, and which columns are the cavity's (size,).

        False where the film alone is not positive definite, or a cavity's column has no diagonal.
        """
        self._entries, self._cavity = self._both.entries(upper, lower), cavity
        both, given = self._both, self._upper
        diagonal = self._entries[both.diagonal]
        good = bool((diagonal[cavity] > 0.0).all())
        kernels.film_part(given.indptr, given.indices, upper, lower, cavity, self._returned, self._part)
        self._count = kernels.flow_order(
            both.indptr, both.indices, self._entries, diagonal, cavity, self._order, self._waits
        )
        return good and self._film.update(self._part)

    def solve(self, load: Array, tolerance: float) -> tuple[Array, Effort]:
        """x with |A x - load| <= tolerance |load|, (n,), or as near as ROUNDS of GMRES come."""
        size = float(np.sqrt(np.sum(load * load)))
        answer = np.zeros(len(load))
        if size == 0.0:
            return answer, Effort(0, 0.0)
        both, steps, left = self._both, 0, size
        for _ in range(ROUNDS):
            left, more = kernels.gmres(
                *self._film.levels, self._film.slots, both.indptr, both.indices, self._entries,
                self._entries[both.diagonal], self._cavity, self._order[: self._count], load, tolerance * size,
                self._basis, answer,
            )  # fmt: skip
            steps += more
            if not left > tolerance * size:
                break
        return answer, Effort(steps, left / size)
