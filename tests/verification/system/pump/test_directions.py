"""Forces between swash plate, ball and bore in space, against statics written out by hand."""

import numpy as np
import pytest

from gaps import DrivenBody, ball_forces
from system import SwashDrive, bore_axis, plate_axes, slipper_acceleration, slipper_sliding_velocity
from system.pump.laws.directions import bore_sides
from system.pump.laws.kinematics import ball_radius

ANGLES = np.linspace(0.0, 2.0 * np.pi, 13)
CONICAL = SwashDrive(45e-3, np.radians(5.0), np.radians(16.2))
CYLINDRICAL = SwashDrive(30e-3, 0.0, np.radians(18.0))


def forces(drive: SwashDrive, angle: float, axial: float) -> tuple[float, np.ndarray]:
    """Normal force of the plate, and its force across the bore, on massless parts pushed along the bore."""
    axis, nothing = bore_axis(drive, angle), np.zeros(3)
    pushed, massless = DrivenBody(0.0, nothing, axial * axis), DrivenBody(0.0, nothing, nothing)
    found = ball_forces(axis, plate_axes(drive)[2], pushed, massless)
    return found.lift, -bore_sides(drive, angle) @ found.side


@pytest.mark.parametrize("drive", [CONICAL, CYLINDRICAL])
@pytest.mark.parametrize("angle", ANGLES)
def test_frames_are_orthonormal_and_right_handed(drive, angle):
    bore = np.vstack([bore_sides(drive, angle), bore_axis(drive, angle)])
    for frame in (bore, plate_axes(drive)):
        np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-14)
        assert np.linalg.det(frame) == pytest.approx(1.0)


@pytest.mark.parametrize("drive", [CONICAL, CYLINDRICAL])
@pytest.mark.parametrize("angle", ANGLES)
def test_pressure_plate_and_bore_forces_balance(drive, angle):
    # Unknowns: plate force along its normal, bore force across the bore (two parts); three equations of statics.
    axial = 1.3e4
    x, y = bore_sides(drive, angle)
    columns = np.column_stack([-plate_axes(drive)[2], x, y])
    normal, held_x, held_y = np.linalg.solve(columns, -axial * bore_axis(drive, angle))
    lift, side = forces(drive, angle, axial)
    assert lift == pytest.approx(normal, rel=1e-13)
    np.testing.assert_allclose(side, [-held_x, -held_y], atol=1e-9 * axial)


@pytest.mark.parametrize("angle", ANGLES)
def test_a_cylindrical_block_has_the_nominal_forces(angle):
    gamma = CYLINDRICAL.swash_angle
    lift, side = forces(CYLINDRICAL, angle, 1.0)
    assert lift == pytest.approx(1.0 / np.cos(gamma))
    np.testing.assert_allclose(side, [-np.tan(gamma), 0.0], atol=1e-14)


def test_plate_and_bore_stand_at_the_difference_and_the_sum_of_their_angles():
    # In the plane of the swash angle the side force is Fa tan of the angle between bore axis and plate normal.
    for angle, between in ((0.0, np.radians(11.2)), (np.pi, np.radians(21.2))):
        assert forces(CONICAL, angle, 1.0)[1][0] == pytest.approx(-np.tan(between), rel=1e-12)


@pytest.mark.parametrize("drive", [CONICAL, CYLINDRICAL])
@pytest.mark.parametrize("angle", ANGLES)
def test_slipper_acceleration_is_the_slope_of_its_velocity(drive, angle):
    speed, step = 220.0, 1e-5
    ahead, behind = (slipper_sliding_velocity(drive, angle + s, speed) for s in (step, -step))
    slope = (ahead - behind) / (2.0 * step) * speed
    scale = drive.pitch_radius * speed**2
    np.testing.assert_allclose(slipper_acceleration(drive, angle, speed), slope, atol=1e-8 * scale)


def test_balls_lie_on_the_bore_axes():
    # The bore axes meet at R/sin(beta) below the balls' circle at zero swash; the plate passes its centre.
    apex = CONICAL.pitch_radius / np.tan(CONICAL.bore_cone_angle)
    for angle in ANGLES:
        axis, normal = bore_axis(CONICAL, angle), plate_axes(CONICAL)[2]
        along = apex * normal[2] / (axis @ normal)
        assert np.hypot(*(along * axis)[:2]) == pytest.approx(float(ball_radius(CONICAL, angle)), rel=1e-12)
