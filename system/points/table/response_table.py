"""Response tables of a pump: its gaps' means over the turn, learnt once from solved points and kept by content.

A table belongs to one pump with its inlet and case pressure, at any speed, delivery pressure, displacement ratio,
viscosity and dimension of the pump in its box. Ports' lines belong to the run: points are solved at held pressures.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from gaps.response import Measure, Response, outside, unit_places
from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.description.keys import key_dimension, key_value
from system.description.pump import PumpDescription
from system.inputs.units import Dimension, format_quantity
from system.points.table.pump_numbers import NumbersError
from system.points.table.sources import Source
from system.pump.operating import OperatingPoint, flat

LARGE_ERROR = 0.03
"""Error of a held-out point above which a run warns of the table."""
HELD_TO = 1e-5
"""Relative: largest deviation of an input that a table holds."""
SPEED, PRESSURE, RATIO, VISCOSITY = "shaft_speed", "delivery_pressure", "displacement_ratio", "viscosity"
INPUTS = (SPEED, PRESSURE, RATIO, VISCOSITY)
"""Of the operating point; every other axis is a dimension of the pump by its path."""
_DIMENSIONS: Mapping[str, Dimension | None] = {
    SPEED: Dimension.ANGULAR_SPEED,
    PRESSURE: Dimension.PRESSURE,
    RATIO: None,
    VISCOSITY: Dimension.DYNAMIC_VISCOSITY,
    "temperature": Dimension.TEMPERATURE,
    "inlet_pressure": Dimension.PRESSURE,
    "case_pressure": Dimension.PRESSURE,
}


@dataclass(frozen=True)
class Failed:
    """A point without a result: its place (SI, in the order of the axes), and the reason."""

    at: tuple[float, ...]
    reason: str


@dataclass(frozen=True)
class TableOrigin:
    """Origin of a table's numbers.

    pump, pump_key: its name and its content; source with its physics, mesh and accuracy; package: the program's
    version; inlet_pressure, case_pressure Pa gauge; held: INPUTS without an axis, SI; dimensions: those with an axis by
    path, as the pump states them, SI; failed: points without a result; seconds of computing per point, mean.
    """

    pump: str
    pump_key: str
    source: Source
    stated: Mapping[str, str]
    package: str
    inlet_pressure: float
    case_pressure: float
    held: Mapping[str, float]
    dimensions: Mapping[str, float]
    failed: tuple[Failed, ...]
    seconds: float


@dataclass(frozen=True)
class ResponseTable:
    """A pump's response with its origin: axes of INPUTS except those held, and of dimensions of the pump; outputs of
    `means.MEANINGS`.

    numbers: errors of runs by the table at the held-out points; None before the runs.
    """

    origin: TableOrigin
    response: Response
    numbers: NumbersError | None = None

    def at(self, pump: PumpDescription, point: OperatingPoint) -> dict[str, float]:
        """The outputs by name of a pump at an operating point; shares of contact are limited to 0 .. 1.

        The pump: the table's own, of any dimensions in the box. Raises InputError for a place outside the box or at
        another value of a held input.
        """
        self._check_held(point)
        place = self._place(pump, point)[None, :]
        self._check_box(place)
        found = self._means(place)
        return {name: float(values[0]) for name, values in found.items()}

    def nearest(
        self, pump: PumpDescription, point: OperatingPoint[Array], off: Mapping[str, float]
    ) -> dict[str, Array]:
        """The outputs (N,) by name of a pump at N points, given as columns (N, 1) or arrays (N,).

        Outside the box those at its nearest face.

        off: excess of outputs by name, relative or absolute by their measure. Held inputs, inlet and case pressure act
        by the lumped law, the reference of the outputs' ratios.
        """
        at, axes = flat(point), self.response.axes
        places = [np.clip(_value(axis.name, pump, at), axis.lower, axis.upper) for axis in axes]
        found = self._means(np.stack(np.broadcast_arrays(*places), axis=1))
        for output in self.response.outputs:
            if (error := off.get(output.name, 0.0)) != 0.0:
                relative = output.measure is Measure.RELATIVE
                found[output.name] = found[output.name] * (1.0 + error) if relative else found[output.name] + error
        return found

    def _means(self, places: Array) -> dict[str, Array]:
        values = self.response.at(places)
        found = {output.name: values[:, k] for k, output in enumerate(self.response.outputs)}
        shares = {name: np.clip(own, 0.0, 1.0) for name, own in found.items() if name.endswith("contact_share")}
        return found | shares

    def holds(self, pump: PumpDescription, point: OperatingPoint) -> bool:
        """True if a pump at a point lies in the box, with the table's values of held inputs."""
        held = all(_same(value, getattr(point, name)) for name, value in self.origin.held.items())
        ends = zip(self.response.axes, self._place(pump, point), strict=True)
        return held and all(axis.lower <= value <= axis.upper for axis, value in ends)

    def beside_failed(self, pump: PumpDescription, point: OperatingPoint) -> Failed | None:
        """The point without a result that is nearer than any learnt one, if any: there the table is not reliable."""
        axes = self.response.axes
        here = unit_places(axes, self._place(pump, point)[None, :])
        distance = [
            np.linalg.norm(unit_places(axes, points) - here, axis=1)
            for points in (np.array([one.at for one in self.origin.failed]), self.response.learnt.points)
            if len(points)
        ]
        if not self.origin.failed or distance[0].min() >= distance[1].min():
            return None
        return self.origin.failed[int(distance[0].argmin())]

    def _place(self, pump: PumpDescription, point: OperatingPoint) -> Array:
        """The place (d,) of a pump at a point, in the order of the axes."""
        return np.array([_value(axis.name, pump, point) for axis in self.response.axes])

    def _check_box(self, place: Array) -> None:
        """Raise InputError for a place (1, d) outside the box: each input as people read it."""
        out = outside(self.response.axes, place)
        if out:
            ranges = (f"{axis_value(axis.name, axis.lower)} .. {axis_value(axis.name, axis.upper)}" for axis, _ in out)
            raise InputError(
                ", ".join(axis_words(axis.name) for axis, _ in out),
                ", ".join(axis_value(axis.name, value) for axis, value in out),
                f"{', '.join(ranges)}, the table's box: nothing is extrapolated",
            )

    def _check_held(self, point: OperatingPoint) -> None:
        for name, own in self.origin.held.items():
            if not _same(own, getattr(point, name)):
                found, expected = axis_value(name, getattr(point, name)), axis_value(name, own)
                raise InputError(name.replace("_", " "), found, f"{expected}, at which the table is held")
        for name in ("inlet_pressure", "case_pressure"):
            own, asked = getattr(self.origin, name), getattr(point, name)
            if abs(asked - own) > 1.0:
                shown = (format_quantity(value, Dimension.PRESSURE, digits=5) for value in (asked, own))
                raise InputError(name.replace("_", " "), *shown)


