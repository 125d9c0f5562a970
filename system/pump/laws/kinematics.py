"""Kinematics of the conical-block swash plate machine: Eqs. (6)-(9) of Xu, Hu, Zhang and Mao (2017), corrected.

Shaft angle 0 is the inner dead centre (smallest chamber); 0 .. pi is suction. All laws are written with the
scale R tan(gamma)/cos(beta) in place of the paper's (R/sin(beta)) t, t = tan(beta) tan(gamma): the same number,
and finite for a cylindrical block (beta = 0). All are valid for t < 1 (the swash plane cuts every bore axis).
"""

from dataclasses import dataclass
from typing import Generic

import numpy as np
from typing_extensions import TypeVar

from reynolds.numerics.arrays import Array

Number = TypeVar("Number", float, Array, default=float)
"""A quantity of one operating point, or of N points a column (N, 1); each row is over the shaft angles."""


@dataclass(frozen=True)
class SwashDrive(Generic[Number]):
    """Geometry that moves the pistons: pitch_radius in m (ball centres at zero swash), angles in rad.

    swash_angle is the plate's whole tilt, dead_centre_shift the angle from the inner dead centre on to the valve
    plate's own axis: 0 without a cross angle (`crossed_drive`). Raises ValueError when the swash plane no longer
    cuts every bore axis (tan(beta) tan(gamma) >= 1).
    """

    pitch_radius: float
    bore_cone_angle: float
    swash_angle: Number
    dead_centre_shift: Number | float = 0.0

    def __post_init__(self) -> None:
        product = np.asarray(self.cone_swash_product)
        if not np.all((product >= 0.0) & (product < 1.0)):
            raise ValueError(
                f"swash angle {np.degrees(np.max(self.swash_angle)):.3g} deg with bore cone angle "
                f"{np.degrees(self.bore_cone_angle):.3g} deg: tan(cone) tan(swash) is "
                f"{np.max(product):.3g}, expected 0 or more and below 1"
            )

    @property
    def cone_swash_product(self) -> Number:
        """t = tan(beta) tan(gamma), dimensionless; zero for a cylindrical block."""
        return np.tan(self.bore_cone_angle) * np.tan(self.swash_angle)

    @property
    def stroke_scale(self) -> Number:
        """R tan(gamma)/cos(beta) in m: half the stroke of the machine except for terms of order t^2."""
        return self.pitch_radius * np.tan(self.swash_angle) / np.cos(self.bore_cone_angle)


def piston_displacement(drive: SwashDrive[Number], shaft_angle: Array | float) -> Array:
    """Way of the piston out of the block from its inner dead centre, in m; paper Eq. (6).

    Solves S = (R/sin b) t/(1+t) (1-cos phi)/(1+t cos phi); shape of `shaft_angle` (rad).
    """
    t = drive.cone_swash_product
    c = np.cos(shaft_angle)
    return np.asarray(drive.stroke_scale * (1.0 - c) / ((1.0 + t) * (1.0 + t * c)))


def stroke(drive: SwashDrive[Number]) -> Number:
    """Full stroke in m, Eq. (6) at the outer dead centre: H = (R/sin b) 2t/(1-t^2)."""
    return 2.0 * drive.stroke_scale / (1.0 - drive.cone_swash_product**2)


def piston_velocity(drive: SwashDrive[Number], shaft_angle: Array | float, shaft_speed: Number) -> Array:
    """Velocity of the piston along its bore in m/s, positive out of the block; paper Eq. (7).

    Solves v = w (R/sin b) t sin phi/(1+t cos phi)^2; shaft_speed w in rad/s.
    """
    t = drive.cone_swash_product
    return np.asarray(shaft_speed * drive.stroke_scale * np.sin(shaft_angle) / (1.0 + t * np.cos(shaft_angle)) ** 2)


def piston_acceleration(drive: SwashDrive[Number], shaft_angle: Array | float, shaft_speed: Number) -> Array:
    """Acceleration of the piston along its bore in m/s2 at constant shaft speed; paper Eq. (8), corrected.

    Solves a = w^2 (R/sin b) [t^2 (1+sin^2 phi) + t cos phi]/(1+t cos phi)^3. The print has cos phi where the
    derivative of Eq. (7) has t cos phi: 39 times too large at 5 deg cone and 16.2 deg swash.
    """
    t = drive.cone_swash_product
    c, s = np.cos(shaft_angle), np.sin(shaft_angle)
    return np.asarray(shaft_speed**2 * drive.stroke_scale * (t * (1.0 + s**2) + c) / (1.0 + t * c) ** 3)


def ball_acceleration_along_bore(drive: SwashDrive[Number], shaft_angle: Array | float, shaft_speed: Number) -> Array:
    """Acceleration of the ball centre along its bore in m/s2, out of the block, in a frame that does not turn.

    Eq. (8) less the bore's share of the centripetal acceleration, w^2 r sin(b): the block carries an inclined bore
    round. Equals Eq. (8) for a cylindrical block.
    """
    swept = shaft_speed**2 * ball_radius(drive, shaft_angle) * np.sin(drive.bore_cone_angle)
    return np.asarray(piston_acceleration(drive, shaft_angle, shaft_speed) - swept)


def slipper_sliding_velocity(drive: SwashDrive[Number], shaft_angle: Array | float, shaft_speed: Number) -> Array:
    """Velocity of the slipper's ball centre on the swash plate in m/s; paper Eq. (9), corrected.

    Shape (2, ...): along the swash plate's steepest line (the one square to its tilt axis) and along the tilt
    axis: v = R w (-sin phi/cos g, cos phi + t)/(1+t cos phi)^2. The printed Eq. (9) is 0.975 .. 1.079 times this
    magnitude over a turn of the paper's pump.
    """
    t = drive.cone_swash_product
    c, s = np.cos(shaft_angle), np.sin(shaft_angle)
    scale = drive.pitch_radius * shaft_speed / (1.0 + t * c) ** 2
    return np.stack([-scale * s / np.cos(drive.swash_angle), scale * (c + t)])


