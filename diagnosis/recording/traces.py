"""Chamber pressure over shaft angle: cycles resampled on one raster and averaged, synchronous with the shaft."""

from __future__ import annotations

import numpy as np

from diagnosis.recording.model import TraceBlock
from diagnosis.recording.tables.table import TableFault
from reynolds.numerics.arrays import Array
from system.inputs.units import TURN

FEWEST_ROWS = 36  # a turn, below which a trace shows no event of the ports
FEWEST_CYCLES = 3  # from which their scatter is kept
ROUNDING = 1e-9  # turns
WIDEST_GAP = TURN / 12


def synchronous_mean(point: int, angle: Array, pressure: Array, cycle: Array | None) -> TraceBlock:
    """Return the mean over cycles of a trace, on as many even angles as its cycles have rows (median).

    angle: (T,) rad, pressure: (T,) Pa gauge, cycle: (T,) number of the cycle of each row; None: a new one begins
    with each turn since the first row. Each cycle is interpolated linearly, closed over the turn.
    covariance_factor F (K, c): deviations of c cycles over sqrt(c (c - 1)), so that F F^T is the covariance of the
    mean. Raises TableFault for a trace with too few rows a turn or a gap of more than 30 deg.
    """
    known = np.isfinite(angle) & np.isfinite(pressure)
    angle, pressure = angle[known], pressure[known]
    marks = _cycles(angle) if cycle is None else cycle[known]
    parts = [marks == mark for mark in np.unique(marks)]
    whole = [part for part in parts if part.sum() >= FEWEST_ROWS and _widest_gap(angle[part]) <= WIDEST_GAP]
    if not whole:
        raise TableFault(
            f"no whole turn in the trace of point {point + 1} ({len(angle)} rows)",
            f"at least {FEWEST_ROWS} rows a turn and no gap of more than 30 deg, angles in the unit stated",
        )
    rows = int(np.median([part.sum() for part in whole]))
    raster = TURN * np.arange(rows) / rows
    courses = np.array([_resampled(angle[part], pressure[part], raster) for part in whole])
    count = len(courses)
    mean = np.mean(courses, axis=0)
    factor = None
    if count >= FEWEST_CYCLES:
        factor = (courses - mean).T / np.sqrt(count * (count - 1.0))
    return TraceBlock(point, raster, mean, factor, count)


def _cycles(angle: Array) -> Array:
    """Number of the cycle of each row: turns since the first, wherever that is; angles wrap or count on."""
    if not len(angle):
        return angle
    course = np.unwrap(angle)
    turns: Array = np.floor((course - course[0]) / TURN + ROUNDING)
    return turns


def _widest_gap(angle: Array) -> float:
    """Widest gap between angles around the turn, rad."""
    ordered = np.sort(np.mod(angle, TURN))
    return float(np.max(np.diff(np.append(ordered, ordered[0] + TURN))))


def _resampled(angle: Array, pressure: Array, raster: Array) -> Array:
    """A cycle on the raster, linear between its rows; rows at the same angle are averaged."""
    places, back = np.unique(np.mod(angle, TURN), return_inverse=True)
    means = np.bincount(back, weights=pressure) / np.bincount(back)
    return np.interp(raster, places, means, period=TURN)
