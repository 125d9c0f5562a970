"""Shaft torque from forces.

The lever of a frictionless piston in closed form, virtual work, the joint's forces from an independent balance,
and the energy balance of whole pumps, which can fail.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gaps import DrivenBody, ball_forces, swept_acceleration
from system import (
    PumpPoint,
    SwashDrive,
    bore_axis,
    load_pump,
    lumped_point,
    operating_point,
    piston_acceleration,
    piston_motion,
    piston_velocity,
    plate_axes,
    slipper_acceleration,
    slipper_sliding_velocity,
)
from system.description.lines import LineKind, LineSection
from system.pump.laws.friction_pairs import over_chambers
from system.pump.laws.kinematics import ball_radius
from system.pump.lumped import chamber_problem, group_masses, lumped_leaks
from system.pump.shaft_torque import ChamberForces, GroupMasses, chamber_torque, shaft_torque

DEGREES = np.pi / 180.0
SPEED = 220.0
ANGLE = 2 * np.pi * np.arange(720) / 720
CYLINDER = SwashDrive(45e-3, 0.0, 16.2 * DEGREES)
CONE = SwashDrive(45e-3, 5 * DEGREES, 16.2 * DEGREES)
MASSES = GroupMasses(0.16, 0.05, 30e-3)
NONE = ChamberForces(np.zeros(720), np.zeros((2, 720)), np.zeros(720))
EXAMPLES = Path(__file__).resolve().parents[4] / "examples" / "pumps"


def some_forces() -> ChamberForces:
    """Forces without symmetry, of the size of a pump's."""
    push = 7e3 * (1.0 - np.tanh(5.0 * np.sin(ANGLE - 0.1))) + 500.0 * np.cos(2 * ANGLE)
    rubbing = np.stack([40.0 * np.sin(ANGLE + 0.3) - 5.0, 30.0 * np.cos(ANGLE)])
    return ChamberForces(push, rubbing, 0.3 + 0.1 * np.cos(ANGLE))


def test_lever_of_a_frictionless_piston(validation):
    force = 13e3
    pushed = replace(NONE, along_bore=np.full(720, force))
    torque = chamber_torque(CYLINDER, ANGLE, SPEED, GroupMasses(0.0, 0.0), pushed)
    expected = -force * 45e-3 * np.tan(16.2 * DEGREES) * np.sin(ANGLE)
    np.testing.assert_allclose(torque, expected, atol=1e-12 * force)
    validation(
        case="shaft torque of one frictionless piston, cylindrical block",
        source="F R tan(gamma), closed form",
        quantity="at 270 deg under 13 kN",
        unit="N m",
        expected=force * 45e-3 * np.tan(16.2 * DEGREES),
        obtained=torque[540],
        relative_tolerance=1e-12,
    )


def test_torque_ripple_of_nine_pistons(validation):
    """Delivery pressure on half of a turn, none on the other: the strokes' ripple (pi/2z) tan(pi/4z)."""
    pressed = replace(NONE, along_bore=np.where(np.sin(ANGLE) < 0.0, 13e3, 0.0))
    torque = over_chambers([chamber_torque(CYLINDER, ANGLE, SPEED, GroupMasses(0.0, 0.0), pressed)], 9)
    assert np.mean(torque) == pytest.approx(9 / np.pi * 13e3 * 45e-3 * np.tan(16.2 * DEGREES), rel=1e-4)
    validation(
        case="kinematic torque ripple of nine pistons",
        source="(pi/2z) tan(pi/4z), closed form",
        quantity="peak to peak of the mean torque",
        unit="%",
        expected=100 * np.pi / 18 * np.tan(np.pi / 36),
        obtained=100 * np.ptp(torque) / np.mean(torque),
        tolerance=100 * (np.pi / 720) ** 2,  # extremes half a sample away at most, on curves of unit bend
    )


def test_masses_ask_for_no_mean_torque():
    """Kinetic energy returns to what it was; at its stroke's ends a piston on a cylinder asks for none at all."""
    torque = chamber_torque(CONE, ANGLE, SPEED, MASSES, NONE)
    assert np.ptp(torque) > 1.0
    assert abs(np.mean(torque)) < 1e-12 * np.ptp(torque)
    straight = chamber_torque(CYLINDER, ANGLE, SPEED, MASSES, NONE)
    mass = MASSES.piston + MASSES.slipper
    inertia = -mass * SPEED**2 * (45e-3 * np.tan(16.2 * DEGREES)) ** 2 * np.cos(ANGLE) * -np.sin(ANGLE)
    np.testing.assert_allclose(straight, inertia, atol=1e-12)


