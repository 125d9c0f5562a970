"""The next point to record: it separates what the recording leaves together, and says so in numbers that hold."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from scipy.special import softmax
from scipy.stats import norm

from diagnosis import BenchBox, Circuit, RecordedChannel, Recording, SteadyTable, Study, load_thresholds
from diagnosis.next_point.choose import NextPoint, next_point
from diagnosis.next_point.forecast import Contender, independent, log_density, odds_forecast, outlook
from diagnosis.next_point.operating_box import rig_box
from reynolds import Array
from system import (
    BenchPoints,
    Channel,
    ChannelName,
    Dimension,
    EffectId,
    LumpedBench,
    Observations,
    Parameter,
    Role,
    Scale,
    base_parameters,
    entry_of,
    load_pump,
    maximum_posterior,
    tolerances,
)
from system.estimation.posterior import linear_posterior, standard_slopes

MPA, LPM = 1e6, 1.0 / 60000.0
SPEED, PRESSURE = 150.0, 20 * MPA
SIGMA = 0.01 * LPM
LIMITS = load_thresholds().next_point
Law = Callable[[BenchPoints], Array]


@dataclass(frozen=True)
class Drain:
    """Case flow of a pump: a leak ~ p of size known to a tenth, and one law more of free size."""

    points: BenchPoints
    law: Law
    parameters: tuple[Parameter, ...]

    def predict(self, values: Array) -> Array:
        return (values[0] * self.points.p_out / PRESSURE + values[1] * self.law(self.points))[:, None]

    def slopes(self, values: Array, names: tuple[str, ...]) -> Array:
        columns = np.stack([self.points.p_out / PRESSURE, self.law(self.points)], axis=-1)
        return columns[:, None, [[one.name for one in self.parameters].index(name) for name in names]]

    def input_slopes(self, values: Array) -> Array:
        return np.zeros((len(self.points.speed), 1, 0))

    def with_parameters(self, parameters: tuple[Parameter, ...]) -> Drain:
        return replace(self, parameters=parameters)

    def elsewhere(self, points: BenchPoints) -> Drain:
        return replace(self, points=points)


def _square(points: BenchPoints) -> Array:
    return (points.p_out / PRESSURE) ** 2


def _fast(points: BenchPoints) -> Array:
    return points.p_out * points.speed / (PRESSURE * SPEED)


def _drain(points: BenchPoints, law: Law, size: float) -> Drain:
    known = ("leak", Role.BASE, Scale.NORMAL, LPM, 0.1 * LPM), (-np.inf, np.inf)
    free = ("size", Role.EXTENSION, Scale.HALF, 0.0, size), (0.0, np.inf)
    return Drain(
        points, law, tuple(Parameter(*own, *ends, Dimension.VOLUME_FLOW, "test") for own, ends in (known, free))
    )


def _points() -> BenchPoints:
    """A campaign in which speed went with pressure: the two laws look alike in it."""
    pressure = np.linspace(5 * MPA, 20 * MPA, 24)
    speed = SPEED * (pressure / PRESSURE + 0.06 * np.sin(7 * np.arange(24)))
    same, order = np.ones(24), np.arange(24.0)
    held = (1 * MPA * same, 0.1 * MPA * same, 323 * same, 323 * same)
    return BenchPoints(speed, same, pressure, *held, order, order, 0 * same)


def _recording(points: BenchPoints, flow: Array) -> Recording:
    values = np.full((24, len(ChannelName)), np.nan)
    columns = {ChannelName.SPEED: points.speed, ChannelName.P_OUT: points.p_out, ChannelName.Q_CASE: flow}
    for name, column in columns.items():
        values[:, list(ChannelName).index(name)] = column
    noise = {ChannelName.SPEED: 0.1, ChannelName.P_OUT: 1e4, ChannelName.Q_CASE: SIGMA}
    channels = tuple(
        RecordedChannel(name, name.value, "", sigma, 0.0, 0.0, 0.0, 0.0, 0.0, ()) for name, sigma in noise.items()
    )
    steady = SteadyTable(values, np.arange(24), np.full(24, np.nan), np.full_like(values, np.nan))
    return Recording("toy", "ref90", "", Circuit.CLOSED, channels, steady, (), ())


def _gains(study: Study, first: Contender, second: Contender, points: BenchPoints) -> Array:
    """(N,), nats that readings at each of the points bring at least, whichever of the two is true."""
    return outlook(study, first, second, points).foretold().each().gain(LIMITS.readings)


def _rivals(true: Law, seed: int, size: float = 0.3) -> tuple[Study, Contender, Contender]:
    """Readings made by one law, so many L/min large, and both laws fitted to them."""
    points = _points()
    flow = points.p_out / PRESSURE * LPM + size * LPM * true(points)
    flow = flow + SIGMA * np.random.default_rng(seed).normal(size=24)
    readings = Observations(
        channels=(Channel("Q_case", Dimension.VOLUME_FLOW),),
        values=flow[:, None],
        sigma=np.full((24, 1), SIGMA),
        inputs=(),
        input_sigma=np.zeros((24, 0)),
        quantum=np.zeros(1),
        blocks=np.arange(24),
    )
    drains = [_drain(points, law, size * LPM) for law in (_square, _fast)]
    fits = [maximum_posterior(drain, readings) for drain in drains]
    ids = EffectId.ELASTIC_OPENING, EffectId.FILM_HEATING
    weights = softmax([fit.log_evidence for fit in fits])
    simulators: Any = drains  # nothing but readings is asked of them
    first, second = (
        Contender((one,), drain, fit, one.value, float(weight))
        for one, drain, fit, weight in zip(ids, simulators, fits, weights, strict=True)
    )
    return (Study(_recording(points, flow), simulators[0], readings, fits[0], (), {}, np.zeros((24, 4))), first, second)


def _asked(test: NextPoint) -> BenchPoints:
    """All points of a test."""
    rows = []
    for place in test.places:
        at = place.point
        rows.append((
            at.shaft_speed, at.displacement_ratio, at.delivery_pressure, at.inlet_pressure, at.case_pressure,
            at.temperature, at.temperature, 0.0, 24.0, 0.0,
        ))  # fmt: skip
    return BenchPoints(*np.array(rows).T)


def _box(study: Study) -> BenchBox:
    return rig_box(study.recording, load_pump("ref90"))


def _repeated(points: BenchPoints, count: int) -> BenchPoints:
    return replace(points, **{name: np.repeat(value, count) for name, value in vars(points).items()})


@pytest.mark.parametrize("true", [_square, _fast])
def test_next_point_separates_twice_as_well_as_one_more_of_the_same(true: Law) -> None:
    """The gate of diagnosis.md 2.3: at least twice the separation of a reading at the campaign's median point."""
    study, first, second = _rivals(true, seed=5)
    found = next_point(study, load_pump("ref90"), _box(study), first, second, LIMITS)
    per_point = _gains(study, first, second, _points())
    assert found.gain >= 2 * np.median(per_point)
    assert found.gain == pytest.approx(_gains(study, first, second, _asked(found))[0], rel=1e-9)
    assert found.separates == (EffectId.ELASTIC_OPENING, EffectId.FILM_HEATING)


