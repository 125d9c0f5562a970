"""What drives the three gaps at one shaft angle, for parts that stand still there."""

from __future__ import annotations

import numpy as np

from reynolds.numerics.arrays import Array
from system.films.drives import Drives, drives, no_rubbing
from system.films.parts import FloatingParts
from system.films.rotor import Rotor

NO_RUBBING = "friction of the films on the parts: left out of the forces between them (one gap alone)"


def instant_drives(rotor: Rotor, parts: FloatingParts, shaft_angle: float, pressure: Array) -> Drives:
    """Drives that hold at one shaft angle (rad) of chamber 1, without friction of the films.

    pressure (z,) Pa of the chambers, chamber k at shaft angle + (k - 1) pitch; or (1,), of them all.
    """
    pistons = rotor.pump.pump.pistons
    # Twice as many angles as chambers: a course over a turn has four at least.
    angles = np.asarray(shaft_angle + np.pi / pistons * np.arange(2 * pistons), dtype=float)
    chambers = np.broadcast_to(pressure, pistons)[np.arange(2 * pistons) // 2]
    return drives(rotor, parts, angles, chambers, no_rubbing(2 * pistons))
