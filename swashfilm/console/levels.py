"""Levels of an input on the command line: `1000,1300,1700rpm`, `500..2500rpm:9`, or both in one list."""

import re

import numpy as np

from system.inputs.faults import Fault
from system.inputs.units import Dimension, QuantityError, parse_quantity, with_point
from system.maps.plan import MapAxis, MapInput

_NUMBER = re.compile(r"\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*")
_MOST = 1000


def map_axis(option: str, text: str, given: MapInput, example: str) -> MapAxis | Fault:
    """Return the axis of a text, in rising order, each level once; a fault for an invalid text.

    The unit of an item holds for items before it without a unit; `a..b:n` are n equally spaced levels from a to b.
    """
    try:
        items = _with_units([item.strip() for item in text.split(",")], given.dimension)
        values = sorted({value for item in items for value in _levels(item, given.dimension)})
    except QuantityError as reason:
        return Fault(option, reason.found, f"{reason.expected}: {example}", reason.nearest)
    return MapAxis(given, tuple(values))


def _with_units(items: list[str], dimension: Dimension | None) -> list[str]:
    """Return the items, each without a unit completed by the unit of the next item that has one."""
    if dimension is None:
        return items
    found, unit = [], ""
    for item in reversed(items):
        ends, colon, count = item.partition(":")
        low, dots, high = ends.partition("..")
        parts = []
        for part in (high, low) if dots else (low,):
            if _NUMBER.fullmatch(part):
                parts.append(part.strip() + unit)
            else:
                unit = re.sub(r"^\s*[+-]?[\d.]+([eE][+-]?\d+)?", "", part)
                parts.append(part)
        found.append(dots.join(reversed(parts)) + colon + count)
    return found[::-1]


def _levels(item: str, dimension: Dimension | None) -> list[float]:
    ends, colon, count = item.partition(":")
    low, dots, high = ends.partition("..")
    if bool(dots) != bool(colon):
        raise QuantityError(repr(item), "a level, or a range with a number of levels")
    if not dots:
        return [_value(low, dimension)]
    if not (count.strip().isdecimal() and 2 <= int(count) <= _MOST):
        raise QuantityError(f"{count!r} levels", f"2 to {_MOST} levels")
    return [float(value) for value in np.linspace(_value(low, dimension), _value(high, dimension), int(count))]


def _value(text: str, dimension: Dimension | None) -> float:
    if dimension is not None:
        return parse_quantity(text.strip(), dimension)
    try:
        return float(text)
    except ValueError:
        raise QuantityError(repr(text), "bare numbers", with_point(text)) from None
