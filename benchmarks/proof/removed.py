"""Share of the explainable residual that a claimed fit removes, on points held out."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

import numpy as np

from .outcome import Outcome

LEAST = 0.2  # of the noise's square, over the channels: below it one case has nothing to remove
DRAWS = 2000
Floor = Mapping[tuple[str, str], float]


def excess(one: Outcome) -> tuple[float, float]:
    """Mean squares beyond the noise stated, before and after, summed over the channels, in its square."""
    return _beyond(one, dict.fromkeys(((one.campaign, channel) for channel in one.heldout), 1.0))


def removed(one: Outcome) -> float:
    """1 - (after^2 - noise^2)/(before^2 - noise^2) over all channels in their noise."""
    before, after = excess(one)
    return 1.0 - max(after, 0.0) / before


def left_by_nothing(nulls: Sequence[Outcome]) -> Floor:
    """Mean square, in the noise stated, that nulls of a campaign leave in a channel: no law can remove it."""
    found = defaultdict(list)
    for one in nulls:
        for channel, (_, after, noise) in one.heldout.items():
            found[one.campaign, channel].append((after / noise) ** 2)
    return {place: float(np.mean(squares)) for place, squares in found.items()}


def removed_of_all(cases: Sequence[Outcome], floor: Floor) -> tuple[float, float, float]:
    """1 - sum of after over sum of before, beyond the floor; its 95 % interval over draws of cases."""
    each = np.array([_beyond(one, floor) for one in cases])
    drawn = np.random.default_rng(0).integers(len(each), size=(DRAWS, len(each)))
    before, after = np.moveaxis(each[drawn].sum(axis=1), 1, 0)
    low, high = np.quantile(1.0 - after / before, (0.025, 0.975))
    return float(1.0 - each[:, 1].sum() / each[:, 0].sum()), float(low), float(high)


def _beyond(one: Outcome, floor: Floor) -> tuple[float, float]:
    before, after = (
        sum((told[k] / told[2]) ** 2 - floor[one.campaign, channel] for channel, told in one.heldout.items())
        for k in (0, 1)
    )
    return before, after
