"""Incomplete filling of chambers behind an inlet line with losses, against the closed form."""

from math import pi, sqrt

import numpy as np
import pytest
from bench_pump import BENCH

from system import PumpDescription, PumpPoint, load_pump, lumped_point, opening_area, operating_point, port_openings
from system.effects.laws.filling import filled_share
from system.pump.chamber.layout import CAVITY_PRESSURE

RPM = pi / 30
LOST = {1000.0: 10e3, 2100.0: 46e3, 3000.0: 94e3, 3600.0: 135e3}
REF90 = load_pump(BENCH)


def _behind(loss: float) -> PumpDescription:
    return load_pump(BENCH, {"physics.incomplete_filling.inlet_loss": loss})


def _point(pump: PumpDescription, rpm: float, inlet: float) -> PumpPoint:
    at = operating_point(
        pump, shaft_speed=rpm * RPM, delivery_pressure=10e6, inlet_pressure=inlet, case_pressure=0.0,
        displacement_ratio=1.0, temperature=323.15,
    )  # fmt: skip
    return lumped_point(pump, at)


def _lost_at_suction(found: PumpPoint) -> float:
    """Shortfall of a chamber below the inlet's pressure about the middle of its suction stroke, Pa."""
    about = np.abs(found.cycle.shaft_angle - pi / 2.0) < 0.5
    return found.point.inlet_pressure - float(found.cycle.pressure[about].min())


def _filled(loss: float, rpm: float, inlet: float) -> float:
    """Of what flows in where nothing is lost."""
    return _point(_behind(loss), rpm, inlet).bench.inlet_flow / _point(REF90, rpm, 2e6).bench.inlet_flow


@pytest.mark.parametrize("rpm", list(LOST))
def test_suction_loss(validation, rpm):
    validation(
        case="Suction loss of REF90",
        source="closed form, orifice law of the kidney",
        quantity=f"pressure lost at {rpm:.0f} r/min",
        unit="Pa",
        expected=LOST[rpm],
        obtained=_lost_at_suction(_point(REF90, rpm, 5e5)),
        tolerance=0.75e3,
    )


@pytest.mark.parametrize("loss", [1.0, 4.0])
def test_a_line_loses_its_share_of_what_the_kidneys_lose(loss):
    assert _lost_at_suction(_point(_behind(loss), 2100.0, 10e5)) == pytest.approx((1.0 + loss) * LOST[2100.0], rel=0.02)


@pytest.mark.parametrize(("loss", "rpm", "inlet"), [(5.0, 2100.0, 0.0), (8.0, 1800.0, 0.0), (8.0, 2100.0, 0.5e5)])
def test_starved_chambers_take_what_the_kidney_lets_through(loss, rpm, inlet):
    """At a cavity from soon after its beginning to the end of the stroke: n_c/n of half the arc of an open kidney.

    Two parts in a hundred: the tabulated loss is rounded to one, and a cavity opens after the stroke has begun.
    """
    suction, _ = port_openings(REF90, 0.0)
    angle = np.linspace(0.0, pi, 20001)
    arc = float(np.mean(opening_area(suction, angle))) * pi / suction.kidney_area
    onset = sqrt((inlet - CAVITY_PRESSURE) / ((1.0 + loss) * LOST[2100.0] * (rpm / 2100.0) ** 2))
    assert _filled(loss, rpm, inlet) == pytest.approx(onset * arc / 2.0, rel=0.02)


def test_a_line_that_loses_nothing_changes_nothing():
    plain, behind = (_point(pump, 2100.0, 0.0).bench for pump in (REF90, _behind(0.0)))
    assert vars(behind) == vars(plain)
    assert _filled(0.0, 2100.0, 1e5) == pytest.approx(1.0, abs=0.005)


def test_flow_grows_no_more_with_speed_once_chambers_starve():
    flows = [_point(_behind(8.0), rpm, 0.0).bench.inlet_flow for rpm in (1800.0, 2400.0, 3000.0)]
    assert flows == pytest.approx([flows[0]] * 3, rel=0.01)


def _behind_a_line(loss: float, laminar: float = 0.0) -> PumpDescription:
    stated = {"physics.incomplete_filling.inlet_loss": loss, "physics.incomplete_filling.laminar": laminar}
    return load_pump(BENCH, stated)


@pytest.mark.parametrize("loss", [1.0, 3.0])
def test_a_line_loses_by_the_flow_that_comes(loss):
    """Where chambers fill: x times the kidney's loss at the flow of all pistons."""
    found = _point(_behind_a_line(loss), 2100.0, 10e5)
    lost = found.point.inlet_pressure - found.suction.pressure.mean()
    assert lost == pytest.approx(loss * LOST[2100.0], rel=0.03)
    assert found.bench.inlet_pressure == pytest.approx(10e5)


@pytest.mark.parametrize(("loss", "inlet"), [(4.0, 0.0), (8.0, 0.0), (8.0, 0.5e5)])
def test_a_line_and_its_chambers_agree_on_the_flow_where_they_starve(loss, inlet):
    """The line's loss at the flow that the chambers take is what it was taken to lose: to 4 in a hundred."""
    found = _point(_behind_a_line(loss), 2400.0, inlet)
    full = _point(REF90, 2400.0, 2e6).bench.inlet_flow
    lost = inlet - found.suction.pressure.mean()
    share = found.bench.inlet_flow / full
    assert share < 0.97
    assert lost == pytest.approx(loss * LOST[2100.0] * (2400.0 / 2100.0 * share) ** 2, rel=0.04)


def test_a_laminar_line_starves_cold_oil():
    warm, cold = (_behind_a_line(2.0, 1.0) for _ in range(2))
    at = {"shaft_speed": 2100.0 * RPM, "inlet_pressure": 0.0, "delivery_pressure": 10e6, "case_pressure": 0.0}
    flows = [
        lumped_point(pump, operating_point(pump, temperature=kelvin, **at)).bench.inlet_flow
        for pump, kelvin in ((warm, 343.15), (cold, 303.15))
    ]
    assert flows[1] < 0.9 * flows[0]


def test_share_that_a_kidney_passes():
    """All of it down to the root at which the cavity is just full as the port shuts, .7246 of half a turn's arc."""
    angle = np.linspace(0.0, pi, 20001)
    share = filled_share(np.array([0.0, 0.36, 0.72, 0.73, 1.0, 2.0]), angle, np.ones_like(angle))
    begins = np.arcsin(0.36)
    passed = np.where(angle < begins, np.sin(angle), 0.36)
    assert share[1] == pytest.approx(np.mean(passed) * pi / 2.0, abs=1e-4)
    assert share[2] == pytest.approx(0.995, abs=0.002)
    np.testing.assert_allclose(share[[0, 3, 4, 5]], [0.0, 1.0, 1.0, 1.0], atol=1e-12)
