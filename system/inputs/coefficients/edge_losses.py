"""Pressure losses of films across a land at their edges and by inertia, beyond the film equation.

    dp = q/G + sum over edges of (12 mu u e/h + K rho u^2/2) + 54/35 sum over lands of rho (u_out^2 - u_in^2)/2

with u = q/(angle r h) at an edge or groove of radius r, extra length e and loss factor K there at Re = u h/nu
(`loss_files`). The last sum is the kinetic energy of a film between discs to first order in Re (Hunt, Torbe 1962:
27/35 rho u^2). With K of deep edges, 54/35 into the film and -54/35 out of it as Re goes to 0, all inertia cancels
except the part that falls with Re. Valid for h far below r, laminar flow.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reynolds.errors import InputError
from reynolds.numerics.arrays import Array

KINETIC = 54.0 / 35.0
"""Flow of kinetic energy of a parabola over that of its mean velocity."""
HALVINGS = 55
"""Of the interval in which a flow is sought: to round-off."""
Excess = Callable[[Array], Array]
"""Pressure (Pa) beyond that of creeping flow at flows (N,) in m3/s."""


@dataclass(frozen=True)
class LossCourse:
    """Loss factors (N,) over Reynolds numbers (N,), ascending; linear between, those of the ends beyond."""

    reynolds: Array
    loss_factor: Array

    def at(self, reynolds: Array) -> Array:
        """The loss factor at Reynolds numbers."""
        return np.asarray(np.interp(reynolds, self.reynolds, self.loss_factor))


@dataclass(frozen=True)
class Edge:
    """An edge or groove of a film at a radius (m): extra length in films, losses of flow along the path and back."""

    radius: float
    extra_length: float
    forth: LossCourse
    back: LossCourse


@dataclass(frozen=True)
class LandPath:
    """A way across lands: an angle (rad) of rings in a film (m), its edges, and lands (from, to) in radii (m).

    lands are those whose film's own inertia counts: with losses at both their edges.
    """

    angle: float
    film: float
    edges: tuple[Edge, ...] = ()
    lands: tuple[tuple[float, float], ...] = ()

    @property
    def extra_log(self) -> float:
        """Addition of the edges to the lands' sum of ln(r_out/r_in) in creeping flow: sum of e h/r."""
        return float(sum(edge.extra_length * self.film / edge.radius for edge in self.edges))

    def resistance(self, viscosity: float) -> float:
        """Resistance of the edges in creeping flow, Pa s/m3: 12 mu/(angle h^3) times `extra_log`."""
        return 12.0 * viscosity / (self.angle * self.film**3) * self.extra_log

    def largest_reynolds(self, flow: Array, kinematic_viscosity: float) -> float:
        """The largest u h/nu at an edge, of flows (N,) in m3/s."""
        least = min((edge.radius for edge in self.edges), default=np.inf)
        return float(np.abs(flow).max() / (self.angle * least * kinematic_viscosity))

    def inertia(self, flow: Array, density: float, kinematic_viscosity: float) -> Array:
        """Pressure loss (Pa) by inertia of flows (N,) in m3/s, positive along the path."""
        flow = np.asarray(flow, dtype=float)
        taken = np.zeros_like(flow)
        for edge in self.edges:
            number = np.abs(flow) / (self.angle * edge.radius * kinematic_viscosity)
            factor = np.where(flow >= 0.0, edge.forth.at(number), -edge.back.at(number))
            taken += factor / edge.radius**2
        taken += KINETIC * sum(1.0 / end**2 - 1.0 / start**2 for start, end in self.lands)
        return np.asarray(0.5 * density * (flow / (self.angle * self.film)) ** 2 * taken)


def secant_conductance(conductance: Array, excess: Excess, drop: Array, where: str) -> Array:
    """Flow over pressure drop (N,), m3/(s Pa), of dp = q/G + excess(q) at drops (N,) in Pa; G itself at zero.

    By bisection: the drop rises with the flow. Raises InputError at the path `where` for an excess so negative that
    twice the flow needs less than the drop.
    """
    size = np.where(drop == 0.0, 1.0, drop)
    low, high = np.zeros_like(size), np.full_like(size, 2.0)

    def missing(share: Array) -> Array:
        return share - 1.0 + excess(share * conductance * size) / size

    if np.any(missing(high) < 0.0):
        raise InputError(where, "a pressure that falls as the flow grows", "losses that grow with the flow")
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        short = missing(middle) < 0.0
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    return np.asarray(0.5 * (low + high) * conductance)
