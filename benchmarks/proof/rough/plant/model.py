"""Flows and torque of a pump in closed forms without scale, after Wilson (1950), with laws of their own.

Leakage V dp/(2 pi mu) into the case, in powers of pressure and viscosity that differ a little from make to make;
chambers that fill draw from the case; delivery w V/(2 pi) less compression and leakage; torque V p/(2 pi) with a
Coulomb, a viscous and a fixed share. Opened gaps: (1 + c p)^3 of the whole film; oil that thickens: its viscosity at
half of the pressure; an edge: Blasius' 1.75th power; a bleed: p^.6; contact: 1/(1 + H/H0).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .hidden import NOTHING, Hidden
from .pump import FULL, MIDDLE, TURN, Array, Pump

WARM = 0.04  # 1/K, of viscosity in a film that heats up
HERSEY = 6e-7  # mu w/p at which contact bears half
LEAST, THICK = 1.0e5, 0.04  # Pa, Pa s
UNIT = 1.0e6  # Pa, of torques over V p/(2 pi)
USUAL_SPEED = 154.98523757709612  # rad/s, 1480 r/min


@dataclass(frozen=True)
class State:
    """Samples (T,): rad/s; Pa above the inlet, of delivery and case; degC of inlet, of case and of the pump's body."""

    speed: Array
    pressure: Array
    around: Array
    inlet: Array
    case: Array
    body: Array


@dataclass(frozen=True)
class Flows:
    """Delivery and case drain (m3/s, at their own pressure) and torque (N m), (T,)."""

    Q_out: Array
    Q_case: Array
    torque: Array


def flows(pump: Pump, at: State, hidden: Hidden = NOTHING) -> Flows:
    """Of a pump in the steady state at every sample."""
    mu, p = pump.thick(at.case), at.pressure
    swept = pump.displacement * at.speed / TURN * (1.0 - hidden.droop * (p / FULL) ** 1.2)
    leaks = _leaks(pump, at, hidden, mu) + _to_case(pump, at, hidden)
    drawn = pump.leak * pump.displacement * at.around / (TURN * mu)  # by the chambers that fill, from the case
    modulus = pump.modulus * (1.0 - hidden.softening * (at.case - 40.0))
    squeezed = (1.0 + pump.dead) * p / modulus
    lost = leaks - _from_inlet(pump, at, hidden) + _across(pump, at, hidden, mu)
    delivered = swept * (1.0 - squeezed) - lost * (1.0 - p / modulus)  # the lost oil was compressed before
    return Flows(Q_out=delivered, Q_case=leaks - drawn, torque=_torque(pump, at, hidden, mu))


def _plate_flow(pump: Pump) -> float:
    return pump.plate * pump.speed / TURN


def _leaks(pump: Pump, at: State, hidden: Hidden, mu: Array) -> Array:
    p = at.pressure - at.around
    opened = (1.0 + hidden.opening * p / FULL) ** 3 * np.exp(-0.5 * hidden.thickening * p / FULL)
    expanded = np.maximum(1.0 + hidden.clearance * (at.body - 40.0), 0.1) ** 3
    warmed = 1.0 / _thinned(at, hidden, mu)
    form = (np.maximum(p, LEAST) / MIDDLE) ** pump.bend * (mu / THICK) ** pump.slack
    return np.asarray(pump.leak * pump.displacement * p / (TURN * mu) * form * opened * expanded * warmed)


def _thinned(at: State, hidden: Hidden, mu: Array) -> Array:
    """Viscosity of films that throttling and shear warm, over that of the case."""
    warmer = hidden.heating * (0.6 * at.pressure / MIDDLE + 0.4 * mu * at.speed / (THICK * USUAL_SPEED))
    return np.asarray(np.exp(-WARM * warmer))


def _to_case(pump: Pump, at: State, hidden: Hidden) -> Array:
    """A bleed of the control, a valve that weeps, slippers that pump from the inlet's side."""
    p = np.maximum(at.pressure, 0.0)
    weeping = hidden.weeping * (np.maximum(p - 18.0e6, 0.0) / 12.0e6) ** 1.5
    bleed = hidden.control * (p / MIDDLE) ** 0.6
    return np.asarray(_plate_flow(pump) * (bleed + weeping) + _from_inlet(pump, at, hidden))


def _from_inlet(pump: Pump, at: State, hidden: Hidden) -> Array:
    return np.asarray(hidden.squeeze * pump.plate * at.speed / TURN)


def _across(pump: Pump, at: State, hidden: Hidden, mu: Array) -> Array:
    p, cold = np.maximum(at.pressure, 0.0), pump.thick(np.full_like(mu, 40.0))
    edge = hidden.short_circuit * (p / MIDDLE) ** (1.0 / 1.75) * (cold / mu) ** (1.0 / 7.0)
    slit = hidden.cross_leak * p / MIDDLE * cold / pump.thick(0.5 * (at.inlet + at.case))
    swelling = hidden.swelling * np.exp(-(((p - 12.0e6) / 4.0e6) ** 2))
    return np.asarray(_plate_flow(pump) * (edge + slit + swelling))


def _torque(pump: Pump, at: State, hidden: Hidden, mu: Array) -> Array:
    p, arm = at.pressure, pump.displacement / TURN
    stroke = 1.0 - hidden.droop * (p / FULL) ** 1.2
    stored = (1.0 + 2.0 * pump.dead) * p / (2.0 * pump.modulus)
    ideal = arm * p * (stroke - pump.recovered * stored + hidden.compression * stored * (p / FULL) ** -0.2)
    loaded = np.maximum(p, LEAST)
    contact = pump.coulomb * (loaded / MIDDLE) ** pump.rub + hidden.mixed / (1.0 + mu * at.speed / loaded / HERSEY)
    viscous = pump.viscous * mu * _thinned(at, hidden, mu) * at.speed * arm
    churning = hidden.churning * (at.speed / USUAL_SPEED) ** 1.85 * (mu / THICK) ** 0.15
    creeping = hidden.creeping * np.sqrt(np.maximum(p, 0.0) / MIDDLE) * np.exp(-(at.case - 40.0) / 8.0)
    return np.asarray(ideal + arm * p * contact + viscous + pump.fixed + arm * UNIT * (churning + creeping))
