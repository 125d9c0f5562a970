"""A calibrated pump: it runs to the readings of its fit and knows itself as well as the fit does."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import product

import numpy as np
import pytest
from bench_pump import BENCH

from system import (
    SIMULATED,
    BenchPoints,
    Channel,
    EffectId,
    Gap,
    LumpedBench,
    Observations,
    Posterior,
    base_parameters,
    entry_of,
    linear_posterior,
    load_pump,
    lumped_point,
    operating_at,
    tolerances,
)
from system.bench.calibration.extended_pump import calibrated_pump
from system.bench.calibration.hersey_curve import PAIRS, hersey_curves

PUMP = load_pump(BENCH)
GRID = np.array(list(product((1000.0, 2100.0), (10e6, 30e6), (0.5, 1.0))))
HELD = {"p_in": 2.5e6, "p_case": 1.5e5, "T_in": 323.0, "T_case": 326.0, "hours": np.nan, "warming": 0.0}
POINTS = BenchPoints(
    speed=GRID[:, 0] * np.pi / 30,
    p_out=GRID[:, 1],
    displacement_ratio=GRID[:, 2],
    order=np.arange(8.0),
    **{name: np.full(8, value) for name, value in HELD.items()},
)


@cache
def _bench() -> LumpedBench:
    return LumpedBench(PUMP, POINTS, SIMULATED, base_parameters(PUMP, tolerances(PUMP)[0]), inputs=())


@cache
def _fit() -> Posterior:
    """Of readings with more friction of the slippers and thinner oil than described."""
    bench = _bench()
    values = np.array([one.centre for one in bench.parameters])
    for name, factor in (("friction.slipper_swash_plate", 1.3), ("viscosity", 0.97)):
        values[[one.name for one in bench.parameters].index(name)] *= factor
    found = linear_posterior(bench, _made(bench.predict(values)))
    return replace(found, predictions=bench.predict(found.values))


def _made(read: np.ndarray) -> Observations:
    """Readings with the noise of a class A bench."""
    return Observations(
        channels=tuple(Channel(name.value, name.dimension) for name in SIMULATED),
        values=read,
        sigma=np.full_like(read, 1.0) * [2e-6, 2e-6, 3e-7, 0.3],
        inputs=(),
        input_sigma=np.zeros((8, 0)),
        quantum=np.zeros(4),
        blocks=np.arange(8),
    )


def test_it_runs_to_the_readings_of_its_fit() -> None:
    """Torque to a tenth of a sigma of a class A bench (.3 N m), flows to 1e-3: a map at its angles."""
    pump = calibrated_pump(PUMP, _fit())
    for at in (0, 7):
        found = lumped_point(pump, operating_at(pump, POINTS, at)).bench
        expected = _fit().predictions[at]
        assert found.delivery_flow == pytest.approx(expected[0], rel=1e-3)
        assert found.shaft_torque == pytest.approx(expected[3], abs=0.03)


def test_its_tolerance_is_what_the_fit_leaves() -> None:
    fit, pump = _fit(), calibrated_pump(PUMP, _fit())
    stated = PUMP.tolerance.friction or tolerances(PUMP)[0].friction
    sigma = {one.name: fit.sigma(one.name) / value for one, value in zip(fit.parameters, fit.values, strict=True)}
    widest = max(
        sigma[f"friction.{name}"]
        for name in ("piston_cylinder", "slipper_swash_plate", "valve_plate_cylinder", "piston_slipper_socket")
    )
    assert pump.tolerance.friction == pytest.approx(widest, rel=1e-9)
    assert widest <= stated * (1 + 1e-9)
    assert pump.tolerance.guide_friction == pytest.approx(sigma["friction.ball_guide_retainer"], rel=1e-9)
    assert pump.tolerance.viscosity == pytest.approx(sigma["viscosity"], rel=1e-9)


@pytest.mark.parametrize(
    ("name", "xi"), [("eccentricity_ratio", 2.0), ("eccentricity_ratio", -1.5), ("displacement", 40.0)]
)
def test_a_tolerance_is_that_of_the_value_in_the_file(name, xi) -> None:
    """Far from the stated value: of an eccentricity, fitted by its square, and of a factor on the displacement."""
    fit = _fit()
    at = fit.index(name)
    parameter = fit.parameters[at]
    moved = replace(fit, xi=np.where(np.arange(fit.xi.size) == at, xi, fit.xi))
    moved = replace(moved, values=np.where(np.arange(fit.xi.size) == at, parameter.value(xi), fit.values))
    width = np.sqrt(fit.covariance[at, at])
    lower, upper = (parameter.value(xi + side * 1e-4 * width) for side in (-1.0, 1.0))
    expected = (upper - lower) / 2e-4
    if name == "displacement":
        expected /= parameter.value(xi)
    assert getattr(calibrated_pump(PUMP, moved).tolerance, name) == pytest.approx(expected, rel=1e-6)


def test_a_value_at_a_bound_keeps_its_tolerance() -> None:
    """Its sigma, of the slope at the bound, says nothing."""
    fit = _fit()
    at = fit.index("dead_volume")
    bound = fit.parameters[at].highest
    held = replace(fit, xi=np.where(np.arange(fit.xi.size) == at, bound, fit.xi))
    assert list(np.flatnonzero(held.at_bounds)) == [at]
    assert not fit.at_bounds.any()
    stated = tolerances(PUMP)[0].dead_volume
    assert calibrated_pump(PUMP, held).tolerance.dead_volume == pytest.approx(stated)
    assert calibrated_pump(PUMP, fit).tolerance.dead_volume < 0.999 * stated


def test_a_share_of_the_inlet_keeps_its_tolerance() -> None:
    """A fit knows it better, but its value is in no file: a narrow prior about a half would be another pump's."""
    pump = load_pump(BENCH, {"tolerance.inlet_share": 0.3})
    parameters = base_parameters(pump, tolerances(pump)[0])
    bench = LumpedBench(pump, POINTS, SIMULATED, parameters, inputs=())
    fit = linear_posterior(bench, _made(bench.predict(np.array([one.centre for one in parameters]))))
    assert fit.sigma("inlet_share") < 0.2
    assert calibrated_pump(pump, fit).tolerance.inlet_share == 0.3