@pytest.mark.parametrize("drive", [CYLINDER, CONE])
def test_virtual_work(drive):
    """Mean power of the shaft is what the forces take: through v and V, which the torque does not use."""
    forces = some_forces()
    torque = chamber_torque(drive, ANGLE, SPEED, MASSES, forces)
    taken = -forces.along_bore * piston_velocity(drive, ANGLE, SPEED)
    taken -= np.sum(forces.on_slipper * slipper_sliding_velocity(drive, ANGLE, SPEED), axis=0)
    taken += SPEED * forces.joint
    assert SPEED * np.mean(torque) == pytest.approx(np.mean(taken), rel=1e-12)


@pytest.mark.parametrize("k", [0, 100, 333, 540, 700])
def test_against_the_balance_of_the_joint(k):
    """Moment of the bore on the piston about the shaft, from `gaps.loads.ball_joint` and the piston's balance."""
    forces, phi, drive = some_forces(), float(ANGLE[k]), CONE
    bore, plate = bore_axis(drive, phi), plate_axes(drive)
    ball = float(ball_radius(drive, phi)) * np.array([np.cos(phi), np.sin(phi), 0.0])
    centre = ball - MASSES.piston_centre * bore
    v = float(piston_velocity(drive, phi, SPEED))
    a = float(piston_acceleration(drive, phi, SPEED))
    piston = DrivenBody(MASSES.piston, swept_acceleration(centre, bore, v, a, SPEED), forces.along_bore[k] * bore)
    plane = slipper_acceleration(drive, phi, SPEED) @ plate[:2]
    slipper = DrivenBody(MASSES.slipper, plane, forces.on_slipper[:, k] @ plate[:2])
    joint = ball_forces(bore, plate[2], piston, slipper)
    held = np.cross(centre, MASSES.piston * piston.acceleration) + np.cross(ball, joint.ball)
    found = chamber_torque(drive, ANGLE, SPEED, MASSES, forces)[k]
    assert found == pytest.approx(held[2] + forces.joint[k], rel=1e-11, abs=1e-9)


def run(name: str, line: LineSection | None = None, **point: float) -> PumpPoint:
    pump = load_pump(name)
    pump = replace(pump, delivery_line=line or LineSection())
    return lumped_point(pump, operating_point(pump, **point))


LINE = LineSection(kind=LineKind.ORIFICE, volume=0.2e-3)


@pytest.mark.parametrize(
    ("name", "line", "point"),
    [
        ("ref90", None, {}),
        ("ref90", LINE, {}),
        ("ref90", None, {"delivery_pressure": 5e6}),
        ("ref90", None, {"displacement_ratio": 0.3, "delivery_pressure": 20e6}),
        ("ref90", LINE, {"delivery_pressure": 20e6}),
        (str(EXAMPLES / "cylindrical_block.toml"), LINE, {}),
    ],
)
def test_energy_of_the_shaft_closes(name, line, point, validation):
    found = run(name, line, **point)
    quantity = f"{Path(name).stem}, {found.point.delivery_pressure * 1e-6:.3g} MPa"
    quantity += f", displacement {found.point.displacement_ratio:.2g}" + (", 0.2 L and orifice" if line else "")
    validation(
        case="energy balance of the shaft torque from forces, lumped",
        source="conservation",
        quantity=quantity,
        unit="1",
        expected=0.0,
        obtained=found.checks.energy_balance_error,
        tolerance=1e-3,  # 360 angles, pressure that bends by 35 MPa within 2 deg
        note="each sink on its own",
    )
    assert found.checks.work_balance_error < 1e-6


def test_the_balance_can_fail():
    """Friction that the forces know and the sinks do not shows in full."""
    pump = load_pump("ref90")
    found = run("ref90")
    motion = piston_motion(pump, found.point)
    problem = chamber_problem(pump, found.point, motion, lumped_leaks(pump, found.point, motion))
    loss = found.pairs.piston_cylinder
    more = replace(found.pairs, piston_cylinder=replace(loss, coulomb=1.5 * loss.coulomb))
    torque = shaft_torque((problem,), (found.cycle,), (more,), (group_masses(pump),), 9, 0.0)
    surplus = found.point.shaft_speed * float(np.mean(torque - found.shaft_torque))
    assert surplus == pytest.approx(0.5 * loss.mean_coulomb, rel=1e-9)
    assert surplus > 5.0 * 1e-3 * found.power.shaft
