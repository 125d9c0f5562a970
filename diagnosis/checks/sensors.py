"""Sensors that do not measure: stuck readings, copies of another channel, rows written twice, no noise."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from diagnosis.recording.channel_noise import STILL
from diagnosis.recording.model import DataNote, NoteKind, RecordedChannel, Recording, reading_sigma
from reynolds.numerics.arrays import Array
from system.inputs.channels import INPUTS, OUTPUTS, ChannelName

LEAST_RUN = 5  # equal readings from which a sensor may be stuck
MOVED = 0.05  # share of its largest value by which an input moves
ALIVE = 3.0  # steps by which a channel changes from point to point at half of the points
SAME = 0.05  # of one sigma: two channels that agree to this are one
SCATTER = 1e-3  # of a channel's own spread, beyond which it has noise of its own however large its sigma is stated
BY_CHANCE = 1e-3  # of a noisy input with equal consecutive readings
FLOWS = (ChannelName.Q_OUT, ChannelName.Q_IN, ChannelName.Q_CASE)  # of the pump's balance
TELLING = 4  # channels that do not repeat themselves together


def low_resolution(recording: Recording) -> Iterator[DataNote]:
    """Yield the fault of channels that by their repeatability are only noise at half of the points."""
    for name in (ChannelName.SPEED, ChannelName.P_OUT, *OUTPUTS):
        channel, values = recording.channel(name), recording.steady.column(name)
        known = values[np.isfinite(values)]
        if channel is None or not len(known):
            continue
        middle = float(np.median(np.abs(known)))
        if (noise := float(np.median(reading_sigma(channel, known)))) > middle > 0.0:
            text = (
                f"{name.value} has a repeatability of {noise / middle:.3g} times what it reads at half of the "
                "points: sigma is one standard deviation in the channel's unit, sigma_relative a share (0.01: 1 %)"
            )
            yield DataNote(NoteKind.FAULT, name, (), text)


def stuck(recording: Recording) -> Iterator[DataNote]:
    """Yield outputs with equal readings at `LEAST_RUN` or more consecutive points while speed or pressure changed.

    Only of a channel that elsewhere changes by more than `ALIVE` of its steps from point to point; one that never
    changes is a fault.
    """
    moving = [recording.steady.column(name) for name in (ChannelName.SPEED, ChannelName.P_OUT)]
    for name in OUTPUTS:
        channel, values = recording.channel(name), recording.steady.column(name)
        if channel is not None and _dead(values) and any(_moved(column, column) for column in moving):
            text = f"{name.value} is stuck: the same reading at every point while inputs change"
            yield DataNote(NoteKind.FAULT, name, (), text + "; leave it out of [channel]")
        changes = np.abs(np.diff(values))
        known = changes[np.isfinite(changes) & (changes > 0.0)]
        if channel is None or not len(known) or np.median(known) <= ALIVE * channel.quantum:
            continue
        for start, stop in _runs(values):
            if stop - start >= LEAST_RUN and any(_moved(column[start:stop], column) for column in moving):
                points = tuple(range(start, stop))
                text = f"{name.value} is stuck at points {start + 1} to {stop}: one reading while inputs change"
                yield DataNote(NoteKind.REMOVED, name, points, text)


def stuck_inputs(recording: Recording) -> Iterator[DataNote]:
    """Yield inputs with longer runs of equal readings than noise allows, and those that never change.

    Steps from point to point are 0 elsewhere with a share p, or q/(2 sqrt(pi) sigma) by step and noise: a run of m
    among N points occurs by chance N p^(m-1) times. An input with equal readings at most points is set, not measured.
    """
    for name in INPUTS:
        channel, values = recording.channel(name), recording.steady.column(name)
        known = values[np.isfinite(values)]
        if channel is None or len(known) < 2 * LEAST_RUN or channel.sigma <= 0.0:
            continue
        if np.ptp(known) == 0.0:
            text = f"{name.value} reads the same at every point: set rather than measured?"
            yield DataNote(NoteKind.NOTED, name, (), text)
            continue
        runs = [(start, stop) for start, stop in _runs(values) if stop - start >= LEAST_RUN]
        held = sum(stop - start for start, stop in runs)
        if 2 * held > len(known):
            continue
        still = int(np.sum(np.diff(values) == 0.0)) - sum(stop - start - 1 for start, stop in runs)
        alike = max(still, 1) / (len(known) - held)
        alike = max(alike, channel.quantum / (2.0 * np.sqrt(np.pi) * channel.sigma))
        for start, stop in runs:
            if len(known) * alike ** (stop - start - 1) < BY_CHANCE:
                text = f"{name.value} is stuck at points {start + 1} to {stop}: the same reading without noise"
                yield DataNote(NoteKind.REMOVED, name, tuple(range(start, stop)), text)


def repeated_rows(recording: Recording) -> Iterator[DataNote]:
    """Yield points that equal others to the last digit in every channel: a fault from `LEAST_RUN` of them on."""
    values = recording.steady.values
    if int(np.any(np.isfinite(values), axis=0).sum()) < TELLING:
        return
    _, first = np.unique(np.nan_to_num(values, nan=-1e300), axis=0, return_index=True)
    read = np.flatnonzero(np.any(np.isfinite(values), axis=1))
    points = tuple(int(point) for point in sorted(set(read.tolist()) - set(first.tolist())))
    if points:
        kind = NoteKind.FAULT if len(points) >= LEAST_RUN else NoteKind.NOTED
        text = "the same as earlier points in every channel: written twice? Leave them out"
        yield DataNote(kind, None, points, text)


def copies(recording: Recording) -> Iterator[DataNote]:
    """Yield a fault for each pair of channels of which one is the other, shifted or scaled, to within its step.

    Of the three flows of the balance also where one is computed from the two others.
    """
    measured = [channel for channel in recording.channels if channel.name in (*INPUTS, *OUTPUTS)]
    found = False
    for one, other in combinations(measured, 2):
        if one.name.dimension is other.name.dimension and _is_computed(recording, other, (one,)):
            found = True
            text = f"{other.name.value} follows {one.name.value} without noise of its own: computed, not measured"
            yield DataNote(NoteKind.FAULT, other.name, (), text + "; leave it out of [channel]")
    flows = [channel for channel in map(recording.channel, FLOWS) if channel is not None]
    if len(flows) == len(FLOWS) and not found:
        *two, last = flows
        if _is_computed(recording, last, two):
            text = f"{', '.join(name.value for name in FLOWS)} depend on each other without noise: one is computed"
            yield DataNote(NoteKind.FAULT, last.name, (), text + "; leave it out of [channel]")


def noiseless(recording: Recording) -> Iterator[DataNote]:
    """Yield a fault for each output that states no noise, or whose repeats agree beyond its stated repeatability.

    The latter at 5 or more degrees of freedom, with a scatter under a hundredth of sigma: simulated or copied. Readings
    of a display whose step exceeds sigma repeat themselves.
    """
    numbers = recording.steady.repeats
    for name in OUTPUTS:
        channel, values = recording.channel(name), recording.steady.column(name)
        known = np.isfinite(values)
        if channel is None or not known.any():
            continue
        if not np.any(reading_sigma(channel, values[known]) > 0.0):
            states = "repeats itself with" if "sigma" in channel.assumed else "states"
            text = f"{name.value} {states} a repeatability of 0, which no sensor has"
            yield DataNote(NoteKind.FAULT, name, (), text + "; state its sigma, of a coarse display its quantum")
            continue
        _, place = np.unique(numbers[known], return_inverse=True)
        count = np.bincount(place)
        free = int(known.sum() - len(count))
        if free < LEAST_RUN:
            continue
        deviation = values[known] - (np.bincount(place, weights=values[known]) / count)[place]
        sigma = float(np.mean(reading_sigma(channel, values[known])))
        if np.sqrt(np.sum(deviation**2) / free) < STILL * sigma and channel.quantum <= sigma:
            text = f"{name.value} repeats itself without noise at {free} repeated points: is it measured?"
            yield DataNote(NoteKind.FAULT, name, (), text)


def _dead(values: Array) -> bool:
    """True where a channel has `LEAST_RUN` readings at least, all of them equal."""
    known = values[np.isfinite(values)]
    return len(known) >= LEAST_RUN and float(np.ptp(known)) == 0.0


def _runs(values: Array) -> Iterator[tuple[int, int]]:
    """Begin and end of stretches of equal values."""
    borders = np.flatnonzero(np.diff(values) != 0.0) + 1  # nan differs from all values
    yield from zip([0, *borders], [*borders, len(values)], strict=True)


def _moved(part: Array, whole: Array) -> bool:
    """True if an input changed within a part by more than `MOVED` of its largest value."""
    if not np.isfinite(part).any():
        return False
    return bool(np.nanmax(part) - np.nanmin(part) > MOVED * np.nanmax(np.abs(whole)))


def _is_computed(recording: Recording, other: RecordedChannel, sources: Sequence[RecordedChannel]) -> bool:
    """True where a linear law of the sources gives `other` to within its step, theirs, or `SAME` of its sigma."""
    x = np.stack([recording.steady.column(one.name) for one in sources], axis=1)
    y = recording.steady.column(other.name)
    known = np.all(np.isfinite(x), axis=1) & np.isfinite(y)
    x, y = x[known], y[known]
    if len(y) < 2 * LEAST_RUN or min(len(np.unique(column)) for column in (*x.T, y)) < LEAST_RUN:
        return False
    shape = np.column_stack([np.ones(len(y)), (x - np.mean(x, axis=0)) / np.std(x, axis=0)])
    size, *_ = np.linalg.lstsq(shape, y, rcond=None)
    scatter = float(np.std(y - shape @ size))
    theirs = np.abs(size[1:]) / np.std(x, axis=0) * [one.quantum for one in sources]
    own = min(SAME * float(np.mean(reading_sigma(other, y))), SCATTER * float(np.std(y)))
    return scatter <= max(other.quantum, float(np.max(theirs)), own)
