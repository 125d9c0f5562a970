"""Fits: peaks of the posterior."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.optimize import least_squares

from reynolds import Array, InputError, NotConverged
from system import (
    Channel,
    FitLimits,
    Observations,
    Parameter,
    Posterior,
    Role,
    Scale,
    best_posterior,
    maximum_posterior,
)

OPEN = (-np.inf, np.inf)


@dataclass(frozen=True)
class Law:
    """A simulator of one channel from a function of its values, slopes by differences times `wrong` (k,)."""

    parameters: tuple[Parameter, ...]
    law: Callable[[Array], Array]
    wrong: float = 1.0

    def predict(self, values: Array) -> Array:
        return self.law(values)[:, None]

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        steps = 1e-6 * np.maximum(np.abs(values), 1e-6)
        columns = [
            (self.predict(values + step * unit) - self.predict(values - step * unit)) / (2 * step)
            for step, unit in zip(steps, np.eye(values.size), strict=True)
        ]
        return self.wrong * np.stack(columns, axis=-1)

    def input_slopes(self, values: Array) -> Array:
        return np.zeros((self.predict(values).size, 1, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Law:
        return replace(self, parameters=parameters)


def _parameter(name: str, centre: float, spread: float, bounds: tuple[float, float], scale: Scale) -> Parameter:
    return Parameter(name, Role.BASE, scale, centre, spread, *bounds, None, "test")


def _readings(values: Array, sigma: float) -> Observations:
    points = values.size
    return Observations(
        channels=(Channel("y", None),),
        values=values[:, None],
        sigma=np.full((points, 1), sigma),
        inputs=(),
        input_sigma=np.zeros((points, 0)),
        quantum=np.zeros(1),
        blocks=np.arange(points),
    )


def _valley(values: Array) -> Array:
    """Rosenbrock's curved valley as two residuals."""
    x, y = values
    return np.array([10.0 * (y - x * x), 1.0 - x])


def _rosenbrock(bounds: tuple[float, float] = OPEN, wrong: float = 1.0) -> Posterior:
    parameters = (_parameter("x", 0.0, 3.0, bounds, Scale.NORMAL), _parameter("y", 0.0, 3.0, OPEN, Scale.NORMAL))
    start = np.array([-1.2, 1.0]) / 3.0
    return maximum_posterior(Law(parameters, _valley, wrong), _readings(np.zeros(2), 0.1), start)


DOSE = np.array([77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0])
VOLUME = np.array([10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.4, 75.47, 81.78])
CERTIFIED = {"b1": (2.3894212918e02, 2.7070075241e00), "b2": (5.5015643181e-04, 7.2668688436e-06)}


def test_misra1a(validation) -> None:
    """NIST's Misra1a from its far start, with priors far wider than the answer."""
    spreads = {"b1": 1000.0, "b2": 2e-3}
    parameters = tuple(_parameter(name, 0.0, spread, OPEN, Scale.NORMAL) for name, spread in spreads.items())
    simulator = Law(parameters, lambda values: -values[0] * np.expm1(-values[1] * DOSE))
    observations = _readings(VOLUME, 1.0187876330e-01)
    start = np.array([0.5, 0.05])  # b1 500, b2 1e-4
    found = maximum_posterior(simulator, observations, start, FitLimits(steps=100, change=1e-8))
    for name, (value, sigma) in CERTIFIED.items():
        at = found.index(name)
        prior_pull = abs(value) * (sigma / spreads[name]) ** 2
        validation(
            case="NIST StRD Misra1a",
            source="NIST, Statistical Reference Datasets, nonlinear regression (1997), certified values",
            quantity=f"{name}",
            unit="1",
            expected=value,
            obtained=float(found.values[at]),
            tolerance=3.0 * prior_pull + 1e-4 * sigma,
        )
        validation(
            case="NIST StRD Misra1a",
            source="NIST, Statistical Reference Datasets, nonlinear regression (1997), certified values",
            quantity=f"standard deviation of {name}",
            unit="1",
            expected=sigma,
            obtained=found.sigma(name),
            relative_tolerance=1e-3,
        )


