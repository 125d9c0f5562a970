"""Forecasts of two explanations for readings at new points, and the odds after such readings.

Each forecast is a Gaussian with the covariance of the noise and of its own parameters: a difference that parameters can
follow has no weight for any number of readings.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve, toeplitz
from scipy.special import ndtr

from diagnosis.recording.model import RecordedChannel, reading_sigma
from diagnosis.study.model import PumpSimulator, Study
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.bench.simulator import LumpedBench
from system.effects.effect import EffectId
from system.estimation.observations import Channel, Observations
from system.estimation.posterior import Posterior, standard_slopes
from system.estimation.whitening import autocorrelation, whitener


@dataclass(frozen=True)
class Contender:
    """A refitted explanation: its ids, the simulator with its laws on, and its posterior.

    text: with places; probability: before new readings.
    """

    effects: tuple[EffectId, ...]
    simulator: PumpSimulator
    posterior: Posterior
    text: str
    probability: float


@dataclass(frozen=True)
class OddsForecast:
    """Gain in ln odds of the true explanation by readings: mean and one sigma, nats, (...)."""

    mean: Array
    sigma: Array

    def chance(self, wanted: Array | float) -> Array:
        """Probability of `wanted` nats at least."""
        found: Array = ndtr((self.mean - wanted) / np.maximum(self.sigma, 1e-12))
        return found


@dataclass(frozen=True)
class Forecast:
    """Forecasts of two explanations at points, whitened: difference (..., m), covariances by parameters (..., m, m).

    One explanation's parameters are as uncertain as the other's where `first` and `second` are the same: then the gain
    is half the squared distance of the two, |d|^2 / 2 in sigma. memory: correlation of the noise from one reading to
    the next, as in `Observations`.
    """

    difference: Array
    first: Array
    second: Array
    memory: tuple[float, ...] = ()

    def odds(self, repeats: int) -> tuple[OddsForecast, OddsForecast]:
        """Gain of `repeats` readings at each point if the first is true, and if the second is."""
        noise = np.eye(self.difference.shape[-1]) / independent(repeats, self.memory)
        if self.first is self.second:
            pull = np.linalg.solve(noise + self.first, self.difference[..., None])[..., 0]
            squares = np.sum(self.difference * pull, axis=-1)
            equal = OddsForecast(0.5 * squares, np.sqrt(squares))
            return equal, equal
        one, two = noise + self.first, noise + self.second
        return odds_forecast(self.difference, one, two), odds_forecast(self.difference, two, one)

    def gain(self, repeats: int) -> Array:
        """Mean gain (...) of `repeats` readings in nats, the lesser of both cases."""
        one, two = self.odds(repeats)
        return np.minimum(one.mean, two.mean)

    def at(self, point: int) -> Forecast:
        """The forecasts at one of the points."""
        return Forecast(self.difference[point], self.first[point], self.second[point], self.memory)


@dataclass(frozen=True)
class Foretold:
    """Two explanations at N points, m readings each, whitened: difference (N, m), and factors (N, m, k) of covariances.

    Covariances of both by their parameters; memory as in `Forecast`.
    """

    difference: Array
    first: Array
    second: Array
    memory: tuple[float, ...] = ()

    def each(self) -> Forecast:
        """The forecasts at each point by itself."""
        return self._of(self.difference, self.first, self.second)

    def together(self, chosen: NDArray[np.int64]) -> Forecast:
        """The forecasts of readings at several points together; chosen: (..., n), points of each choice."""
        shape = chosen.shape[:-1]
        first, second = (own[chosen].reshape(*shape, -1, own.shape[-1]) for own in (self.first, self.second))
        return self._of(self.difference[chosen].reshape(*shape, -1), first, second)

    def _of(self, difference: Array, first: Array, second: Array) -> Forecast:
        one, other = (own @ np.swapaxes(own, -1, -2) for own in (first, second))
        return Forecast(difference, one, other, self.memory)


@dataclass(frozen=True)
class Outlook:
    """Predictions of two explanations at N points, SI, of all channels of the study and of further meters.

    first, second: (N, C) readings; slopes: of each (N, C, k), times a factor of the parameters' covariance;
    input_slopes: (N, C, M). The further meters follow the C channels.
    """

    study: Study
    first: Array
    second: Array
    slopes: tuple[Array, Array]
    input_slopes: Array
    further: tuple[RecordedChannel, ...] = ()

    def foretold(self, meters: tuple[RecordedChannel, ...] = ()) -> Foretold:
        """The forecasts of the study's channels and of some of the further meters."""
        count = len(self.study.channels)
        read = [*range(count), *(count + self.further.index(one) for one in meters)]
        whitening = whitener(readings(self.study, self.first[:, read], further=meters), self.input_slopes[:, read])
        points = len(self.first)

        def factor(of: Array, slopes: Array) -> Array:
            known = np.concatenate([slopes[:, read], _calibrations(of[:, read], meters)], axis=2)
            return whitening.whiten(known).reshape(points, -1, known.shape[2])

        difference = whitening.whiten((self.second - self.first)[:, read]).reshape(points, -1)
        first, second = (factor(self.first, own) for own in self.slopes)
        return Foretold(difference, first, second, self.study.observations.memory)


def outlook(
    study: Study, first: Contender, second: Contender, points: BenchPoints, further: tuple[RecordedChannel, ...] = ()
) -> Outlook:
    """Predictions of the two at N points."""
    there = [_there(one, points, further) for one in (first, second)]
    one, other = (
        bench.predict(own.posterior.values) for bench, own in zip(there, (first, second), strict=True)
    )  # fmt: skip
    spreads = [_spread(own, bench) for bench, own in zip(there, (first, second), strict=True)]
    input_slopes = there[0].input_slopes(first.posterior.values)
    return Outlook(study, one, other, (spreads[0], spreads[1]), input_slopes, further)


