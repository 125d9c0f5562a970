"""Laws of the oil in pressure: viscosity and density, each with its slope for Newton's method."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from reynolds.numerics.arrays import Array

ViscosityLaw = Callable[[Array, Array], tuple[Array, Array]]
"""(pressure Pa, viscosity Pa s at the reference pressure) -> viscosity Pa s and its slope by pressure, Pa s/Pa."""

DensityLaw = Callable[[Array], tuple[Array, Array]]
"""Pressure Pa -> density over that at the reference pressure, and its slope, 1/Pa."""


def isoviscous(pressure: Array, viscosity: Array) -> tuple[Array, Array]:
    """A viscosity independent of pressure."""
    return viscosity, np.zeros((1, 1))


def incompressible(pressure: Array) -> tuple[Array, Array]:
    """A density independent of pressure: ratio one."""
    return _constant(pressure.shape)


@lru_cache(maxsize=64)
def _constant(shape: tuple[int, ...]) -> tuple[Array, Array]:
    """Ones and zeros, made once a shape; not to be written to."""
    ratio, slope = np.ones(shape), np.zeros(shape)
    ratio.flags.writeable = slope.flags.writeable = False
    return ratio, slope


@dataclass(frozen=True)
class Fluid:
    """Laws of the oil in pressure; flows of a film are volumes at the reference density (ratio one)."""

    viscosity: ViscosityLaw = isoviscous
    density: DensityLaw = incompressible


CONSTANT = Fluid()
