"""One turn of a floating gap: marched from angle to angle, or until it joins the turn before."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, fields, is_dataclass, replace
from typing import Generic, TypeVar, cast

import numpy as np

from gaps.revolution.schedule import Accuracy, Schedule
from reynolds.equation.rough_overlap import vertex_thickness
from reynolds.errors import FilmNotConverged
from reynolds.fem.space import FilmSpace
from reynolds.floating.problem import Floating
from reynolds.floating.start import pressed, restarted, seats_of, started
from reynolds.floating.step import Stage, solve_stage
from reynolds.numerics.arrays import Array
from reynolds.numerics.dirk import State, Tableau, Taken, march, nodes_only
from reynolds.problem import FilmSolution
from reynolds.solve.loads import cavitated_fraction
from reynolds.solve.solver import FilmSolver

MET = 0.1  # of the distance at which a turn counts as closed: near enough to join the turn before
SHORT = 1e-2  # of the first way to a node: a step in which elastic walls give way to their first load
FARTHEST = 2e-2  # of the film's length, by which a wall may leave its shape: then nothing is thin, no tilt small

Seen = TypeVar("Seen")
Told = TypeVar("Told")


@dataclass(frozen=True)
class GapInstant(Generic[Seen]):
    """A gap at one shaft angle (rad): position (k,) m, rate (k,) m/s, forces (k,) N along the position, film.

    Forces of film, contact, what is outside and of inertia, -M q'', add up to nothing.

    least_gap m is the least distance of the mean planes, negative where rough walls overlap; film_thickness_min
    and mean_film m the least and the area mean of the film's thickness; pressure_max Pa; cavitated_area_fraction;
    seen: what the gap itself tells of the instant (friction); passed: the same in the mean since the angle before,
    in which flows balance as the march has them; pushed: power (W) by which the film moves what presses on it,
    such a mean too.
    """

    angle: float
    position: Array
    rate: Array
    film_force: Array
    contact_force: Array
    outer_force: Array
    inertia_force: Array
    least_gap: float
    film_thickness_min: float
    mean_film: float
    pressure_max: float
    cavitated_area_fraction: float
    seen: Seen
    passed: Seen
    pushed: float


@dataclass(frozen=True)
class GapTurn(Generic[Seen]):
    """One turn: its start q, its instants, kept films by angle, its end, and what it cost.

    oil: (size,) m3 of each unknown at each reported angle; times (s) of its steps; step_error: largest error of a
    step over what was allowed; allowed, reach, repeats: as `reynolds.numerics.shooting.Turn` has them.
    """

    start: Array
    instants: tuple[GapInstant[Seen], ...]
    films: dict[float, FilmSolution] = field(repr=False)
    oil: tuple[Array, ...] = field(repr=False)
    last: State[Stage] = field(repr=False)
    times: Array = field(repr=False)
    step_error: float
    allowed: float
    reach: float
    repeats: bool

    @property
    def end(self) -> Array:
        """Position at its end, (k,) m."""
        return self.last.q

    @property
    def slopes(self) -> Array:
        """d end / d start, (k, k)."""
        assert self.last.tangent is not None
        return self.last.tangent.q


class Turns(Generic[Seen]):
    """Turns of one gap, each from a start; counts what they cost."""

    def __init__(
        self,
        solver: FilmSolver,
        floating: Floating,
        schedule: Schedule,
        look: Callable[[Stage], Seen],
        accuracy: Accuracy,
        method: Tableau,
        opening: GapTurn[Seen] | None,
        report: Callable[[int, float], None],
    ) -> None:
        self._solver, self._floating, self._look = solver, floating, look
        self._accuracy, self._method, self._opening = accuracy, method, opening
        self._times, self._speed = schedule.times, schedule.speed
        self._angles = dict(zip(schedule.angles / schedule.speed, schedule.angles, strict=True))
        self._kept = set(schedule.angles[schedule.keep - 1 :: schedule.keep])
        self._adaptive = 2 if opening is None else 1  # turns left that choose their steps
        self._report, self._turn = report, 0
        self._solved: deque[Stage] = deque(maxlen=len(method.matrix))  # of the step taken last
        self.films_solved = 0

    def turn(self, start: Array, before: GapTurn[Seen] | None) -> GapTurn[Seen]:
        """One turn from a start, on from what the turn before left in the film.

        Once the film is where it was in that turn, and that one ended next to the start, its rest is taken over.
        """
        state = begin = self._begin(start, before or self._opening)
        again = before.times if before is not None and self._adaptive <= 0 else None
        joins = before is not None and bool(np.abs(before.end - start).max() <= before.allowed)
        self._adaptive -= 1
        course: _Course[Seen] = _Course()
        since: Passed[Seen] = Passed()
        for taken in self._marched(begin, again):
            state, stage = taken.state, taken.stage
            course.step(state, self._excess(taken))
            angle = self._angles.get(state.time)
            # Turns that lead near the periodic motion tell of their last step alone.
            if angle is None and self._opening is None:
                continue
            seen = self._tell(taken.step, since)
            if angle is None:
                continue
            course.tell(_instant(angle, stage, state.rate, seen, since), stage, kept=angle in self._kept)
            since = Passed()
            if joins and before is not None and course.meets(before, self._accuracy.closed):
                state = course.join(before)
                break
        end = course.instants[-1]
        return GapTurn(
            start=start,
            instants=tuple(course.instants),
            films=course.films,
            oil=tuple(course.oil),
            last=state,
            times=np.array(course.times),
            step_error=max(course.errors),
            allowed=self._accuracy.closed * end.mean_film,
            reach=self._accuracy.reach * end.film_thickness_min,
            repeats=_oil_moved(self._floating.shape_at(0.0).space, begin, state) <= self._accuracy.closed,
        )

    def _tell(self, step: float, since: Passed[Seen]) -> Seen:
        """Add what the stages of a step (s) tell, each for its share of the step; what the last one tells."""
        for stage, share in zip(self._solved, self._method.matrix[-1], strict=True):
            seen = self._look(stage)
            since.add(share * step, seen, -float(stage.outer.force @ stage.rate))
        return seen

    def _marched(self, begin: State[Stage], again: Array | None) -> Iterator[Taken[Stage]]:
        """Steps of a turn, chosen by their error or those of an earlier turn again."""
        if again is None:
            steps = march(self._method, self._stage, begin, self._times, self._excess)
        else:
            steps = march(self._method, self._stage, begin, again, nodes_only)
        reached = begin.time
        self._turn += 1
        try:
            for taken in steps:
                reached = taken.state.time
                _check_near(taken.stage)
                self._report(self._turn, reached / self._times[-1])
                yield taken
        except FilmNotConverged as reason:
            angle = np.degrees(self._speed * reached)
            raise FilmNotConverged(f"after {angle:.5g} deg: {reason.what}", reason.remedy) from None

    def _begin(self, start: Array, last: GapTurn[Seen] | None) -> State[Stage]:
        """The start of a turn; what begins or had another drive before (the `opening`) gives way to this load."""
        if last is None or last.last.stage is None:
            begin = started(self._floating, 0.0, start)
        else:
            begin = restarted(self._floating, 0.0, last.last, start)
            if last is not self._opening:
                return begin
        if self._floating.shape_at(0.0).walls is None:
            return begin
        return pressed(self._solver, self._floating, begin, SHORT * self._times[0])

    def _stage(self, time: float, before: Array, step: float, guess: Array, last: Stage | None) -> Stage:
        close = self._accuracy.closeness
        stage = solve_stage(self._solver, self._floating, time, before, step, guess, last, close)
        self.films_solved += stage.films
        self._solved.append(stage)
        return stage

    def _excess(self, taken: Taken[Stage]) -> float:
        """Largest error of the film by a step, over what is allowed there."""
        stage = taken.stage
        allowed = self._accuracy.step * stage.yardstick + self._accuracy.floor
        return float(np.max(np.abs(stage.moved(taken.error)) / allowed))


def _check_near(stage: Stage) -> None:
    """Raise FilmNotConverged where a wall has gone so far that there is no film any more: it tips or flies off."""
    modes = stage.instant.modes
    away = float(np.abs(modes.at_vertices @ stage.q).max())
    length = float(np.ptp(modes.space.vertices, axis=0).max())
    if away > FARTHEST * length + float(np.abs(stage.instant.shape.film.thickness).max()):
        name, least = stage.instant.floating.name, stage.least_gap
        raise FilmNotConverged(
            f"{name} leaves its film: {away:.3g} m open, a share {away / length:.2g} of its length, least gap "
            f"{least:.3g} m: no film balances what acts on it",
            "what presses it on nearer to the middle of the film, a stronger spring, or a stop",
        )


class _Course(Generic[Seen]):
    """What has been gathered of a turn so far."""

    def __init__(self) -> None:
        self.instants: list[GapInstant[Seen]] = []
        self.films: dict[float, FilmSolution] = {}
        self.oil: list[Array] = []
        self.times: list[float] = []
        self.errors: list[float] = []

    def step(self, state: State[Stage], error: float) -> None:
        """One more step, with its error over what was allowed."""
        self.times.append(state.time)
        self.errors.append(error)

    def tell(self, instant: GapInstant[Seen], stage: Stage, *, kept: bool) -> None:
        """One more reported angle."""
        self.instants.append(instant)
        self.oil.append(stage.holds[: stage.instant.shape.space.size])
        if kept:
            self.films[instant.angle] = stage.solution

    def meets(self, before: GapTurn[Seen], closed: float) -> bool:
        """Whether the last angle told found part and oil where they were in the turn before."""
        here = len(self.instants) - 1
        away = np.abs(self.instants[here].position - before.instants[here].position).max()
        return bool(away <= MET * before.allowed) and _moved(before.oil[here], self.oil[here]) <= closed

    def join(self, before: GapTurn[Seen]) -> State[Stage]:
        """Take the rest of the turn before; its end."""
        told, time, angle = len(self.instants), self.times[-1], self.instants[-1].angle
        self.instants += before.instants[told:]
        self.oil += before.oil[told:]
        self.films |= {at: film for at, film in before.films.items() if at > angle}
        self.times += [float(later) for later in before.times[before.times > time]]
        self.errors.append(before.step_error)
        return before.last


def _oil_moved(first: FilmSpace, begin: State[Stage], end: State[Stage]) -> float:
    """Oil that is elsewhere at the end, over all of it."""
    assert end.stage is not None
    space = end.stage.instant.shape.space
    return _moved(end.held[: space.size][seats_of(first, space)], begin.held[: space.size])


def _moved(came: Array, went: Array) -> float:
    """What is elsewhere, over all there is."""
    return float(np.abs(came - went).sum() / np.abs(went).sum())


def _instant(angle: float, stage: Stage, rate: Array, seen: Seen, since: Passed[Seen]) -> GapInstant[Seen]:
    """What is reported of the end of a step."""
    area, film = stage.solution.problem.space.area, stage.solution.film
    return GapInstant(
        angle=angle,
        position=stage.q,
        rate=rate,
        film_force=stage.film_force,
        contact_force=stage.contact_force,
        outer_force=stage.outer.force,
        inertia_force=stage.inertia_force,
        least_gap=stage.least_gap,
        film_thickness_min=float(min(vertex_thickness(stage.solution).min(), film.thickness.min())),
        mean_film=float(np.sum(film.thickness * area) / np.sum(area)),
        pressure_max=float(stage.solution.pressure.max()),
        cavitated_area_fraction=cavitated_fraction(stage.solution),
        seen=seen,
        passed=since.mean,
        pushed=since.mean_pushed,
    )


def mean_of(told: Sequence[Told], weights: Array) -> Told:
    """Weighted mean of what several stages tell, of the same unit.

    Numbers and arrays are averaged, dataclasses field by field; what is neither is as the last one tells it.
    A flow averaged over stages by the weights of their method is what the step has passed, to round-off.
    """
    last = told[-1]
    if is_dataclass(last) and not isinstance(last, type):
        names = (field.name for field in fields(last))
        means = {name: mean_of([getattr(one, name) for one in told], weights) for name in names}
        return cast(Told, replace(last, **means))
    if isinstance(last, float):
        return cast(Told, float(np.average(np.array(told), weights=weights)))
    if isinstance(last, np.ndarray):
        return cast(Told, np.average(np.array(told), axis=0, weights=weights))
    return last


class Passed(Generic[Told]):
    """What the stages of some steps have told, each with the time (s) for which it stands."""

    def __init__(self) -> None:
        self._told: list[Told] = []
        self._pushed: list[float] = []
        self._times: list[float] = []

    def add(self, time: float, told: Told, pushed: float) -> None:
        """One more stage; pushed: power (W) by which its film moves what presses on it."""
        self._told.append(told)
        self._pushed.append(pushed)
        self._times.append(time)

    @property
    def mean(self) -> Told:
        """What they tell in the mean."""
        return mean_of(self._told, np.array(self._times))

    @property
    def mean_pushed(self) -> float:
        """Their power (W) in the mean."""
        return mean_of(self._pushed, np.array(self._times))
