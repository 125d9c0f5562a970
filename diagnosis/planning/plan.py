"""Plan of a test: the planned campaign's distances between suspects, points and meters to add, inseparable pairs."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.explain.hypotheses import Hypothesis
from diagnosis.planning.apart import Contest, all_pairs
from diagnosis.planning.design import MANY, Asked, Desk, Equipped, Purpose
from diagnosis.planning.further_meters import MeterWorth, further_meters, meter_worths, read_at_points, with_beside
from diagnosis.planning.never import Never, never_apart
from diagnosis.planning.responses import Foreseen
from diagnosis.planning.suspects import Suspect, signs_of, suspects_of
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.work.progress import Report, silent


@dataclass(frozen=True)
class Plan:
    """A planned campaign: the pairs of S suspects that it separates, and points and meters to add.

    points: N, the planned first; planned, counts: readings at each (N,), as planned and with the added ones. before,
    after, ever: (S, S), sigma, by the planned campaign, with the added points, and with MANY readings at every point;
    seen: (S,), sigma from the null, with the added points. wanted: sigma from which a pair is separated. told_planned,
    told: such pairs, farther apart than the error of form of their laws (`Contest.told`). never: pairs that no point
    separates. worths: of further meters beside the campaign with its added points; equipped: the campaign with the
    proposed meters, None where none separates more; shows: the channel with the largest effect of each suspect.
    """

    points: BenchPoints
    planned: NDArray[np.int64]
    counts: NDArray[np.int64]
    channels: tuple[str, ...]
    suspects: tuple[Suspect, ...]
    before: Array
    after: Array
    ever: Array
    seen: Array
    wanted: float
    added: tuple[Purpose, ...]
    totals: tuple[float, ...]
    most: int
    told_planned: tuple[tuple[int, int], ...]
    told: tuple[tuple[int, int], ...]
    never: tuple[Never, ...]
    worths: tuple[MeterWorth, ...]
    equipped: Equipped | None
    shows: tuple[str, ...]

    @property
    def pairs(self) -> tuple[tuple[int, int], ...]:
        """Every pair of suspects."""
        return all_pairs(len(self.suspects))

    @property
    def open(self) -> tuple[tuple[int, int], ...]:
        """The pairs that points could separate, and the campaign with its added points does not."""
        settled = {*self.told, *(one.pair for one in self.never)}
        return tuple(pair for pair in self.pairs if pair not in settled)

    @property
    def is_spent(self) -> bool:
        """True if as many readings were added as were allowed: more would separate more."""
        return len(self.added) >= self.most > 0 and bool(self.open)


def plan_campaign(
    foreseen: Foreseen, asked: Asked, chosen: Sequence[Hypothesis], thresholds: Thresholds, report: Report = silent
) -> Plan:
    """The plan of a campaign for some hypotheses; `foreseen` holds the points of `asked`, in their order."""
    campaign = np.flatnonzero(asked.counts)
    suspects = suspects_of(foreseen, chosen, campaign, thresholds, asked.cost)
    read = read_at_points(asked.channels)
    contest = contest_of(foreseen, read, suspects)
    contest = with_beside(contest, foreseen, asked.channels, campaign, thresholds, report)
    everywhere = np.full(len(asked.counts), MANY)
    ever = contest.apart(everywhere)
    further = further_meters(foreseen, asked.channels, campaign, thresholds, report, asked.further)
    desk = Desk(foreseen, asked, thresholds, report)
    never = never_apart(contest, ever, everywhere, further, desk.wanted)
    own = desk.designed(contest, {one.pair for one in never})
    before = contest.apart(asked.counts)
    return Plan(
        points=asked.points,
        planned=asked.counts,
        counts=own.counts,
        channels=tuple(asked.channels),
        suspects=suspects,
        before=before.distances,
        after=own.apart.distances,
        ever=ever.distances,
        seen=np.sqrt(np.maximum(own.apart.seen, 0.0)),
        wanted=desk.wanted,
        added=own.added,
        totals=own.totals,
        most=asked.most,
        told_planned=desk.told(contest, before),
        told=own.told,
        never=never,
        worths=meter_worths(contest, frozenset(own.told), own.counts, further, desk.wanted, thresholds.form, report),
        equipped=desk.equipped(contest, own, further),
        shows=_shows(foreseen, contest, read),
    )


def contest_of(foreseen: Foreseen, channels: Collection[str], suspects: tuple[Suspect, ...]) -> Contest:
    """The suspects before a bench that reads these channels at each point."""
    widths = np.array([one.width for one in foreseen.candidates])
    return Contest(foreseen.responses.white(channels), suspects, widths, signs_of(foreseen.candidates))


def _shows(foreseen: Foreseen, contest: Contest, channels: Collection[str]) -> tuple[str, ...]:
    """The channel of the largest square of each suspect, over all points."""
    names = [one.name for one in foreseen.responses.readings.channels if one.name in channels]
    squares = np.sum((contest.white.columns @ contest.truths) ** 2, axis=0)
    return tuple(names[at] for at in np.argmax(squares, axis=0))
