"""Stretches of a series: where marks hold or values repeat, and their times as text."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array

Mask = NDArray[np.bool_]
ROUNDING = 1e-12  # of the largest reading: means of equal readings differ by so much
NAMED = 3  # stretches that a text names


def stretches(marks: Mask) -> tuple[slice, ...]:
    """Stretches of marked samples (T,), in order."""
    padded = np.diff(np.concatenate([[0], marks.astype(np.int8), [0]]))
    return tuple(
        slice(int(a), int(b)) for a, b in zip(np.flatnonzero(padded == 1), np.flatnonzero(padded == -1), strict=True)
    )


def equal_runs(values: Array) -> tuple[slice, ...]:
    """Stretches (T,) or of rows (T, C) in which every reading repeats the one before; without gaps."""
    columns = values.reshape(len(values), -1)
    known = np.where(np.isfinite(columns), np.abs(columns), 0.0)
    same = np.all(np.abs(np.diff(columns, axis=0)) <= ROUNDING * known.max(axis=0), axis=1)
    borders = np.concatenate([[0], np.flatnonzero(~same) + 1, [len(columns)]])
    read = np.all(np.isfinite(columns), axis=1)
    return tuple(slice(int(a), int(b)) for a, b in pairwise(borders) if read[a])


def bridged(values: Array, marks: Mask) -> Array:
    """Values (T,) with lines across the gaps that are marked (T,); gaps at either end stay."""
    known, place = np.isfinite(values), np.arange(len(values))
    if not known.any():
        return values
    first, last = place[known][[0, -1]]
    gaps = marks & ~known & (place > first) & (place < last)
    return np.where(gaps, np.interp(place, place[known], values[known]), values)


def times(time: Array, found: Sequence[slice]) -> str:
    """Stretches by their times in s as text: of many the longest, with the number and length of all."""
    longest = sorted(sorted(found, key=lambda s: s.start - s.stop)[:NAMED], key=lambda s: s.start)
    listed = ", ".join(f"from {time[s.start]:g} s to {time[s.stop - 1]:g} s" for s in longest)
    if len(found) <= NAMED:
        return listed
    step = float(np.median(np.diff(time)))
    whole = sum(s.stop - s.start for s in found) * step
    return f"{listed} and {len(found) - NAMED} times more, {whole:g} s in all"
