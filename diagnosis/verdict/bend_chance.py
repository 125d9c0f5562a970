"""How surprising a freely bent component is, where no candidate resembles the mismatch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import logsumexp

from diagnosis.detect.component_evidence import multiplier_columns
from diagnosis.detect.mismatch import holds
from diagnosis.explain.hypotheses import Hypothesis
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.estimation.evidence import multiplier_evidences_without
from system.estimation.posterior import Posterior, settled


@dataclass(frozen=True)
class MultiplierChance:
    """The chance of such a bend, at most, where nothing is there; `point`, from 0, is the one it rests on most."""

    chance: float
    point: int


def chance_of_bend(
    study: Study, null: Posterior, unknown: Sequence[Hypothesis], thresholds: Thresholds
) -> MultiplierChance:
    """The chance, at most, that unknown physics would stand so far ahead of nothing if nothing were there.

    An evidence over the null's has a mean of 1 under the null: K or more has a chance of 1/K at most (Markov).
    K is what is left of it without the point that it rests on most: fifteen free columns make a bend of one
    reading that is far off, and noise with tails has such. About the prior mean, and about the null's own fit
    where that holds: the less surprising counts, as of candidates (`detect.confirmed`).
    """
    if not unknown:
        return MultiplierChance(1.0, 0)
    fits = (study.base, settled(null)) if holds(null, thresholds) else (study.base,)
    looked = [_ahead(study, fit, unknown, thresholds) for fit in fits]
    ahead, at = min((float(own.min()), int(own.argmin())) for own in looked)
    return MultiplierChance(float(np.exp(-max(ahead, 0.0))), int(np.unique(study.base.whitening.rows[:, 0])[at]))


def _ahead(study: Study, fit: Posterior, unknown: Sequence[Hypothesis], thresholds: Thresholds) -> Array:
    """ln evidence of unknown physics over nothing without the readings of each point that has some."""
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
