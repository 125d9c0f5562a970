"""Response tables of a pump: its gaps' means over the turn, learnt once from solved points and kept by content.

A table belongs to a pump as it is, its inlet and case pressure included, at any speed, delivery pressure,
displacement ratio and viscosity in its box. Ports' lines belong to the run: points are solved at held pressures.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from gaps.response import Measure, Response, unit_places
from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.inputs.units import Dimension, format_quantity
from system.points.table.pump_numbers import NumbersError
from system.points.table.sources import Source
from system.pump.operating import OperatingPoint, flat

LARGE_ERROR = 0.03
"""Error of a held-out point from which a table is warned of."""
HELD_TO = 1e-5
"""Relative: how far an input that a table holds may be off."""
SPEED, PRESSURE, RATIO, VISCOSITY = "shaft_speed", "delivery_pressure", "displacement_ratio", "viscosity"
INPUTS = (SPEED, PRESSURE, RATIO, VISCOSITY)
DIMENSIONS = {
    SPEED: Dimension.ANGULAR_SPEED,
    PRESSURE: Dimension.PRESSURE,
    VISCOSITY: Dimension.DYNAMIC_VISCOSITY,
    "temperature": Dimension.TEMPERATURE,
    "inlet_pressure": Dimension.PRESSURE,
    "case_pressure": Dimension.PRESSURE,
}


@dataclass(frozen=True)
class Failed:
    """A point that has no result: where (SI, in the order of the axes), and why."""

    at: tuple[float, ...]
    reason: str


@dataclass(frozen=True)
class TableOrigin:
    """Origin of a table's numbers.

    pump, pump_key: its name and its content; source with its physics, mesh and accuracy; package: the program's
    version; inlet_pressure, case_pressure Pa gauge; held: INPUTS without an axis, SI; failed: points without a
    result; seconds of computing per point, mean.
    """

    pump: str
    pump_key: str
    source: Source
    stated: Mapping[str, str]
    package: str
    inlet_pressure: float
    case_pressure: float
    held: Mapping[str, float]
    failed: tuple[Failed, ...]
    seconds: float


@dataclass(frozen=True)
class ResponseTable:
    """A pump's response with its origin: axes of INPUTS but for those held, outputs of `table_means.MEANINGS`.

    numbers: how far runs by the table are off at the held-out points; None before they were run.
    """

    origin: TableOrigin
    response: Response
    numbers: NumbersError | None = None

    def at(self, point: OperatingPoint) -> dict[str, float]:
        """The outputs by name at an operating point; shares of contact are limited to 0 .. 1.

        Raises InputError for a point outside the box or at another value of a held input.
        """
        self._check_held(point)
        found = self._means(np.array([[getattr(point, axis.name) for axis in self.response.axes]]))
        return {name: float(values[0]) for name, values in found.items()}

    def nearest(self, point: OperatingPoint[Array], off: Mapping[str, float]) -> dict[str, Array]:
        """The outputs (N,) by name at N points, given as columns (N, 1) or arrays (N,): outside the box those at its
        nearest face.

        off: outputs by name that are too large by so much, relative or absolute as their measure is. Held
        inputs, inlet and case pressure act by the lumped law that the outputs are ratios to.
        """
        at = flat(point)
        places = [np.clip(getattr(at, axis.name), axis.lower, axis.upper) for axis in self.response.axes]
        found = self._means(np.stack(places, axis=1))
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

    def holds(self, point: OperatingPoint) -> bool:
        """True if a point lies in the box, with the table's values of held inputs."""
        held = all(_same(value, getattr(point, name)) for name, value in self.origin.held.items())
        return held and all(axis.lower <= getattr(point, axis.name) <= axis.upper for axis in self.response.axes)

    def beside_failed(self, point: OperatingPoint) -> Failed | None:
        """The point without a result that is nearer than any learnt one, if any: there the table guesses."""
        axes = self.response.axes
        here = unit_places(axes, np.array([[getattr(point, axis.name) for axis in axes]]))
        distance = [
            np.linalg.norm(unit_places(axes, points) - here, axis=1)
            for points in (np.array([one.at for one in self.origin.failed]), self.response.learnt.points)
            if len(points)
        ]
        if not self.origin.failed or distance[0].min() >= distance[1].min():
            return None
        return self.origin.failed[int(distance[0].argmin())]

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


def _same(one: float, other: float) -> bool:
    """True if two values of an input are equal up to round-off and the tolerance of a port's pressure."""
    return abs(one - other) <= HELD_TO * abs(one)


def axis_value(name: str, value: float) -> str:
    """A value of an operating point's as people read it."""
    return format_quantity(value, DIMENSIONS[name], digits=4) if name in DIMENSIONS else f"{value:.4g}"


def box_text(table: ResponseTable) -> str:
    """The box of a table as text, with the held inputs."""
    ranges = {
        axis.name: f"{axis_value(axis.name, axis.lower)} .. {axis_value(axis.name, axis.upper)}"
        for axis in table.response.axes
    }
    held = {name: axis_value(name, value) for name, value in table.origin.held.items()}
    return ", ".join(f"{name.replace('_', ' ')} {text}" for name, text in (ranges | held).items())


def point_text(point: OperatingPoint) -> str:
    """The inputs of a point as people read them."""
    return ", ".join(f"{name.replace('_', ' ')} {axis_value(name, getattr(point, name))}" for name in INPUTS)
