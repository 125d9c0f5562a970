"""Outliers: single readings far from those of their neighbours on the map."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations_with_replacement

import numpy as np

from diagnosis.recording.model import DataNote, NoteKind, Recording, reading_sigma
from diagnosis.thresholds import DataLimits
from reynolds.numerics.arrays import Array
from system.inputs.channels import OUTPUTS, ChannelName

ROUNDS = 12
NEIGHBOURS = 6
NORMAL = 1.4826  # standard deviation of a normal distribution per median magnitude
_AXES = (ChannelName.SPEED, ChannelName.P_OUT, ChannelName.DISPLACEMENT_RATIO, ChannelName.T_CASE)


def outliers(recording: Recording, limits: DataLimits) -> Iterator[DataNote]:
    """Yield single readings of outputs that deviate from a smooth map by more than `outlier` robust deviations.

    The map is a polynomial in speed, pressure, displacement ratio and temperature, fitted by least absolute
    deviations, of the highest degree up to three that leaves a third of the points free; the deviation is that of
    a point left out of the fit. Points at the rim, which no neighbour vouches for, are kept; so are groups of
    neighbours (an effect, not a slip) and whatever is within `outlier` sigma of repeatability.
    """
    shapes, places = _shapes(recording)
    if shapes is None:
        return
    for name in OUTPUTS:
        channel, values = recording.channel(name), recording.steady.column(name)
        known = np.isfinite(values) & np.all(np.isfinite(shapes), axis=1)
        if channel is None or known.sum() < 1.5 * shapes.shape[1]:
            continue
        points = np.flatnonzero(known)
        deviation, leverage = _left_out(shapes[known], values[known])
        scale = np.maximum(NORMAL * np.median(np.abs(deviation)), reading_sigma(channel, values[known]))
        score = deviation / scale
        far = (np.abs(score) > limits.outlier) & (leverage < limits.leverage)
        lone = [k for k in np.flatnonzero(far) if _alone(k, score, places[known])]
        if lone and len(lone) <= max(1.0, limits.outlier_share * len(points)):
            for k in lone:
                off = f"off its neighbours by {abs(score[k]):.0f} deviations"
                text = f"{name.value} at point {points[k] + 1} is {off}"
                yield DataNote(NoteKind.REMOVED, name, (int(points[k]),), text)


def _shapes(recording: Recording) -> tuple[Array | None, Array]:
    """Polynomials of the inputs that vary (N, k), None where points are too few, and the scaled inputs (N, d)."""
    columns = [recording.steady.column(name) for name in _AXES]
    varied = [c for c in columns if np.isfinite(c).any() and np.nanstd(c) > 1e-3 * np.nanmax(np.abs(c))]
    if not varied:
        return None, np.empty((0, 0))
    places = np.stack([(c - np.nanmin(c)) / (np.nanmax(c) - np.nanmin(c)) * 2.0 - 1.0 for c in varied], axis=1)
    count = len(places)
    for degree in (3, 2, 1):
        powers = [p for d in range(1, degree + 1) for p in combinations_with_replacement(range(len(varied)), d)]
        if 1.5 * (1 + len(powers)) <= count:
            terms = [np.prod(places[:, list(power)], axis=1) for power in powers]
            return np.stack([np.ones(count), *terms], axis=1), places
    return None, places


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


def _alone(point: np.int64, score: Array, places: Array) -> bool:
    """True if none of the nearest points deviates by a third as much: a step of the map moves them all."""
    distance = np.sum((places - places[point]) ** 2, axis=1)
    nearest = np.argsort(distance)[1 : NEIGHBOURS + 1]
    return bool(np.all(np.abs(score[nearest]) < abs(score[point]) / 3.0))