def test_curved_valley() -> None:
    """The peak is where scipy's least squares of the stacked residuals end, to within the change allowed."""
    found = _rosenbrock()
    reference = least_squares(lambda xi: np.concatenate((_valley(3.0 * xi) / 0.1, xi)), np.array([0.3, 0.3]))
    assert found.objective == pytest.approx(2.0 * reference.cost, abs=FitLimits().change)
    off = found.xi - reference.x
    assert float(off @ found.precision @ off) < 1.1 * FitLimits().change
    assert found.effort.predictions < 50


def test_wrong_slopes_lead_to_the_same_peak() -> None:
    """Slopes a tenth off: the trials correct them, and the peak is that of the predictions."""
    right, led = _rosenbrock(), _rosenbrock(wrong=0.9)
    assert led.objective == pytest.approx(right.objective, abs=2 * FitLimits().change)
    assert led.values == pytest.approx(right.values, abs=0.02)


def test_active_bound() -> None:
    """A value that tends beyond a bound is held on it, and the others are best there: y = x^2 but for the prior."""
    found = _rosenbrock(bounds=(-2.0, 0.5))
    assert found.values[0] == 0.5
    held = 0.25 * 1e4 / (1e4 + 1.0 / 9.0)
    assert found.values[1] == pytest.approx(held, abs=1e-3)


PRESSURE = np.linspace(0.1, 1.0, 20)


def _two_films(values: Array) -> Array:
    """Leakage of two films together, and the drag of one, by which alone they can be told apart."""
    one, two = values
    return np.concatenate((PRESSURE * (one**3 + two**3), 0.05 * PRESSURE / two))


def test_films_that_change_places() -> None:
    """From a thick wrong film back along a valley that bends: the peak that starts from the truth reach, soon."""
    parameters = (
        _parameter("one", 1.0, 0.08, (0.0, np.inf), Scale.LOG),
        _parameter("two", 1.0, 0.8, (0.0, np.inf), Scale.LOG),
    )
    simulator = Law(parameters, _two_films)
    readings = _readings(_two_films(np.array([1.05, 2.0])), 0.004)
    swapped = maximum_posterior(simulator, readings, np.array([8.0, -1.0]))
    direct = maximum_posterior(simulator, readings, np.array([0.5, 0.85]))
    assert swapped.objective == pytest.approx(direct.objective, abs=2 * FitLimits().change)
    assert direct.values[1] == pytest.approx(2.0, rel=0.01)
    assert swapped.effort.predictions < 60


def _leaks(xi: Array) -> Array:
    """Leakage of two films and a groove through oil of one viscosity: products, a sum of which is known to 1e-4."""
    one, two, viscosity, groove = xi
    leaks = np.exp(0.45 * one) + PRESSURE * np.exp(0.45 * two) + 0.5 * PRESSURE**2 * np.exp(0.3 * groove)
    return 3000.0 * leaks * np.exp(-0.3 * viscosity)


@pytest.mark.parametrize("wave", [0.0, 2.0], ids=["right law", "another law"])
def test_the_floor_of_a_curved_valley_is_followed(wave: float) -> None:
    """Steps of whole spreads, each corrected down to the floor: the peak of scipy's least squares in some predictions.

    wave: what the law cannot meet, in sigma.
    """
    parameters = tuple(_parameter(name, 0.0, 1.0, OPEN, Scale.NORMAL) for name in ("one", "two", "viscosity", "groove"))
    values = _leaks(np.array([1.5, -1.0, 2.0, 0.5])) + wave * np.sin(25.0 * PRESSURE)
    found = maximum_posterior(Law(parameters, _leaks), _readings(values, 1.0))
    best = least_squares(lambda xi: np.concatenate((values - _leaks(xi), xi)), np.zeros(4), xtol=1e-12, ftol=1e-12)
    assert found.objective == pytest.approx(2.0 * best.cost, abs=5 * FitLimits().change)
    assert found.effort.predictions < 20
    assert found.effort.slopes < 5


def test_intervals_of_curved_models_hold_the_truth() -> None:
    """Two films drawn from their priors, 150 fits: 90 % intervals hold 84 to 96 % (sampling alone: 90 +- 1.7)."""
    rng = np.random.default_rng(41)
    parameters = tuple(_parameter(name, 1.0, 0.2, (0.0, np.inf), Scale.LOG) for name in ("one", "two"))
    simulator = Law(parameters, _two_films)
    inside = []
    for _ in range(150):
        truth = rng.normal(size=2)
        readings = _two_films(np.exp(0.2 * truth)) + 0.02 * rng.normal(size=2 * PRESSURE.size)
        found = maximum_posterior(simulator, _readings(readings, 0.02))
        inside.append(np.abs(found.xi - truth) < 1.6448536 * np.sqrt(np.diag(found.covariance)))
    assert 0.84 < np.mean(inside) < 0.96


