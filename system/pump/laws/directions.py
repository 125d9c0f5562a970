"""Directions in space of bores and swash plate.

Pump frame: z along the shaft from valve plate to swash plate, x to the inner dead centre.
"""

import numpy as np

from reynolds.numerics.arrays import Array
from system.pump.laws.kinematics import SwashDrive


def bore_axis(drive: SwashDrive, shaft_angle: float) -> Array:
    """Unit vector (3,) of a bore axis, out of the block; cones open towards the swash plate."""
    cone = drive.bore_cone_angle
    return np.array([np.sin(cone) * np.cos(shaft_angle), np.sin(cone) * np.sin(shaft_angle), np.cos(cone)], dtype=float)


def bore_sides(drive: SwashDrive, shaft_angle: float) -> Array:
    """Two unit vectors (2, 3) square to a bore axis: x towards the inner dead centre's side, y = axis cross x."""
    axis = bore_axis(drive, shaft_angle)
    side = np.array([1.0, 0.0, 0.0]) - axis[0] * axis
    side /= np.linalg.norm(side)
    (ax, ay, az), (x, y, z) = axis.tolist(), side.tolist()
    return np.array([[x, y, z], [ay * z - az * y, az * x - ax * z, ax * y - ay * x]])


def plate_axes(drive: SwashDrive) -> Array:
    """Unit vectors (3, 3) of the swash plate: steepest line, tilt axis (y), normal away from the block."""
    c, s = np.cos(drive.swash_angle), np.sin(drive.swash_angle)
    return np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
