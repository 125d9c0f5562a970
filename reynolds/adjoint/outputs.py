"""Outputs of a film whose derivatives are wanted: each gives its value, as `Loads` has it, and its slopes."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import ClassVar, Protocol

import numpy as np

from reynolds.adjoint.flow import flow_slopes
from reynolds.adjoint.heat import heat_slopes
from reynolds.adjoint.shear import shear_slopes
from reynolds.adjoint.solved import OutputSlopes, SolvedFilm, slopes_of
from reynolds.errors import FilmInputError
from reynolds.laws.contact import contact_pressure
from reynolds.problem import FilmProblem
from reynolds.solve.bearing import directions, radius_around
from reynolds.solve.loads import point_fields


class Wall(Enum):
    """A wall of the film."""

    MOVING = "moving"
    FIXED = "fixed"


class Axis(Enum):
    """A direction in the film plane."""

    X = "x"
    Y = "y"


class Output(Protocol):
    """An output of a film: its unit and its slopes."""

    @property
    def unit(self) -> str:
        """SI unit of the value."""

    def slopes(self, film: SolvedFilm) -> OutputSlopes:
        """Value and slopes; raises FilmInputError where the film has no such output."""


@dataclass(frozen=True)
class LoadOutput:
    """Load of the film, N: integral of p."""

    unit: ClassVar[str] = "N"

    def slopes(self, film: SolvedFilm) -> OutputSlopes:
        """As `Output`."""
        value = float(np.sum(film.pressure[0] * film.space.axial_area))
        return slopes_of(film, value, by_pressure=film.on_unknowns(film.space.axial_area))


@dataclass(frozen=True)
class ContactLoadOutput:
    """Load of the asperities, N; raises FilmInputError for walls without asperities."""

    unit: ClassVar[str] = "N"

    def slopes(self, film: SolvedFilm) -> OutputSlopes:
        """As `Output`."""
        asperities, area = film.problem.asperities, film.space.axial_area
        if asperities is None:
            raise FilmInputError("contact load", "walls without asperities", "a problem with `asperities`")
        bears = contact_pressure(asperities, film.solution.gap)
        return slopes_of(film, float(np.sum(bears.value * area)), by_gap=bears.slope * area)


@dataclass(frozen=True)
class MomentOutput:
    """Moment about an axis, N m: integral of p y about x, of -p x about y, p with the contact's pressure."""

    axis: Axis
    unit: ClassVar[str] = "N m"

    def slopes(self, film: SolvedFilm) -> OutputSlopes:
        """As `Output`."""
        x, y, _ = film.space.points_in_space
        lever = film.space.area * (y if self.axis is Axis.X else -x)
        pressed, by_gap = film.pressure[0], None
        if film.problem.asperities is not None:
            bears = contact_pressure(film.problem.asperities, film.solution.gap)
            pressed, by_gap = pressed + bears.value, bears.slope * lever
        value = float(np.sum(pressed * lever))
        return slopes_of(film, value, by_pressure=film.on_unknowns(lever), by_gap=by_gap)


@dataclass(frozen=True)
class BearingLoadOutput:
    """Size of the load of a film whose x runs once around a cylinder, N: |int (p + p_c) exp(2 pi i x/L) dA|.

    Raises FilmInputError for a film without load, whose vector has no direction.
    """

    unit: ClassVar[str] = "N"

    def slopes(self, film: SolvedFilm) -> OutputSlopes:
        """As `Output`."""
        around, pressed, by_gap = directions(film.space), film.pressure[0], None
        bears = (
            None if film.problem.asperities is None else contact_pressure(film.problem.asperities, film.solution.gap)
        )
        if bears is not None:
            pressed = pressed + bears.value
        load = complex(np.sum(pressed * around * film.space.area))
        if load == 0.0:
            raise FilmInputError("bearing load", "a film without load", "a film that bears a load")
        along = np.real(around * load.conjugate()) / abs(load) * film.space.area
        if bears is not None:
            by_gap = bears.slope * along
        return slopes_of(film, abs(load), by_pressure=film.on_unknowns(along), by_gap=by_gap)


