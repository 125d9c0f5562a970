"""Round levels of contours: of efficiencies, of other numbers, of differences."""

from __future__ import annotations

import math

import numpy as np

from reynolds.numerics.arrays import Array

LINES = 12
DOWNWARDS = (1, 1, 1, 1, 2, 2, 5, 5, 10, 10, 20)
"""Steps between contours of an efficiency from the best down, in units; the last step repeats."""
UNITS = tuple(digit * 10.0**power for power in (-3, -2, -1, 0) for digit in (1, 2, 5))
"""Units of these steps, percent; the first that needs at most LINES and two contours is used."""


def efficiency_levels(*fields: Array) -> Array:
    """Return round contour levels of efficiencies in percent, dense near the best and sparser below."""
    least, most = _ends(*fields)
    for unit in UNITS:
        levels = _downwards(least / unit, most / unit)
        if len(levels) <= LINES + 2:
            break
    return unit * np.array(levels[::-1], float)


def steps_words(levels: Array) -> str:
    """Return the steps of contours in words, finest and coarsest."""
    steps = np.diff(levels)
    fine, coarse = float(steps[-1]), float(steps.max())
    if math.isclose(fine, coarse):
        return f"{fine:g} percentage points"
    return f"{fine:g} percentage points near the best, up to {coarse:g} far from it"


def _downwards(least: float, most: float) -> list[int]:
    """Return whole numbers from above the largest down to below the least, multiples of growing steps."""
    found = [math.ceil(most)]
    while found[-1] > least or len(found) == 1:
        step = DOWNWARDS[min(len(found), len(DOWNWARDS)) - 1]
        found.append((found[-1] - 1) // step * step)
    return found


def levels_of(*fields: Array) -> Array:
    """Return equidistant round contour levels from below the least of all fields to above their largest."""
    return _even(*_ends(*fields))


def difference_levels(field: Array) -> Array:
    """Return equidistant round contour levels, symmetric about zero."""
    most = max(map(abs, _ends(field)))
    return _even(-most, most)


def _even(least: float, most: float) -> Array:
    from matplotlib.ticker import MaxNLocator

    return np.asarray(MaxNLocator(LINES).tick_values(least, max(most, least + 1e-6)))


def _ends(*fields: Array) -> tuple[float, float]:
    finite = np.concatenate([np.ma.compressed(np.ma.masked_invalid(field)) for field in fields])
    return (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
