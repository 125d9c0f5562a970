"""Repeatability from points that repeat a set point."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array

Numbers = NDArray[np.int64]
FEWEST = 5  # degrees of freedom below which a scatter is no estimate


def set_points(marks: Array) -> Numbers:
    """Return the set point's number of each row: equal marks are one set point, nan is one of its own."""
    own = np.where(np.isfinite(marks), marks, np.inf)
    _, numbers = np.unique(own, return_inverse=True)
    lone = ~np.isfinite(marks)
    numbers = numbers.astype(np.int64)
    numbers[lone] = numbers.max(initial=0) + 1 + np.arange(int(lone.sum()))
    return numbers


def repeatability(readings: Array, inputs: Array, numbers: Numbers) -> float | None:
    """Return one sigma of a channel (N,) from the scatter within set points, pooled; None below `FEWEST` degrees.

    Set points are reached approximately: the part of the scatter that follows the deviations of the inputs (N, M)
    within set points is removed by least squares first, as far as degrees of freedom allow.
    """
    known = np.isfinite(readings)
    deviation, groups = _within(readings[known], numbers[known])
    free = len(deviation) - groups
    if free < FEWEST:
        return None
    moved = [_within(np.nan_to_num(column[known]), numbers[known])[0] for column in inputs.T]
    shifts = np.array([shift for shift in moved if np.any(shift)]).reshape(-1, len(deviation)).T
    rank = int(np.linalg.matrix_rank(shifts)) if shifts.size else 0
    if rank and free - rank >= FEWEST:
        size, *_ = np.linalg.lstsq(shifts / np.max(np.abs(shifts), axis=0), deviation, rcond=None)
        deviation = deviation - shifts / np.max(np.abs(shifts), axis=0) @ size
        free -= rank
    return float(np.sqrt(np.sum(deviation**2) / free))


def _within(readings: Array, numbers: Numbers) -> tuple[Array, int]:
    """Deviations from the mean of each set point, and the number of set points."""
    found, place = np.unique(numbers, return_inverse=True)
    means = np.bincount(place, weights=readings) / np.maximum(np.bincount(place), 1)
    return readings - means[place], len(found)
