"""Noise of inputs, of digitisation and with memory; resulting uncertainty of parameters."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.linalg import toeplitz
from scipy.stats import kstest

from reynolds import Array
from reynolds.errors import InputError
from system import (
    Channel,
    FitLimits,
    Observations,
    Parameter,
    Posterior,
    Role,
    Scale,
    linear_posterior,
    maximum_posterior,
)
from system.estimation.folds import log_predictive, predictive
from system.estimation.whitening import Whitening, autocorrelation, whitener

POINTS = 30


@dataclass(frozen=True)
class Bench:
    """Two channels linear in three parameters and in one input: a leakage and a torque, say."""

    parameters: tuple[Parameter, ...]
    columns: Array  # (N, 2, 3)
    sensitivity: Array  # (N, 2), to the input

    def predict(self, values: Array) -> Array:
        return self.columns @ values

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        return self.columns

    def input_slopes(self, values: Array) -> Array:
        return self.sensitivity[:, :, None]

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Bench:
        return replace(self, parameters=parameters)


def _bench() -> Bench:
    rng = np.random.default_rng(21)
    parameters = tuple(
        Parameter(name, Role.BASE, Scale.NORMAL, 0.0, 1.0, -np.inf, np.inf, None, "test") for name in "abc"
    )
    return Bench(parameters, rng.normal(size=(POINTS, 2, 3)) / 3.0, rng.normal(size=(POINTS, 2)))


def _readings(values: Array, memory: tuple[float, ...] = (), input_sigma: float = 2.0) -> Observations:
    return Observations(
        channels=(Channel("Q", None), Channel("M", None)),
        values=values,
        sigma=np.tile([1.0, 0.5], (len(values), 1)),
        inputs=("T",),
        input_sigma=np.full((len(values), 1), input_sigma),
        quantum=np.array([0.0, 1.0]),
        blocks=np.arange(len(values)) // 6,
        memory=memory,
    )


def _draws(bench: Bench, count: int) -> Iterator[tuple[Array, Observations]]:
    """True values drawn from the prior and readings of them: own noise, input noise, a step of 1 in the second."""
    rng = np.random.default_rng(22)
    sigma = _readings(np.zeros((POINTS, 2))).sigma
    for _ in range(count):
        truth = rng.normal(size=3)
        shift = bench.sensitivity * 2.0 * rng.normal(size=(POINTS, 1))
        values = bench.predict(truth) + shift + sigma * rng.normal(size=(POINTS, 2))
        values[:, 1] = np.round(values[:, 1])
        yield truth, _readings(values)


@pytest.fixture(scope="module")
def fits() -> list[tuple[Array, Posterior]]:
    """400 fits of readings whose truth is known."""
    bench = _bench()
    return [(truth, linear_posterior(bench, observed)) for truth, observed in _draws(bench, 400)]


def test_intervals_hold_the_truth(fits) -> None:
    """90 % intervals of 1200 parameters: 86 to 94 % hold the truth (sampling alone: 90 +- 1.7)."""
    inside = [np.abs(found.xi - truth) < 1.6448536 * np.sqrt(np.diag(found.covariance)) for truth, found in fits]
    assert 0.86 < np.mean(inside) < 0.94


def test_pulls_are_standard_normal(fits) -> None:
    """Where the priors are right, pulls are N(0, 1): Kolmogorov-Smirnov over all fits, each parameter."""
    pulls = np.array([found.pulls for _, found in fits])
    assert min(kstest(pulls[:, at], "norm").pvalue for at in range(3)) > 0.01


def test_objective_is_chi_square(fits) -> None:
    """r.r + xi.xi at the peak has as many degrees of freedom as there are readings."""
    objectives = np.array([found.objective for _, found in fits])
    readings = 2 * POINTS
    assert objectives.mean() == pytest.approx(readings, abs=3.0 * np.sqrt(2.0 * readings / objectives.size))


def test_without_input_noise_chi_square_is_too_large() -> None:
    """A term that the whitening leaves out shows: the same readings, their input taken as exact."""
    bench = _bench()
    blind = [
        linear_posterior(bench, replace(observed, input_sigma=np.zeros((POINTS, 1)))).objective
        for _, observed in _draws(bench, 20)
    ]
    assert np.mean(blind) > 3.0 * 2 * POINTS


def _dense(whitening: Whitening, shape: tuple[int, int]) -> Array:
    """The whitening as a matrix over all readings."""
    unit = np.eye(shape[0] * shape[1]).reshape(*shape, -1)
    return whitening.whiten(unit)


@pytest.mark.parametrize("memory", [(), (0.6, 0.2)])
def test_whitening_makes_the_covariance_one(memory: tuple[float, ...]) -> None:
    """W C W^T = 1 with the covariance of all readings put together outright, some of them missing."""
    bench = _bench()
    values = np.zeros((POINTS, 2))
    values[3, 0] = values[7:9, 1] = values[20, :] = np.nan
    observed = _readings(values, memory)
    whitening = whitener(observed, bench.input_slopes(np.zeros(3)))
    matrix = _dense(whitening, (POINTS, 2))
    kept = np.flatnonzero(observed.measured.ravel())
    if memory:
        alone = whitener(replace(observed, memory=()), bench.input_slopes(np.zeros(3)))
        mixing = np.linalg.inv(_dense(alone, (POINTS, 2))[:, kept])
        serial = np.kron(toeplitz(autocorrelation(memory, POINTS)), np.eye(2))[np.ix_(kept, kept)]
        channel = whitening.rows[:, 1]
        serial = np.where(channel[:, None] == channel, serial, 0.0)
        covariance = mixing @ serial @ mixing.T
    else:
        own = np.diag((observed.sigma**2 + observed.quantum**2 / 12.0).ravel())
        seen = np.zeros((2 * POINTS, POINTS))
        for point in range(POINTS):
            seen[2 * point : 2 * point + 2, point] = 2.0 * bench.sensitivity[point]
        covariance = (own + seen @ seen.T)[np.ix_(kept, kept)]
    assert matrix[:, kept] @ covariance @ matrix[:, kept].T == pytest.approx(np.eye(kept.size), abs=1e-10)
    sizes = 2.0 * np.log(observed.sigma[observed.measured]).sum()
    assert whitening.log_determinant == pytest.approx(0.5 * (sizes - np.linalg.slogdet(covariance)[1]), abs=1e-9)


def test_change_of_the_noise_is_relative() -> None:
    still = whitener(_readings(np.zeros((POINTS, 2))), _bench().input_slopes(np.zeros(3)))
    louder = replace(still, factors=still.factors / 1.25)
    assert still.change(still) == pytest.approx(0.0, abs=1e-12)
    assert still.change(louder) == pytest.approx(0.25)
    assert louder.change(still) == pytest.approx(0.2)


def test_known_correlation_is_whitened() -> None:
    """W C W^T = 1 for readings whose own noise correlates between points, and ln det with it; inputs known exactly."""
    bench, distance = _bench(), np.abs(np.subtract.outer(np.arange(POINTS), np.arange(POINTS)))
    correlation = tuple(0.6 * np.exp(-distance / length) + 0.4 * np.eye(POINTS) for length in (3.0, 8.0))
    values = np.zeros((POINTS, 2))
    values[3, 0] = values[7:9, 1] = np.nan
    observed = replace(_readings(values, input_sigma=0.0), quantum=np.zeros(2), correlation=correlation)
    whitening = whitener(observed, bench.input_slopes(np.zeros(3)))
    kept = np.flatnonzero(observed.measured.ravel())
    joint = sum(np.kron(own, np.diag(np.eye(2)[k])) for k, own in enumerate(correlation))
    spread = observed.sigma.ravel()
    covariance = (joint * np.outer(spread, spread))[np.ix_(kept, kept)]
    matrix = _dense(whitening, (POINTS, 2))[:, kept]
    assert matrix @ covariance @ matrix.T == pytest.approx(np.eye(kept.size), abs=1e-10)
    sizes = 2.0 * np.log(observed.sigma[observed.measured]).sum()
    assert whitening.log_determinant == pytest.approx(0.5 * (sizes - np.linalg.slogdet(covariance)[1]), abs=1e-9)


def test_noise_of_inputs_does_not_correlate() -> None:
    """Where all noise comes from the inputs, known correlation of the readings' own noise counts for nothing."""
    bench, values = _bench(), np.zeros((POINTS, 2))
    loud = replace(
        _readings(values, input_sigma=1e4), quantum=np.zeros(2), correlation=(np.full((POINTS, POINTS), 0.9),) * 2
    )
    factors = whitener(loud, bench.input_slopes(np.zeros(3))).serial
    assert all(np.abs(np.tril(own, -1)).max() < 1e-4 for own in factors)


