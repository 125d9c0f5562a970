"""Motion of a piston: its ball centre is where the bore's axis meets the swash plane; angle 0 is inner dead."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .machine import Array, Machine


@dataclass(frozen=True)
class Motion:
    """Per rad of shaft angle at given angles: travel out of the inner dead centre (m), its first and second slope,
    path of the ball centre in the swash plane (m/rad), acceleration along the bore (m/rad2); swash: the plate's
    angle; stand_out: of the ball at inner dead centre beyond full stroke (m).
    """

    angle: Array
    travel: Array
    speed: Array
    sliding: Array
    acceleration: Array
    swash: float
    stand_out: float


def swash_at(machine: Machine, ratio: float) -> float:
    """Swash angle (rad) at which the stroke is `ratio` of the full one."""
    slope = np.tan(machine.swash) * np.tan(machine.cone)
    wanted = ratio * slope / (1.0 - slope**2)
    small = 2.0 * wanted / (1.0 + np.sqrt(1.0 + 4.0 * wanted**2))
    return float(np.arctan(small / np.tan(machine.cone)))


def full_stroke(machine: Machine, swash: float) -> float:
    """Between the dead centres, m: along the bore from the swash plane at angle 0 to that at pi."""
    return float(np.diff([_along(machine, swash, np.array([at]))[0] for at in (0.0, np.pi)])[0])


def motion(machine: Machine, ratio: float, angle: Array) -> Motion:
    """The motion at a displacement ratio: s = -R tan g cos/(cos b + sin b tan g cos) and its derivatives."""
    swash = swash_at(machine, ratio * machine.stroke)
    sin_b, cos_b, tan_g = np.sin(machine.cone), np.cos(machine.cone), np.tan(swash)
    under = cos_b + sin_b * tan_g * np.cos(angle)
    along = _along(machine, swash, angle)
    speed = machine.radius * tan_g * cos_b * np.sin(angle) / under**2
    bend = machine.radius * tan_g * cos_b * (np.cos(angle) / under**2)
    bend = bend + 2.0 * speed * sin_b * tan_g * np.sin(angle) / under
    out = machine.radius + along * sin_b
    sliding = np.sqrt(speed**2 + out**2)
    start = float(_along(machine, swash, np.zeros(1))[0])
    inner = float(_along(machine, machine.swash, np.zeros(1))[0])
    return Motion(angle, along - start, speed, sliding, bend - out * sin_b, swash, start - inner)


def _along(machine: Machine, swash: float, angle: Array) -> Array:
    """Place of the ball centre on the bore's axis, 0 where the plate stands upright (m)."""
    fall = np.tan(swash) * np.cos(angle)
    return np.asarray(-machine.radius * fall / (np.cos(machine.cone) + np.sin(machine.cone) * fall))
