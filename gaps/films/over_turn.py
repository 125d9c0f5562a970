"""Quantities over one turn of the shaft, interpolated between known angles: the drive of a floating part."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import PchipInterpolator

from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array

TURN = 2.0 * np.pi
WRAPPED = 3  # knots repeated beyond either end, so that slopes there are those of a closed curve

OverTurn = Callable[[float], Array]
"""Shaft angle (rad, any turn) -> value: a number or an array, SI."""


@dataclass(frozen=True)
class PeriodicCurve:
    """Values (n, ...) at rising angles (n,) rad within one turn, continued from turn to turn.

    Between the angles monotone cubic interpolation (Fritsch and Carlson 1980, Fritsch and Butland 1984): slope
    continuous, of second order or better, and never beyond its neighbours, so that no pressure falls below the
    lowest one given. Raises FilmInputError for fewer than four angles, angles that do not rise or span a turn or
    more, and for values that are not finite.
    """

    angles: Array
    values: Array

    def __post_init__(self) -> None:
        rising = np.isfinite(self.angles).all() and (np.diff(self.angles) > 0.0).all()
        if len(self.angles) <= WRAPPED or not rising or not self.angles[-1] - self.angles[0] < TURN:
            found = f"{len(self.angles)} from {np.degrees(self.angles[0]):g} to {np.degrees(self.angles[-1]):g} deg"
            raise FilmInputError("course over a turn, angles", found, "four or more, rising, within one turn")
        if len(self.values) != len(self.angles) or not np.isfinite(self.values).all():
            found = f"an array of shape {np.shape(self.values)}"
            raise FilmInputError("course over a turn, values", found, f"{len(self.angles)} finite ones")

    def __call__(self, angle: float) -> Array:
        """The value at a shaft angle (rad)."""
        first = self.angles[0]
        lowest, highest = self._range
        return np.clip(self._between(first + (angle - first) % TURN), lowest, highest)

    @cached_property
    def _range(self) -> tuple[Array, Array]:
        """Least and largest values, beyond which interpolation may round in the last digit."""
        return self.values.min(axis=0), self.values.max(axis=0)

    @cached_property
    def _between(self) -> PchipInterpolator:
        wrapped = [
            self.angles[-WRAPPED:] - TURN, self.angles, self.angles[: WRAPPED + 1] + TURN,
        ]  # fmt: skip
        values = [self.values[-WRAPPED:], self.values, self.values[: WRAPPED + 1]]
        return PchipInterpolator(np.concatenate(wrapped), np.concatenate(values), axis=0, extrapolate=False)


def constant(*value: float) -> OverTurn:
    """A constant quantity: a number, or (k,) of several."""
    held = np.asarray(value[0] if len(value) == 1 else value, dtype=float)
    return lambda angle: held
