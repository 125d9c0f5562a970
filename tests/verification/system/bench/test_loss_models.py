"""Loss models of the literature: each finds its own coefficients again, within its bounds."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from reynolds import Array, InputError
from system import INPUTS, BenchPoints, Channel, ChannelName, Observations, load_pump, maximum_posterior
from system.bench.calibration.held_out import Split, model_rows, split_levels
from system.bench.loss_models.bench import LossModelBench, loss_model_bench
from system.bench.loss_models.catalogue import LOSS_MODELS
from system.bench.loss_models.model import LossModel, LossModelName
from system.bench.loss_models.orders import polymod_for
from system.bench.loss_models.polynomials import Orders, polymod

PUMP = load_pump("ref90")
GRID = np.array(list(product((1000, 1300, 1700, 2100), (5e6, 12e6, 18e6, 25e6, 35e6), (0.28, 0.51, 0.77, 1.0))))


def _points() -> BenchPoints:
    """Levels of speed, pressure and displacement; the case warmer from point to point, so that viscosity moves."""
    count = len(GRID)
    held = {"p_in": 2e6, "p_case": 1e5, "T_in": 320.0, "warming": 0.0}
    return BenchPoints(
        speed=GRID[:, 0] * np.pi / 30,
        p_out=GRID[:, 1],
        displacement_ratio=GRID[:, 2],
        T_case=np.linspace(310.0, 340.0, count)[np.random.default_rng(1).permutation(count)],
        hours=np.arange(count, dtype=float),
        order=np.arange(count, dtype=float),
        **{name: np.full(count, value) for name, value in held.items()},
    )


POINTS = _points()


def _readings(values: Array) -> Observations:
    flow, torque = Channel("Q_out", ChannelName.Q_OUT.dimension), Channel("torque", ChannelName.TORQUE.dimension)
    return Observations(
        channels=(flow, torque),
        values=values,
        sigma=np.tile([0.1 / 6e4, 0.3], (len(values), 1)),
        inputs=tuple(channel.value for channel in INPUTS),
        input_sigma=np.zeros((len(values), len(INPUTS))),
        quantum=np.zeros(2),
        blocks=np.arange(len(values)),
    )


def _bench(model: LossModel) -> LossModelBench:
    return loss_model_bench(model, PUMP, POINTS, INPUTS)


def _made(bench: LossModelBench, seed: int = 2) -> Array:
    """Coefficients of a few percent of the ideal flow and torque, of the sign that each may have."""
    size = np.random.default_rng(seed).uniform(0.002, 0.02, len(bench.parameters))
    return np.array([number * parameter.spread for number, parameter in zip(size, bench.parameters, strict=True)])


@pytest.mark.parametrize("name", list(LOSS_MODELS))
def test_a_model_finds_its_own_coefficients(name: LossModelName) -> None:
    """Without noise: what is left is the pull of priors as wide as the whole flow, below a tenth of a sigma."""
    bench = _bench(LOSS_MODELS[name])
    values = _made(bench)
    found = maximum_posterior(bench, _readings(bench.predict(values)))
    sigma = np.array([found.sigma(parameter.name) for parameter in bench.parameters])
    assert np.all(np.abs(found.values - values) < 0.1 * sigma)
    assert np.sqrt(np.mean(found.residual**2)) < 0.01


@pytest.mark.parametrize("name", list(LOSS_MODELS))
def test_polynomials_and_laws_have_the_terms_of_their_print(name: LossModelName) -> None:
    counts = {"wilson": (2, 3), "schlosser": (2, 4), "mccandlish_dorey": (5, 6), "zarotti_nevegna": (6, 7)}
    model = LOSS_MODELS[name]
    assert (len(model.flow), len(model.torque)) == counts.get(name.value, (27, 27))
    assert model.source


def test_wilson_by_hand() -> None:
    """One point: C_s D dp/mu of slip, C_d D mu w + C_f D dp + T_c of drag."""
    bench = _bench(LOSS_MODELS[LossModelName.WILSON])
    from system.bench.loss_models.points import loss_points

    at = loss_points(PUMP, POINTS)
    values = np.array([2e-9, 1e-6, 3e4, 0.02, 1.5])
    one = {name: getattr(at, name)[7] for name in ("speed", "pressure_difference", "ratio", "viscosity")}
    d = at.displacement / (2 * np.pi)
    flow = one["ratio"] * d * one["speed"] - 2e-9 * d * one["pressure_difference"] / one["viscosity"] - 1e-6
    torque = (one["ratio"] + 0.02) * d * one["pressure_difference"] + 3e4 * d * one["viscosity"] * one["speed"] + 1.5
    assert bench.predict(values)[7] == pytest.approx([flow, torque], rel=1e-12)


def test_schlosser_by_hand() -> None:
    """One point: C_st V^(2/3) sqrt(2 dp/rho) of slip and C_h rho w^2 V^(5/3) of drag beside Wilson's."""
    from system.bench.loss_models.points import loss_points

    bench, at = _bench(LOSS_MODELS[LossModelName.SCHLOSSER]), loss_points(PUMP, POINTS)
    names = [parameter.name for parameter in bench.parameters]
    assert [name.rpartition(".")[2] for name in names] == ["C_s", "C_st", "C_d", "C_f", "C_h", "T_c"]
    values = np.array([2e-9, 1e-4, 3e4, 0.02, 40.0, 1.5])
    one = {name: getattr(at, name)[7] for name in ("speed", "pressure_difference", "ratio", "viscosity")}
    d = at.displacement / (2 * np.pi)
    slip = 2e-9 * d * one["pressure_difference"] / one["viscosity"]
    slip += 1e-4 * at.displacement ** (2 / 3) * np.sqrt(2 * one["pressure_difference"] / at.density)
    drag = 3e4 * d * one["viscosity"] * one["speed"] + 0.02 * d * one["pressure_difference"] + 1.5
    drag += 40.0 * at.density * one["speed"] ** 2 * at.displacement ** (5 / 3)
    expected = [one["ratio"] * d * one["speed"] - slip, one["ratio"] * d * one["pressure_difference"] + drag]
    assert bench.predict(values)[7] == pytest.approx(expected, rel=1e-12)


