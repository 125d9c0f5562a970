"""A gap over the revolution: its floating film marched from angle to angle until the turn closes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from time import perf_counter
from typing import Generic

import numpy as np

from gaps.revolution.schedule import Accuracy, Schedule
from gaps.revolution.turn import GapInstant, GapTurn, Seen, Turns
from gaps.revolution.warmth import Warmth
from reynolds.errors import FilmInputError
from reynolds.floating.problem import Floating
from reynolds.floating.step import Stage
from reynolds.numerics.arrays import Array
from reynolds.numerics.dirk import ALEXANDER_2, Tableau
from reynolds.numerics.shooting import Periodic, approached, periodic
from reynolds.solve.solver import FilmSolver

TurnReport = Callable[[str, float], None]
"""Hears of each step: which turn it is in, and the share of that turn that is done."""


def unheard(turn: str, share: float) -> None:
    """Report a turn's progress to nobody."""


class Leg(Enum):
    """A stretch of the way to a gap's motion, by the physics that it adds."""

    RIGID = "rigid"
    ELASTIC = "elastic"
    HEAT = "heat"


@dataclass(frozen=True)
class GapRevolution(Generic[Seen]):
    """A gap whose turn closes: the turn, and how it was found (turns, changes a turn, multipliers).

    spent: time (s) of each leg, of which elastic counts oil that pressure stiffens, too. warmth: temperatures over
    the turn, None where they are not solved.
    """

    turn: GapTurn[Seen]
    closing: Periodic[GapTurn[Seen]] = field(repr=False)
    films_solved: int
    spent: Mapping[Leg, float]
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
    def seconds(self) -> float:
        """Time (s) that it took."""
        return sum(self.spent.values())

    @property
    def bare(self) -> GapRevolution[Seen]:
        """The same without its last film and oil: what goes on from it starts as a full film where it ended."""
        turn = replace(self.turn, oil=(), last=replace(self.turn.last, stage=None))
        return replace(self, turn=turn, closing=replace(self.closing, turn=turn))

    @property
    def least_film(self) -> GapInstant[Seen]:
        """The instant at which the film is thinnest."""
        return min(self.turn.instants, key=lambda instant: instant.film_thickness_min)


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
    motion, or goes on from a revolution `before` it, of a full film where that has no last one; `look` tells what
    else to report of each angle. The steps of the first turn that stops at all angles are those of all that
    follow, so that the map of a turn is smooth. Afterwards each coordinate is as near to the periodic motion as
    `closed` says, and the oil in the film repeats as well. Raises FilmInputError for a schedule that does not rise
    from 0, FilmNotConverged with part and time where a step or the turn does not settle.
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
        first = Turns(solver, floating, schedule.wide, look, accuracy.rough, method, None, told)
        opening = approached(first.turn, start)
        films = first.films_solved
    run = Turns(solver, floating, schedule, look, accuracy, method, opening, _told(report, "turn"))
    closing = periodic(run.turn, opening.end)
    leg = Leg.RIGID if floating.shape_at(0.0).walls is None else Leg.ELASTIC
    spent = {leg: perf_counter() - began}
    return GapRevolution(closing.turn, closing, films + run.films_solved, spent)


def _told(report: TurnReport, name: str) -> Callable[[int, float], None]:
    return lambda number, share: report(f"{name} {number}", share)
