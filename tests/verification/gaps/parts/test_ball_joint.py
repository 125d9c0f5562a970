"""Ball joint: forces and moments on piston and slipper against their inertia.

The sums are formed here from places and vectors in space; nothing of the code's coordinates enters them.
"""

from __future__ import annotations

import numpy as np
import pytest

from gaps import DrivenBody, ball_forces, face_force, swept_acceleration
from gaps.films.slipper import pressed_by
from gaps.loads.ball_joint import (
    Spins,
    ball_friction,
    bore_drag,
    free_spins,
    land_drag,
    lateral_force,
    lateral_moment,
    relative_spin,
)
from reynolds import FilmInputError
from system import (
    SwashDrive,
    bore_axis,
    piston_acceleration,
    piston_displacement,
    piston_velocity,
    plate_axes,
    slipper_acceleration,
)
from system.pump.laws.directions import bore_sides
from system.pump.laws.kinematics import ball_radius

SPEED = 220.0
DRIVE = SwashDrive(45e-3, np.radians(5.0), np.radians(16.2))
CYLINDER = SwashDrive(45e-3, 0.0, np.radians(16.2))
ANGLES = np.radians([17.0, 100.0, 172.0, 270.0])
CENTRE, GUIDE, OVERHANG = 35e-3, 40e-3, 25e-3  # of mass from the ball; guide; ball outside the guide's edge


def _ball(drive: SwashDrive, angle: float) -> np.ndarray:
    """Place of the ball, up to a constant along the shaft: on the plate and on its bore's axis."""
    radius = float(ball_radius(drive, angle))
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    return np.array([x, y, -x * np.tan(drive.swash_angle)])


def _bodies(drive: SwashDrive, angle: float) -> tuple[DrivenBody, DrivenBody]:
    """A piston under 35 MPa with friction in its bore, and a slipper that rubs on the plate."""
    axis, (steepest, across, _) = bore_axis(drive, angle), plate_axes(drive)
    velocity = float(piston_velocity(drive, angle, SPEED))
    sliding = float(piston_acceleration(drive, angle, SPEED))
    ball = _ball(drive, angle)
    centre = swept_acceleration(ball - CENTRE * axis, axis, velocity, sliding, SPEED)
    with_ball = swept_acceleration(ball, axis, velocity, sliding, SPEED)
    piston = DrivenBody(0.16, centre, (35e6 * np.pi * 0.011**2 - 120.0) * axis)
    return piston, DrivenBody(0.05, with_ball, 31.0 * steepest - 17.0 * across)


@pytest.mark.parametrize("drive", [DRIVE, CYLINDER])
@pytest.mark.parametrize("angle", ANGLES)
def test_forces_add_up(drive, angle, validation):
    axis, normal = bore_axis(drive, angle), plate_axes(drive)[2]
    piston, slipper = _bodies(drive, angle)
    found = ball_forces(axis, normal, piston, slipper)
    rest = piston.force + slipper.force + found.side - found.lift * normal
    rest = rest - piston.mass * piston.acceleration - slipper.mass * slipper.acceleration
    assert abs(found.side @ axis) < 1e-12 * found.lift
    validation(
        case="Ball joint, forces on piston and slipper together",
        source="Newton's second law, vector sum in space",
        quantity=f"rest over lift, {np.degrees(angle):.0f} deg, cone {np.degrees(drive.bore_cone_angle):.0f} deg",
        unit="1",
        expected=0.0,
        obtained=float(np.abs(rest).max()) / found.lift,
        tolerance=1e-12,
    )


def test_the_slipper_alone_is_in_balance():
    """m A = B + G - lift n, also under a force and an acceleration along the plate's normal."""
    axis, normal = bore_axis(DRIVE, 0.7), plate_axes(DRIVE)[2]
    piston, slipper = _bodies(DRIVE, 0.7)
    pressed = DrivenBody(slipper.mass, slipper.acceleration + 40.0 * normal, slipper.force - 250.0 * normal)
    found = ball_forces(axis, normal, piston, pressed)
    rest = found.ball + pressed.force - found.lift * normal - pressed.mass * pressed.acceleration
    assert np.abs(rest).max() < 1e-12 * found.lift


