"""One implicit step of a floating film: the position at which its forces balance, by Newton's method."""

from dataclasses import dataclass, replace

import numpy as np

from reynolds.compiled.film import is_compiled
from reynolds.errors import FilmNotConverged, InputError, WallsOverlap
from reynolds.floating.coordinates import modes_on
from reynolds.floating.joint import JointSearch
from reynolds.floating.pose import lowest_gap, posed
from reynolds.floating.problem import Floating
from reynolds.floating.sensitivity import FilmSensitivity
from reynolds.floating.stage import EXACT, Closeness, FloatingStage
from reynolds.floating.trial import TOUCHING, FloatingInstant, StepStart, Trial, filled, instant_of, joined, solved
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.solver import FilmSolver
from reynolds.solve.transient import oil_held

TOLERANCE = 1e-8  # of the magnitudes that balance in a generalised force
GOOD_ENOUGH = 1e-6  # where no step comes nearer to balance: round-off of the film's pressures
LOOSE = 1e-5  # of the linear solves for a Newton step's slopes
SOFT_LOOSE = 1e-3  # the same between elastic walls, whose factors are costly
MOST_STEPS = 40
MOST_HALVINGS = 8
MOST_FAILED = 5  # films without convergence, in one stage
LEAST_GAIN = 1e-4  # of the imbalance, by a full step


def solve_stage(
    solver: FilmSolver,
    floating: Floating,
    time: float,
    before: Array,
    step: float,
    guess: Array,
    last: FloatingStage | None,
    close: Closeness = EXACT,
) -> FloatingStage:
    """The position at `time` (s), one implicit step (s) after the state `before`.

    Afterwards the generalised forces balance to 1e-8 of the magnitudes that meet there (1e-6 where the film's round-off
    allows no less), or do so along their slopes within a step that `close` allows. Film and position are found together
    from `guess` (k,) m and `last` where the film has a compiled form (`compiled.film`); else, and where that fails,
    by films in balance. Raises FilmNotConverged, with the film's reason, where that fails too; a shorter step may
    succeed.
    `functools.partial(solve_stage, solver, floating)` is a `dirk.StageSolver`.
    """
    instant = instant_of(solver, floating, time, step, before)
    if last is not None and is_compiled(instant.shape):
        jointly = JointSearch(instant, close).stage(guess, last.ahead(guess))
        if jointly is not None:
            return jointly
    return films_in_balance(instant, guess, last, close)


def films_in_balance(
    instant: FloatingInstant, guess: Array, last: FloatingStage | None, close: Closeness = EXACT
) -> FloatingStage:
    """The same by Newton's method on the position alone, with a film in balance at each: slower, from farther away.

    It starts at `guess` (k,) m and, where that fails, at the position before; `last` is the film's first guess. A
    Newton step leaves a fifth of the least gap, or presses rough walls by three standard deviations at most, and is
    halved until it brings the forces nearer to balance.
    """
    search = _Search(instant, close, None if last is None else last.ahead(guess))
    if (found := search.balanced(guess)) is None:
        found = search.balanced(instant.before.position)
    if found is None:
        raise FilmNotConverged(f"{instant.floating.name} at {instant.time:.6g} s: {search.why}", search.remedy)
    return FloatingStage(instant.time, found, instant, search.films, search.steps, *search.rest)


@dataclass(frozen=True)
class InitialFilm:
    """Film from which a march starts: pressures (size,) Pa and film fractions (size,)."""

    pressure: Array
    fraction: Array


def full_film(
    floating: Floating, time: float, q: Array, rate: Array | None = None, initial: InitialFilm | None = None
) -> Array:
    """State at the start of a march, as `FloatingStage.holds`: a full or an `initial` film at a position (k,) m.

    A full film has the lowest pressure between its boundaries. The pressures of an `initial` film open elastic walls
    before the first step. `rate` (k,) m/s counts where walls have inertia (None: at rest). Raises WallsOverlap where
    walls overlap, FilmInputError for an initial film of another number of unknowns.
    """
    shape = floating.shape_at(time)
    at = posed(shape, modes_on(shape.space, floating.modes_at(time), floating.pockets), q)
    if shape.walls is None and not at.least > lowest_gap(shape):
        raise WallsOverlap(floating.name, time, at.least)
    full = replace(shape, film=at.film, asperities=at.asperities, boundary=filled(floating, shape, q))
    oil = oil_held(full) if initial is None else oil_held(full, initial.fraction, initial.pressure)
    return joined(floating, StepStart(oil, q, np.zeros(len(q)) if rate is None else rate))


