"""Second effects that only stand in for the form of the first.

A law that is right in kind but not in form leaves a residual, and some second effect always takes up a part of it.
That effect is believed only if it does better than the first one's own pattern, bent smoothly over the map, and if
it takes up more than the form of a law is trusted with.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from math import inf, nan

import numpy as np
from scipy.special import logsumexp

from diagnosis.explain.explained import repair
from diagnosis.explain.ranked import Explanation
from diagnosis.study.map_axes import smooth_shapes
from diagnosis.study.model import Study
from diagnosis.thresholds import FormLimits, Thresholds
from reynolds.numerics.arrays import Array
from system.effects.effect import EffectId, Kind
from system.estimation.evidence import multiplier_evidence
from system.estimation.posterior import Posterior, settled
from system.inputs.errors import NotConverged

Evidence = Callable[[Explanation], float | None]


def without_stand_ins(
    study: Study, weighed: Sequence[Explanation], thresholds: Thresholds
) -> tuple[Explanation, ...]:
    """Explanations of one and more effects, those whose last effects are stand-ins cut to what they stand on.

    Of A + B, where A has a law and was refitted, B stands in if A bent does as well within the odds of a name, and
    B takes up no more than the share `second` of what A does.
    What is left is A with the evidence that the two have, or A bent, whichever is less: it claims A, and that its
    form is not all. B stands in too if in each channel it takes up less than `slight` of what A does there: then A
    has the evidence of the two. So it is with unknown physics, a component bent freely: it stands in where one
    law, bent, does as well, and its own form explains `own` times what the bending adds.
    """
    bent: Evidence = cache(lambda each: bent_evidence(study, each, thresholds))
    null = next((each for each in weighed if each.hypothesis.kind is Kind.NO_MISMATCH), None)
    known = [each for each in weighed if each.hypothesis.component is None]
    unknown = [each for each in weighed if each.hypothesis.component is not None]
    if null is None:
        return tuple(weighed)
    cut = [_cut(study, each, known, null, bent, thresholds) for each in known]
    return (*cut, *_known_after_all(unknown, known, null, bent, thresholds))


def bent_evidence(study: Study, weighed: Explanation, thresholds: Thresholds) -> float | None:
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


def _cut(
    study: Study,
    whole: Explanation,
    weighed: Sequence[Explanation],
    null: Explanation,
    bent: Evidence,
    thresholds: Thresholds,
) -> Explanation:
    """An explanation, or the least part of it on which the rest stands."""
    odds = thresholds.name.odds
    parts = [each for each in weighed if _is_part(each, whole) and each.log_weight < whole.log_weight - odds]
    stands: list[tuple[Explanation, float]] = []
    for each in parts:
        found = bent(each)
        if found is None:
            continue
        if _is_slight(study, whole, each, null, thresholds.form):
            stands.append((each, whole.log_evidence))
        elif found >= whole.log_evidence - odds and not _is_more(whole, each, null, thresholds.form):
            stands.append((each, min(found, whole.log_evidence)))
    if not stands:
        return whole
    part, found = min(stands, key=lambda one: (len(one[0].hypothesis.effects), -one[1]))
    beside = tuple(each for each in whole.hypothesis.effects if each not in part.hypothesis.effects)
    return _as_bent(part, found, whole.hypothesis.log_prior, beside)


def _is_slight(study: Study, whole: Explanation, part: Explanation, null: Explanation, form: FormLimits) -> bool:
    """Whether the rest of an explanation takes up no more of a channel's sum of squares than its part's form may.

    Sum r^2 falls by G_c from nothing to the part, by D_c from the part to the whole: D_c < slight G_c + slack.
    So it is with the objectives, into which goes what parameters were moved for it.
    """
    fits = [each.posterior for each in (null, part, whole)]
    if any(fit is None for fit in fits):
        return False
    before, by_part, by_whole = (_squares(study, fit) for fit in fits if fit is not None)
    return bool(np.all(by_part - by_whole < form.slight * np.maximum(before - by_part, 0.0) + form.slack))


def _is_more(whole: Explanation, part: Explanation, null: Explanation, form: FormLimits) -> bool:
    """Whether the rest of an explanation takes up more of the objective than the form of a part can be off by."""
    fits = [each.posterior for each in (null, part, whole)]
    before, by_part, by_whole = (nan if fit is None else fit.objective for fit in fits)
    return by_part - by_whole > form.second * (before - by_part)


def _squares(study: Study, fit: Posterior) -> Array:
    """Sums of squares of a fit's residuals by shown channel, and its objective."""
    sums = np.zeros(len(study.observations.channels))
    np.add.at(sums, fit.whitening.rows[:, 1], fit.residual**2)
    return np.append(study.by_shown(sums), fit.objective)


def _known_after_all(
    unknown: Sequence[Explanation],
    known: Sequence[Explanation],
    null: Explanation,
    bent: Evidence,
    thresholds: Thresholds,
) -> tuple[Explanation, ...]:
    """Unknown physics, with what a law bent does as well as gathered into one explanation by that law."""
    ahead = max((each.log_weight for each in known), default=-inf)
    if max((each.log_weight for each in unknown), default=-inf) < ahead - thresholds.name.odds:
        return tuple(unknown)
    standing: list[tuple[Explanation, float]] = []
    for each in known:
        gained = each.log_evidence - null.log_evidence
        single = len(each.hypothesis.effects) == 1 and gained > thresholds.name.odds
        found = bent(each) if single else None
        if found is not None and thresholds.form.own * (found - each.log_evidence) < gained:
            standing.append((each, found))
    law, most = max(standing, key=lambda one: one[1] + one[0].hypothesis.log_prior, default=(null, -inf))
    taken = [each for each in unknown if each.log_evidence <= most]
    if not taken:
        return tuple(unknown)
    prior = float(logsumexp([each.hypothesis.log_prior for each in taken]))
    evidence = float(logsumexp([each.log_weight for each in taken])) - prior
    return (_as_bent(law, evidence, prior, ()), *(each for each in unknown if each.log_evidence > most))


def _as_bent(
    part: Explanation, log_evidence: float, log_prior: float, beside: tuple[EffectId, ...]
) -> Explanation:
    """A law's explanation, of which is said that its form is not all; beside: what stood in for the form."""
    own = replace(part.hypothesis, bent=True, stand_ins=beside, log_prior=log_prior)
    return replace(part, hypothesis=own, log_evidence=log_evidence)


def _is_part(each: Explanation, whole: Explanation) -> bool:
    return bool(each.hypothesis.open_names) and set(each.hypothesis.open_names) < set(whole.hypothesis.open_names)
