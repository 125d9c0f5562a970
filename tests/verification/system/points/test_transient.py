"""Transients of displacement.

A held plate is the operating point; free swings and stops against closed forms; oil and energy balance; order two.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from bench_pump import BENCH

from reynolds import InputError
from system import joint_forces, load_pump, lumped_point, operating_point, orifice_flow
from system.multibody.plate_motion import mechanism
from system.multibody.transient import kernels as kernel
from system.multibody.transient.solver import ControlPressure, Transient, TransientCase, Transition, run_transient

DEGREES = np.pi / 180.0
PUMPS = Path(__file__).parents[4] / "examples" / "pumps"
FIRM = {"actuator.area": "40 cm2", "actuator.arm": "60 mm"}
"""At 10 MPa an actuator that no moment moves off its stop."""


def held_at(pressure: float) -> ControlPressure:
    return ControlPressure(np.zeros(1), np.array([pressure]))


def run(
    stated: dict[str, object], control: ControlPressure, end: float, step: float | None = None, **asked: float
) -> Transient:
    pump = load_pump(BENCH, stated)
    return run_transient(TransientCase(pump, operating_point(pump, **asked), control, end, step and step * DEGREES))


@pytest.fixture(scope="module")
def firm() -> Transient:
    """One turn on the upper stop."""
    return run(FIRM, held_at(10e6), 2 * np.pi / 219.9)


def test_a_held_plate_is_the_operating_point(firm, validation):
    """Chamber pressure over the turn, flow and moments against `lumped_point` and the forces of its joints."""
    point = lumped_point(firm.case.pump, firm.case.point)
    assert np.ptp(firm.swash_angle) == 0.0
    found = np.interp(point.cycle.shaft_angle, firm.shaft_angle, firm.pressure[:, 0])
    assert np.sqrt(np.mean((found - point.cycle.pressure) ** 2)) < 1e-3 * point.point.delivery_pressure
    dense = np.exp(-point.point.delivery_pressure / firm.case.pump.oil.bulk_modulus)
    validation(
        case="swash plate held in a transient against the operating point",
        source="lumped_point of the same pump",
        quantity="mean delivery flow",
        unit="L/min",
        expected=point.bench.delivery_flow * 6e4,
        obtained=float(np.mean(firm.rows[1:, kernel.DELIVERY])) * dense * 6e4,
        relative_tolerance=1e-3,
    )
    moments = firm.rows[1:, kernel.MOMENT_PRESSURE : kernel.MOMENT_ACTUATOR].sum(axis=1).mean()
    control = joint_forces(firm.case.pump, point).plate.control.mean()
    validation(
        case="swash plate held in a transient against the operating point",
        source="multibody rotating group",
        quantity="mean moment of the pump on the plate",
        unit="N m",
        expected=-float(control),
        obtained=float(moments),
        relative_tolerance=0.02,  # sampled angles of either, friction of slippers left out
    )


@pytest.mark.parametrize(("pistons", "displacement"), [(7, "69.9 cm3/rev"), (8, "79.87 cm3/rev")])
def test_other_numbers_of_pistons_hold_too(pistons, displacement):
    """Full stroke and speed of another machine: its flow is the operating point's."""
    stated = FIRM | {"pump.pistons": pistons, "pump.displacement": displacement}
    found = run(stated, held_at(10e6), 2 * np.pi / 150.0, shaft_speed=150.0, delivery_pressure=15e6)
    point = lumped_point(found.case.pump, found.case.point)
    dense = np.exp(-15e6 / found.case.pump.oil.bulk_modulus)
    flow = float(np.mean(found.rows[1:, kernel.DELIVERY])) * dense
    assert flow == pytest.approx(point.bench.delivery_flow, rel=1e-3)


def test_a_cross_angle_turns_the_dead_centres_not_the_flow():
    """At full stroke and two starts: shaft angles count from the plate's own axis, as its ports do."""
    found = run(FIRM | {"pump.cross_angle": "2 deg", "pump.displacement": "90.5 cm3/rev"}, held_at(10e6), 0.05714)
    point = lumped_point(found.case.pump, found.case.point)
    dense = np.exp(-point.point.delivery_pressure / found.case.pump.oil.bulk_modulus)
    flow = float(np.mean(found.rows[1:, kernel.DELIVERY])) * dense
    assert flow == pytest.approx(point.bench.delivery_flow, rel=2e-3)


STROKE = ControlPressure(np.array([0.0, 0.01]), np.array([2.5e6, 0.3e6]))


@pytest.fixture(scope="module")
def destroked() -> Transient:
    """The control pressure falls: the pump's own moment sets its plate back."""
    return run({}, STROKE, 0.24)


