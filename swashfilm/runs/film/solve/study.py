"""Solution of a film case."""

from __future__ import annotations

import time
from dataclasses import dataclass

from reynolds.problem import FilmSolution
from reynolds.solve.load_search import LoadedFilm
from reynolds.solve.loads import Loads, loads
from reynolds.thermal.energy import FilmTemperature
from swashfilm.case.file import FilmCase
from swashfilm.case.gap.instant import GapCase
from swashfilm.case.tables.film import Geometry
from swashfilm.runs.film.solve.gap import GapStudy, solve_gap
from swashfilm.runs.film.solve.loaded import solve_loaded
from swashfilm.runs.film.solve.oil import film_of, heat_of, oil_solver
from swashfilm.runs.film.solve.sensitivity import Sensitivities
from swashfilm.runs.film.solve.transient import Moment, transient
from system.work.progress import Report, silent


@dataclass(frozen=True)
class FilmStudy:
    """A solved case: solution, integrals and computing time (s); None for parts that the case does not have.

    gap: gap of a pump; heat: temperature; history: steps of a transient, with `solution` at its end; loaded:
    position at which the film supports its load; sensitivity: derivatives by the film thickness; geometry: of both
    faces.
    """

    name: str
    solution: FilmSolution
    loads: Loads
    gap: GapStudy | None
    solve_seconds: float
    heat: FilmTemperature | None = None
    history: tuple[Moment, ...] = ()
    loaded: LoadedFilm | None = None
    sensitivity: Sensitivities | None = None
    geometry: Geometry = Geometry.PLANE


def solve_case(case: FilmCase | GapCase, report: Report = silent) -> FilmStudy:
    """Solve a case; raise FilmNotConverged without a converged solution.

    `report` receives the steps of a transient.
    """
    began = time.perf_counter()
    if isinstance(case, GapCase):
        gap = solve_gap(case)
        seconds = time.perf_counter() - began
        return FilmStudy(case.name, gap.film.solution, gap.film.loads, gap, seconds, geometry=case.geometry)
    heat: FilmTemperature | None = None
    history: tuple[Moment, ...] = ()
    loaded: LoadedFilm | None = None
    if case.stated.time:
        history = tuple(transient(case.stated, report))
        last = history[-1].solution
        assert last is not None
        solution, heat = last, history[-1].heat
    elif case.stated.film.load:
        loaded, found = solve_loaded(case.stated, case.problem)
        solution, heat = film_of(found), heat_of(found)
    else:
        found = oil_solver(case.stated, case.problem.space).solve(case.problem)
        solution, heat = film_of(found), heat_of(found)
    seconds = time.perf_counter() - began
    return FilmStudy(case.name, solution, loads(solution), None, seconds, heat, history, loaded, geometry=case.geometry)