def predicted(contender: Contender, points: BenchPoints, further: tuple[RecordedChannel, ...] = ()) -> Array:
    """Readings (N, C) in SI at the points, predicted by the contender's fit."""
    return _there(contender, points, further).predict(contender.posterior.values)


def log_density(
    study: Study, contender: Contender, points: BenchPoints, values: Array, further: tuple[RecordedChannel, ...] = ()
) -> float:
    """ln of the joint density of readings (N, C), SI, at new points by the forecast of an explanation.

    nan: not read. Up to a constant that all explanations share. Consecutive readings have the correlation of the
    recording's noise. Columns of further meters follow.
    """
    there = _there(contender, points, further)
    new = readings(study, values, study.observations.memory, further)
    whitening = whitener(new, there.input_slopes(contender.posterior.values))
    foreseen = there.predict(contender.posterior.values)
    residual = whitening.whiten(values - foreseen)
    spread = whitening.whiten(np.concatenate([_spread(contender, there), _calibrations(foreseen, further)], axis=2))
    covariance = np.eye(residual.size) + spread @ spread.T
    squares = float(residual @ cho_solve(cho_factor(covariance), residual))
    return whitening.log_determinant - 0.5 * (squares + float(np.linalg.slogdet(covariance)[1]))


def odds_forecast(difference: Array, true: Array, other: Array) -> OddsForecast:
    """ln odds of N(0, true) against N(difference, other) by readings of the first: mean and sigma, (...).

    difference: (..., m), covariances (..., m, m).

    Mean (tr(B) - m + d^T S2^-1 d + ln det S2 - ln det S1) / 2, the divergence (Kullback and Leibler 1951), never
    negative; variance tr((B - I)^2) / 2 + d^T S2^-1 S1 S2^-1 d, with B = S2^-1 S1: of a quadratic form of normal
    numbers (Searle 1971).
    """
    ratio = np.linalg.solve(other, true)
    pull = np.linalg.solve(other, difference[..., None])[..., 0]
    volume = np.linalg.slogdet(other)[1] - np.linalg.slogdet(true)[1]
    squares = np.sum(difference * pull, axis=-1)
    mean = 0.5 * (np.trace(ratio, axis1=-2, axis2=-1) - difference.shape[-1] + squares + volume)
    excess = ratio - np.eye(difference.shape[-1])
    variance = 0.5 * np.sum(excess * np.swapaxes(excess, -1, -2), axis=(-2, -1))
    variance = variance + np.sum(pull * (true @ pull[..., None])[..., 0], axis=-1)
    return OddsForecast(mean, np.sqrt(np.maximum(variance, 0.0)))


def independent(repeats: int, memory: tuple[float, ...]) -> float:
    """Number of independent readings equivalent to `repeats` in a row, 1^T R^-1 1 with their correlation R."""
    if not memory:
        return float(repeats)
    correlation = toeplitz(autocorrelation(memory, repeats)[:repeats])
    return float(np.linalg.solve(correlation, np.ones(repeats)).sum())


def readings(
    study: Study, predictions: Array, memory: tuple[float, ...] = (), further: tuple[RecordedChannel, ...] = ()
) -> Observations:
    """Readings at new points that are as predicted, with the noise of the recording's channels and of further ones."""
    known_readings, count = study.observations, len(study.channels)
    recorded = [*(study.recording.channel(name) for name in study.channels), *further]
    sigma = [
        np.full(len(predictions), np.nan) if one is None else reading_sigma(one, column)
        for one, column in zip(recorded, predictions.T, strict=True)
    ]
    had = known_readings.measured[:, :count].any(axis=0)
    known = np.append(had, np.ones(len(further), dtype=bool)) & np.array([one is not None for one in recorded])
    new = tuple(Channel(one.name.value, one.name.dimension) for one in further)
    return Observations(
        channels=(*known_readings.channels[:count], *new),
        values=np.where(known, predictions, np.nan),
        sigma=np.stack(sigma, axis=1),
        inputs=known_readings.inputs,
        input_sigma=np.tile(np.median(known_readings.input_sigma, axis=0), (len(predictions), 1)),
        quantum=np.append(known_readings.quantum[:count], np.zeros(len(further))),
        blocks=np.arange(len(predictions)),
        memory=memory,
    )


def _there(contender: Contender, points: BenchPoints, further: tuple[RecordedChannel, ...]) -> PumpSimulator:
    """The contender's simulator at other points, with further outputs read."""
    there = contender.simulator.elsewhere(points)
    if not further:
        return there
    if not isinstance(there, LumpedBench):
        raise TypeError("a simulator of other outputs than those recorded is needed")
    return there.reading((*there.channels, *(one.name for one in further)))


def _spread(contender: Contender, there: PumpSimulator) -> Array:
    """(N, C, k), factor of the covariance of a contender's predictions by its parameters, SI."""
    slopes = standard_slopes(there, contender.posterior.xi)
    spread: Array = slopes @ np.linalg.cholesky(contender.posterior.covariance)
    return spread


def _calibrations(values: Array, further: tuple[RecordedChannel, ...]) -> Array:
    """(N, C, 2 F), one sigma of gain and zero of the F further meters, the last columns of readings (N, C)."""
    found = np.zeros((*values.shape, 2 * len(further)))
    for at, one in enumerate(further):
        column = values.shape[1] - len(further) + at
        found[:, column, 2 * at] = one.gain_sigma * values[:, column]
        found[:, column, 2 * at + 1] = one.zero_sigma
    return found
