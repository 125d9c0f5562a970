"""Linear solver of a film with oil in its cavities, on a grid, at a cost in proportion to the unknowns.

Columns of the film are symmetric, those of the cavity transport oil downstream. GMRES (Saad and Schultz 1986) is
preconditioned by blocks: the cavity unknown by unknown in the order of its flow, a multigrid cycle on the film
with the cavity's flow into it, and the cavity once more with the film's flow into it. The film's block leaves out
the flow that a cavity returns to the film beyond its next unknown: 7 to 11 steps to 1e-10 in journal bearings of
7e2 to 6e4 unknowns; a long front where a film reforms takes 14 to 50, more on finer meshes.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array

from reynolds.linear import cavitated_kernels as kernels
from reynolds.linear.multigrid.grid import Grid
from reynolds.linear.multigrid.solver import IterationRecord, Multigrid, Precision
from reynolds.linear.triangles import both_triangles
from reynolds.numerics.array_kernels import norm
from reynolds.numerics.arrays import Array

DIRECTIONS = 30  # of GMRES, kept between restarts
ROUNDS = 3


class CavitatedFilm:
    """The matrix of a film with cavities on one grid: `update` with new entries and cavity, then `solve`.

    Memory: some 100 doubles an unknown.
    """

    def __init__(self, grid: Grid, upper: csc_array) -> None:
        """`upper` has the pattern to come. Raises FilmInputError as `Multigrid` does."""
        size, entries = grid.unknowns.size, 2 * len(upper.indices)
        self._film = Multigrid(grid, upper, Precision.DOUBLE)
        self._upper = upper
        self._both = both_triangles(upper)
        self._part = np.empty(len(upper.indices))
        self._order, self._waits = np.empty((2, size), dtype=np.int32)
        self._returned = np.empty(size)
        self._basis = np.zeros((DIRECTIONS + 3, size))
        self._begin, self._value = np.empty(size + 1, dtype=np.int32), np.empty(entries)
        self._row, self._edge, self._edge_column = np.empty((3, entries), dtype=np.int32)
        self._columns: kernels.CavitatedColumns | None = None

    def update(self, upper: Array, lower: Array, cavity: NDArray[np.bool_]) -> bool:
        """Set the entries of the upper triangle, their mirror, and which columns are the cavity's (size,).

        False where the film alone is not positive definite, or a cavity's column has no diagonal.
        """
        both, given = self._both, self._upper
        entries = both.entries(upper, lower)
        diagonal = entries[both.diagonal]
        good = bool((diagonal[cavity] > 0.0).all())
        kernels.film_part(given.indptr, given.indices, upper, lower, cavity, self._returned, self._part)
        count = kernels.flow_order(both.indptr, both.indices, entries, diagonal, cavity, self._order, self._waits)
        columns = kernels.CavitatedColumns(
            both.indptr, both.indices, entries, diagonal, cavity, self._order[:count], self._begin, self._row,
            self._value, self._edge, self._edge_column,
        )  # fmt: skip
        edges = kernels.sort_columns(columns)
        self._columns = columns._replace(edge=self._edge[:edges], edge_column=self._edge_column[:edges])
        return good and self._film.update(self._part)

    def solve(self, load: Array, tolerance: float, *, transposed: bool = False) -> tuple[Array, IterationRecord]:
        """x with |A x - load| <= tolerance |load|, (n,), or as near as ROUNDS of GMRES come; A^T x if `transposed`."""
        size = norm(load)
        answer = np.zeros(len(load))
        if size == 0.0:
            return answer, IterationRecord(0, 0.0)
        steps, left = 0, size
        for _ in range(ROUNDS):
            left, more = kernels.gmres(
                self._film.levels,
                self._film.slots,
                self._columns,
                transposed,
                load,
                tolerance * size,
                self._basis,
                answer,
            )
            steps += more
            if not left > tolerance * size:
                break
        return answer, IterationRecord(steps, left / size)
