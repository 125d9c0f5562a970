"""The linearised balance between walls that give way, J = A + B C, ready for any load.

A, sparse, is the balance between rigid walls, B, sparse, its slope by the opening, C the walls' compliance. A film
smooths what a wall feeds back to it: but for a few smooth pressures A^-1 B C is small, on any mesh, so that GMRES
(Saad and Schultz 1986) on J A^-1 takes a few tens of solves with A, where a dense factor of J costs size^3.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.linalg import lapack
from scipy.sparse import csc_array, csr_array
from scipy.sparse.linalg import SuperLU, splu

from reynolds.errors import FilmNotConverged
from reynolds.krylov import gmres
from reynolds.mesh import Array
from reynolds.walls import WallMatrix, full

DENSE_LIMIT = 400  # unknowns up to which a dense factor is as fast
MOST_STEPS = 150  # of GMRES; one that needs more is cheaper with the dense factor
GOOD_ENOUGH = 1e-9  # residual over load, where round-off allows no less
Answer = Callable[[Array, float], Array]
"""(load (size,), tolerance) -> change (size,) with |J change - load| <= tolerance |load|, round-off allowing."""


def compliant_answer(rigid: csc_array, slope: csr_array, wider: WallMatrix, pressures: Array) -> Answer:
    """The answer of J = A + B C P: A `rigid` (size, size), B `slope` (size, vertices), C `wider` (vertices, size).

    P is the diagonal `pressures` (size,), one where an unknown is a free pressure, else zero. What is factorised
    is factorised once. Raises FilmNotConverged where J is singular.
    """
    if isinstance(wider, csr_array):
        return _sparse(csc_array(rigid + slope @ (wider * pressures[None, :])))
    if rigid.shape[0] <= DENSE_LIMIT:
        return _dense(_multiplied(rigid, slope, wider, pressures))
    return _iterated(rigid, slope, wider, pressures)


def _multiplied(rigid: csc_array, slope: csr_array, wider: WallMatrix, pressures: Array) -> Array:
    return np.asarray(rigid.toarray() + slope @ (full(wider) * pressures[None, :]))


def _iterated(rigid: csc_array, slope: csr_array, wider: WallMatrix, pressures: Array) -> Answer:
    factor = _eliminated(rigid)
    if factor is None:  # J need not be singular where A is
        return _dense(_multiplied(rigid, slope, wider, pressures))

    def image(part: Array) -> Array:
        return np.asarray(part + slope @ (wider @ (pressures * factor.solve(part))))

    direct: list[Answer] = []

    def answer(load: Array, tolerance: float) -> Array:
        if not direct:
            part, left = gmres(image, load, tolerance, MOST_STEPS)
            if left <= max(tolerance, GOOD_ENOUGH):
                return np.asarray(factor.solve(part))
            direct.append(_dense(_multiplied(rigid, slope, wider, pressures)))
        return direct[0](load, tolerance)

    return answer


def _eliminated(matrix: csc_array) -> SuperLU | None:
    """Factor of a matrix of symmetric pattern whose diagonal bears it; None where a pivot vanishes."""
    options = {"SymmetricMode": True, "Equil": False}
    try:
        return splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=1e-3, options=options)
    except RuntimeError:  # "Factor is exactly singular"
        return None


def _sparse(matrix: csc_array) -> Answer:
    try:
        factor = splu(matrix)
    except RuntimeError as reason:
        raise singular(str(reason)) from None
    return lambda load, tolerance: np.asarray(factor.solve(load))


def _dense(matrix: Array) -> Answer:
    factor, pivots, fault = lapack.dgetrf(matrix)
    if fault:
        raise singular("a pivot is zero")
    return lambda load, tolerance: np.asarray(lapack.dgetrs(factor, pivots, load)[0])


def singular(reason: str) -> FilmNotConverged:
    """The error of a balance that no change of pressure answers."""
    what = f"the balance between walls that give way is singular ({reason})"
    return FilmNotConverged(what, "stiffer walls, or a thicker film")
