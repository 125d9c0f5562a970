"""Forces between the parts of the rotating group, as what drives floating gaps."""

import numpy as np
import pytest

from gaps import swept_acceleration
from system import (
    bore_axis,
    drives,
    floating_parts,
    load_pump,
    no_rubbing,
    operating_point,
    piston_acceleration,
    piston_area,
    piston_velocity,
    plate_axes,
    rotor,
    slipper_acceleration,
)
from system.films.drives import group_balance
from system.films.places import ball_centre
from system.films.rotor import travel
from system.pump.laws.directions import bore_sides
from system.pump.lumped import block_spring

ANGLES = np.linspace(0.0, 2.0 * np.pi, 18, endpoint=False)
MASSLESS = {"piston.mass": "1e-9 kg", "slipper.mass": "1e-9 kg"}
CYLINDER = {"pump.bore_cone_angle": "0 deg", "pump.displacement": "89.46 cm3/rev"}


def posed(**overrides):
    pump = load_pump("ref90", {key.replace("__", "."): value for key, value in overrides.items()})
    return rotor(pump, operating_point(pump)), floating_parts(pump)


def test_piston_and_slipper_together_obey_newton():
    """All forces from outside, with those of both films, move the two masses: an independent vector sum."""
    group, parts = posed()
    pump, speed, drag, friction = group.pump, group.point.shaft_speed, 37.0, np.array([-20.0, 11.0])
    whole = np.ones(18)
    found = group_balance(group, parts, ANGLES, 2e7 * whole, drag * whole, np.outer(whole, friction))
    for k, angle in enumerate(ANGLES):
        axis, plate = bore_axis(group.drive, angle), plate_axes(group.drive)
        push = (piston_area(pump) * (2e7 - group.point.case_pressure) + drag) * axis
        outside = push + found.forces.side[k] - found.forces.lift[k] * plate[2] + friction @ plate[:2]
        place = ball_centre(group, angle) - parts.piston.centre_of_mass * axis
        velocity = float(piston_velocity(group.drive, angle, speed))
        acceleration = float(piston_acceleration(group.drive, angle, speed))
        piston = swept_acceleration(place, axis, velocity, acceleration, speed)
        slipper = slipper_acceleration(group.drive, angle, speed) @ plate[:2]
        moved = pump.piston.mass * piston + pump.slipper.mass * slipper
        np.testing.assert_allclose(outside, moved, rtol=0.0, atol=1e-9 * np.linalg.norm(push))


def test_a_slipper_without_lift_has_a_finite_moment():
    """At the pressure at which its lift passes through zero the plate's moment is that beside it."""
    group, parts = posed(retainer__kind="clearance")

    def at(*pressures):
        both = np.ones(2)
        friction = np.outer(both, [-20.0, 11.0])
        return group_balance(group, parts, 0.3 * both, np.array(pressures), 37.0 * both, friction)

    low, high = at(0.0, 1e7).forces.lift + at(0.0, 1e7).held
    balanced = -low * 1e7 / (high - low)  # the lift is linear in the pressure
    found = at(balanced, balanced + 1.0)
    assert abs(found.forces.lift[0] + found.held) < 1e-6
    np.testing.assert_allclose(*found.couple, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(*found.places, rtol=0.0, atol=1e-12)
    moved = np.cross(found.couple, plate_axes(group.drive)[2])
    np.testing.assert_allclose(moved, found.pressed @ plate_axes(group.drive)[:2], rtol=1e-9)


def test_the_piston_turns_about_its_guide_as_its_forces_ask():
    """The forces on both ends of the guide balance force and moment of joint, mass and friction."""
    group, parts = posed()
    found = drives(group, parts, ANGLES, np.full(18, 2e7), no_rubbing(18))
    guide = parts.piston.guide_length
    for k, angle in enumerate(ANGLES):
        outer, at = found.piston.outer(angle).reshape(2, 2), found.group
        sides, axis = bore_sides(group.drive, angle), bore_axis(group.drive, angle)
        ball = group.pump.piston.overhang + travel(group, angle)  # outside the case edge
        np.testing.assert_allclose(outer.sum(axis=0), -sides @ at.forces.side[k], atol=1e-9 * np.abs(outer).max())
        forces, levers = (-at.forces.ball[k], at.inertia[k, 0]), (ball, ball - parts.piston.centre_of_mass)
        moment = sum(np.cross(lever * axis, force) for lever, force in zip(levers, forces, strict=True))
        # About the case edge only what presses at the inner end has a lever.
        ends = np.cross(-guide * axis, outer[0] @ sides)
        asked = sides @ (moment - at.ball_moment[k])
        np.testing.assert_allclose(sides @ ends, asked, atol=1e-9 * np.abs(asked).max())


def test_a_cylindrical_group_presses_with_its_pistons_and_its_spring():
    """Without masses and friction z Ap dp and the spring press the block, with the moments of Ap dp at the balls.

    Each piston pushes the plate with N = Ap dp/cos(g); its sideways part passes to the block at the ball's height.
    """
    pressure = 1e7 * (1.5 + np.sin(ANGLES))
    group, parts = posed(**MASSLESS, **CYLINDER, **{"friction.piston_slipper_socket": 0.0})
    found = drives(group, parts, ANGLES, pressure, no_rubbing(18)).block
    area, spring = piston_area(group.pump), block_spring(group.pump)
    above, gamma = pressure - group.point.case_pressure, group.drive.swash_angle
    radius = group.pump.pump.pitch_radius
    for k, angle in enumerate(ANGLES[:2]):
        chambers = (k + 2 * np.arange(9)) % 18
        lift = (area * above[chambers] + spring / 9.0) / np.cos(gamma)
        places = np.column_stack([radius * np.cos(ANGLES[chambers]), radius * np.sin(ANGLES[chambers])])
        height = np.array([ball_centre(group, a)[2] for a in ANGLES[chambers]]) - parts.block.spline_height
        forces = np.column_stack([-lift * np.sin(gamma), 0.0 * lift, -lift * np.cos(gamma)])
        moments = np.cross(np.column_stack([places, height]), forces).sum(axis=0)
        expected = np.array([forces[:, 2].sum(), moments[0], moments[1]])
        np.testing.assert_allclose(found.press(angle), expected, rtol=1e-6, atol=1e-6 * np.abs(expected).max())
        assert expected[0] == pytest.approx(-(area * above[chambers].sum() + spring), rel=1e-12)
