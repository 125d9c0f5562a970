"""Film in time: implicit Euler steps of the oil held, from the initial state of the case."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from reynolds.errors import FilmNotConverged, InputError
from reynolds.problem import FilmProblem, FilmSolution
from reynolds.solve.bearing import BearingLoad, bearing_load
from reynolds.solve.loads import Loads, loads
from reynolds.solve.transient import oil_held
from reynolds.thermal.energy import FilmTemperature
from swashfilm.case.problem import film_problem
from swashfilm.case.tables.film import Geometry
from swashfilm.runs.film.solve.oil import film_of, heat_of, oil_solver
from swashfilm.runs.film.solve.torque import friction_torque
from system.work.progress import Report

if TYPE_CHECKING:
    from swashfilm.case.statement import FilmStatement


@dataclass(frozen=True)
class Moment:
    """The film at a time (s): its integrals; for a written film its solution and temperature.

    friction_torque: on the moving wall, N m; bearing: the load as a vector, of a film around a cylinder.
    """

    time: float
    solution: FilmSolution | None
    heat: FilmTemperature | None
    temperature_max: float | None
    loads: Loads
    friction_torque: float
    bearing: BearingLoad | None = None

    @property
    def supported(self) -> float:
        """Load on film and contact, N: around a cylinder the size of the vector."""
        return self.bearing.size if self.bearing else self.loads.load + self.loads.contact_load


def transient(stated: FilmStatement, report: Report) -> list[Moment]:
    """Return every step of a transient, in time; the last one has its solution.

    Each step satisfies d(oil held)/dt + outflow = 0 with the film and the boundaries at its end (implicit Euler,
    first order in the step). At the start the film holds film.initial_film_fraction of its thickness. A step that
    does not converge is divided. Raises FilmNotConverged with the time reached, and InputError where a field
    has no valid value or a law does not hold.
    """
    assert stated.time is not None
    assert stated.film.initial_film_fraction is not None
    first = film_problem(stated)
    space, rigid = first.space, replace(stated, elastic=None)
    now = 0.0

    def problem_at(t: float) -> FilmProblem:
        nonlocal now
        now = t
        return replace(film_problem(rigid, space, t), walls=first.walls)

    filled = space.to_unknowns(np.broadcast_to(stated.film.initial_film_fraction.sample(space), space.area.shape))
    found: list[Moment] = []
    try:
        held = oil_held(first, np.minimum(filled, 1.0))  # the mean of ones may exceed one by round-off
        for instant in oil_solver(stated, space).march(problem_at, stated.time.end, stated.time.step_taken, held):
            film, heat = film_of(instant.solution), heat_of(instant.solution)
            hottest = None if heat is None else float(heat.highest.max())
            is_kept = stated.time.is_output(instant.time, instant.step)
            geometry, integrals = stated.film.geometry, loads(film)
            bearing = bearing_load(film) if geometry is Geometry.CYLINDER else None
            torque = friction_torque(film, integrals, geometry)
            kept = film if is_kept else None
            found.append(Moment(instant.time, kept, heat if is_kept else None, hottest, integrals, torque, bearing))
            report(stated.time.number(instant.time), stated.time.steps, f"t = {instant.time:.4g} s")
    except FilmNotConverged as reason:
        raise FilmNotConverged(f"at t = {now:.6g} s: {reason.what}", f"a smaller step; {reason.remedy}") from None
    except InputError as reason:
        raise InputError(f"at t = {now:.6g} s, {reason.where}", reason.found, reason.expected) from None
    return found
