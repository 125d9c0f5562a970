"""Viscosity over temperature (Walther, Vogel) and over pressure (Barus, Roelands), each with its slope."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from reynolds.errors import BeyondBarus, FilmInputError
from reynolds.laws.law import Tangent, require_positive, within
from reynolds.laws.oil import HIGHEST_TEMPERATURE, LOWEST_TEMPERATURE, WALTHER_SHIFT, Oil, walther, walther_coefficients

# Barus is the tangent of ln mu at zero pressure. With mu0 = 0.041 Pa s and 22 /GPa it is 1.2 times Roelands at 0.1 GPa
# and 2.9 times at 0.3 GPa: beyond, it is not valid (at 1 GPa it is e^22).
BARUS_HIGHEST_PRESSURE = 0.3e9  # Pa
ROELANDS_PRESSURE = 1.96e8  # Pa; Roelands 1966, as in Hamrock, Schmid and Jacobson 2004
ROELANDS_LOG_VISCOSITY = 9.67  # ln(1 Pa s / 6.31e-5 Pa s): where all his isotherms meet
ROELANDS_HIGHEST_PRESSURE = 1.0e9  # Pa; above, most oils are near their glass transition


def barus(pressure: ArrayLike, viscosity: ArrayLike, coefficient: float) -> Tangent:
    """mu = mu0 exp(alpha p) and dmu/dp; p Pa gauge, mu0 Pa s, alpha 1/Pa; arrays broadcast.

    Source: Barus 1893. Validity: moderate pressure; raises BeyondBarus beyond +-0.3 GPa.
    """
    remedy = "Roelands' law holds to 1 GPa"
    p = within("Barus, pressure", pressure, -BARUS_HIGHEST_PRESSURE, BARUS_HIGHEST_PRESSURE, "Pa", remedy, BeyondBarus)
    mu = np.asarray(viscosity, dtype=float) * np.exp(coefficient * p)
    return Tangent(mu, coefficient * mu)


def roelands_index(coefficient: float, viscosity: ArrayLike) -> np.ndarray:
    """z = alpha 1.96e8 Pa/(ln mu0 + 9.67): the index with which Roelands' law starts with the slope alpha (1/Pa).

    Source: Roelands 1966. Raises FilmInputError for mu0 below 1e-4 Pa s, near the pole of the law.
    """
    log_viscosity = np.log(within("Roelands, viscosity at zero pressure", viscosity, 1e-4, 1e6, "Pa s"))
    return np.asarray(coefficient * ROELANDS_PRESSURE / (log_viscosity + ROELANDS_LOG_VISCOSITY))


def roelands(pressure: ArrayLike, viscosity: ArrayLike, index: ArrayLike) -> Tangent:
    """mu = mu0 exp{(ln mu0 + 9.67)[(1 + p/1.96e8)^z - 1]} and dmu/dp; p Pa gauge, mu0 Pa s; arrays broadcast.

    Source: Roelands 1966. Validity: to about 0.5 GPa within a few percent; raises FilmInputError above 1 GPa
    and below -0.1 GPa (tension, where there are no data).
    """
    p = within("Roelands, pressure", pressure, -0.1e9, ROELANDS_HIGHEST_PRESSURE, "Pa")
    mu0 = within("Roelands, viscosity at zero pressure", viscosity, 1e-4, 1e6, "Pa s")
    z = np.asarray(index, dtype=float)
    above_pole = np.log(mu0) + ROELANDS_LOG_VISCOSITY
    pressed = 1.0 + p / ROELANDS_PRESSURE
    mu = mu0 * np.exp(above_pole * (pressed**z - 1.0))
    return Tangent(mu, mu * above_pole * z * pressed ** (z - 1.0) / ROELANDS_PRESSURE)


@dataclass(frozen=True)
class Barus:
    """Barus' law with its pressure-viscosity coefficient alpha, 1/Pa (mineral oils 1.5e-8 .. 2.5e-8)."""

    coefficient: float

    def __call__(self, pressure: ArrayLike, viscosity_at_reference: ArrayLike) -> Tangent:
        return barus(pressure, viscosity_at_reference, self.coefficient)


