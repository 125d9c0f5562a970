"""Explanation: a hypothesis with its evidence, probability, and prediction of held-out points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import log_softmax

from diagnosis.explain.hypotheses import Hypothesis
from system.estimation.posterior import Posterior
from system.inputs.channels import ChannelName


@dataclass(frozen=True)
class HeldOut:
    """Held-out points: gain in nats of each fold over the null; RMS residuals before, after and of noise, SI.

    `how`: the split of the points, as text.
    """

    gains: Mapping[str, float]
    before: Mapping[ChannelName, float]
    after: Mapping[ChannelName, float]
    noise: Mapping[ChannelName, float]
    vetoed: bool
    how: str


@dataclass(frozen=True, eq=False)
class Explanation:
    """A hypothesis with its evidence (natural logarithm), from the linear model or from a refit (`posterior`).

    z: score of the linear model, or the size over its sigma of a refit. Compared by identity.
    """

    hypothesis: Hypothesis
    log_evidence: float
    linear: bool
    posterior: Posterior | None
    z: float
    probability: float
    heldout: HeldOut | None

    @property
    def log_weight(self) -> float:
        """ln evidence plus ln prior, the order of explanations."""
        return self.log_evidence + self.hypothesis.log_prior


def with_probabilities(explanations: Sequence[Explanation], temperature: float) -> tuple[Explanation, ...]:
    """The same with probabilities that sum to 1, the likeliest first.

    P ~ exp((ln evidence + ln prior) / temperature).
    """
    logs = log_softmax(np.array([each.log_weight for each in explanations]) / temperature)
    found = [replace(each, probability=float(np.exp(one))) for each, one in zip(explanations, logs, strict=True)]
    return tuple(sorted(found, key=lambda each: -each.log_weight))
