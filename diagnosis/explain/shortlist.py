"""Explanations to refit."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from scipy.stats import chi2

from diagnosis.detect.mismatch import Detection
from diagnosis.explain.ranked import Explanation, with_probabilities
from diagnosis.explain.refit import FirstLook, first_look
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.errors import NotConverged
from system.effects.effect import Kind


def is_settled(detection: Detection, null: Explanation, thresholds: Thresholds) -> bool:
    """True if neither a candidate's score nor the goodness of fit contradicts the null's refit."""
    fit = null.posterior
    if fit is None:
        return False
    p_value = float(chi2.sf(fit.objective, fit.residual.size))
    limits = thresholds.mismatch
    return detection.chance >= limits.suspicion and p_value >= limits.chance


def shortlist(
    screened: Sequence[Explanation], settled: bool, thresholds: Thresholds, gain: float = -inf
) -> tuple[Explanation, ...]:
    """The explanations of the catalogue to refit: those within the gap of the best in the linear model.

    Where the null holds, only those that gain on it, and none unless the null is improbable: a verdict needs both.
    gain: nats over the null, at least, in the linear model.
    """
    limits = thresholds.name
    ranked = _ranked(screened)
    null = next(each for each in with_probabilities(screened, limits.temperature) if _is_null(each))
    if not ranked or (settled and null.probability >= thresholds.mismatch.null_probability):
        return ()
    least = max(ranked[0].log_evidence - limits.shortlist_gap, null.log_evidence + (0.0 if settled else gain))
    return tuple(each for each in ranked[: limits.shortlist] if each.log_evidence > least)


def first_that_gain(screened: Sequence[Explanation], thresholds: Thresholds) -> tuple[Explanation, ...]:
    """The first explanations of the catalogue in the linear model, at most a shortlist, that gain on the null there."""
    null = next(each for each in screened if _is_null(each))
    first = _ranked(screened)[: thresholds.name.shortlist]
    return tuple(each for each in first if each.log_evidence > null.log_evidence)


def worth_a_refit(linear: Explanation, null: Explanation, thresholds: Thresholds) -> float:
    """Gain over the null in the linear model below which no explanation is refitted, where that model is right.

    It is where it gives the evidence of the null's own fit: there, refits of candidates without gain are useless.
    """
    is_right = abs(linear.log_evidence - null.log_evidence) < thresholds.name.odds
    return thresholds.fit.worth if is_right else -inf


def wrong_parameters(
    study: Study, screened: Sequence[Explanation], thresholds: Thresholds
) -> tuple[tuple[Explanation, FirstLook], ...]:
    """Wrong parameters to refit for a mismatch, each with its first estimate.

    Large changes of a film change the slopes of all others, so that the linear model ranks them wrongly; those with the
    least objective at a first estimate are refitted.
    """
    wrong = [each for each in _ranked(screened) if each.hypothesis.kind is Kind.WRONG_PARAMETER]
    looks = [(each, _look(study, each, thresholds)) for each in wrong]
    return tuple(sorted(looks, key=lambda look: look[1].promised)[: thresholds.fit.shortlisted_parameters])


def _ranked(screened: Sequence[Explanation]) -> list[Explanation]:
    """Explanations of the catalogue, the likeliest in the linear model first."""
    return sorted((each for each in screened if each.hypothesis.open_names), key=lambda each: -each.log_weight)


def _is_null(each: Explanation) -> bool:
    return each.hypothesis.kind is Kind.NO_MISMATCH


def _look(study: Study, wrong: Explanation, thresholds: Thresholds) -> FirstLook:
    try:
        return first_look(study, wrong.hypothesis, thresholds)
    except NotConverged:
        return FirstLook(inf, inf)
