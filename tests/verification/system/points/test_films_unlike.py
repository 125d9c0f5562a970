"""Films at given positions of chambers that differ: written out one by one as alike, a worn piston, its neighbours."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from system import FilmsPoint, PumpDescription, films_point, load_pump, lumped_point, operating_point
from system.points.table.build import TableCase
from system.points.table.sources import FilmsSolver

COARSE = {"positions_per_pitch": 2, "finer": 0.25}
PUMP = load_pump("ref90", {"physics.film_heating.piston": "6.6e-5 m2 K/W", "physics.churning.factor": 1.0})
PISTONS = PUMP.pump.pistons
CLEARANCE = PUMP.piston.radial_clearance
WORN, WEAR = 2, 1.5  # chamber 3


def with_clearance(clearance: float) -> PumpDescription:
    """The pump with another radial clearance (m) of the third piston."""
    return replace(PUMP, single_pistons=((WORN + 1, replace(PUMP.piston, radial_clearance=clearance)),))


def solved(pump: PumpDescription) -> FilmsPoint:
    return films_point(pump, operating_point(pump), **COARSE)


@pytest.fixture(scope="module")
def alike() -> FilmsPoint:
    return solved(PUMP)


@pytest.fixture(scope="module")
def worn() -> FilmsPoint:
    return solved(with_clearance(WEAR * CLEARANCE))


def leaked(point: FilmsPoint) -> np.ndarray:
    """Leakage of each chamber's piston in a turn (m3)."""
    return np.array([float(one.outflow.piston) for one in point.pump_point.chambers])


@pytest.mark.slow
def test_chambers_written_out_one_by_one_are_the_pump_that_is_alike(alike):
    """A clearance that differs by rounding alone: other ways, the same numbers, films of the ring over the turn."""
    written = solved(with_clearance(CLEARANCE * (1.0 + 1e-12)))
    assert [one.chambers for one in written.kinds] == [(0, 1, 3, 4, 5, 6, 7, 8), (WORN,)]
    assert len(written.gaps.valve_plate) == PISTONS * len(alike.gaps.valve_plate)
    one, other = alike.pump_point, written.pump_point
    for tell in (
        lambda point: point.bench.delivery_flow,
        lambda point: point.bench.drain_flow,
        lambda point: point.bench.shaft_torque,
        lambda point: point.leakage_flow.piston,
        lambda point: point.leakage_flow.valve_plate,
        lambda point: point.power.friction,
        lambda point: float(np.mean(point.shaft_torque)),
    ):
        assert tell(other) == pytest.approx(tell(one), rel=1e-7)
    assert written.sampling_error == pytest.approx(alike.sampling_error, rel=1e-5)
    assert 0.0 < alike.sampling_error < 0.05
    np.testing.assert_allclose(written.gaps.flow, alike.gaps.flow, rtol=1e-5, atol=1e-6 * alike.gaps.flow.max())


@pytest.mark.slow
def test_one_worn_piston_of_nine_leaks_as_one_of_nine(alike, worn):
    """Between the pump as drawn and the one that is worn all over; what the others leak stays."""
    over = replace(PUMP, piston=replace(PUMP.piston, radial_clearance=WEAR * CLEARANCE))
    all_worn = solved(over)
    more = leaked(worn) / leaked(alike)[0]
    assert np.delete(more, WORN) == pytest.approx(np.ones(PISTONS - 1), rel=1e-3)
    assert leaked(worn)[WORN] == pytest.approx(leaked(all_worn)[0], rel=1e-3)
    share = 1.0 / PISTONS
    for tell in (
        lambda point: point.leakage_flow.piston,
        lambda point: point.bench.drain_flow,
        lambda point: point.bench.delivery_flow,
        lambda point: point.pairs.piston_cylinder.mean_viscous,
    ):
        ends = tell(alike.pump_point), tell(all_worn.pump_point)
        expected = (1.0 - share) * ends[0] + share * ends[1]
        assert tell(worn.pump_point) == pytest.approx(expected, abs=2e-3 * abs(ends[1] - ends[0]))


@pytest.mark.slow
def test_balances_close_and_the_torque_pulses_once_a_turn(alike, worn):
    checks = worn.pump_point.checks
    assert checks.energy_balance_error == pytest.approx(alike.pump_point.checks.energy_balance_error, abs=1e-4)
    assert checks.mass_balance_error < 1e-9
    orders = np.abs(np.fft.rfft([alike.pump_point.shaft_torque, worn.pump_point.shaft_torque]))
    assert orders[0, 1] < 1e-9 * orders[0, 0] < orders[1, 1]


@pytest.mark.slow
def test_films_and_closed_laws_agree_about_the_worn_piston(alike, worn):
    """Added leakage of the wider gap, by its films and by the cube of its clearance: the warm films leak 8 % more."""
    lumped = [lumped_point(one, operating_point(one)) for one in (PUMP, with_clearance(WEAR * CLEARANCE))]
    by_law = np.subtract(*(one.leakage_flow.piston for one in reversed(lumped)))
    by_films = worn.pump_point.leakage_flow.piston - alike.pump_point.leakage_flow.piston
    assert by_films == pytest.approx(by_law, rel=0.1)


def test_a_response_table_of_such_a_pump_is_refused():
    case = TableCase(with_clearance(WEAR * CLEARANCE), FilmsSolver(2), (), 1, 1)
    with pytest.raises(ValueError, match="expected chambers that are alike"):
        case.solve(np.zeros(0))
