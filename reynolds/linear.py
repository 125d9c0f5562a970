"""Symmetric positive definite solves with one sparsity pattern.

QDLDL (Stellato et al. 2020) keeps its symbolic part between calls and is the fastest of the freely licensed
direct solvers below about 1e5 unknowns; above, conjugate gradients with algebraic multigrid
(Ruge-Stueben 1987, pyamg) take over, since fill grows faster than the mesh. Where they stall, the direct solver
does it after all, slowly.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import qdldl
from scipy.sparse import csc_array, csc_matrix, csr_array, triu

from reynolds.mesh import Array

DIRECT_LIMIT = 60_000
ITERATIVE_TOLERANCE = 1e-11


class Factor:
    """The factorised operator of one pattern: `update` with new entries, then `solve` any number of times."""

    def __init__(self) -> None:
        self._direct: qdldl.Solver | None = None
        self._multigrid: tuple[csr_array, Any] | None = None
        self._upper: csc_array | None = None
        self._stalled = False

    def update(self, upper: csc_array) -> None:
        """Take the upper triangle of a symmetric positive definite matrix; the pattern never changes."""
        self._upper = upper
        if upper.shape[0] > DIRECT_LIMIT and not self._stalled:
            self._multigrid = multigrid(upper)
        else:
            self._factorise(upper)

    def solve(self, load: Array) -> Array:
        """x with A x = load, (n,). Where multigrid stalls (films that jump many times over) by a direct solve."""
        if self._multigrid is not None:
            answer, converged = _conjugate_gradients(*self._multigrid, load)
            if converged:
                return answer
            assert self._upper is not None
            self._stalled = True
            self._factorise(self._upper)
        assert self._direct is not None
        return self._direct.solve(load)

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
    return answer, reached <= 1e3 * ITERATIVE_TOLERANCE * float(np.linalg.norm(load))
