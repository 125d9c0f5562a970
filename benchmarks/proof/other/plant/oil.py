"""ISO VG 46 by other relations: viscosity after Roelands, density by a secant modulus that rises with pressure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .points import KELVIN, Array

ATMOSPHERE = 101325.0
VAPOUR = 3.0e3  # Pa absolute at which a cavity opens
POLYTROPE = 1.4  # of bubbles, adiabatic
CENTRE = 50.0  # degC about which the slope of one oil may differ
COLD, HOT = (40.0, 39.56), (70.0, 12.78)  # degC, mPa s of the data sheet, at the ends of the usual range
ZERO, POLE = 1.2, 135.0  # Roelands' constants


@dataclass(frozen=True)
class Oil:
    """density: kg/m3 at atmosphere; modulus: Pa, secant, at atmosphere; rise: its growth with pressure; viscosity:
    factor on the data sheet's; slope: 1/K on that, about 50 degC; air: volume share of bubbles at atmosphere.
    """

    density: float = 860.0
    modulus: float = 1.6e9
    rise: float = 1.0
    viscosity: float = 1.0
    slope: float = 0.0
    air: float = 0.0

    def thick(self, kelvin: Array) -> Array:
        """Dynamic viscosity in Pa s: lg(lg mu + 1.2) = G - S lg(1 + T/135), mu in mPa s, T in degC (Roelands 1966)."""
        celsius = kelvin - KELVIN
        found = 1e-3 * 10.0 ** (10.0 ** (LEVEL - FALL * np.log10(1.0 + celsius / POLE)) - ZERO)
        return np.asarray(self.viscosity * found * np.exp(self.slope * (celsius - CENTRE)))

    def dense(self, pressure: Array) -> Array:
        """kg/m3 at Pa absolute: rho0/(1 - p/(K + m p)); bubbles by a polytrope."""
        above = pressure - ATMOSPHERE
        liquid = self.density / (1.0 - above / (self.modulus + self.rise * above))
        if self.air == 0.0:
            return np.asarray(liquid)
        bubbles = self.air * (ATMOSPHERE / np.maximum(pressure, VAPOUR)) ** (1.0 / POLYTROPE)
        return np.asarray(liquid / (1.0 + bubbles))


def _roelands() -> tuple[float, float]:
    """G and S through the two points of the data sheet."""
    levels = [np.log10(np.log10(value) + ZERO) for _, value in (COLD, HOT)]
    places = [np.log10(1.0 + celsius / POLE) for celsius, _ in (COLD, HOT)]
    fall = (levels[0] - levels[1]) / (places[1] - places[0])
    return float(levels[0] + fall * places[0]), float(fall)


LEVEL, FALL = _roelands()
