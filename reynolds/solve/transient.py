"""A film in time: implicit Euler on the oil that each unknown holds, theta r h as one quantity.

Mass is conserved to round-off in a step of any size; the accuracy in time is of first order.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Generic, Protocol, TypeVar

import numpy as np

from reynolds.equation.balance import FilmState, density, operators
from reynolds.equation.deformation import deformation
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.numerics.arrays import Array
from reynolds.problem import ZERO, FilmProblem, FilmSolution, Storage
from reynolds.solve.boundary import spread
from reynolds.solve.solver import FilmSolver
from reynolds.solve.warm_start import from_last_or_anew

MOST_HALVINGS = 12  # of a step on which the cavity does not converge


class Holding(Protocol):
    """A solution of any kind with the oil of its unknowns, as a march requires."""

    @property
    def holds(self) -> Array:
        """Oil of each unknown, m3 at reference density, (size,)."""


Solved = TypeVar("Solved", bound=Holding)

Step = Callable[[FilmProblem, Solved | None], Solved]
"""(film with its storage, solution one step before or None) -> solution."""


@dataclass(frozen=True)
class FilmInstant(Generic[Solved]):
    """The film at the end of a step: time s, step s, and its solution (its `storage` has the oil before)."""

    time: float
    step: float
    solution: Solved


def march(
    solver: FilmSolver,
    problem_at: Callable[[float], FilmProblem],
    end: float,
    step: float,
    *,
    start: float = 0.0,
    held: Array | None = None,
) -> Iterator[FilmInstant[FilmSolution]]:
    """The film after each of equal steps of at most `step` (s) up to end (s), one at a time: as `march_with`."""

    def solve(problem: FilmProblem, last: FilmSolution | None) -> FilmSolution:
        return from_last_or_anew(lambda warm: solver.solve(problem, start=warm), last)

    return march_with(solve, problem_at, end, step, start=start, held=held)


def march_with(
    solve: Step[Solved],
    problem_at: Callable[[float], FilmProblem],
    end: float,
    step: float,
    *,
    start: float = 0.0,
    held: Array | None = None,
) -> Iterator[FilmInstant[Solved]]:
    """The film after each of equal steps of at most `step` (s) up to end (s), one at a time, each solved by `solve`.

    Solves d(theta r h)/dt + div q = 0 with `problem_at(t)` the film at time t, without storage: its thickness,
    wall speeds and boundary pressures; its squeeze is not used. `held` (size,) m3 is the unknowns' oil at
    `start`; None: a full film at its lowest pressure. A step without convergence is cut in two, each half yielded.
    Raises FilmInputError for an end before the start, a step not above zero and a mesh that moves, since its
    motion would move oil too; FilmNotConverged where no step is short enough.
    """
    if not (np.isfinite(end) and end > start):
        raise FilmInputError("time, end", f"{end:g} s", f"after the start, {start:g} s")
    if not (np.isfinite(step) and step > 0.0):
        raise FilmInputError("time, step", f"{step:g} s", "above zero")
    count = equal_steps(end - start, step)
    first = problem_at(start)
    before = oil_held(first) if held is None else held
    last: Solved | None = None

    def still(time: float) -> FilmProblem:
        problem = problem_at(time)
        if not np.array_equal(problem.space.vertices, first.space.vertices):
            raise FilmInputError(f"mesh at {time:g} s", "vertices that have moved", "those of the start")
        return replace(problem, film=replace(problem.film, squeeze=ZERO))

    for number in range(count):
        begin, until = (start + (end - start) * k / count for k in (number, number + 1))
        for instant in _stepped(solve, still, before, last, begin, until):
            before, last = instant.solution.holds, instant.solution
            yield instant


def equal_steps(duration: float, longest: float) -> int:
    """Number of equal steps over a duration (s), none of them longer than the longest (s) but for round-off."""
    return max(1, int(np.ceil(duration / longest * (1.0 - 1e-9))))


def oil_held(problem: FilmProblem, film_fraction: float | Array = 1.0, pressure: Array | None = None) -> Array:
    """Oil of each unknown of a film at given film fractions (size,), m3 at reference density, (size,).

    pressure (size,) Pa where no boundary holds it, under which oil is denser and elastic walls open; None: the lowest.
    """
    setting = spread(problem)
    if pressure is not None and pressure.shape != (problem.space.size,):
        raise FilmInputError("pressure", f"an array of shape {pressure.shape}", f"({problem.space.size},)")
    held = setting.pressure if pressure is None else np.where(setting.held, setting.pressure, pressure)
    fraction = np.asarray(film_fraction, dtype=float)
    if fraction.shape not in ((), (problem.space.size,)):
        raise FilmInputError("film fraction", f"an array of shape {fraction.shape}", f"({problem.space.size},)")
    fraction = np.broadcast_to(fraction, (problem.space.size,))
    if not np.all((fraction >= 0.0) & (fraction <= 1.0)):
        raise FilmInputError("film fraction", f"{fraction.min():g} .. {fraction.max():g}", "0 to 1")
    state = FilmState(held, fraction, deformation(problem, held))
    return operators(problem, state).content * fraction * density(problem, held)[0]


def _stepped(
    solve: Step[Solved],
    problem_at: Callable[[float], FilmProblem],
    before: Array,
    last: Solved | None,
    begin: float,
    until: float,
) -> Iterator[FilmInstant[Solved]]:
    """One step, or shorter ones."""
    at, step, halvings = begin, until - begin, 0
    while at < until - 1e-9 * (until - begin):
        problem = replace(problem_at(at + step), storage=Storage(before, step))
        try:
            solution = solve(problem, last)
        except FilmNotConverged as reason:
            halvings += 1
            if halvings > MOST_HALVINGS:
                raise FilmNotConverged(f"at {at:.6g} s, step {step:.2g} s: {reason.what}", reason.remedy) from None
            step *= 0.5
            continue
        at += step
        before, last = solution.holds, solution
        yield FilmInstant(at, step, solution)