def test_slip_and_friction_are_not_negative() -> None:
    """Readings that ask for a negative slip get none; plain least squares would give it."""
    bench = _bench(LOSS_MODELS[LossModelName.WILSON])
    values = _made(bench)
    values[0] *= -1.0
    found = maximum_posterior(bench, _readings(bench.predict(values)))
    assert found.values[0] == 0.0
    assert np.all(found.values[2:] >= 0.0)


def test_polymod_takes_the_orders_that_are_there() -> None:
    """Made of orders (1, 2, 1) and (2, 1, 2) with noise; four levels bear order 2, five order 3."""
    truth = _bench(polymod(Orders(1, 2, 1), Orders(2, 1, 2)))
    noise = np.random.default_rng(5).standard_normal((len(GRID), 2)) * [0.1 / 6e4, 0.3]
    found = polymod_for(PUMP, POINTS, INPUTS, _readings(truth.predict(_made(truth)) + noise))
    assert (len(found.flow), len(found.torque)) == (12, 18)


def test_polymod_is_bounded_by_the_levels() -> None:
    """Three levels of speed bear a line only, one level nothing, whatever is in the readings."""
    truth = _bench(polymod(Orders(2, 2, 2), Orders(2, 2, 2)))
    readings = _readings(truth.predict(_made(truth)))
    three = readings.without(GRID[:, 0] == 2100)
    assert all(term.name[1] in "01" for term in polymod_for(PUMP, POINTS, INPUTS, three).flow)
    one = readings.without(GRID[:, 0] < 2100)
    assert all(term.name[1] == "0" for term in polymod_for(PUMP, POINTS, INPUTS, one).torque)


def test_levels_left_out_are_predicted_without_them() -> None:
    """Of a model's own readings everything left out is predicted; a wild level spoils only its own fold."""
    bench = _bench(LOSS_MODELS[LossModelName.WILSON])
    readings = _readings(bench.predict(_made(bench)))
    rows = model_rows(LossModelName.WILSON, PUMP, POINTS, INPUTS, readings)
    assert {row.split for row in rows} == set(Split)
    assert all(row.rms < 0.05 * row.noise for row in rows)
    wild = readings.values.copy()
    wild[GRID[:, 0] == 1300, 1] += 30.0
    spoilt = model_rows(LossModelName.WILSON, PUMP, POINTS, INPUTS, replace(readings, values=wild))
    speed = next(row for row in spoilt if row.split is Split.SPEED and row.channel is ChannelName.TORQUE)
    assert speed.rms > 30.0 / 2.0


def test_levels_of_a_bench() -> None:
    found = split_levels(POINTS)
    assert [found[split].max() + 1 for split in (Split.SPEED, Split.PRESSURE, Split.DISPLACEMENT)] == [4, 5, 4]


def test_a_missing_channel_is_told() -> None:
    readings = _readings(np.ones((len(GRID), 2)))
    other = replace(readings, channels=(readings.channels[0], Channel("Q_in", None)))
    with pytest.raises(InputError, match="no torque"):
        model_rows(LossModelName.WILSON, PUMP, POINTS, INPUTS, other)
