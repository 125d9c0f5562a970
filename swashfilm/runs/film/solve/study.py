"""One film study: a case solved, its summary, its warnings and its fields."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reynolds.floating.load_search import LoadedFilm
from reynolds.problem import FilmSolution
from reynolds.solve.loads import Loads, loads
from reynolds.thermal.energy import FilmTemperature
from swashfilm.case.file import FilmCase
from swashfilm.case.gap.instant import GapCase
from swashfilm.runs.film.solve.gap import GapStudy, solve_gap
from swashfilm.runs.film.solve.loaded import solve_carried
from swashfilm.runs.film.solve.oil import film_of, heat_of, oil_solver
from swashfilm.runs.film.solve.transient import Moment, transient
from system.work.progress import Report, silent

if TYPE_CHECKING:
    pass


@dataclass(frozen=True)
class FilmStudy:
    """A solved case: its solution and integrals, and the seconds it took; None what the case has not.

    gap: the pump's gap that it is of; heat: its temperature; history: the steps of a transient, whose end
    `solution` is; carried: the position at which it bears a load.
    """

    name: str
    solution: FilmSolution
    loads: Loads
    gap: GapStudy | None
    solve_seconds: float
    heat: FilmTemperature | None = None
    history: tuple[Moment, ...] = ()
    carried: LoadedFilm | None = None


def solve_case(case: FilmCase | GapCase, report: Report = silent) -> FilmStudy:
    """Solve a case; raises FilmNotConverged rather than give a number that is none.

    `report` hears of the steps of a transient.
    """
    began = time.perf_counter()
    if isinstance(case, GapCase):
        gap = solve_gap(case)
        return FilmStudy(case.name, gap.film.solution, gap.film.loads, gap, time.perf_counter() - began)
    heat: FilmTemperature | None = None
    history: tuple[Moment, ...] = ()
    carried: LoadedFilm | None = None
    if case.stated.time:
        history = tuple(transient(case.stated, report))
        last = history[-1].solution
        assert last is not None
        solution, heat = last, history[-1].heat
    elif case.stated.load:
        carried, found = solve_carried(case.stated, case.problem)
        solution, heat = film_of(found), heat_of(found)
    else:
        found = oil_solver(case.stated, case.problem.space).solve(case.problem)
        solution, heat = film_of(found), heat_of(found)
    seconds = time.perf_counter() - began
    return FilmStudy(case.name, solution, loads(solution), None, seconds, heat, history, carried)