def test_a_fall_of_the_control_pressure_sets_the_plate_back(destroked):
    degrees = destroked.swash_angle / DEGREES
    assert degrees[0] == pytest.approx(16.2)
    assert degrees[-1] < 1.0
    assert degrees.min() >= 0.0
    assert np.all(np.isfinite(destroked.rows))
    flow = destroked.rows[:, kernel.DELIVERY]
    assert flow[-840:].mean() < 0.1 * flow[1:400].mean()
    assert {taken.path for taken in destroked.mechanism.taken} >= {"actuator.area", "swash_plate.inertia"}


def test_an_assumed_actuator_is_that_of_the_pump_at_its_rating():
    pump = load_pump(BENCH)
    found = mechanism(pump).actuator
    rated = operating_point(pump, shaft_speed=pump.pump.rated_speed, delivery_pressure=pump.pump.rated_pressure)
    moment = np.max(np.abs(joint_forces(pump, lumped_point(pump, rated)).plate.control))
    held = 2.5e6 * found.area * found.arm * np.cos(pump.pump.swash_angle_max)
    assert held == pytest.approx(moment, rel=1e-12)
    slow = replace(pump, operating=replace(pump.operating, speed=0.5 * pump.operating.speed, pressure=10e6))
    assert mechanism(slow).actuator == found


def test_oil_is_kept_and_energy_balances(destroked):
    assert destroked.checks.mass_balance_error < 1e-12
    assert destroked.checks.energy_balance_error < 1e-3


def test_energy_balances_where_chambers_do_no_work():
    """Next to no stroke: the errors are then shares of the power of the oil that passes."""
    idle = run({"actuator.area": "4 cm2"}, held_at(0.3e6), 0.03, displacement_ratio=0.01)
    assert idle.checks.energy_balance_error < 1e-4


def test_the_actuator_keeps_its_oil(destroked):
    """The volume took the flow of its orifice, by Simpson's rule over the sampled pressures."""
    case, parts = destroked.case, destroked.mechanism
    plate, oil = parts.plate, case.pump.oil
    way = parts.actuator.arm * (np.sin(destroked.swash_angle) - np.sin(plate.angle_min))
    volume = parts.actuator.dead_volume + parts.actuator.area * way
    pressure = destroked.rows[:, kernel.ACTUATOR]
    mass = volume * np.exp(pressure / oil.bulk_modulus)
    law = (case.pump.ports.flow_coefficient, oil.density, case.point.viscosity / oil.density, 150.0)
    control = destroked.rows[:, kernel.CONTROL]
    into = np.array(
        [float(orifice_flow(c - p, parts.actuator.orifice_area, *law)) for c, p in zip(control, pressure, strict=True)]
    )
    rate = into * np.exp(pressure / oil.bulk_modulus)
    passed = float(np.sum(0.5 * (rate[1:] + rate[:-1])) * destroked.step)
    assert passed == pytest.approx(mass[-1] - mass[0], rel=5e-3)


SWINGING = {
    "swash_plate.inertia": "0.2 kg m2", "swash_plate.angle_min": "-3 deg", "pump.swash_angle_max": "3 deg",
    "pump.displacement": "16.23 cm3/rev", "pump.bore_cone_angle": "0 deg", "pump.dead_volume": "1 L",
    "piston.engaged_length": "60 mm", "friction.piston_cylinder": 0.0, "actuator.area": "1 mm2",
    "actuator.arm": "60 mm", "actuator.dead_volume": "1 L", "actuator.spring_rate": "2000 N/mm",
    "actuator.orifice_area": "20 mm2",
}  # fmt: skip
"""A plate on its spring: next to no pressure, so much oil in the chambers that none of them matters."""


def swung(step: float) -> Transient:
    return run(
        SWINGING, held_at(0.15e6), 0.0075, step, delivery_pressure=0.16e6, inlet_pressure=0.15e6,
        case_pressure=0.15e6, displacement_ratio=0.9, shaft_speed=100.0,
    )  # fmt: skip


def test_steps_converge_to_second_order(refine):
    def angle(n: int) -> float:
        found = swung(2.0 / n)
        return float(np.interp(np.pi / 500.0, found.time, found.swash_angle))

    assert refine(angle, (1, 2, 4), 2.0).order == pytest.approx(2.0, abs=0.1)


