"""Two and three effects at once: additions to the best so far, judged in the linear model, then refitted."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from diagnosis.explain.hypotheses import Hypothesis, candidates_of, together
from diagnosis.explain.ranked import Explanation
from diagnosis.explain.refit import hopeless_beside, refit_all
from diagnosis.explain.screen import joint_evidence, linear_gain
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from system.description.gap import Gap
from system.effects.effect import EffectId
from system.estimation.posterior import Posterior, settled
from system.work.processes import ProcessPool
from system.work.progress import Report


def combine(
    study: Study, explanations: Sequence[Explanation], thresholds: Thresholds, executor: ProcessPool, report: Report
) -> tuple[tuple[Explanation, ...], tuple[str, ...]]:
    """Refitted explanations of several effects, and the refits that failed, as text.

    Effects are added to the best explanations while each gains more than the odds of a name: a single effect that
    imitates two may be ahead of both. In addition all pairs of the best singles are screened about the prior mean.
    """
    known = [each for each in explanations if each.hypothesis.effects and each.hypothesis.component is None]
    if not known:
        return (), ()
    leaders = _leaders([each for each in known if each.posterior is not None], thresholds)
    found: list[Explanation] = []
    failed: list[str] = []
    while leaders and len(leaders[0].hypothesis.effects) < thresholds.fit.most_effects:
        refitted: list[Explanation] = []
        for leader in leaders:
            ahead = max((leaders[0], *refitted), key=_weight)
            tried = [each for each in _additions(study, leader, ahead, known, thresholds) if not _holds(refitted, each)]
            if leader is leaders[0] and len(leader.hypothesis.effects) == 1:
                tried += [each for each in _pairs(study, known, thresholds) if not _holds(tried, each)]
            done, reasons = refit_all(
                study, tried, thresholds, executor, report, hopeless_beside(ahead, thresholds), leader
            )
            failed += reasons
            refitted += [each for each in done if each.posterior is not None]
        found += refitted
        gained = [one for one in refitted if one.log_weight - leaders[0].log_weight > thresholds.name.odds]
        leaders = _leaders(gained, thresholds)
    return tuple(found), tuple(failed)


def _leaders(refitted: Sequence[Explanation], thresholds: Thresholds) -> list[Explanation]:
    """The likeliest refitted explanations within the gap of a shortlist behind the first, `most_additions` at most."""
    ranked = sorted(refitted, key=_weight, reverse=True)[: thresholds.fit.most_additions]
    return [each for each in ranked if ranked[0].log_weight - each.log_weight <= thresholds.name.shortlist_gap]


def _weight(explanation: Explanation) -> float:
    return explanation.log_weight


def _additions(
    study: Study, leader: Explanation, ahead: Explanation, known: Sequence[Explanation], thresholds: Thresholds
) -> list[Explanation]:
    """The likeliest additions to an explanation, about its refit, of those that promise more than the one ahead."""
    if leader.posterior is None:
        return []
    posterior = settled(leader.posterior)
    found = []
    for each in known:
        if _apart(leader.hypothesis, each.hypothesis):
            both = together(leader.hypothesis, each.hypothesis, thresholds.prior.pair_penalty)
            gain = linear_gain(study, posterior, each.hypothesis, thresholds)
            found.append(Explanation(both, leader.log_evidence + gain, True, None, 0.0, 0.0, None))
    return _likeliest([each for each in found if each.log_weight > ahead.log_weight], thresholds)


def _pairs(study: Study, known: Sequence[Explanation], thresholds: Thresholds) -> list[Explanation]:
    """The likeliest pairs of the best singles in the linear model; none unless ahead of the best single there."""
    singles = sorted(known, key=lambda each: each.log_evidence, reverse=True)[: thresholds.name.shortlist]
    alone = [linear_gain(study, study.base, each.hypothesis, thresholds) for each in singles]
    found = []
    for one, other in combinations(singles, 2):
        if _apart(one.hypothesis, other.hypothesis):
            both = together(one.hypothesis, other.hypothesis, thresholds.prior.pair_penalty)
            gain = _best_member(study, study.base, both, thresholds)
            found.append(Explanation(both, study.base.log_evidence + gain, True, None, 0.0, 0.0, None))
    least = study.base.log_evidence + max(
        gain + each.hypothesis.log_prior for gain, each in zip(alone, singles, strict=True)
    )
    return _likeliest([each for each in found if each.log_weight > least], thresholds)


def _likeliest(found: Sequence[Explanation], thresholds: Thresholds) -> list[Explanation]:
    """The first `additions`, and those within the gap of a class behind the first, `most_additions` in all."""
    ranked = sorted(found, key=_weight, reverse=True)[: thresholds.fit.most_additions]
    near = [each for each in ranked if ranked[0].log_weight - each.log_weight <= thresholds.name.class_gap]
    return ranked[: max(thresholds.fit.additions, len(near))]


def _best_member(study: Study, posterior: Posterior, both: Hypothesis, thresholds: Thresholds) -> float:
    widths = thresholds.name.mixture_widths
    return max(joint_evidence(posterior, candidates_of(study, member), widths).evidence for member in both.members)


def _apart(one: Hypothesis, other: Hypothesis) -> bool:
    """True if two explanations have different free parameters: other effects, or one law at other gaps."""
    return not set(one.open_names) & set(other.open_names) and not _acting(one) & _acting(other)


def _acting(one: Hypothesis) -> set[tuple[EffectId, Gap | None]]:
    places = (None if isinstance(subject, str) else subject.pair for subject in one.subjects)
    return set(zip(one.effects, places, strict=True))


def _holds(tried: Sequence[Explanation], other: Explanation) -> bool:
    names = set(other.hypothesis.open_names)
    return any(set(each.hypothesis.open_names) == names for each in tried)
