"""Eq. (21): what the hydromechanical loss says about seven friction coefficients."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import product

import numpy as np
import pytest

from system import INPUTS, SIMULATED, BenchPoints, Channel, LumpedBench, Observations, load_pump, maximum_posterior
from system.bench.calibration.equation_21 import (
    EqTwentyOne,
    eq_fits,
    eq_twenty_one,
    measured_losses,
    paper_priors,
    unstated_priors,
)
from system.description.tolerance import DrawnSection, Shape
from system.pump.laws.friction_pairs import Pair

PUMP = load_pump("ref90")
GRID = np.array(list(product((1000, 1700, 2100), (5e6, 10e6, 15e6, 20e6, 25e6, 30e6, 35e6), (0.28, 0.51, 1.0))))
RPM = np.pi / 30


def _points() -> BenchPoints:
    count = len(GRID)
    held = {"p_in": 2.5e6, "p_case": 1.5e5, "T_in": 323.0, "T_case": 326.0, "warming": 0.0}
    return BenchPoints(
        speed=GRID[:, 0] * RPM,
        p_out=GRID[:, 1],
        displacement_ratio=GRID[:, 2],
        hours=np.full(count, np.nan),
        order=np.arange(count, dtype=float),
        **{name: np.full(count, value) for name, value in held.items()},
    )


POINTS = _points()


@cache
def _bench() -> LumpedBench:
    return LumpedBench(PUMP, POINTS, SIMULATED, paper_priors(PUMP)[0])


@cache
def _eq() -> EqTwentyOne:
    bench = _bench()
    centre = np.array([one.centre for one in bench.parameters])
    return eq_twenty_one(bench, centre, bench.parameters)


def _observed(values: np.ndarray) -> Observations:
    """The bench's readings as a recording of class A would have them."""
    sigma = np.abs(values) * [6e-4, 1e-3, 4e-3, 6e-4] + [0.08 / 6e4, 0.12 / 6e4, 0.015 / 6e4, 0.25]
    return Observations(
        channels=tuple(Channel(name.value, name.dimension) for name in SIMULATED),
        values=values,
        sigma=sigma,
        inputs=tuple(name.value for name in INPUTS),
        input_sigma=np.tile([0.05, 0.0, 1.5e4, 2e3, 1e3, 0.15, 0.2], (len(values), 1)),
        quantum=np.zeros(len(SIMULATED)),
        blocks=np.arange(len(values)),
    )


def test_the_equation_is_exact_in_the_coefficients() -> None:
    """Eq. (2) of readings simulated at other coefficients = rest + sum of coefficient x column."""
    bench, factors = _bench(), np.array([1.3, 0.8, 1.1, 0.9, 1.02, 1.2, 0.85])
    values = np.array([one.centre for one in bench.parameters]) * factors
    loss = measured_losses(POINTS, _observed(bench.predict(values))).values
    assert _eq().predict(values) == pytest.approx(loss, rel=1e-9)


def test_friction_that_a_law_adds_goes_with_no_coefficient() -> None:
    """A pump with [physics.mixed_friction]: its boundary friction stays while the coefficients change."""
    law = {"piston": 0.05, "slipper": 0.05, "valve_plate": 0.05, "hersey_scale": 1e-6, "exponent": 1.0}
    pump = load_pump("ref90", {f"physics.mixed_friction.{key}": value for key, value in law.items()})
    few = replace(POINTS, **{name: values[::9] for name, values in vars(POINTS).items()})
    bench = LumpedBench(pump, few, SIMULATED, paper_priors(pump)[0])
    centre = np.array([one.centre for one in bench.parameters])
    values = centre * np.array([1.3, 0.8, 1.1, 0.9, 1.02, 1.2, 0.85])
    loss = measured_losses(few, _observed(bench.predict(values))).values
    eq = eq_twenty_one(bench, centre, bench.parameters)
    assert eq.predict(values) == pytest.approx(loss, rel=1e-9)
    own = LumpedBench(PUMP, few, SIMULATED, paper_priors(PUMP)[0])
    assert eq.columns == pytest.approx(eq_twenty_one(own, centre, own.parameters).columns, rel=1e-9)


def test_one_speed_and_displacement_have_rank_two() -> None:
    """Every pair's loss is a straight line of pressure there: seven coefficients, two that could be told apart.

    The paper tunes seven from these (its Fig. 13). The whole map tells more, never the bearings from each other.
    """
    readings = measured_losses(POINTS, _observed(_bench().predict(_eq_values())))
    *cells, whole = eq_fits(_eq(), readings, POINTS, PUMP.pump.rated_speed)
    assert [cell.ratio for cell in cells] == pytest.approx([0.28, 0.51, 1.0])
    assert [cell.rank for cell in cells] == [2, 2, 2]
    assert all(cell.known <= 2 for cell in cells)
    assert all(cell.condition > 1e3 for cell in cells)
    assert 3 <= whole.rank < 7
    shrunk = {one.name: whole.posterior.sigma(one.name) / one.stretch(0.0) for one in whole.posterior.parameters}
    assert shrunk["friction.slipper_swash_plate"] < 0.3
    assert shrunk["friction.front_bearing"] > 0.95


def _eq_values() -> np.ndarray:
    return np.array([one.centre for one in _eq().parameters])


