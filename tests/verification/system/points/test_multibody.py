"""Multibody rotating group.

Kinematics against Eqs. (6)-(8) and differences; each part's balance closes for pumps of every build; the drive
torque is that of the energy balance; closed forms of the plate's moment and of the ball guide.
"""

from dataclasses import replace

import numpy as np
import pytest

from gaps import DrivenBody, ball_forces, swept_acceleration
from swashfilm.runs.pump.forces import force_warnings
from system import (
    PumpDescription,
    SwashDrive,
    bore_axis,
    joint_forces,
    load_pump,
    lumped_point,
    operating_point,
    piston_acceleration,
    piston_area,
    piston_displacement,
    piston_velocity,
    plate_axes,
)
from system.multibody.closure import closure
from system.multibody.joints import wrench
from system.multibody.kinematics import BoreCircle, Plate, axial_rates, ball_motion, circle_of, cross, dot, swash_angle
from system.multibody.retainer import guide_contact, guide_loss
from system.multibody.rotating_group import JointForces
from system.pump.laws.kinematics import crossed_drive, slipper_sliding_speed
from system.pump.laws.retainer import BallGuide, mean_sliding_speed

DEGREES = np.pi / 180.0
ANGLE = 2 * np.pi * np.arange(72) / 72
SPEED = 220.0
CIRCLES = {
    "cylinder": BoreCircle(45e-3, 0.0),
    "cone": BoreCircle(45e-3, 5 * DEGREES),
    "crossed and off the shaft": BoreCircle(45e-3, 5 * DEGREES, 2 * DEGREES, 6e-3),
}


def found(pump: PumpDescription, **asked: float) -> JointForces:
    return joint_forces(pump, lumped_point(pump, operating_point(pump, **asked)))


@pytest.mark.parametrize("name", CIRCLES)
def test_derivatives_of_the_place_along_the_bore(name):
    """Central differences at two steps, Richardson: error of fourth order, 1e-13 of rounding over the step."""
    circle, at, h = CIRCLES[name], 13 * DEGREES, 2e-3

    def place(dg: float, dphi: float) -> np.ndarray:
        return axial_rates(circle, Plate(at + dg), ANGLE + dphi).place

    def differences(step: float) -> np.ndarray:
        up, down = place(step, 0.0), place(-step, 0.0)
        on, back, here = place(0.0, step), place(0.0, -step), place(0.0, 0.0)
        corners = place(step, step) - place(step, -step) - place(-step, step) + place(-step, -step)
        return np.array(
            [
                (on - back) / (2 * step), (up - down) / (2 * step), (on - 2 * here + back) / step**2,
                corners / (4 * step**2), (up - 2 * here + down) / step**2,
            ]
        )  # fmt: skip

    expected = (4 * differences(h) - differences(2 * h)) / 3
    rates = axial_rates(circle, Plate(at), ANGLE)
    obtained = np.array([rates.phi, rates.tilt, rates.phi_phi, rates.phi_tilt, rates.tilt_tilt])
    np.testing.assert_allclose(obtained, expected, atol=1e-10)


def test_place_along_the_bore_is_equation_6():
    drive = SwashDrive(45e-3, 5 * DEGREES, 16.2 * DEGREES)
    rates = axial_rates(circle_of(drive), Plate(drive.swash_angle), ANGLE)
    np.testing.assert_allclose(rates.place - rates.place[0], piston_displacement(drive, ANGLE), atol=1e-17)
    np.testing.assert_allclose(rates.phi * SPEED, piston_velocity(drive, ANGLE, SPEED), atol=1e-14)
    np.testing.assert_allclose(rates.phi_phi * SPEED**2, piston_acceleration(drive, ANGLE, SPEED), atol=1e-11)


def test_a_cross_angle_moves_the_dead_centres_as_the_drive_says():
    swash, tilt = 12 * DEGREES, 3 * DEGREES
    drive = crossed_drive(45e-3, 5 * DEGREES, swash, tilt)
    own = axial_rates(BoreCircle(45e-3, 5 * DEGREES, tilt), Plate(swash), ANGLE - drive.dead_centre_shift)
    np.testing.assert_allclose(own.phi * SPEED, piston_velocity(drive, ANGLE, SPEED), atol=1e-14)