def test_next_point_leaves_the_line_that_the_campaign_ran_along() -> None:
    """Speed and pressure went together: what separates p^2 from p n is to take them apart."""
    study, first, second = _rivals(_square, seed=5)
    found = next_point(study, load_pump("ref90"), _box(study), first, second, LIMITS)
    apart = found.point.shaft_speed / SPEED - found.point.delivery_pressure / PRESSURE
    assert abs(apart) > 0.3
    assert found.expected.channel == "Q_case"
    assert found.expected.apart > 0.0


def test_ln_odds_have_the_mean_and_scatter_that_is_predicted() -> None:
    """Draw readings from one forecast and weigh them by both: the mean of ln odds is the divergence."""
    rng = np.random.default_rng(3)
    factors = [rng.normal(size=(3, 3)) + 2 * np.eye(3) for _ in range(2)]
    one, other = (factor @ factor.T for factor in factors)
    apart = rng.normal(size=3)
    draws = np.linalg.cholesky(one) @ rng.normal(size=(3, 200000))

    def log_density(offset: Array, covariance: Array) -> Array:
        white = np.linalg.solve(np.linalg.cholesky(covariance), offset)
        return np.asarray(-0.5 * (white**2).sum(axis=0) - 0.5 * np.linalg.slogdet(covariance)[1])

    odds = log_density(draws, one) - log_density(draws - apart[:, None], other)
    told = odds_forecast(apart, one, other)
    assert told.mean == pytest.approx(odds.mean(), abs=4 * odds.std() / np.sqrt(odds.size))
    fourth = float(((odds - odds.mean()) ** 4).mean())
    assert told.sigma**2 == pytest.approx(odds.var(), abs=4 * np.sqrt(fourth / odds.size))
    assert odds_forecast(np.zeros(3), one, one).mean == pytest.approx(0.0, abs=1e-12)


