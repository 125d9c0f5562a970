"""Viscosity over shear rate: Carreau, Carreau-Yasuda, Cross and the Ree-Eyring stress law.

Each is a published function of shear rate gamma (1/s, its magnitude counts) and viscosity without shear mu0
(Pa s), and a frozen class of an oil's constants. The second Newtonian viscosity is given as a
share of mu0, so that it follows temperature and pressure.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from reynolds.errors import FilmInputError
from reynolds.laws.law import require_positive
from reynolds.numerics.arrays import Array


def carreau_yasuda(
    shear_rate: ArrayLike,
    viscosity: ArrayLike,
    second_newtonian: float,
    relaxation_time: float,
    exponent: float,
    transition: float,
) -> Array:
    """mu = mu2 + (mu0 - mu2) [1 + (lambda gamma)^a]^((n - 1)/a), mu2 = second_newtonian mu0; a = transition.

    Source: Yasuda, Armstrong and Cohen 1981; a = 2 is Carreau 1972. n is the power-law index, 0 <= n <= 1.
    """
    reduced = relaxation_time * np.abs(np.asarray(shear_rate, dtype=float))
    thinned = (1.0 + reduced**transition) ** ((exponent - 1.0) / transition)
    return np.asarray(viscosity, dtype=float) * (second_newtonian + (1.0 - second_newtonian) * thinned)


def cross(
    shear_rate: ArrayLike, viscosity: ArrayLike, second_newtonian: float, relaxation_time: float, exponent: float
) -> Array:
    """mu = mu2 + (mu0 - mu2)/[1 + (lambda gamma)^m], mu2 = second_newtonian mu0. Source: Cross 1965."""
    reduced = relaxation_time * np.abs(np.asarray(shear_rate, dtype=float))
    share = second_newtonian + (1.0 - second_newtonian) / (1.0 + reduced**exponent)
    return np.asarray(viscosity, dtype=float) * share


def eyring(shear_rate: ArrayLike, viscosity: ArrayLike, eyring_stress: float) -> Array:
    """mu = tau/gamma with tau = tau0 asinh(mu0 gamma/tau0), tau0 in Pa (oils 2 .. 10 MPa).

    Source: Ree and Eyring 1955, Johnson and Tevaarwerk 1977. Tends to mu0 as gamma to zero.
    """
    mu0 = np.asarray(viscosity, dtype=float)
    reduced = mu0 * np.abs(np.asarray(shear_rate, dtype=float)) / eyring_stress
    # asinh(x)/x = 1 - x^2/6 + ...: one to round-off below 1e-8, where the quotient is 0/0 in the end.
    small = np.maximum(reduced, 1e-8)
    return np.asarray(mu0 * np.arcsinh(small) / small)


def _check(where: str, second_newtonian: float, relaxation_time: float, exponent: float) -> None:
    require_positive(where, relaxation_time=relaxation_time)
    for name, share in (("second_newtonian", second_newtonian), ("exponent", exponent)):
        if not 0.0 <= share <= 1.0:
            raise FilmInputError(f"{where}, {name}", f"{share:g}", "0 .. 1: an oil that thins")


@dataclass(frozen=True)
class Carreau:
    """Carreau's law: mu2/mu0, relaxation time (s), power-law index n. Raises FilmInputError outside 0 .. 1."""

    second_newtonian: float
    relaxation_time: float
    exponent: float

    def __post_init__(self) -> None:
        _check("Carreau", self.second_newtonian, self.relaxation_time, self.exponent)

    def __call__(self, shear_rate: ArrayLike, viscosity: ArrayLike) -> Array:
        return carreau_yasuda(
            shear_rate, viscosity, self.second_newtonian, self.relaxation_time, self.exponent, transition=2.0
        )


@dataclass(frozen=True)
class Cross:
    """Cross' law: mu2/mu0, relaxation time (s), exponent m = 1 - n. Raises FilmInputError outside 0 .. 1."""

    second_newtonian: float
    relaxation_time: float
    exponent: float

    def __post_init__(self) -> None:
        _check("Cross", self.second_newtonian, self.relaxation_time, self.exponent)

    def __call__(self, shear_rate: ArrayLike, viscosity: ArrayLike) -> Array:
        return cross(shear_rate, viscosity, self.second_newtonian, self.relaxation_time, self.exponent)


@dataclass(frozen=True)
class Eyring:
    """Ree-Eyring's law with its stress tau0, Pa."""

    stress: float

    def __post_init__(self) -> None:
        require_positive("Eyring", stress=self.stress)

    def __call__(self, shear_rate: ArrayLike, viscosity: ArrayLike) -> Array:
        return eyring(shear_rate, viscosity, self.stress)
