"""Flows past the chambers, drag on the shaft and a meter's bias, by laws of the second plant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .hidden import Hidden
from .motion import Motion
from .points import BODY, RATED_FLOW, RATED_SPEED, Array, Points
from .pump import Pump

MEDIUM, MIDDLE = 0.025, 20.0e6  # Pa s, Pa of reference
THROTTLED = 0.45e-6  # K/Pa by which oil warms as it is throttled
QUALITY, RINGING = 8.0, 157.08  # of the line, and its speed (rad/s, 1500 r/min)
DRUM = 0.062, 0.063  # m, radius and length of the barrel


@dataclass(frozen=True)
class Aside:
    """Delivery to inlet, delivery to case, inlet to case (m3/s), torque (N m), factor on the delivery meter, (N,)."""

    across: Array
    to_case: Array
    from_inlet: Array
    torque: Array
    meter: Array


def aside(pump: Pump, hidden: Hidden, at: Points, move: Motion, flow: Array) -> Aside:
    """All of them at points where the chambers deliver `flow` (N,) m3/s."""
    oil, drop, turned = pump.oil(0.0), at.p_out - at.p_in, at.speed / RATED_SPEED
    viscosity = oil.thick(at.T_case)
    weeping = hidden.weeping * (np.maximum(at.p_out - 25.0e6, 0.0) / 10.0e6) ** 1.5
    hot = hidden.hot_leak * np.exp((at.T_case - BODY) / 8.0) * at.p_out / MIDDLE
    slit = oil.thick(at.T_in + 0.5 * THROTTLED * drop)
    ringing = at.speed / RINGING
    bump = (ringing / QUALITY) ** 2 / ((1.0 - ringing**2) ** 2 + (ringing / QUALITY) ** 2)
    return Aside(
        across=_edge(pump, hidden, drop, viscosity) + hidden.cross_leak * drop / slit
        + hidden.shuttle * turned * (1.0 - at.ratio),
        to_case=_control(hidden, at, viscosity) + weeping + hot, from_inlet=_squeezed(pump, hidden, turned),
        torque=_drag(pump, hidden, at, move, (viscosity, flow)), meter=1.0 + hidden.resonance * bump,
    )  # fmt: skip


def _edge(pump: Pump, hidden: Hidden, drop: Array, viscosity: Array) -> Array:
    """A short bore: 1/C = 1/.7 + 20/Re (1 + 2.25 l/d), l = 2 d (Lichtarowicz et al. 1965)."""
    if hidden.short_circuit == 0.0:
        return np.zeros_like(drop)
    ideal = np.sqrt(2.0 * drop / pump.oil(0.0).density)
    reynolds = pump.oil(0.0).density * ideal * np.sqrt(4.0 * hidden.short_circuit / np.pi) / viscosity
    return np.asarray(hidden.short_circuit * ideal / (1.0 / 0.7 + 20.0 / reynolds * (1.0 + 2.25 * 2.0)))


def _control(hidden: Hidden, at: Points, viscosity: Array) -> Array:
    """A bleed beside a spool's clearance, half of the flow each at 20 MPa and 25 mPa s."""
    drop = (at.p_out - at.p_case) / MIDDLE
    return np.asarray(0.5 * hidden.control_flow * (np.sqrt(drop) + drop * MEDIUM / viscosity))


def _squeezed(pump: Pump, hidden: Hidden, turned: Array) -> Array:
    """Slippers that rise and settle once a turn, less at higher speed."""
    area = pump.pistons * np.pi * pump.pad**2
    return np.asarray(area * hidden.squeeze * turned * RATED_SPEED / (2.0 * np.pi) * 1.3 / (1.0 + 0.3 * turned))


def _drag(pump: Pump, hidden: Hidden, at: Points, move: Motion, state: tuple[Array, Array]) -> Array:
    viscosity, flow = state
    turned = at.speed / RATED_SPEED
    lip = 0.5 + 0.5 * np.cbrt(viscosity * turned / MEDIUM)  # half dry, half after Hirano (1961)
    pressed = 1.1 * (at.p_in - at.p_case) + 1e5 * viscosity * at.speed  # Wilson (1950)
    charge = hidden.charge_pump / (2.0 * np.pi) * pressed
    share = np.maximum(flow, 0.0) / RATED_FLOW
    passage = hidden.throttling * (0.8 * share**2 + 0.2 * share * viscosity / MEDIUM) * np.maximum(flow, 0.0) / at.speed
    inner = pump.dead_volume + pump.area * move.retracted[:, 0]
    outer = inner + pump.area * move.travel.max(axis=1)
    held = pump.pistons * (0.75 * inner + 0.25 * outer) * (at.p_out - at.p_in) ** 2 / (2.0 * pump.bulk_modulus)
    strange = hidden.belt * np.sqrt(turned) + hidden.pocketing * at.p_out / MIDDLE * (1.0 - at.ratio) ** 2
    return np.asarray(
        hidden.churning * _drum(pump, at, viscosity) + hidden.seal * lip + charge + passage
        + hidden.compression * held / (2.0 * np.pi) + strange
    )  # fmt: skip


def _drum(pump: Pump, at: Points, viscosity: Array) -> Array:
    """Torque (N m) of the barrel: 1/sqrt(C) = -.6 + 4.07 lg(Re sqrt(C)) (Theodorsen and Regier 1944)."""
    radius, length = DRUM
    density = pump.oil(0.0).density
    reynolds = density * at.speed * radius**2 / viscosity
    root = np.full_like(reynolds, 10.0)
    for _ in range(30):
        root = -0.6 + 4.07 * np.log10(reynolds / root)
    return np.asarray(np.pi * density * at.speed**2 * radius**4 * length / root**2)
