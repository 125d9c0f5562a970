"""Places of the films in the pump: rigid geometry that the frames must keep."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gaps import slipper_mesh
from reynolds import film_space
from reynolds.fem.sphere import PLANE
from system import (
    RIGID,
    Gap,
    Rotor,
    floating_parts,
    load_pump,
    operating_point,
    piston_displacement,
    rotor,
    slipper_sliding_velocity,
    stroke,
)
from system.films.places import Frame, face_frame, guide_frame, place_of
from system.films.positions import instant_drives
from system.films.problems import piston_film
from system.films.rotor import travel

ANGLES = np.radians([0.0, 35.0, 90.0, 180.0, 250.0, 345.0])
PUMPS = ["ref90", str(Path(__file__).resolve().parents[4] / "examples/pumps/cylindrical_block.toml")]


def group(pump: str, ratio: float) -> Rotor:
    description = load_pump(pump)
    return rotor(description, operating_point(description, displacement_ratio=ratio))


def plate_normal(parts: Rotor) -> np.ndarray:
    gamma = parts.drive.swash_angle
    return np.array([np.sin(gamma), 0.0, np.cos(gamma)])


def bore_frame(parts: Rotor, angle: float) -> Frame:
    return guide_frame(parts, parts.pump.piston.engaged_length, angle)


def slipper_frame(parts: Rotor, angle: float) -> Frame:
    return face_frame(parts, HEIGHT, angle)


HEIGHT = 11e-3


def ball(parts: Rotor, angle: float) -> np.ndarray:
    """Ball centre from the piston's frame: guide and overhang of the instant along the bore."""
    frame, part = bore_frame(parts, angle), parts.pump.piston
    return frame.origin + (part.engaged_length + part.overhang + travel(parts, angle)) * frame.z


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("frame_of", [bore_frame, slipper_frame])
def test_frames_are_right_handed(frame_of, angle):
    frame: Frame = frame_of(group("ref90", 0.6), angle)
    axes = np.array([frame.x, frame.y, frame.z])
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(axes) == pytest.approx(1.0)


@pytest.mark.parametrize("pump", PUMPS)
@pytest.mark.parametrize("ratio", [1.0, 0.3])
def test_ball_stays_on_the_swash_plane(pump, ratio):
    """The height of the ball comes from the piston's way; the plane it must lie in from the swash angle alone."""
    parts = group(pump, ratio)
    height = [ball(parts, angle) @ plate_normal(parts) for angle in ANGLES]
    assert height == pytest.approx([height[0]] * len(ANGLES), abs=1e-9)


@pytest.mark.parametrize("pump", PUMPS)
def test_ball_moves_along_its_bore(pump):
    """Against the block, whose bore stands at the cone angle, the ball moves by the piston's displacement."""
    parts = group(pump, 1.0)
    for angle in ANGLES:
        way = ball(parts, angle) - _turn(angle) @ ball(parts, 0.0)
        axis = bore_frame(parts, angle).z
        assert np.cross(way, axis) == pytest.approx(np.zeros(3), abs=1e-12)
        assert way @ axis == pytest.approx(float(piston_displacement(parts.drive, angle)), abs=1e-12)
    assert (ball(parts, np.pi) - _turn(np.pi) @ ball(parts, 0.0))[2] < stroke(parts.drive) + 1e-12


def _turn(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


@pytest.mark.parametrize("angle", ANGLES)
def test_slipper_film_lies_in_the_plate(angle):
    """Film points lie in one plane parallel to the swash plane, beyond the balls, about the ball's foot."""
    parts = group("ref90", 1.0)
    taken, lands = floating_parts(parts.pump), parts.pump.slipper.lands
    space = film_space(slipper_mesh(lands.radii, (2, 12)))
    points = place_of(Gap.SLIPPER, parts, taken, angle)(space.vertices)
    normal, centre = plate_normal(parts), ball(parts, angle)
    beyond = (points - centre) @ normal
    assert beyond == pytest.approx(np.full(len(points), taken.slipper.ball_height), abs=1e-12)
    foot = centre + beyond[0] * normal
    away = np.linalg.norm(points - foot, axis=1)
    drawn = np.hypot(*space.vertices.T)
    assert (away.min(), away.max()) == pytest.approx((drawn.min(), drawn.max()))


@pytest.mark.parametrize("angle", ANGLES)
def test_slipper_slides_as_its_ball_moves(angle):
    """Finite difference of the ball's place along the film's x and y."""
    parts, step = group("ref90", 1.0), 1e-5
    frame, speed = slipper_frame(parts, angle), parts.point.shaft_speed
    way = (ball(parts, angle + step) - ball(parts, angle - step)) / (2.0 * step) * speed
    sliding = slipper_sliding_velocity(parts.drive, angle, speed)
    seen = np.array([frame.x, frame.y, frame.z]) @ way
    assert seen == pytest.approx([*sliding, 0.0], abs=1e-7 * np.hypot(*sliding))


@pytest.mark.parametrize("angle", ANGLES)
def test_piston_film_is_a_cylinder_about_the_bore(angle):
    parts = group("ref90", 1.0)
    taken, radius = floating_parts(parts.pump), parts.pump.pump.piston_diameter / 2
    drive = instant_drives(parts, taken, angle, np.array([1e6])).piston
    space = piston_film(parts, taken, drive, RIGID, (12, 2)).space_at(angle / drive.shaft_speed)
    points = place_of(Gap.PISTON, parts, taken, angle)(space.vertices)
    frame, out = bore_frame(parts, angle), travel(parts, angle)
    along = (points - ball(parts, angle)) @ frame.z
    across = points - ball(parts, angle) - along[:, None] * frame.z
    assert np.linalg.norm(across, axis=1) == pytest.approx(np.full(len(points), radius))
    assert along.max() == pytest.approx(-parts.pump.piston.overhang - out)  # the bore's case edge
    assert np.ptp(along) == pytest.approx(parts.pump.piston.engaged_length - out)
    # Angle 0 lies on the inner dead centre's side.
    assert frame.x[0] > 0.99 * np.linalg.norm(frame.x)
    assert frame.z[2] == pytest.approx(np.cos(parts.pump.pump.bore_cone_angle))


def test_valve_plate_lies_at_zero_height():
    flat = np.array([[30e-3, 0.0], [0.0, 30e-3], [-10e-3, 20e-3]])
    points = PLANE.in_space(flat)
    assert points[:, 2] == pytest.approx(np.zeros(3))
    assert points[:, :2] == pytest.approx(flat)