@dataclass(frozen=True)
class FlowOutput:
    """Flow out through a named boundary, m3/s; raises FilmInputError for one that is closed or unknown."""

    boundary: str
    unit: ClassVar[str] = "m3/s"

    def slopes(self, film: SolvedFilm) -> OutputSlopes:
        """As `Output`."""
        return flow_slopes(film, self.boundary)


@dataclass(frozen=True)
class FrictionOutput:
    """Force of oil and contact on a wall along an axis, N."""

    axis: Axis
    wall: Wall = Wall.MOVING
    unit: ClassVar[str] = "N"

    def slopes(self, film: SolvedFilm) -> OutputSlopes:
        """As `Output`."""
        one, nothing = np.ones((1, 1)), np.zeros((1, 1))
        along = (one, nothing) if self.axis is Axis.X else (nothing, one)
        return shear_slopes(film, along, on_moving=self.wall is Wall.MOVING)


@dataclass(frozen=True)
class FrictionForceOutput:
    """Magnitude of the force of oil and contact on the moving wall, N; raises FilmInputError where it is zero."""

    unit: ClassVar[str] = "N"

    def slopes(self, film: SolvedFilm) -> OutputSlopes:
        """As `Output`."""
        stress = point_fields(film.solution).shear_moving
        x, y = (float(np.sum(part * film.space.area * film.weight)) for part in stress)
        size = float(np.hypot(x, y))
        if size == 0.0:
            raise FilmInputError("friction", "no force on the moving wall", "friction_torque, or a wall that slides")
        return shear_slopes(film, (np.full((1, 1), x / size), np.full((1, 1), y / size)), on_moving=True)


@dataclass(frozen=True)
class FrictionTorqueOutput:
    """Torque of oil and contact on a wall, N m: about the origin, or of a film whose x runs around a cylinder about its
    axis, the force along x times the radius (m)."""

    wall: Wall = Wall.MOVING
    radius: float | None = None
    unit: ClassVar[str] = "N m"

    def slopes(self, film: SolvedFilm) -> OutputSlopes:
        """As `Output`."""
        if self.radius is not None:
            turning = np.full((1, 1), self.radius), np.zeros((1, 1))
            return shear_slopes(film, turning, on_moving=self.wall is Wall.MOVING)
        x, y, _ = film.space.points_in_space
        return shear_slopes(film, (-y, x), on_moving=self.wall is Wall.MOVING)


@dataclass(frozen=True)
class DissipationOutput:
    """Heat of the film, W, contact included."""

    unit: ClassVar[str] = "W"

    def slopes(self, film: SolvedFilm) -> OutputSlopes:
        """As `Output`."""
        return heat_slopes(film)


def output_names(problem: FilmProblem, *, around_cylinder: bool = False) -> dict[str, Output]:
    """The outputs of a film by name.

    load; contact_load of asperities; moment_x, moment_y; bearing_load in place of load and moments where the film's x
    runs once around a cylinder; flow.NAME of each boundary with a condition; friction, the
    magnitude of the force on the moving wall, friction_x, friction_y, friction_torque (around a cylinder about its
    axis), and friction_fixed_x, friction_fixed_y, friction_fixed_torque of the fixed wall; dissipation.
    """
    radius = radius_around(problem.space) if around_cylinder else None
    names: dict[str, Output] = {"bearing_load": BearingLoadOutput()} if around_cylinder else {"load": LoadOutput()}
    if problem.asperities is not None:
        names["contact_load"] = ContactLoadOutput()
    if not around_cylinder:
        names |= {f"moment_{axis.value}": MomentOutput(axis) for axis in Axis}
    names |= {f"flow.{name}": FlowOutput(name) for name in problem.boundary}
    names["friction"] = FrictionForceOutput()
    for wall, stem in ((Wall.MOVING, "friction"), (Wall.FIXED, "friction_fixed")):
        names |= {f"{stem}_{axis.value}": FrictionOutput(axis, wall) for axis in Axis}
        names[f"{stem}_torque"] = FrictionTorqueOutput(wall, radius)
    return names | {"dissipation": DissipationOutput()}
