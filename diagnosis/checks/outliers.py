"""Outliers: single readings far from those of their neighbours on the map, as slips or as suspects."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations_with_replacement

import numpy as np
from numpy.typing import NDArray

from diagnosis.recording.line_pressures import LINES, varied_lines
from diagnosis.recording.model import DataNote, NoteKind, Recording, reading_sigma
from diagnosis.thresholds import DataLimits
from reynolds.numerics.arrays import Array
from system.inputs.channels import OUTPUTS, ChannelName

ROUNDS = 12
NEIGHBOURS = 6
NORMAL = 1.4826  # standard deviation of a normal distribution per median magnitude
LEAST_WARMING = 3.0  # K: less is the accuracy of a temperature's control
ORDER = 3  # points at the beginning and at the end of the recording: warming, cooling
MOST_ENDS = 0.5  # of all points: an axis with more at its ends has no middle
_AXES = (ChannelName.SPEED, ChannelName.P_OUT, ChannelName.DISPLACEMENT_RATIO, ChannelName.T_CASE)

Marks = NDArray[np.bool_]


@dataclass(frozen=True)
class _Scores:
    """One channel's deviations (N,) in robust standard deviations, 0 where unknown, and readings that are lone."""

    deviation: Array
    lone: tuple[int, ...]


def outliers(recording: Recording, limits: DataLimits) -> Iterator[DataNote]:
    """Yield notes on single readings of outputs that deviate from a smooth map by more than `outlier` deviations.

    The map is a polynomial in the inputs that vary, fitted by least absolute deviations, of the highest degree up to
    three that leaves a third of the points free; the deviation is that of a point left out of the fit. A deviation of
    one channel inside the map is a slip (REMOVED). Where other channels deviate too, or at an end of an axis or of the
    recording, it may be physics or a state of the bench: it is a suspect and stays (SUSPECT). No note is given for
    points without near neighbours, for groups of neighbours (an effect), and for deviations within `outlier` sigma of
    repeatability.
    """
    axes, places = _varied(recording), scaled_places(recording)
    shapes = _shapes(axes)
    if shapes is None:
        return
    rims = _rims(recording, axes, limits)
    found = {name: _scores(recording, name, shapes, places, limits) for name in OUTPUTS}
    for name, own in found.items():
        if len(own.lone) > max(1.0, limits.outlier_share * np.count_nonzero(own.deviation)):
            continue
        for point in own.lone:
            why = [*_partners(found, name, point, limits), *_ends(rims, point)]
            text = f"off its neighbours by {abs(own.deviation[point]):.0f} deviations"
            kind = NoteKind.SUSPECT if why else NoteKind.REMOVED
            yield DataNote(kind, name, (point,), f"{text}, {', '.join(why)}: kept" if why else text)


def scaled_places(recording: Recording) -> Array:
    """(N, d), the inputs that vary, each scaled to -1 .. 1; nan where one is missing."""
    axes = _varied(recording)
    return _scaled(axes) if axes else np.zeros((len(recording.steady.values), 0))


def is_alone(point: int, score: Array, places: Array) -> bool:
    """True if none of the nearest points deviates by a third as much: a step of the map would move them all."""
    distance = np.sum((places - places[point]) ** 2, axis=1)
    distance[point] = -1.0  # first of all, also among readings at the same place
    nearest = np.argsort(distance, kind="stable")[1 : NEIGHBOURS + 1]
    return bool(np.all(np.abs(score[nearest]) < abs(score[point]) / 3.0))


def _varied(recording: Recording) -> Mapping[ChannelName, Array]:
    """The inputs that vary, (N,) each in SI: axes of the map, and pressures of the lines where they are set."""
    columns = {name: recording.steady.column(name) for name in (*_AXES, *varied_lines(recording))}
    known = {name: column[np.isfinite(column)] for name, column in columns.items()}
    return {
        name: columns[name]
        for name, own in known.items()
        if name in LINES or (own.size and np.std(own) > 1e-3 * np.max(np.abs(own)))
    }


def _scaled(axes: Mapping[ChannelName, Array]) -> Array:
    """(N, d), each of one or more axes scaled to -1 .. 1."""
    return np.stack([(c - np.nanmin(c)) / (np.nanmax(c) - np.nanmin(c)) * 2.0 - 1.0 for c in axes.values()], axis=1)


