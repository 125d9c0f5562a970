"""A film in time: implicit Euler steps of what it holds, from a state that its case gives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.film import FilmSolution, Storage
from reynolds.loads import Loads, loads
from reynolds.solve import FilmSolver
from reynolds.transport import lumped
from swashfilm.film_problem import film_problem

if TYPE_CHECKING:
    from swashfilm.film_statement import FilmStatement

StepReport = Callable[[int, int, str], None]


@dataclass(frozen=True)
class Instant:
    """The film at a time (s): its solution, kept only where it is written, and its integrals."""

    time: float
    solution: FilmSolution | None
    loads: Loads


def transient(stated: FilmStatement, report: StepReport) -> list[Instant]:
    """Every step of a transient, in time; the last one has its solution.

    Each step meets d(oil held)/dt + outflow = 0 with the film and the boundaries at its end (implicit Euler, first
    order in the step). At the start the film holds film.initial_film_fraction of its thickness. Raises
    FilmNotConverged with the time that was reached, FilmInputError where a field has no possible value.
    """
    assert stated.time is not None
    problem = film_problem(stated)
    space, walls = problem.space, problem.walls
    full = problem.film.thickness * stated.initial_film_fraction.sample(space)
    before = lumped(space, np.broadcast_to(full, space.area.shape).copy())
    solver, solution, found = FilmSolver(space), None, []
    begin, steps = 0.0, stated.time.steps
    for number, end in enumerate(stated.time.times, start=1):
        try:
            now = replace(film_problem(replace(stated, elastic=None), space, float(end)), walls=walls)
            solution = solver.solve(replace(now, storage=Storage(before, float(end) - begin)), solution)
        except FilmNotConverged as reason:
            raise FilmNotConverged(
                f"at t = {end:.6g} s: {reason.what}", f"a smaller step; {reason.remedy}"
            ) from None
        except FilmInputError as reason:
            raise FilmInputError(f"at t = {end:.6g} s, {reason.where}", reason.found, reason.expected) from None
        before, begin = solution.holds, float(end)
        kept = solution if stated.time.is_output(number) else None
        found.append(Instant(float(end), kept, loads(solution)))
        report(number, steps, f"t = {end:.4g} s")
    return found
