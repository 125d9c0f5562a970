"""Units in which people read numbers: the door from SI to tables, pictures and CSV files, and back to SI.

Files for programs (summary.json, NetCDF) stay in SI.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from enum import Enum
from math import floor, isfinite, log10, pi
from typing import TYPE_CHECKING, Any, overload

from system.inputs.units import LPM, RPM, Dimension, format_quantity

if TYPE_CHECKING:
    from reynolds.numerics.arrays import Array

DIGITS = 4
"""Significant digits of a number in tables."""
SMALL = 1e-3
"""Size below which a number is shown with a power of ten."""
THICK = 1e-3
"""Length in m above any film's."""


ROUND_OFF = 1e-10
"""Part of the largest number of a unit below which another number of it is round-off."""


class PressureUnit(Enum):
    """Unit in which pressures are shown."""

    MPA = "MPa"
    BAR = "bar"


_ASKED: ContextVar[PressureUnit | None] = ContextVar("pressures", default=None)


@contextmanager
def pressures_in(unit: PressureUnit | None) -> Iterator[None]:
    """Show pressures inside in this unit: in tables, pictures and CSV files; None: MPa, readings of a bench in bar."""
    before = _ASKED.set(unit)
    try:
        yield
    finally:
        _ASKED.reset(before)


def pressure_unit(usual: PressureUnit = PressureUnit.MPA) -> PressureUnit:
    """Return the unit in which pressures are shown: `usual` if no other is requested."""
    return _ASKED.get() or usual


@dataclass(frozen=True)
class Shown:
    """Unit in which numbers of an SI unit are shown: (value - zero) x factor."""

    si: str
    unit: str
    factor: float = 1.0
    zero: float = 0.0

    @overload
    def of(self, value: float) -> float: ...
    @overload
    def of(self, value: Array) -> Array: ...
    def of(self, value: float | Array) -> float | Array:
        """Return an SI value in the unit."""
        return (value - self.zero) * self.factor

    def difference(self, value: float) -> float:
        """Return a difference of two SI values in the unit."""
        return value * self.factor

    def to_si(self, value: Array) -> Array:
        """Return values of the unit in SI."""
        return value / self.factor + self.zero

    def text(self, value: float, digits: int = DIGITS) -> str:
        """Return an SI value rounded to significant digits, with its unit."""
        return f"{significant(self.of(value), digits)} {self.symbol}".rstrip()

    def stated(self, value: float) -> str:
        """Return an SI value that is an input, with its unit and up to six digits."""
        return f"{self.of(value):.6g} {self.symbol}".rstrip()

    @property
    def symbol(self) -> str:
        """The unit behind a number; empty for a bare number."""
        return "" if self.unit == "1" else self.unit


_PRESSURE = {PressureUnit.MPA: Shown("Pa", "MPa", 1e-6), PressureUnit.BAR: Shown("Pa", "bar", 1e-5)}
_SHOWN = {
    one.si: one
    for one in (
        Shown("m", "um", 1e6), Shown("m2", "mm2", 1e6), Shown("m3", "mL", 1e6), Shown("m3/s", "L/min", LPM),
        Shown("m3/rev", "mL/r", 1e6), Shown("rad", "deg", 180.0 / pi), Shown("rad/s", "r/min", 1.0 / RPM),
        Shown("K", "degC", 1.0, 273.15), Shown("Pa s", "mPa s", 1e3), Shown("J", "kJ", 1e-3),
        Shown("m2/s", "mm2/s", 1e6), Shown("Pa/s", "GPa/s", 1e-9),
    )
}  # fmt: skip
_PLACE, _TILT, _RATE = Shown("m", "mm", 1e3), Shown("rad", "mrad", 1e3), Shown("rad/s", "deg/s", 180.0 / pi)
_WARMING = Shown("K", "K")
PERCENT = Shown("1", "%", 100.0)
"""Shares and efficiencies."""
_BY_WORDS = (
    (re.compile(r"^((piston|slipper|valve_plate)_)?[xyz]$|radius|along|_at$|diameter|length"), _PLACE),
    (re.compile(r"tilt|slope"), _TILT),
    (re.compile(r"rate|fastest"), _RATE),
    (re.compile(r"rise|error|sigma|change"), _WARMING),
)
"""Other units of quantities whose name contains these words: places in a film, small angles, and the like."""
_BACK = {one.unit: one for one in (*_SHOWN.values(), *_PRESSURE.values(), _PLACE, _TILT, _RATE, PERCENT)}


