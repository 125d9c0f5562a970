"""One implicit step of a floating film: the position at which its forces balance, by Newton's method."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from reynolds.equation.rough_overlap import as_shaped
from reynolds.errors import FilmInputError, FilmNotConverged, InputError
from reynolds.floating.coordinates import SoftContact, modes_on
from reynolds.floating.pose import lowest_gap, posed
from reynolds.floating.problem import Floating, Outer
from reynolds.floating.sensitivity import FilmSensitivity
from reynolds.floating.trial import (
    TOUCHING,
    FloatingInstant,
    StepStart,
    Trial,
    filled,
    instant_of,
    joined,
    parted,
    solved,
)
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.iterate import is_linear
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


@dataclass(frozen=True)
class Closeness:
    """Length of a last Newton step (share of the least film, and m) after which the film is not solved again.

    Oil and forces then follow the position along their slopes, with an error of its square. Zero for both: steps
    until the forces balance.
    """

    share: float = 0.0
    floor: float = 0.0

    def allows(self, at: Trial) -> float:
        """Allowed length at a trial, m."""
        return self.share * float(at.solution.film.thickness.min()) + self.floor


EXACT = Closeness()


@dataclass(frozen=True)
class FloatingStage:
    """A floating film at the end of an implicit step: a `Stage` of `numerics.dirk`.

    films: number solved; steps: of Newton's method. The film is the last one tried, and `shift` (k,) m the way
    from there to the balance of forces, see `Closeness`.
    """

    time: float
    trial: Trial = field(repr=False)
    instant: FloatingInstant = field(repr=False)
    films: int
    steps: int
    shift: Array
    known: FilmSensitivity | None = field(repr=False, default=None)

    @property
    def q(self) -> Array:
        """Position (k,), m."""
        return self.trial.q + self.shift

    @cached_property
    def solution(self) -> FilmSolution:
        """The film in balance, with its storage, between rigid walls of its deformed shape.

        It follows the shift along its slopes, and so do its flows: oil is conserved to the square of the shift.
        """
        if not self.shift.any():
            return as_shaped(self.trial.solution)
        return as_shaped(self.instant.moved(self.trial, self.shift, self.by_position))

    @cached_property
    def gap(self) -> Array:
        """Distance of the mean planes at the quadrature points (cells, points), m, deformation included."""
        if not self.shift.any():
            return self.trial.gap
        return self.trial.gap + self.instant.shape.space.sample_vertices(self._grown @ self.shift)

    @property
    def least_gap(self) -> float:
        """Least distance of the mean planes, m."""
        if not self.shift.any():
            return self.trial.least
        corners = self.trial.corner_gap
        least = float(self.gap.min())
        return least if corners is None else min(least, float((corners + self._grown @ self.shift).min()))

    @cached_property
    def _grown(self) -> Array:
        """Growth of the gap by each coordinate at the vertices, (vertices, k)."""
        return self.instant.grown(self.trial, self.by_position)

    @property
    def film_force(self) -> Array:
        """Q without contact, (k,) N."""
        return self.trial.film_force + self._along(lambda: self.instant.film_slopes(self.by_position))

    @property
    def contact_force(self) -> Array:
        """Share of the asperities in Q, (k,) N."""
        contact = self.trial.contact
        if contact is None:
            return np.zeros(len(self.q))
        return contact.force + self._along(lambda: contact.slopes + contact.by_pressure(self.by_position.pressure))

    @property
    def wall_pressure(self) -> Array:
        """Pressure (size,) Pa of the film on its walls and, where these are elastic, of the asperities too."""
        contact = self.trial.contact
        if not isinstance(contact, SoftContact):
            return self.solution.pressure
        touch = contact.touch
        bears = touch.bears.value + self._along(lambda: touch.bears.slope[:, None] * self._grown)
        return self.solution.pressure + touch.meeting.on_unknowns(bears)

    @property
    def outer(self) -> Outer:
        """P and its slopes."""
        outer = self.trial.outer
        more = self._along(lambda: outer.by_position + outer.by_rate / self.instant.step)
        return replace(outer, force=outer.force + more)

    @property
    def rate(self) -> Array:
        """dq/dt over the step, (k,) m/s."""
        return self.trial.rate + self.shift / self.instant.step

    @property
    def inertia_force(self) -> Array:
        """-M q'' over the step, (k,) N."""
        return self.instant.inertia_force(self.rate)

    def _along(self, slopes: Callable[[], Array]) -> Array | float:
        """Change of forces of such slopes by the shift."""
        return slopes() @ self.shift if self.shift.any() else 0.0

    @cached_property
    def holds(self) -> Array:
        """State at the end of the step, one vector: oil (size,) m3, q (k,) m and, with inertia, dq/dt (k,) m/s."""
        oil = self.trial.solution.holds
        if self.shift.any():
            oil = oil + self.instant.oil_moved(self.trial, self.by_position, self.shift[:, None])[:, 0]
        return joined(self.instant.floating, StepStart(oil, self.q, self.rate))

    @cached_property
    def by_position(self) -> FilmSensitivity:
        """Sensitivity of the film to its position: by the film's last factor while no other film is solved."""
        if self.known is not None:
            return self.known
        return self.instant.by_position(self.trial, self.instant.exactness)

    @cached_property
    def force_slopes(self) -> Array:
        """d(Q + P - M q'')/dq over the step, (k, k) N/m: stiffness and, by the step, damping."""
        return self.instant.slopes(self.trial, self.by_position)

    def ahead(self, q: Array) -> FilmSolution:
        """A guess of the film at another position (k,) m: this one if linear, else along its slopes."""
        if is_linear(self.trial.solution.problem):
            return self.trial.solution
        return self.instant.ahead(self.trial, q - self.trial.q, self.by_position)

    def moved(self, change: Array) -> Array:
        """Change of the gap (cells, points) m by one of the position (k,) m, elastic walls following."""
        return self.instant.shape.space.sample_vertices(self._grown @ change)

    @property
    def yardstick(self) -> Array:
        """Film thickness (cells, points) m as the scale of its changes.

        Where elastic walls flatten summits, at least their height.
        """
        thickness, shape = self.trial.solution.film.thickness, self.instant.shape
        if shape.walls is None or shape.asperities is None:
            return thickness
        return np.maximum(thickness, shape.asperities.height)

    def propagated(self, before: Array) -> tuple[Array, Array]:
        """Change of q (k, m) and of `holds` (held, m) by changes (held, m) of the state before.

        Exact at constant cavity; costs k + m right-hand sides on the film's last factor, and a new factor
        where the solver has solved another film since.
        """
        floating = self.instant.floating
        changed = parted(floating, before, len(self.trial.solution.pressure))
        after = self.instant.onward(self.trial, self.by_position, self.force_slopes, changed)
        return after.position, joined(floating, after)


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
    allows no less), or do so along their slopes within a step that `close` allows. Newton's method starts at `guess`
    (k,) m and, where that fails, at the position before; `last` warms the film. A Newton step leaves a fifth of the
    least gap, or presses rough walls by three standard deviations at most, and is halved until it brings the forces
    nearer to balance. Raises FilmNotConverged, with the film's reason, where that fails; a shorter step may succeed.
    `functools.partial(solve_stage, solver, floating)` is a `dirk.StageSolver`.
    """
    instant = instant_of(solver, floating, time, step, before)
    search = _Search(instant, close, None if last is None else last.ahead(guess))
    if (found := search.balanced(guess)) is None:
        found = search.balanced(instant.before.position)
    if found is None:
        raise FilmNotConverged(f"{floating.name} at {time:.6g} s: {search.why}", search.remedy)
    return FloatingStage(time, found, instant, search.films, search.steps, *search.rest)


def full_film(floating: Floating, time: float, q: Array, rate: Array | None = None) -> Array:
    """State of a full film at a position (k,) m, as `FloatingStage.holds`: the start of a march.

    The film is at the pressures of its boundaries; `rate` (k,) m/s counts where walls have inertia (None: at
    rest). Raises FilmInputError where walls overlap.
    """
    shape = floating.shape_at(time)
    at = posed(shape, modes_on(shape.space, floating.modes_at(time), floating.pockets), q)
    if shape.walls is None and not at.least > lowest_gap(shape):
        raise FilmInputError(f"{floating.name} at {time:.6g} s", f"a least gap of {at.least:.3g} m", "walls apart")
    full = replace(shape, film=at.film, asperities=at.asperities, boundary=filled(floating, shape, q))
    return joined(floating, StepStart(oil_held(full), q, np.zeros(len(q)) if rate is None else rate))


class _Search:
    """Films tried at one instant, each warming the next."""

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
        return bool(np.abs(self._instant.modes.at_vertices @ step).max() <= self._close.allows(at))

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
