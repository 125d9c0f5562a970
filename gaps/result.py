"""What a gap reports: its film, where its position came from, and what it carries, leaks and rubs."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from reynolds.film import FilmSolution
from reynolds.loads import Loads, point_fields
from reynolds.mesh import Array

# Three times the composite roughness of ground and lapped pump parts (about 0.5 um): below a lambda ratio of 3 the
# film is mixed and a smooth-wall Reynolds solution no longer valid, so no balance is claimed with less.
SMALLEST_FILM = 1.5e-6
LOAD_TOLERANCE = 1e-3
"""Of the required load: what a film at a given position may miss of it and still count as holding it."""


class PositionSource(Enum):
    """Where the film's position comes from."""

    BALANCE = "balance"
    GIVEN = "given"


@dataclass(frozen=True)
class GapFilm:
    """One gap at one instant, SI.

    chamber_flow m3/s out of the chamber into the gap, leakage_flow m3/s out of the gap into the case,
    conductance = d chamber_flow / d chamber pressure of the pressure flow (m3/(s Pa)); friction_power W drawn
    from the moving parts by shear (walls' force times velocity); required_load N and carried_load N: what
    presses the parts together and what the film (with its pockets) holds, both in the load's direction.
    `verdict` says in words why a balance was not found.
    """

    solution: FilmSolution
    loads: Loads
    source: PositionSource
    position: Array
    chamber_flow: float
    leakage_flow: float
    conductance: float
    friction_power: float
    required_load: float
    carried_load: float
    verdict: str

    @property
    def carried_fraction(self) -> float:
        """Share of the required load that the film carries; 1 where nothing is required."""
        return self.carried_load / self.required_load if self.required_load > 0.0 else 1.0

    @property
    def holds_its_load(self) -> bool:
        """Whether film and load balance: as found, or at a given position by chance, to LOAD_TOLERANCE."""
        return self.source is PositionSource.BALANCE or abs(self.carried_fraction - 1.0) < LOAD_TOLERANCE

    @property
    def film_thickness_mean(self) -> float:
        """Area mean of the film thickness (m)."""
        area = self.solution.problem.space.area
        return float(np.sum(self.solution.film.thickness * area) / np.sum(area))


def wall_power(solution: FilmSolution, weight: Array | None = None) -> float:
    """Power (W) that the walls spend on shearing the film: -(integral of wall stress times wall velocity).

    `weight` leaves regions out that are no film, as in `reynolds.loads.loads`.
    """
    film = solution.film
    fields = point_fields(solution)
    area = solution.problem.space.area if weight is None else solution.problem.space.area * weight
    stresses = (*fields.shear_moving, *fields.shear_fixed)
    velocities = (*film.velocity_moving, *film.velocity_fixed)
    return -float(sum(np.sum(t * u * area) for t, u in zip(stresses, velocities, strict=True)))
