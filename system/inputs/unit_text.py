"""Meaning of a unit's text: factor, zero and dimensions, exactly."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pint

_ANGLE_WORDS = ("radian", "turn", "revolution", "arcminute", "arcsecond", "grade")
_POWER = re.compile(r"(?<=[A-Za-zµμ])(?:\^|\*\*)?(-?\d)")
_FACTOR = r"[A-Za-zµμ°]+[A-Za-z]*(?:(?:\^|\*\*)?-?\d|[²³])?"
_PRODUCT = rf"{_FACTOR}(?:\s*[*·. ]\s*{_FACTOR})*"
_UNIT_TEXT = re.compile(rf"(?:1(?=\s*/)|{_PRODUCT})(?:\s*/\s*(?:{_FACTOR}|\(\s*{_PRODUCT}\s*\)))*")


@dataclass(frozen=True)
class Unit:
    """A unit: value in base units (m, kg, s, K, rad) = factor * number + offset, exactly."""

    factor: Fraction
    offset: Fraction
    dimensionality: frozenset[tuple[str, object]]
    counts_angle: bool


@cache
def _registry() -> pint.UnitRegistry:
    """Return the one registry; its numbers are fractions, so that a unit adds no rounding of its own."""
    import pint

    registry: pint.UnitRegistry = pint.UnitRegistry(non_int_type=Fraction, on_redefinition="ignore")
    registry.define("@alias turn = rev = r")
    registry.define("lpm = liter / minute")
    registry.define("Nm = newton * meter")  # pint reads a count of textile yarn here
    return registry


@cache
def unit_of_text(text: str) -> Unit | None:
    """Return what a unit text means, or None when it is not known."""
    import pint

    if _UNIT_TEXT.fullmatch(text) is None:
        return None
    registry = _registry()
    try:
        unit = registry.Unit(_POWER.sub(r"**\1", text.replace(".", "*")))
        origin = registry.Quantity(Fraction(0), unit).to_base_units().magnitude
        first = registry.Quantity(Fraction(1), unit).to_base_units().magnitude
    except (pint.PintError, TypeError):  # TypeError: a logarithmic unit, such as dB
        return None
    names = [name for name, _ in registry.Quantity(1, unit).unit_items()]
    return Unit(
        factor=Fraction(first) - Fraction(origin),
        offset=Fraction(origin),
        dimensionality=frozenset(unit.dimensionality.items()),
        counts_angle="degree" in names or any(word in name for name in names for word in _ANGLE_WORDS),
    )