def test_a_correlation_of_another_size_is_refused() -> None:
    for found in ((np.eye(POINTS),), (np.eye(3), np.eye(3))):
        with pytest.raises(InputError, match="correlation"):
            replace(_readings(np.zeros((POINTS, 2))), correlation=found)


def test_autocorrelation(validation) -> None:
    """An autoregressive noise of second order, by the closed form of its first lag and by a long record."""
    memory = (0.6, 0.2)
    correlation = autocorrelation(memory, 40)
    validation(
        case="Autoregressive noise",
        source="Box and Jenkins, Time Series Analysis (1970), section 3.2: rho1 = phi1 / (1 - phi2)",
        quantity="correlation of neighbours, phi 0.6 and 0.2",
        unit="1",
        expected=0.75,
        obtained=float(correlation[1]),
        tolerance=1e-12,
    )
    assert correlation[2:] == pytest.approx(0.6 * correlation[1:-1] + 0.2 * correlation[:-2], abs=1e-12)
    assert autocorrelation((0.5,), 1) == pytest.approx([1.0])


def test_rows_not_fitted() -> None:
    """Residual and joint covariance of a fold are those of a fit without it."""
    bench = _bench()
    _, observed = next(_draws(bench, 1))
    fold = observed.blocks == 2
    whole, without = linear_posterior(bench, observed), linear_posterior(bench, observed.without(fold))
    rows = fold[whole.whitening.rows[:, 0]]
    residual, covariance = predictive(whole, rows)
    missed = whole.whitening.whiten(observed.values - without.predictions)[rows]
    assert residual == pytest.approx(missed, abs=1e-10)
    slopes = whole.slopes[rows]
    assert covariance == pytest.approx(np.eye(rows.sum()) + slopes @ without.covariance @ slopes.T, abs=1e-10)