@pytest.mark.parametrize("name", CIRCLES)
def test_a_ball_moves_as_its_place_does(name):
    """Velocity and acceleration in space against differences in time, the plate swinging too."""
    circle, h = CIRCLES[name], 1e-5
    swing = Plate(10 * DEGREES, 3.0, -400.0)

    def at(time: float):
        tilt = swing.angle + swing.rate * time + 0.5 * swing.acceleration * time**2
        moved = Plate(tilt, swing.rate + swing.acceleration * time, swing.acceleration)
        return ball_motion(circle, moved, ANGLE + SPEED * time, SPEED)

    before, here, after = at(-h), at(0.0), at(h)
    size = 45e-3 * SPEED
    np.testing.assert_allclose((after.place - before.place) / (2 * h), here.velocity, atol=1e-4 * size)
    gained = (after.velocity - before.velocity) / (2 * h)
    np.testing.assert_allclose(gained, here.acceleration, atol=1e-4 * size * SPEED)


BUILDS = {
    "ref90": ("ref90", {}, 1.0),
    "ref90 at part stroke": ("ref90", {}, 0.28),
    "seven pistons": ("ref90", {"pump.pistons": 7, "pump.displacement": "69.9 cm3/rev"}, 1.0),
    "eight pistons": ("ref90", {"pump.pistons": 8, "pump.displacement": "79.87 cm3/rev"}, 0.7),
    "eleven pistons": (
        "ref90",
        {"pump.pistons": 11, "pump.pitch_radius": "56 mm", "pump.displacement": "136.7 cm3/rev"},
        1.0,
    ),
    "cylindrical block": ("ref90", {"pump.bore_cone_angle": "0 deg", "pump.displacement": "89.46 cm3/rev"}, 1.0),
    "cross angle": ("ref90", {"pump.cross_angle": "2 deg"}, 0.9),
    "plate that droops": ("ref90", {"physics.swash_droop.rate": "3 deg/GPa"}, 1.0),
    "retainer that stands": ("ref90", {"retainer.kind": "clearance"}, 1.0),
    "short guide, bearings stated": (
        "ref90",
        {"piston.guide_length": "35 mm", "bearings.front_position": "0.2 m", "bearings.rear_position": "-30 mm"},
        1.0,
    ),
}


@pytest.mark.parametrize("build", BUILDS)
def test_forces_moments_and_power_close(build):
    """Sums of what acts from outside know of no joint; ten sums of round-off at the most."""
    name, stated, ratio = BUILDS[build]
    closed = closure(found(load_pump(name, stated), displacement_ratio=ratio))
    assert max(closed.force, closed.moment, closed.power) < 1e-13


@pytest.mark.parametrize("build", ["ref90", "ref90 at part stroke", "cross angle", "plate that droops"])
def test_drive_torque_is_that_of_the_energy_balance(build):
    name, stated, ratio = BUILDS[build]
    pump = load_pump(name, stated)
    point = lumped_point(pump, operating_point(pump, displacement_ratio=ratio))
    torque = joint_forces(pump, point).shaft.torque
    np.testing.assert_allclose(torque, point.shaft_torque, rtol=1e-12)


def test_chambers_that_differ_close_and_give_the_mean_torque():
    """Masses and pressures of each, friction the mean of all: the torque agrees in the mean over the turn."""
    pump = load_pump("ref90")
    heavy = replace(pump.piston, mass=0.3, radial_clearance=30e-6)
    pump = replace(pump, single_pistons=((4, heavy),))
    point = lumped_point(pump, operating_point(pump))
    joints = joint_forces(pump, point)
    closed = closure(joints)
    assert len(joints.sets) == 9
    assert max(closed.force, closed.moment, closed.power) < 1e-13
    assert np.mean(joints.shaft.torque) == pytest.approx(np.mean(point.shaft_torque), rel=1e-3)


def test_a_joint_left_on_one_part_alone_is_seen():
    """The check can fail: a bearing's force, a slipper's friction, a spline's torque changed by a hundredth."""
    joints = found(load_pump("ref90"))
    front = replace(joints.shaft, front=1.01 * joints.shaft.front)
    assert closure(replace(joints, shaft=front)).force > 1e-4
    turned = replace(joints.shaft, torque=1.01 * joints.shaft.torque)
    assert closure(replace(joints, shaft=turned)).power > 1e-3
    rubbed = replace(joints.sets[0], plate=joints.sets[0].plate * np.array([[1.0], [1.01], [1.0]]))
    assert closure(replace(joints, sets=(rubbed,))).moment > 1e-5


