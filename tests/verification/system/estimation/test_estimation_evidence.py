"""Evidence: Laplace's, of columns and of multipliers, against integrals done outright."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import asin, log, pi

import numpy as np
import pytest
from scipy.integrate import quad, simpson
from scipy.special import logsumexp

from reynolds import Array
from system import Channel, Observations, Parameter, Role, Scale, linear_posterior, maximum_posterior
from system.estimation.determined import undetermined
from system.estimation.evidence import (
    Sign,
    family_evidences,
    mixture_evidence,
    multiplier_evidence,
    multiplier_evidences_without,
    score,
    taken_up,
)
from system.estimation.posterior import log_mass, settled

POINTS = 12
FREE = (-np.inf, np.inf)
POSITIVE = (0.0, np.inf)


@dataclass(frozen=True)
class Columns:
    """A linear simulator of one channel: readings = columns . values."""

    parameters: tuple[Parameter, ...]
    columns: Array

    def predict(self, values: Array) -> Array:
        return (self.columns @ values)[:, None]

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        return self.columns[:, None, :]

    def input_slopes(self, values: Array) -> Array:
        return np.zeros((len(self.columns), 1, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Columns:
        return replace(self, parameters=parameters)


def _parameter(name: str, bounds: tuple[float, float] = FREE) -> Parameter:
    scale = Scale.HALF if bounds[0] == 0.0 else Scale.NORMAL
    return Parameter(name, Role.BASE, scale, 0.0, 1.0, *bounds, None, "test")


def _columns(seed: int, count: int) -> Array:
    return np.random.default_rng(seed).normal(size=(POINTS, count))


def _observed(values: Array) -> Observations:
    return Observations(
        channels=(Channel("y", None),),
        values=values[:, None],
        sigma=np.ones((values.size, 1)),
        inputs=(),
        input_sigma=np.zeros((values.size, 0)),
        quantum=np.zeros(1),
        blocks=np.arange(values.size),
    )


def _grid_evidence(columns: Array, readings: Array, bounds: list[tuple[float, float]]) -> float:
    """ln of the integral of likelihood times prior over two parameters by Simpson's rule on a fine grid."""
    axes = [np.linspace(max(low, -9.0), min(high, 9.0), 601) for low, high in bounds]
    one, two = np.meshgrid(*axes, indexing="ij")
    precision = columns.T @ columns + np.eye(2)
    pull = columns.T @ readings
    squares = precision[0, 0] * one**2 + 2.0 * precision[0, 1] * one * two + precision[1, 1] * two**2
    exponent = pull[0] * one + pull[1] * two - 0.5 * (readings @ readings + squares)
    integral = simpson(simpson(np.exp(exponent - exponent.max()), axes[1], axis=1), axes[0])
    low, high = np.array(bounds).T
    prior = log_mass(np.zeros(2), np.ones(2), low, high).sum()
    return float(exponent.max()) + log(integral) - log(2.0 * pi) - float(prior)


@pytest.mark.parametrize("truth", [1.0, 0.1, 0.0, -0.4])
@pytest.mark.parametrize("bounds", [FREE, POSITIVE, (-0.3, 0.5)])
def test_laplace_with_one_bounded_parameter_is_exact(bounds: tuple[float, float], truth: float) -> None:
    """Linear readings, one parameter bounded, the other free: the mass within bounds, peak in or out of them."""
    columns = _columns(3, 2)
    readings = columns @ np.array([truth, 0.7]) + np.random.default_rng(4).normal(size=POINTS)
    simulator = Columns((_parameter("a", bounds), _parameter("b")), columns)
    found = maximum_posterior(simulator, _observed(readings))
    expected = _grid_evidence(columns, readings, [bounds, FREE])
    assert found.log_evidence == pytest.approx(expected, abs=2e-4)


def test_two_bounded_parameters() -> None:
    """Two bounds are counted one at a time: right but for what they share at a corner (Sheppard 1899)."""
    columns = _columns(5, 2)
    columns[:, 1] += 0.5 * columns[:, 0]
    readings = columns @ np.array([0.1, 0.2])
    simulator = Columns((_parameter("a", POSITIVE), _parameter("b", POSITIVE)), columns)
    found = maximum_posterior(simulator, _observed(readings))
    shared = abs(log(1.0 - 2.0 / pi * asin(abs(found.correlation("a", "b")))))
    expected = _grid_evidence(columns, readings, [POSITIVE, POSITIVE])
    assert 0.1 < shared < 0.3
    assert found.log_evidence == pytest.approx(expected, abs=shared)


def _marginal(base: Array, columns: Array, widths: Array, readings: Array) -> float:
    """ln N(readings; 0, 1 + base base^T + columns diag(widths^2) columns^T), outright."""
    covariance = np.eye(readings.size) + base @ base.T + (columns * widths**2) @ columns.T
    squares = readings @ np.linalg.solve(covariance, readings)
    return -0.5 * float(squares) - 0.5 * float(np.linalg.slogdet(covariance)[1])


