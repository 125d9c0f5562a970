"""Leakage of the three gaps in closed form, with laws of oil and walls of the second plant.

Piston: eccentric annulus, 1 + 1.5 e^2; slipper: capillary and disc land in series, a hydrostatic pocket; plate: two
rings of the loaded pitch. Oil thickens after Cameron (1966), (1 + c p)^16; walls dish as Kirchhoff's plate, most at
the pressure's side; films warm after Nahme (1940); clearances change with the block's mean temperature.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .hidden import Hidden
from .points import BODY, RATED_SPEED, Array, Points
from .pump import Pump

CAMERON = 16.0
WARM = 0.034  # 1/K, of viscosity
CONDUCT = 0.13  # W/(m K)
LIFTS = 0.98  # N m of a slipper's weight at rated speed
HOLDS = 77.0, 8.4e-3  # N of the retainer, m of its lever
SOFT = 0.3  # of the holding moment over which a slipper leaves the plate
PLACES, WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True)
class Gaps:
    """The gaps of N points in the order piston, slipper, plate.

    film (m), viscosity at no pressure (Pa s), opening (1/Pa): (3, N); thicken: 1/Pa; warmer: (3, N), factor on the
    viscosity that shears; leak: (3, N), m3/s/Pa of one chamber, the piston's times its length; choked: Pa s/m3 of a
    slipper's orifice; lifted: (2, N), flow (m3/s) from the inlet's side into the case and drag (N m) of slippers.
    """

    film: Array
    viscosity: Array
    opening: Array
    thicken: float
    warmer: Array
    leak: Array
    choked: Array
    lifted: Array

    def flow(self, above: Array, length: Array) -> Array:
        """Leakage (m3/s) of one chamber at pressures above the case (N,), its piston guided over a length (N,)."""
        piston, slipper, plate = self.ways(above, length)
        return np.asarray(above * (piston + slipper + plate))

    def ways(self, above: Array, length: Array) -> Array:
        """The same over the pressure, by gap, (3, N) m3/s/Pa."""
        thick = thinner(self.thicken, above)
        found = self.leak * thick * dished(self.opening * np.abs(above))
        found[0] = found[0] / length
        found[1] = found[1] / (1.0 + found[1] * self.choked)
        return np.asarray(found)


def gaps(pump: Pump, hidden: Hidden, at: Points) -> Gaps:
    """The gaps at N points."""
    body = 0.5 * (at.T_in + at.T_case) - BODY
    stated = np.array([pump.piston_film, pump.slipper_film, pump.plate_film])
    rates = np.array([hidden.thermal_piston, hidden.thermal_slipper, hidden.thermal_plate])
    film = stated[:, None] * np.exp(rates[:, None] * body)
    mu = pump.oil(0.0).thick(at.T_case) * np.ones((3, 1))
    speeds = np.array([0.3 * pump.pitch * np.tan(pump.tilt), pump.pitch, pump.plate_radius])[:, None] * at.speed
    nahme = hidden.film_heating * WARM * mu * speeds**2 / CONDUCT
    hotter = mu / (1.0 + nahme / 8.0) ** (2.0 / 3.0)
    openings = np.array([hidden.opening_piston, hidden.opening_slipper, hidden.opening_plate])
    return Gaps(
        film=film, viscosity=mu, opening=openings[:, None] * np.ones_like(film), thicken=hidden.viscosity_pressure,
        warmer=sheared(nahme), leak=_leak(pump, film) / hotter, choked=_orifice(pump, hotter[1]),
        lifted=_lifted(pump, hidden, at, film[1], mu[1]),
    )  # fmt: skip


def thinner(coefficient: float, above: Array) -> Array:
    """Mean of mu0/mu along a pressure that falls to the case's: (1 - (1 + c p)^-15)/(15 c p), 16 c the coefficient."""
    grown = coefficient / CAMERON * np.abs(above)
    power = CAMERON - 1.0
    return np.where(grown > 1e-9, (1.0 - (1.0 + grown) ** -power) / np.maximum(power * grown, 1e-12), 1.0)


def thicker(coefficient: float, above: Array) -> Array:
    """Mean of mu/mu0 along the same: ((1 + c p)^17 - 1)/(17 c p)."""
    grown = coefficient / CAMERON * np.abs(above)
    power = CAMERON + 1.0
    return np.where(grown > 1e-9, ((1.0 + grown) ** power - 1.0) / np.maximum(power * grown, 1e-12), 1.0)


def dished(share: Array) -> Array:
    """Flow through a film h0 (1 + c (1 - s^2)), s from the pressure's side to the case, over that of h0."""
    if not np.any(share):
        return np.ones_like(share)
    along = 0.5 * (PLACES + 1.0)
    resistance = sum(w / (1.0 + share * (1.0 - s * s)) ** 3 for s, w in zip(along, 0.5 * WEIGHTS, strict=True))
    return np.asarray(1.0 / resistance)


def sheared(nahme: Array) -> Array:
    """Shear stress of a film between walls of one temperature over that of a cold one (Nahme 1940)."""
    s = np.sqrt(np.maximum(nahme, 1e-12) / 8.0)
    return np.asarray(np.arcsinh(s) / (s * np.sqrt(1.0 + s * s)))


def _leak(pump: Pump, film: Array) -> Array:
    """(3, N) m3/s/Pa times viscosity, of one chamber; the piston's times its length too."""
    annulus = np.pi * pump.bore * (1.0 + 1.5 * pump.eccentricity**2) / 12.0
    disc = np.pi / (6.0 * np.log(pump.pad / pump.pocket))
    r1, r2, r3, r4 = pump.lands
    rings = (np.pi / pump.pistons) / 6.0 * (1.0 / np.log(r2 / r1) + 1.0 / np.log(r4 / r3))
    return np.asarray(np.array([annulus, disc, rings])[:, None] * film**3)


def _orifice(pump: Pump, viscosity: Array) -> Array:
    return np.asarray(128.0 * viscosity * pump.orifice_length / (np.pi * pump.orifice**4))


def _lifted(pump: Pump, hidden: Hidden, at: Points, film: Array, viscosity: Array) -> Array:
    """Slippers of the suction side that their weight tips off, by 1 - exp(-(ratio - 1)/.3) beyond the hold."""
    force, lever = HOLDS
    holds = np.maximum(pump.area * (at.p_in - at.p_case) + force, 1.0) * lever
    beyond = np.maximum(LIFTS * (at.speed / RATED_SPEED) ** 2 / holds - 1.0, 0.0)
    risen = film + hidden.lift * -np.expm1(-beyond / SOFT)
    disc = np.pi / (6.0 * np.log(pump.pad / pump.pocket) * viscosity)
    half = 0.5 * pump.pistons
    paths = [disc * one**3 / (1.0 + disc * one**3 * _orifice(pump, viscosity)) for one in (risen, film)]
    flow = half * (at.p_in - at.p_case) * (paths[0] - paths[1])
    swept = half * viscosity * np.pi * (pump.pad**2 - pump.pocket**2) * at.speed * pump.pitch**2
    return np.stack([flow, swept * (1.0 / risen - 1.0 / film)])
