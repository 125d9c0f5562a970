"""Traces over shaft angle out of their table: cycles averaged, and the channels of angle and chamber pressure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from diagnosis.recording.channel_noise import recorded_channel
from diagnosis.recording.columns import ColumnReader
from diagnosis.recording.form import TraceForm
from diagnosis.recording.model import RecordedChannel, TraceBlock
from diagnosis.recording.tables.table import TableFault
from diagnosis.recording.traces import synchronous_mean
from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class ReadTraces:
    """Averaged traces, and their two channels (none where there are no traces)."""

    blocks: tuple[TraceBlock, ...] = ()
    channels: tuple[RecordedChannel, ...] = ()


def read_traces(form: TraceForm, reader: ColumnReader, rows: Array | None, count: int) -> ReadTraces:
    """Return the traces of a recording of `count` steady points; faults go to the reader.

    rows: the steady table's own column of the name that the traces call a point by; without one, points count
    from 1. A point's trace is the mean over its cycles (`traces.synchronous_mean`).
    """
    columns = reader.columns("traces", form.source)
    if columns is None:
        return ReadTraces()
    point = reader.column("traces.point", form.point, columns)
    angle = reader.column("traces.angle.column", form.angle.column, columns)
    pressure = reader.column("traces.p_chamber.column", form.pressure.column, columns)
    cycle = reader.column("traces.cycles", form.cycles, columns) if form.cycles else None
    if point is None or angle is None or pressure is None or (form.cycles and cycle is None):
        return ReadTraces()
    angle, pressure = form.angle.si(angle), form.pressure.si(pressure)
    lost = int(np.sum(~np.isfinite(point)))
    if lost:
        reader.note(f"traces: {lost} rows without a number in {form.point!r} belong to no point and are left out")
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
    """Channels of angle and chamber pressure; the latter's repeatability is its mean's where cycles tell it."""
    scatter = [np.sqrt(np.mean(np.sum(f**2, axis=1))) for b in blocks if (f := b.covariance_factor) is not None]
    angle = recorded_channel(replace(form.angle, sigma=form.angle.sigma or 0.0), np.zeros(1), None)
    chamber = recorded_channel(form.pressure, pressure, max(scatter, default=None))
    if chamber is None:
        reader.fault(
            "traces.p_chamber.sigma", "no such key, and fewer than 3 cycles", "one sigma of repeatability"
        )
    return tuple(channel for channel in (angle, chamber) if channel is not None)
