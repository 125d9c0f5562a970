"""Chance of a departure of a component's law, where no candidate resembles the mismatch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import logsumexp

from diagnosis.detect.mismatch import holds
from diagnosis.explain.hypotheses import Hypothesis
from diagnosis.study.departures import departure_columns, departure_evidence, departure_shapes
from diagnosis.study.model import Study
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.effects.components import Component
from system.estimation.evidence import multiplier_evidences_without
from system.estimation.posterior import Posterior, settled


@dataclass(frozen=True)
class MultiplierChance:
    """Upper bound of the chance of such a departure without a mismatch; `point`, from 0, contributes most."""

    chance: float
    point: int


def multiplier_chance(
    study: Study, null: Posterior, unknown: Sequence[Hypothesis], thresholds: Thresholds
) -> MultiplierChance:
    """Upper bound of the chance that unknown physics is so far ahead of the null without a mismatch.

    A ratio of evidence to the null's has a mean of 1 under the null: K or more has a chance of 1/K at most (Markov). K
    is the ratio without the point that contributes most: free shapes can follow one outlying reading, and noise with
    tails has such. About the prior mean, and about the null's fit where that holds: the larger chance counts, as for
    candidates (`detect.confirmed`).
    """
    if not unknown:
        return MultiplierChance(1.0, 0)
    fits = (study.base, settled(null)) if holds(null, thresholds) else (study.base,)
    looked = [_ahead(study, fit, unknown, thresholds) for fit in fits]
    ahead, at = min((float(own.min()), int(own.argmin())) for own in looked)
    return MultiplierChance(float(np.exp(-max(ahead, 0.0))), int(np.unique(study.base.whitening.rows[:, 0])[at]))


def _ahead(study: Study, fit: Posterior, unknown: Sequence[Hypothesis], thresholds: Thresholds) -> Array:
    """ln evidence of unknown physics over the null, each point left out in turn.

    Of each component by one family of shapes, the likeliest with all points, with its prior share: an average of many
    is no less than one of its terms.
    """
    points, widths = fit.whitening.rows[:, 0], thresholds.locate.multiplier_widths
    shapes = departure_shapes(study.recording)
    prior = np.array([each.log_prior for each in unknown])
    gains = []
    for each in unknown:
        law = study.components[_component_of(each)]
        family = departure_evidence(fit, law, shapes, widths).family
        columns = departure_columns(fit, law, shapes)[:, family.columns]
        gains.append(family.log_prior + multiplier_evidences_without(fit, columns, points, widths))
    found: Array = logsumexp(np.array(gains) + prior[:, None], axis=0) - logsumexp(prior)
    return found


def _component_of(unknown: Hypothesis) -> Component:
    if unknown.component is None:
        raise ValueError(f"{unknown.text}: no component departs")
    return unknown.component
