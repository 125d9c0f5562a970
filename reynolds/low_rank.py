"""A compliance cut to those of its motions that matter.

Pays for bodies that bend: a few shapes then make most of the opening. A layer that is thin beside the pressure
field answers to each pressure where it acts, and next to all of its rank is needed for a small error; so is it for
the indentation under a narrow pressure, which falls only as its width (Boussinesq 1885).
"""

from __future__ import annotations

import numpy as np

from reynolds.errors import FilmInputError
from reynolds.mesh import Array
from reynolds.walls import LowRank


def low_rank(matrix: Array, tolerance: float) -> LowRank:
    """The product of least rank with |C p - L R p| <= tolerance max |C q| over |q| = |p|, for every pressure p.

    matrix C (vertices, size) m/Pa; norms are Euclidean, over vertices and over unknowns. Cut where the next
    singular value is within the tolerance: no product of that rank is nearer (Eckart and Young 1936). Raises
    FilmInputError for a tolerance outside 0 .. 1 and for a matrix that is not finite or zero.
    """
    if not 0.0 < tolerance < 1.0:
        raise FilmInputError("low rank, tolerance", f"{tolerance:g}", "between 0 and 1")
    if not (np.isfinite(matrix).all() and np.any(matrix)):
        raise FilmInputError("low rank", "a compliance that is not finite, or zero", "numbers, m/Pa")
    left, size, right = np.linalg.svd(matrix, full_matrices=False)
    rank = int(np.count_nonzero(size > tolerance * size[0]))
    return LowRank(np.ascontiguousarray(left[:, :rank] * size[:rank]), np.ascontiguousarray(right[:rank]))