def test_ball_and_plate_are_those_of_the_joint_balance():
    """Without a spring on the slippers they are `gaps.loads.ball_joint`'s, angle by angle."""
    joints = found(load_pump("ref90", {"retainer.kind": "clearance"}))
    group, own, one = joints.group, joints.loads[0], joints.sets[0]
    pushing = joints.hold.pushing
    normal = plate_axes(group.drive)[2]
    for k in range(0, group.shaft_angle.size, 45):
        angle = float(group.shaft_angle[k])
        axis, place = bore_axis(group.drive, angle), group.ball.place[:, k]
        way = piston_velocity(group.drive, angle, group.point.shaft_speed)
        gain = piston_acceleration(group.drive, angle, group.point.shaft_speed)
        rate = swept_acceleration(place, axis, float(way), float(gain), group.point.shaft_speed)
        piston = DrivenBody(own.masses.piston, rate, own.known.along_bore[k] * axis)
        slipper = DrivenBody(own.masses.slipper, rate, own.known.rubbing[:, k] + pushing[:, k])
        forces = ball_forces(axis, normal, piston, slipper)
        np.testing.assert_allclose(one.ball[:, k], forces.ball, atol=1e-8)
        np.testing.assert_allclose((one.edge + one.inner)[:, k], forces.side, atol=1e-8)
        assert one.lift[k] - joints.hold.pressing[k] == pytest.approx(forces.lift, abs=1e-8)


def test_control_moment_is_that_of_virtual_work():
    """The plate's moment against the work that all forces do as it swings: no joint of it is the other's."""
    joints = found(load_pump("ref90"))
    group, own, axis = joints.group, joints.loads[0], joints.group.ball.axis
    rates = axial_rates(circle_of(group.drive), Plate(group.drive.swash_angle), group.shaft_angle)
    inertia = (own.masses.piston + own.masses.slipper) * dot(group.ball.acceleration, axis)
    work = rates.tilt * (own.known.along_bore + dot(own.known.rubbing, axis) - inertia)
    np.testing.assert_allclose(joints.plate.control, -group.whole([work]), atol=1e-9)


def test_inertia_moment_on_the_plate(validation):
    joints = found(load_pump("ref90", BUILDS["cylindrical block"][1]))
    pump, drive = joints.group.pump, joints.group.drive
    rates = axial_rates(circle_of(drive), Plate(drive.swash_angle), joints.group.shaft_angle)
    mass, speed = pump.piston.mass + pump.slipper.mass, joints.group.point.shaft_speed
    moment = -mass * joints.group.whole([rates.tilt * rates.phi_phi]) * speed**2
    tangent = np.tan(drive.swash_angle)
    validation(
        case="inertia of nine pistons on a swash plate, cylindrical block",
        source="z/2 m R^2 w^2 tan g/cos^2 g, closed form",
        quantity="moment at 2100 r/min and 16.2 deg",
        unit="N m",
        expected=4.5 * mass * drive.pitch_radius**2 * speed**2 * tangent / np.cos(drive.swash_angle) ** 2,
        obtained=float(moment.mean()),
        relative_tolerance=1e-12,
    )


def test_pressure_switched_after_the_dead_centres(validation):
    """Square pressure on a massless group: the plate's mean moment, by the control that holds it."""
    drive, shift, pressure = SwashDrive(45e-3, 0.0, 16.2 * DEGREES), 8 * DEGREES, 30e6
    area = piston_area(load_pump("ref90"))
    angle = 2 * np.pi * (np.arange(7200) + 0.5) / 7200
    rates = axial_rates(circle_of(drive), Plate(drive.swash_angle), angle)
    pushed = np.where(np.sin(angle - shift) < 0.0, area * pressure, 0.0)
    validation(
        case="pressure moment on a swash plate, pressure switched after the dead centres",
        source="-z A p R sin(delta)/(pi cos^2 g), closed form",
        quantity="mean at 30 MPa, 8 deg",
        unit="N m",
        expected=-9 * area * pressure * 45e-3 * np.sin(shift) / (np.pi * np.cos(drive.swash_angle) ** 2),
        obtained=9 * float(np.mean(pushed * rates.tilt)),
        relative_tolerance=(np.pi / 7200) ** 2 * 2,  # midpoint rule, its bends on edges of the grid
    )