def slipper_sliding_speed(drive: SwashDrive[Number], shaft_angle: Array | float, shaft_speed: Number) -> Array:
    """Magnitude of `slipper_sliding_velocity` in m/s, shape of `shaft_angle`; paper Eq. (9), corrected."""
    return np.hypot(*slipper_sliding_velocity(drive, shaft_angle, shaft_speed))


def slipper_acceleration(drive: SwashDrive, shaft_angle: Array | float, shaft_speed: float) -> Array:
    """Acceleration (2, ...) m/s2 of the ball centre in the swash plate's plane: time derivative of Eq. (9), corrected.

    Axes as in `slipper_sliding_velocity`. P = R (cos phi/cos g, sin phi)/(1 + t cos phi) twice derived.
    """
    t, c, s = drive.cone_swash_product, np.cos(shaft_angle), np.sin(shaft_angle)
    n = 1.0 + t * c
    along = -(c / n**2 + 2.0 * t * s**2 / n**3) / np.cos(drive.swash_angle)
    across = -s / n**2 + 2.0 * t * s * (c + t) / n**3
    return drive.pitch_radius * shaft_speed**2 * np.array([along, across])


def ball_radius(drive: SwashDrive[Number], shaft_angle: Array | float) -> Array:
    """Distance of a ball centre from the shaft axis in m: R/(1 + t cos phi), plate and bore axis cutting there."""
    return np.asarray(drive.pitch_radius / (1.0 + drive.cone_swash_product * np.cos(shaft_angle)))


def swash_angle_for_stroke(stroke_length: Number, pitch_radius: float, bore_cone_angle: float) -> Number:
    """Swash angle in rad that gives a stroke in m: the positive root of H (1-t^2) = 2 R tan(g)/cos(b).

    Written as tan g = H/(r + sqrt(r^2 + H^2 tan^2 b)), r = R/cos(b), which is exact for a cylindrical block.
    """
    radius = pitch_radius / np.cos(bore_cone_angle)
    root = np.hypot(radius, stroke_length * np.tan(bore_cone_angle))
    return np.arctan(stroke_length / (radius + root))


def crossed_drive(pitch_radius: float, bore_cone_angle: float, swash_angle: float, cross_angle: float) -> SwashDrive:
    """The drive of a plate tilted by a swash angle g and, fixed and about the axis square to it, a cross angle k.

    The plate z = -x tan g + y tan k is one of tilt G, tan^2 G = tan^2 g + tan^2 k, whose dead centres come
    earlier by atan2(tan k, tan g): counted from them all laws of this file hold, and ports lie later by that.
    """
    if cross_angle == 0.0:
        return SwashDrive(pitch_radius, bore_cone_angle, swash_angle)
    swash, cross = np.tan(swash_angle), np.tan(cross_angle)
    whole, shift = np.arctan(np.hypot(swash, cross)), np.arctan2(cross, swash)
    return SwashDrive(pitch_radius, bore_cone_angle, float(whole), float(shift))


def least_ratio(full: SwashDrive) -> float:
    """Displacement ratio at which the swash angle is zero and the cross angle alone moves the pistons."""
    cross = abs(np.tan(full.swash_angle) * np.sin(full.dead_centre_shift))
    alone = SwashDrive(full.pitch_radius, full.bore_cone_angle, float(np.arctan(cross)))
    return stroke(alone) / stroke(full)


def drive_at_ratio(full: SwashDrive, displacement_ratio: Number) -> SwashDrive[Number]:
    """The same pump set to a fraction of its full displacement; `full` is the drive at its largest swash angle.

    Displacement is proportional to the stroke, so the swash angle is the inverse of Eq. (6) at
    `displacement_ratio` (0 .. 1) times the full stroke. A cross angle stays; ValueError below `least_ratio`.
    """
    wanted = displacement_ratio * stroke(full)
    angle = swash_angle_for_stroke(wanted, full.pitch_radius, full.bore_cone_angle)
    if full.dead_centre_shift == 0.0:
        return SwashDrive(full.pitch_radius, full.bore_cone_angle, angle)
    if np.any(displacement_ratio < least_ratio(full)):
        raise ValueError(
            f"displacement ratio: found {np.min(displacement_ratio):.3g}, expected at least "
            f"{least_ratio(full):.3g}, that of the cross angle alone"
        )
    crossed = np.tan(full.swash_angle) * np.sin(full.dead_centre_shift) / np.tan(angle)
    return SwashDrive(full.pitch_radius, full.bore_cone_angle, angle, np.arcsin(np.clip(crossed, -1.0, 1.0)))


def stand_out(full: SwashDrive, drive: SwashDrive[Number]) -> Number:
    """Overhang of the piston at its inner dead centre beyond that at full displacement, in m: (H_max - H)/2.

    The plate pivots on the shaft axis, so both dead centres move towards mid stroke as the displacement is reduced.
    Exact for a cylindrical block; with a cone the mid point itself moves by less than t H_max/2 (0.33 mm on REF90),
    neglected so that the dead volume is the linear one REF90 states.
    """
    return (stroke(full) - stroke(drive)) / 2.0


def displacement(pistons: int, piston_area: float, stroke_length: float) -> float:
    """Geometric displacement per revolution in m3: z Ap H."""
    return pistons * piston_area * stroke_length
