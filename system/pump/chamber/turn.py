"""Integrals over one turn of a chamber by name: mass out by each path, work, energy left in the paths."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Generic

import numpy as np

from reynolds.numerics.arrays import Array
from system.pump.chamber.layout import (
    CARRIED_ENERGY,
    GAPS,
    INTEGRALS,
    OUTFLOW,
    PATH_ENERGY,
    PATHS,
    PORT_ENERGY,
    PORTS,
    WORK,
)
from system.pump.laws.kinematics import Number


@dataclass(frozen=True)
class Paths:
    """One number, or one array, for each path out of the chamber."""

    delivery: Array
    suction: Array
    piston: Array
    slipper: Array
    valve_plate: Array

    @property
    def ports(self) -> Array:
        """Sum over both ports."""
        return self.delivery + self.suction

    @property
    def gaps(self) -> Array:
        """Sum over the three gaps."""
        return self.piston + self.slipper + self.valve_plate

    @property
    def total(self) -> Array:
        """Sum over all paths."""
        return self.delivery + self.suction + self.piston + self.slipper + self.valve_plate


def as_number(value: Any) -> Any:
    """A float for one point, the array for N points."""
    return float(value) if np.ndim(value) == 0 else value


@dataclass(frozen=True)
class TurnTotals(Generic[Number]):
    """Integrals over one turn of one chamber; TurnTotals[Array]: at N operating points, arrays (N,).

    `outflow` in m3 at the density of zero gauge pressure; `path_energy` in J, throttled in the ports and given off
    in the gaps; `carried_energy` (3,) or (3, N) in J of piston, slipper, valve plate, the part of it that carried
    oil gives to the walls that carry it, which is not lost (negative: the walls push the oil in); `indicated_work`
    in J, done on the chamber: -integral of p dV; `port_energy` (2,) or (2, N) in J, pressure work and elastic
    energy of the oil that goes into delivery and suction port.
    """

    outflow: Paths
    path_energy: Paths
    carried_energy: Array
    indicated_work: Number
    port_energy: Array


def turn_totals(integrals: Array) -> TurnTotals[Any]:
    """The totals of integrals (INTEGRALS,) of one point, or of (N, INTEGRALS) of N points."""
    column = np.moveaxis(integrals[..., :INTEGRALS], -1, 0)
    return TurnTotals(
        outflow=Paths(*column[OUTFLOW : OUTFLOW + PATHS]),
        path_energy=Paths(*column[PATH_ENERGY : PATH_ENERGY + PATHS]),
        carried_energy=column[CARRIED_ENERGY : CARRIED_ENERGY + GAPS],
        indicated_work=as_number(column[WORK]),
        port_energy=column[PORT_ENERGY : PORT_ENERGY + PORTS],
    )
