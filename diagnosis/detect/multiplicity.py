"""Multiplicity: chance of the strongest of many candidates without a mismatch."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.stats import norm

from diagnosis.study.model import Candidate
from reynolds.numerics.arrays import Array
from system.estimation.evidence import NOTHING_LEFT, Sign, project
from system.estimation.posterior import Posterior


def log_chances(scores: Array, candidates: Sequence[Candidate]) -> Array:
    """(m,), ln of the chance of each candidate's score (m,) without a mismatch.

    One-sided where an effect has a sign. A logarithm: the chance of strong ones is below any float.
    """
    side = np.array([_SIDE[each.sign] for each in candidates])
    both = norm.logsf(np.abs(scores)) + np.log(2.0)
    return np.asarray(np.where(side == 0.0, both, norm.logsf(side * scores)))


def holm(p_values: Array) -> float:
    """The smallest of several p-values after Holm (1979): the chance of one as small without a mismatch."""
    return min(1.0, float(p_values.min(initial=1.0)) * max(p_values.size, 1))


def family_chance(posterior: Posterior, candidates: Sequence[Candidate], log_p: Array, draws: int, seed: int) -> float:
    """The chance that any candidate is as significant as the strongest, ln p (m,), without a mismatch.

    Scores of similar candidates are correlated: they are drawn from N(0, V^T P V), their distribution without a
    mismatch, and the least p of each draw is counted (Westfall and Young 1993, min P). Where fewer than one draw in
    `draws` is as significant, Holm's bound, which ignores the correlation, is the smaller.
    """
    bound = holm(np.exp(log_p))
    columns = np.stack([each.column for each in candidates], axis=1) if candidates else np.zeros((0, 0))
    content = columns.T @ project(posterior, columns) if candidates else columns
    left = np.diag(content) > NOTHING_LEFT * (columns**2).sum(axis=0)
    if not left.any():
        return bound
    spread = np.sqrt(np.diag(content)[left])
    level, axes = np.linalg.eigh(content[np.ix_(left, left)] / np.outer(spread, spread))
    factor = axes * np.sqrt(np.maximum(level, 0.0))
    drawn = factor @ np.random.default_rng(seed).standard_normal((len(factor), draws))
    side = np.array([_SIDE[each.sign] for each in candidates])[left, None]
    least = float(np.exp(log_p.min()))
    striking = np.where(side == 0.0, np.abs(drawn) >= norm.isf(0.5 * least), side * drawn >= norm.isf(least))
    return min(bound, float(1 + np.count_nonzero(striking.any(axis=0))) / (draws + 1))


_SIDE = {Sign.POSITIVE: 1.0, Sign.NEGATIVE: -1.0, Sign.EITHER: 0.0}