def test_ball_guide_takes_the_power_of_its_friction(validation):
    """Friction's moment times the turning of the retainer against the guide; the law's 1/cos g."""
    guide, axes, speed = BallGuide(22e-3, 30 * DEGREES), plate_axes(SwashDrive(45e-3, 0.0, 16.2 * DEGREES)), 220.0
    loss = guide_loss(0.12, 1080.0, guide, axes, speed)
    contact = guide_contact(guide, axes, speed, 1080.0, loss)
    turning = speed * (axes[2] - np.array([0.0, 0.0, 1.0]))
    assert -contact.moment @ turning == pytest.approx(loss, rel=1e-12)
    assert contact.force[2] == pytest.approx(1080.0, rel=1e-12)
    nominal = 0.12 * 1080.0 / np.sin(30 * DEGREES) * mean_sliding_speed(guide, 16.2 * DEGREES, speed)
    validation(
        case="ball guide and retainer: loss by the guide's balance over REF90's nominal law",
        source="1/cos g, paper Eq. (23)",
        quantity="ratio at 16.2 deg",
        unit="1",
        expected=1.0 / np.cos(16.2 * DEGREES),
        obtained=float(loss / nominal),
        relative_tolerance=1e-12,
    )


def test_the_retainer_hands_on_what_the_guide_gives_it():
    """Sum and moment about the guide's centre of all slippers' share; evenly but for what holds the moment."""
    joints = found(load_pump("ref90"))
    group, held = joints.group, joints.hold
    normal = group.plate_axes[2][:, None]
    about = group.ball.place - group.places.pivot * np.array([[0.0], [0.0], [1.0]])
    given = held.pressing * normal + held.pushing
    for values, expected in ((given, joints.guide.force), (cross(about, given), joints.guide.moment)):
        np.testing.assert_allclose(group.whole([values]), np.outer(expected, np.ones(360)), atol=1e-9)
    assert np.max(np.abs(dot(held.pushing, normal))) < 1e-12
    even = np.linalg.norm(joints.guide.force @ group.plate_axes[2]) / 9
    assert np.max(np.abs(held.pressing - even)) < 0.25 * even


def test_bearings_share_the_side_force_as_stated():
    """Left out, their places are those at which a side force in the plane of the balls gives the stated shares."""
    joints = found(load_pump("ref90"))
    front, rear = joints.shaft.front[:2], joints.shaft.rear[:2]
    share = np.linalg.norm(front.mean(axis=1)) / np.linalg.norm((front + rear).mean(axis=1))
    assert share == pytest.approx(0.62, rel=1e-3)
    assert {taken.path for taken in joints.group.places.taken} >= {"bearings.front_position", "block.spline_position"}


@pytest.mark.parametrize("strokes", ["up", "down"])
def test_trunnion_and_actuator_hold_the_plate(strokes):
    """All on the plate sums to nothing; the trunnion bears no moment about the tilt axis."""
    joints = found(load_pump("ref90", {"pump.cross_angle": "2 deg", "actuator.strokes": strokes}))
    group, plate = joints.group, joints.plate
    from_slippers = -group.whole([wrench(one.plate, group.ball.place, one.plate_moment) for one in joints.sets])
    assert np.max(np.abs(from_slippers + plate.trunnion + plate.actuator)) < 1e-9
    pivot = group.places.pivot * np.array([[0.0], [0.0], [1.0]])
    about = plate.trunnion[3:] - cross(pivot, plate.trunnion[:3])
    assert np.max(np.abs(group.tilt_axis @ about)) < 1e-9
    way = 1.0 if strokes == "up" else -1.0
    lever = group.places.arm * np.cos(swash_angle(group.drive))
    np.testing.assert_allclose(way * lever * plate.actuator[2], plate.control, rtol=1e-12)


def test_a_slipper_that_lifts_is_told():
    """No charge pressure at twice the speed: inertia pulls slippers off where suction begins."""
    pump = load_pump("ref90")
    calm = joint_forces(pump, lumped_point(pump, operating_point(pump)))
    assert force_warnings(calm) == []
    wild = found(pump, shaft_speed=440.0, inlet_pressure=0.0, case_pressure=0.2e6)
    assert "slipper_lifts" in force_warnings(wild)[0]


def test_sliding_speed_of_the_moving_group_is_equation_9():
    drive = SwashDrive(45e-3, 5 * DEGREES, 16.2 * DEGREES)
    ball = ball_motion(circle_of(drive), Plate(drive.swash_angle), ANGLE, SPEED)
    speed = np.linalg.norm(ball.velocity, axis=0)
    np.testing.assert_allclose(speed, slipper_sliding_speed(drive, ANGLE, SPEED), rtol=1e-12)
