"""Distributions of a pump's dimensions over a series."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.tolerance import Shape

SIGMAS = 3.0
"""Standard deviations of a normal dimension between its middle and a limit of the drawing."""
DEVIATION = {Shape.NORMAL: SIGMAS, Shape.UNIFORM: math.sqrt(3.0), Shape.TRIANGULAR: math.sqrt(6.0)}
"""Half width of the tolerance over the standard deviation, of a shape that is even about its middle."""


@dataclass(frozen=True)
class Drawn:
    """A dimension with its distribution: middle and standard deviation, SI; limits of a bounded shape.

    name: its path; keys: that, and those that scatter in proportion to it. peak: the likeliest value of a triangle.
    parts: of a pump, each of its own size; the distribution is that of one. logarithmic: of a normal dimension the
    logarithm scatters, by sigma over middle, and the middle is the median; least and most then cut the distribution.
    """

    name: str
    keys: tuple[str, ...]
    shape: Shape
    middle: float
    sigma: float
    least: float = -math.inf
    most: float = math.inf
    peak: float = math.nan
    parts: int = 1
    logarithmic: bool = False
    scores: ClassVar[int] = 1

    @property
    def law(self) -> str:
        """Name of the distribution."""
        return "log-normal" if self.logarithmic else self.shape.value


@dataclass(frozen=True)
class DrawnFit:
    """A radial clearance of hole and shaft, limits of their diameters in m, paired by class; parts: pairs of a pump."""

    name: str
    shape: Shape
    hole: tuple[float, float]
    shaft: tuple[float, float]
    classes: int
    parts: int = 1
    scores: ClassVar[int] = 2

    @property
    def law(self) -> str:
        """Name of either diameter's distribution."""
        return self.shape.value

    @property
    def keys(self) -> tuple[str, ...]:
        """Its path."""
        return (self.name,)


@dataclass(frozen=True)
class Drawing:
    """All that scatters; correlation: coefficient of the normal scores by the names of two dimensions.

    unused: keys of [tolerance] of an unknown of a pump that is no scattering dimension.
    """

    dimensions: tuple[Drawn, ...]
    fits: tuple[DrawnFit, ...]
    correlation: Mapping[tuple[str, str], float]
    unused: tuple[str, ...]

    @property
    def members(self) -> tuple[Drawn | DrawnFit, ...]:
        """Dimensions, then fits."""
        return (*self.dimensions, *self.fits)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the members."""
        return tuple(one.name for one in self.members)

    def matrix(self) -> Array:
        """Return the correlation of the dimensions' scores (k, k), fits left out."""
        found = np.eye(len(self.dimensions))
        at = {one.name: place for place, one in enumerate(self.dimensions)}
        for (one, other), coefficient in self.correlation.items():
            found[at[one], at[other]] = found[at[other], at[one]] = coefficient
        return found


def pump_sigma(one: Drawn | DrawnFit) -> float:
    """Return the standard deviation (SI) of a dimension of a pump: of the mean of its parts."""
    return (one.sigma if isinstance(one, Drawn) else fit_sigma(one)) / math.sqrt(one.parts)


def fit_sigma(fit: DrawnFit) -> float:
    """Return the standard deviation (m) of one clearance, of uniform diameters in their classes."""
    hole, shaft = fit.hole[1] - fit.hole[0], fit.shaft[1] - fit.shaft[0]
    within = (hole**2 + shaft**2) / fit.classes**2
    between = (hole - shaft) ** 2 * (1.0 - 1.0 / fit.classes**2)
    return 0.5 * math.sqrt(within + between) / (2.0 * DEVIATION[fit.shape])
