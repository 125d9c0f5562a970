"""Contributions of effects to a bench's readings that do not pass through the chambers."""

import numpy as np

from system.effects.effect import BenchState, Effects, Value
from system.effects.state import ideal_flow
from system.pump.bench import Outside


def outside(effects: Effects[Value], state: BenchState[Value]) -> Outside[Value]:
    """Flows past the chambers, drag on the shaft and the part of the displacement that is not filled.

    Oil keeps its mass from port to port at the constant bulk modulus K: volumes go with exp(-p/K). A part 1 - intake of
    the displaced volume contains no oil at inlet pressure: it is neither drawn in nor delivered, and its work per
    volume at zero pressure, h(delivery) - h(inlet), h = K (1 - exp(-p/K)), is not done.
    """
    modulus = state.geometry.oil.bulk_modulus
    delivery, inlet, case = (
        np.exp(-pressure / modulus) for pressure in (state.delivery_pressure, state.inlet_pressure, state.case_pressure)
    )
    missing = (1.0 - effects.intake) * ideal_flow(state)
    not_done = missing / inlet * modulus * (inlet - delivery)
    past = effects.cross_flow + effects.drain_flow
    return Outside(
        delivery=-past - missing * delivery / inlet,
        inlet=effects.drain_from_inlet - effects.cross_flow * inlet / delivery - missing,
        drain=effects.drain_flow * case / delivery + effects.drain_from_inlet * case / inlet,
        torque=effects.torque - not_done / state.speed,
        carried_off=effects.carried_off,
        delivery_reading=effects.delivery_reading,
        suction_loss=effects.suction_loss,
    )
