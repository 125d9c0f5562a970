"""Chance of a component's free multiplier, where no candidate resembles the mismatch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import logsumexp

from diagnosis.detect.mismatch import holds
from diagnosis.explain.hypotheses import Hypothesis
from diagnosis.study.model import Study
from diagnosis.study.multipliers import multiplier_columns
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.estimation.evidence import multiplier_evidences_without
from system.estimation.posterior import Posterior, settled


@dataclass(frozen=True)
class MultiplierChance:
    """Upper bound of the chance of such a multiplier without a mismatch; `point`, from 0, contributes most."""

    chance: float
    point: int


def multiplier_chance(
    study: Study, null: Posterior, unknown: Sequence[Hypothesis], thresholds: Thresholds
) -> MultiplierChance:
    """Upper bound of the chance that unknown physics is so far ahead of the null without a mismatch.

    A ratio of evidence to the null's has a mean of 1 under the null: K or more has a chance of 1/K at most
    (Markov). K is the ratio without the point that contributes most: fifteen free columns can follow one reading
    that is far off, and noise with tails has such. About the prior mean, and about the null's fit where that
    holds: the larger chance counts, as for candidates (`detect.confirmed`).
    """
    if not unknown:
        return MultiplierChance(1.0, 0)
    fits = (study.base, settled(null)) if holds(null, thresholds) else (study.base,)
    looked = [_ahead(study, fit, unknown, thresholds) for fit in fits]
    ahead, at = min((float(own.min()), int(own.argmin())) for own in looked)
    return MultiplierChance(float(np.exp(-max(ahead, 0.0))), int(np.unique(study.base.whitening.rows[:, 0])[at]))


def _ahead(study: Study, fit: Posterior, unknown: Sequence[Hypothesis], thresholds: Thresholds) -> Array:
    """ln evidence of unknown physics over nothing, each point left out in turn."""
    points = fit.whitening.rows[:, 0]
    prior = np.array([each.log_prior for each in unknown])
    gains = [
        multiplier_evidences_without(
            fit, multiplier_columns(study, fit, each.component), points, thresholds.locate.multiplier_widths
        )
        for each in unknown
        if each.component is not None
    ]
    found: Array = logsumexp(np.array(gains) + prior[:, None], axis=0) - logsumexp(prior)
    return found
