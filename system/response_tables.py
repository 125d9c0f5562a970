"""Response tables of a pump: its gaps' means over the turn, learnt once from solved points and kept by content.

A table belongs to a pump as it is, its inlet and case pressure included, at any speed, delivery pressure,
displacement ratio and viscosity in its box. Ports' lines belong to the run: points are solved at held pressures.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from gaps.response import Axis, Response, unit_places
from reynolds.errors import FilmInputError
from system.operating import OperatingPoint
from system.table_sources import Source
from system.units import Dimension, format_quantity

LARGE_ERROR = 0.03
"""Error of a held-out point from which a table is warned of."""
SPEED, PRESSURE, RATIO, VISCOSITY = "shaft_speed", "delivery_pressure", "displacement_ratio", "viscosity"
DIMENSIONS = {SPEED: Dimension.ANGULAR_SPEED, PRESSURE: Dimension.PRESSURE, VISCOSITY: Dimension.DYNAMIC_VISCOSITY}


@dataclass(frozen=True)
class Failed:
    """A point that has no result: where (SI, in the order of the axes), and why."""

    at: tuple[float, ...]
    reason: str


@dataclass(frozen=True)
class Origin:
    """Where a table's numbers come from.

    pump, pump_key: its name and its content; source with what it states of physics, mesh and accuracy; package:
    the program's version; inlet_pressure, case_pressure Pa gauge; failed: points without a result; seconds of
    computing that a point took, mean.
    """

    pump: str
    pump_key: str
    source: Source
    stated: Mapping[str, str]
    package: str
    inlet_pressure: float
    case_pressure: float
    failed: tuple[Failed, ...]
    seconds: float


@dataclass(frozen=True)
class ResponseTable:
    """A pump's response with its origin: axes SPEED .. VISCOSITY, outputs of `table_means.MEANINGS`."""

    origin: Origin
    response: Response

    def at(self, point: OperatingPoint) -> dict[str, float]:
        """The outputs by name at an operating point; shares of contact are held to 0 .. 1, which a share is.

        Raises FilmInputError for a point outside the box or at another inlet or case pressure.
        """
        self._check_held(point)
        values = self.response.at(np.array([[getattr(point, axis.name) for axis in self.response.axes]]))[0]
        found = {output.name: float(value) for output, value in zip(self.response.outputs, values, strict=True)}
        shares = {name: min(max(found[name], 0.0), 1.0) for name in found if name.endswith("contact_share")}
        return found | shares

    def holds(self, point: OperatingPoint) -> bool:
        """Whether a point lies in the box."""
        return all(axis.lower <= getattr(point, axis.name) <= axis.upper for axis in self.response.axes)

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
        for name in ("inlet_pressure", "case_pressure"):
            own, asked = getattr(self.origin, name), getattr(point, name)
            if abs(asked - own) > 1.0:
                shown = (format_quantity(value, Dimension.PRESSURE, digits=5) for value in (asked, own))
                raise FilmInputError(name.replace("_", " "), *shown)


def axis_value(name: str, value: float) -> str:
    """A value of an axis as people read it."""
    return format_quantity(value, DIMENSIONS[name], digits=4) if name in DIMENSIONS else f"{value:.4g}"


def box_text(axes: tuple[Axis, ...]) -> str:
    """The box as people read it."""
    rows = (
        f"{a.name.replace('_', ' ')} {axis_value(a.name, a.lower)} .. {axis_value(a.name, a.upper)}" for a in axes
    )
    return ", ".join(rows)


def point_text(point: OperatingPoint) -> str:
    """The inputs of a point as people read them."""
    names = (SPEED, PRESSURE, RATIO, VISCOSITY)
    return ", ".join(f"{name.replace('_', ' ')} {axis_value(name, getattr(point, name))}" for name in names)
