"""Losses of the pairs: Coulomb shares and Newtonian shear, and concealed effects in them.

Contact beside the films after Bo and Pavelescu (1982), f exp(-(v/v_s)^d), the speed scaled by the oil's viscosity;
oil sheared fast after Eyring (1936), asinh(x)/x.
"""

from __future__ import annotations

import numpy as np

from .chamber import Turn
from .gaps import Gaps, thicker
from .hidden import Hidden
from .motion import Motion
from .points import Array, Points
from .pump import Pump

STRIBECK, FALLING = 0.25, 0.7  # m/s at 25 mPa s, and the power
MEDIUM = 0.025  # Pa s


def losses(pump: Pump, hidden: Hidden, at: Points, move: Motion, gaps: Gaps, turn: Turn) -> Array:
    """Mean power (N,) in W of all seven pairs; `move` at the middles of the turn's steps."""
    speed, above = at.speed[:, None], turn.pressure - at.p_case[:, None]
    axial = np.abs(pump.area * above - pump.mass * move.bend * speed**2)
    side, pressed = axial * np.tan(move.tilt), axial / np.cos(move.tilt)
    length = pump.guide - move.travel - pump.held_out * move.retracted
    lever = (length + 2.0 * (pump.overhang + move.travel + pump.held_out * move.retracted)) / length
    wetted = np.pi * pump.bore * length / np.sqrt(1.0 - pump.eccentricity**2)
    pads = np.pi * (pump.pad**2 - pump.pocket**2)
    piston = _pair(hidden, gaps, 0, (pump.friction_piston, side * lever, np.abs(move.slope) * speed, wetted, above))
    slipper = _pair(hidden, gaps, 1, (pump.friction_slipper, pressed, move.sliding * speed, pads, above))
    socket = pump.friction_socket * pressed * pump.ball * speed * np.sin(move.tilt)
    turning = sum(f * part * d / 2.0 for f, part, d in zip(
        (pump.friction_front, pump.friction_rear), pump.shares, pump.shafts, strict=True))  # fmt: skip
    mean = turn.width / turn.width.sum()
    once = pump.pistons * ((piston + slipper + socket + turning * side * speed) @ mean)
    return np.asarray(once + _plate(pump, hidden, at, gaps, above @ mean) + _retainer(pump, at, move, mean))


def _pair(hidden: Hidden, gaps: Gaps, gap: int, drive: tuple[float, Array, Array, Array | float, Array]) -> Array:
    """Power (N, M) of one pair: coefficient, load, speed, area of shear, pressure above the case."""
    coefficient, load, speed, area, above = drive
    film, viscosity = gaps.film[gap][:, None], gaps.viscosity[gap][:, None]
    stress = viscosity * gaps.warmer[gap][:, None] * thicker(gaps.thicken, np.maximum(above, 0.0)) * speed / film
    stress = stress / (1.0 + 0.6 * gaps.opening[gap][:, None] * np.maximum(above, 0.0))
    dry = hidden.mixed_friction * np.exp(-((speed * viscosity / (STRIBECK * MEDIUM)) ** FALLING))
    share = 1.0 if gap == 0 else 0.05
    return np.asarray((coefficient + share * dry) * load * speed + area * _eyring(hidden, stress) * speed)


def _plate(pump: Pump, hidden: Hidden, at: Points, gaps: Gaps, above: Array) -> Array:
    r1, r2, r3, r4 = pump.lands
    load = pump.clamping * pump.pistons * pump.area * above + pump.spring
    area = np.pi * (r2**2 - r1**2 + r4**2 - r3**2)
    speed = (at.speed * pump.plate_radius)[:, None]
    found = _pair(hidden, gaps, 2, (pump.friction_plate, load[:, None], speed, area, above[:, None]))
    return np.asarray(found[:, 0])


def _retainer(pump: Pump, at: Points, move: Motion, mean: Array) -> Array:
    """Of the ball guide and the retainer that turns rigidly."""
    sine, rest = np.sin(move.tilt), 1.0 - np.cos(move.tilt)
    along = np.sin(pump.latitude) * rest - np.cos(pump.latitude) * np.cos(move.angle)[None, :] * sine
    slip = pump.ring * np.sqrt(2.0 * rest - along**2)
    return np.asarray(pump.friction_guide * pump.spring / np.sin(pump.latitude) * (slip @ mean) * at.speed)


def _eyring(hidden: Hidden, stress: Array) -> Array:
    if hidden.shear_thinning == 0.0:
        return stress
    return np.asarray(np.arcsinh(hidden.shear_thinning * stress) / hidden.shear_thinning)