@pytest.mark.parametrize("angle", ANGLES)
def test_moments_on_the_piston(angle, validation):
    """Its film as two forces at the guide's ends: all moments about the ball across the bore vanish."""
    axis, sides = bore_axis(DRIVE, angle), bore_sides(DRIVE, angle)
    piston, slipper = _bodies(DRIVE, angle)
    ball = ball_forces(axis, plate_axes(DRIVE)[2], piston, slipper).ball
    joint = np.array([1.3, -0.7, 2.0])  # moment of the joint's friction on the piston
    inertia = -piston.mass * piston.acceleration
    outer = (
        lateral_force(GUIDE, -OVERHANG, sides @ -ball)
        + lateral_force(GUIDE, CENTRE - OVERHANG, sides @ inertia)
        + lateral_moment(GUIDE, sides @ joint)
    )
    inner_end, case_edge = (-outer.reshape(2, 2)) @ sides
    forces = inner_end + case_edge - ball + inertia + piston.force
    moments = joint - CENTRE * np.cross(axis, inertia)
    moments = moments - (OVERHANG + GUIDE) * np.cross(axis, inner_end) - OVERHANG * np.cross(axis, case_edge)
    size = float(np.abs(outer).max())
    validation(
        case="Ball joint, forces and moments on the piston",
        source="vector sum in space, the film as two forces",
        quantity=f"largest rest over the film's force, {np.degrees(angle):.0f} deg",
        unit="1",
        expected=0.0,
        obtained=max(np.abs(forces).max(), np.abs(sides @ moments).max() / GUIDE) / size,
        tolerance=1e-12,
    )


def test_moments_on_the_slipper(validation):
    """A film of five point forces that gives what is asked keeps the slipper's moments about the ball at zero."""
    axes = plate_axes(DRIVE)
    steepest, across, normal = axes
    mass_centre, height, outer_radius = 9e-3, 12e-3, 14e-3
    inertia, friction, moment = np.array([25.0, -90.0]), np.array([-40.0, 13.0]), np.array([0.4, -1.1, 2.0])
    pressed = pressed_by(inertia, mass_centre, friction, height, moment[:2])
    asked = face_force(outer_radius, 900.0, pressed)
    # Films at the middle and on both axes: q0 takes the sum, q1 and q2 the differences.
    east, north = -0.5 * asked[1], -0.5 * asked[2]
    push = np.array([900.0, east, -east, north, -north])
    places = outer_radius * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])
    total = moment @ axes + np.cross(height * normal, friction @ axes[:2])
    total = total - np.cross(mass_centre * normal, inertia @ axes[:2])
    for force, (x, y) in zip(push, places, strict=True):
        total = total + np.cross(x * steepest + y * across + height * normal, -force * normal)
    validation(
        case="Slipper, moments about the ball",
        source="vector sum in space, the film as point forces",
        quantity="rest along the plate",
        unit="N m",
        expected=0.0,
        obtained=float(np.abs(axes[:2] @ total).max()),
        tolerance=1e-12,
    )


def test_cylindrical_block_without_mass(validation):
    """A bore along the shaft: the plate pushes with Ap dp/cos(gamma) and across the bore with Ap dp tan(gamma)."""
    push = 35e6 * np.pi * 0.011**2
    still = DrivenBody(0.0, np.zeros(3), push * np.array([0.0, 0.0, 1.0]))
    found = ball_forces(
        bore_axis(CYLINDER, 1.0), plate_axes(CYLINDER)[2], still, DrivenBody(0.0, np.zeros(3), np.zeros(3))
    )
    for quantity, expected, obtained in (
        ("lift of the slipper", push / np.cos(CYLINDER.swash_angle), found.lift),
        ("side force of the bore", push * np.tan(CYLINDER.swash_angle), found.side[0]),
    ):
        validation(
            case="Ball joint, cylindrical block without friction and inertia",
            source="closed form, Ap dp/cos(gamma) and Ap dp tan(gamma)",
            quantity=quantity,
            unit="N",
            expected=expected,
            obtained=obtained,
            relative_tolerance=1e-12,
        )
    assert np.abs(found.side[1:]).max() < 1e-12 * push


