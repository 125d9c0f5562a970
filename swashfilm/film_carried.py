"""A film that is asked to bear a load: from what a case states to the core's search for its position."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from reynolds.carried_load import Carried, carry
from reynolds.energy import FilmTemperature
from reynolds.film import FilmProblem, FilmSolution
from swashfilm.film_thermal import solve_with_temperature

if TYPE_CHECKING:
    from reynolds.thermal import ThermalSolution
    from swashfilm.film_statement import FilmStatement


@dataclass
class _WithTemperature:
    """Films with their temperatures, each warming the next."""

    stated: FilmStatement
    last: ThermalSolution | None = None

    def __call__(self, problem: FilmProblem) -> FilmSolution:
        self.last = solve_with_temperature(self.stated, problem, self.last)
        return self.last.film


def solve_carried(stated: FilmStatement, problem: FilmProblem) -> tuple[Carried, FilmTemperature | None]:
    """The film at the position at which it bears what the case asks, and its temperature where it has one.

    Raises FilmNotConverged, with what was borne at best, where there is no such position.
    """
    assert stated.load is not None
    if stated.thermal is None:
        return carry(problem, stated.load), None
    solve = _WithTemperature(stated)
    found = carry(problem, stated.load, solve)
    assert solve.last is not None
    return found, solve.last.heat


def carried_summary(found: Carried) -> dict[str, Any]:
    """Where the film stands: separation m, slopes (m/m), what it bears with the contact, N and N m."""
    position = found.position
    return {
        "separation_m": position.separation,
        "slope_x_rad": position.slope_x,
        "slope_y_rad": position.slope_y,
        "carried_load_N": found.force,
        "load_rest": found.rest,
        "films_solved": found.films,
    }
