"""Doubt: probabilities of explanations that leave a part unexplained, by the record of such findings."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from math import e, exp, log

import numpy as np

from diagnosis.explain.ranked import Explanation
from reynolds.numerics.arrays import Array
from system.effects.effect import Kind


def doubted(explanations: Sequence[Explanation], share: float, rest: Collection[Kind]) -> tuple[Explanation, ...]:
    """The explanations in their order with probabilities P' = share P + (1 - share) P0.

    P0: priors of the explanations of the kinds `rest`, normalised; without any of these 0, and the sum of all P' is
    share: the rest is of causes that have no explanation here. Evidences are valid if one
    of the explanations is true; the residual contradicts that, and with the chance 1 - share only the prior is known
    (contamination of a posterior; Berger and Berliner 1986, doi:10.1214/aos/1176349933). share: of such findings, the
    right ones.
    """
    prior = _prior(explanations, rest)
    return tuple(
        replace(each, probability=share * each.probability + (1.0 - share) * float(own))
        for each, own in zip(explanations, prior, strict=True)
    )


def no_surer(explanations: Sequence[Explanation], chance: float) -> tuple[Explanation, ...]:
    """The explanations with a least probability of "no mismatch", and all others in their proportions.

    A p-value `chance` (0 to 1) changes the prior odds of "no mismatch" by the factor of `sellke_bayarri_berger` at
    most. Evidences may exceed that, since their laws differ from those of the pump; the readings do not support it.
    """
    null = next(each for each in explanations if each.hypothesis.kind is Kind.NO_MISMATCH)
    others = np.exp([each.hypothesis.log_prior for each in explanations if each is not null]).sum()
    odds = sellke_bayarri_berger(chance) * exp(null.hypothesis.log_prior) / float(others)
    least = odds / (1.0 + odds)
    if null.probability >= least:
        return tuple(explanations)
    factor = (1.0 - least) / (1.0 - null.probability)
    return tuple(
        replace(each, probability=least if each is null else factor * each.probability) for each in explanations
    )


def sellke_bayarri_berger(chance: float) -> float:
    """Least factor by which a p-value changes the odds of the null: -e p ln p for p < 1/e, 1 above.

    Source: Sellke, Bayarri, Berger 2001 (doi:10.1198/000313001300339950), eq. 2; for alternatives whose p-values are
    beta-distributed.

    >>> round(sellke_bayarri_berger(0.05), 3), round(sellke_bayarri_berger(0.01), 3)
    (0.407, 0.125)
    """
    return -e * chance * log(chance) if 0.0 < chance < 1.0 / e else float(chance > 0.0)


def _prior(explanations: Sequence[Explanation], rest: Collection[Kind]) -> Array:
    """Prior (m,) of each explanation of the kinds `rest`, normalised; 0 for all others."""
    own = np.array([each.hypothesis.kind in rest for each in explanations])
    prior = np.where(own, np.exp([each.hypothesis.log_prior for each in explanations]), 0.0)
    return prior / prior.sum() if own.any() else prior
