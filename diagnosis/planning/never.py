"""Pairs of suspects that no point of a bench tells apart, and why."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from diagnosis.planning.apart import Apart, Contest, all_pairs
from diagnosis.planning.further_meters import FurtherMeter
from diagnosis.thresholds import Thresholds


class Reason(Enum):
    """Why no point tells two suspects apart."""

    UNSEEN = "one of the two hardly moves these readings"
    SAME_FORM = "both move these readings in the same way over the whole range"
    NEAR_FORM = "they differ by less than their laws are true"


@dataclass(frozen=True)
class Never:
    """A pair that no point tells apart: why, the suspects that are not seen at all, and meters that would tell."""

    pair: tuple[int, int]
    reason: Reason
    unseen: tuple[int, ...]
    meters: tuple[FurtherMeter, ...]


def never_apart(
    contest: Contest,
    ever: Apart,
    counts: NDArray[np.int64],
    meters: Sequence[FurtherMeter],
    wanted: float,
    thresholds: Thresholds,
) -> tuple[Never, ...]:
    """Pairs that `ever`, by the readings `counts` (N,) of all points, leaves nearer than `wanted`.

    Or nearer than laws are true: d^2 below the share of its own square that a law off by a tenth leaves
    (`form.true_to`; `form.placed_by` for one effect at two places), which no further reading mends.
    """
    distances, seen = ever.distances, np.sqrt(np.maximum(ever.seen, 0.0))
    with_meters = [one.added_to(contest).apart(counts) for one in meters]
    found = []
    for pair in all_pairs(len(contest.suspects)):
        unseen = tuple(at for at in pair if seen[at] < wanted)
        near = distances[pair] < _form(contest, ever, pair, thresholds)
        if distances[pair] >= wanted and not near:
            continue
        reason = Reason.NEAR_FORM if distances[pair] >= wanted else Reason.SAME_FORM
        helpful = tuple(
            one
            for one, apart in zip(meters, with_meters, strict=True)
            if apart.distances[pair] >= max(wanted, _form(contest, apart, pair, thresholds))
        )
        found.append(Never(pair, Reason.UNSEEN if unseen else reason, unseen, helpful))
    return tuple(found)


def _form(contest: Contest, apart: Apart, pair: tuple[int, int], thresholds: Thresholds) -> float:
    """Sigma that the error of form of two laws leaves between them."""
    one, other = (contest.suspects[at] for at in pair)
    share = thresholds.form.placed_by if one.effect is other.effect else thresholds.form.true_to
    return float(np.sqrt(share * max(float(min(apart.seen[at] for at in pair)), 0.0)))
