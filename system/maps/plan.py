"""Range of an operating map: levels of five inputs, and the faults of any point of their grid."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from itertools import product

from reynolds.errors import InputError
from system.description.pump import PumpDescription
from system.inputs.faults import Fault
from system.inputs.shown import Shown, shown_in
from system.inputs.units import Dimension
from system.pump.operating import OperatingPoint, operating_point
from system.pump_file.check import CheckWarning
from system.pump_file.operating import check_operating_point

MOST_POINTS = 100_000
"""Largest number of points of a map: each keeps some 60 numbers by name, about 10 kB with its file's text."""
LUMPED_SECONDS = 0.006
"""Processor time (s) of a lumped point, about."""


class MapInput(Enum):
    """The inputs of a map by their field in `OperatingPoint`, in the order of its axes."""

    SPEED = "shaft_speed"
    PRESSURE = "delivery_pressure"
    RATIO = "displacement_ratio"
    TEMPERATURE = "temperature"
    INLET_PRESSURE = "inlet_pressure"

    @property
    def dimension(self) -> Dimension | None:
        """Dimension of the input; None for the displacement ratio, a bare number."""
        return _DIMENSIONS.get(self)

    @property
    def unit(self) -> str:
        """The SI unit of its levels."""
        return self.dimension.si_unit if self.dimension else "1"

    @property
    def words(self) -> str:
        """Name for people."""
        return "oil temperature in the case" if self is MapInput.TEMPERATURE else self.value.replace("_", " ")

    def text(self, value: float) -> str:
        """A value as people read it."""
        return self.shown.stated(value)

    @property
    def shown(self) -> Shown:
        """The unit that people read its levels in."""
        return shown_in(self.unit, self.value)


_DIMENSIONS = {
    MapInput.SPEED: Dimension.ANGULAR_SPEED,
    MapInput.PRESSURE: Dimension.PRESSURE,
    MapInput.TEMPERATURE: Dimension.TEMPERATURE,
    MapInput.INLET_PRESSURE: Dimension.PRESSURE,
}


@dataclass(frozen=True)
class MapAxis:
    """The levels of one input, SI, rising; a single level holds the input. Raises InputError for others."""

    input: MapInput
    values: tuple[float, ...]

    def __post_init__(self) -> None:
        rising = all(low < high for low, high in zip(self.values, self.values[1:], strict=False))
        if not self.values or not rising:
            found = ", ".join(self.input.text(value) for value in self.values) or "no level"
            raise InputError(f"levels of {self.input.words}", found, "levels that rise, each once")


@dataclass(frozen=True)
class MapPlan:
    """A pump over the grid of five axes, in the order of `MapInput`; all other inputs are the pump's own."""

    pump: PumpDescription
    axes: tuple[MapAxis, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of levels of each axis."""
        return tuple(len(axis.values) for axis in self.axes)

    @property
    def size(self) -> int:
        """Number of points."""
        return math.prod(self.shape)

    @cached_property
    def points(self) -> tuple[OperatingPoint, ...]:
        """All points, the last axis' level changing first; raises InputError where the oil's law is not valid."""
        names = [axis.input.value for axis in self.axes]
        levels = product(*(axis.values for axis in self.axes))
        return tuple(operating_point(self.pump, **dict(zip(names, level, strict=True))) for level in levels)

    def checked(self) -> MapCheck:
        """Faults and warnings of all points, each listed once; a fault of more than MOST_POINTS alone."""
        return self._checked

    @cached_property
    def _checked(self) -> MapCheck:
        if self.size > MOST_POINTS:
            return MapCheck((self._too_many(),), {})
        faults: Counter[Fault] = Counter()
        warnings: dict[str, list[CheckWarning]] = {}
        for point in self.points:
            report = check_operating_point(self.pump, point)
            faults.update(report.faults)
            for warning in report.warnings:
                warnings.setdefault(warning.path, []).append(warning)
        listed = {
            path: f"{path}: at {len(found)} of {self.size} points; at the first: {found[0].text}"
            for path, found in warnings.items()
        }
        return MapCheck(tuple(faults), listed)

    def _too_many(self) -> Fault:
        """The fault of a plan of more than MOST_POINTS."""
        levels = " x ".join(f"{len(axis.values)} of {axis.input.words}" for axis in self.axes if len(axis.values) > 1)
        most = (
            f"at most {MOST_POINTS} points, which take {LUMPED_SECONDS * MOST_POINTS / 60.0:.0f} min at the lumped "
            "fidelity and 1 GB of memory"
        )
        fewer = "fewer levels: numbers between them are interpolated (the map's error is measured)"
        return Fault("points", f"{self.size}, levels {levels}", most, fewer)


@dataclass(frozen=True)
class MapCheck:
    """Faults of a plan's points, each once, and its warnings by their key of the pump file."""

    faults: tuple[Fault, ...]
    warnings: Mapping[str, str]


def map_plan(pump: PumpDescription, axes: Sequence[MapAxis]) -> MapPlan:
    """A plan of the stated axes; an input without an axis is held at the pump's own operating point."""
    stated, point = {axis.input: axis for axis in axes}, operating_point(pump)
    held = {given: MapAxis(given, (getattr(point, given.value),)) for given in MapInput}
    return MapPlan(pump, tuple((held | stated).values()))


def point_words(point: OperatingPoint) -> str:
    """The inputs of a point as people read them."""
    return ", ".join(f"{given.words} {given.text(getattr(point, given.value))}" for given in MapInput)


def reading_levels(axis: MapAxis) -> tuple[float, ...]:
    """The levels of an axis in the unit that people read them in, `axis.input.shown`."""
    return tuple(float(f"{axis.input.shown.of(value):.12g}") for value in axis.values)
