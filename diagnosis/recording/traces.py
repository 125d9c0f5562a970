"""Chamber pressure over shaft angle: cycles resampled on one raster and averaged, synchronous with the shaft."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from diagnosis.recording.channel_noise import recorded_channel
from diagnosis.recording.form import TraceForm
from diagnosis.recording.model import RecordedChannel, TraceBlock
from diagnosis.recording.tables.columns import ColumnReader
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
    """Number of the cycle of each row: turns since the first row, at any angle; angles wrap or continue."""
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


@dataclass(frozen=True)
class ReadTraces:
    """Averaged traces, and their two channels (none without traces)."""

    blocks: tuple[TraceBlock, ...] = ()
    channels: tuple[RecordedChannel, ...] = ()


def read_traces(form: TraceForm, reader: ColumnReader, rows: Array | None, count: int) -> ReadTraces:
    """Return the traces of a recording of `count` steady points; faults go to the reader.

    rows: the steady table's own column with the traces' name of a point; without one, points count from 1. A point's
    trace is the mean over its cycles (`traces.synchronous_mean`).
    """
    columns = reader.columns("traces", form.source)
    if columns is None:
        return ReadTraces()
    point = reader.column("traces.point", form.stated.point, columns)
    angle = reader.column("traces.angle.column", form.angle.column, columns)
    pressure = reader.column("traces.p_chamber.column", form.pressure.column, columns)
    cycle = reader.column("traces.cycles", form.stated.cycles, columns) if form.stated.cycles else None
    if point is None or angle is None or pressure is None or (form.stated.cycles and cycle is None):
        return ReadTraces()
    angle, pressure = form.angle.si(angle), form.pressure.si(pressure)
    lost = int(np.sum(~np.isfinite(point)))
    if lost:
        name = form.stated.point
        reader.note(f"traces: {lost} rows without a number in {name!r} belong to no point and are left out")
    rows = np.arange(1.0, count + 1.0) if rows is None else rows
    blocks = []
    for mark in np.unique(point[np.isfinite(point)]):
        place, at = np.flatnonzero(rows == mark), point == mark
        if len(place) != 1:
            reader.fault("traces.point", f"{mark:g}", "the number of one row of the steady table")
            continue
        try:
            turns = None if cycle is None else cycle[at]
            blocks.append(synchronous_mean(int(place[0]), angle[at], pressure[at], turns))
        except TableFault as reason:
            reader.fault("traces", reason.found, reason.expected, reason.nearest)
    return ReadTraces(tuple(blocks), _channels(form, reader, pressure, blocks))


def _channels(
    form: TraceForm, reader: ColumnReader, pressure: Array, blocks: Sequence[TraceBlock]
) -> tuple[RecordedChannel, ...]:
    """Channels of angle and chamber pressure; the latter's repeatability is that of its mean if cycles give it."""
    scatter = [np.sqrt(np.mean(np.sum(f**2, axis=1))) for b in blocks if (f := b.covariance_factor) is not None]
    angle = recorded_channel(replace(form.angle, sigma=form.angle.sigma or 0.0), np.zeros(1), None)
    chamber = recorded_channel(form.pressure, pressure, max(scatter, default=None))
    if chamber is None:
        reader.fault("traces.p_chamber.sigma", "missing, and fewer than 3 cycles", "one sigma of repeatability")
    return tuple(channel for channel in (angle, chamber) if channel is not None)
