"""Film under a given load: search for the position at which it supports the load of a case."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from reynolds.problem import FilmProblem, FilmSolution
from reynolds.solve.load_search import LoadedFilm, carry_load
from reynolds.solve.warm_start import from_last_or_anew
from swashfilm.runs.film.solve.oil import Found, OilSolver, film_of, oil_solver

if TYPE_CHECKING:
    from swashfilm.case.statement import FilmStatement


@dataclass
class _Warmed:
    """Solver of films with their oil, each started from the one before; `last` is the latest solution."""

    solver: OilSolver
    last: Found | None = None

    def __call__(self, problem: FilmProblem) -> FilmSolution:
        self.last = from_last_or_anew(partial(self.solver.solve, problem), self.last)
        return film_of(self.last)


def solve_loaded(stated: FilmStatement, problem: FilmProblem) -> tuple[LoadedFilm, Found]:
    """Return the position at which the film supports the load of the case, and the film there.

    Raises FilmNotConverged, with the largest supported load, where there is no such position.
    """
    load = stated.film.rigid_load
    assert load is not None
    solve = _Warmed(oil_solver(stated, problem.space))
    loaded = carry_load(problem, load, solve)
    assert solve.last is not None
    return loaded, solve.last


def load_summary(found: LoadedFilm) -> dict[str, Any]:
    """Return position (separation m, slopes m/m) and supported load with contact, N."""
    position = found.position
    return {
        "separation_m": position.separation,
        "slope_x_rad": position.slope_x,
        "slope_y_rad": position.slope_y,
        "carried_load_N": found.force,
        "load_rest": found.rest,
        "films_solved": found.films,
    }
