"""Directions in space of bores and swash plate.

Pump frame: z along the shaft from valve plate to swash plate, x to the inner dead centre.
"""

import numpy as np

from reynolds.numerics.arrays import Array
from system.pump.laws.kinematics import SwashDrive


def bore_axis(drive: SwashDrive, shaft_angle: Array | float) -> Array:
    """Unit vectors (..., 3) of a bore axis at angles (...), out of the block; cones open towards the swash plate."""
    return cone_axis(drive.bore_cone_angle, shaft_angle)


def cone_axis(cone: float, shaft_angle: Array | float) -> Array:
    """The same (..., 3) of bores inclined to the shaft by a cone's half angle (rad)."""
    angle = np.asarray(shaft_angle)
    out = np.full(angle.shape, np.cos(cone))
    return np.stack([np.sin(cone) * np.cos(angle), np.sin(cone) * np.sin(angle), out], axis=-1)


def bore_sides(drive: SwashDrive, shaft_angle: Array | float) -> Array:
    """Two unit vectors (..., 2, 3) square to a bore axis: x towards the inner dead centre's side, y = axis cross x."""
    axis = bore_axis(drive, shaft_angle)
    side = np.array([1.0, 0.0, 0.0]) - axis[..., :1] * axis
    side /= np.linalg.norm(side, axis=-1, keepdims=True)
    return np.stack([side, np.cross(axis, side)], axis=-2)


def plate_axes(drive: SwashDrive) -> Array:
    """Unit vectors (3, 3) of the swash plate: steepest line, tilt axis (y), normal away from the block."""
    c, s = np.cos(drive.swash_angle), np.sin(drive.swash_angle)
    return np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
