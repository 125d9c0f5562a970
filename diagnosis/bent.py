"""Second effects that only stand in for the form of the first.

A law that is right in kind but not in form leaves a residual, and some second effect always takes up a part of it.
That effect is believed only if it does better than the first one's own pattern, bent smoothly over the map.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from diagnosis.map_axes import smooth_shapes
from diagnosis.repair import repair
from diagnosis.study import Study
from diagnosis.thresholds import Thresholds
from diagnosis.weighed import Weighed
from system.errors import NotConverged
from system.estimation.evidence import multiplier_evidence
from system.estimation.posterior import settled


def without_stand_ins(study: Study, weighed: Sequence[Weighed], thresholds: Thresholds) -> tuple[Weighed, ...]:
    """Explanations of one and more effects, those whose last effects are stand-ins cut to what they stand on.

    Of A + B, where A has a law and was refitted, B stands in if A bent does as well within the odds of a name.
    What is left is A with the evidence that the two have, or A bent, whichever is less: it claims A, and that its
    form is not all.
    """
    return tuple(_cut(study, each, weighed, thresholds) for each in weighed)


def bent_evidence(study: Study, weighed: Weighed, thresholds: Thresholds) -> float | None:
    """ln evidence of an explanation with what its laws add to the readings times 1 + Phi b.

    b as of unknown physics, linear about the refit. None for what was not refitted, and for what has no law.
    """
    posterior = weighed.posterior
    if posterior is None or not weighed.hypothesis.laws:
        return None
    try:
        added = repair(study, weighed, thresholds).added
    except NotConverged:
        return None
    columns = posterior.whitening.whiten(added[:, :, None] * smooth_shapes(study.axes)[:, None, :])
    return weighed.log_evidence + multiplier_evidence(
        settled(posterior), columns, thresholds.locate.multiplier_widths
    )


def _cut(study: Study, whole: Weighed, weighed: Sequence[Weighed], thresholds: Thresholds) -> Weighed:
    """An explanation, or the least part of it on which the rest stands."""
    odds = thresholds.name.odds
    parts = [each for each in weighed if _is_part(each, whole) and each.log_weight < whole.log_weight - odds]
    stands: list[tuple[Weighed, float]] = []
    for each in parts:
        found = bent_evidence(study, each, thresholds)
        if found is not None and found >= whole.log_evidence - odds:
            stands.append((each, found))
    if not stands:
        return whole
    part, found = min(stands, key=lambda one: (len(one[0].hypothesis.effects), -one[1]))
    own = replace(part.hypothesis, bent=True, log_prior=whole.hypothesis.log_prior)
    return replace(part, hypothesis=own, log_evidence=min(found, whole.log_evidence))


def _is_part(each: Weighed, whole: Weighed) -> bool:
    return bool(each.hypothesis.open_names) and set(each.hypothesis.open_names) < set(whole.hypothesis.open_names)
