"""Impossible readings: beyond the range of any pump or sensor, or a code for no reading."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from diagnosis.checks.units import HIGHEST, LIKELY
from diagnosis.recording.model import DataNote, NoteKind, RecordedChannel, Recording, reading_sigma
from reynolds.numerics.arrays import Array
from system.inputs.channels import OUTPUTS, ChannelName
from system.inputs.units import STANDARD_ATMOSPHERE, Dimension, unit_scale

MOST = 0.5  # of a channel's readings: more of them are a fault of its unit
VACUUM = -1.02 * STANDARD_ATMOSPHERE  # Pa gauge, with the error of a sensor
CODE = re.compile(r"-?(9{3,}(\.9+)?|9{2,}\.9+)")
NO_SIGNAL = 10.0  # sigma that all other readings are away from 0 at least
IDLE = 0.05  # displacement ratio below which a flow may be 0
Marks = NDArray[np.bool_]


def impossible(recording: Recording) -> Iterator[DataNote]:
    """Yield readings that are put aside one by one, less than half of a channel's.

    Beyond the range of a bench (speed zero or reversed, vacuum, `LIKELY`); nines far from all other readings, a
    logger's code for no reading; an output at exactly 0, from which all others are NO_SIGNAL sigma away.
    """
    for channel in recording.channels:
        if channel.name in (ChannelName.ANGLE, ChannelName.P_CHAMBER) or channel.name.dimension is None:
            continue
        values = recording.steady.column(channel.name)
        beyond = _beyond(channel, values)
        for bad, why in (
            (beyond, "beyond the range of a bench"),
            (_nines(channel, values) & ~beyond, "nines far from all other readings: a code for no reading"),
            (_silent(recording, channel, values), "far from all other readings: no signal"),
        ):
            if 0 < bad.sum() < MOST * np.isfinite(values).sum():
                points = tuple(int(point) for point in np.flatnonzero(bad))
                text = f"reads {_shown(channel, values[bad])}, {why}"
                yield DataNote(NoteKind.REMOVED, channel.name, points, text)


def _beyond(channel: RecordedChannel, values: Array) -> Marks:
    dimension = channel.name.dimension
    assert dimension is not None
    sized = values if dimension in (Dimension.TEMPERATURE, Dimension.PRESSURE) else np.abs(values)
    if channel.name is ChannelName.SPEED:
        sized = values * np.sign(np.nanmedian(values)) if np.isfinite(values).any() else values
    low, high = (VACUUM, HIGHEST) if dimension is Dimension.PRESSURE else LIKELY.get(dimension, (0.0, np.inf))
    return np.isfinite(values) & ~((sized >= low) & (sized <= high))


def _nines(channel: RecordedChannel, values: Array) -> Marks:
    """Readings that are nines in the file's unit, farther from all others than these are from each other."""
    dimension = channel.name.dimension
    assert dimension is not None
    factor, offset = unit_scale(channel.unit, dimension)
    shifts = (offset, offset - STANDARD_ATMOSPHERE) if dimension is Dimension.PRESSURE else (offset,)
    known = np.isfinite(values)
    found = np.zeros(len(values), dtype=bool)
    for shift in shifts:
        numbers = (values[known] - shift) / factor
        found[known] |= np.array([CODE.fullmatch(f"{number:.6g}") is not None for number in numbers], dtype=bool)
    others = values[known & ~found]
    if not found.any() or not len(others):
        return np.zeros(len(values), dtype=bool)
    breadth = np.ptp(others)
    return found & ((values > others.max() + breadth) | (values < others.min() - breadth))


def _silent(recording: Recording, channel: RecordedChannel, values: Array) -> Marks:
    """Outputs of exactly 0 without others near it, the displacement not being 0."""
    ratio = recording.steady.column(ChannelName.DISPLACEMENT_RATIO)
    zero = (values == 0.0) & ~(np.abs(ratio) < IDLE)
    others = values[np.isfinite(values) & (values != 0.0)]
    if channel.name not in OUTPUTS or not len(others):
        return np.zeros(len(values), dtype=bool)
    near = np.min(np.abs(others) - NO_SIGNAL * reading_sigma(channel, others)) <= 0.0
    return np.zeros(len(values), dtype=bool) if near else zero


def _shown(channel: RecordedChannel, values: Array) -> str:
    dimension = channel.name.dimension
    assert dimension is not None
    factor, offset = unit_scale(channel.unit, dimension)
    numbers = (values - (offset if dimension is Dimension.TEMPERATURE else 0.0)) / factor
    ends = sorted({f"{numbers.min():.6g}", f"{numbers.max():.6g}"}, key=float)
    gauge = " gauge" if dimension is Dimension.PRESSURE else ""
    return f"{' to '.join(ends)} {channel.unit}{gauge}"