WIDTHS = (0.03, 0.1, 0.3, 1.0)


@pytest.fixture
def case() -> tuple[Array, Array, Array]:
    """Columns of three fitted parameters, one column that is not fitted, readings that hold some of it."""
    columns = _columns(11, 4)
    noise = np.random.default_rng(12).normal(size=POINTS)
    return columns[:, :3], columns[:, 3], columns @ np.array([0.5, -1.0, 0.2, 0.6]) + noise


def _fitted(base: Array, readings: Array):
    simulator = Columns(tuple(_parameter(f"p{at}") for at in range(base.shape[1])), base)
    return linear_posterior(simulator, _observed(readings))


def test_mixture_without_sign(case) -> None:
    """The evidence of a column is a ratio of two normal densities, nothing projected."""
    base, column, readings = case
    null = _marginal(base, column[:, None], np.zeros(1), readings)
    each = [_marginal(base, column[:, None], np.array([width]), readings) - null for width in WIDTHS]
    found = mixture_evidence(score(_fitted(base, readings), column), WIDTHS, Sign.EITHER)
    assert found == pytest.approx(logsumexp(each) - log(len(WIDTHS)), abs=1e-10)


@pytest.mark.parametrize(("sign", "direction"), [(Sign.POSITIVE, 1.0), (Sign.NEGATIVE, -1.0)])
def test_mixture_with_sign(case, sign: Sign, direction: float) -> None:
    """Of one sign: the size integrated outright over half a normal prior."""
    base, column, readings = case
    null = _marginal(base, column[:, None], np.zeros(1), readings)

    def density(size: float, width: float) -> float:
        shifted = _marginal(base, column[:, None], np.zeros(1), readings - direction * size * column)
        return 2.0 / (width * np.sqrt(2.0 * pi)) * np.exp(shifted - null - 0.5 * (size / width) ** 2)

    each = [quad(density, 0.0, 12.0 * width, args=(width,), epsabs=1e-12)[0] for width in WIDTHS]
    found = mixture_evidence(score(_fitted(base, readings), column), WIDTHS, sign)
    assert found == pytest.approx(log(np.mean(each)), abs=1e-8)


def test_multiplier(case) -> None:
    """Several columns at once, as many as there are readings left and more."""
    base, _, readings = case
    columns = _columns(13, 15)
    null = _marginal(base, columns, np.zeros(15), readings)
    each = [_marginal(base, columns, np.full(15, width), readings) - null for width in (0.01, 0.1, 1.0)]
    found = multiplier_evidence(_fitted(base, readings), columns, (0.01, 0.1, 1.0))
    assert found == pytest.approx(logsumexp(each) - log(3.0), abs=1e-9)


def test_families_of_columns_are_each_by_itself(case) -> None:
    base, _, readings = case
    columns, widths = _columns(13, 6), (0.01, 0.1, 1.0)
    fit, families = _fitted(base, readings), (np.array([0, 2]), np.array([1]), np.arange(6))
    found = family_evidences(fit, columns, families, widths)
    assert found == pytest.approx([multiplier_evidence(fit, columns[:, own], widths) for own in families], abs=1e-10)


def test_columns_take_up_what_their_fit_does(case) -> None:
    """The fall of the objective by a fit with these columns, of prior N(0, w^2), at the width of most evidence."""
    base, _, readings = case
    columns = _columns(13, 2)
    fit = _fitted(base, readings)
    widths = (0.1, 3.0)
    best = max(widths, key=lambda width: multiplier_evidence(fit, columns, [width]))
    both = _fitted(np.column_stack((base, best * columns)), readings)
    assert taken_up(fit, columns, widths) == pytest.approx(0.5 * (fit.objective - both.objective), abs=1e-8)


def test_multiplier_without_a_part_is_that_of_the_rest(case) -> None:
    """The fit repeated on what is left, and the columns there."""
    base, _, readings = case
    columns, parts, widths = _columns(13, 4), np.arange(POINTS) // 3, (0.01, 0.1, 1.0)
    found = multiplier_evidences_without(_fitted(base, readings), columns, parts, widths)
    rest = [
        multiplier_evidence(_fitted(base[parts != k], readings[parts != k]), columns[parts != k], widths)
        for k in range(POINTS // 3)
    ]
    assert found == pytest.approx(rest, abs=1e-9)


def test_score_is_the_refit(case) -> None:
    """Size and sigma of a column are what a fit with a wide parameter of it finds."""
    base, column, readings = case
    found = score(_fitted(base, readings), column)
    wide = 1e4
    refit = _fitted(np.column_stack((base, wide * column)), readings)
    assert found.size == pytest.approx(refit.xi[3] * wide, rel=1e-6)
    assert found.sigma == pytest.approx(np.sqrt(refit.covariance[3, 3]) * wide, rel=1e-6)
    assert found.z == pytest.approx(found.size / found.sigma)


def test_column_of_nothing(case) -> None:
    """A column of zeros has no score and leaves the odds as they are."""
    base, column, readings = case
    found = score(_fitted(base, readings), 0.0 * column)
    assert (found.z, found.size) == (0.0, 0.0)
    assert mixture_evidence(found, WIDTHS, Sign.POSITIVE) == 0.0


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [
        (-np.inf, np.inf, 0.0),
        (0.0, np.inf, log(0.5)),
        (30.0, np.inf, -454.32124395634625),  # ln Phi(-30), Abramowitz and Stegun 26.2.12
        (-np.inf, -30.0, -454.32124395634625),
        (-1.0, 1.0, log(0.6826894921370859)),
    ],
)
def test_mass_between_bounds(low: float, high: float, expected: float) -> None:
    found = log_mass(np.zeros(1), np.ones(1), np.array([low]), np.array([high]))
    assert found[0] == pytest.approx(expected, rel=1e-9, abs=1e-15)


