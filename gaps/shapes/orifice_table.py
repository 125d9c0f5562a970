"""The bore that feeds a slipper's pocket, by measured or computed coefficients: flow over pressure drop.

Re = u d/nu over the flow number lambda = (d/nu) sqrt(2 dp/rho) = Re/Cd (McCloy, Martin 1980, Control of Fluid
Power), straight between nodes in logarithms, so that either follows from the other exactly. Below the first node
flow is laminar (Re grows with lambda^2), above the last one Cd stays.
"""

from dataclasses import dataclass

import numpy as np

from reynolds.laws.law import Tangent
from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class OrificeTable:
    """ln lambda and ln Re of a bore at its nodes, both ascending."""

    log_number: tuple[float, ...]
    log_reynolds: tuple[float, ...]

    @property
    def laminar(self) -> float:
        """lambda^2/Re of its laminar flow: 64 l/d of a bore of Hagen and Poiseuille."""
        return float(np.exp(2.0 * self.log_number[0] - self.log_reynolds[0]))

    def conductance(self, diameter: float, viscosity: float) -> float:
        """Laminar flow per pressure drop, pi d^3/(2 mu lambda^2/Re), m3/(s Pa), of a bore of d m."""
        return float(np.pi * diameter**3 / (2.0 * viscosity * self.laminar))

    def equal_length(self, diameter: float) -> float:
        """Length in m of the capillary of Hagen and Poiseuille with as much laminar resistance."""
        return self.laminar * diameter / 64.0

    def flow(self, drop: float, diameter: float, viscosity: float, density: float) -> Tangent:
        """Flow (m3/s) by a pressure drop (Pa) and its slope; oil of viscosity Pa s and density kg/m3."""
        laminar, kinematic = self.conductance(diameter, viscosity), viscosity / density
        if drop == 0.0:
            return _tangent(0.0, laminar)
        place = np.log(diameter / kinematic) + 0.5 * np.log(2.0 * abs(drop) / density)
        if place <= self.log_number[0]:
            return _tangent(laminar * drop, laminar)
        x, y = np.array(self.log_number), np.array(self.log_reynolds)
        cell = min(int(np.searchsorted(x, place)) - 1, len(x) - 2)
        steep = float((y[cell + 1] - y[cell]) / (x[cell + 1] - x[cell])) if place < x[-1] else 1.0
        reynolds = np.exp(np.interp(place, x, y) + max(place - x[-1], 0.0))
        flow = float(np.sign(drop) * reynolds * kinematic * 0.25 * np.pi * diameter)
        return _tangent(flow, 0.5 * steep * flow / drop)

    def drop(self, flow: Array, diameter: float, viscosity: float, density: float) -> Array:
        """The pressure drop (Pa) that drives flows (m3/s), of their sign."""
        kinematic = viscosity / density
        x, y = np.array(self.log_number), np.array(self.log_reynolds)
        log_flow = np.log(np.maximum(np.abs(flow), 1e-30) / (kinematic * 0.25 * np.pi * diameter))
        number = np.interp(log_flow, y, x) + np.maximum(log_flow - y[-1], 0.0)
        number += 0.5 * np.minimum(log_flow - y[0], 0.0)
        return np.asarray(np.sign(flow) * 0.5 * density * (np.exp(number) * kinematic / diameter) ** 2)


def _tangent(flow: float, slope: float) -> Tangent:
    return Tangent(np.asarray(flow), np.asarray(slope))
