"""Sources of the points of a response table: a fidelity that solves the films, by one call."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Any, Protocol

import numpy as np

from gaps.revolution.course import GapInstant
from gaps.revolution.march import GapRevolution
from gaps.standing.gap_film import GapFilm
from reynolds.errors import NotConverged
from reynolds.laws.oil import temperature_of
from system.description.lines import LineSection
from system.description.pump import PumpDescription
from system.inputs.units import RPM
from system.points.film_effects import film_laws
from system.points.films import POSITIONS_PER_PITCH, TOLERANCE, films_point
from system.points.floating import PRESSURE_TOLERANCE, FloatingPoint, floating_point
from system.points.floating_gaps import FloatingOptions
from system.points.table.means import SolvedPoint
from system.pump.assembly import PointWarning, Remark
from system.pump.chamber.turn import Gaps
from system.pump.operating import OperatingPoint


class Source(Enum):
    """The fidelity that a table condenses, the finer one later."""

    FIXED = "fixed"
    FLOATING = "floating"


LEFT_OUT, NOTHING = "left out: ", "nothing"
"""Words before the film physics that a source leaves out, and that it leaves out none."""


def left_out(stated: Mapping[str, str]) -> tuple[str, ...]:
    """The film physics that the points of a solver leave out on request, of its `stated`."""
    names = stated.get("physics", "").partition(LEFT_OUT)[2]
    return () if names in ("", NOTHING) else tuple(names.split(", "))


def fidelity_words(source: Source, stated: Mapping[str, str]) -> str:
    """The fidelity of a solver's points, with the film physics that they leave out."""
    without = left_out(stated)
    return source.value + (f" without {', '.join(without)}" if without else "")


class PointSolver(Protocol):
    """Solver of one operating point: frozen data that can be sent to another process.

    `stated`: physics, mesh and accuracy in words and numbers, all inputs of its result besides pump and point.
    """

    @property
    def source(self) -> Source:
        """The fidelity behind it."""

    @property
    def stated(self) -> Mapping[str, str]:
        """Inputs of its numbers."""

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point solved; raises NotConverged or FilmNotConverged."""

    def row(self) -> PointSolver:
        """The solver of points of one pump that follow each other: a later one may start from the one before."""


@dataclass(frozen=True)
class FilmsSolver:
    """`films_point`: rigid isothermal films at the positions that the description gives."""

    positions_per_pitch: int = POSITIONS_PER_PITCH
    source = Source.FIXED

    @property
    def stated(self) -> Mapping[str, str]:
        """Inputs of its numbers."""
        return {
            "physics": "rigid, isothermal, mass-conserving cavitation; positions and Coulomb coefficients given",
            "mesh": f"meshes of the fidelity fixed, {self.positions_per_pitch} film angles a piston pitch",
            "accuracy": f"chamber pressure repeats to {TOLERANCE:g} of the pressure difference",
        }

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point by `films_point`."""
        found = films_point(pump, point, positions_per_pitch=self.positions_per_pitch)
        series, physics = (found.gaps.piston, found.gaps.slipper, found.gaps.valve_plate), found.physics
        mean = (float(np.mean([film.film_thickness_mean for film in films])) for films in series)
        least = (min(film.loads.film_thickness_min for film in films) for films in series)
        rise = (
            _oil_temperature(pump, films) - point.temperature if own.heat else 0.0
            for own, films in zip((physics.piston, physics.slipper, physics.valve_plate), series, strict=True)
        )
        carried = (_carried(films) for films in series)
        return SolvedPoint(found.pump_point, Gaps(*mean), Gaps(*least), Gaps(*rise), Gaps(*carried))

    def row(self) -> FilmsSolver:
        """The same: given positions need no start."""
        return self


