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
from diagnosis.study.departures import DepartureEvidence, departure_evidence, departure_shapes
from diagnosis.study.model import Study
from diagnosis.thresholds import FormLimits, Thresholds
from reynolds.errors import NotConverged
from reynolds.numerics.arrays import Array
from system.effects.effect import EffectId, Kind
from system.estimation.posterior import Posterior, settled

Departing = Callable[[Explanation], DepartureEvidence | None]


def without_stand_ins(
    study: Study, explanations: Sequence[Explanation], thresholds: Thresholds
) -> tuple[Explanation, ...]:
    """Explanations of one and more effects, without effects that are stand-ins.

    In A + B, where A has a law and a refit, B is a stand-in if A with a departure has the same evidence within the odds
    of a name, and B explains no more than the share `second` of A's part. Then A remains, of another form, with the
    lesser evidence of A + B and of A with a departure. B is a stand-in too if in each channel it explains less than
    `slight` of A's part there: then A has the evidence of both. Unknown physics, a component whose law departs, is a
    stand-in if one law with a departure has the same evidence and the departure absorbs no more than the share
    `material` of both: an explanation of nine tenths is complete. A law that absorbs `own` times as much as its
    departure stays beside unknown physics.
    """
    departing: Departing = cache(lambda each: departure_of(study, each, thresholds))
    null = next((each for each in explanations if each.hypothesis.kind is Kind.NO_MISMATCH), None)
    known = [each for each in explanations if each.hypothesis.component is None]
    unknown = [each for each in explanations if each.hypothesis.component is not None]
    if null is None:
        return tuple(explanations)
    cut = [_cut(study, each, known, null, departing, thresholds) for each in known]
    return (*cut, *_known_after_all(unknown, known, null, departing, thresholds))


def departure_of(study: Study, explanation: Explanation, thresholds: Thresholds) -> DepartureEvidence | None:
    """Departure of an explanation's addition to the readings, linear about its refit.

    None without a refit, and without a law.
    """
    posterior = explanation.posterior
    if posterior is None or not explanation.hypothesis.laws:
        return None
    try:
        added = explained_mismatch(study, explanation, thresholds).added
    except NotConverged:
        return None
    shapes, widths = departure_shapes(study.recording), thresholds.locate.multiplier_widths
    return departure_evidence(settled(posterior), added, shapes, widths)


def _cut(
    study: Study,
    whole: Explanation,
    explanations: Sequence[Explanation],
    null: Explanation,
    departing: Departing,
    thresholds: Thresholds,
) -> Explanation:
    """An explanation, or its smallest part if the rest are stand-ins."""
    odds = thresholds.name.odds
    parts = [each for each in explanations if _is_part(each, whole) and each.log_weight < whole.log_weight - odds]
    remaining: list[tuple[Explanation, float]] = []
    for each in parts:
        departure = departing(each)
        if departure is None:
            continue
        found = each.log_evidence + departure.log_evidence
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

    Sum r^2 falls by G_c from the null to the part, by D_c from the part to the whole: D_c < slight G_c + slack. The
    same holds for the objectives, which include the moved parameters.
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
    departing: Departing,
    thresholds: Thresholds,
) -> tuple[Explanation, ...]:
    """Unknown physics, and laws with a departure beside it; explanations equal to such a law are merged into one by it.

    They are merged if the law is complete except for its form, else the law with its departure stays beside it.
    """
    ahead = max((each.log_weight for each in known), default=-inf)
    if max((each.log_weight for each in unknown), default=-inf) < ahead - thresholds.name.odds:
        return tuple(unknown)
    equal: list[tuple[Explanation, float]] = []
    beside: list[Explanation] = []
    for each in known:
        single = len(each.hypothesis.effects) == 1 and each.log_evidence - null.log_evidence > thresholds.name.odds
        departure = departing(each) if single else None
        if departure is None:
            continue
        found, left = each.log_evidence + departure.log_evidence, _share_left(each, null, departure)
        if left <= thresholds.form.material:
            equal.append((each, found))
        elif thresholds.form.own * left < 1.0 - left and departure.log_evidence > 0.0:
            beside.append(_of_other_form(each, found, each.hypothesis.log_prior, ()))
    law, most = max(equal, key=lambda one: one[1] + one[0].hypothesis.log_prior, default=(null, -inf))
    taken = [each for each in unknown if each.log_evidence <= most]
    if not taken:
        return (*beside, *unknown)
    prior = float(logsumexp([each.hypothesis.log_prior for each in taken]))
    evidence = float(logsumexp([each.log_weight for each in taken])) - prior
    gathered = _of_other_form(law, evidence, prior, ())
    return (gathered, *beside, *(each for each in unknown if each.log_evidence > most))


def _share_left(law: Explanation, null: Explanation, departure: DepartureEvidence) -> float:
    """Share of a departure in the objective that it absorbs together with its law; 1 without refits."""
    if law.posterior is None or null.posterior is None:
        return 1.0
    own = max(0.5 * (null.posterior.objective - law.posterior.objective), 0.0)
    return departure.taken / (own + departure.taken) if departure.taken > 0.0 else 0.0


def _of_other_form(
    part: Explanation, log_evidence: float, log_prior: float, beside: tuple[EffectId, ...]
) -> Explanation:
    """An explanation by a law of another form; beside: its stand-ins."""
    own = replace(part.hypothesis, other_form=True, stand_ins=beside, log_prior=log_prior)
    return replace(part, hypothesis=own, log_evidence=log_evidence)


def _is_part(each: Explanation, whole: Explanation) -> bool:
    return bool(each.hypothesis.open_names) and set(each.hypothesis.open_names) < set(whole.hypothesis.open_names)