def _value(name: str, pump: PumpDescription, point: OperatingPoint[Any]) -> Any:
    """The value of an axis: an input of the point, or a dimension of the pump."""
    return getattr(point, name) if name in INPUTS else key_value(pump, name)


def axis_dimension(name: str) -> Dimension | None:
    """Kind of the quantity of an input or a pump's dimension; None for a pure number."""
    return _DIMENSIONS[name] if name in _DIMENSIONS else key_dimension(name)


def axis_words(name: str) -> str:
    """Name of an axis as people read it: an input in words, a dimension by its path."""
    return name if "." in name else name.replace("_", " ")


def _same(one: float, other: float) -> bool:
    """True if two values of an input are equal up to round-off and the tolerance of a port's pressure."""
    return abs(one - other) <= HELD_TO * abs(one)


def axis_value(name: str, value: float) -> str:
    """A value of an operating point or a pump's dimension as people read it."""
    dimension = axis_dimension(name)
    return f"{value:.4g}" if dimension is None else format_quantity(value, dimension, digits=4)


def box_text(table: ResponseTable) -> str:
    """The box of a table as text, with the held inputs."""
    ranges = {
        axis.name: f"{axis_value(axis.name, axis.lower)} .. {axis_value(axis.name, axis.upper)}"
        for axis in table.response.axes
    }
    held = {name: axis_value(name, value) for name, value in table.origin.held.items()}
    return ", ".join(f"{axis_words(name)} {text}" for name, text in (ranges | held).items())


def point_text(point: OperatingPoint) -> str:
    """The inputs of a point as people read them."""
    return ", ".join(f"{axis_words(name)} {axis_value(name, getattr(point, name))}" for name in INPUTS)
