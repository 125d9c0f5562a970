"""Forecasts of two explanations for readings at new points, and the odds after such readings.

Each forecast is a Gaussian with the covariance of the noise and of its own parameters: a difference that
parameters can follow has no weight, however often it is read.
"""

from __future__ import annotations

from collections.abc import Iterator
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
    """Gain in ln odds of the true explanation by readings: mean and one sigma, nats."""

    mean: float
    sigma: float

    def chance(self, wanted: float) -> float:
        """Probability of `wanted` nats at least."""
        return float(ndtr((self.mean - wanted) / max(self.sigma, 1e-12)))


@dataclass(frozen=True)
class Forecast:
    """Forecasts of two explanations at one point, whitened: difference (m,), covariances (m, m) by parameters.

    memory: correlation of the noise from one reading to the next, as in `Observations`.
    """

    difference: Array
    first: Array
    second: Array
    memory: tuple[float, ...] = ()

    def odds(self, repeats: int) -> tuple[OddsForecast, OddsForecast]:
        """Gain of `repeats` readings if the first is true, and if the second is."""
        noise = np.eye(self.difference.size) / independent(repeats, self.memory)
        one, two = noise + self.first, noise + self.second
        return odds_forecast(self.difference, one, two), odds_forecast(self.difference, two, one)

    def gain(self, repeats: int) -> float:
        """Mean gain of `repeats` readings in nats, the lesser of both cases."""
        return min(each.mean for each in self.odds(repeats))


def forecasts(study: Study, first: Contender, second: Contender, points: BenchPoints) -> Iterator[Forecast]:
    """Forecasts of the two at each of the points."""
    one, other = (predicted(contender, points) for contender in (first, second))
    there = first.simulator.elsewhere(points)
    whitening = whitener(readings(study, one), there.input_slopes(first.posterior.values))
    difference = whitening.whiten(other - one)
    spreads = [_spread(contender, points, whitening) for contender in (first, second)]
    for at in range(len(points.speed)):
        own = whitening.rows[:, 0] == at
        first_spread, second_spread = (spread[own] @ spread[own].T for spread in spreads)
        yield Forecast(difference[own], first_spread, second_spread, study.observations.memory)


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
    """ln odds of N(0, true) against N(difference, other) by readings of the first: mean and sigma.

    Mean (tr(B) - m + d^T S2^-1 d + ln det S2 - ln det S1) / 2, the divergence (Kullback and Leibler 1951), never
    negative; variance tr((B - I)^2) / 2 + d^T S2^-1 S1 S2^-1 d, with B = S2^-1 S1: of a quadratic form of normal
    numbers (Searle 1971).
    """
    factor = cho_factor(other)
    ratio = cho_solve(factor, true)
    pull = cho_solve(factor, difference)
    volume = float(np.linalg.slogdet(other)[1] - np.linalg.slogdet(true)[1])
    mean = 0.5 * (float(np.trace(ratio)) - difference.size + float(difference @ pull) + volume)
    excess = ratio - np.eye(difference.size)
    variance = 0.5 * float(np.trace(excess @ excess)) + float(pull @ true @ pull)
    return OddsForecast(mean, float(np.sqrt(variance)))


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
