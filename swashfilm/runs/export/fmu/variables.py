"""Variables of the unit: the inputs of the map, its numbers, and their value references."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from swashfilm.runs.export.numbers import tables
from system.maps.data import MapData
from system.maps.plan import MapAxis

TIME = 0
"""Value reference of the time; inputs and outputs follow in their order."""
EFFICIENCY = "overall_efficiency"


@dataclass(frozen=True)
class Output:
    """An output of the unit: name, SI unit, meaning, value reference."""

    name: str
    unit: str
    words: str
    reference: int


@dataclass(frozen=True)
class Input:
    """An input of the unit, or a constant where its axis has one level; value reference."""

    axis: MapAxis
    reference: int

    @property
    def constant(self) -> bool:
        """Whether the map has one level of it."""
        return len(self.axis.values) == 1

    @property
    def start(self) -> float:
        """Its initial value, SI: the middle level."""
        return self.axis.values[len(self.axis.values) // 2]

    @property
    def words(self) -> str:
        """Its meaning, and its range in the map."""
        given, levels = self.axis.input, self.axis.values
        gauge = ", gauge" if given.unit == "Pa" else ""
        ends = "constant" if self.constant else f"the map has {given.text(levels[0])} .. {given.text(levels[-1])}"
        return f"{given.words}{gauge}; {ends}"


def inputs(data: MapData) -> tuple[Input, ...]:
    """Return the five inputs of a map."""
    return tuple(Input(axis, k) for k, axis in enumerate(data.axes, start=TIME + 1))


def outputs(data: MapData) -> tuple[Output, ...]:
    """Return the numbers of `TABLES`, and the overall efficiency last."""
    return tuple(Output(*row, k) for k, row in enumerate(_rows(data), start=TIME + 1 + len(data.axes)))


def _rows(data: MapData) -> Iterator[tuple[str, str, str]]:
    for number in tables(data):
        yield number.identifier, number.unit, number.words
    yield EFFICIENCY, "1", "(p2 Q2 - p1 Q1)/(w T), pressures at the ports; 0 where the machine does not pump"