class _Search:
    """Films tried at one instant, each the first guess of the next."""

    def __init__(self, instant: FloatingInstant, close: Closeness, warm: FilmSolution | None) -> None:
        self._instant, self._close, self._warm = instant, close, warm
        self.rest: tuple[Array, FilmSensitivity | None] = np.zeros_like(instant.before.position), None
        self.films = self.steps = self._failed = 0
        self.why, self.remedy = "no film tried", "a shorter step, or less load"

    def balanced(self, start: Array) -> Trial | None:
        """The film in balance that Newton's method reaches from a position (k,) m; else None, and `why`."""
        at = self._tried(start)
        if at is None and self._warm is not None:  # a cavity that opens everywhere at once converges from a cold start
            self._warm = None
            at = self._tried(start)
        for _ in range(MOST_STEPS):
            if at is None or at.missed <= TOLERANCE:
                return at
            found = self._newton(at)
            if found is not None and self._near(at, found[0]):
                self.rest = found
                return at
            new = None if found is None else self._downhill(at, *found)
            if new is None:
                return at if at.missed <= GOOD_ENOUGH else None
            at = new
            self.steps += 1
        self.why = f"not settled after {MOST_STEPS} steps"
        return None

    def _near(self, at: Trial, step: Array) -> bool:
        """True for a step within the closeness."""
        return bool(
            np.abs(self._instant.modes.at_vertices @ step).max() <= self._close.allows(at.solution.film.thickness)
        )

    def _tried(self, q: Array, ahead: FilmSolution | None = None) -> Trial | None:
        """The film there, None where it fails; `ahead` is a guess of it."""
        self.films += 1
        try:
            found = self._instant.tried(q, self._warm if ahead is None else ahead)
        except FilmNotConverged as reason:
            self._failed += 1
            self.why, self.remedy = reason.what, reason.remedy
            return None
        except InputError as reason:  # a law of oil or contact ends before; a shorter step may do
            self._failed += 1
            self.why = str(reason)
            return None
        self._warm = found.solution
        return found

    def _newton(self, at: Trial) -> tuple[Array, FilmSensitivity] | None:
        """The step of Newton's method and the film's sensitivity to the position; None where no force resists."""
        instant = self._instant
        try:
            film = instant.by_position(at, LOOSE if instant.shape.walls is None else SOFT_LOOSE)
            return -solved(instant.slopes(at, film), at.missing, instant.floating.name), film
        except FilmNotConverged as reason:
            self.why, self.remedy = reason.what, reason.remedy
            return None

    def _downhill(self, at: Trial, step: Array, film: FilmSensitivity) -> Trial | None:
        """The film one Newton step on, the step cut until it is nearer to balance; None where no share is."""
        instant = self._instant
        room = min(1.0, instant.room(at, step, film))
        if instant.touching(at):
            self.why, self.remedy = f"walls that touch: least gap {at.least:.3g} m", TOUCHING
            return None
        size = at.scale
        before = float(np.max(np.abs(at.missing) / size))
        for halvings in range(MOST_HALVINGS):
            share = room * 0.5**halvings
            new = self._tried(at.q + share * step, instant.ahead(at, share * step, film))
            # Walls too far apart to interact: a step cut at their gap brings them nearer.
            wanted = before if share == room < 1.0 else (1.0 - LEAST_GAIN * share) * before
            if new is not None and float(np.max(np.abs(new.missing) / size)) <= wanted:
                return new
            if self._failed > MOST_FAILED:  # costly: a shorter step in time is cheaper
                return None
        self.why = f"forces out of balance by {at.missed:.2g} of their magnitudes, least gap {at.least:.3g} m"
        return None
