"""A gap over the revolution: its floating film marched from angle to angle until the turn closes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from time import perf_counter
from typing import Generic

import numpy as np

from gaps.films.reports import Reported, drawn
from gaps.revolution.course import GapInstant, Value
from gaps.revolution.schedule import Accuracy, Schedule
from gaps.revolution.turn import GapTurn, Turns
from gaps.revolution.warmth import GapTemperatures
from reynolds.errors import FilmInputError
from reynolds.floating.problem import Floating
from reynolds.floating.stage import FloatingStage
from reynolds.numerics.arrays import Array
from reynolds.numerics.dirk import ALEXANDER_2, Tableau
from reynolds.numerics.shooting import PeriodicTurn, approached, one_turn, periodic
from reynolds.solve.solver import FilmSolver

TurnReport = Callable[[str, float], None]
"""Progress callback: name of the turn, and the fraction of it that is done."""


def no_report(turn: str, share: float) -> None:
    """Ignore a turn's progress."""


class Leg(Enum):
    """A stage of the solution of a gap's motion, by the physics that it adds."""

    RIGID = "rigid"
    ELASTIC = "elastic"
    HEAT = "heat"


@dataclass(frozen=True)
class GapRevolution(Generic[Value]):
    """A gap whose turn closes: the turn, and its solution (turns, changes a turn, multipliers).

    spent: time (s) of each leg; elastic includes pressure-dependent viscosity. warmth: temperatures over
    the turn, None where they are not solved.
    """

    turn: GapTurn[Value]
    closing: PeriodicTurn[GapTurn[Value]] = field(repr=False)
    films_solved: int
    spent: Mapping[Leg, float]
    warmth: GapTemperatures | None = None

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
        """Total time (s)."""
        return sum(self.spent.values())

    @property
    def bare(self) -> GapRevolution[Value]:
        """The same without its last stage, its oil and its warmed films: a march from it starts with its final film."""
        turn = replace(self.turn, oil=(), last=replace(self.turn.last, stage=None))
        warmth = None if self.warmth is None else replace(self.warmth, films=())
        return replace(self, turn=turn, closing=replace(self.closing, turn=turn), warmth=warmth)

    @property
    def mean_film(self) -> float:
        """Film thickness over area and turn, m."""
        return float(np.mean([instant.mean_film for instant in self.turn.instants]))

    @property
    def least_film(self) -> GapInstant[Value]:
        """The instant at which the film is thinnest."""
        return min(self.turn.instants, key=lambda instant: instant.film_thickness_min)


def run_revolution(
    solver: FilmSolver,
    floating: Floating,
    schedule: Schedule,
    start: Array,
    report_of: Callable[[FloatingStage], Value],
    *,
    accuracy: Accuracy | None = None,
    method: Tableau = ALEXANDER_2,
    before: GapRevolution[Value] | None = None,
    report: TurnReport = no_report,
) -> GapRevolution[Value]:
    """The periodic motion of a gap whose drive repeats with the schedule's last angle.

    Starts as a full film at rest at `start` (k,) m, from which turns of wide steps lead close to the periodic motion,
    or goes on from a revolution `before` it, from its `final` film where it has no last stage. `report_of` gives the
    report of each angle. The steps of the first turn that stops at all angles are those of all that follow, so that the
    map of a turn is smooth. Afterwards each coordinate is as near to the periodic motion as `closed` says, and the oil
    in the film repeats as well; where `accuracy` is not settled, one turn more has been run. Raises FilmInputError for
    a schedule that does not rise from 0, FilmNotConverged with part and time where a step or the turn does not settle.
    """
    angles = np.concatenate([[0.0], schedule.angles])
    if len(angles) < 2 or not np.all(np.diff(angles) > 0.0) or not schedule.speed > 0.0:
        raise FilmInputError("revolution", f"angles {schedule.angles[:5]} rad at {schedule.speed:g} rad/s", "rising")
    began, accuracy = perf_counter(), accuracy or Accuracy()
    films = 0
    if before is None:
        approach = _numbered(report, "approach, turn")
        first = Turns(solver, floating, schedule.wide, report_of, accuracy.rough, method, None, approach)
        near = (approached if accuracy.settled else one_turn)(first.turn, start)
        films = first.films_solved
    else:
        near = before.closing
    opening = near.turn
    run = Turns(solver, floating, schedule, report_of, accuracy, method, opening, _numbered(report, "turn"))
    closing = (periodic if accuracy.settled else one_turn)(run.turn, near.onward)
    leg = Leg.RIGID if floating.shape_at(0.0).walls is None else Leg.ELASTIC
    spent = {leg: perf_counter() - began}
    return GapRevolution(closing.turn, closing, films + run.films_solved, spent)


def _numbered(report: TurnReport, name: str) -> Callable[[int, float], None]:
    return lambda number, share: report(f"{name} {number}", share)


def mass_balance_error(revolution: GapRevolution[Reported]) -> float:
    """Oil that enters a gap over the turn and does not leave it, as a share of the flow between the reported angles.

    The march keeps its oil to round-off; the rest is the turn's lack of periodicity, and films that are
    extrapolated along their slopes (`Closeness`).
    """
    came = np.array([drawn(instant.passed) for instant in revolution.turn.instants])
    left = np.array([instant.passed.leakage for instant in revolution.turn.instants])
    passed = 0.5 * float(np.mean(np.abs(came)) + np.mean(np.abs(left)))
    return abs(float(np.mean(came) - np.mean(left))) / max(passed, 1e-300)
