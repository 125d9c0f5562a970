"""Solved part of a floating point: its rounds and the last revolution of each gap, also where a later film fails."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from gaps.films.reports import Reported
from gaps.revolution.march import GapRevolution, Leg
from system.description.gap import Gap
from system.films.drives import Drives
from system.films.parts import FloatingParts
from system.films.rotor import Rotor
from system.points.floating_gaps import FloatingOptions


@dataclass(frozen=True)
class Round:
    """One round of gaps and chamber.

    Changes by the round (as the tolerances count them), whether its turns close and agree with their temperatures,
    films solved, time s; time of its gaps on each leg, s, the sum of all processes.
    """

    pressure_change: float
    friction_change: float
    spin_change: float
    settled: bool
    films_solved: int
    seconds: float
    spent: Mapping[Leg, float]


@dataclass(frozen=True)
class GapsOfKind:
    """Equal chambers (from 0), their parts, and the drives of their gaps in a round."""

    chambers: tuple[int, ...]
    rotor: Rotor
    parts: FloatingParts
    drives: Drives


@dataclass(frozen=True)
class SolvedGap:
    """A gap over the turn, as the round of that number (from 1) solved it."""

    gap: Gap
    of: GapsOfKind
    options: FloatingOptions
    revolution: GapRevolution[Any]
    number: int


@dataclass
class Solved:
    """The complete rounds of a point, and the last revolution of each gap of each kind of chambers (from 0).

    A gap of the round under way has a number one above that of the complete rounds.
    """

    rounds: list[Round] = field(default_factory=list)
    gaps: dict[tuple[int, Gap], SolvedGap] = field(default_factory=dict)

    def keep(
        self, gap: Gap, kinds: Sequence[GapsOfKind], options: FloatingOptions, found: Iterable[GapRevolution[Reported]]
    ) -> list[GapRevolution[Reported]]:
        """The revolutions of a gap, one of each kind, each kept as soon as it is found."""
        kept = []
        for kind, revolution in enumerate(found):
            self.gaps[kind, gap] = SolvedGap(gap, kinds[kind], options, revolution, len(self.rounds) + 1)
            kept.append(revolution)
        return kept
