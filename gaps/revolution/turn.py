"""One turn of a floating gap: marched from angle to angle, or until it joins the turn before."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import Generic

import numpy as np
from numpy.typing import NDArray

from gaps.revolution.course import SAME, Course, GapInstant, Passed, Value, instant_of_stage
from gaps.revolution.schedule import Accuracy, Schedule
from gaps.revolution.stopped import TurnStopped
from reynolds.errors import FilmNotConverged
from reynolds.floating.problem import Floating
from reynolds.floating.stage import FloatingStage
from reynolds.floating.start import places_of, pressed, restarted, started
from reynolds.floating.step import InitialFilm, solve_stage
from reynolds.numerics.arrays import Array
from reynolds.numerics.dirk import AcceptedStep, State, Tableau, integrate, nodes_only
from reynolds.problem import FilmSolution
from reynolds.solve.solver import FilmSolver

MET = 0.1  # of the distance at which a turn counts as closed: near enough to join the turn before
SHORT = 1e-2  # of the first way to a node: a step in which elastic walls deform under their first load
TOO_COARSE = 3.0  # times its tolerance: an error at which steps of an earlier turn are chosen anew
ROUGH_ROOM = 0.1  # of the mean film, between rough walls
SHORTEST = 3e-5  # of a turn: a step in which a part without mass may jump, as a cavity under it fills
FARTHEST = 2e-2  # of the film's length, by which a wall may leave its shape: then nothing is thin, no tilt small


@dataclass(frozen=True)
class GapTurn(Generic[Value]):
    """One turn: its start q, its instants, kept films by angle with the deformation that is in their shape, its end.

    oil: (size,) m3 of each unknown at each reported angle; final: film at its end, on the mesh of its start; times (s)
    of its steps; step_error: largest error of a step over the allowed one, without jumps; accuracy: that allowance,
    share of the film; allowed, reach, repeats: as `reynolds.numerics.shooting.Turn` has them.
    """

    start: Array
    instants: tuple[GapInstant[Value], ...]
    films: dict[float, FilmSolution] = field(repr=False)
    oil: tuple[Array, ...] = field(repr=False)
    last: State[FloatingStage] = field(repr=False)
    final: InitialFilm = field(repr=False)
    times: Array = field(repr=False)
    step_error: float
    accuracy: float
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
    """Turns of one gap, each from a start, and their count."""

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
        self._nodes, self._speed = schedule.nodes, schedule.speed
        self._shortest = SHORTEST * 2.0 * np.pi / schedule.speed
        self._angles, self._kept = schedule.angles, set(schedule.kept)
        self._adaptive = 2 if opening is None else 1  # turns left that choose their steps
        self._steps: Array | None = None
        if opening is not None and opening.accuracy == accuracy.step and np.isin(self._nodes, opening.times).all():
            self._adaptive, self._steps = 0, opening.times
        self._progress, self._turn = progress, 0
        self._solved: deque[FloatingStage] = deque(maxlen=len(method.matrix))  # of the step taken last
        self.films_solved = 0

    def turn(self, start: Array, before: GapTurn[Value] | None) -> GapTurn[Value]:
        """One turn from a start, with the oil that the turn before left in the film.

        Once the film agrees with that turn, and that turn ended close to its start, the rest of it is adopted.
        """
        state = begin = self._begin(start, before or self._opening)
        joins = before is not None and bool(np.abs(before.end - start).max() <= before.allowed)
        gathered: _Gathered[Value] = _Gathered()
        since: Passed[Value] = Passed()
        behind: GapInstant[Value] | None = None
        for taken in self._marched(begin):
            state = taken.state
            if taken.step > self._shortest:
                gathered.step(state, self._excess(taken))
            else:
                gathered.jump(state, float(np.abs(taken.stage.moved(taken.error)).max()))
            angles = self._within(state.time - taken.step, state.time)
            # Turns that approach the periodic motion report their last step alone.
            if self._opening is None and not len(angles):
                continue
            course = self._course(taken, behind)
            behind, began = course.end, state.time - taken.step
            for angle in angles:
                course.passed(began, began := angle / self._speed, since)
                gathered.add(course.at(angle, since), taken.stage, course.oil(angle), kept=angle in self._kept)
                since = Passed()
            course.passed(began, state.time, since)
            if len(angles) and joins and before is not None and gathered.meets(before, self._accuracy.closed):
                state = gathered.join(before)
                break
        self._choose(gathered)
        end, places = gathered.instants[-1], self._places(state)
        return GapTurn(
            start=start,
            instants=tuple(gathered.instants),
            films=gathered.films,
            oil=tuple(gathered.oil),
            last=state,
            final=_film_at_end(places, state),
            times=np.array(gathered.times),
            step_error=max(gathered.errors),
            accuracy=self._accuracy.step,
            allowed=max(self._accuracy.closed * end.mean_film, gathered.jumped),
            reach=self._accuracy.reach * self._room(end),
            repeats=_oil_moved(places, begin, state) <= self._accuracy.closed,
        )

    def _places(self, end: State[FloatingStage]) -> NDArray[np.intp]:
        """The unknown (size,) at the end of a turn that is in the place of each at its start."""
        assert end.stage is not None
        return places_of(self._floating.shape_at(0.0).space, end.stage.instant.shape.space).unknowns

    def _initial(self, last: GapTurn[Value]) -> InitialFilm | None:
        """The final film of a turn of another drive; None on another mesh, on which a full film starts."""
        return last.final if len(last.final.pressure) == self._floating.shape_at(0.0).space.size else None

    def _room(self, end: GapInstant[Value]) -> float:
        """Film (m) at the end of a turn that the next start may use up: rough walls bear where they come too near."""
        rough = self._floating.shape_at(0.0).asperities is not None
        return max(end.film_thickness_min, ROUGH_ROOM * end.mean_film if rough else 0.0)

    def _within(self, began: float, ended: float) -> Array:
        """Reported angles (rad) after one time (s) and up to another."""
        first, last = np.searchsorted(self._angles, self._speed * np.array([began, ended]) * (1.0 + SAME), side="right")
        return self._angles[first:last]

    def _course(self, taken: AcceptedStep[FloatingStage], behind: GapInstant[Value] | None) -> Course[Value]:
        """The gap over a step: at its stages, and at the end of the step before if that is known."""
        stages = tuple(self._solved)
        instants = tuple(instant_of_stage(self._speed * stage.time, stage, self._report_of(stage)) for stage in stages)
        return Course(behind, instants, tuple(stage.holds for stage in stages), taken.step, self._speed)

    def _choose(self, gathered: _Gathered[Value]) -> None:
        """Choose the steps of the next turn: those of this one once settled, while they are fine enough."""
        self._adaptive -= 1
        if max(gathered.errors) > TOO_COARSE:
            self._steps = None
        elif self._adaptive <= 0 and self._steps is None:
            self._steps = np.array(gathered.times)

    def _marched(self, begin: State[FloatingStage]) -> Iterator[AcceptedStep[FloatingStage]]:
        """Steps of a turn, chosen by their error or those of an earlier turn again."""
        if self._steps is None:
            steps = integrate(self._method, self._stage, begin, self._nodes, self._excess, self._shortest)
        else:
            steps = integrate(self._method, self._stage, begin, self._steps, nodes_only)
        reached = begin.time
        self._turn += 1
        try:
            for taken in steps:
                reached = taken.state.time
                _check_near(taken.stage)
                self._progress(self._turn, reached / self._nodes[-1])
                yield taken
        except FilmNotConverged as reason:
            angle = float(self._speed * reached)
            raise TurnStopped(f"after {np.degrees(angle):.5g} deg: {reason.what}", reason.remedy, angle) from None

    def _begin(self, start: Array, last: GapTurn[Value] | None) -> State[FloatingStage]:
        """The start of a turn; a cold one, or one of another drive (`opening`), first deforms under this load."""
        if last is None or last.last.stage is None:
            begin = started(self._floating, 0.0, start, None if last is None else self._initial(last))
        else:
            begin = restarted(self._floating, 0.0, last.last, start)
            if last is not self._opening:
                return begin
        if self._floating.shape_at(0.0).walls is None:
            return begin
        return pressed(self._solver, self._floating, begin, SHORT * self._angles[0] / self._speed)

    def _stage(
        self, time: float, before: Array, step: float, guess: Array, last: FloatingStage | None
    ) -> FloatingStage:
        close = self._accuracy.closeness
        stage = solve_stage(self._solver, self._floating, time, before, step, guess, last, close)
        self.films_solved += stage.films
        self._solved.append(stage)
        return stage

    def _excess(self, taken: AcceptedStep[FloatingStage]) -> float:
        """Largest error of the film by a step, over the allowed one there."""
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
        self.jumped = 0.0

    def step(self, state: State[FloatingStage], error: float) -> None:
        """One more step, with its error over the allowed one."""
        self.times.append(state.time)
        self.errors.append(error)

    def jump(self, state: State[FloatingStage], height: float) -> None:
        """One more step, the shortest, in which the film may jump by a height (m): no turn closes nearer than that."""
        self.times.append(state.time)
        self.errors.append(0.0)
        self.jumped = max(self.jumped, height)

    def add(self, instant: GapInstant[Value], stage: FloatingStage, oil: Array, *, kept: bool) -> None:
        """One more reported angle, with the state (held,) there; the film of a kept one is that of the stage."""
        self.instants.append(instant)
        self.oil.append(oil[: stage.instant.shape.space.size])
        if kept:
            self.films[instant.angle] = replace(stage.solution, deformation=stage.deformation)

    def meets(self, before: GapTurn[Value], closed: float) -> bool:
        """True if position and oil at the last reported angle are those of the turn before."""
        here = len(self.instants) - 1
        away = np.abs(self.instants[here].position - before.instants[here].position).max()
        return bool(away <= MET * before.allowed) and _moved(before.oil[here], self.oil[here]) <= closed

    def join(self, before: GapTurn[Value]) -> State[FloatingStage]:
        """Adopt the rest of the turn before; its end."""
        count, time, angle = len(self.instants), self.times[-1], self.instants[-1].angle
        self.instants += before.instants[count:]
        self.oil += before.oil[count:]
        self.films |= {at: film for at, film in before.films.items() if at > angle}
        self.times += [float(later) for later in before.times[before.times > time]]
        self.errors.append(before.step_error)
        return before.last


def _film_at_end(places: NDArray[np.intp], end: State[FloatingStage]) -> InitialFilm:
    """The film at the end of a turn, each unknown in its place at the start."""
    assert end.stage is not None
    film = end.stage.balanced
    return InitialFilm(film.pressure[places], film.film_fraction[places])


def _oil_moved(places: NDArray[np.intp], begin: State[FloatingStage], end: State[FloatingStage]) -> float:
    """Oil that differs in place at the end, over all."""
    return _moved(end.held[: len(places)][places], begin.held[: len(places)])


def _moved(came: Array, went: Array) -> float:
    """Oil that differs in place, over all."""
    return float(np.abs(came - went).sum() / np.abs(went).sum())