def test_half_stays_at_nothing() -> None:
    """An effect of one sign that readings deny ends at exactly 0."""
    parameter = _parameter("effect", 0.0, 1.0, (0.0, np.inf), Scale.HALF)
    simulator = Law((parameter,), lambda values: np.full(5, values[0]))
    found = maximum_posterior(simulator, _readings(np.full(5, -0.3), 0.1))
    assert found.xi[0] == 0.0


def _limited(values: Array) -> Array:
    if values[0] > 1.5:
        raise NotConverged("the model ends at 1.5")
    return np.array([np.exp(values[0]), 3.0 * values[0]])


def test_failing_predictions_are_gone_round() -> None:
    """A trial that the simulator cannot do is shortened; a start it cannot do is told."""
    parameter = _parameter("x", 0.0, 1.0, OPEN, Scale.NORMAL)
    readings = _readings(_limited(np.array([1.4])), 0.01)
    found = maximum_posterior(Law((parameter,), _limited), readings, np.array([-1.0]))
    assert found.values[0] == pytest.approx(1.4, abs=1e-3)
    with pytest.raises(NotConverged, match=r"ends at 1\.5"):
        maximum_posterior(Law((parameter,), _limited), readings, np.array([2.0]))


def test_too_few_steps_are_told() -> None:
    with pytest.raises(NotConverged, match=r"still promised .* more steps than 1"):
        maximum_posterior(
            Law(
                (_parameter("x", 0.0, 3.0, OPEN, Scale.NORMAL), _parameter("y", 0.0, 3.0, OPEN, Scale.NORMAL)), _valley
            ),
            _readings(np.zeros(2), 0.1),
            np.array([-0.4, 0.33]),
            FitLimits(steps=1),
        )


def _threshold(values: Array) -> Array:
    """Nothing below 1, then a steep line: no slope at the prior mean tells of it."""
    return np.maximum(values[0] - 1.0, 0.0) * np.array([1.0, 2.0, 3.0])


def test_starts_find_what_a_threshold_hides() -> None:
    parameter = _parameter("size", 0.0, 1.0, (0.0, np.inf), Scale.HALF)
    simulator = Law((parameter,), _threshold)
    readings = _readings(_threshold(np.array([2.0])), 0.1)
    blind = maximum_posterior(simulator, readings)
    found = best_posterior(simulator, readings, [np.array([start]) for start in (0.1, 1.5, 3.0)])
    assert blind.values[0] == 0.0
    assert found.values[0] == pytest.approx(2.0, abs=0.01)
    assert found.log_evidence > blind.log_evidence + 100.0


@pytest.mark.parametrize("scale", Scale)
def test_scales(scale: Scale) -> None:
    """Value and standard number are inverse; `stretch` is the slope of the one by the other."""
    centre = 0.0 if scale is Scale.HALF else 2.0
    lower = 0.2 if scale is Scale.SQUARE else 0.0
    parameter = _parameter("p", centre, 0.3, (lower, 9.0), scale)
    xi = 0.7
    assert parameter.standard(parameter.value(xi)) == pytest.approx(xi, rel=1e-12)
    slope = (parameter.value(xi + 1e-6) - parameter.value(xi - 1e-6)) / 2e-6
    assert parameter.stretch(xi) == pytest.approx(slope, rel=1e-8)
    assert parameter.value(parameter.highest) == pytest.approx(9.0)
    of_square = (lower**2 - centre**2) / (2.0 * 2.0 * 0.3)
    lowest = {Scale.HALF: 0.0, Scale.LOG: -np.inf, Scale.NORMAL: -2.0 / 0.3, Scale.SQUARE: of_square}
    assert parameter.lowest == pytest.approx(lowest[scale])
    assert parameter.widened(10.0).spread == 3.0
    held = parameter.held(2.0)
    expected = (max(parameter.lowest, -2.0), min(parameter.highest, 2.0))
    assert (held.lowest, held.highest) == pytest.approx(expected)
    assert (held.spread, held.centre) == (parameter.spread, parameter.centre)


