"""Sensors that do not measure: stuck readings, copies of another channel, readings without noise."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from diagnosis.recording import DataNote, NoteKind, RecordedChannel, Recording, reading_sigma
from system.channels import INPUTS, OUTPUTS, ChannelName
from system.kinematics import Array

LEAST_RUN = 5  # readings alike from which a sensor may be stuck
MOVED = 0.05  # share of its largest value by which an input moves
ALIVE = 3.0  # steps by which a channel changes from point to point at half of the points
SAME = 0.05  # of one sigma: two channels that agree to this are one


def stuck(recording: Recording) -> Iterator[DataNote]:
    """Yield outputs that read the same at `LEAST_RUN` or more points on end while speed or pressure moved.

    Only of a channel that elsewhere changes by more than `ALIVE` of its steps from point to point.
    """
    moving = [recording.steady.column(name) for name in (ChannelName.SPEED, ChannelName.P_OUT)]
    for name in OUTPUTS:
        channel, values = recording.channel(name), recording.steady.column(name)
        changes = np.abs(np.diff(values))
        known = changes[np.isfinite(changes) & (changes > 0.0)]
        if channel is None or not len(known) or np.median(known) <= ALIVE * channel.quantum:
            continue
        for start, stop in _runs(values):
            if stop - start >= LEAST_RUN and any(_moved(column[start:stop], column) for column in moving):
                points = tuple(range(start, stop))
                text = f"{name.value} is stuck at points {start + 1} to {stop}: one reading while inputs moved"
                yield DataNote(NoteKind.REMOVED, name, points, text)


def copies(recording: Recording) -> Iterator[DataNote]:
    """Yield a fault for each pair of channels of which one is the other, shifted or scaled, to within its step."""
    measured = [channel for channel in recording.channels if channel.name in (*INPUTS, *OUTPUTS)]
    for one, other in combinations(measured, 2):
        if one.name.dimension is other.name.dimension and _is_copy(recording, one, other):
            text = f"{other.name.value} follows {one.name.value} without noise of its own: computed, not measured"
            yield DataNote(NoteKind.FAULT, other.name, (), text + "; leave it out of [channel]")


def noiseless(recording: Recording) -> Iterator[DataNote]:
    """Yield a fault for each output that states no noise, or whose repeats agree beyond its stated repeatability.

    The latter at 5 or more degrees of freedom, with a scatter under a hundredth of sigma: simulated or copied.
    """
    numbers = recording.steady.repeats
    for name in OUTPUTS:
        channel, values = recording.channel(name), recording.steady.column(name)
        known = np.isfinite(values)
        if channel is None or not known.any():
            continue
        if not np.any(reading_sigma(channel, values[known]) > 0.0):
            yield DataNote(
                NoteKind.FAULT, name, (), f"{name.value} states a repeatability of 0, which no sensor has"
            )
            continue
        _, place = np.unique(numbers[known], return_inverse=True)
        count = np.bincount(place)
        free = int(known.sum() - len(count))
        if free < LEAST_RUN:
            continue
        deviation = values[known] - (np.bincount(place, weights=values[known]) / count)[place]
        sigma = float(np.mean(reading_sigma(channel, values[known])))
        if np.sqrt(np.sum(deviation**2) / free) < 0.01 * sigma:
            text = f"{name.value} repeats itself without noise at {free} repeated points: is it measured?"
            yield DataNote(NoteKind.FAULT, name, (), text)


def _runs(values: Array) -> Iterator[tuple[int, int]]:
    """From and to of stretches of equal values."""
    borders = np.flatnonzero(np.diff(values) != 0.0) + 1  # nan differs from everything
    yield from zip([0, *borders], [*borders, len(values)], strict=True)


def _moved(part: Array, whole: Array) -> bool:
    """True where an input changed within a part by more than `MOVED` of its largest value."""
    if not np.isfinite(part).any():
        return False
    return bool(np.nanmax(part) - np.nanmin(part) > MOVED * np.nanmax(np.abs(whole)))


def _is_copy(recording: Recording, one: RecordedChannel, other: RecordedChannel) -> bool:
    """True where a straight line through `one` gives `other` to within its step, or `SAME` of its sigma."""
    x, y = recording.steady.column(one.name), recording.steady.column(other.name)
    known = np.isfinite(x) & np.isfinite(y)
    if known.sum() < 2 * LEAST_RUN:
        return False
    x, y = x[known], y[known]
    if len(np.unique(x)) < LEAST_RUN or len(np.unique(y)) < LEAST_RUN:
        return False
    shape = np.stack([np.ones_like(x), (x - np.mean(x)) / np.std(x)], axis=1)
    size, *_ = np.linalg.lstsq(shape, y, rcond=None)
    scatter = float(np.std(y - shape @ size))
    steps = max(other.quantum, abs(size[1]) / float(np.std(x)) * one.quantum)
    return scatter <= max(steps, SAME * float(np.mean(reading_sigma(other, y))))
