"""The oil: viscosity over temperature (Walther; ASTM D341) and the ISO viscosity grades (ISO 3448)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from reynolds.errors import FilmInputError
from reynolds.laws.law import within

CONTINUUM = 1e-8  # m; a film thinner than some ten molecules is no continuum
WALTHER_SHIFT = 0.7  # mm2/s; the constant of ASTM D341, good above LOWEST_KINEMATIC_VISCOSITY
LOWEST_KINEMATIC_VISCOSITY = 2e-6  # m2/s; below this ASTM D341 needs further terms
LOWEST_TEMPERATURE = 233.15  # K (-40 degC): near the pour point of mineral hydraulic oils
HIGHEST_TEMPERATURE = 423.15  # K (150 degC): the oil ages within hours above this

_TEMPERATURE_40C = 313.15
_TEMPERATURE_100C = 373.15


@dataclass(frozen=True)
class Oil:
    """A Newtonian oil at the pressure of the case, given by two viscosities.

    kinematic_viscosity_40C, kinematic_viscosity_100C in m2/s, density in kg/m3, bulk_modulus in Pa,
    specific_heat in J/(kg K). Raises FilmInputError for a value that is not positive, for a viscosity below
    ASTM D341's 2 mm2/s and for an oil that does not thin from 40 to 100 degC.
    """

    kinematic_viscosity_40C: float
    kinematic_viscosity_100C: float
    density: float
    bulk_modulus: float
    specific_heat: float

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not value > 0.0:
                raise FilmInputError(f"oil {name}", f"{value:g}", "a positive SI value")
        if self.kinematic_viscosity_100C < LOWEST_KINEMATIC_VISCOSITY:
            found = f"{self.kinematic_viscosity_100C * 1e6:g} mm2/s"
            raise FilmInputError("oil kinematic_viscosity_100C", found, "at least 2 mm2/s (ASTM D341)")
        if self.kinematic_viscosity_100C >= self.kinematic_viscosity_40C:
            found = f"{self.kinematic_viscosity_100C * 1e6:g} mm2/s"
            at_40 = f"{self.kinematic_viscosity_40C * 1e6:g} mm2/s at 40 degC"
            raise FilmInputError("oil kinematic_viscosity_100C", found, f"less than the {at_40}")


@dataclass(frozen=True)
class ViscosityGrade:
    """An ISO viscosity grade by its kinematic viscosities at 40 and 100 degC, in m2/s."""

    kinematic_viscosity_40C: float
    kinematic_viscosity_100C: float


# At 40 degC: the midpoint of ISO 3448. At 100 degC: viscosity index 100 by ASTM D2270 (a mineral oil),
# to the 0.1 mm2/s of a data sheet.
ISO_GRADES = {
    "ISO VG 10": ViscosityGrade(10e-6, 2.7e-6),
    "ISO VG 15": ViscosityGrade(15e-6, 3.4e-6),
    "ISO VG 22": ViscosityGrade(22e-6, 4.3e-6),
    "ISO VG 32": ViscosityGrade(32e-6, 5.4e-6),
    "ISO VG 46": ViscosityGrade(46e-6, 6.8e-6),
    "ISO VG 68": ViscosityGrade(68e-6, 8.7e-6),
    "ISO VG 100": ViscosityGrade(100e-6, 11.4e-6),
    "ISO VG 150": ViscosityGrade(150e-6, 15.0e-6),
}


def walther_coefficients(oil: Oil) -> tuple[float, float]:
    """Return A, m of log10 log10(nu + 0.7) = A - m log10 T, nu in mm2/s and T in K, through 40 and 100 degC.

    Source: Walther 1931, as in ASTM D341.
    """
    at_40 = _double_log(oil.kinematic_viscosity_40C)
    at_100 = _double_log(oil.kinematic_viscosity_100C)
    slope = (at_40 - at_100) / (np.log10(_TEMPERATURE_100C) - np.log10(_TEMPERATURE_40C))
    return float(at_40 + slope * np.log10(_TEMPERATURE_40C)), float(slope)


def walther(temperature: ArrayLike, oil: Oil) -> np.ndarray:
    """Return the kinematic viscosity in m2/s at `temperature` in K (any shape), from Walther's law.

    Raises FilmInputError outside -40 .. 150 degC and where the oil is thinner than 2 mm2/s: the law is not valid there.
    Source: Walther 1931, ASTM D341.
    """
    kelvin = np.asarray(temperature, dtype=float)
    lowest, highest = (limit - 273.15 for limit in (LOWEST_TEMPERATURE, HIGHEST_TEMPERATURE))
    within("oil temperature", kelvin - 273.15, lowest, highest, "degC", "there Walther's law holds")
    intercept, slope = walther_coefficients(oil)
    viscosity = 1e-6 * (10.0**10.0 ** (intercept - slope * np.log10(kelvin)) - WALTHER_SHIFT)
    if not np.all(viscosity >= LOWEST_KINEMATIC_VISCOSITY):
        raise FilmInputError(
            f"oil at {np.max(kelvin) - 273.15:g} degC",
            f"{np.min(viscosity) * 1e6:.3g} mm2/s",
            "at least 2 mm2/s, from which ASTM D341 holds: a thicker grade or a lower temperature",
        )
    return viscosity


def dynamic_viscosity(oil: Oil, temperature: float) -> float:
    """Return the dynamic viscosity in Pa s at `temperature` in K: Walther's law times the density.

    The density is constant: its thermal expansion (0.07 %/K) is within the oil grade's own 10 %.
    Raises FilmInputError outside the range of `walther`.
    """
    return float(walther(temperature, oil)) * oil.density


def temperature_of(oil: Oil, viscosity: float) -> float:
    """Return the temperature in K at which `dynamic_viscosity` is `viscosity` in Pa s: Walther's law solved for T.

    Raises FilmInputError where that is outside the range of `walther`.
    """
    intercept, slope = walther_coefficients(oil)
    kelvin = 10.0 ** ((intercept - _double_log(viscosity / oil.density)) / slope)
    walther(kelvin, oil)
    return float(kelvin)


def _double_log(kinematic_viscosity: float) -> float:
    return float(np.log10(np.log10(kinematic_viscosity * 1e6 + WALTHER_SHIFT)))