def test_planted_coefficients_lie_within_the_posterior() -> None:
    """200 pumps drawn from priors of a third of the width: intervals hold as often as they say.

    Within 4 sigma of a count of 200, and .02 for the logarithm's bend.
    """
    rng, eq = np.random.default_rng(21), _eq()
    eq = eq.with_parameters(tuple(one.widened(0.3) for one in eq.parameters))
    sigma, inside = 0.01 * eq.predict(_eq_values()), []
    for _ in range(200):
        xi = rng.standard_normal(len(eq.parameters))
        true = np.array([one.value(float(at)) for one, at in zip(eq.parameters, xi, strict=True)])
        loss = eq.predict(true) + sigma * rng.standard_normal(sigma.shape)
        fit = maximum_posterior(eq, _loss_readings(loss, sigma))
        inside.append(np.abs(fit.xi - xi) / np.sqrt(np.diag(fit.covariance)))
    for limit, share in ((1.0, 0.683), (1.96, 0.95)):
        allowed = 4.0 * np.sqrt(share * (1 - share) / 200) + 0.02
        assert np.all(np.abs((np.array(inside) < limit).mean(axis=0) - share) < allowed)


def _loss_readings(loss: np.ndarray, sigma: np.ndarray) -> Observations:
    empty = np.zeros((len(loss), 0))
    channel = Channel("hydromechanical_loss", None)
    return Observations((channel,), loss, sigma, (), empty, np.zeros(1), np.arange(len(loss)))


def test_bounds_hold() -> None:
    """A loss that asks for twelve times the slippers' friction gets the bound, no coefficient is negative."""
    eq = _eq()
    names = [one.name for one in eq.parameters]
    asked = _eq_values()
    asked[names.index("friction.slipper_swash_plate")] *= 12.0
    loss = eq.predict(asked)
    fit = maximum_posterior(eq, _loss_readings(loss, 1e-4 * loss))
    upper = np.array([one.upper for one in eq.parameters])
    lower = np.array([one.lower for one in eq.parameters])
    assert np.all((fit.values <= upper * (1 + 1e-9)) & (fit.values >= lower * (1 - 1e-9)))
    assert np.any(np.isclose(fit.values, upper, rtol=1e-6))


def test_coefficients_that_hold_the_shear_leave_none_of_it() -> None:
    """Mixed: the rest is less by the films' shear; a loss made so gives its coefficients back, within 4 sigma."""
    eq = _eq()
    assert eq.mixed.rest + eq.shear == pytest.approx(eq.rest)
    assert eq.shear.min() > 0.0
    planted = _eq_values() * 1.1
    loss = eq.mixed.predict(planted)
    *_, whole = eq_fits(eq.mixed, _loss_readings(loss, 1e-3 * loss), POINTS, PUMP.pump.rated_speed)
    off = (whole.posterior.values - planted) / [whole.posterior.sigma(one.name) for one in eq.parameters]
    assert np.abs(off).max() < 4.0


def test_bounds_that_bite_do_not_stop_the_fit_where_it_starts() -> None:
    """The shear held in the coefficients drives several to their bounds: no single change betters the place."""
    eq = _eq()
    loss = eq.predict(_eq_values())
    *_, whole = eq_fits(eq.mixed, _loss_readings(loss, 2e-3 * loss), POINTS, PUMP.pump.rated_speed)
    xi = whole.posterior.xi

    def objective(at: np.ndarray) -> float:
        values = np.array([one.value(float(each)) for one, each in zip(eq.parameters, at, strict=True)])
        missed = (loss - eq.mixed.predict(values))[:, 0] / (2e-3 * loss[:, 0])
        return float(missed @ missed + at @ at)

    best = objective(xi)
    assert best < 0.5 * objective(np.zeros(xi.size))
    for k, one in enumerate(eq.parameters):
        for step in (-0.02, 0.02):
            moved = xi.copy()
            moved[k] = np.clip(moved[k] + step, one.lowest, one.highest)
            assert objective(moved) > best - 1e-3 * best


def test_a_coefficient_far_from_the_papers_keeps_its_tolerance() -> None:
    friction = replace(PUMP.friction, piston_cylinder=0.2, rear_bearing=0.0)
    priors, told = paper_priors(replace(PUMP, friction=friction))
    names = [one.name for one in priors]
    assert "friction.piston_cylinder" not in names
    assert "friction.rear_bearing" not in names
    assert len(told) == 1
    assert "0.2" in told[0]


def test_the_noise_of_the_loss_is_that_of_its_readings() -> None:
    """Against 300 draws of readings and inputs of every ninth point: their scatter, within 4 sigma of its own."""
    few = replace(POINTS, **{name: values[::9] for name, values in vars(POINTS).items()})
    values = _bench().predict(_eq_values())[::9]
    observed, rng, draws = _observed(values), np.random.default_rng(3), []
    stated = measured_losses(few, observed).sigma[:, 0]
    for _ in range(300):
        drawn = values + observed.sigma * rng.standard_normal(values.shape)
        moved = {
            name: getattr(few, name) + observed.input_sigma[:, at] * rng.standard_normal(len(values))
            for at, name in enumerate(observed.inputs)
        }
        draws.append(measured_losses(replace(few, **moved), replace(observed, values=drawn)).values[:, 0])
    scatter = np.std(draws, axis=0, ddof=1)
    assert np.all(np.abs(scatter / stated - 1.0) < 4.0 / np.sqrt(2 * 299))


def test_the_papers_ranges_stand_only_where_no_tolerance_is_stated() -> None:
    """A sigma of [tolerance], of its key or of the drawing, keeps its coefficients from the paper's ranges."""
    drawn = DrawnSection(key="friction.piston_cylinder", shape=Shape.NORMAL, sigma="0.002")
    part = replace(PUMP.tolerance, friction=None, bearing_friction=None, dimension=(drawn,))
    priors, told = unstated_priors(replace(PUMP, tolerance=part))
    names = {one.name.rpartition(".")[2] for one in priors}
    stated = {"ball_guide_retainer", "piston_cylinder"}
    assert names == {pair.value for pair in Pair} - stated
    assert all("the paper's" in note for note in told)
    assert unstated_priors(PUMP) == ((), ())
