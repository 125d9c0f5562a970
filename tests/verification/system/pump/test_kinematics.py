"""Kinematics against independent vector geometry: the ball centre is where a bore's axis cuts the swash plane."""

import numpy as np
import pytest

from gaps import DrivenBody, ball_forces, swept_acceleration
from system import bore_axis, load_pump, operating_point, piston_area, plate_axes, rotor
from system.pump.laws import friction_pairs as pairs, kinematics as kin

RATED_SPEED = 2100.0 * 2.0 * np.pi / 60.0
ANGLES = np.linspace(0.0, 2.0 * np.pi, 721)
REF90 = kin.SwashDrive(45e-3, np.radians(5.0), np.radians(16.2))
DRIVES = [
    REF90,
    kin.SwashDrive(45e-3, 0.0, np.radians(16.2)),
    kin.SwashDrive(30e-3, np.radians(20.0), np.radians(25.0)),
]


def ball_centre(drive: kin.SwashDrive, angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Way along the bore and position (x along the shaft, out of the block): line cut with plane."""
    ways, points = [], []
    for phi in angle:
        radial = np.array([0.0, np.cos(phi), np.sin(phi)])
        start = drive.pitch_radius * radial
        along = np.array([np.cos(drive.bore_cone_angle), 0.0, 0.0]) + np.sin(drive.bore_cone_angle) * radial
        normal = np.array([np.cos(drive.swash_angle), np.sin(drive.swash_angle), 0.0])
        way = -(normal @ start) / (normal @ along)
        ways.append(way)
        points.append(start + way * along)
    return np.array(ways), np.array(points).T


@pytest.mark.parametrize("drive", DRIVES)
def test_displacement_is_the_intersection_of_bore_and_swash_plane(drive):
    way, _ = ball_centre(drive, ANGLES)
    start, _ = ball_centre(drive, np.array([0.0]))
    np.testing.assert_allclose(kin.piston_displacement(drive, ANGLES), way - start, atol=1e-16, rtol=1e-12)
    assert kin.stroke(drive) == pytest.approx(np.ptp(way), rel=1e-12)


@pytest.mark.parametrize("drive", DRIVES)
def test_velocity_and_acceleration_are_derivatives(drive):
    h = 1e-5  # central differences: error h^2/6 of the third derivative, 1e-10 of the amplitude
    ahead, behind = kin.piston_displacement(drive, ANGLES + h), kin.piston_displacement(drive, ANGLES - h)
    speed = RATED_SPEED * (ahead - behind) / (2 * h)
    scale = RATED_SPEED * drive.stroke_scale
    np.testing.assert_allclose(kin.piston_velocity(drive, ANGLES, RATED_SPEED), speed, atol=1e-8 * scale)
    ahead = kin.piston_velocity(drive, ANGLES + h, RATED_SPEED)
    behind = kin.piston_velocity(drive, ANGLES - h, RATED_SPEED)
    acceleration = RATED_SPEED * (ahead - behind) / (2 * h)
    np.testing.assert_allclose(
        kin.piston_acceleration(drive, ANGLES, RATED_SPEED), acceleration, atol=1e-8 * scale * RATED_SPEED
    )


@pytest.mark.parametrize("drive", DRIVES)
def test_sliding_velocity_is_the_ball_centres_in_the_swash_plane(drive):
    h = 1e-5
    _, ahead = ball_centre(drive, ANGLES + h)
    _, behind = ball_centre(drive, ANGLES - h)
    velocity = RATED_SPEED * (ahead - behind) / (2 * h)
    steepest = np.array([-np.sin(drive.swash_angle), np.cos(drive.swash_angle), 0.0])
    in_plane = np.stack([steepest @ velocity, velocity[2]])
    scale = RATED_SPEED * drive.pitch_radius
    np.testing.assert_allclose(kin.slipper_sliding_velocity(drive, ANGLES, RATED_SPEED), in_plane, atol=1e-8 * scale)
    speed = np.linalg.norm(velocity, axis=0)
    np.testing.assert_allclose(kin.slipper_sliding_speed(drive, ANGLES, RATED_SPEED), speed, atol=1e-8 * scale)


def test_the_printed_sliding_speed_is_off_by_what_the_seed_says():
    b, g, c, s = REF90.bore_cone_angle, REF90.swash_angle, np.cos(ANGLES), np.sin(ANGLES)
    t = np.tan(b) * np.tan(g)
    ellipse = c**2 + np.cos(g) ** 2 * s**2
    first = REF90.pitch_radius * np.cos(g + b) * np.sqrt(ellipse)
    first /= (np.cos(g) * np.cos(b) - np.sin(g) * np.sin(b) * c) * np.cos(g)
    printed = first * RATED_SPEED * np.cos(g) * (1 + t) / ((1 - t) * ellipse)
    ratio = printed / kin.slipper_sliding_speed(REF90, ANGLES, RATED_SPEED)
    assert ratio.min() == pytest.approx(0.975, abs=5e-4)
    assert ratio.max() == pytest.approx(1.079, abs=5e-4)


def test_a_cylindrical_block_is_the_limit_of_a_conical_one():
    straight = kin.SwashDrive(45e-3, 0.0, np.radians(16.2))
    nearly = kin.SwashDrive(45e-3, 1e-9, np.radians(16.2))
    expected = 45e-3 * np.tan(np.radians(16.2)) * (1 - np.cos(ANGLES))
    np.testing.assert_allclose(kin.piston_displacement(straight, ANGLES), expected, rtol=1e-14, atol=1e-18)
    np.testing.assert_allclose(kin.piston_displacement(nearly, ANGLES), expected, rtol=1e-8, atol=1e-18)
    assert kin.swash_angle_for_stroke(kin.stroke(straight), 45e-3, 0.0) == pytest.approx(straight.swash_angle)


def test_ref90_check_values():
    area = np.pi / 4 * 22e-3**2
    assert kin.stroke(REF90) == pytest.approx(26.264e-3, abs=0.5e-6)
    assert kin.displacement(9, area, kin.stroke(REF90)) == pytest.approx(89.86e-6, abs=0.005e-6)
    fine = np.linspace(0, 2 * np.pi, 20001)
    assert kin.piston_velocity(REF90, fine, RATED_SPEED).max() == pytest.approx(2.890, abs=5e-4)
    assert np.abs(kin.piston_acceleration(REF90, fine, RATED_SPEED)).max() == pytest.approx(668.0, abs=0.5)


@pytest.mark.parametrize(
    ("ratio", "degrees"), [(0.13, 2.164), (0.28, 4.653), (0.51, 8.432), (0.52, 8.595), (0.77, 12.613)]
)
def test_swash_angle_at_reduced_displacement(ratio, degrees):
    drive = kin.drive_at_ratio(REF90, ratio)
    assert np.degrees(drive.swash_angle) == pytest.approx(degrees, abs=5e-4)
    assert kin.stroke(drive) == pytest.approx(ratio * kin.stroke(REF90), rel=1e-13)
    assert kin.stand_out(REF90, drive) == pytest.approx((1 - ratio) * kin.stroke(REF90) / 2, rel=1e-12)


def test_a_swash_plane_that_misses_a_bore_axis_is_refused():
    with pytest.raises(ValueError, match="below 1"):
        kin.SwashDrive(45e-3, np.radians(60.0), np.radians(60.0))


@pytest.mark.parametrize("cone", [0.0, 5.0, 12.0])
def test_acceleration_along_the_bore_is_that_of_the_ball_in_space(cone):
    """Second differences of the ball's place, along the bore: Eq. (8) alone misses the turning of the bore."""
    drive = kin.SwashDrive(45e-3, np.radians(cone), np.radians(16.2))
    step = 1e-4
    for angle in (0.3, 2.0, 4.5):
        phi = angle + step * np.array([-1.0, 0.0, 1.0])
        radius = kin.ball_radius(drive, phi)
        place = np.stack(
            [radius * np.cos(phi), radius * np.sin(phi), -radius * np.cos(phi) * np.tan(drive.swash_angle)]
        )
        rate = RATED_SPEED**2 * (place[:, 0] - 2.0 * place[:, 1] + place[:, 2]) / step**2
        along = float(bore_axis(drive, angle) @ rate)
        found = float(kin.ball_acceleration_along_bore(drive, angle, RATED_SPEED))
        assert found == pytest.approx(along, abs=1e-5 * RATED_SPEED**2 * drive.pitch_radius)
    if cone:
        sliding = float(kin.piston_acceleration(drive, 2.0, RATED_SPEED))
        assert abs(float(kin.ball_acceleration_along_bore(drive, 2.0, RATED_SPEED)) - sliding) > 100.0


def test_force_on_the_plate_is_that_of_the_ball_joint_on_a_conical_block():
    """ref90's plate force by Fa against the balance of a body at the ball, in vectors."""
    group, angle, above = rotor(load_pump("ref90"), operating_point(load_pump("ref90"))), 4.0, 30e6
    drive, speed, pump = group.drive, group.point.shaft_speed, group.pump
    axis, plate = bore_axis(drive, angle), plate_axes(drive)
    velocity, sliding = (float(law(drive, angle, speed)) for law in (kin.piston_velocity, kin.piston_acceleration))
    radius = float(kin.ball_radius(drive, angle))
    ball = radius * np.array([np.cos(angle), np.sin(angle), 0.0])
    rate = swept_acceleration(ball, axis, velocity, sliding, speed)
    push = piston_area(pump) * above * axis
    both = DrivenBody(pump.piston.mass + pump.slipper.mass, rate, push)
    lift = ball_forces(axis, plate[2], both, DrivenBody(0.0, np.zeros(3), np.zeros(3))).lift
    mass, at_ball = both.mass, float(kin.ball_acceleration_along_bore(drive, angle, speed))
    axial = pairs.axial_force(np.array(above), 0.0, piston_area(pump), mass, np.array(at_ball))
    assert float(axial) / (plate[2] @ axis) == pytest.approx(lift, rel=1e-12)
