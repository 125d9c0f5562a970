"""Warnings of a film whose flow is not laminar, or whose inertia Reynolds' equation leaves out."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.loads import point_fields
from swashfilm.runs.film.checks.extent import Warned

DENSITY = 870.0  # kg/m3, of mineral oils
LARGEST_REYNOLDS = 1000.0
"""Of rho V h/mu: turbulence begins at some 1100 between plates at rest, at 1440 between sliding ones (Tillmark and
Alfredsson 1992), Taylor's (1923) vortices in a journal bearing at 41 (R/c)^(1/2), or 1300 at R/c = 1000."""
LEAST_SHARE = 0.01  # of the film's area, less is a corner about which pressure falls steeply
LARGEST_INERTIA = 1.0
"""Of rho V h^2/(mu L), about ten times the share by which inertia changes the pressure of a pad."""


def regime_warnings(solution: FilmSolution) -> Iterator[Warned]:
    """Yield warnings, name and text, by Reynolds numbers of the film with the density of a mineral oil."""
    area, film = solution.problem.space.area, solution.film
    found = _reynolds(solution)
    total = float(area.sum())
    if (share := float(area[found > LARGEST_REYNOLDS].sum()) / total) > LEAST_SHARE:
        yield (
            "film_turbulent",
            f"the Reynolds number rho V h/mu (oil of {DENSITY:g} kg/m3) is up to {found.max():.4g}, above "
            f"{LARGEST_REYNOLDS:g} on {share:.0%} of the film: its flow is turbulent, which raises friction and lowers "
            "leakage; Reynolds' equation holds for laminar films: check the units of film thickness and viscosity",
        )
    inertia = float(np.sum(found * film.thickness * area)) / total**1.5
    if inertia > LARGEST_INERTIA:
        yield (
            "film_has_inertia",
            f"the reduced Reynolds number rho V h^2/(mu L) (oil of {DENSITY:g} kg/m3) is {inertia:.3g} in the mean "
            f"(limit {LARGEST_INERTIA:g}, where inertia changes pressures by some 10%): the film equation leaves out "
            "inertia; check the units of film thickness and viscosity",
        )


def _reynolds(solution: FilmSolution) -> Array:
    """Return rho V h/mu (cells, points), V the larger of the walls' sliding and the mean speed by pressure."""
    film, fields = solution.film, point_fields(solution)
    (u1, v1), (u2, v2) = film.velocity_moving, film.velocity_fixed
    driven = film.thickness**2 / (12.0 * film.viscosity) * np.hypot(*fields.gradient)
    speed = np.minimum(fields.filled, 1.0) * np.maximum(np.hypot(u1 - u2, v1 - v2), driven)
    return np.asarray(DENSITY * speed * film.thickness / film.viscosity)
