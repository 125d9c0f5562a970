"""Parameters with priors: each is a standard normal number xi and the value that follows from it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from math import exp, inf, log, sqrt

from reynolds.errors import InputError
from system.inputs.units import Dimension


class Scale(Enum):
    """Relation of a value to its standard number xi, with centre v0 and spread s."""

    NORMAL = "normal"  # v0 + s xi
    LOG = "log"  # v0 exp(s xi)
    HALF = "half"  # v0 + s xi with xi >= 0: of one sign only
    SQUARE = "square"  # (v0^2 + 2 v0 s xi)^(1/2): readings are nearly linear in the value's square


class Role(Enum):
    """Subject of a parameter."""

    BASE = "base"
    FLUID = "fluid"
    SENSOR = "sensor"
    EXTENSION = "extension"


@dataclass(frozen=True)
class Parameter:
    """One parameter and its prior: xi ~ N(0, 1), cut to [lower, upper] in value; HALF: also xi >= 0.

    centre, lower and upper are SI values; spread is in SI too, except relative for LOG. `dimension` is None for a pure
    number. `source` is the origin of the prior. linear: readings are linear in it, so that steps may be long. power: of
    a LOG value in which readings are nearly linear (3 for a film that leaks), 0 without such a power.
    """

    name: str
    role: Role
    scale: Scale
    centre: float
    spread: float
    lower: float
    upper: float
    dimension: Dimension | None
    source: str
    linear: bool = False
    power: float = 0.0

    def __post_init__(self) -> None:
        """Raise InputError for an invalid prior."""
        where = f"parameter {self.name}"
        if not 0 < self.spread < inf:
            raise InputError(where, f"a spread of {self.spread}", "a positive number")
        if not self.lower <= self.centre <= self.upper or self.lower == self.upper:
            raise InputError(where, f"centre {self.centre}", f"one within [{self.lower}, {self.upper}]")
        if self.scale is Scale.LOG and not self.lower >= 0 < self.centre:
            raise InputError(where, f"centre {self.centre}, lower {self.lower}", "positive values on a log scale")
        if self.scale is Scale.SQUARE and not self.lower > 0:
            raise InputError(where, f"lower {self.lower}", "a positive value on a scale of squares")

    @property
    def lowest(self) -> float:
        """The least xi allowed: that of `lower`, and 0 on a HALF scale."""
        if self.scale is Scale.HALF:
            return 0.0
        return self.standard(self.lower)

    @property
    def highest(self) -> float:
        """The largest xi allowed."""
        return self.standard(self.upper)

    def value(self, xi: float) -> float:
        """The value in SI of a standard number."""
        if self.scale is Scale.LOG:
            return self.centre * exp(self.spread * xi)
        if self.scale is Scale.SQUARE:
            return sqrt(max(self.centre**2 + 2.0 * self.centre * self.spread * xi, self.lower**2))
        return self.centre + self.spread * xi

    def standard(self, value: float) -> float:
        """The standard number of a value in SI: the inverse of `value`."""
        if self.scale is Scale.LOG:
            return log(value / self.centre) / self.spread if value > 0 else -inf
        if self.scale is Scale.SQUARE:
            return (value**2 - self.centre**2) / (2.0 * self.centre * self.spread)
        return (value - self.centre) / self.spread

    def stretch(self, xi: float) -> float:
        """d value / d xi, in SI: factor from a slope by value to a slope by xi."""
        if self.scale is Scale.SQUARE:
            return self.centre * self.spread / self.value(xi)
        return self.spread * (self.value(xi) if self.scale is Scale.LOG else 1.0)

    @property
    def bend(self) -> float:
        """power times spread on a LOG scale, else 0: readings are nearly linear in exp(bend xi)."""
        return self.power * self.spread if self.scale is Scale.LOG else 0.0

    def widened(self, factor: float) -> Parameter:
        """The same parameter with a prior `factor` times as wide, between the same bounds."""
        return replace(self, spread=self.spread * factor)

    def held(self, sigmas: float) -> Parameter:
        """The same parameter, no farther than so many sigma from its centre."""
        lower, upper = max(self.lower, self.value(-sigmas)), min(self.upper, self.value(sigmas))
        return replace(self, lower=lower, upper=upper)
