"""Chamber pressure over a turn: balance of mass, one implicit step of closed form at each angle.

With one port open at most, s V/dt x + a sgn(x) sqrt|x| = r for x = p - p_port has a closed solution; s, the secant of
the density, is renewed. A chamber that would fall below vapour pressure cavitates and keeps its mass.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .gaps import Gaps
from .hidden import Hidden
from .motion import Motion
from .oil import VAPOUR, Oil
from .points import Array, Points
from .pump import Pump

DEGREE = np.pi / 180.0
BEGIN = 330.0 * DEGREE  # the delivery's kidney still open: a turn from here needs no guess
FINE, COARSE = 0.25, 2.0  # deg: about the dead centres, elsewhere
AHEAD, BEHIND = 20.0, 50.0  # deg of a dead centre
GROOVE_BEGIN, GROOVE_END, FULL, FALLING, SHUT = (one * DEGREE for one in (-5.0, 10.0, 40.0, 140.0, 170.0))
SECANTS = 4


@dataclass(frozen=True)
class Turn:
    """Angle (M,) at the ends of steps and their width; pressure (N, M) Pa absolute, mean of each step; mass (N,) kg a
    turn drawn through the inlet, delivered, leaked; work (N,) J of one piston.
    """

    angle: Array
    width: Array
    pressure: Array
    drawn: Array
    delivered: Array
    leaked: Array
    work: Array


def grid() -> Array:
    """Angles (M + 1,) of a turn from BEGIN on, rad."""
    degrees = [330.0]
    while degrees[-1] < 690.0 - 1e-9:
        near = (degrees[-1] + AHEAD) % 180.0 < AHEAD + BEHIND
        degrees.append(min(degrees[-1] + (FINE if near else COARSE), 690.0))
    return np.asarray(degrees) * DEGREE


def opening(pump: Pump, hidden: Hidden, angle: float) -> float:
    """m2 of a port at an angle behind its dead centre; a worn groove begins earlier, and rises as a notch."""
    turned = (angle + 0.5 * np.pi) % (2.0 * np.pi) - 0.5 * np.pi
    begin = GROOVE_BEGIN - hidden.erosion
    if turned <= begin or turned >= SHUT:
        return 0.0
    if turned < GROOVE_END:
        own = max(turned - GROOVE_BEGIN, 0.0) / (GROOVE_END - GROOVE_BEGIN)
        worn = hidden.erosion * (turned - begin) / (GROOVE_END - begin)
        return pump.groove * (own**2 + 2.0 * worn)
    if turned < FULL:
        groove = pump.groove * (1.0 + 2.0 * hidden.erosion)
        return groove + (pump.kidney - groove) * (turned - GROOVE_END) / (FULL - GROOVE_END)
    return pump.kidney * min(1.0, (SHUT - turned) / (SHUT - FALLING))


def march(pump: Pump, hidden: Hidden, at: Points, move: Motion, gaps: Gaps) -> Turn:
    """One turn at N points; `move` at `grid()`."""
    oil = pump.oil(hidden.air)
    half = 0.5 * np.pi * pump.bore * gaps.film[0]
    volume = pump.dead_volume + pump.area * (move.retracted + move.travel)
    length = pump.guide - move.travel - pump.held_out * move.retracted
    begun, mass = at.p_out, oil.dense(at.p_out) * volume[:, 0]
    pressures, sums = np.zeros((at.speed.size, move.angle.size - 1)), np.zeros((4, at.speed.size))
    for k in range(1, move.angle.size):
        swept = np.diff(move.travel[:, k - 1 : k + 1], axis=1)[:, 0]
        time = (move.angle[k] - move.angle[k - 1]) / at.speed
        middle = 0.5 * (move.angle[k] + move.angle[k - 1])
        inlet, outlet = opening(pump, hidden, middle), opening(pump, hidden, middle - np.pi)
        port = at.p_in if inlet else at.p_out if outlet else begun
        leaks = pump.oil(0.0).density * gaps.flow(begun - at.p_case, length[:, k])
        leaks = leaks + oil.dense(begun) * half * swept / time
        ended, kept = _settled(pump, oil, mass - time * leaks, (volume[:, k], time, port, inlet + outlet))
        through = mass - kept - time * leaks
        sums += np.stack([through * (inlet > 0), through * (outlet > 0), time * leaks,
                          -0.5 * (begun + ended) * (pump.area + half) * swept])  # fmt: skip
        pressures[:, k - 1] = 0.5 * (begun + ended)
        begun, mass = ended, kept
    return Turn(move.angle[1:], np.diff(move.angle), pressures, -sums[0], sums[1], sums[2], sums[3])


def _settled(pump: Pump, oil: Oil, mass: Array, step: tuple[Array, Array, Array, float]) -> tuple[Array, Array]:
    """Pressure and mass at the end of a step that begins with a mass (kg) less leakage."""
    volume, time, port, area = step
    at_port = oil.dense(port)
    throat = pump.flow_coefficient * area * np.sqrt(2.0 * at_port)
    excess = (mass - at_port * volume) / time
    slope = (oil.dense(port + 1e5) - at_port) / 1e5
    for _ in range(SECANTS):
        stiff = slope * volume / time
        root = 2.0 * np.abs(excess) / (throat + np.sqrt(throat**2 + 4.0 * stiff * np.abs(excess)))
        apart = np.sign(excess) * np.maximum(root**2, 1.0)
        pressure = np.maximum(port + apart, VAPOUR)
        slope = (oil.dense(pressure) - at_port) / np.where(pressure == port, 1.0, pressure - port)
        slope = np.maximum(slope, 1e-9)
    parted = port + apart < VAPOUR
    drawn_in = throat * np.sqrt(np.maximum(port - VAPOUR, 0.0)) * time
    return pressure, np.where(parted, np.minimum(mass + drawn_in, oil.dense(pressure) * volume),
                              oil.dense(pressure) * volume)  # fmt: skip
