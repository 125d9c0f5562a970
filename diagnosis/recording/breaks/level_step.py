"""Step of a channel's level at one place of the order, beside a smooth law of the other channels.

    y_k = sum_j c_j A_kj + d [k >= K] + e_k

A: terms of the other channels. By least squares for every K at once: with
Q the orthonormal base of A and r the residual without a step, d = h.r/|h - Q Q'h|^2, h being 1 from K on, and the sum
of squares falls by (h.r)^2/|h - Q Q'h|^2.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array

Mask = NDArray[np.bool_]
PER_TERM = 4  # points a term of the law
LEAST_PART = 5  # points before and behind a step
WIDE = 2.0  # largest over least reading of a channel whose logarithm is a term
HELD = 0.8  # of the points: least share of readings of a channel in use
CERTAIN = 10.0  # standard errors of a step
LEFT = 0.4  # of the sum of squares that a step leaves
TINY = 1e-9  # of |h|^2, below which a step is a combination of the other channels


@dataclass(frozen=True)
class LevelStep:
    """Step at row `row`, the first behind it: size d in the unit of y; squares: sum of squares with the step; of_law:
    without; error: standard error of d.
    """

    row: int
    size: float
    squares: float
    of_law: float
    error: float

    @property
    def is_certain(self) -> bool:
        """True for a step of `CERTAIN` standard errors that leaves `LEFT` of the squares at most."""
        return abs(self.size) >= CERTAIN * self.error and self.squares <= LEFT * self.of_law


def level_step(values: Array, law: Array) -> LevelStep | None:
    """The step (K, d) that lowers the sum of squares most: values (N,), law (N, m), nan in gaps; None for too few
    points, and where the law leaves nothing.
    """
    known = np.isfinite(values) & np.all(np.isfinite(law), axis=1)
    rows, free = np.flatnonzero(known), int(known.sum()) - law.shape[1] - 1
    if free < law.shape[1] or len(rows) < 4 * LEAST_PART:
        return None
    base = _base(law[known])
    residual = values[known] - base @ (base.T @ values[known])
    behind = np.cumsum(residual[::-1])[::-1]
    within = np.cumsum(base[::-1], axis=0)[::-1]
    count = np.arange(len(rows), 0.0, -1.0)
    length = count - np.sum(within**2, axis=1)
    allowed = (length > TINY * count) & (count <= len(rows) - LEAST_PART) & (count >= LEAST_PART)
    if not allowed.any():
        return None
    gain = np.where(allowed, behind**2 / np.where(allowed, length, 1.0), 0.0)
    at = int(np.argmax(gain))
    of_law = float(residual @ residual)
    if of_law <= TINY**2 * float(values[known] @ values[known]):
        return None
    squares = max(of_law - float(gain[at]), 0.0)
    error = float(np.sqrt(squares / free / length[at]))
    return LevelStep(int(rows[at]), float(behind[at] / length[at]), squares, of_law, error)


def law_of(readings: Array, columns: NDArray[np.int64]) -> Array:
    """Terms (N, m) of a smooth law of some columns of readings (N, C): first degree, logarithms of channels that vary
    widely, second degree as far as the points suffice. Columns that are mostly gaps or constant are left out.
    """
    scaled, logarithms = [], []
    for k in columns:
        column = readings[:, k]
        known = np.isfinite(column)
        if known.mean() >= HELD and np.ptp(column[known]) > 0.0:
            low, high = np.min(column[known]), np.max(column[known])
            scaled.append(2.0 * (column - low) / (high - low) - 1.0)
            if high > WIDE * low > 0.0:
                logarithms.append(np.log(column))
    terms = [np.ones(len(readings)), *scaled]
    for more in (logarithms, [one**2 for one in scaled], [one * other for one, other in combinations(scaled, 2)]):
        if PER_TERM * (len(terms) + len(more)) <= len(readings):
            terms += more
    return np.column_stack(terms)


def _base(law: Array) -> Array:
    """Orthonormal base of the columns (N, m) of a law."""
    left, sizes, _ = np.linalg.svd(law, full_matrices=False)
    found: Array = left[:, sizes > TINY * sizes[0]]
    return found
