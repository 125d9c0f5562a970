"""Effects of [physics] in transients: a held plate is the lumped point with them; a swinging one follows their laws."""

from __future__ import annotations

from dataclasses import fields, replace
from functools import cache

import numpy as np
import pytest
from bench_pump import BENCH

from system import load_pump, lumped_point, operating_point
from system.description.effects import PhysicsSection
from system.effects.laws.film import opening_flow
from system.multibody.kinematics import swash_angle
from system.multibody.transient import kernels as kernel
from system.multibody.transient.pistons import stroke_ratio
from system.multibody.transient.setup import plate_record
from system.multibody.transient.solver import ControlPressure, Transient, TransientCase, flows, run_transient
from system.pump.laws.kinematics import drive_at_ratio
from system.pump.lumped import full_drive
from system.pump.operating import OperatingPoint

DEGREES = np.pi / 180.0
FIRM = {"actuator.area": "40 cm2", "actuator.arm": "60 mm"}
FIRMLY = ControlPressure(np.zeros(1), np.array([10e6]))
"""On the upper stop whatever the pump's moment."""
DOWN = {
    "actuator.strokes": "down", "actuator.area": "12 cm2", "actuator.arm": "60 mm", "actuator.orifice_area": "20 mm2",
}  # fmt: skip
SET_BACK = ControlPressure(np.array([0.0, 0.005]), np.array([0.5e6, 12e6]))
RESISTANCE = dict.fromkeys(("piston", "slipper", "valve_plate"), "6.6e-5 m2 K/W")
HELD = {
    "film_heating": RESISTANCE,
    "viscosity_pressure": {"coefficient": "20 1/GPa"},
    "shear_thinning": {"drop": 0.3, "rate": "5e5 1/s"},
    "mixed_friction": {"piston": 0.08, "slipper": 0.05, "valve_plate": 0.05, "hersey_scale": 1e-4},
    "elastic_opening": {"piston.opening": "20 1/GPa", "slipper.opening": "10 1/GPa", "valve_plate.opening": "5 1/GPa"},
    "thermal_clearance": {"piston.rate": "0.005 1/K", "slipper.rate": "0.01 1/K"},
    "squeeze_pumping": {"stroke": "20 um"},
    "slipper_lift": {"ride_height": "30 um", "retainer_force": "50 N", "wedge_exponent": 0.5},
    "block_tipping": {"wedge": "10 um"},
    "entrained_air": {"void": 0.02},
    "incomplete_filling": {"inlet_loss": 5.0},
    "churning": {"factor": 1.0},
    "seal_drag": {"torque": "2 N m"},
    "charge_pump_drag": {"volume": "20 cm3/rev"},
    "port_throttling": {"factor": 2.0},
    "compression_loss": {"share": 0.5},
    "port_short_circuit": {"area": "0.3 mm2"},
    "laminar_cross_leak": {"conductance": "1e-5 mm3"},
    "control_flow": {"area": "0.2 mm2", "laminar": 0.5},
    "notch_erosion": {"advance": "2 deg", "widening": 0.5},
    "swash_droop": {"rate": "0.003 deg/MPa", "play": "0.05 deg"},
    "line_resonance": {"height": 0.01, "speed": "2100 rpm"},
}
FORMS = {"entrained_air": {"void": 0.02, "polytropic": 1.2}, "incomplete_filling": {"inlet_loss": 3.0, "laminar": 0.5}}
TIPPING, STARVED = {"shaft_speed": 400.0, "delivery_pressure": 2.6e6}, {"inlet_pressure": 0.5e6, "shaft_speed": 400.0}
"""At which REF90's block tips, at which an inlet with ten times the kidneys' loss no longer fills its chambers."""
AT = {"block_tipping": TIPPING, "thermal_clearance": {"temperature": 333.15}}
CASES = [*HELD.items(), *FORMS.items(), ("incomplete_filling", {"inlet_loss": 10.0, "growth": 5.0})]


