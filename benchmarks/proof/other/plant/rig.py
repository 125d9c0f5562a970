"""The second plant at its points: flows, torque, chamber pressure."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .aside import aside
from .chamber import Turn, grid, march
from .gaps import Gaps, gaps
from .hidden import NOTHING, Hidden
from .motion import Motion, motion
from .oil import VAPOUR
from .points import RATED_FLOW, RATED_SPEED, Array, Points
from .pump import Pump
from .rubbing import losses

HERTZ = 0.8  # power of the load with which the plate's stop yields
FULL = 35.0e6  # Pa
DRAWS = 12  # rounds between an inlet's pressure and its flow


@dataclass(frozen=True)
class Readout:
    """Flows at their own port's pressure (m3/s) and torque (N m), (N,); angle (M,) rad and chamber pressure (N, M) Pa
    absolute. Q_piston, Q_slipper, Q_valve_plate: outflow through each gap alone.
    """

    Q_out: Array
    Q_in: Array
    Q_case: Array
    torque: Array
    angle: Array
    pressure: Array
    Q_piston: Array
    Q_slipper: Array
    Q_valve_plate: Array


def run(pump: Pump, at: Points, hidden: Hidden = NOTHING) -> Readout:
    """The steady state of a machine with its concealed effects."""
    yielded = hidden.droop * (np.maximum(at.p_out - at.p_in, 0.0) / FULL) ** HERTZ
    at = replace(at, ratio=np.maximum(at.ratio - yielded, 1e-3))
    edges = grid()
    ends = motion(pump, at.ratio, edges)
    at, films, turn = _behind_its_line(pump, hidden, at, ends)
    move = motion(pump, at.ratio, 0.5 * (edges[1:] + edges[:-1]))
    rate = pump.pistons * at.speed / (2.0 * np.pi)
    oil = pump.oil(hidden.air)
    delivered = rate * turn.delivered / oil.dense(at.p_out)
    taken, leaked = rate * turn.drawn / oil.dense(at.p_in), rate * turn.leaked / pump.oil(0.0).density
    past = aside(pump, hidden, at, move, delivered)
    drained = leaked * _shares(pump, at, move, films, turn)
    power = rate * turn.work + losses(pump, hidden, at, move, films, turn)
    return Readout(
        Q_out=(delivered - past.across - past.to_case) * past.meter,
        Q_in=taken - past.across + past.from_inlet + films.lifted[0],
        Q_case=leaked + past.to_case + past.from_inlet + films.lifted[0],
        torque=power / at.speed + past.torque + films.lifted[1], angle=turn.angle, pressure=turn.pressure,
        Q_piston=drained[0], Q_slipper=drained[1], Q_valve_plate=drained[2],
    )  # fmt: skip


def _shares(pump: Pump, at: Points, move: Motion, films: Gaps, turn: Turn) -> Array:
    """(3, N), shares of the gaps in the leakage over a turn, by the pressure at each step."""
    above = turn.pressure - at.p_case[:, None]
    length = pump.guide - move.travel - pump.held_out * move.retracted
    steps = np.stack(
        [above[:, k] * films.ways(above[:, k], length[:, k]) for k in range(above.shape[1])], axis=-1
    )  # fmt: skip
    found = steps @ turn.width
    return np.asarray(found / found.sum(axis=0))


def _behind_its_line(pump: Pump, hidden: Hidden, at: Points, ends: Motion) -> tuple[Points, Gaps, Turn]:
    """The points at the pressure of the inlet port behind its line, by the actual flow: damped rounds.

    Loss of the line: .7 of it with the square of the flow, .3 of it with the flow and the oil's viscosity.
    """
    films = gaps(pump, hidden, at)
    if hidden.suction == 0.0:
        return at, films, march(pump, hidden, at, ends, films)
    oil, viscosity = pump.oil(hidden.air), pump.oil(0.0).thick(at.T_in)
    share = at.ratio * at.speed / RATED_SPEED
    for _ in range(DRAWS):
        lost = hidden.suction * (0.7 * share**2 + 0.3 * share * viscosity / 0.025)
        own = replace(at, p_in=np.maximum(at.p_in - lost, VAPOUR + 1e3))
        turn = march(pump, hidden, own, ends, films)
        drawn = pump.pistons * at.speed / (2.0 * np.pi) * turn.drawn / oil.dense(own.p_in)
        share = 0.5 * (share + drawn / RATED_FLOW)
    return own, films, turn
