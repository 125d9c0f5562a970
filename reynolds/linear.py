"""Symmetric positive definite solves with one sparsity pattern.

QDLDL (Stellato et al. 2020) keeps its symbolic part between calls and is the fastest of the freely licensed
direct solvers below about 1e5 unknowns; above, conjugate gradients with algebraic multigrid
(Ruge-Stueben 1987, pyamg) take over, since fill grows faster than the mesh.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import qdldl
from scipy.sparse import csc_array, csc_matrix, csr_array, triu

from reynolds.errors import FilmNotConverged
from reynolds.mesh import Array

DIRECT_LIMIT = 60_000
ITERATIVE_TOLERANCE = 1e-11


class Factor:
    """The factorised operator of one pattern: `update` with new entries, then `solve` any number of times."""

    def __init__(self) -> None:
        self._direct: qdldl.Solver | None = None
        self._multigrid: tuple[csr_array, Any] | None = None

    def update(self, upper: csc_array) -> None:
        """Take the upper triangle of a symmetric positive definite matrix; the pattern never changes."""
        if upper.shape[0] > DIRECT_LIMIT:
            self._multigrid = multigrid(upper)
            return
        matrix = csc_matrix((upper.data, upper.indices, upper.indptr), shape=upper.shape)
        if self._direct is None:
            self._direct = qdldl.Solver(matrix, upper=True)
        else:
            self._direct.update(matrix, upper=True)

    def solve(self, load: Array) -> Array:
        """x with A x = load, (n,) or (n, m); raises FilmNotConverged when multigrid stalls."""
        if load.ndim == 2:
            return np.column_stack([self.solve(column) for column in load.T])
        if self._multigrid is None:
            assert self._direct is not None
            return self._direct.solve(load)
        return _conjugate_gradients(*self._multigrid, load)


def multigrid(upper: csc_array, max_coarse: int = 10) -> tuple[csr_array, Any]:
    """The full matrix of an upper triangle and its algebraic multigrid, no coarser than about `max_coarse`."""
    import pyamg

    full = csr_array(upper + triu(upper, 1).T)
    full.indices, full.indptr = full.indices.astype(np.int32), full.indptr.astype(np.int32)
    # The minimum norm keeps positive couplings of stretched quadrilaterals out of the strength graph.
    strength = ("classical", {"theta": 0.25, "norm": "min"})
    return full, pyamg.ruge_stuben_solver(full, strength=strength, max_coarse=max_coarse)


def _conjugate_gradients(matrix: csr_array, hierarchy: Any, load: Array) -> Array:
    history: list[float] = []
    answer = hierarchy.solve(load, tol=ITERATIVE_TOLERANCE, accel="cg", maxiter=200, residuals=history)
    reached = np.linalg.norm(load - matrix @ answer)
    if reached > 1e3 * ITERATIVE_TOLERANCE * np.linalg.norm(load):
        raise FilmNotConverged(
            f"algebraic multigrid stopped at a relative residual of {reached / np.linalg.norm(load):.2g}",
            f"a mesh with less stretched cells, or a smaller mesh (direct solver below {DIRECT_LIMIT} unknowns)",
        )
    return answer
