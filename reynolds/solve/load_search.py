"""Separation and tilts of a film's walls at which film and contact bear a given load.

The film's thickness is then a shape, to which h = shape + separation + slope_x x + slope_y y adds a rigid motion.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from reynolds.errors import FilmInputError, FilmNotConverged, InputError
from reynolds.laws.contact import contact_pressure
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmProblem, FilmSolution
from reynolds.solve.loads import pressure_integrals
from reynolds.solve.solver import FilmSolver
from reynolds.solve.warm_start import from_last_or_anew

TOLERANCE = 1e-6  # of the load, and of the load at the film's edge for moments
NEARLY = 1e-3  # of the load: the force is met, and only the moments are not
MOST_FILMS = 200
THICKEST, THINNEST = 1.0, 1e-9  # least gap over the film's extent; beyond, no film
MOLECULE = 1e-9  # m, of an oil: no thinner gap holds a film
USUAL_GAP = 1e-4  # of the extent, where the shape is flat
SOFT_START = 0.7  # first place between elastic walls: unit steps from there do not meet a zero gap
LEAST_STEP, MOST_STEP = 1e-3, 2.5  # of the logarithm of the least gap
DIFFERENCE = 1e-4  # of the logarithm of the least gap, and of the rise over it, for slopes by differences

Solve = Callable[[FilmProblem], FilmSolution]


@dataclass(frozen=True)
class RigidLoad:
    """Load on film and contact: force N, and moments N m about the origin as in `Loads`.

    moment_x (integral of p y) frees the tilt along y, moment_y (integral of -p x) that along x; None: no tilt.
    Raises FilmInputError for a force that is not above zero.
    """

    force: float
    moment_x: float | None = None
    moment_y: float | None = None

    def __post_init__(self) -> None:
        if not (np.isfinite(self.force) and self.force > 0.0):
            raise FilmInputError("load", f"{self.force:g} N", "a force above zero, which presses the walls together")


@dataclass(frozen=True)
class Position:
    """Rigid motion of a wall: h grows by separation + slope_x x + slope_y y (m)."""

    separation: float
    slope_x: float = 0.0
    slope_y: float = 0.0

    def of(self, x: Array, y: Array) -> Array:
        """Growth of the film thickness at places (m), m."""
        return self.separation + self.slope_x * x + self.slope_y * y


@dataclass(frozen=True)
class LoadedFilm:
    """A film at the position at which it bears its load.

    force N and moments N m that film and contact bear there; rest: largest residual, relative as TOLERANCE; films:
    number of films solved.
    """

    position: Position
    solution: FilmSolution
    force: float
    moment_x: float
    moment_y: float
    rest: float
    films: int


def carry_load(problem: FilmProblem, load: RigidLoad, solve: Solve | None = None) -> LoadedFilm:
    """The film of `problem`, its thickness a shape, at the position at which it bears the load.

    Afterwards force and free moments are those of `load` to 1e-6. The separation is bracketed between a film that bears
    more and a thicker one that bears less, so that it is stable, and closed in by regula falsi (Illinois: Dowell and
    Jarratt 1971). Tilts: Newton's method with Broyden's updates (1965) from there. `solve` gives the film of a problem
    (left out: `FilmSolver`, each film the first guess of the next). Raises FilmNotConverged, with the nearest supported
    load, where no position bears the load; also as `solve` does.
    """
    search = _LoadSearch(problem, load, solve or _warmed(problem))
    for lean in search.leans():
        try:
            place, found = search.one_freedom(lean)
            found = found if search.free == [0] else search.newton(place, lean, found)
        except _Nowhere:
            continue
        return LoadedFilm(found.position, found.solution, *found.supported, found.rest, search.films)
    raise search.verdict()


def _warmed(problem: FilmProblem) -> Solve:
    solver, last = FilmSolver(problem.space), None

    def solve(now: FilmProblem) -> FilmSolution:
        nonlocal last
        last = from_last_or_anew(partial(solver.solve, now), last)
        return last

    return solve


class _Nowhere(Exception):
    """A search ended without a position."""


@dataclass(frozen=True)
class _Tried:
    """A film at a position: supported load (N, N m), residuals that are to vanish, least gap by its shape (m).

    aims: the logarithm of the force over the load, and how far it acts from its place, over the film's reach; infinite
    for a film without force. The first hardly depends on the tilts and the second hardly on the separation.
    """

    position: Position
    solution: FilmSolution
    supported: tuple[float, float, float]
    misses: Array
    aims: Array
    gap: float

    @property
    def rest(self) -> float:
        return float(np.abs(self.misses).max())


class _LoadSearch:
    """Films of one shape at positions; keeps the one nearest to the load."""

    def __init__(self, problem: FilmProblem, load: RigidLoad, solve: Solve) -> None:
        self._problem, self._load, self._solve = problem, load, solve
        self.films = 0
        self._best: _Tried | None = None
        space, shape = problem.space, problem.film.thickness
        x, y = (np.ravel(np.broadcast_to(part, space.area.shape)) for part in space.points)
        self._x, self._y = (np.append(part, space.vertices[:, k]) for k, part in enumerate((x, y)))
        flat = np.ravel(np.broadcast_to(shape, space.area.shape))
        corners = problem.film.thickness_at_vertices
        self._shape = np.append(flat, np.full(len(space.vertices), flat.max()) if corners is None else corners)
        self.extent = float(np.sqrt(space.area.sum()))
        self.reach = float(np.hypot(*space.vertices.T).max())
        self._scale = max(float(np.ptp(flat)), USUAL_GAP * self.extent)
        thickest = float(np.log(THICKEST * self.extent / self._scale))
        self._ends = (float(np.log(THINNEST * self.extent / self._scale)), thickest)
        if problem.walls is not None:
            self._ends = (-thickest, thickest)
        moments = (load.moment_y, load.moment_x)  # of the tilts along x and y
        self.free = [0, *(k for k, moment in enumerate(moments, start=1) if moment is not None)]

    def leans(self) -> Iterator[tuple[float, float]]:
        """Tilts to start from, rise over the extent per least gap: a film that is flat, or opens, may bear nothing."""
        yield 0.0, 0.0
        for rise in (-1.0, 1.0, -4.0, 4.0):
            for k in self.free[1:]:
                yield (rise, 0.0) if k == 1 else (0.0, rise)

    def at(self, position: Position) -> _Tried:
        """The film at a position; raises as the solve does."""
        if self.films >= MOST_FILMS:
            raise _Nowhere
        self.films += 1
        given, space = self._problem.film, self._problem.space
        corners = given.thickness_at_vertices
        film = replace(
            given,
            thickness=given.thickness + position.of(*space.points),
            thickness_at_vertices=None if corners is None else corners + position.of(*space.vertices.T),
        )
        solution = self._solve(replace(self._problem, film=film))
        supported = _supported(solution)
        gap = float((self._shape + position.of(self._x, self._y)).min())
        tried = _Tried(position, solution, supported, self._misses(supported), self._aims(supported), gap)
        if self._best is None or tried.rest < self._best.rest:
            self._best = tried
        return tried

    def _misses(self, supported: tuple[float, float, float]) -> Array:
        """Relative residual of the force, within -2 .. 2; moments over the load at the film's edge."""
        load, (force, moment_x, moment_y) = self._load, supported
        size = 0.5 * (max(force, 0.0) + load.force)
        misses = [max((force - load.force) / size, -2.0)]
        for moment, wanted in ((moment_y, load.moment_y), (moment_x, load.moment_x)):
            misses += [] if wanted is None else [(moment - wanted) / (load.force * self.reach)]
        return np.array(misses)

    def _aims(self, supported: tuple[float, float, float]) -> Array:
        """Logarithm of force over load, and distances of the force from its place over the film's reach."""
        load, (force, moment_x, moment_y) = self._load, supported
        wanted = [(moment_y, load.moment_y), (moment_x, load.moment_x)]
        arms = [(moment, there / load.force) for moment, there in wanted if there is not None]
        if force <= 0.0:
            return np.full(1 + len(arms), np.inf)
        return np.array([np.log(force / load.force), *((moment / force - at) / self.reach for moment, at in arms)])

    def _leaning(self, place: float, lean: tuple[float, float]) -> Position:
        """Position of least gap scale exp(place); between elastic walls 2 scale sinh(place), which may overlap."""
        gap = self._scale * np.exp(place)
        slope_x, slope_y = (gap / self.extent * part for part in lean)
        if self._problem.walls is not None:
            gap -= self._scale * np.exp(-place)
        tilted = self._shape + slope_x * self._x + slope_y * self._y
        return Position(float(gap - tilted.min()), float(slope_x), float(slope_y))

    def one_freedom(self, lean: tuple[float, float]) -> tuple[float, _Tried]:
        """Place and film that bears the force alone; raises _Nowhere."""
        (a, one), (b, two) = self._bracket(lean)
        f_a, f_b = one.misses[0], two.misses[0]
        while abs(f_b) > TOLERANCE:
            place = (a * f_b - b * f_a) / (f_b - f_a)
            new = None if place in (a, b) else self._tried(self._leaning(place, lean))
            if new is None:
                raise _Nowhere
            two = new
            if two.misses[0] * f_b < 0.0:
                a, f_a = b, f_b
            else:
                f_a *= 0.5
            b, f_b = place, two.misses[0]
        return b, two

    def _bracket(self, lean: tuple[float, float]) -> tuple[tuple[float, _Tried], tuple[float, _Tried]]:
        """Places of less and of more than the load, next to each other; raises _Nowhere without such places."""
        at = 0.0 if self._problem.walls is None else SOFT_START
        last = self.at(self._leaning(at, lean))
        longest = MOST_STEP
        step = 1.0 if last.misses[0] > 0.0 else -1.0
        while True:
            step = float(np.clip(at + step, *self._ends)) - at
            if abs(step) < LEAST_STEP:
                raise _Nowhere
            new = self._tried(self._leaning(at + step, lean))
            if new is None:  # a shorter step may reach it
                step *= 0.5
                longest = abs(step)
                continue
            if new.misses[0] * last.misses[0] <= 0.0:
                return (at, last), (at + step, new)
            falls = (new.misses[0] - last.misses[0]) / step
            wanted = 1.3 * abs(new.misses[0] / falls) if falls else MOST_STEP
            at, last = at + step, new
            step = float(np.copysign(min(max(wanted, 0.3), longest), step))
            longest = min(2.0 * longest, MOST_STEP)

    def _tried(self, position: Position) -> _Tried | None:
        """The film there; None where it does not converge or its walls are beyond their contact's law."""
        try:
            return self.at(position)
        except (FilmNotConverged, InputError):
            return None

    def newton(self, place: float, lean: tuple[float, float], here: _Tried) -> _Tried:
        """The film that bears force and moments, from that at a place and tilts on; raises _Nowhere.

        Unknowns are the place and the free tilts of `_leaning`, of which the force's place follows the tilts and the
        logarithm of the force the place, both nearly linear.
        """
        at = np.array([place, *lean])[self.free]
        slopes: Array | None = None
        while here.rest > TOLERANCE:
            if fresh := slopes is None:
                slopes = self._slopes(at, here)
            assert slopes is not None
            if (found := self._nearer(at, here, slopes)) is None:
                if fresh:
                    raise _Nowhere
                slopes = None
                continue
            moved, new = found[0] - at, found[1]
            change = new.aims - here.aims - slopes @ moved
            slopes = slopes + np.outer(change, moved) / (moved @ moved)
            at, here = found
        return here

    def _nearer(self, at: Array, here: _Tried, slopes: Array) -> tuple[Array, _Tried] | None:
        """The film after the step by `slopes`, or a share of it, from which the next step by them is shorter.

        Steps count, not aims: a small change of the force's place asks for a long way over tilts (Deuflhard 1974).
        """
        try:
            step = -np.asarray(np.linalg.solve(slopes, here.aims))
        except np.linalg.LinAlgError:
            raise _Nowhere from None
        longest = float(np.max(np.abs(step) / (MOST_STEP, *(1.0 + np.abs(at[1:])))))
        for halvings in range(8):
            share = 0.5**halvings / max(longest, 1.0)
            new = self._tried(self._leaning_at(at + share * step))
            if new is None or not np.all(np.isfinite(new.aims)):
                continue
            if np.linalg.norm(np.linalg.solve(slopes, new.aims)) < (1.0 - 1e-3 * share) * np.linalg.norm(step):
                return at + share * step, new
        return None

    def _slopes(self, at: Array, here: _Tried) -> Array:
        """Slopes of the aims by place and free tilts, by differences."""
        beside = at + DIFFERENCE * np.eye(len(at))
        return np.column_stack([(self.at(self._leaning_at(one)).aims - here.aims) / DIFFERENCE for one in beside])

    def _leaning_at(self, unknowns: Array) -> Position:
        every = np.zeros(3)
        every[self.free] = unknowns
        return self._leaning(float(every[0]), (float(every[1]), float(every[2])))

    def _searched(self) -> str:
        """Limits of the search in words, with those beyond which nothing is a film."""
        low, high = (self._scale * np.exp(end) for end in self._ends)
        if self._problem.walls is not None:
            low = self._scale * (np.exp(self._ends[0]) - np.exp(-self._ends[0]))
        told = f"least gaps of {low:.3g} to {high:.3g} m, the film's extent, were open to the search"
        assert self._best is not None
        if self._problem.walls is None and self._best.gap < MOLECULE:
            told += f"; below {MOLECULE:g} m, the size of an oil's molecules, there is no film"
        return told

    def verdict(self) -> FilmNotConverged:
        """The error with the nearest supported load, and the limits of the search."""
        assert self._best is not None
        best, load = self._best, self._load
        asked = f"{load.force:.6g} N" + ("" if self.free == [0] else " and its moments")
        at = best.position
        tilts = "" if self.free == [0] else f", slopes {at.slope_x:.3g} and {at.slope_y:.3g}"
        moments = "" if self.free == [0] else f" with moments {best.supported[1]:.4g} and {best.supported[2]:.4g} N m"
        side = "that this shape can bear"
        if abs(best.misses[0]) > NEARLY:
            side = "above that" if best.misses[0] > 0.0 else "below that"
        verb = "found that bears" if self.films >= MOST_FILMS else "bears"
        return FilmNotConverged(
            f"no position of the walls {verb} {asked}; nearest after {self.films} films: {best.supported[0]:.6g} N"
            f"{moments} at separation {at.separation:.4g} m{tilts}; {self._searched()}",
            f"a load {side}, another shape or speed, or a load nearer to the middle of the film",
        )


def _supported(solution: FilmSolution) -> tuple[float, float, float]:
    """Force (N, on a sphere along z) and moments (N m) of film and contact."""
    force, moment_x, moment_y = pressure_integrals(solution)
    problem = solution.problem
    if problem.asperities is not None:
        pressed = contact_pressure(problem.asperities, solution.gap).value
        force += float(np.sum(pressed * problem.space.axial_area))
    return force, moment_x, moment_y