def _shapes(axes: Mapping[ChannelName, Array]) -> Array | None:
    """Shapes (N, k) over the map; None where points are too few, or no input varies.

    Polynomials of the axes, and squares of the lines' pressures by themselves: products with them would leave few
    points free.
    """
    if not axes:
        return None
    places, lines = _scaled(axes), np.array([name in LINES for name in axes])
    own, beside = places[:, ~lines], places[:, lines]
    count = len(places)
    for degree in (3, 2, 1):
        powers = [p for d in range(1, degree + 1) for p in combinations_with_replacement(range(own.shape[1]), d)]
        terms = [*(np.prod(own[:, list(power)], axis=1) for power in powers), *beside.T, *(beside.T**2)]
        if 1.5 * (1 + len(terms)) <= count:
            return np.stack([np.ones(count), *terms], axis=1)
    return None


def _scores(recording: Recording, name: ChannelName, shapes: Array, places: Array, limits: DataLimits) -> _Scores:
    channel, values = recording.channel(name), recording.steady.column(name)
    known = np.isfinite(values) & np.all(np.isfinite(shapes), axis=1)
    deviation = np.zeros(len(values))
    if channel is None or known.sum() < 1.5 * shapes.shape[1]:
        return _Scores(deviation, ())
    apart, leverage = _left_out(shapes[known], values[known])
    scale = np.maximum(NORMAL * np.median(np.abs(apart)), reading_sigma(channel, values[known]))
    deviation[known] = apart / scale
    far = np.flatnonzero((np.abs(apart / scale) > limits.outlier) & (leverage < limits.leverage))
    lone = [k for k in far if is_alone(int(k), apart / scale, places[known])]
    return _Scores(deviation, tuple(int(point) for point in np.flatnonzero(known)[lone]))


def _partners(found: Mapping[ChannelName, _Scores], name: ChannelName, point: int, limits: DataLimits) -> Iterator[str]:
    """Other channels that deviate at the point."""
    others = [one for one in found if one is not name and abs(found[one].deviation[point]) > limits.together]
    if others:
        yield f"with {' and '.join(one.value for one in others)}"


def _ends(rims: Mapping[str, Marks], point: int) -> Iterator[str]:
    """The ends at which the point lies."""
    at = [name for name, ends in rims.items() if ends[point]]
    if at:
        yield f"at an end of {' and '.join(at)}"


def _rims(recording: Recording, axes: Mapping[ChannelName, Array], limits: DataLimits) -> Mapping[str, Marks]:
    """Points (N,) at an end of each axis and of the recording, by name; none for an axis of two levels."""
    warmth = {name: recording.steady.column(name) for name in (ChannelName.T_IN, ChannelName.T_CASE)}
    order = np.arange(len(recording.steady.values))
    rims = {"the recording": (order < ORDER) | (order >= order.size - ORDER)}
    for name, values in {**axes, **warmth}.items():
        span = np.ptp(values[np.isfinite(values)]) if np.isfinite(values).any() else 0.0
        if span <= (LEAST_WARMING if name in warmth else 0.0):
            continue
        ends = (values < np.nanmin(values) + limits.rim * span) | (values > np.nanmax(values) - limits.rim * span)
        if np.count_nonzero(ends) <= MOST_ENDS * values.size:
            rims[name.value] = ends
    return rims


def _left_out(shapes: Array, values: Array) -> tuple[Array, Array]:
    """Deviation of each value from the fit without it, and its leverage; least absolute values by reweighting."""
    weights = np.ones(len(values))
    residual, leverage = values, weights
    for _ in range(ROUNDS):
        root = np.sqrt(weights)
        q, _ = np.linalg.qr(root[:, None] * shapes)
        residual = values - q @ (q.T @ (root * values)) / root
        leverage = np.sum(q**2, axis=1)
        spread = max(NORMAL * float(np.median(np.abs(residual))), 1e-12 * float(np.max(np.abs(values))), 1e-300)
        weights = 1.0 / np.maximum(np.abs(residual) / spread, 1.0)
    return residual / np.maximum(1.0 - leverage, 0.1), leverage