def test_log_predictive_is_a_ratio_of_evidences() -> None:
    """ln p(fold | rest) = ln p(all) - ln p(rest)."""
    bench = _bench()
    _, observed = next(_draws(bench, 1))
    fold = observed.blocks == 4
    whole, without = linear_posterior(bench, observed), linear_posterior(bench, observed.without(fold))
    rows = fold[whole.whitening.rows[:, 0]]
    evidences = [found.log_evidence - found.whitening.log_determinant for found in (whole, without)]
    assert log_predictive(whole, rows) == pytest.approx(evidences[0] - evidences[1], abs=1e-9)


PEARSON_X = np.array([0.0, 0.9, 1.8, 2.6, 3.3, 4.4, 5.2, 6.1, 6.5, 7.4])
PEARSON_Y = np.array([5.9, 5.4, 4.4, 4.6, 3.5, 3.7, 2.8, 2.8, 2.4, 1.5])
YORK_WX = np.array([1000.0, 1000.0, 500.0, 800.0, 200.0, 80.0, 60.0, 20.0, 1.8, 1.0])
YORK_WY = np.array([1.0, 1.8, 4.0, 8.0, 20.0, 20.0, 70.0, 70.0, 100.0, 500.0])


@dataclass(frozen=True)
class Line:
    """y = a + b x with x measured: its noise comes in by the slope of the line."""

    parameters: tuple[Parameter, ...]

    def predict(self, values: Array) -> Array:
        return (values[0] + values[1] * PEARSON_X)[:, None]

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        return np.column_stack((np.ones_like(PEARSON_X), PEARSON_X))[:, None, :]

    def input_slopes(self, values: Array) -> Array:
        return np.full((PEARSON_X.size, 1, 1), values[1])

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Line:
        return replace(self, parameters=parameters)


def test_line_with_noise_in_both(validation) -> None:
    """Pearson's points with York's weights: the noise of the input renewed until it stays.

    First order in the input's noise: the fit takes the line's slope in the weights from the round before, and so
    stops short of York's exact line by a part of its standard error.
    """
    parameters = tuple(
        Parameter(name, Role.BASE, Scale.NORMAL, 0.0, 100.0, -np.inf, np.inf, None, "test") for name in "ab"
    )
    observed = Observations(
        channels=(Channel("y", None),),
        values=PEARSON_Y[:, None],
        sigma=YORK_WY[:, None] ** -0.5,
        inputs=("x",),
        input_sigma=YORK_WX[:, None] ** -0.5,
        quantum=np.zeros(1),
        blocks=np.arange(PEARSON_X.size),
    )
    found = maximum_posterior(Line(parameters), observed, limits=FitLimits(change=1e-8, whitening_rounds=20))
    for name, expected, sigma in (("a", 5.47991, 0.29497), ("b", -0.480533, 0.057985)):
        validation(
            case="A line with noise in both coordinates",
            source="York, Can. J. Phys. 44 (1966): Pearson's data with York's weights",
            quantity={"a": "intercept", "b": "slope"}[name],
            unit="1",
            expected=expected,
            obtained=float(found.values[found.index(name)]),
            tolerance=0.5 * sigma,
            note="half a standard error",
        )
        assert found.sigma(name) == pytest.approx(sigma, rel=0.1)
