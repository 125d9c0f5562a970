"""Doubt: probabilities of explanations that leave a part unexplained, by the record of such findings."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from diagnosis.explain.ranked import Explanation
from reynolds.numerics.arrays import Array
from system.effects.effect import Kind


def doubted(explanations: Sequence[Explanation], share: float, rest: Collection[Kind]) -> tuple[Explanation, ...]:
    """The explanations in their order with probabilities P' = share P + (1 - share) P0.

    P0: priors of the explanations of the kinds `rest`, normalised; 0 where there is none of these. Evidences hold
    where one of the explanations is true; the residual contradicts that, and with the chance 1 - share the prior is
    all that is known (contamination of a posterior; Berger and Berliner 1986, doi:10.1214/aos/1176349933). share: of
    such findings, the right ones.
    """
    prior = _prior(explanations, rest)
    return tuple(
        replace(each, probability=share * each.probability + (1.0 - share) * float(own))
        for each, own in zip(explanations, prior, strict=True)
    )


def _prior(explanations: Sequence[Explanation], rest: Collection[Kind]) -> Array:
    """Prior (m,) of each explanation of the kinds `rest`, normalised; 0 for all others."""
    own = np.array([each.hypothesis.kind in rest for each in explanations])
    prior = np.where(own, np.exp([each.hypothesis.log_prior for each in explanations]), 0.0)
    return prior / prior.sum() if own.any() else prior
