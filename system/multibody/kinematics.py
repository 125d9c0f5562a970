"""Motion of pistons, balls and slippers under a swash plate at a variable tilt angle.

Frame and definitions as in `plate_kernels`; exact for a cone, a cross angle and a tilt axis off the shaft. For a
fixed plate whose tilt axis meets the shaft these are Eqs. (6)-(8), `system.pump.laws.kinematics`.
"""

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.multibody.plate_kernels import axial
from system.pump.laws.directions import cone_axis
from system.pump.laws.kinematics import SwashDrive

SHAFT = np.array([[0.0], [0.0], [1.0]])


@dataclass(frozen=True)
class BoreCircle:
    """Circle of the bores: pitch_radius m of the ball centres at zero tilt, cone rad; cross rad, the plate's fixed
    tilt about the other axis; pivot_offset m of the tilt axis from the shaft's, to the inner dead centre.
    """

    pitch_radius: float
    cone: float
    cross: float = 0.0
    pivot_offset: float = 0.0


@dataclass(frozen=True)
class Plate:
    """The swash plate's tilt: angle rad, rate rad/s, acceleration rad/s2; one, or one for each shaft angle."""

    angle: Array | float
    rate: Array | float = 0.0
    acceleration: Array | float = 0.0


@dataclass(frozen=True)
class AxialRates:
    """Place s (m) of balls along their bores, from the circle of C out of the block, and its derivatives by shaft
    angle phi and tilt g (m/rad, m/rad2), each (N,)."""

    place: Array
    phi: Array
    tilt: Array
    phi_phi: Array
    phi_tilt: Array
    tilt_tilt: Array

    def velocity(self, plate: Plate, speed: float) -> Array:
        """s' = s_phi w + s_g g' in m/s, out of the block."""
        return np.asarray(self.phi * speed + self.tilt * plate.rate)

    def acceleration(self, plate: Plate, speed: float) -> Array:
        """s'' = s_phiphi w^2 + 2 s_phig w g' + s_gg g'^2 + s_g g'' in m/s2, at constant shaft speed."""
        turning = self.phi_phi * speed**2 + 2.0 * self.phi_tilt * speed * plate.rate
        return np.asarray(turning + self.tilt_tilt * plate.rate**2 + self.tilt * plate.acceleration)


def swash_angle(drive: SwashDrive) -> float:
    """Tilt (rad) about the swash axis of a drive, whose own tilt a cross angle makes larger."""
    return float(np.arctan(np.tan(drive.swash_angle) * np.cos(drive.dead_centre_shift)))


def circle_of(drive: SwashDrive) -> BoreCircle:
    """The bores of a drive whose plate pivots on the shaft's axis, shaft angles from its own dead centre."""
    return BoreCircle(drive.pitch_radius, drive.bore_cone_angle)


def axial_rates(circle: BoreCircle, plate: Plate, shaft_angle: Array) -> AxialRates:
    """Place along the bore at shaft angles (N,) rad, with all derivatives; valid while the plate faces the
    bores."""
    at = np.asarray(shaft_angle, dtype=float)
    found = axial(at, plate.angle, circle.pitch_radius, circle.cone, circle.cross, circle.pivot_offset)
    return AxialRates(*found)


def bore_axes(cone: float, shaft_angle: Array) -> Array:
    """Unit vectors (3, N) of the bores' axes, out of the block."""
    return np.ascontiguousarray(cone_axis(cone, shaft_angle).T)


@dataclass(frozen=True)
class BallMotion:
    """A ball centre over N shaft angles: bore axis, place m, velocity m/s and acceleration m/s2 in space, (3, N);
    way: velocity along the bore m/s, (N,)."""

    axis: Array
    place: Array
    velocity: Array
    acceleration: Array
    way: Array


def ball_motion(circle: BoreCircle, plate: Plate, shaft_angle: Array, speed: float) -> BallMotion:
    """Motion of the ball centres; the places' heights count from the circle of C."""
    found = axial_rates(circle, plate, shaft_angle)
    axis = bore_axes(circle.cone, shaft_angle)
    radius = np.stack([np.cos(shaft_angle), np.sin(shaft_angle), np.zeros_like(shaft_angle)])
    place = circle.pitch_radius * radius + found.place * axis
    way, gain = found.velocity(plate, speed), found.acceleration(plate, speed)
    return BallMotion(axis, place, way * axis + speed * cross(SHAFT, place), swept(place, axis, way, gain, speed), way)


def swept(place: Array, axis: Array, way: Array, gain: Array, speed: float) -> Array:
    """Acceleration (3, N) of points that slide along axes which turn with the shaft.

    s'' a + 2 w s' z x a - w^2 r, r from the shaft's axis: `gaps.loads.ball_joint.swept_acceleration` at all angles.
    """
    inward = speed**2 * (place - SHAFT * place[2])
    return np.asarray(gain * axis + 2.0 * speed * way * cross(SHAFT, axis) - inward)


def cross(one: Array, two: Array) -> Array:
    """Vector products of (3, N) or (3, 1) vectors."""
    return np.asarray(np.cross(one, two, axis=0))


def dot(one: Array, two: Array) -> Array:
    """Scalar products (N,) of (3, N) or (3, 1) vectors."""
    return np.asarray(np.sum(one * two, axis=0))
