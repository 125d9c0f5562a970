"""Levels of an input on the command line: `1000,1300,1700rpm`, `500..2500rpm:9`, or both in one list."""

import re
from dataclasses import dataclass

import numpy as np

from system.inputs.faults import Fault
from system.inputs.units import Dimension, QuantityError, parse_quantity, parse_share
from system.maps.plan import MapAxis, MapInput

_NUMBER = re.compile(r"\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*")
_DASHED = re.compile(r"\s*(\d+\.?\d*)\s*-\s*(\d+\.?\d*)\s*([^\d\s].*|)")
_MOST = 1000
_USUAL = 7  # levels that a remedy proposes


def map_axis(option: str, text: str, given: MapInput, example: str) -> MapAxis | Fault:
    """Return the axis of a text, in rising order, each level once; a fault for an invalid text.

    The unit of an item holds for items before it without a unit; `a..b:n` are n equally spaced levels from a to b.
    """
    try:
        values = sorted({value for item in level_texts(text) for value in item.levels(given.dimension)})
    except QuantityError as reason:
        nearest = "" if _has_no_unit(reason.nearest, given.dimension) else reason.nearest
        return Fault(option, reason.found, f"{reason.expected}: {example}", nearest)
    return MapAxis(given, tuple(values))


def _has_no_unit(text: str, dimension: Dimension | None) -> bool:
    """Return whether a range without a unit is proposed where one is needed."""
    _, dots, high = text.partition(":")[0].partition("..")
    return dimension is not None and bool(dots) and _NUMBER.fullmatch(high) is not None


@dataclass(frozen=True)
class LevelText:
    """An item of a list of levels: one level, or two ends and the number of levels between them."""

    ends: tuple[str, ...]
    count: int = 1

    def levels(self, dimension: Dimension | None) -> list[float]:
        """Return the levels in SI; raise QuantityError for ends of another dimension, or equal ones."""
        ends = [_value(end, dimension) for end in self.ends]
        if self.count > 1 and ends[0] == ends[-1]:
            raise QuantityError(
                f"{self.count} levels from {self.ends[0]} to itself", "two ends, or one level", self.ends[0]
            )
        return [float(value) for value in np.linspace(ends[0], ends[-1], self.count)]


def level_texts(text: str) -> list[LevelText]:
    """Return the items of a text such as `1000,1300..1700rpm:5`, each with the unit of its list.

    Raises QuantityError for a range without a number of levels.
    """
    return [_item(item) for item in with_units([item.strip() for item in text.split(",")])]


def with_units(items: list[str]) -> list[str]:
    """Return the items, each without a unit completed by the unit of the next item that has one."""
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


def _item(item: str) -> LevelText:
    if dashed := dashed_range(item):
        raise QuantityError(repr(item), "a level, or a range with a number of levels", f"{dashed}:{_USUAL}")
    ends, colon, count = item.partition(":")
    low, dots, high = ends.partition("..")
    if bool(dots) != bool(colon):
        remedy = f"{item}:{_USUAL}" if dots else ""
        raise QuantityError(repr(item), "a level, or a range with a number of levels", remedy)
    if not dots:
        return LevelText((low,))
    if not (count.strip().isdecimal() and 2 <= int(count) <= _MOST):
        raise QuantityError(f"{count!r} levels", f"2 to {_MOST} levels")
    return LevelText((low, high), int(count))


def _value(text: str, dimension: Dimension | None) -> float:
    if dimension is not None:
        return parse_quantity(text.strip(), dimension)
    return parse_share(text)


def dashed_range(text: str) -> str:
    """Return `5..35MPa` of `5-35MPa`; empty for a text that is no such range."""
    match = _DASHED.fullmatch(text)
    return f"{match[1]}..{match[2]}{match[3]}" if match else ""


def range_of(
    faults: list[Fault], option: str, text: str, dimension: Dimension | None, example: str
) -> tuple[float, float] | None:
    """Return MIN..MAX in SI, the unit of MAX also that of a MIN without one; None after a fault."""
    ends = with_units([text])[0].split("..")
    try:
        if len(ends) != 2:
            raise QuantityError(repr(text), "two ends with .. between them", dashed_range(text))
        low, high = (_value(end, dimension) for end in ends)
        if not low < high:
            raise QuantityError(repr(text), "the lower end first")
    except QuantityError as reason:
        faults.append(Fault(option, reason.found, f"{reason.expected}: {example}", reason.nearest))
        return None
    return low, high
