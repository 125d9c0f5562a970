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
from reynolds.floating.step import FloatingStage, solve_stage
from reynolds.numerics.arrays import Array
from reynolds.numerics.dirk import AcceptedStep, State, Tableau, integrate, nodes_only
from reynolds.problem import FilmSolution
from reynolds.solve.loads import cavitated_fraction
from reynolds.solve.solver import FilmSolver

MET = 0.1  # of the distance at which a turn counts as closed: near enough to join the turn before
SHORT = 1e-2  # of the first way to a node: a step in which elastic walls deform under their first load
FARTHEST = 2e-2  # of the film's length, by which a wall may leave its shape: then nothing is thin, no tilt small

Value = TypeVar("Value")
Item = TypeVar("Item")


@dataclass(frozen=True)
class GapInstant(Generic[Value]):
    """A gap at one shaft angle (rad): position (k,) m, rate (k,) m/s, forces (k,) N along the position, film.

    Forces of film, contact, outside and inertia, -M q'', add up to zero.

    least_gap m is the least distance of the mean planes, negative where rough walls overlap; film_thickness_min
    and mean_film m the least and the area mean of the film's thickness; pressure_max Pa; cavitated_area_fraction;
    report: of the gap at the instant; passed: its mean since the angle before, in which flows balance as in the
    march; pushed: power (W) of the film on the outer forces, such a mean too.
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
    report: Value
    passed: Value
    pushed: float


@dataclass(frozen=True)
class GapTurn(Generic[Value]):
    """One turn: its start q, its instants, kept films by angle, its end, and what it cost.

    oil: (size,) m3 of each unknown at each reported angle; times (s) of its steps; step_error: largest error of a
    step over what was allowed; allowed, reach, repeats: as `reynolds.numerics.shooting.Turn` has them.
    """

    start: Array
    instants: tuple[GapInstant[Value], ...]
    films: dict[float, FilmSolution] = field(repr=False)
    oil: tuple[Array, ...] = field(repr=False)
    last: State[FloatingStage] = field(repr=False)
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


class Turns(Generic[Value]):
    """Turns of one gap, each from a start; counts what they cost."""

    def __init__(
        self,
        solver: FilmSolver,
        floating: Floating,
        schedule: Schedule,
        report_of: Callable[[FloatingStage], Value],
        accuracy: Accuracy,
        method: Tableau,
        opening: GapTurn[Value] | None,
        progress: Callable[[int, float], None],
    ) -> None:
        self._solver, self._floating, self._report_of = solver, floating, report_of
        self._accuracy, self._method, self._opening = accuracy, method, opening
        self._times, self._speed = schedule.times, schedule.speed
        self._angles = dict(zip(schedule.angles / schedule.speed, schedule.angles, strict=True))
        self._kept = set(schedule.angles[schedule.keep - 1 :: schedule.keep])
        self._adaptive = 2 if opening is None else 1  # turns left that choose their steps
        self._progress, self._turn = progress, 0
        self._solved: deque[FloatingStage] = deque(maxlen=len(method.matrix))  # of the step taken last
        self.films_solved = 0

    def turn(self, start: Array, before: GapTurn[Value] | None) -> GapTurn[Value]:
        """One turn from a start, on from what the turn before left in the film.

        Once the film is where it was in that turn, and that one ended next to the start, its rest is taken over.
        """
        state = begin = self._begin(start, before or self._opening)
        again = before.times if before is not None and self._adaptive <= 0 else None
        joins = before is not None and bool(np.abs(before.end - start).max() <= before.allowed)
        self._adaptive -= 1
        gathered: _Gathered[Value] = _Gathered()
        since: Passed[Value] = Passed()
        for taken in self._marched(begin, again):
            state, stage = taken.state, taken.stage
            gathered.step(state, self._excess(taken))
            angle = self._angles.get(state.time)
            # Turns that approach the periodic motion report their last step alone.
            if angle is None and self._opening is None:
                continue
            report = self._report_step(taken.step, since)
            if angle is None:
                continue
            gathered.add(_instant(angle, stage, state.rate, report, since), stage, kept=angle in self._kept)
            since = Passed()
            if joins and before is not None and gathered.meets(before, self._accuracy.closed):
                state = gathered.join(before)
                break
        end = gathered.instants[-1]
        return GapTurn(
            start=start,
            instants=tuple(gathered.instants),
            films=gathered.films,
            oil=tuple(gathered.oil),
            last=state,
            times=np.array(gathered.times),
            step_error=max(gathered.errors),
            allowed=self._accuracy.closed * end.mean_film,
            reach=self._accuracy.reach * end.film_thickness_min,
            repeats=_oil_moved(self._floating.shape_at(0.0).space, begin, state) <= self._accuracy.closed,
        )

    def _report_step(self, step: float, since: Passed[Value]) -> Value:
        """Add the reports of a step's stages (s), each for its share of the step; the last stage's report."""
        for stage, share in zip(self._solved, self._method.matrix[-1], strict=True):
            report = self._report_of(stage)
            since.add(share * step, report, -float(stage.outer.force @ stage.rate))
        return report

    def _marched(self, begin: State[FloatingStage], again: Array | None) -> Iterator[AcceptedStep[FloatingStage]]:
        """Steps of a turn, chosen by their error or those of an earlier turn again."""
        if again is None:
            steps = integrate(self._method, self._stage, begin, self._times, self._excess)
        else:
            steps = integrate(self._method, self._stage, begin, again, nodes_only)
        reached = begin.time
        self._turn += 1
        try:
            for taken in steps:
                reached = taken.state.time
                _check_near(taken.stage)
                self._progress(self._turn, reached / self._times[-1])
                yield taken
        except FilmNotConverged as reason:
            angle = np.degrees(self._speed * reached)
            raise FilmNotConverged(f"after {angle:.5g} deg: {reason.what}", reason.remedy) from None

    def _begin(self, start: Array, last: GapTurn[Value] | None) -> State[FloatingStage]:
        """The start of a turn; a cold one, or one of another drive (`opening`), first deforms under this load."""
        if last is None or last.last.stage is None:
            begin = started(self._floating, 0.0, start)
        else:
            begin = restarted(self._floating, 0.0, last.last, start)
            if last is not self._opening:
                return begin
        if self._floating.shape_at(0.0).walls is None:
            return begin
        return pressed(self._solver, self._floating, begin, SHORT * self._times[0])

    def _stage(
        self, time: float, before: Array, step: float, guess: Array, last: FloatingStage | None
    ) -> FloatingStage:
        close = self._accuracy.closeness
        stage = solve_stage(self._solver, self._floating, time, before, step, guess, last, close)
        self.films_solved += stage.films
        self._solved.append(stage)
        return stage

    def _excess(self, taken: AcceptedStep[FloatingStage]) -> float:
        """Largest error of the film by a step, over what is allowed there."""
        stage = taken.stage
        allowed = self._accuracy.step * stage.yardstick + self._accuracy.floor
        return float(np.max(np.abs(stage.moved(taken.error)) / allowed))


def _check_near(stage: FloatingStage) -> None:
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


class _Gathered(Generic[Value]):
    """Results of a turn so far."""

    def __init__(self) -> None:
        self.instants: list[GapInstant[Value]] = []
        self.films: dict[float, FilmSolution] = {}
        self.oil: list[Array] = []
        self.times: list[float] = []
        self.errors: list[float] = []

    def step(self, state: State[FloatingStage], error: float) -> None:
        """One more step, with its error over what was allowed."""
        self.times.append(state.time)
        self.errors.append(error)

    def add(self, instant: GapInstant[Value], stage: FloatingStage, *, kept: bool) -> None:
        """One more reported angle."""
        self.instants.append(instant)
        self.oil.append(stage.holds[: stage.instant.shape.space.size])
        if kept:
            self.films[instant.angle] = stage.solution

    def meets(self, before: GapTurn[Value], closed: float) -> bool:
        """True if part and oil at the last reported angle are those of the turn before."""
        here = len(self.instants) - 1
        away = np.abs(self.instants[here].position - before.instants[here].position).max()
        return bool(away <= MET * before.allowed) and _moved(before.oil[here], self.oil[here]) <= closed

    def join(self, before: GapTurn[Value]) -> State[FloatingStage]:
        """Take the rest of the turn before; its end."""
        count, time, angle = len(self.instants), self.times[-1], self.instants[-1].angle
        self.instants += before.instants[count:]
        self.oil += before.oil[count:]
        self.films |= {at: film for at, film in before.films.items() if at > angle}
        self.times += [float(later) for later in before.times[before.times > time]]
        self.errors.append(before.step_error)
        return before.last


def _oil_moved(first: FilmSpace, begin: State[FloatingStage], end: State[FloatingStage]) -> float:
    """Oil that differs in place at the end, over all."""
    assert end.stage is not None
    space = end.stage.instant.shape.space
    return _moved(end.held[: space.size][seats_of(first, space)], begin.held[: space.size])


def _moved(came: Array, went: Array) -> float:
    """Oil that differs in place, over all."""
    return float(np.abs(came - went).sum() / np.abs(went).sum())


def _instant(angle: float, stage: FloatingStage, rate: Array, report: Value, since: Passed[Value]) -> GapInstant[Value]:
    """The instant at the end of a step."""
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
        report=report,
        passed=since.mean,
        pushed=since.mean_pushed,
    )


def weighted_mean(items: Sequence[Item], weights: Array) -> Item:
    """Weighted mean of reports of several stages, of the same unit.

    Numbers and arrays are averaged, dataclasses field by field; anything else is the last one's.
    A flow averaged over stages by the weights of their method is what the step has passed, to round-off.
    """
    last = items[-1]
    if is_dataclass(last) and not isinstance(last, type):
        names = (field.name for field in fields(last))
        means = {name: weighted_mean([getattr(one, name) for one in items], weights) for name in names}
        return cast(Item, replace(last, **means))
    if isinstance(last, float):
        return cast(Item, float(np.average(np.array(items), weights=weights)))
    if isinstance(last, np.ndarray):
        return cast(Item, np.average(np.array(items), axis=0, weights=weights))
    return last


class Passed(Generic[Item]):
    """Reports of the stages of some steps, each with its share of time (s)."""

    def __init__(self) -> None:
        self._reports: list[Item] = []
        self._pushed: list[float] = []
        self._times: list[float] = []

    def add(self, time: float, report: Item, pushed: float) -> None:
        """One more stage; pushed: power (W) of its film on the outer forces."""
        self._reports.append(report)
        self._pushed.append(pushed)
        self._times.append(time)

    @property
    def mean(self) -> Item:
        """Mean of the reports."""
        return weighted_mean(self._reports, np.array(self._times))

    @property
    def mean_pushed(self) -> float:
        """Mean of the power (W)."""
        return weighted_mean(self._pushed, np.array(self._times))
