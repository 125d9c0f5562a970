"""Density over pressure and temperature, with or without air, each with its slope.

A pressure law gives the density over that at zero gauge pressure, so that every ratio is one there. The film
equation counts mass at reference density and needs no more.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from reynolds.errors import FilmInputError
from reynolds.laws.fluid import DensityLaw
from reynolds.laws.law import Tangent, require_positive, within
from reynolds.numerics.arrays import Array

ATMOSPHERE = 101325.0  # Pa absolute at zero gauge
MINERAL_OIL_BUNSEN = 0.09  # volume of air (0 gauge) that a volume of mineral oil dissolves per atmosphere
API_LUBRICANT = 0.6278  # kg/(m3 K): expansion times density of lubricating oils, ASTM D1250 table 54D


@dataclass(frozen=True)
class RationalDensity:
    """rho/rho0 = (a + b p)/(a + p), a in Pa, b the limit of the ratio at high pressure.

    Source: the form of Dowson and Higginson 1966; a = 2.22e9 Pa, b = 1.66 in Bertocchi et al. 2013. Written 1 + A p/(1
    + B p), a = 1/B and b = 1 + A/B. Bulk modulus a/(b - 1) at zero pressure. Raises FilmInputError where tension
    reduces the density to zero (p <= -a/b).
    """

    a: float
    b: float

    def __call__(self, pressure: ArrayLike) -> Tangent:
        p = within("density, pressure", pressure, -0.99 * self.a / self.b, np.inf, "Pa")
        return Tangent((self.a + self.b * p) / (self.a + p), self.a * (self.b - 1.0) / (self.a + p) ** 2)


# Mineral oil, measured to 0.4 GPa (Dowson and Higginson 1966, chapter 6).
DOWSON_HIGGINSON = RationalDensity(0.59e9, 1.34)


@dataclass(frozen=True)
class BulkModulus:
    """rho/rho0 = exp(p/K): constant tangent bulk modulus K = rho dp/drho (Pa).

    Holds for p well below K/10, since the modulus of oils grows by about ten times the pressure. Raises
    FilmInputError beyond +-K.
    """

    modulus: float

    def __post_init__(self) -> None:
        require_positive("density", bulk_modulus=self.modulus)

    def __call__(self, pressure: ArrayLike) -> Tangent:
        p = within("density of constant bulk modulus, pressure", pressure, -self.modulus, self.modulus, "Pa")
        ratio = np.exp(p / self.modulus)
        return Tangent(ratio, ratio / self.modulus)


@dataclass(frozen=True)
class Tait:
    """rho0/rho = 1 - ln[1 + (1 + K0') p/K0]/(1 + K0'): K0 (Pa) the modulus at zero pressure, K0' its rise with p.

    Source: Tait 1888 in the form of Dymond and Malhotra 1988, Bair 2007; K0' = 11 for mineral oils, K0 by
    `tait_modulus`. Holds to several GPa; raises FilmInputError in tension, where its logarithm ends.
    """

    modulus: float
    modulus_slope: float

    def __post_init__(self) -> None:
        require_positive("Tait", modulus=self.modulus, modulus_slope=self.modulus_slope)

    def __call__(self, pressure: ArrayLike) -> Tangent:
        rise = 1.0 + self.modulus_slope
        p = within("Tait, pressure", pressure, -0.99 * self.modulus / rise, self.modulus * 1e3, "Pa")
        ratio = 1.0 / (1.0 - np.log1p(rise * p / self.modulus) / rise)
        return Tangent(ratio, ratio**2 / (self.modulus + rise * p))


def tait_modulus(temperature: ArrayLike) -> Array:
    """K0 = 9 GPa exp(-0.0065 T), T in K: mineral oils and hydrocarbons. Source: Fakhreddine and Zoller 1990."""
    return np.asarray(9e9 * np.exp(-6.5e-3 * within("Tait, temperature", temperature, 233.15, 473.15, "K")))


def thermal_expansion(temperature: ArrayLike, reference: float, coefficient: float) -> Tangent:
    """rho/rho_ref = 1 - alpha (T - T_ref) and its slope; T in K, alpha in 1/K (mineral oils 6.5e-4 .. 8e-4).

    Linear: good within 0.5 % over +-80 K. Raises FilmInputError where the ratio leaves 0.5 .. 2.
    """
    ratio = 1.0 - coefficient * (np.asarray(temperature, dtype=float) - reference)
    within("thermal expansion, density ratio", ratio, 0.5, 2.0, "1")
    return Tangent(ratio, np.full_like(ratio, -coefficient))


def api_density(temperature: ArrayLike, density_15C: float) -> Tangent:
    """Density (kg/m3) of a lubricating oil from that at 15 degC, and its slope; T in K.

    rho = rho15 exp[-alpha d (1 + 0.8 alpha d)], d = T - 288.15 K, alpha = 0.6278/rho15. Source: ASTM D1250
    (API MPMS 11.1) table 54D of 1980; 800 .. 1164 kg/m3, -20 .. 150 degC, else FilmInputError.
    """
    within("API, density at 15 degC", density_15C, 800.0, 1164.0, "kg/m3")
    warmer = within("API, temperature", temperature, 253.15, 423.15, "K") - 288.15
    alpha = API_LUBRICANT / density_15C
    density = density_15C * np.exp(-alpha * warmer * (1.0 + 0.8 * alpha * warmer))
    return Tangent(density, -alpha * (1.0 + 1.6 * alpha * warmer) * density)


@dataclass(frozen=True)
class Aerated:
    """An oil with entrained air: law(pressure gauge) -> (mixture density over that at zero gauge, slope).

    `free_air` is the volume share of bubbles at zero gauge. Henry and Dalton: each volume of oil dissolves
    `bunsen` volumes of that air per atmosphere of rise and gives as much back when the pressure falls, at once;
    0 for a passage too short to dissolve any (a film's passage takes milliseconds, dissolving seconds).
    The free air follows V ~ P^(-1/n), n = 1 isothermal (small bubbles), 1.4 adiabatic. The mass of the air is
    left out (0.1 % of the oil's). The slope jumps where the last bubble dissolves.
    Source: Nykanen, Esque and Ellman 2000; Kim and Murrenhoff 2012; Gholizadeh, Burton and Schoenau 2011.
    Raises FilmInputError below 1 % of the absolute `atmosphere` (Pa at zero gauge): vapour, not this law.
    """

    liquid: DensityLaw
    free_air: float
    bunsen: float
    polytropic_exponent: float
    atmosphere: float = ATMOSPHERE

    def __post_init__(self) -> None:
        for name, value, top in (("free_air", self.free_air, 0.99), ("bunsen", self.bunsen, 10.0)):
            if not 0.0 <= value <= top:
                raise FilmInputError(f"aerated oil, {name}", f"{value:g}", f"0 .. {top:g}")
        if not 1.0 <= self.polytropic_exponent <= 1.7:
            raise FilmInputError("aerated oil, polytropic_exponent", f"{self.polytropic_exponent:g}", "1 .. 1.7")
        require_positive("aerated oil", atmosphere=self.atmosphere)

    def __call__(self, pressure: ArrayLike) -> Tangent:
        gauge = within("aerated oil, gauge pressure", pressure, -0.99 * self.atmosphere, np.inf, "Pa")
        liquid, liquid_slope = self.liquid(gauge)
        share, absolute = 1.0 - self.free_air, gauge + self.atmosphere
        dissolved_per_pascal = self.bunsen * share / self.atmosphere
        free = np.maximum(self.free_air - dissolved_per_pascal * gauge, 0.0)
        free_slope = np.where(free > 0.0, -dissolved_per_pascal, 0.0)
        squeezed = (self.atmosphere / absolute) ** (1.0 / self.polytropic_exponent)
        volume = share / liquid + free * squeezed
        volume_slope = (
            -share * liquid_slope / liquid**2
            + free_slope * squeezed
            - free * squeezed / (self.polytropic_exponent * absolute)
        )
        return Tangent(1.0 / volume, -volume_slope / volume**2)

    @property
    def saturation_pressure(self) -> float:
        """Gauge pressure (Pa) at which the last bubble is dissolved; infinite without solubility."""
        if self.bunsen == 0.0:
            return np.inf if self.free_air > 0.0 else 0.0
        return self.atmosphere * self.free_air / (self.bunsen * (1.0 - self.free_air))
