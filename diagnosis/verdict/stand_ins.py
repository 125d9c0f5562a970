"""Second effects that merely compensate the error of form of the first.

A law that is right in kind but not in form leaves a residual, and some second effect always explains a part of it.
That effect counts only if it explains more than the first one's own pattern with a smooth multiplier over the map,
and more than an error of form may leave.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from math import inf, nan

import numpy as np
from scipy.special import logsumexp

from diagnosis.explain.explained import explained_mismatch
from diagnosis.explain.ranked import Explanation
from diagnosis.study.map_axes import smooth_shapes
from diagnosis.study.model import Study
from diagnosis.thresholds import FormLimits, Thresholds
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.effects.effect import EffectId, Kind
from system.estimation.evidence import multiplier_evidence
from system.estimation.posterior import Posterior, settled

Evidence = Callable[[Explanation], float | None]


def without_stand_ins(
    study: Study, explanations: Sequence[Explanation], thresholds: Thresholds
) -> tuple[Explanation, ...]:
    """Explanations of one and more effects, without effects that are stand-ins.

    In A + B, where A has a law and a refit, B is a stand-in if A with a free multiplier has the same evidence
    within the odds of a name, and B explains no more than the share `second` of what A explains. Then A remains,
    of another form, with the lesser evidence of A + B and of A with the multiplier. B is a stand-in too if in each
    channel it explains less than `slight` of what A explains there: then A has the evidence of both. Unknown
    physics, a component with a free multiplier, is a stand-in if one law with a multiplier has the same evidence
    and the law itself gains `own` times as much as its multiplier adds.
    """
    multiplied: Evidence = cache(lambda each: multiplied_evidence(study, each, thresholds))
    null = next((each for each in explanations if each.hypothesis.kind is Kind.NO_MISMATCH), None)
    known = [each for each in explanations if each.hypothesis.component is None]
    unknown = [each for each in explanations if each.hypothesis.component is not None]
    if null is None:
        return tuple(explanations)
    cut = [_cut(study, each, known, null, multiplied, thresholds) for each in known]
    return (*cut, *_known_after_all(unknown, known, null, multiplied, thresholds))


def multiplied_evidence(study: Study, explanation: Explanation, thresholds: Thresholds) -> float | None:
    """ln evidence of an explanation whose addition to the readings is multiplied by 1 + Phi b.

    b as for unknown physics, linear about the refit. None without a refit, and without a law.
    """
    posterior = explanation.posterior
    if posterior is None or not explanation.hypothesis.laws:
        return None
    try:
        added = explained_mismatch(study, explanation, thresholds).added
    except NotConverged:
        return None
    columns = posterior.whitening.whiten(added[:, :, None] * smooth_shapes(study.axes)[:, None, :])
    return explanation.log_evidence + multiplier_evidence(
        settled(posterior), columns, thresholds.locate.multiplier_widths
    )


def _cut(
    study: Study,
    whole: Explanation,
    explanations: Sequence[Explanation],
    null: Explanation,
    multiplied: Evidence,
    thresholds: Thresholds,
) -> Explanation:
    """An explanation, or its smallest part if the rest are stand-ins."""
    odds = thresholds.name.odds
    parts = [each for each in explanations if _is_part(each, whole) and each.log_weight < whole.log_weight - odds]
    remaining: list[tuple[Explanation, float]] = []
    for each in parts:
        found = multiplied(each)
        if found is None:
            continue
        if _is_slight(study, whole, each, null, thresholds.form):
            remaining.append((each, whole.log_evidence))
        elif found >= whole.log_evidence - odds and not _is_more(whole, each, null, thresholds.form):
            remaining.append((each, min(found, whole.log_evidence)))
    if not remaining:
        return whole
    part, found = min(remaining, key=lambda one: (len(one[0].hypothesis.effects), -one[1]))
    beside = tuple(each for each in whole.hypothesis.effects if each not in part.hypothesis.effects)
    return _of_other_form(part, found, whole.hypothesis.log_prior, beside)


def _is_slight(study: Study, whole: Explanation, part: Explanation, null: Explanation, form: FormLimits) -> bool:
    """True if the rest of an explanation explains no more of any channel than the form of its part may leave.

    Sum r^2 falls by G_c from nothing to the part, by D_c from the part to the whole: D_c < slight G_c + slack.
    The same holds for the objectives, which include the moved parameters.
    """
    fits = [each.posterior for each in (null, part, whole)]
    if any(fit is None for fit in fits):
        return False
    before, by_part, by_whole = (_squares(study, fit) for fit in fits if fit is not None)
    return bool(np.all(by_part - by_whole < form.slight * np.maximum(before - by_part, 0.0) + form.slack))


def _is_more(whole: Explanation, part: Explanation, null: Explanation, form: FormLimits) -> bool:
    """True if the rest of an explanation explains more of the objective than an error of form of its part can."""
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
    multiplied: Evidence,
    thresholds: Thresholds,
) -> tuple[Explanation, ...]:
    """Unknown physics; components that a law with a multiplier equals are gathered into one explanation by it."""
    ahead = max((each.log_weight for each in known), default=-inf)
    if max((each.log_weight for each in unknown), default=-inf) < ahead - thresholds.name.odds:
        return tuple(unknown)
    equal: list[tuple[Explanation, float]] = []
    for each in known:
        gained = each.log_evidence - null.log_evidence
        single = len(each.hypothesis.effects) == 1 and gained > thresholds.name.odds
        found = multiplied(each) if single else None
        if found is not None and thresholds.form.own * (found - each.log_evidence) < gained:
            equal.append((each, found))
    law, most = max(equal, key=lambda one: one[1] + one[0].hypothesis.log_prior, default=(null, -inf))
    taken = [each for each in unknown if each.log_evidence <= most]
    if not taken:
        return tuple(unknown)
    prior = float(logsumexp([each.hypothesis.log_prior for each in taken]))
    evidence = float(logsumexp([each.log_weight for each in taken])) - prior
    return (_of_other_form(law, evidence, prior, ()), *(each for each in unknown if each.log_evidence > most))


def _of_other_form(
    part: Explanation, log_evidence: float, log_prior: float, beside: tuple[EffectId, ...]
) -> Explanation:
    """An explanation by a law of another form; beside: its stand-ins."""
    own = replace(part.hypothesis, other_form=True, stand_ins=beside, log_prior=log_prior)
    return replace(part, hypothesis=own, log_evidence=log_evidence)


def _is_part(each: Explanation, whole: Explanation) -> bool:
    return bool(each.hypothesis.open_names) and set(each.hypothesis.open_names) < set(whole.hypothesis.open_names)
