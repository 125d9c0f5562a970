"""The units of most files, with what they are; all others are read by pint, which takes a second to start."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

_NAMES = "[length]", "[mass]", "[time]", "[temperature]"
_PI = Fraction("3.1415926535897932384626433832795028841971693993751")
"""As many digits as pint has, so that a unit is the same from either."""


@dataclass(frozen=True)
class Unit:
    """A unit: value in base units (m, kg, s, K, rad) = factor * number + offset, exactly."""

    factor: Fraction
    offset: Fraction
    dimensionality: frozenset[tuple[str, object]]
    counts_angle: bool


def _unit(factor: Fraction | int | str, *powers: int, offset: str = "0", angle: bool = False) -> Unit:
    """Return a unit by the powers of length, mass, time and temperature, as far as they are not zero."""
    own = frozenset((name, Fraction(power)) for name, power in zip(_NAMES, powers, strict=False) if power)
    return Unit(Fraction(factor), Fraction(offset), own, angle)


USUAL = {
    "m": _unit(1, 1), "mm": _unit("1e-3", 1), "um": _unit("1e-6", 1),
    "m2": _unit(1, 2), "mm2": _unit("1e-6", 2),
    "m3": _unit(1, 3), "cm3": _unit("1e-6", 3),
    "m3/rev": _unit(1 / (2 * _PI), 3, angle=True), "cm3/rev": _unit(Fraction("1e-6") / (2 * _PI), 3, angle=True),
    "rad": _unit(1, angle=True), "deg": _unit(_PI / 180, angle=True),
    "rad/s": _unit(1, 0, 0, -1, angle=True), "rpm": _unit(_PI / 30, 0, 0, -1, angle=True),
    "r/min": _unit(_PI / 30, 0, 0, -1, angle=True),
    "Pa": _unit(1, -1, 1, -2), "bar": _unit(10**5, -1, 1, -2), "MPa": _unit(10**6, -1, 1, -2),
    "GPa": _unit(10**9, -1, 1, -2), "Pa s": _unit(1, -1, 1, -1), "mPa s": _unit("1e-3", -1, 1, -1),
    "kg": _unit(1, 0, 1), "g": _unit("1e-3", 0, 1), "kg/m3": _unit(1, -3, 1),
    "N": _unit(1, 1, 1, -2), "N/m": _unit(1, 0, 1, -2), "N/mm": _unit(1000, 0, 1, -2), "N m": _unit(1, 2, 1, -2),
    "m3/s": _unit(1, 3, 0, -1), "L/min": _unit("1/60000", 3, 0, -1),
    "K": _unit(1, 0, 0, 0, 1), "degC": _unit(1, 0, 0, 0, 1, offset="273.15"),
    "J/(kg K)": _unit(1, 2, 0, -2, -1), "s": _unit(1, 0, 0, 1),
}  # fmt: skip
"""Unit by its text."""
