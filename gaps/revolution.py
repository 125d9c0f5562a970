"""A gap over the revolution: its floating film marched from angle to angle until the turn closes."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from time import perf_counter
from typing import Generic, TypeVar

import numpy as np

from gaps.means import Passed
from gaps.warmth import Warmth
from reynolds.dirk import ALEXANDER_2, State, Tableau, Taken, march, nodes_only
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.film import FilmSolution
from reynolds.floating import Floating
from reynolds.floating_stage import Closeness, Stage, solve_stage
from reynolds.floating_start import pressed, restarted, seats_of, started
from reynolds.loads import Loads, loads
from reynolds.mesh import Array
from reynolds.periodic import Periodic, periodic
from reynolds.solve import FilmSolver
from reynolds.space import FilmSpace

SHORT = 1e-2  # of the first way to a node: a step in which elastic walls give way to their first load
ROUGH = 10.0  # times as far from the periodic motion may the first turns end
FEWEST = 24  # nodes of a whole turn with steps as wide as their error allows


@dataclass(frozen=True)
class Accuracy:
    """How exactly a revolution is marched and closed.

    step, floor: largest error of the film by one step, share of it in each place and m beside it; balance: share
    of that error within which forces are taken along their slopes; closed: distance from the periodic motion,
    share of the mean film, and oil that is elsewhere after a turn, share of all; reach: how far beyond a turn's
    end the next may start, share of the least film there.
    """

    step: float = 1e-3
    floor: float = 1e-8
    balance: float = 1e-2
    closed: float = 1e-3
    reach: float = 0.25

    @property
    def closeness(self) -> Closeness:
        """How near to balance the film of a stage has to come."""
        return Closeness(self.balance * self.step, self.balance * self.floor)

    @property
    def rough(self) -> Accuracy:
        """The same for turns of wide steps that only lead near to the periodic motion.

        Each of their steps is the more exact, so that the first turn that stops at all angles closes.
        """
        return replace(self, step=self.step / ROUGH, closed=ROUGH * self.closed)


@dataclass(frozen=True)
class Schedule:
    """Where a revolution stops: shaft speed rad/s, angles (n,) rad to report, `breaks` to step on, films to keep.

    Angles rise from above 0 to the last, at which the turn closes: 2 pi, or a pitch where parts and mesh repeat
    with it. `breaks` are those at which the drive bends (a port opens). Every `keep`th reported film is kept.
    """

    speed: float
    angles: Array
    breaks: Array = field(default_factory=lambda: np.zeros(0))
    keep: int = 10

    @property
    def times(self) -> Array:
        """Nodes of the march, s: angles and breaks together."""
        inside = self.breaks[(self.breaks > 0.0) & (self.breaks < self.angles[-1])]
        return np.unique(np.concatenate([self.angles, inside])) / self.speed

    @property
    def wide(self) -> Schedule:
        """The same turn with its last angle alone to report, and few nodes besides its breaks."""
        span = self.angles[-1]
        count = max(1, round(FEWEST * span / (2.0 * np.pi)))
        nodes = span * np.arange(1, count) / count
        return Schedule(self.speed, self.angles[-1:], np.union1d(self.breaks, nodes), keep=2)


def evenly(speed: float, steps: int, span: float = 2.0 * np.pi, keep: int = 10) -> Schedule:
    """Every span/steps (rad) of the turn, every `keep`th film kept."""
    return Schedule(speed, span * np.arange(1, steps + 1) / steps, keep=keep)


Seen = TypeVar("Seen")
TurnReport = Callable[[str, float], None]
"""Hears of each step: which turn it is in, and the share of that turn that is done."""


def unheard(turn: str, share: float) -> None:
    """Report a turn's progress to nobody."""


@dataclass(frozen=True)
class GapInstant(Generic[Seen]):
    """A gap at one shaft angle (rad): position (k,) m, rate (k,) m/s, forces (k,) N along the position, film.

    least_gap m is the least distance of the mean planes, negative where rough walls overlap; mean_film m the area
    mean of the film's thickness; loads as `reynolds.loads` gives them, of the film without contact; seen: what the
    gap itself tells of the instant (friction); passed: the same in the mean since the angle before, in which flows
    balance as the march has them; pushed: power (W) by which the film moves what presses on it, such a mean too.
    """

    angle: float
    position: Array
    rate: Array
    film_force: Array
    contact_force: Array
    outer_force: Array
    least_gap: float
    mean_film: float
    loads: Loads
    seen: Seen
    passed: Seen
    pushed: float


@dataclass(frozen=True)
class GapTurn(Generic[Seen]):
    """One turn: its start q, its instants, kept films by angle, its end, and what it cost.

    times (s) of its steps; step_error: largest error of a step over what was allowed; allowed, reach, repeats: as
    `reynolds.periodic.Turn` has them.
    """

    start: Array
    instants: tuple[GapInstant[Seen], ...]
    films: dict[float, FilmSolution] = field(repr=False)
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


