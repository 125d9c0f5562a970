"""Plan of a test: the planned campaign's distances between suspects, points and sensors to add, what is never told."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from math import sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from diagnosis.explain.hypotheses import Hypothesis
from diagnosis.next_point.discrimination import Added, added_points
from diagnosis.next_point.operating_box import rows
from diagnosis.planning.apart import Contest, PairCampaign, all_pairs
from diagnosis.planning.further_meters import FurtherMeter, MeterWorth, further_meters, meter_worths
from diagnosis.planning.never import Never, never_apart
from diagnosis.planning.responses import Foreseen
from diagnosis.planning.suspects import COST, Suspect, signs_of, suspects_of
from diagnosis.thresholds import NextPointLimits, Thresholds
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.work.progress import Report, silent

LEAST = 0.1
"""Nats over all pairs that a further reading has to promise: a forty-fifth of what one pair needs."""
MANY = 20
"""Readings at every possible point: what they do not tell apart, no campaign does."""


@dataclass(frozen=True)
class Asked:
    """A campaign as planned, and what may be added to it.

    planned: points as they are to be driven, with their readings `repeats`; possible: points that may be added;
    channels: those of the bench; most: readings to add at most; cost: of efficiency, the size of every suspect; apart:
    sigma from which on a pair is told, None: `wanted_distance`; aim: sigma up to which a pair draws readings, if more.
    """

    planned: BenchPoints
    repeats: NDArray[np.int64]
    possible: BenchPoints
    channels: Collection[str]
    most: int
    cost: float = COST
    apart: float | None = None
    aim: float = 0.0

    @property
    def points(self) -> BenchPoints:
        """The planned points, then the possible ones, each at its place in a mixed order."""
        one, other = vars(self.planned), vars(self.possible)
        return BenchPoints(**{name: np.concatenate([own, other[name]]) for name, own in one.items()})

    @property
    def counts(self) -> NDArray[np.int64]:
        """(N,), readings at each of `points` as planned."""
        return np.concatenate([self.repeats, np.zeros(len(self.possible.speed), dtype=np.int64)])


@dataclass(frozen=True)
class Purpose:
    """An added reading: its point, and the pairs that it moves most."""

    point: int
    pairs: tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class Plan:
    """A planned campaign: the pairs of S suspects that it tells apart, and points and meters to add.

    points: N, the planned first; planned, counts: readings at each (N,), as asked and with the added. before, after,
    ever: (S, S), sigma, by the planned campaign, with the added points, and with MANY readings at every point; seen:
    (S,), sigma from nothing at all, with the added points. wanted: sigma from which on a pair is apart. told_planned,
    told: pairs that are, and farther than their laws are true (`Contest.told`). never: pairs that no point tells apart.
    worths: of further meters beside the campaign with its added points; shows: the channel in which each suspect shows
    most.
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
    shows: tuple[str, ...]

    @property
    def pairs(self) -> tuple[tuple[int, int], ...]:
        """Every pair of suspects."""
        return all_pairs(len(self.suspects))

    @property
    def open(self) -> tuple[tuple[int, int], ...]:
        """The pairs that points could tell apart, and the campaign with its added points does not."""
        settled = {*self.told, *(one.pair for one in self.never)}
        return tuple(pair for pair in self.pairs if pair not in settled)

    @property
    def is_spent(self) -> bool:
        """True if as many readings were added as were allowed: more would tell more."""
        return len(self.added) >= self.most > 0 and bool(self.open)


def wanted_distance(limits: NextPointLimits) -> float:
    """Distance in sigma at which odds of `odds` to 1 for the true of two are reached with the chance `promised`.

    ln odds are normal, of mean d^2/2 and sigma d: d^2/2 - z d = ln odds.
    """
    z = float(ndtri(limits.promised))
    return z + sqrt(z**2 + 2.0 * limits.settled)