@pytest.mark.parametrize(
    ("centre", "spread", "bounds", "scale", "told"),
    [
        (1.0, 0.0, OPEN, Scale.NORMAL, "spread of 0.0"),
        (1.0, 0.1, (2.0, 3.0), Scale.NORMAL, "centre 1.0"),
        (0.0, 0.1, (0.0, 3.0), Scale.LOG, "positive values on a log scale"),
    ],
)
def test_priors_that_are_none(
    centre: float, spread: float, bounds: tuple[float, float], scale: Scale, told: str
) -> None:
    with pytest.raises(InputError, match=told):
        _parameter("p", centre, spread, bounds, scale)


def test_readings_that_do_not_fit() -> None:
    whole = _readings(np.zeros(3), 0.1)
    with pytest.raises(InputError, match="input_sigma"):
        replace(whole, input_sigma=np.zeros((2, 0)))
    with pytest.raises(InputError, match="positive sigma"):
        replace(whole, sigma=np.zeros((3, 1)))
    assert not whole.without(np.array([True, False, False])).measured[0, 0]


def test_a_fit_that_cannot_come_low_enough_ends_early() -> None:
    """A parameter 300 spreads off, two the first step, beside a reading that nothing explains: left on its way."""
    far = (_parameter("a", 0.0, 1.0, OPEN, Scale.NORMAL),)
    law = Law(far, lambda values: np.array([values[0], 0.0]))
    readings = _readings(np.array([300.0, 1.0]), 0.01)
    whole = maximum_posterior(law, readings)
    left = maximum_posterior(law, readings, limits=FitLimits(hopeless=5e3))
    assert whole.values[0] == pytest.approx(300.0, abs=0.1)
    assert left.effort.predictions < whole.effort.predictions
    assert whole.objective < left.objective
    assert left.log_evidence == pytest.approx(whole.log_evidence, rel=1e-3)  # that of the peak promised


@pytest.mark.parametrize(
    ("away", "hopeless", "trials"),
    [
        pytest.param(30.0, 1e8, 4, id="slopes promise a fall of 9e6, 3e8 are missing"),
        pytest.param(300.0, 1e7, 4, id="promised is forty times what is of use"),
        pytest.param(300.0, 1e8, 6, id="promised is four times as much, and a fall of 9e8"),
        pytest.param(300.0, 5e8, None, id="promised is of use"),
    ],
)
def test_patience_ends_sooner_where_slopes_are_right(away: float, hopeless: float, trials: int | None) -> None:
    """A parameter far off, steps of a tenth at first, beside a reading that nothing explains: an objective of 4e8."""
    far = (_parameter("a", 0.0, 1.0, OPEN, Scale.NORMAL),)
    law = Law(far, lambda values: np.array([values[0], 0.0]))
    limits = FitLimits(hopeless=hopeless, patience=6, level=80, largest_step=0.1)
    found = maximum_posterior(law, _readings(np.array([away, 200.0]), 0.01), limits=limits)
    if trials is None:
        assert found.values[0] == pytest.approx(away, abs=0.1)
    else:
        assert found.effort.predictions == 1 + trials
        assert found.values[0] == pytest.approx(0.1 * (2**trials - 1))  # steps that keep their promise double


def test_steps_grow_while_they_keep_their_promise() -> None:
    """A thousand spreads away: steps of two, four, eight; 500 trials of two each otherwise."""
    far = (_parameter("a", 0.0, 1.0, OPEN, Scale.NORMAL),)
    found = maximum_posterior(Law(far, lambda values: values), _readings(np.array([1000.0]), 0.001))
    assert found.values[0] == pytest.approx(1000.0, abs=0.01)
    assert found.effort.predictions < 15


def test_square_scale_is_straight_where_a_value_has_no_slope() -> None:
    """Readings 1 + 1.5 e^2 of e = 0.1 beside the bound: few trials, where a scale of e itself jumps to and fro."""
    own = (_parameter("e", 0.6, 0.2, (0.05, 0.95), Scale.SQUARE),)
    law = Law(own, lambda values: (1.0 + 1.5 * values[0] ** 2) * np.array([1.0, 2.0, 3.0]))
    found = maximum_posterior(law, _readings(1.015 * np.array([1.0, 2.0, 3.0]), 1e-4))
    assert found.values[0] == pytest.approx(0.1, abs=0.002)
    assert found.effort.predictions < 6