def test_a_plate_swings_on_its_spring(validation):
    """Spring, plate and pistons alone: a cosine about the actuator's innermost place, at small angles."""
    found, low = swung(0.5), -3 * DEGREES
    pump = found.case.pump
    mass = pump.piston.mass + pump.slipper.mass
    turned = 0.2 + 4.5 * mass * pump.pump.pitch_radius**2  # and pistons resist being turned round, m w^2 z R^2/2
    rate = np.sqrt((2e6 * 0.06**2 - 4.5 * mass * pump.pump.pitch_radius**2 * 100.0**2) / turned)
    expected = low + (found.swash_angle[0] - low) * np.cos(rate * 0.006)
    validation(
        case="swash plate oscillating on its spring",
        source="cosine of its natural frequency, closed form",
        quantity="angle after 6 ms",
        unit="deg",
        expected=expected / DEGREES,
        obtained=float(np.interp(0.006, found.time, found.swash_angle)) / DEGREES,
        tolerance=0.03,  # sine of 5.7 deg against the angle 0.16 %, some kPa over the pistons
    )


def test_a_stop_is_not_passed_and_tells_what_it_took(destroked):
    """Back up to the upper one, which it strikes: no penetration, an impulse, then a moment on the stop."""
    up = ControlPressure(np.array([0.0]), np.array([6e6]))
    found = run({"actuator.area": "20 cm2", "actuator.arm": "60 mm", "actuator.orifice_area": "60 mm2"}, up, 0.1,
                displacement_ratio=0.3)  # fmt: skip
    top = found.mechanism.plate.angle_max
    assert found.swash_angle.max() == top
    struck = np.argmax(found.impulses)
    assert found.impulses[struck] > 0.01
    resting = found.rows[-200:]
    on_stop = resting[:, kernel.ANGLE] == top
    assert on_stop.any()
    total = resting[on_stop][:, kernel.MOMENT_PRESSURE : kernel.MOMENT_STOP + 1].sum(axis=1)
    stopped = resting[on_stop][:, kernel.MOMENT_STOP] != 0.0
    np.testing.assert_allclose(total[stopped], 0.0, atol=1e-9)


def test_an_actuator_that_strokes_down_against_a_spring():
    """Its pressure sets the plate back, the spring brings it up again."""
    stated = {
        "actuator.strokes": "down", "actuator.area": "12 cm2", "actuator.arm": "60 mm",
        "actuator.spring_preload": "9 kN", "actuator.spring_rate": "50 N/mm", "actuator.orifice_area": "20 mm2",
    }  # fmt: skip
    found = run(stated, ControlPressure(np.array([0.0, 0.02, 0.08]), np.array([0.15e6, 12e6, 0.15e6])), 0.2)
    at = np.interp([0.019, 0.075, 0.199], found.time, found.swash_angle) / DEGREES
    assert at[0] == pytest.approx(16.2, abs=0.2)
    assert at[1] < 0.8 * at[0]
    assert at[2] > 1.15 * at[1]


def test_a_chamber_that_cavitates_gives_numbers():
    """No charge pressure at twice the speed: cavities open, nothing is lost, nothing is nan."""
    found = run(FIRM, held_at(10e6), 0.03, shaft_speed=440.0, inlet_pressure=-0.03e6, case_pressure=0.0)
    assert found.pressure.min() < -0.1e6
    assert np.all(np.isfinite(found.rows))
    assert found.checks.mass_balance_error < 1e-12


def test_a_light_plate_that_hammers_its_stop_is_followed():
    """The small pump's plate is light, its actuator cavitates: narrow ports make the chambers' equations swing."""
    pump = load_pump(str(PUMPS / "cylindrical_block.toml"))
    fall = ControlPressure(np.array([0.0, 0.02]), np.array([2e6, 0.4e6]))
    found = run_transient(TransientCase(pump, operating_point(pump), fall, 0.06))
    assert np.all(np.isfinite(found.rows))
    assert found.swash_angle.max() <= found.mechanism.plate.angle_max
    assert found.checks.mass_balance_error < 1e-12


def test_steps_too_long_for_the_plate_are_refused():
    with pytest.raises(InputError, match="at most"):
        run({"swash_plate.inertia": "1e-5 kg m2"} | FIRM, held_at(10e6), 0.01, 2.0)


def test_schedules_hold_or_ramp():
    times, values = np.array([0.0, 0.2, 0.4]), np.array([1.0, 3.0, 2.0])
    steps = ControlPressure(times, values).over(0.1, 6)
    np.testing.assert_allclose(steps[:, 0], [1, 1, 3, 3, 2, 2])
    np.testing.assert_allclose(steps[:, 1], steps[:, 0])
    ramp = ControlPressure(times, values, Transition.RAMP).over(0.1, 6)
    np.testing.assert_allclose(ramp[:, 0], [1, 2, 3, 2.5, 2, 2])
    np.testing.assert_allclose(ramp[:-1, 1], ramp[1:, 0])
