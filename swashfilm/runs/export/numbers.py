"""Numbers of a map for other programs: names, units, values over the map's axes; and its points without result."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.units import Dimension, unit_scale
from system.maps.data import MapData
from system.maps.plan import MapAxis
from system.maps.point import GAPS, columns
from system.pump.bench import EFFICIENCIES
from system.pump.efficiency import EfficiencyDefinition

TABLES = (
    "shaft_torque", "delivery_flow", "inlet_flow", "drain_flow", "loss", *(f"film_least.{gap}" for gap in GAPS),
)  # fmt: skip
"""Numbers that a model of the pump in another program reads: each is a table of its own there."""
DIMENSIONS = {
    "rad/s": Dimension.ANGULAR_SPEED, "Pa": Dimension.PRESSURE, "K": Dimension.TEMPERATURE, "m": Dimension.LENGTH,
    "N m": Dimension.TORQUE, "m3/s": Dimension.VOLUME_FLOW, "W": Dimension.POWER, "m3/rev": Dimension.DISPLACEMENT,
}  # fmt: skip
"""Dimension of each SI unit of a map."""
PERCENT = "%"
READING_UNITS = {
    "rad/s": "r/min", "Pa": "bar", "K": "degC", "m": "um", "N m": "N m", "m3/s": "L/min", "W": "W",
    "m3/rev": "cm3/rev", "1": PERCENT,
}  # fmt: skip
"""Unit that people read a number in, by SI unit."""


@dataclass(frozen=True)
class Display:
    """A unit that people read: its name, and value there = factor * SI value + offset."""

    name: str
    factor: float
    offset: float


@dataclass(frozen=True)
class Number:
    """A number of a map: its name, its SI unit, its meaning, its values over the map's five axes."""

    name: str
    unit: str
    words: str
    values: Array

    @property
    def identifier(self) -> str:
        """The name without points, valid in any language."""
        return self.name.replace(".", "_")


def numbers(data: MapData) -> Iterator[Number]:
    """Yield every number of the map, the loss, and the efficiencies by definition; nan if not defined."""
    yield from _read(data)
    for definition in EfficiencyDefinition:
        found = data.efficiency(definition)
        for part in EFFICIENCIES:
            words = f"{part} efficiency, {definition.label}"
            yield Number(f"{part}_efficiency.{definition.value}", "1", words, getattr(found, part))


def tables(data: MapData) -> tuple[Number, ...]:
    """Return the numbers of `TABLES`, in that order."""
    known = {number.name: number for number in _read(data)}
    return tuple(known[name] for name in TABLES)


def _read(data: MapData) -> Iterator[Number]:
    for name, unit, words in columns():
        yield Number(name, unit, words, data.values[name])
    yield Number("loss", "W", "shaft power less p Q summed over delivery, inlet and case", data.loss)


def wide(data: MapData) -> tuple[MapAxis, ...]:
    """Return the axes with several levels; the other inputs are held."""
    return tuple(axis for axis in data.axes if len(axis.values) > 1)


def held(data: MapData) -> str:
    """Return the inputs with one level, in words: "temperature 50 degC, .."; empty where all vary."""
    return ", ".join(
        f"{axis.input.words} {axis.input.text(axis.values[0])}" for axis in data.axes if len(axis.values) == 1
    )


def first_hole(data: MapData) -> str:
    """Return the number of points without a result, and inputs and reason of the first; empty for a whole map."""
    lacking = np.argwhere(~data.solved)
    if not len(lacking):
        return ""
    index = tuple(int(k) for k in lacking[0])
    place = ", ".join(axis.input.text(axis.values[k]) for axis, k in zip(data.axes, index, strict=True))
    return f"{len(lacking)} of {data.solved.size} points without a result, the first at {place}: {data.reason[index]}"


def display(si_unit: str) -> Display:
    """Return the unit that people read numbers of an SI unit in."""
    name = READING_UNITS[si_unit]
    if name == PERCENT:
        return Display(name, 100.0, 0.0)
    if name == si_unit:
        return Display(name, 1.0, 0.0)
    factor, offset = unit_scale(name, DIMENSIONS[si_unit])
    return Display(name, 1.0 / factor, 0.0 - offset / factor)


def in_unit(values: Array, si_unit: str, unit: str) -> Array:
    """Return SI values in another unit of their dimension; of bare numbers (unit 1), in percent."""
    if unit == si_unit:
        return values
    if unit == PERCENT:
        return 100.0 * values
    factor, offset = unit_scale(unit, DIMENSIONS[si_unit])
    return np.asarray((values - offset) / factor)
