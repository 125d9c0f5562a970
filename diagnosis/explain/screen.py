"""Screening of all hypotheses in a linear model, before any refit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log

import numpy as np
from scipy.special import log_ndtr, logsumexp

from diagnosis.explain.hypotheses import Hypothesis, candidates_of
from diagnosis.explain.ranked import Explanation
from diagnosis.study.departures import departure_evidence, departure_shapes
from diagnosis.study.model import Candidate, Study
from diagnosis.thresholds import Thresholds
from reynolds.numerics.arrays import Array
from system.effects.components import Component
from system.estimation.evidence import Sign, project, score
from system.estimation.posterior import Posterior


@dataclass(frozen=True)
class JointEvidence:
    """Some columns together: ln evidence over none of them, and their sizes in spreads at the best width."""

    evidence: float
    sizes: Array


def screen(
    study: Study, posterior: Posterior, single: Sequence[Hypothesis], thresholds: Thresholds
) -> tuple[Explanation, ...]:
    """All hypotheses with their linear evidence about a posterior without them, in the given order.

    Those on a grid are averaged over it. The scale of the evidence is that of the posterior.
    """
    return tuple(_screened(study, posterior, hypothesis, thresholds) for hypothesis in single)


def linear_gain(study: Study, posterior: Posterior, hypothesis: Hypothesis, thresholds: Thresholds) -> float:
    """Gain in ln evidence of a hypothesis of the catalogue over a posterior without it."""
    widths = thresholds.name.mixture_widths
    members = hypothesis.members
    found = [joint_evidence(posterior, candidates_of(study, member), widths).evidence for member in members]
    return float(logsumexp(found)) - log(len(found))


def joint_evidence(posterior: Posterior, candidates: Sequence[Candidate], widths: Sequence[float]) -> JointEvidence:
    """ln evidence for the columns of several candidates together over none, averaged over prior widths.

    For one width, V the columns times it, g = V^T r, G = V^T P V: g^T (1 + G)^-1 g / 2 - ln det(1 + G) / 2, and
    for each size of one sign the ln of twice its mass on that side. One column: `mixture_evidence`.
    """
    if not candidates:
        return JointEvidence(0.0, np.zeros(0))
    columns = np.stack([each.column * each.width for each in candidates], axis=1)
    sign = np.array([_SIGNS[each.sign] for each in candidates])
    agreement, content = columns.T @ posterior.residual, columns.T @ project(posterior, columns)
    found, means = [], []
    for width in widths:
        precision = np.eye(sign.size) + width**2 * 0.5 * (content + content.T)
        covariance = np.linalg.inv(precision)
        mean = covariance @ agreement * width
        one_sided = np.where(sign != 0, log(2.0) + log_ndtr(sign * mean / np.sqrt(np.diag(covariance))), 0.0)
        gain = 0.5 * width * float(agreement @ mean) - 0.5 * float(np.linalg.slogdet(precision)[1])
        found.append(gain + float(one_sided.sum()))
        means.append(mean * width * np.array([each.width for each in candidates]))
    return JointEvidence(float(logsumexp(found)) - log(len(found)), means[int(np.argmax(found))])


def unknown_gain(study: Study, posterior: Posterior, component: Component, thresholds: Thresholds) -> float:
    """Gain in ln evidence of a departure of the component's law over a posterior."""
    law, widths = study.components[component], thresholds.locate.multiplier_widths
    return departure_evidence(posterior, law, departure_shapes(study.recording), widths).log_evidence


def _screened(study: Study, posterior: Posterior, hypothesis: Hypothesis, thresholds: Thresholds) -> Explanation:
    if hypothesis.component is not None:
        gain = unknown_gain(study, posterior, hypothesis.component, thresholds)
    elif hypothesis.effects:
        gain = linear_gain(study, posterior, hypothesis, thresholds)
    else:
        gain = 0.0
    columns = [each.column for member in hypothesis.members for each in candidates_of(study, member)]
    z = max((score(posterior, column).z for column in columns), key=abs, default=0.0)
    return Explanation(hypothesis, posterior.log_evidence + gain, True, None, z, 0.0, None)


_SIGNS = {Sign.POSITIVE: 1.0, Sign.NEGATIVE: -1.0, Sign.EITHER: 0.0}
