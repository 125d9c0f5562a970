"""Stages of a diagnosis: detect, locate, explain, judge."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf

import numpy as np

from diagnosis.checks.notes import note_text
from diagnosis.detect.mismatch import Detection, confirmed, detect, holds
from diagnosis.detect.time_scan import remains
from diagnosis.explain.combinations import combine
from diagnosis.explain.explained import explained_mismatch
from diagnosis.explain.held_out import held_out
from diagnosis.explain.hypotheses import hypotheses
from diagnosis.explain.ranked import Explanation, with_probabilities
from diagnosis.explain.refit import hopeless_beside, refit_all, try_refit, within_tolerance
from diagnosis.explain.scaling import Scaling, scaling
from diagnosis.explain.screen import screen, unknown_gain
from diagnosis.explain.shortlist import first_that_gain, is_settled, shortlist, worth_a_refit, wrong_parameters
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from diagnosis.verdict.diagnosis import Diagnosis, VerdictStatus
from diagnosis.verdict.judge import Judgement, judge
from diagnosis.verdict.locate import Location, locate, of_explanation, without_explanation
from diagnosis.verdict.stand_ins import without_stand_ins
from diagnosis.verdict.trend import coordinates
from reynolds.numerics.arrays import Array
from system.effects.effect import Kind
from system.estimation.posterior import FitEffort, Posterior, settled
from system.inputs.channels import ChannelName
from system.work.processes import ProcessPool, process_pool
from system.work.progress import Report, silent


def diagnose_study(
    study: Study, viscosity: Array, thresholds: Thresholds, report: Report = silent, workers: int = 1
) -> Diagnosis:
    """The diagnosis of a study without the next point; `viscosity` (N,) Pa s, of the oil at the case.

    Fits run in `workers` processes side by side. A hypothesis that could not be refitted keeps its linear form,
    with a note.
    """
    detection, location = detect(study, thresholds), locate(study, thresholds)
    screened = screen(study, study.base, hypotheses(study, thresholds), thresholds)
    report(0, 1, "fitting the model as it is")
    null, not_null = _null(study, screened[0], thresholds)
    detection = confirmed(study, detection, _fit_of(null), thresholds)
    screened = _screened_anew(study, detection, screened, null, thresholds)
    with process_pool(workers) as executor:
        fits = _fits(study, detection, screened, null, thresholds, executor, report)
    ranked = _with_held_out(study, null, with_probabilities(fits.explanations, thresholds.name.temperature), thresholds)
    verdict = judge(study, detection, ranked, coordinates(study, viscosity), thresholds)
    notes = (*map(note_text, study.recording.notes), *verdict.reasons, *not_null, *fits.failed)
    return _finding(study, detection, location, verdict, viscosity, notes, thresholds)


@dataclass(frozen=True)
class _Fits:
    """All explanations on one scale, and failed refits as text."""

    explanations: tuple[Explanation, ...]
    failed: tuple[str, ...]


def _fits(
    study: Study,
    detection: Detection,
    screened: Sequence[Explanation],
    null: Explanation,
    thresholds: Thresholds,
    executor: ProcessPool,
    report: Report,
) -> _Fits:
    """Refits of the likeliest; with a mismatch also of wrong parameters and of several effects together."""
    least = worth_a_refit(screened[0], null, thresholds)
    listed = shortlist(screened, is_settled(detection, null, thresholds), thresholds, least)
    combined: tuple[Explanation, ...] = ()
    if is_settled(detection, null, thresholds):
        refitted, failed = refit_all(study, listed, thresholds, executor, report)
    else:
        listed = (*listed, *_listed_anew(study, screened, listed, null, thresholds))
        wrong = wrong_parameters(study, screened, thresholds)
        more = tuple(each for each, _ in wrong if each not in listed)
        reached = [look.reached for _, look in wrong]
        reached += [] if null.linear else [_fit_of(null).objective]
        hopeless = min(reached, default=inf) + 2.0 * thresholds.fit.hopeless
        refitted, failed = refit_all(study, (*listed, *more), thresholds, executor, report, hopeless)
        placed = _placed(study, screened, null, refitted)
        combined, not_combined = combine(study, placed, thresholds, executor, report)
        best = max((*placed, *combined), key=lambda each: each.log_weight)
        given_up = hopeless_beside(best, thresholds)
        parts, not_parted = refit_all(study, _parts(placed, best), thresholds, executor, report, given_up)
        refitted, failed = (*refitted, *parts), (*failed, *not_combined, *not_parted)
    is_missed = _is_missed(screened, null, thresholds)
    single = _unknown_anew(study, _placed(study, screened, null, refitted), null, is_missed, thresholds)
    return _Fits(without_stand_ins(study, (*single, *combined), thresholds), failed)


def _listed_anew(
    study: Study,
    screened: Sequence[Explanation],
    listed: Sequence[Explanation],
    null: Explanation,
    thresholds: Thresholds,
) -> tuple[Explanation, ...]:
    """Further explanations to refit where the linear model about the prior mean misses the null.

    There a gap in that model has little meaning: the first of its ranking that gain on the null are refitted, and those
    of a linear model about the null's fit. Effects hidden by nuisances at the prior mean may be visible about that fit,
    and the reverse.
    """
    if null.posterior is None or not _is_missed(screened, null, thresholds):
        return ()
    anew = screen(study, settled(null.posterior), [each.hypothesis for each in screened], thresholds)
    names = {each.hypothesis.open_names for each in shortlist(anew, False, thresholds)}
    names |= {each.hypothesis.open_names for each in first_that_gain(screened, thresholds)}
    return tuple(each for each in screened if each.hypothesis.open_names in names and each not in listed)


def _is_missed(screened: Sequence[Explanation], null: Explanation, thresholds: Thresholds) -> bool:
    """True if the linear model about the prior mean predicts far more for the null than its fit reaches."""
    linear = next(each for each in screened if each.hypothesis.kind is Kind.NO_MISMATCH)
    return linear.log_evidence - null.log_evidence > thresholds.name.shortlist_gap


def _parts(placed: Sequence[Explanation], best: Explanation) -> tuple[Explanation, ...]:
    """Single effects of an explanation of several effects that have no refit of their own."""
    names = set(best.hypothesis.open_names)
    return tuple(
        each
        for each in placed
        if each.posterior is None and each.hypothesis.open_names and set(each.hypothesis.open_names) < names
    )


def _null(study: Study, linear: Explanation, thresholds: Thresholds) -> tuple[Explanation, tuple[str, ...]]:
    """The refitted null; if that fails, its linear form about the prior mean, with the reason as text."""
    null, reason = try_refit(study, linear, thresholds)
    return (null, ()) if reason is None else (replace(null, posterior=study.base), (reason,))


def _screened_anew(
    study: Study, detection: Detection, screened: tuple[Explanation, ...], null: Explanation, thresholds: Thresholds
) -> tuple[Explanation, ...]:
    """The screening repeated about the null's fit, if no test contradicts that.

    About the prior mean a nonlinear influence within tolerance (an encoder's offset on the flank of a trace) looks
    like an effect, and refits would cost many maps to reject it.
    """
    fit = _fit_of(null)
    if not is_settled(detection, null, thresholds) or not holds(fit, thresholds):
        return screened
    return screen(study, settled(fit), [each.hypothesis for each in screened], thresholds)


def _placed(
    study: Study, screened: Sequence[Explanation], null: Explanation, refitted: Sequence[Explanation]
) -> tuple[Explanation, ...]:
    """All singles on one scale: refits replace their linear forms, the others are shifted.

    Without a refit, or where it failed, the distance to the best refitted hypothesis is that of the linear model: a
    linear model that fits by impossible nuisances is ahead of no refit.
    """
    done = (each for each in refitted if each.posterior is not None)
    fresh = {each.hypothesis.open_names: each for each in (null, *done)}
    linear = [each.log_evidence for each in screened if _key(each) in fresh and _key(each) is not None]
    moved = max(each.log_evidence for each in fresh.values()) - max(linear)
    return tuple(
        fresh[each.hypothesis.open_names]
        if _key(each) in fresh
        else replace(each, log_evidence=each.log_evidence + min(moved, 0.0))
        for each in screened
    )


def _key(each: Explanation) -> tuple[str, ...] | None:
    return None if each.hypothesis.component is not None else each.hypothesis.open_names


def _unknown_anew(
    study: Study, explanations: Sequence[Explanation], null: Explanation, is_missed: bool, thresholds: Thresholds
) -> tuple[Explanation, ...]:
    """Unknown physics about the prior mean or about the null's refit, the larger evidence of the two.

    is_missed: the linear model about the prior mean misses the null, so that it is not valid for a multiplier either.
    """
    fit = None if null.posterior is None else settled(null.posterior)

    def renewed(each: Explanation) -> Explanation:
        component = each.hypothesis.component
        if component is None or fit is None:
            return each
        anew = null.log_evidence + unknown_gain(study, fit, component, thresholds)
        return replace(each, log_evidence=anew if is_missed else max(each.log_evidence, anew))

    return tuple(renewed(each) for each in explanations)


def _with_held_out(
    study: Study, null: Explanation, ranked: Sequence[Explanation], thresholds: Thresholds
) -> tuple[Explanation, ...]:
    """The same with held-out points of the likeliest refits.

    The gains of an explanation by a wrong value are over the null within its tolerances: a null that is pulled farther
    makes the same predictions by the same value.
    """
    before = null.posterior
    if before is None:
        return tuple(ranked)
    known = [each for each in ranked if each.posterior is not None][: thresholds.fit.held_out]
    of_values = [each for each in known if each.hypothesis.widened and not each.hypothesis.laws]
    tolerated = within_tolerance(study, null, thresholds) if of_values else None

    def with_held_out(each: Explanation) -> Explanation:
        if each not in known or each.posterior is None:
            return each
        rival = tolerated if each in of_values else None
        return replace(each, heldout=held_out(study, before, each.posterior, thresholds, rival))

    return tuple(with_held_out(each) for each in ranked)


def _finding(
    study: Study,
    detection: Detection,
    location: Location,
    verdict: Judgement,
    viscosity: Array,
    notes: tuple[str, ...],
    thresholds: Thresholds,
) -> Diagnosis:
    """The diagnosis from its parts, the claimed explanation first."""
    ranked = verdict.ranked
    null = next(each for each in ranked if each.hypothesis.kind is Kind.NO_MISMATCH)
    claimed = verdict.members[0] if verdict.members else None
    shown = claimed or null
    before, after = _fit_of(null), _fit_of(shown)
    first = claimed or ranked[0]
    is_described = verdict.status is not VerdictStatus.SUSPICION and verdict.kind is not Kind.NO_MISMATCH
    described = first if is_described else None
    if claimed is not None and claimed.posterior is not None:
        location = of_explanation(study, location, explained_mismatch(study, claimed, thresholds).added, thresholds)
        if ChannelName.P_CHAMBER in location.channels:
            location = without_explanation(study, location, claimed, thresholds)
        if location.time is not None and not remains(location.time, study, after, thresholds):
            location = replace(location, time=None)
    return Diagnosis(
        kind=verdict.kind,
        status=verdict.status,
        detection=detection,
        location=location,
        effects=verdict.claims,
        hypotheses=(first, *(each for each in ranked if each is not first)),
        before=before,
        after=after,
        fit=shown.heldout or held_out(study, before, after, thresholds),
        scaling=None if described is None else scaling_of(study, described, viscosity, thresholds),
        next_point=None,
        not_identifiable=_not_identifiable(verdict, after, thresholds.name.alike),
        notes=notes,
        effort=_effort(ranked),
        thresholds=thresholds,
        left=verdict.left,
    )


def scaling_of(study: Study, explanation: Explanation, viscosity: Array, thresholds: Thresholds) -> Scaling | None:
    """Exponents of the mismatch by an explanation, in the channel with the greatest addition in sigma.

    None if that channel is the chamber pressure.
    """
    found = explained_mismatch(study, explanation, thresholds)
    sigma = study.base.whitening.sigma
    strength = np.where(study.observations.measured, (found.added / sigma) ** 2, 0.0).sum(axis=0)
    at = int(np.argmax(study.by_shown(strength)))
    if study.shown_channels[at] is ChannelName.P_CHAMBER:
        return None
    channel = study.channels[at]
    return scaling(
        channel, found.mismatch[:, at], sigma[:, at], coordinates(study, viscosity), thresholds.form.least_range
    )


def _fit_of(explanation: Explanation) -> Posterior:
    if explanation.posterior is None:
        raise ValueError(f"{explanation.hypothesis.text}: not refitted")
    return explanation.posterior


def _not_identifiable(verdict: Judgement, after: Posterior, alike: float) -> tuple[str, ...]:
    """Members of the claimed class, and parameters that the readings correlate."""
    members = [f"{verdict.members[0].hypothesis.text} vs {each.hypothesis.text}" for each in verdict.members[1:]]
    spread = np.sqrt(np.diag(after.covariance))
    correlation = np.triu(after.covariance / np.outer(spread, spread), 1)
    names = [parameter.name for parameter in after.parameters]
    tied = [f"{names[one]} vs {names[other]}" for one, other in np.argwhere(np.abs(correlation) > alike)]
    return (*members, *tied)


def _effort(ranked: Sequence[Explanation]) -> FitEffort:
    """Effort of all refits together."""
    spent = [each.posterior.effort for each in ranked if each.posterior is not None]
    return FitEffort(
        sum(each.predictions for each in spent), sum(each.slopes for each in spent), sum(each.seconds for each in spent)
    )
