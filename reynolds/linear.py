"""Linear solves with one sparsity pattern: symmetric positive definite (`Factor`) and general (`GeneralFactor`).

A ladder for the symmetric ones. On a grid, multigrid takes them from a few hundred unknowns on. QDLDL (Stellato
et al. 2020) keeps its symbolic part between calls and is the fastest of the freely licensed direct solvers below
about 1e5 unknowns; above, conjugate gradients with algebraic multigrid (Ruge-Stueben 1987, pyamg) take over,
since fill grows faster than the mesh. Where a rung stalls, the next one does it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import qdldl
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array, csc_matrix, csr_array, triu
from scipy.sparse.linalg import SuperLU, splu

from reynolds.errors import FilmNotConverged
from reynolds.grid import Grid
from reynolds.mesh import Array
from reynolds.multigrid import Multigrid

DIRECT_LIMIT = 60_000
GRID_LEAST = 500  # unknowns: below, a direct solve of a grid is as fast as multigrid
ITERATIVE_TOLERANCE = 1e-11
STALLED = 1e3  # times the tolerance: what round-off may leave; beyond, the next rung of the ladder
GENERAL_TOLERANCE = 1e-10  # residual over load beyond which an elimination without pivots is done again with them


class Factor:
    """The factorised operator of one pattern: `update` with new entries, then `solve` any number of times."""

    def __init__(self, grid: Grid | None = None) -> None:
        """`grid`: the rows and columns of the unknowns (`grid_of`), None where there are none."""
        self._grid = grid if grid is not None and grid.unknowns.size >= GRID_LEAST else None
        self._on_grid: Multigrid | None = None
        self._direct: qdldl.Solver | None = None
        self._multigrid: tuple[csr_array, Any] | None = None
        self._upper: csc_array | None = None
        self._stalled = False

    def update(self, upper: csc_array) -> None:
        """Take the upper triangle of a symmetric positive definite matrix; the pattern never changes."""
        self._upper = upper
        if self._grid is not None:
            if self._on_grid is None:
                self._on_grid = Multigrid(self._grid, upper)
            if self._on_grid.update(upper.data):
                return
            self._leave_grid()
        self._off_grid(upper)

    def solve(self, load: Array) -> Array:
        """x with A x = load, (n,). Where multigrid stalls (films that jump many times over) by a direct solve."""
        assert self._upper is not None
        if self._on_grid is not None:
            answer, effort = self._on_grid.solve(load, ITERATIVE_TOLERANCE)
            if effort.left <= STALLED * ITERATIVE_TOLERANCE:
                return answer
            self._leave_grid()
            self._off_grid(self._upper)
        if self._multigrid is not None:
            answer, converged = _conjugate_gradients(*self._multigrid, load)
            if converged:
                return answer
            self._stalled = True
            self._factorise(self._upper)
        assert self._direct is not None
        return self._direct.solve(load)

    def _leave_grid(self) -> None:
        self._grid = self._on_grid = None

    def _off_grid(self, upper: csc_array) -> None:
        if upper.shape[0] > DIRECT_LIMIT and not self._stalled:
            self._multigrid = multigrid(upper)
        else:
            self._factorise(upper)

    def _factorise(self, upper: csc_array) -> None:
        self._multigrid = None
        matrix = csc_matrix((upper.data, upper.indices, upper.indptr), shape=upper.shape)
        if self._direct is None:
            self._direct = qdldl.Solver(matrix, upper=True)
        else:
            self._direct.update(matrix, upper=True)


def multigrid(upper: csc_array, max_coarse: int = 10) -> tuple[csr_array, Any]:
    """The full matrix of an upper triangle and its algebraic multigrid, no coarser than about `max_coarse`."""
    import pyamg

    full = csr_array(upper + triu(upper, 1).T)
    full.indices, full.indptr = full.indices.astype(np.int32), full.indptr.astype(np.int32)
    # The minimum norm keeps positive couplings of stretched quadrilaterals out of the strength graph.
    strength = ("classical", {"theta": 0.25, "norm": "min"})
    return full, pyamg.ruge_stuben_solver(full, strength=strength, max_coarse=max_coarse)


def _conjugate_gradients(matrix: csr_array, hierarchy: Any, load: Array) -> tuple[Array, bool]:
    """The solution, and whether its residual came down to near ITERATIVE_TOLERANCE of the load."""
    answer = hierarchy.solve(load, tol=ITERATIVE_TOLERANCE, accel="cg", maxiter=200)
    reached = float(np.linalg.norm(load - matrix @ answer))
    return answer, reached <= STALLED * ITERATIVE_TOLERANCE * float(np.linalg.norm(load))


class GeneralFactor:
    """A matrix of symmetric pattern and any values, factorised: `update`, then `solve` any number of times.

    Made for the mass-conserving film, whose columns are symmetric in the film and upwind transport in the
    cavity: pivots on the diagonal do, and where they do not the elimination is done again with pivots.
    """

    def __init__(self) -> None:
        self._full: _FullPattern | None = None
        self._matrix: csc_array | None = None
        self._scale: tuple[Array, Array] | None = None
        self._lu: SuperLU | None = None

    def update(self, upper: csc_array, lower: Array) -> None:
        """Take the upper triangle with its diagonal, and the mirrored entries.

        lower[k] is the entry (j, i) where upper.data[k] is (i, j); on the diagonal it is not looked at. The
        pattern never changes. Raises FilmNotConverged for a row or column of zeros.
        """
        if self._full is None:
            self._full = _full_pattern(upper)
        entries = np.concatenate([upper.data, lower])[self._full.source]
        matrix = csc_array((entries, self._full.indices, self._full.indptr), shape=upper.shape)
        columns = _largest(np.abs(entries), self._full.column, upper.shape[0])
        entries = np.abs(entries) / columns[self._full.column]
        rows = _largest(entries, self._full.indices, upper.shape[0])
        self._scale = 1.0 / rows, 1.0 / columns
        entries = matrix.data * self._scale[0][matrix.indices] * self._scale[1][self._full.column]
        self._matrix = csc_array((entries, matrix.indices, matrix.indptr), shape=upper.shape)
        self._lu = _eliminate(self._matrix, threshold=1e-3)

    def solve(self, load: Array) -> Array:
        """x with A x = load, (n,), refined once. Raises FilmNotConverged where the matrix is singular."""
        assert self._matrix is not None
        assert self._scale is not None
        rows, columns = self._scale
        scaled = rows * load
        answer, good = _refined(self._lu, self._matrix, scaled)
        if not good:
            self._lu = _eliminate(self._matrix, threshold=1.0)
            answer, good = _refined(self._lu, self._matrix, scaled)
        if not good:
            raise FilmNotConverged("the linearised film balance is singular", "a boundary that holds a pressure")
        return columns * answer


@dataclass(frozen=True)
class _FullPattern:
    """Both triangles by columns; `source` places each entry in (upper data, lower data)."""

    indptr: NDArray[np.int32]
    indices: NDArray[np.int32]
    column: NDArray[np.int32]
    source: NDArray[np.int64]


def _full_pattern(upper: csc_array) -> _FullPattern:
    size, count = upper.shape[0], len(upper.indices)
    column = np.repeat(np.arange(size, dtype=np.int32), np.diff(upper.indptr))
    off = np.flatnonzero(upper.indices != column)
    row = np.concatenate([upper.indices, column[off]])
    number = np.concatenate([np.arange(count), count + off])
    full = coo_array((number + 1, (row, np.concatenate([column, upper.indices[off]]))), shape=upper.shape).tocsc()
    full.sort_indices()
    indptr, indices = full.indptr.astype(np.int32), full.indices.astype(np.int32)
    return _FullPattern(
        indptr, indices, np.repeat(np.arange(size, dtype=np.int32), np.diff(indptr)), full.data - 1
    )


def _largest(values: Array, place: NDArray[np.int32], size: int) -> Array:
    """Largest value at each place, (size,)."""
    found = np.zeros(size)
    np.maximum.at(found, place, values)
    if not found.all():
        raise FilmNotConverged("a film balance that nothing enters", "a boundary that holds a pressure")
    return found


def _eliminate(matrix: csc_array, threshold: float) -> SuperLU | None:
    """SuperLU (Li 2005); None where a pivot vanishes."""
    options = {"SymmetricMode": threshold < 1.0, "Equil": False}
    order = "MMD_AT_PLUS_A" if threshold < 1.0 else "COLAMD"
    try:
        return splu(matrix, permc_spec=order, diag_pivot_thresh=threshold, options=options)
    except RuntimeError:  # "Factor is exactly singular"
        return None


def _refined(lu: SuperLU | None, matrix: csc_array, load: Array) -> tuple[Array, bool]:
    """Solution after one step of refinement, and whether its residual is small."""
    if lu is None:
        return load, False
    answer = lu.solve(load)
    answer += lu.solve(load - matrix @ answer)
    left = float(np.linalg.norm(load - matrix @ answer))
    return answer, left <= GENERAL_TOLERANCE * float(np.linalg.norm(load))