def test_constant_friction_is_a_level_line() -> None:
    fit = _fit()
    for curve in hersey_curves(_bench(), fit):
        name = f"friction.{PAIRS[curve.gap].value}"
        assert curve.friction == pytest.approx(float(fit.values[fit.index(name)]), rel=1e-12)
        assert curve.sigma == pytest.approx(fit.sigma(name), rel=1e-3)
        assert np.all(np.diff(curve.number) > 0)


def test_friction_falls_with_the_hersey_number_by_the_law() -> None:
    """f_c + f_b exp(-(H/H0)^d) with the law's own values; most at the least number."""
    law = entry_of(EffectId.MIXED_FRICTION).extensions[0].members[2]
    bench = _bench().with_extensions((law,))
    xi = np.concatenate([_fit().xi, [0.8] * len(law.parameters), np.zeros(len(law.free) - len(law.parameters))])
    count = len(xi)
    fit = replace(_fit(), parameters=bench.parameters, xi=xi, precision=np.eye(count))
    fit = replace(fit, values=np.array([one.value(float(at)) for one, at in zip(fit.parameters, xi, strict=True)]))
    curve = next(one for one in hersey_curves(bench, fit, (law,)) if one.gap is Gap.PISTON)
    scale, exponent = law.grid[0]["hersey_scale"], law.grid[0]["exponent"]
    constant = fit.values[fit.index("friction.piston_cylinder")]
    expected = constant + 0.8 * 0.05 * np.exp(-((curve.number / scale) ** exponent))
    assert curve.friction == pytest.approx(expected, rel=1e-9)


def test_stated_mixed_friction_is_part_of_the_curve() -> None:
    """[physics.mixed_friction] of the pump itself, which no fit changes, adds to the constant coefficient."""
    stated = {"piston": 0.05, "slipper": 0.0, "valve_plate": 0.0, "hersey_scale": 1e-6, "exponent": 1.2}
    pump = load_pump(BENCH, {f"physics.mixed_friction.{key}": value for key, value in stated.items()})
    bench = LumpedBench(pump, POINTS, SIMULATED, _bench().parameters, inputs=())
    for curve in hersey_curves(bench, _fit()):
        name = f"friction.{PAIRS[curve.gap].value}"
        added = stated[curve.gap.value] * np.exp(-((curve.number / 1e-6) ** 1.2))
        assert curve.friction == pytest.approx(_fit().values[_fit().index(name)] + added, rel=1e-12)
        assert curve.sigma == pytest.approx(_fit().sigma(name), rel=1e-3)
