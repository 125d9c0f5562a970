"""Contributions of effects to a bench's readings that do not pass through the chambers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.effects.effect import BenchState, Effects
from system.effects.state import ideal_flow


@dataclass(frozen=True)
class Outside:
    """Additions to the readings at N points: delivery, inlet and drain flow in m3/s, torque in N m, (N,)."""

    delivery: Array
    inlet: Array
    drain: Array
    torque: Array


def outside(effects: Effects, state: BenchState) -> Outside:
    """Flows past the chambers, drag on the shaft and the part of the displacement that is not filled.

    Oil keeps its mass from port to port at the constant bulk modulus K: volumes go with exp(-p/K). A part 1 -
    intake of the displaced volume holds no oil at inlet pressure: it is neither taken in nor delivered, and its
    work per volume at zero pressure, h(delivery) - h(inlet), h = K (1 - exp(-p/K)), is not done. The factor
    `delivery_reading` is not in here: it belongs to the meter.
    """
    modulus = state.geometry.oil.bulk_modulus
    delivery, inlet, case = (
        np.exp(-pressure / modulus)
        for pressure in (state.delivery_pressure, state.inlet_pressure, state.case_pressure)
    )
    missing = (1.0 - effects.intake) * ideal_flow(state)
    not_done = missing / inlet * modulus * (inlet - delivery)
    past = effects.cross_flow + effects.drain_flow
    return Outside(
        delivery=-past - missing * delivery / inlet,
        inlet=effects.drain_from_inlet - effects.cross_flow * inlet / delivery - missing,
        drain=effects.drain_flow * case / delivery + effects.drain_from_inlet * case / inlet,
        torque=effects.torque - not_done / state.speed,
    )
