"""Integrals over one turn of a chamber by name: mass out by each path, work, energy left in the paths."""

from dataclasses import dataclass
from typing import Any, Generic

import numpy as np

from reynolds.numerics.arrays import Array
from system.pump.chamber import layout as col
from system.pump.chamber.layout import INTEGRALS, PATHS
from system.pump.laws.kinematics import Number


@dataclass(frozen=True)
class Paths(Generic[Number]):
    """One number for each path out of the chamber; Paths[Array]: one array."""

    delivery: Number
    suction: Number
    piston: Number
    slipper: Number
    valve_plate: Number

    @property
    def ports(self) -> Number:
        """Sum over both ports."""
        return self.delivery + self.suction

    @property
    def gaps(self) -> Number:
        """Sum over the three gaps."""
        return self.piston + self.slipper + self.valve_plate

    @property
    def total(self) -> Number:
        """Sum over all paths."""
        return self.delivery + self.suction + self.piston + self.slipper + self.valve_plate


@dataclass(frozen=True)
class Gaps(Generic[Number]):
    """One number for each of the three gaps; Gaps[Array]: at N points, arrays (N,)."""

    piston: Number
    slipper: Number
    valve_plate: Number

    @property
    def total(self) -> Number:
        """All three together."""
        return self.piston + self.slipper + self.valve_plate


@dataclass(frozen=True)
class TurnTotals(Generic[Number]):
    """Integrals over one turn of one chamber; TurnTotals[Array]: at N operating points, arrays (N,).

    `outflow` in m3 at the density of zero gauge pressure; `path_energy` in J, throttled in the ports and given off in
    the gaps; `drag_energy` in J, the part of it that dragged oil returns to the moving walls, which is no loss
    (negative: the walls push the oil in); `indicated_work` in J, done on the chamber: -integral of p dV; `port_energy`
    (2,) or (2, N) in J, pressure work and elastic energy of the oil that goes into delivery and suction port.
    """

    outflow: Paths[Number]
    path_energy: Paths[Number]
    drag_energy: Gaps[Number]
    indicated_work: Number
    port_energy: Array


def turn_totals(integrals: Array) -> TurnTotals[Any]:
    """The totals of integrals (INTEGRALS,) of one point, or of (N, INTEGRALS) of N points."""
    whole = integrals[..., :INTEGRALS]
    column: Any = whole.tolist() if whole.ndim == 1 else whole.T
    return TurnTotals(
        outflow=Paths(*column[col.OUTFLOW : col.OUTFLOW + PATHS]),
        path_energy=Paths(*column[col.PATH_ENERGY : col.PATH_ENERGY + PATHS]),
        drag_energy=Gaps(*column[col.DRAG_ENERGY : col.DRAG_ENERGY + col.GAPS]),
        indicated_work=column[col.WORK],
        port_energy=np.array(column[col.PORT_ENERGY : col.PORT_ENERGY + col.PORTS]),
    )