def extended(effect: str, values: dict[str, object], stated: dict[str, object]):
    return load_pump(BENCH, stated | {f"physics.{effect}.{key}": value for key, value in values.items()})


def held(pump, point: OperatingPoint, step: float | None = None) -> np.ndarray:
    """Delivery, inlet, drain flow (L/min) and torque (N m), means over a turn on the stop."""
    found = run_transient(TransientCase(pump, point, FIRMLY, 2.0 * np.pi / point.shaft_speed, step and step * DEGREES))
    return np.array([*(6e4 * one[1:].mean() for one in flows(found)), found.torque[1:].mean()])


def steady(pump, point: OperatingPoint) -> np.ndarray:
    found = lumped_point(pump, point).bench
    return np.array([6e4 * found.delivery_flow, 6e4 * found.inlet_flow, 6e4 * found.drain_flow, found.shaft_torque])


@cache
def without(point: OperatingPoint) -> tuple[np.ndarray, np.ndarray]:
    """Of the pump without effects: held and steady."""
    plain = load_pump(BENCH, FIRM)
    return held(plain, point), steady(plain, point)


def test_every_effect_has_its_case():
    assert set(HELD) == {own.name for own in fields(PhysicsSection)}


@pytest.mark.slow
@pytest.mark.parametrize(("effect", "values"), CASES, ids=[f"{name}-{len(values)}" for name, values in CASES])
def test_a_held_plate_is_the_lumped_point_with_the_effect(effect, values):
    """Change by the effect in the lumped fidelity.

    That one sees the gaps as they are without it, a transient as they are with it: 0.5 % of the largest change.
    """
    fast = AT.get(effect, STARVED if "growth" in values else {})
    pump = extended(effect, values, FIRM)
    point = operating_point(pump, **fast)
    on_the_stop, lumped = without(point)
    changed, expected = held(pump, point) - on_the_stop, steady(pump, point) - lumped
    assert np.abs(expected).max() > 0.02
    for part, own in ((slice(3), 1e-4), (slice(3, 4), 5e-3)):  # L/min, N m: what steps and sampled angles leave
        np.testing.assert_allclose(
            changed[part], expected[part], rtol=0.0, atol=own + 5e-3 * np.abs(expected[part]).max()
        )


@pytest.mark.slow
def test_a_law_that_jumps_with_the_pressure_converges_with_the_step(refine):
    """Slippers that seat as the chamber's pressure rises: of the first order in the step."""
    pump = extended("slipper_lift", {"ride_height": "80 um", "retainer_force": "10 N"}, FIRM)
    point = operating_point(pump)
    found = refine(lambda n: float(held(pump, point, 0.5 / n)[2]), (1, 2, 4), 1.0)
    off = 3.5e-3  # L/min of a change by 0.11: so far are angles a degree apart from the limit, 0.8404
    assert found.finest == pytest.approx(steady(pump, point)[2], abs=found.tolerance(off))


def set_back(effect: str, values: dict[str, object]) -> Transient:
    pump = extended(effect, values, DOWN)
    return run_transient(TransientCase(pump, operating_point(pump), SET_BACK, 0.08))


def test_an_opening_follows_the_pressure_of_each_chamber_at_the_instant():
    """The drain over a pitch amid the swing, by the law at every instant and chamber."""
    share = 20e-9
    found = set_back("elastic_opening", {"valve_plate.opening": "20 1/GPa"})
    case = found.case
    plate = plate_record(case.pump, case.point, found.mechanism, found.step)[0]
    middle = int(np.argmax(found.swash_angle < 8.0 * DEGREES))
    rows = slice(middle, middle + round(2.0 * np.pi / 9 / case.point.shaft_speed / found.step) + 1)
    assert np.abs(found.rows[rows, kernel.RATE]).max() > 1.0
    above = found.pressure[rows] - case.point.case_pressure
    ring = plate["ring_leak"] * opening_flow(share * np.maximum(above, 0.0)) * above
    slipper = plate["slipper_leak"] * above
    engaged = case.pump.piston.engaged_length - 0.5 * full_stroke(found)
    dense = np.exp(found.pressure[rows] / case.pump.oil.bulk_modulus)
    piston = plate["piston_leak"] / engaged * above  # half of the stroke out in the mean: a twentieth of the drain
    expected = ((ring + slipper + piston) * dense).sum(axis=1).mean()
    passed = found.rows[rows, kernel.CASE][1:].mean()
    assert passed == pytest.approx(expected, rel=0.02)
    assert ring.sum() > 0.3 * expected * len(ring)


