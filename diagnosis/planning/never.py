"""Pairs of suspects that no point of a bench separates, and the reason."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from diagnosis.planning.apart import Apart, Contest, all_pairs
from diagnosis.planning.further_meters import FurtherMeter

NEARLY_ALL = 0.7
"""Of a suspect's distance from the null: a distance above it is limited by that, not by the form."""


class Reason(Enum):
    """Reason why no point separates two suspects."""

    UNSEEN = "one of the two hardly moves these readings"
    WEAK = "one of the two stands out too little for a difference to show"
    SAME_FORM = "both move these readings in the same way over the whole range"


@dataclass(frozen=True)
class Never:
    """A pair that no point separates: the reason, suspects without effect on readings, meters to separate it."""

    pair: tuple[int, int]
    reason: Reason
    unseen: tuple[int, ...]
    meters: tuple[FurtherMeter, ...]


def never_apart(
    contest: Contest, ever: Apart, counts: NDArray[np.int64], meters: Sequence[FurtherMeter], wanted: float
) -> tuple[Never, ...]:
    """Pairs that `ever`, by the readings `counts` (N,) of all points, leaves nearer than `wanted`: so do fewer
    readings.
    """
    distances, seen = ever.distances, np.sqrt(np.maximum(ever.seen, 0.0))
    with_meters = [one.added_to(contest).apart(counts) for one in meters]
    found = []
    for pair in all_pairs(len(contest.suspects)):
        unseen = tuple(at for at in pair if seen[at] < wanted)
        if distances[pair] >= wanted:
            continue
        helpful = tuple(one for one, apart in zip(meters, with_meters, strict=True) if apart.distances[pair] >= wanted)
        reason = Reason.WEAK if distances[pair] > NEARLY_ALL * min(seen[at] for at in pair) else Reason.SAME_FORM
        found.append(Never(pair, Reason.UNSEEN if unseen else reason, unseen, helpful))
    return tuple(found)