def shown_in(si_unit: str, quantity: str = "", largest: float = 0.0) -> Shown:
    """Return the unit in which a quantity of an SI unit is shown; itself where people read it in SI.

    Lengths are those of films, in um, unless their name or their largest value indicates otherwise.
    """
    if si_unit == "Pa":
        return _PRESSURE[pressure_unit()]
    for words, own in _BY_WORDS:
        if own.si == si_unit and words.search(quantity.replace(" ", "_")):
            return own
    if si_unit == "m" and largest >= THICK:
        return _PLACE
    return _SHOWN.get(si_unit, Shown(si_unit or "1", si_unit or "1"))


def pressure_text(value: float, digits: int = 3) -> str:
    """Return a pressure in Pa for a sentence, rounded to significant digits, with the unit in which it is shown."""
    shown = shown_in("Pa")
    return f"{float(f'{shown.of(value):.{digits}g}'):g} {shown.unit}"


def quantity_text(value: float, dimension: Dimension, digits: int = 3) -> str:
    """Return an SI value for a sentence in the unit that suits its size; pressures in the requested unit."""
    if dimension is Dimension.PRESSURE:
        return pressure_text(value, digits)
    if dimension is Dimension.ANGULAR_SPEED:
        return f"{value / RPM:.{digits}g} r/min"
    return format_quantity(value, dimension, digits=digits)


def known_unit(unit: str) -> Shown:
    """Return the conversion of a unit in a head; a unit that is not shown elsewhere is itself."""
    return _BACK.get(unit, Shown(unit, unit))


def titled(words: str, unit: str) -> str:
    """Return the title of a column or an axis: `load [N]`; without a unit the words alone."""
    return f"{words} [{unit}]" if unit and unit != "1" else words


def title_in(words: str, si_unit: str) -> str:
    """Return the title of an axis whose numbers are shown in the unit for this SI unit: `pressure, gauge [MPa]`."""
    return titled(words, shown_in(si_unit, words).unit)


def significant(value: float, digits: int = DIGITS) -> str:
    """Return a number with significant digits; a power of ten only for small and huge numbers."""
    if value == 0.0 or not isfinite(value):
        return "0" if value == 0.0 else str(value)
    size = floor(log10(abs(float(f"{value:.{digits - 1}e}"))))
    if abs(value) < SMALL or size >= 9:
        return f"{value:.{digits - 1}e}".replace("e-0", "e-").replace("e+0", "e+")
    return f"{value:.{max(0, digits - 1 - size)}f}"


def largest_of_units(numbers: Iterable[tuple[str, Any]]) -> Mapping[str, float]:
    """Return the largest magnitude of the finite numbers of each unit, the scale of round-off.

    Bare numbers have no common scale, and neither have temperatures.
    """
    import numpy as np

    scales: dict[str, float] = {}
    for unit, values in numbers:
        known = np.abs(np.array(values, dtype=float))
        if unit not in ("", "1", "K") and np.any(np.isfinite(known)):
            scales[unit] = max(scales.get(unit, 0.0), float(np.max(known[np.isfinite(known)])))
    return scales


def round_off(name: str, unit: str, scales: Mapping[str, float]) -> float:
    """Return the size below which a number of this name and SI unit is round-off; fractions are of 1."""
    return ROUND_OFF * scales.get(unit, 1.0 if "fraction" in name else 0.0)