def test_readings_with_memory_are_worth_fewer() -> None:
    """Of a first-order memory rho, n in a row are worth (n - (n - 2) rho)/(1 + rho): variance of the best mean."""
    assert independent(3, ()) == 3.0
    for count in (1, 3, 12):
        assert independent(count, (0.3,)) == pytest.approx((count - (count - 2) * 0.3) / 1.3)


def test_what_the_test_promises_comes_about() -> None:
    """Of pairs fitted to drawn recordings, as many settle by drawn readings as the chance says."""
    settled, predicted, reached = [], [], []
    for seed in range(24):
        study, first, second = _rivals(_square, seed, size=0.03)
        found = next_point(study, load_pump("ref90"), _box(study), first, second, LIMITS)
        place = _repeated(_asked(found), LIMITS.readings)
        rng = np.random.default_rng(1000 + seed)
        foretold = outlook(study, first, second, _asked(found)).foretold()
        one = foretold.together(np.arange(len(found.places))).odds(LIMITS.readings)[0]
        flow = place.p_out / PRESSURE * LPM + 0.03 * LPM * _square(place) + SIGMA * rng.normal(size=len(place.speed))
        odds = log_density(study, first, place, flow[:, None]) - log_density(study, second, place, flow[:, None])
        settled.append(found.before + odds >= LIMITS.settled)
        predicted.append(one.chance(LIMITS.settled - found.before))
        reached.append((odds - one.mean) / one.sigma)
    assert abs(np.mean(reached)) < 3 / np.sqrt(24)
    spread = np.sqrt(np.sum(np.array(predicted) * (1 - np.array(predicted)))) / 24
    assert abs(np.mean(settled) - np.mean(predicted)) < 3 * spread
    assert 0.1 < np.mean(predicted) < 0.98


def test_several_points_are_asked_for_where_one_does_not_settle() -> None:
    """Three different points at most, together worth more than the best read three times as often."""
    study, first, second = _rivals(_square, seed=5, size=0.02)
    first, second = (replace(one, probability=0.5) for one in (first, second))
    found = next_point(study, load_pump("ref90"), _box(study), first, second, LIMITS)
    each = outlook(study, first, second, _asked(found)).foretold().each()
    assert not found.settles or len(found.places) > 1
    assert 2 <= len(found.places) <= 3
    assert found.readings == LIMITS.readings * len(found.places)
    assert found.gain > max(each.gain(LIMITS.readings * len(found.places)))
    assert found.ranked[0].gain == pytest.approx(max(each.gain(LIMITS.readings)), rel=1e-9)


def test_readings_of_one_point_twice_are_twice_as_many() -> None:
    """Readings at several points are one vector that shares the parameters: the same point twice is its repeats."""
    study, first, second = _rivals(_square, seed=5)
    foretold = outlook(study, first, second, _points()).foretold()
    each = foretold.each()
    for at in (0, 11, 23):
        assert foretold.together(np.array([at])).gain(3) == pytest.approx(float(each.at(at).gain(3)), rel=1e-9)
        assert foretold.together(np.array([at, at])).gain(3) == pytest.approx(float(each.at(at).gain(6)), rel=1e-9)
    both = foretold.together(np.array([[0, 23], [5, 5]]))
    assert both.gain(3)[0] == pytest.approx(float(foretold.together(np.array([0, 23])).gain(3)), rel=1e-12)


def test_readings_speak_by_the_forecast_of_each_law() -> None:
    """Odds of a reading are those of two normal densities, each as wide as noise and parameters make it."""
    study, first, second = _rivals(_square, seed=5)
    point, reading = _repeated(_one_point(140.0), 1), np.array([[0.9 * LPM]])
    told, expected = [], []
    for one in (first, second):
        there = one.simulator.elsewhere(point)
        slopes = standard_slopes(there, one.posterior.xi)[0, 0]
        spread = np.sqrt(SIGMA**2 + slopes @ one.posterior.covariance @ slopes)
        told.append(log_density(study, one, point, reading))
        expected.append(norm.logpdf(reading[0, 0], there.predict(one.posterior.values)[0, 0], spread))
    assert told[0] - told[1] == pytest.approx(expected[0] - expected[1], rel=1e-9)