def full_stroke(found: Transient) -> float:
    part = found.case.pump.pump
    return 2.0 * part.pitch_radius * float(np.tan(part.swash_angle_max))


def test_throttling_falls_with_the_cube_of_the_displacement():
    """The torque of the ports' passages at the displacement that the plate has on its way."""
    found = set_back("port_throttling", {"factor": 2.0})
    a_pitch = round(2.0 * np.pi / 9 / found.case.point.shaft_speed / found.step)
    angle = found.swash_angle[1 : 1 + found.swash_angle[1:].size // a_pitch * a_pitch].reshape(-1, a_pitch).mean(axis=1)
    ratio = stroke_ratio(found.case.pump, angle)
    assert np.count_nonzero((ratio > 0.1) & (ratio < 0.9)) >= 4
    torque = found.outside.torque[a_pitch::a_pitch][: angle.size]
    np.testing.assert_allclose(torque, found.outside.torque[0] * ratio**3, rtol=1e-9, atol=1e-9)


def test_a_plate_droops_no_further_than_upright():
    """As many degrees as the load makes; at last as many as are left. Oil is kept and nothing jumps."""
    found = set_back("swash_droop", {"rate": "0.01 deg/MPa", "play": "0.1 deg"})
    span = found.case.point.delivery_pressure - found.case.point.inlet_pressure
    droop, angle = found.rows[:, kernel.DROOP] / DEGREES, found.swash_angle / DEGREES
    whole = 0.01e-6 * span + 0.1
    far = angle > 2.0
    np.testing.assert_allclose(droop[far], whole, rtol=2e-3)
    assert angle[-1] == pytest.approx(0.0, abs=1e-9)
    assert droop[-1] == pytest.approx(0.0, abs=1e-9)
    assert np.abs(np.diff(droop)).max() < 0.05
    assert found.checks.mass_balance_error < 1e-12
    assert found.checks.energy_balance_error < 1e-4
    plain = run_transient(replace(found.case, pump=load_pump(BENCH, DOWN)))
    assert found.pressure.max() < 1.05 * plain.pressure.max()


def test_air_keeps_its_oil_and_its_energy_on_the_way_to_no_stroke():
    found = set_back("entrained_air", {"void": 0.02, "polytropic": 1.2})
    assert found.swash_angle[-1] == pytest.approx(0.0, abs=1e-9)
    assert np.all(np.isfinite(found.rows))
    assert np.all(np.isfinite(np.stack(flows(found))))
    assert found.checks.mass_balance_error < 1e-12
    assert found.checks.energy_balance_error < 1e-4


def test_missing_oil_is_that_of_the_dead_volume_where_nothing_is_displaced():
    """Air that grows again in the dead volume takes its oil at any stroke: the law divides by none."""
    found = set_back("entrained_air", {"void": 0.02})
    upright = found.swash_angle < 1e-9
    assert upright[-1]
    assert np.all(np.isfinite(found.outside.inlet))
    pump = found.case.pump
    small = replace(found.case.point, displacement_ratio=0.05)
    start = swash_angle(drive_at_ratio(full_drive(pump), 0.05))
    moved = float(np.interp(-start, -found.swash_angle, found.outside.inlet))
    expected = steady(pump, small) - steady(load_pump(BENCH, DOWN), small)
    assert 6e4 * moved == pytest.approx(expected[1], rel=0.05)  # on the way, over a pitch
