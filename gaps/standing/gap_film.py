"""What a gap reports of an instant at which its part stands still: film, flows, friction, load borne."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gaps.revolution.reports import Active
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.loads import Loads

LOAD_TOLERANCE = 1e-3
"""Of the required load: what a film at a given position may miss of it and still count as holding it."""


@dataclass(frozen=True)
class GapFilm:
    """One gap at one instant, SI; the part neither approaches nor tilts.

    position (k,) m, as the gap's film counts it; chamber_flow m3/s out of the chamber into the gap, leakage_flow
    m3/s out of the gap into the case; friction_power W drawn from the moving parts; required_load N and
    carried_load N: what presses the parts together and what the film with its pockets and contact holds, both in
    the load's direction; contact_load N, int of the asperities' pressure; active: as
    `gaps.revolution.reports.GapSeen` has it.
    """

    solution: FilmSolution
    loads: Loads
    position: Array
    chamber_flow: float
    leakage_flow: float
    friction_power: float
    required_load: float
    carried_load: float
    contact_load: float
    active: tuple[Active, ...]

    @property
    def carried_fraction(self) -> float:
        """Share of the required load that the film carries; 1 where nothing is required."""
        return self.carried_load / self.required_load if self.required_load > 0.0 else 1.0

    @property
    def holds_its_load(self) -> bool:
        """Whether film and load balance to LOAD_TOLERANCE."""
        return abs(self.carried_fraction - 1.0) < LOAD_TOLERANCE

    @property
    def film_thickness_mean(self) -> float:
        """Area mean of the film thickness (m)."""
        area = self.solution.problem.space.area
        return float(np.sum(self.solution.film.thickness * area) / np.sum(area))


@dataclass(frozen=True)
class ValvePlateFilm:
    """The ring's film with what chambers (z,) and ports give into it, m3/s."""

    gap: GapFilm
    chamber_flows: Array
    suction_flow: float
    delivery_flow: float