def plan_campaign(
    foreseen: Foreseen,
    asked: Asked,
    chosen: Sequence[Hypothesis],
    thresholds: Thresholds,
    report: Report = silent,
    meters: Sequence[FurtherMeter] | None = None,
) -> Plan:
    """The plan of a campaign for some hypotheses; `foreseen` holds the points of `asked`, in their order.

    meters: further ones that are weighed; all that the bench lacks where None.
    """
    limits, counts, campaign = thresholds.next_point, asked.counts, np.flatnonzero(asked.counts)
    suspects = suspects_of(foreseen, chosen, campaign, thresholds, asked.cost)
    contest = contest_of(foreseen, asked.channels, suspects)
    wanted = wanted_distance(limits) if asked.apart is None else asked.apart
    everywhere = np.full(len(counts), MANY)
    ever = contest.apart(everywhere)
    weighed = further_meters(foreseen, asked.channels, campaign, thresholds, report) if meters is None else meters
    never = never_apart(contest, ever, everywhere, weighed, wanted)
    pairs = tuple(pair for pair in all_pairs(len(suspects)) if pair not in {one.pair for one in never})
    rivals = PairCampaign(contest, pairs, max(wanted, asked.aim))
    added = added_points(rivals, counts, np.maximum(counts, limits.readings), asked.most, LEAST, report)
    reached = counts + np.bincount(added.points, minlength=len(counts)).astype(np.int64)
    before, after = contest.apart(counts), contest.apart(reached)
    told_planned, told = (_pairs(contest.told(one, wanted, thresholds.form)) for one in (before, after))
    return Plan(
        points=asked.points,
        planned=counts,
        counts=reached,
        channels=tuple(asked.channels),
        suspects=suspects,
        before=before.distances,
        after=after.distances,
        ever=ever.distances,
        seen=np.sqrt(np.maximum(after.seen, 0.0)),
        wanted=wanted,
        added=_purposes(rivals, counts, added),
        totals=added.totals,
        most=asked.most,
        told_planned=told_planned,
        told=told,
        never=never,
        worths=meter_worths(contest, frozenset(told), reached, weighed, wanted, thresholds.form, report),
        shows=_shows(foreseen, contest, asked.channels),
    )


def contest_of(foreseen: Foreseen, channels: Collection[str], suspects: tuple[Suspect, ...]) -> Contest:
    """The suspects before a bench with these channels."""
    widths = np.array([one.width for one in foreseen.candidates])
    return Contest(foreseen.responses.white(channels), suspects, widths, signs_of(foreseen.candidates))


def _pairs(told: NDArray[np.bool_]) -> tuple[tuple[int, int], ...]:
    return tuple(pair for pair in all_pairs(len(told)) if told[pair])


def _shows(foreseen: Foreseen, contest: Contest, channels: Collection[str]) -> tuple[str, ...]:
    """The channel of the largest square of each suspect, over all points."""
    names = [one.name for one in foreseen.responses.readings.channels if one.name in channels]
    squares = np.sum((contest.white.columns @ contest.truths) ** 2, axis=0)
    return tuple(names[at] for at in np.argmax(squares, axis=0))


def _purposes(campaign: PairCampaign, counts: NDArray[np.int64], added: Added) -> tuple[Purpose, ...]:
    """The added readings, each with the one or two pairs that it moves most."""
    found, now = [], counts.copy()
    levels = np.minimum(campaign.levels(now), campaign.enough)
    for point in added.points:
        now[point] += 1
        moved = np.minimum(campaign.levels(now), campaign.enough)
        rise = moved - levels
        first = [at for at in np.argsort(-rise)[:2] if rise[at] > 0.25 * rise.max() > 0.0]
        found.append(Purpose(point, tuple(campaign.pairs[at] for at in first)))
        levels = moved
    return tuple(found)


def driven(plan: Plan) -> NDArray[np.int64]:
    """The points to drive, by their place in the mixed order."""
    own = np.flatnonzero(plan.counts)
    return np.asarray(own[np.argsort(plan.points.order[own], kind="stable")], dtype=np.int64)


def readings_of(plan: Plan) -> BenchPoints:
    """Every reading of the campaign as a point of its own, in the order in which they are driven.

    The readings of one point stand at even distances in the order, so that a drift shows between them.
    """
    turns = [
        (plan.points.order[at] + turn / plan.counts[at]) % 1.0
        for at in driven(plan)
        for turn in range(int(plan.counts[at]))
    ]
    which = np.repeat(driven(plan), plan.counts[driven(plan)])
    found = rows(plan.points, which[np.argsort(turns, kind="stable")])
    return replace(found, order=np.arange(len(which), dtype=float))


def spread_order(count: int, begin: int = 0) -> Array:
    """(count,), places from 0 to 1 in a mixed order: the multiples of the golden ratio, no two near each other."""
    golden = 0.5 * (sqrt(5.0) - 1.0)
    return np.asarray((golden * np.arange(begin, begin + count)) % 1.0)
