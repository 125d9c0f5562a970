"""The next point to record: where two explanations part the most.

What a reading there would tell is the divergence of the two predictive distributions (Kullback and Leibler 1951;
Box and Hill 1967): each explanation foretells a Gaussian, as wide as the noise and its own parameters make it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from diagnosis.bench_box import rig_box, rows
from diagnosis.study import MovableSimulator, Study
from system.bench_points import BenchPoints, operating_at
from system.description import PumpDescription
from system.estimation.observations import Array, Observations
from system.estimation.posterior import Posterior, standard_slopes
from system.estimation.whitening import Whitening, whitener
from system.operating import OperatingPoint
from system.physics.effects import EffectId
from system.units import Dimension, format_quantity

ENOUGH = 5.0  # nats: odds of 150 to 1, that readings at the point are to bring
MOST_REPEATS = 20
LOOKED_AT = 48  # points whose slopes are asked for: those where the predictions part the most
LEVELS = (6, 6, 3, 3)  # of speed, delivery pressure, displacement ratio, case temperature over the box
LEAST_GAIN = 0.05  # nats, below which a point separates nothing


@dataclass(frozen=True)
class Gained:
    """A point and the gain of one reading there in nats; temperatures as of a `NextPoint`."""

    point: OperatingPoint
    inlet_temperature: float
    gain: float


@dataclass(frozen=True)
class NextPoint:
    """A point, the ids it separates, the gain of one reading in nats, repeats to be sure, and why in words.

    point.temperature is that of the case; inlet_temperature, in K, what it goes with in the recording. ranked: all
    points whose gain was asked for, this one first.
    """

    point: OperatingPoint
    inlet_temperature: float
    separates: tuple[EffectId, ...]
    gain: float
    repeats: int
    why: str
    ranked: tuple[Gained, ...] = ()


@dataclass(frozen=True)
class Contender:
    """One explanation as refitted: its ids, the simulator with its laws on, and its posterior."""

    effects: tuple[EffectId, ...]
    simulator: MovableSimulator
    posterior: Posterior


@dataclass(frozen=True)
class _Forecast:
    """What two explanations foretell of the readings at one point, whitened: difference and parameter spreads."""

    difference: Array
    first: Array
    second: Array

    def gain(self, repeats: int = 1) -> float:
        """Nats that `repeats` readings bring at least, whichever of the two is true."""
        noise = np.eye(self.difference.size) / repeats
        one, two = noise + self.first, noise + self.second
        return min(divergence(self.difference, one, two), divergence(self.difference, two, one))


def next_point(study: Study, pump: PumpDescription, first: Contender, second: Contender) -> NextPoint | None:
    """The point of the rig's box at which one reading separates two explanations best, and how often to take it.

    The box is that of the recording and a tenth of its range beyond, within the pump's rating. None where no point
    of it would bring more than 0.05 nats: the two are one on this rig.
    """
    box = rig_box(study.recording, pump)
    points = box.points(tuple(_levels(*ends, count) for ends, count in zip(box.ends, LEVELS, strict=True)))
    parting = _parting(study, first, second, points)
    best = np.sort(np.argsort(parting)[::-1][:LOOKED_AT])
    some = rows(points, best)
    forecasts = list(_forecasts(study, first, second, some))
    gains = [forecast.gain() for forecast in forecasts]
    at = int(np.argsort(gains)[-1])
    if gains[at] < LEAST_GAIN:
        return None
    repeats = next((n for n in range(1, MOST_REPEATS) if forecasts[at].gain(n) >= ENOUGH), MOST_REPEATS)
    separates = tuple(dict.fromkeys((*first.effects, *second.effects)))
    why = _why(study, first, second, rows(some, np.array([at])))
    ranked = tuple(
        Gained(operating_at(pump, some, place), float(some.T_in[place]), gains[place])
        for place in np.argsort(gains)[::-1]
    )
    return NextPoint(ranked[0].point, ranked[0].inlet_temperature, separates, gains[at], repeats, why, ranked)


def gains_at(study: Study, first: Contender, second: Contender, points: BenchPoints) -> Array:
    """(N,), nats that one reading at each of the points brings at least, whichever of the two is true."""
    return np.array([forecast.gain() for forecast in _forecasts(study, first, second, points)])


def log_density(study: Study, contender: Contender, points: BenchPoints, values: Array) -> float:
    """ln of the joint density of readings (N, C), SI, at new points as an explanation foretells them.

    nan: not read. But for a constant that all explanations share.
    """
    there = contender.simulator.elsewhere(points)
    whitening = whitener(_readings(study, values), there.input_slopes(contender.posterior.values))
    residual = whitening.whiten(values - there.predict(contender.posterior.values))
    spread = _spread(contender, points, whitening)
    covariance = np.eye(residual.size) + spread @ spread.T
    squares = float(residual @ cho_solve(cho_factor(covariance), residual))
    return whitening.log_determinant - 0.5 * (squares + float(np.linalg.slogdet(covariance)[1]))


def divergence(difference: Array, true: Array, other: Array) -> float:
    """Nats by which readings of N(0, true) speak for it against N(difference, other), on average.

    (tr(S2^-1 S1) - m + d^T S2^-1 d + ln det S2 - ln det S1) / 2 (Kullback and Leibler 1951); never negative.
    """
    factor = cho_factor(other)
    trace = float(np.trace(cho_solve(factor, true)))
    distance = float(difference @ cho_solve(factor, difference))
    volume = float(np.linalg.slogdet(other)[1] - np.linalg.slogdet(true)[1])
    return 0.5 * (trace - difference.size + distance + volume)


def _levels(lower: float, upper: float, count: int) -> Array:
    return np.linspace(lower, upper, count) if upper > lower else np.array([lower])


def _readings(study: Study, predictions: Array) -> Observations:
    """Readings at new points that are as predicted, with the noise of the recording's channels."""
    seen, count = study.observations, len(study.channels)
    recorded = [study.recording.channel(name) for name in study.channels]
    sigma = [
        np.full(len(predictions), np.nan) if one is None else one.sigma + one.sigma_relative * np.abs(column)
        for one, column in zip(recorded, predictions.T, strict=True)
    ]
    known = seen.measured[:, :count].any(axis=0) & np.array([one is not None for one in recorded])
    return Observations(
        channels=seen.channels[:count],
        values=np.where(known, predictions, np.nan),
        sigma=np.stack(sigma, axis=1),
        inputs=seen.inputs,
        input_sigma=np.tile(np.median(seen.input_sigma, axis=0), (len(predictions), 1)),
        quantum=seen.quantum[:count],
        blocks=np.arange(len(predictions)),
    )