@pytest.mark.parametrize("drive", [DRIVE, CYLINDER])
@pytest.mark.parametrize("angle", ANGLES)
def test_acceleration_of_the_ball(drive, angle):
    """That of a point carried by bore and shaft is that of the point on the plate, which the plate's law gives."""
    axis, axes = bore_axis(drive, angle), plate_axes(drive)
    velocity = float(piston_velocity(drive, angle, SPEED))
    sliding = float(piston_acceleration(drive, angle, SPEED))
    found = axes @ swept_acceleration(_ball(drive, angle), axis, velocity, sliding, SPEED)
    size = SPEED**2 * drive.pitch_radius
    assert found[:2] == pytest.approx(slipper_acceleration(drive, angle, SPEED), abs=1e-12 * size)
    assert abs(found[2]) < 1e-12 * size


def test_axial_inertia_of_a_cone_is_not_the_bare_stroke_acceleration():
    """Centripetal acceleration has a part along the bore, w^2 r sin(beta), which the lumped law leaves out."""
    angle = ANGLES[3]
    axis = bore_axis(DRIVE, angle)
    place = _ball(DRIVE, angle) - CENTRE * axis
    sliding = float(piston_acceleration(DRIVE, angle, SPEED))
    along = float(swept_acceleration(place, axis, float(piston_velocity(DRIVE, angle, SPEED)), sliding, SPEED) @ axis)
    radius = float(np.hypot(*place[:2]))
    assert along - sliding == pytest.approx(-(SPEED**2) * radius * np.sin(DRIVE.bore_cone_angle), rel=1e-12)
    # The place of the piston itself, differentiated twice.
    step = 1e-3

    def at(angle: float) -> np.ndarray:
        height = float(piston_displacement(DRIVE, angle)) - float(piston_displacement(DRIVE, ANGLES[3]))
        apex = _ball(DRIVE, ANGLES[3]) - float(ball_radius(DRIVE, ANGLES[3])) / np.sin(DRIVE.bore_cone_angle) * axis
        distance = float(ball_radius(DRIVE, ANGLES[3])) / np.sin(DRIVE.bore_cone_angle) - CENTRE + height
        return apex + distance * bore_axis(DRIVE, angle)

    bent = (at(angle + step) - 2.0 * at(angle) + at(angle - step)) / (step / SPEED) ** 2
    assert float(bent @ axis) == pytest.approx(along, abs=step**2 * SPEED**2 * DRIVE.pitch_radius)


def test_ball_friction():
    spin = np.array([30.0, -200.0, 90.0])
    moment = ball_friction(0.02, 13.9e3, 8e-3, spin, SPEED)
    assert np.linalg.norm(moment) == pytest.approx(0.02 * 13.9e3 * 8e-3, rel=0.01**2)
    assert moment / np.linalg.norm(moment) == pytest.approx(-spin / np.linalg.norm(spin), abs=1e-12)
    assert ball_friction(0.02, 13.9e3, 8e-3, np.zeros(3), SPEED) == pytest.approx(np.zeros(3), abs=0.0)
    pulled = ball_friction(0.02, -100.0, 8e-3, spin, SPEED)
    assert float(pulled @ spin) < 0.0  # it resists, whichever way the joint is loaded


def test_spins_without_friction():
    spins = free_spins(bore_axis(DRIVE, 1.0)[None], plate_axes(DRIVE)[2], SPEED, np.zeros(1), 5e-4, 1e-4)
    assert (spins.piston, spins.slipper) == pytest.approx((0.0, 0.0), abs=1e-9)


def test_spins_of_a_stiff_joint(validation):
    """A cylindrical block's piston and slipper that stick together turn neither in space."""
    axis, normal = bore_axis(CYLINDER, 1.0), plate_axes(CYLINDER)[2]
    spins = free_spins(axis[None], normal, SPEED, np.array([1e6]), 5e-4, 1e-4)
    for quantity, expected, obtained in (
        ("spin of the piston against the block over shaft speed", -1.0, spins.piston / SPEED),
        ("spin of the slipper over shaft speed", 0.0, spins.slipper / SPEED),
    ):
        validation(
            case="Ball joint that rubs without limit",
            source="closed form: W = s n - (w + s_p) z vanishes for s = 0, s_p = -w alone",
            quantity=quantity,
            unit="1",
            expected=expected,
            obtained=obtained,
            tolerance=1e-6,
        )


