"""The finding with the known law: the truth's own fit, and its residual at points held out."""

from __future__ import annotations

from functools import reduce

import numpy as np

from diagnosis.explain.held_out import held_out
from diagnosis.explain.hypotheses import together
from diagnosis.explain.ranked import Explanation
from diagnosis.explain.refit import refit
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from diagnosis.verdict.diagnosis import Diagnosis
from reynolds.errors import NotConverged

from .outcome import Outcome


def is_of_truth(weighed: Explanation, expected: Outcome) -> bool:
    """Whether an explanation is the truth: its effects, each at its gap where both name one."""
    own = weighed.hypothesis
    if own.other_form or own.component is not None or len(own.effects) != len(expected.effects):
        return False
    places = [place.value if place else None for place in own.places]
    told = sorted(zip((effect.value for effect in own.effects), places, strict=True), key=str)
    true = sorted(zip(expected.effects, expected.pairs, strict=True), key=str)
    return all(
        one == other and (gap is None or pair is None or gap == pair)
        for (one, gap), (other, pair) in zip(told, true, strict=True)
    )


def oracle(study: Study, found: Diagnosis, expected: Outcome, thresholds: Thresholds) -> dict[str, float]:
    """Channel -> rms held out, SI, by the fit of the truth's law; empty where no law of this program is the truth."""
    fitted = _truth(study, found, expected, thresholds)
    if fitted is None or fitted.posterior is None:
        return {}
    left = held_out(study, found.before, fitted.posterior, thresholds).after
    return {channel.value: rms for channel, rms in left.items()}


def _truth(study: Study, found: Diagnosis, expected: Outcome, thresholds: Thresholds) -> Explanation | None:
    """The truth's explanation, refitted here where the diagnosis did not."""
    if not expected.effects:
        return None
    known = [each for each in found.hypotheses if is_of_truth(each, expected)]
    best = max(known, key=lambda each: (not each.linear, each.log_weight), default=None)
    if best is not None and best.posterior is not None:
        return best
    hypothesis = best.hypothesis if best is not None else None
    if hypothesis is None:
        single = [_single(found, effect, pair) for effect, pair in zip(expected.effects, expected.pairs, strict=True)]
        if len(single) < 2 or None in single:
            return None
        hypothesis = reduce(
            lambda one, other: together(one, other, thresholds.prior.pair_penalty),
            [each.hypothesis for each in single if each is not None],
        )
    try:
        return refit(study, hypothesis, thresholds, np.inf)
    except NotConverged:
        return None


def _single(found: Diagnosis, effect: str, pair: str | None) -> Explanation | None:
    """The likeliest explanation that is this effect alone."""
    alone = [
        each
        for each in found.hypotheses
        if [one.value for one in each.hypothesis.effects] == [effect]
        and not each.hypothesis.other_form
        and (each.hypothesis.pair is None or each.hypothesis.pair.value == pair)
    ]
    return max(alone, key=lambda each: each.log_weight, default=None)
