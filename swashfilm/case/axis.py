"""Varied keys with their values: as written in a case, as numbers, and in words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from system.inputs.shown import Shown, shown_in
from system.inputs.units import Dimension, QuantityError, format_quantity, parse_quantity


@dataclass(frozen=True)
class StudyAxis:
    """One varied key: its values as written in a case and, for numbers, in SI with their unit."""

    key: str
    values: tuple[Any, ...]
    numbers: tuple[float, ...] | None
    unit: str

    @property
    def labels(self) -> tuple[str, ...]:
        """The values as text."""
        return tuple(str(value) for value in self.values)

    @property
    def shown(self) -> Shown:
        """The unit in which the numbers are shown."""
        return shown_in(self.unit, self.key, max(map(abs, self.numbers or ()), default=0.0))

    def text(self, value: Any) -> str:
        """Return one of the values in the unit in which it is shown; one without a number as it is written."""
        if self.numbers is None:
            return str(value)
        return self.shown.stated(self.numbers[self.labels.index(str(value))])


def place_words(axes: Iterable[StudyAxis], values: Mapping[str, Any]) -> str:
    """Return values by key in words: `operating.speed = 1000 r/min, operating.pressure = 20 MPa`."""
    return ", ".join(f"{axis.key} = {axis.text(values[axis.key])}" for axis in axes)


def listed_axis(key: str, values: Sequence[Any]) -> StudyAxis:
    """Return an axis of listed values, with numbers where all are bare numbers or of one dimension."""
    if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values):
        return StudyAxis(key, tuple(values), tuple(float(value) for value in values), "")
    dimension = dimension_of(values)
    if dimension is None:
        return StudyAxis(key, tuple(values), None, "")
    numbers = tuple(parse_quantity(value, dimension) for value in values)
    return StudyAxis(key, tuple(values), numbers, dimension.si_unit)


def stepped(key: str, numbers: Sequence[float], dimension: Dimension | None) -> StudyAxis:
    """Return an axis of numbers (SI)."""
    if dimension is None:
        return StudyAxis(key, tuple(numbers), tuple(numbers), "")
    texts = [format_quantity(number, dimension, digits=12) for number in numbers]
    return StudyAxis(key, tuple(texts), tuple(parse_quantity(text, dimension) for text in texts), dimension.si_unit)


def dimension_of(values: Sequence[Any]) -> Dimension | None:
    """Return the first dimension that fits all texts as quantities."""
    for dimension in Dimension:
        try:
            for value in values:
                parse_quantity(value if isinstance(value, str) else None, dimension)
        except QuantityError:
            continue
        return dimension
    return None