@pytest.mark.parametrize("friction", [0.01, 0.08, 2.2])
def test_spins_balance_the_torques(friction):
    axis, normal = bore_axis(DRIVE, 1.0), plate_axes(DRIVE)[2]
    drags = bore_drag(0.0258, 22e-3, 40e-3, 15e-6), land_drag(0.0258, 8.2e-3, 14e-3, 8e-6)
    spins = free_spins(axis[None], normal, SPEED, np.array([friction]), *drags)
    spin = relative_spin(axis, normal, SPEED, spins.piston, spins.slipper)
    moment = ball_friction(friction, 1.0, 1.0, spin, SPEED)
    assert moment @ normal == pytest.approx(drags[1] * spins.slipper, abs=1e-8 * friction)
    assert -moment @ axis == pytest.approx(drags[0] * spins.piston, abs=1e-8 * friction)


def test_spins_settle_though_the_sum_that_is_least_cancels():
    """Films that drive the parts: of 26 W least, 25 cancel, and the last step lowers it by less than round-off."""
    angle, normal = np.linspace(0.0, 2.0 * np.pi, 36, endpoint=False), plate_axes(DRIVE)[2]
    axis = np.tile([0.0, 0.0, 1.0], (36, 1))
    friction = np.where(angle < np.pi, 2.2, 0.14)
    for factor, other in np.random.default_rng(2).uniform(0.5, 1.5, (500, 2)):
        driven = -0.51 * factor, 0.0094 * other
        spins = free_spins(axis, normal, 104.72, friction, 0.0127, 3.9e-4, driven=driven)
        turning = [
            ball_friction(
                rubbing, 1.0, 1.0, relative_spin(axis[0], normal, 104.72, spins.piston, spins.slipper), 104.72
            )
            for rubbing in friction
        ]
        moment = np.mean(turning, axis=0)
        assert moment @ normal == pytest.approx(3.9e-4 * spins.slipper - driven[1], abs=1e-9)
        assert -moment @ axis[0] == pytest.approx(0.0127 * spins.piston - driven[0], abs=1e-9)


def test_a_stated_spin_leaves_the_other_free():
    """The free one still has its own torque balance; both stated are both kept."""
    axis, normal = bore_axis(DRIVE, 1.0), plate_axes(DRIVE)[2]
    drags = bore_drag(0.0258, 22e-3, 40e-3, 15e-6), land_drag(0.0258, 8.2e-3, 14e-3, 8e-6)
    spins = free_spins(axis[None], normal, SPEED, np.array([0.08]), *drags, stated=(-20.0, None))
    assert spins.piston == -20.0
    moment = ball_friction(0.08, 1.0, 1.0, relative_spin(axis, normal, SPEED, -20.0, spins.slipper), SPEED)
    assert moment @ normal == pytest.approx(drags[1] * spins.slipper, abs=1e-8)
    assert free_spins(axis[None], normal, SPEED, np.array([0.08]), *drags, stated=(-20.0, 3.0)) == Spins(-20.0, 3.0)


def test_drags():
    assert land_drag(0.03, 5e-3, 10e-3, 10e-6) * 100.0 == pytest.approx(0.00441786, abs=0.5e-8)  # closed form
    centred = bore_drag(0.03, 20e-3, 30e-3, 10e-6)
    assert centred == pytest.approx(0.03 / 10e-6 * 10e-3**2 * np.pi * 20e-3 * 30e-3, rel=1e-12)


def test_plate_along_the_bore_is_refused():
    still = DrivenBody(1.0, np.zeros(3), np.zeros(3))
    with pytest.raises(FilmInputError, match=r"plate normal along the bore: 0; expected at least 0\.1"):
        ball_forces(np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0]), still, still)
