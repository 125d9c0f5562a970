"""Points that separate explanations, several at a time: the predicted gain of each, and the choice among them.

A pair of explanations has a level, the mean ln odds of the true one by all readings so far. The predicted gain of a
point is

    sum over pairs of min(level + gain, wanted) - min(level, wanted)

with the gain of readings there (`forecast.Forecast.gain`: the divergence of Box and Hill 1967; where both explanations
are equally uncertain, half the squared distance of T-optimality, Atkinson and Fedorov 1975). The bound keeps a decided
pair from drawing more readings. Points are chosen one after the other, each by its gain beside those before it, then
exchanged for better ones as long as the sum grows (Fedorov 1972).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array
from system.work.progress import Report, silent

ROUNDS = 2
"""Of exchanges, each over all added points."""
SLACK = 1e-9
"""Relative gain of an exchange below which the point stays."""


def promise(levels: Array, gains: Array, wanted: float) -> Array:
    """(N,), nats of a reading at each of N points for P pairs of levels (P,) by its gains (P, N), bounded."""
    bounded = np.minimum(levels[:, None] + gains, wanted) - np.minimum(levels, wanted)[:, None]
    return np.asarray(bounded.sum(axis=0), dtype=float)


class Campaign(Protocol):
    """Pairs of explanations beside a campaign whose points are counted."""

    def total(self, counts: NDArray[np.int64]) -> float:
        """Sum over the pairs of their levels in nats, each up to the required one, by so many readings (N,)."""
        ...

    def promised(self, counts: NDArray[np.int64]) -> Array:
        """(N,), `promise` of one reading more at each point."""
        ...


@dataclass(frozen=True)
class Added:
    """Readings added to a campaign: the points in the order of their choice, the total after each, nats.

    totals: (len(points) + 1,), the first without any.
    """

    points: tuple[int, ...]
    totals: tuple[float, ...]


def added_points(
    campaign: Campaign,
    counts: NDArray[np.int64],
    allowed: NDArray[np.int64],
    most: int,
    least: float,
    report: Report = silent,
) -> Added:
    """At most `most` readings added to `counts` (N,), no point beyond `allowed` (N,), until the best gains < `least`.

    Nats; the total never falls.
    """
    now, chosen = counts.copy(), []
    for number in range(most):
        report(number, most, "points are chosen")
        best = _best(campaign, now, allowed)
        if best is None or best[1] < least:
            break
        chosen.append(best[0])
        now[best[0]] += 1
    chosen = _exchanged(campaign, counts, allowed, chosen, report)
    totals, so_far = [campaign.total(counts)], counts.copy()
    for point in chosen:
        so_far[point] += 1
        totals.append(campaign.total(so_far))
    return Added(tuple(chosen), tuple(totals))


def _best(campaign: Campaign, counts: NDArray[np.int64], allowed: NDArray[np.int64]) -> tuple[int, float] | None:
    """The point of the largest gain that may be read once more, or None."""
    promised = np.where(counts < allowed, campaign.promised(counts), -np.inf)
    at = int(np.argmax(promised))
    return (at, float(promised[at])) if np.isfinite(promised[at]) else None


def _exchanged(
    campaign: Campaign, counts: NDArray[np.int64], allowed: NDArray[np.int64], chosen: list[int], report: Report
) -> list[int]:
    """The chosen points, each exchanged for another that is better beside all others, until none is."""
    now = counts + np.bincount(chosen, minlength=len(counts)) if chosen else counts
    total = campaign.total(now)
    for turn in range(ROUNDS):
        report(turn, ROUNDS, "points are exchanged")
        moved = False
        for place, point in enumerate(chosen):
            without = now.copy()
            without[point] -= 1
            best = _best(campaign, without, allowed)
            if best is None or best[0] == point:
                continue
            without[best[0]] += 1
            reached = campaign.total(without)
            if reached > total * (1.0 + SLACK):
                now, total, moved = without, reached, True
                chosen = [*chosen[:place], best[0], *chosen[place + 1 :]]
        if not moved:
            break
    return chosen