@dataclass(frozen=True)
class FloatingSolver:
    """`floating_point`: films from the balance of forces, coupled with the chambers."""

    options: FloatingOptions = field(default_factory=FloatingOptions)
    source = Source.FLOATING

    @property
    def stated(self) -> Mapping[str, str]:
        """Inputs of its numbers."""
        options = self.options
        cells = (options.piston_cells, options.slipper_cells, options.block_cells)
        exact = options.accuracy
        return {
            "physics": f"gaps float; {LEFT_OUT}{', '.join(options.physics.left_out_words) or NOTHING}",
            "mesh": f"cells of piston, slipper, block {', '.join(f'{x} x {y}' for x, y in cells)}",
            "accuracy": f"{options.steps} angles a turn; a step errs by {exact.step:g} of the least film and "
            f"{exact.floor:g} m at most, a turn closes to {exact.closed:g} of the mean film; chamber pressure "
            f"repeats to {PRESSURE_TOLERANCE:g} of the ports' difference",
        }

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point by `floating_point`; least film: of the mean planes, below 0 where rough walls overlap."""
        return solved_means(floating_point(pump, point, self.options))

    def row(self) -> FloatingRow:
        """A solver whose points start from the motion, the temperatures and the spins of the one before."""
        return FloatingRow(self)


@dataclass
class FloatingRow:
    """`floating_point` at points of one pump that follow each other; the last one solved is the next one's start."""

    solver: FloatingSolver
    last: FloatingPoint | None = None
    source = Source.FLOATING

    @property
    def stated(self) -> Mapping[str, str]:
        """Inputs of its numbers: a start changes them by less than the accuracy."""
        return self.solver.stated

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """As `FloatingSolver.solve`, by `floating`."""
        return solved_means(self.floating(pump, point))

    def floating(self, pump: PumpDescription, point: OperatingPoint) -> FloatingPoint:
        """The point itself; without a start, and with a warning, where the start from the neighbour's motion fails."""
        near, self.last = self.last, None
        try:
            self.last = floating_point(pump, point, self.solver.options, near=near)
        except NotConverged as reason:
            if near is None:
                raise
            self.last = _refused(near, reason, floating_point(pump, point, self.solver.options))
        return self.last

    def row(self) -> FloatingRow:
        """A solver of its own."""
        return FloatingRow(self.solver)


def _refused(near: FloatingPoint, reason: NotConverged, found: FloatingPoint) -> FloatingPoint:
    """A point that was solved without the start from `near`, with a warning."""
    at = near.pump_point.point
    text = (
        f"the films of the point before, {at.delivery_pressure / 1e6:.3g} MPa, {at.shaft_speed / RPM:.0f} r/min and "
        f"{at.displacement_ratio:.0%} stroke, led to no motion here ({reason}): solved from films of its own, which "
        "takes longer; points nearer to each other save the time"
    )
    told = replace(found.pump_point, warnings=(*found.pump_point.warnings, Remark(PointWarning.START_REFUSED, text)))
    return replace(found, pump_point=told)


def solved_means(found: FloatingPoint) -> SolvedPoint:
    """Means of a floating point for a table; least film: of the mean planes, below 0 where rough walls overlap."""
    own, point = found.kinds[0].gaps, found.pump_point.point
    gaps: tuple[GapRevolution[Any], ...] = (own.piston, own.slipper, own.block)
    mean = (gap.mean_film for gap in gaps)
    least = (min(instant.least_gap for instant in gap.turn.instants) for gap in gaps)
    rise = (_hottest(gap, point) - point.temperature for gap in gaps)
    carried = (_by_film(gap.turn.instants) for gap in gaps)
    return SolvedPoint(found.pump_point, Gaps(*mean), Gaps(*least), Gaps(*rise), Gaps(*carried))


def _carried(films: Sequence[GapFilm[Any]]) -> float:
    """One less the largest load that a film does not support, of the largest load of the turn."""
    left = max(film.required_load - film.carried_load for film in films)
    return 1.0 - left / max(film.required_load for film in films)


def _by_film(instants: Sequence[GapInstant[Any]]) -> float:
    """One less the largest contact force, of the largest force that presses the part against film and contact."""
    contact = max(float(np.sum(np.abs(one.contact_force))) for one in instants)
    return 1.0 - contact / max(float(np.sum(np.abs(one.outer_force))) for one in instants)


def _oil_temperature(pump: PumpDescription, films: Sequence[GapFilm[Any]]) -> float:
    """Temperature (K) of the thinnest oil of a gap over the turn, by its viscosity at zero pressure."""
    thinnest = min(float(np.min(film.solution.problem.film.viscosity)) for film in films)
    return temperature_of(pump.oil.fluid, thinnest)


def _hottest(gap: GapRevolution[Any], point: OperatingPoint) -> float:
    """Temperature (K) of the hottest oil of a gap over the turn; that of the case for films without heat."""
    return point.temperature if gap.warmth is None else float(gap.warmth.hottest.max())


def solver_of(source: Source, options: FloatingOptions) -> PointSolver:
    """The solver of the points of a source; `options` are those of floating gaps."""
    return FilmsSolver() if source is Source.FIXED else FloatingSolver(options)


def films_alone(pump: PumpDescription) -> PumpDescription:
    """The pump of a table's points: at held port pressures, without effects of [physics] that act by their laws."""
    return replace(film_laws(pump), delivery_line=LineSection(), suction_line=LineSection())