@dataclass(frozen=True)
class Roelands:
    """Roelands' law by the coefficient alpha (1/Pa) that it has at zero pressure, the same at any temperature."""

    coefficient: float

    def __call__(self, pressure: ArrayLike, viscosity_at_reference: ArrayLike) -> Tangent:
        index = roelands_index(self.coefficient, viscosity_at_reference)
        return roelands(pressure, viscosity_at_reference, index)


@dataclass(frozen=True)
class RoelandsIndex:
    """Roelands' law by its index z (mineral oils 0.5 .. 0.7), nearly the same at all temperatures.

    Its coefficient alpha = z (ln mu0 + 9.67)/1.96e8 Pa falls as the oil warms: the better choice in a film
    whose temperature is solved for.
    """

    index: float

    def __call__(self, pressure: ArrayLike, viscosity_at_reference: ArrayLike) -> Tangent:
        return roelands(pressure, viscosity_at_reference, self.index)


@dataclass(frozen=True)
class Walther:
    """Dynamic viscosity of an oil by ASTM D341 (`oil.walther`) at constant density: law(T) -> (mu, dmu/dT).

    Raises FilmInputError outside the range of `oil.walther`.
    """

    oil: Oil

    def __call__(self, temperature: ArrayLike) -> Tangent:
        kelvin = np.asarray(temperature, dtype=float)
        kinematic = walther(kelvin, self.oil)
        _, m = walther_coefficients(self.oil)
        shifted = kinematic * 1e6 + WALTHER_SHIFT
        slope = -m * 1e-6 * shifted * np.log(shifted) / kelvin
        return Tangent(self.oil.density * kinematic, self.oil.density * slope)


@dataclass(frozen=True)
class Vogel:
    """mu = a exp(b/(T + c)), T in K: law(T) -> (mu, dmu/dT). a in Pa s, b and c in K, c negative for oils.

    Source: Vogel 1921. Three constants, so that it may pass through three measurements. Raises FilmInputError
    outside -40 .. 150 degC and at or below the pole T = -c.
    """

    a: float
    b: float
    c: float

    def __call__(self, temperature: ArrayLike) -> Tangent:
        kelvin = within("Vogel, temperature", temperature, LOWEST_TEMPERATURE, HIGHEST_TEMPERATURE, "K")
        above_pole = kelvin + self.c
        if not np.all(above_pole > 0.0):
            raise FilmInputError("Vogel, temperature", f"{np.min(kelvin):g} K", f"above the pole, {-self.c:g} K")
        mu = self.a * np.exp(self.b / above_pole)
        return Tangent(mu, -self.b * mu / above_pole**2)


def vogel_through(temperatures: tuple[float, float, float], viscosities: tuple[float, float, float]) -> Vogel:
    """Vogel's law through three viscosities (Pa s) at three rising temperatures (K), in closed form.

    Raises FilmInputError unless the viscosity falls, and ln mu falls ever more slowly, as oils do.
    """
    require_positive("Vogel, viscosities", first=viscosities[0], second=viscosities[1], third=viscosities[2])
    (t1, t2, t3), (y1, y2, y3) = temperatures, np.log(viscosities)
    if not (0.0 < t1 < t2 < t3 and y1 > y2 > y3):
        raise FilmInputError("Vogel", f"{temperatures} K, {viscosities} Pa s", "three rising K, falling Pa s")
    ratio = (y1 - y2) * (t3 - t2) / ((y2 - y3) * (t2 - t1))  # = (t3 + c)/(t1 + c)
    if ratio <= 1.0:
        raise FilmInputError("Vogel", f"ln mu falls {ratio:g} times as fast at first", "more than 1: an oil")
    c = (t3 - ratio * t1) / (ratio - 1.0)
    b = (y1 - y2) * (t1 + c) * (t2 + c) / (t2 - t1)
    return Vogel(float(np.exp(y1 - b / (t1 + c))), float(b), float(c))
