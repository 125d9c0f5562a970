"""Forecasts of two explanations for readings at new points, and the odds after such readings.

Each forecast is a Gaussian with the covariance of the noise and of its own parameters: a difference that
parameters can follow has no weight, however often it is read.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve, toeplitz
from scipy.special import ndtr

from diagnosis.study.model import PumpSimulator, Study
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.effects.effect import EffectId
from system.estimation.observations import Observations
from system.estimation.posterior import Posterior, standard_slopes
from system.estimation.whitening import Whitening, autocorrelation, whitener


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


def forecasts(study: Study, first: Contender, second: Contender, points: BenchPoints) -> Forecast:
    """Forecasts of the two at N points, m readings each."""
    one, other = (predicted(contender, points) for contender in (first, second))
    there = first.simulator.elsewhere(points)
    whitening = whitener(readings(study, one), there.input_slopes(first.posterior.values))
    count = len(points.speed)
    difference = whitening.whiten(other - one).reshape(count, -1)
    spreads = (
        _spread(contender, points, whitening).reshape(count, difference.shape[1], -1) for contender in (first, second)
    )
    first_spread, second_spread = (spread @ np.swapaxes(spread, 1, 2) for spread in spreads)
    return Forecast(difference, first_spread, second_spread, study.observations.memory)


def predicted(contender: Contender, points: BenchPoints) -> Array:
    """Readings (N, C) in SI at the points, predicted by the contender's fit."""
    return contender.simulator.elsewhere(points).predict(contender.posterior.values)


def log_density(study: Study, contender: Contender, points: BenchPoints, values: Array) -> float:
    """ln of the joint density of readings (N, C), SI, at new points by the forecast of an explanation.

    nan: not read. Up to a constant that all explanations share. Consecutive readings have the correlation of the
    recording's noise.
    """
    there = contender.simulator.elsewhere(points)
    new = readings(study, values, study.observations.memory)
    whitening = whitener(new, there.input_slopes(contender.posterior.values))
    residual = whitening.whiten(values - there.predict(contender.posterior.values))
    spread = _spread(contender, points, whitening)
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
    """Independent readings that `repeats` in a row are worth, 1^T R^-1 1 with their correlation R."""
    if not memory:
        return float(repeats)
    correlation = toeplitz(autocorrelation(memory, repeats)[:repeats])
    return float(np.linalg.solve(correlation, np.ones(repeats)).sum())


def readings(study: Study, predictions: Array, memory: tuple[float, ...] = ()) -> Observations:
    """Readings at new points that are as predicted, with the noise of the recording's channels."""
    known_readings, count = study.observations, len(study.channels)
    recorded = [study.recording.channel(name) for name in study.channels]
    sigma = [
        np.full(len(predictions), np.nan) if one is None else one.sigma + one.sigma_relative * np.abs(column)
        for one, column in zip(recorded, predictions.T, strict=True)
    ]
    known = known_readings.measured[:, :count].any(axis=0) & np.array([one is not None for one in recorded])
    return Observations(
        channels=known_readings.channels[:count],
        values=np.where(known, predictions, np.nan),
        sigma=np.stack(sigma, axis=1),
        inputs=known_readings.inputs,
        input_sigma=np.tile(np.median(known_readings.input_sigma, axis=0), (len(predictions), 1)),
        quantum=known_readings.quantum[:count],
        blocks=np.arange(len(predictions)),
        memory=memory,
    )


def _spread(contender: Contender, points: BenchPoints, whitening: Whitening) -> Array:
    """(n, k), factor of the covariance that a contender's parameters give its predictions, whitened."""
    slopes = whitening.whiten(standard_slopes(contender.simulator.elsewhere(points), contender.posterior.xi))
    spread: Array = slopes @ np.linalg.cholesky(contender.posterior.covariance)
    return spread