def test_what_is_left_open() -> None:
    """Two parameters seen by their sum alone, one not seen at all: each told by itself; what is seen is not."""
    columns = _columns(17, 4)
    columns[:, 1] = columns[:, 0]
    columns[:, 3] = 0.0
    simulator = Columns(tuple(_parameter(name) for name in ("gap", "oil", "seen", "unseen")), columns)
    found = undetermined(linear_posterior(simulator, _observed(np.zeros(POINTS))))
    by_names = {frozenset(combination.names): combination for combination in found}
    assert set(by_names) == {frozenset({"gap", "oil"}), frozenset({"unseen"})}
    assert sum(by_names[frozenset({"gap", "oil"})].weights) == pytest.approx(0.0, abs=1e-6)
    assert all(combination.shrinkage == pytest.approx(1.0) for combination in found)


def test_odds_mean_what_they_say() -> None:
    """Effects of one sign drawn in half of 300 records: posterior odds of 1 in p are right one time in p.

    Where odds lean to an effect and where they lean away the number of effects is as predicted, to 3 sigma.
    """
    rng = np.random.default_rng(31)
    columns = _columns(19, 3) / 2.0
    nuisances = (_parameter("a"), _parameter("b"))
    null, effect = Columns(nuisances, columns[:, :2]), Columns((*nuisances, _parameter("c", POSITIVE)), columns)
    present = rng.random(300) < 0.5
    predicted = np.empty(present.size)
    for at, there in enumerate(present):
        truth = np.append(rng.normal(size=2), abs(rng.normal()) * there)
        observed = _observed(columns @ truth + rng.normal(size=POINTS))
        evidences = [maximum_posterior(model, observed).log_evidence for model in (null, effect)]
        predicted[at] = 1.0 / (1.0 + np.exp(evidences[0] - evidences[1]))
    for leaning in (predicted > 0.5, predicted <= 0.5):
        expected, spread = predicted[leaning].sum(), np.sqrt((predicted * (1.0 - predicted))[leaning].sum())
        assert present[leaning].sum() == pytest.approx(expected, abs=3.0 * spread)
    assert np.ptp(predicted) > 0.5


def test_a_fit_beside_its_peak_is_settled_before_columns_are_weighed() -> None:
    """A large column that the parameters nearly take up: nonsense beside the peak, exact once settled."""
    columns = 30.0 * _columns(11, 2)
    readings = columns @ np.array([0.3, -0.2]) + np.random.default_rng(12).normal(size=POINTS)
    simulator = Columns((_parameter("a"), _parameter("b")), columns)
    peak = linear_posterior(simulator, _observed(readings))
    beside = 0.02 * np.ones(2)
    ended = replace(peak, xi=peak.xi - beside, residual=peak.residual + peak.slopes @ beside)
    column = (50.0 * columns[:, 0] + _columns(13, 1)[:, 0])[:, None]
    exact = multiplier_evidence(peak, column, [1.0])
    assert abs(multiplier_evidence(ended, column, [1.0]) - exact) > 10.0
    assert multiplier_evidence(settled(ended), column, [1.0]) == pytest.approx(exact, abs=1e-6)
    assert settled(ended).xi == pytest.approx(peak.xi)


def test_a_linear_model_is_the_same_about_any_place() -> None:
    """Peak, residual and evidence of linear readings do not depend on where the slopes are taken."""
    columns = _columns(11, 3)
    simulator = Columns(tuple(_parameter(name) for name in "abc"), columns)
    observed = _observed(columns @ np.array([0.5, -1.0, 0.2]) + np.random.default_rng(12).normal(size=POINTS))
    at_mean = linear_posterior(simulator, observed)
    elsewhere = linear_posterior(simulator, observed, np.array([1.0, -2.0, 0.3]))
    for name in ("xi", "residual", "predictions", "objective", "log_evidence"):
        assert getattr(elsewhere, name) == pytest.approx(getattr(at_mean, name)), name