def _parting(study: Study, first: Contender, second: Contender, points: BenchPoints) -> Array:
    """(N,), sum over the channels of the squared difference of the two predictions, in sigma of a reading."""
    one, other = (_predict(contender, points) for contender in (first, second))
    readings = _readings(study, one)
    squares = np.where(readings.measured, ((one - other) / readings.sigma) ** 2, 0.0)
    return np.asarray(squares.sum(axis=1), dtype=float)


def _predict(contender: Contender, points: BenchPoints) -> Array:
    return contender.simulator.elsewhere(points).predict(contender.posterior.values)


def _forecasts(study: Study, first: Contender, second: Contender, points: BenchPoints) -> Iterator[_Forecast]:
    """What the two foretell at each of the points."""
    one, other = (_predict(contender, points) for contender in (first, second))
    there = first.simulator.elsewhere(points)
    whitening = whitener(_readings(study, one), there.input_slopes(first.posterior.values))
    difference = whitening.whiten(other - one)
    spreads = [_spread(contender, points, whitening) for contender in (first, second)]
    for at in range(len(points.speed)):
        own = whitening.rows[:, 0] == at
        yield _Forecast(difference[own], *(spread[own] @ spread[own].T for spread in spreads))


def _spread(contender: Contender, points: BenchPoints, whitening: Whitening) -> Array:
    """(n, k), factor of the covariance that a contender's parameters give its predictions, whitened."""
    slopes = whitening.whiten(standard_slopes(contender.simulator.elsewhere(points), contender.posterior.xi))
    spread: Array = slopes @ np.linalg.cholesky(contender.posterior.covariance)
    return spread


def _why(study: Study, first: Contender, second: Contender, point: BenchPoints) -> str:
    """In words: the channel in which the two part the most at the point, and by how much."""
    one, other = (_predict(contender, point)[0] for contender in (first, second))
    readings = _readings(study, one[None])
    apart = np.where(readings.measured[0], np.abs(other - one) / readings.sigma[0], 0.0)
    most = int(np.argmax(apart))
    channel = readings.channels[most]
    told = [_told(value[most], channel.dimension) for value in (one, other)]
    ids = [" + ".join(effect.value for effect in contender.effects) or "nothing" for contender in (first, second)]
    return (
        f"there {channel.name} is {told[0]} by {ids[0]} and {told[1]} by {ids[1]}, "
        f"{apart[most]:.1f} sigma of one reading apart"
    )


def _told(value: float, dimension: Dimension | None) -> str:
    return f"{value:.4g}" if dimension is None else format_quantity(float(value), dimension, digits=4)