def test_no_point_is_said_to_settle_two_names_for_one_law() -> None:
    """Where nothing of the box parts two explanations, the best point brings nothing and none is promised."""
    study, first, _ = _rivals(_square, seed=5)
    second = replace(first, effects=(EffectId.FILM_HEATING,))
    found = next_point(study, load_pump("ref90"), _box(study), first, second, LIMITS)
    assert found.gain == pytest.approx(0.0, abs=1e-9)
    assert found.is_open
    assert not found.settles
    assert found.repeats is None


def test_box_holds_what_the_rig_can_do() -> None:
    """A tenth beyond the recorded range, within the rating; what was not measured stays as the pump states it."""
    pump = load_pump("ref90")
    points = _points()
    box = rig_box(_recording(points, points.p_out), pump)
    (slow, fast), (low, high), ratio, temperature = box.ends
    span = np.ptp(points.speed)
    assert fast == pytest.approx(min(points.speed.max() + 0.1 * span, pump.pump.rated_speed))
    assert 0 < slow < points.speed.min()
    assert (low, high) == pytest.approx((3.75 * MPA, 21.5 * MPA))  # half the least rise over 2.5 MPa
    assert ratio == (pump.operating.displacement_ratio,) * 2
    assert temperature == (pump.operating.temperature,) * 2
    grid = box.points((np.array([slow, fast]), np.array([low, high]), np.array([1.0]), np.array([320.0])))
    assert len(grid.speed) == 4
    assert set(grid.order) == {24.0}


def test_a_bench_elsewhere_is_the_bench_of_those_points() -> None:
    """A lumped bench moved to another point reads there what one made for it reads, laws and parameters kept."""
    pump = load_pump("ref90")
    here, there = (_one_point(speed) for speed in (100.0, 150.0))
    parameters = base_parameters(pump, tolerances(pump)[0])
    law = entry_of(EffectId.CHURNING).extensions[0].members[0]
    bench = LumpedBench(pump, here, (ChannelName.Q_CASE, ChannelName.TORQUE), parameters).with_extensions((law,))
    moved = bench.elsewhere(there)
    assert moved.parameters == bench.parameters
    values = np.array([parameter.centre for parameter in bench.parameters])
    own = LumpedBench(pump, there, bench.channels, bench.parameters, bench.physics)
    np.testing.assert_array_equal(moved.predict(values), own.predict(values))
    assert np.all(moved.predict(values) != bench.predict(values))


def _one_point(speed: float) -> BenchPoints:
    numbers = (speed, 1.0, 20 * MPA, 2.5 * MPA, 0.15 * MPA, 323.15, 323.15, 0.0, 0.0, 0.0)
    return BenchPoints(*(np.array([number]) for number in numbers))


def test_a_further_meter_brings_its_own_readings_and_calibration() -> None:
    """The drain of one gap beside the case drain: its column is the bench's own, and its gain is uncertain to both."""
    pump = load_pump("ref90")
    parameters = base_parameters(pump, tolerances(pump)[0])
    points = _one_point(150.0)
    bench = LumpedBench(pump, points, (ChannelName.Q_CASE,), parameters, inputs=())
    values = np.array([parameter.value(0.0) for parameter in parameters])
    flow = bench.predict(values)
    readings = Observations(
        (Channel("Q_case", Dimension.VOLUME_FLOW),), flow, np.full((1, 1), SIGMA), (), np.zeros((1, 0)), np.zeros(1),
        np.zeros(1, dtype=np.int64),
    )  # fmt: skip
    fit = linear_posterior(bench, readings)
    one = Contender((EffectId.CHURNING,), bench, fit, "one", 0.5)
    study = Study(_recording(_points(), np.ones(24)), bench, readings, fit, (), {}, np.zeros((1, 4)))
    sure, vague = (
        RecordedChannel(ChannelName.Q_SLIPPER, "", "", SIGMA, 0.0, 0.0, 0.0, gain, 0.0, ()) for gain in (0.0, 0.5)
    )
    found = outlook(study, one, one, points, (sure, vague))
    alone = LumpedBench(pump, points, (ChannelName.Q_SLIPPER,), parameters).predict(fit.values)
    np.testing.assert_allclose(found.first[:, 1], alone[:, 0], rtol=1e-12)
    assert found.foretold().difference.shape == (1, 1)
    spreads = [np.sum(found.foretold((meter,)).first[0, 1] ** 2) for meter in (sure, vague)]
    assert spreads[1] - spreads[0] == pytest.approx((0.5 * alone[0, 0] / SIGMA) ** 2, rel=1e-6)
