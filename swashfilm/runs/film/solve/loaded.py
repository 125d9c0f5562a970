"""A film that is asked to bear a load: from what a case states to the core's search for its position."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from reynolds.errors import FilmNotConverged
from reynolds.floating.load_search import LoadedFilm, carry_load
from reynolds.problem import FilmProblem, FilmSolution
from swashfilm.runs.film.solve.oil import Found, OilSolver, film_of, oil_solver

if TYPE_CHECKING:
    from swashfilm.case.statement import FilmStatement


@dataclass
class _Warmed:
    """Films with what their oil does, each warming the next; `last` is the one solved last."""

    solver: OilSolver
    last: Found | None = None

    def __call__(self, problem: FilmProblem) -> FilmSolution:
        try:
            self.last = self.solver.solve(problem, self.last)
        except FilmNotConverged:  # from nothing it may be nearer
            self.last = self.solver.solve(problem)
        return film_of(self.last)


def solve_carried(stated: FilmStatement, problem: FilmProblem) -> tuple[LoadedFilm, Found]:
    """The position at which the film bears what the case asks, and the film there.

    Raises FilmNotConverged, with what was borne at best, where there is no such position.
    """
    assert stated.load is not None
    solve = _Warmed(oil_solver(stated, problem.space))
    carried = carry_load(problem, stated.load, solve)
    assert solve.last is not None
    return carried, solve.last


def carried_summary(found: LoadedFilm) -> dict[str, Any]:
    """Where the film stands: separation m, slopes (m/m), what it bears with the contact, N."""
    position = found.position
    return {
        "separation_m": position.separation,
        "slope_x_rad": position.slope_x,
        "slope_y_rad": position.slope_y,
        "carried_load_N": found.force,
        "load_rest": found.rest,
        "films_solved": found.films,
    }
