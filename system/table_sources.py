"""Where the points of a response table come from: a fidelity that solves the films, by one call."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

import numpy as np

from system.description import PumpDescription
from system.films import POSITIONS_PER_PITCH, TOLERANCE, films_point
from system.line_description import LineSection
from system.operating import OperatingPoint
from system.power import Gaps
from system.table_means import SolvedPoint


class Source(Enum):
    """The fidelity that a table condenses."""

    FILMS = "films"


class PointSolver(Protocol):
    """Solves one operating point: frozen data that can be sent to another process.

    `stated`: physics, mesh and accuracy in words and numbers, all that its result depends on beside pump and
    point.
    """

    @property
    def source(self) -> Source:
        """The fidelity behind it."""
        ...

    @property
    def stated(self) -> Mapping[str, str]:
        """What its numbers rest on."""
        ...

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point solved; raises NotConverged or FilmNotConverged."""
        ...


@dataclass(frozen=True)
class FilmsSolver:
    """`films_point`: rigid isothermal films at positions of quasi-static balance, or given where none is."""

    positions_per_pitch: int = POSITIONS_PER_PITCH
    source = Source.FILMS

    @property
    def stated(self) -> Mapping[str, str]:
        """What its numbers rest on."""
        return {
            "physics": "rigid, isothermal, mass-conserving cavitation, quasi-static; Coulomb coefficients given",
            "mesh": f"meshes of the films fidelity, {self.positions_per_pitch} film angles a piston pitch",
            "accuracy": f"chamber pressure repeats to {TOLERANCE:g} of the pressure difference",
        }

    def solve(self, pump: PumpDescription, point: OperatingPoint) -> SolvedPoint:
        """The point by `films_point`."""
        found = films_point(pump, point, positions_per_pitch=self.positions_per_pitch)
        series = (found.gaps.piston, found.gaps.slipper, tuple(film.gap for film in found.gaps.valve_plate))
        mean = (float(np.mean([film.film_thickness_mean for film in films])) for films in series)
        least = (min(film.loads.film_thickness_min for film in films) for films in series)
        return SolvedPoint(found.pump_point, Gaps(*mean), Gaps(*least))


def with_held_ports(pump: PumpDescription) -> PumpDescription:
    """The pump without its lines: points of a table are solved at held port pressures."""
    return pump.model_copy(update={"delivery_line": LineSection(), "suction_line": LineSection()})


SOLVERS: Mapping[Source, PointSolver] = {Source.FILMS: FilmsSolver()}
"""How each source solves a point where nothing else is said."""