@dataclass(frozen=True)
class GapRevolution(Generic[Seen]):
    """A gap whose turn closes: the turn, and how it was found (turns, changes a turn, multipliers).

    warmth: temperatures over the turn, None where they are not solved.
    """

    turn: GapTurn[Seen]
    closing: Periodic[GapTurn[Seen]] = field(repr=False)
    films_solved: int
    seconds: float
    warmth: Warmth | None = None

    @property
    def angles(self) -> Array:
        """Reported shaft angles (n,) rad."""
        return np.array([instant.angle for instant in self.turn.instants])

    @property
    def positions(self) -> Array:
        """Positions (n, k) m."""
        return np.array([instant.position for instant in self.turn.instants])

    @property
    def least_film(self) -> GapInstant[Seen]:
        """The instant at which the film is thinnest."""
        return min(self.turn.instants, key=lambda instant: instant.loads.film_thickness_min)


def run_revolution(
    solver: FilmSolver,
    floating: Floating,
    schedule: Schedule,
    start: Array,
    look: Callable[[Stage], Seen],
    *,
    accuracy: Accuracy | None = None,
    method: Tableau = ALEXANDER_2,
    before: GapRevolution[Seen] | None = None,
    report: TurnReport = unheard,
) -> GapRevolution[Seen]:
    """The periodic motion of a gap whose drive repeats with the schedule's last angle.

    Starts as a full film at rest at `start` (k,) m, from which turns of wide steps lead next to the periodic
    motion, or goes on from a revolution `before` it; `look` tells what else to report of each angle. The steps of
    the first turn that stops at all angles are those of all that follow, so that the map of a turn is smooth.
    Afterwards each coordinate is as near to the periodic motion as `closed` says, and the oil in
    the film repeats as well. Raises FilmInputError for a schedule that does not rise from 0, FilmNotConverged with
    part and time where a step or the turn does not settle.
    """
    angles = np.concatenate([[0.0], schedule.angles])
    if len(angles) < 2 or not np.all(np.diff(angles) > 0.0) or not schedule.speed > 0.0:
        raise FilmInputError(
            "revolution", f"angles {schedule.angles[:5]} rad at {schedule.speed:g} rad/s", "rising"
        )
    began, accuracy = perf_counter(), accuracy or Accuracy()
    films, opening = 0, None if before is None else before.turn
    if opening is None:
        told = _told(report, "approach, turn")
        first = _Turns(solver, floating, schedule.wide, look, accuracy.rough, method, None, told)
        opening = periodic(first.turn, start).turn
        films = first.films_solved
    run = _Turns(solver, floating, schedule, look, accuracy, method, opening, _told(report, "turn"))
    closing = periodic(run.turn, opening.end)
    return GapRevolution(closing.turn, closing, films + run.films_solved, perf_counter() - began)


def _told(report: TurnReport, name: str) -> Callable[[int, float], None]:
    return lambda number, share: report(f"{name} {number}", share)


class _Turns(Generic[Seen]):
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
        """One turn from a start, on from what the turn before left in the film."""
        state = begin = self._begin(start, before or self._opening)
        again = before.times if before is not None and self._adaptive <= 0 else None
        self._adaptive -= 1
        instants: list[GapInstant[Seen]] = []
        films: dict[float, FilmSolution] = {}
        times, errors = [], []
        since: Passed[Seen] = Passed()
        for taken in self._marched(begin, again):
            state, stage = taken.state, taken.stage
            times.append(state.time)
            errors.append(self._excess(taken))
            angle = self._angles.get(state.time)
            # Turns that lead near the periodic motion tell of their last step alone.
            if angle is None and self._opening is None:
                continue
            seen = self._tell(taken.step, since)
            if angle is None:
                continue
            instants.append(_instant(angle, stage, state.rate, seen, since))
            since = Passed()
            if angle in self._kept:
                films[angle] = stage.solution
        end = instants[-1]
        return GapTurn(
            start=start,
            instants=tuple(instants),
            films=films,
            last=state,
            times=np.array(times),
            step_error=max(errors),
            allowed=self._accuracy.closed * end.mean_film,
            reach=self._accuracy.reach * end.loads.film_thickness_min,
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
                self._report(self._turn, reached / self._times[-1])
                yield taken
        except FilmNotConverged as reason:
            angle = np.degrees(self._speed * reached)
            raise FilmNotConverged(f"after {angle:.5g} deg: {reason.what}", reason.remedy) from None

    def _begin(self, start: Array, last: GapTurn[Seen] | None) -> State[Stage]:
        if last is None:
            begin = started(self._floating, 0.0, start)
            if self._floating.shape_at(0.0).walls is None:
                return begin
            return pressed(self._solver, self._floating, begin, SHORT * self._times[0])
        return restarted(self._floating, 0.0, last.last, start)

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


def _oil_moved(first: FilmSpace, begin: State[Stage], end: State[Stage]) -> float:
    """Oil that is elsewhere at the end, over all of it."""
    assert end.stage is not None
    oil = slice(len(end.stage.solution.pressure))
    came, went = end.held[oil][seats_of(first, end.stage.solution.problem.space)], begin.held[oil]
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
        least_gap=stage.least_gap,
        mean_film=float(np.sum(film.thickness * area) / np.sum(area)),
        loads=loads(stage.solution),
        seen=seen,
        passed=since.mean,
        pushed=since.mean_pushed,
    )
