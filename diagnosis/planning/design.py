"""Design of a campaign: readings to add at its points, with the available meters and with further ones."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from diagnosis.next_point.discrimination import Added, added_points
from diagnosis.planning.apart import Apart, Contest, PairCampaign, all_pairs
from diagnosis.planning.further_meters import FurtherMeter, read_at_points
from diagnosis.planning.responses import Foreseen
from diagnosis.planning.suspects import COST
from diagnosis.thresholds import NextPointLimits, Thresholds
from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.work.progress import Report, silent

LEAST = 0.02
"""Least predicted gain of a further reading over all pairs, nats: a three-hundredth of the need of one pair."""
MANY = 20
"""Readings at every possible point: pairs that they do not separate, no campaign separates."""


@dataclass(frozen=True)
class Asked:
    """A campaign as planned, and its possible additions.

    planned: points in the planned order, with their readings `repeats`; possible: points that may be added; channels:
    those of the bench; most: readings to add at most; cost: of efficiency, the size of every suspect; apart: sigma from
    which a pair is separated, None: `wanted_distance`; aim: sigma up to which a pair draws readings, if more; meters:
    largest number of further meters; further: names of those that the bench could add, None: all.
    """

    planned: BenchPoints
    repeats: NDArray[np.int64]
    possible: BenchPoints
    channels: Collection[str]
    most: int
    cost: float = COST
    apart: float | None = None
    aim: float = 0.0
    meters: int = 1
    further: Collection[str] | None = None

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
    """An added reading: its point, and the pairs that gain most."""

    point: int
    pairs: tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class Design:
    """Readings at each point (N,), the added ones, the total after each in nats, and the pairs that they separate."""

    counts: NDArray[np.int64]
    added: tuple[Purpose, ...]
    totals: tuple[float, ...]
    apart: Apart
    told: tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class Equipped:
    """The campaign with meters that the bench lacks: its readings at each point (N,), the same number at most.

    after: (S, S), sigma; told: separated pairs, farther apart than the error of form of their laws.
    """

    meters: tuple[FurtherMeter, ...]
    counts: NDArray[np.int64]
    added: tuple[Purpose, ...]
    after: Array
    told: tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class Desk:
    """Common parts of all designs of a plan: bench, question, thresholds."""

    foreseen: Foreseen
    asked: Asked
    thresholds: Thresholds
    report: Report = silent

    @property
    def wanted(self) -> float:
        """Sigma from which a pair is separated."""
        return wanted_distance(self.thresholds.next_point) if self.asked.apart is None else self.asked.apart

    def told(self, contest: Contest, apart: Apart) -> tuple[tuple[int, int], ...]:
        """The separated pairs."""
        found = contest.told(apart, self.wanted, self.thresholds.form)
        return tuple(pair for pair in all_pairs(len(found)) if found[pair])

    def rivals(self, contest: Contest, without: Collection[tuple[int, int]]) -> PairCampaign:
        """All pairs except some, for the choice of points."""
        pairs = tuple(pair for pair in all_pairs(len(contest.suspects)) if pair not in without)
        return PairCampaign(contest, pairs, max(self.wanted, self.asked.aim))

    def designed(self, contest: Contest, hopeless: Collection[tuple[int, int]]) -> Design:
        """The campaign with the points that separate the pairs that are not hopeless."""
        counts, rivals = self.asked.counts, self.rivals(contest, hopeless)
        allowed = np.maximum(counts, self.thresholds.next_point.readings)
        added = added_points(rivals, counts, allowed, self.asked.most, LEAST, self.report)
        reached = counts + np.bincount(added.points, minlength=len(counts)).astype(np.int64)
        apart = contest.apart(reached)
        return Design(reached, _purposes(rivals, counts, added), added.totals, apart, self.told(contest, apart))

    def equipped(self, contest: Contest, own: Design, further: Sequence[FurtherMeter]) -> Equipped | None:
        """The campaign with the best meters one after the other, its points chosen anew; None without further pairs.

        The best separates most pairs with the available points; of several the one by which all pairs gain most nats.
        """
        chosen: list[FurtherMeter] = []
        found = own
        while further and len(chosen) < self.asked.meters:
            best = max(further, key=lambda one: self._worth(one.added_to(contest), found.counts))
            contest = best.added_to(contest)
            redesigned = self.designed(contest, self._hopeless(contest))
            if len(redesigned.told) <= len(found.told):
                break
            chosen.append(best)
            found = redesigned
            read = {*read_at_points(self.asked.channels), *(one.name for one in chosen if one.white is not None)}
            further = [one.on(self.foreseen, read) for one in further if one is not best]
        if not chosen:
            return None
        return Equipped(tuple(chosen), found.counts, found.added, found.apart.distances, found.told)

    def _worth(self, contest: Contest, counts: NDArray[np.int64]) -> tuple[int, float]:
        """Pairs that readings at each point (N,) separate, and nats of all pairs."""
        return len(self.told(contest, contest.apart(counts))), self.rivals(contest, ()).total(counts)

    def _hopeless(self, contest: Contest) -> set[tuple[int, int]]:
        """The pairs that no point separates."""
        distances = contest.apart(np.full(len(self.asked.counts), MANY)).distances
        return {pair for pair in all_pairs(len(distances)) if distances[pair] < self.wanted}


def wanted_distance(limits: NextPointLimits) -> float:
    """Distance in sigma at which odds of `odds` to 1 for the true of two are reached with the chance `promised`.

    ln odds are normal, of mean d^2/2 and sigma d: d^2/2 - z d = ln odds.
    """
    z = float(ndtri(limits.promised))
    return z + sqrt(z**2 + 2.0 * limits.settled)


def _purposes(campaign: PairCampaign, counts: NDArray[np.int64], added: Added) -> tuple[Purpose, ...]:
    """The added readings, each with the one or two pairs that gain most."""
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


def driven(counts: NDArray[np.int64], points: BenchPoints) -> NDArray[np.int64]:
    """The points to drive of so many readings at each (N,), by their place in the mixed order."""
    own = np.flatnonzero(counts)
    return np.asarray(own[np.argsort(points.order[own], kind="stable")], dtype=np.int64)


def reading_order(counts: NDArray[np.int64], points: BenchPoints) -> NDArray[np.int64]:
    """The point of every reading of a campaign, in the order in which they are driven.

    The readings of one point stand at even distances in the order, so that a drift is visible between them.
    """
    own = driven(counts, points)
    turns = [(points.order[at] + turn / counts[at]) % 1.0 for at in own for turn in range(int(counts[at]))]
    return np.asarray(np.repeat(own, counts[own])[np.argsort(turns, kind="stable")], dtype=np.int64)


def spread_order(count: int, begin: int = 0) -> Array:
    """(count,), places from 0 to 1 in a mixed order: the multiples of the golden ratio, no two near each other."""
    golden = 0.5 * (sqrt(5.0) - 1.0)
    return np.asarray((golden * np.arange(begin, begin + count)) % 1.0)
