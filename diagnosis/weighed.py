"""A hypothesis weighed: evidence, probability, and how it predicts points that took no part in the fit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from diagnosis.hypotheses import Hypothesis
from system.channels import ChannelName
from system.estimation.posterior import Posterior


@dataclass(frozen=True)
class HeldOut:
    """Held-out points: gain in nats of each fold over the null; RMS residuals before, after and of noise, SI.

    `how` says in words how the points were split.
    """

    gains: Mapping[str, float]
    before: Mapping[ChannelName, float]
    after: Mapping[ChannelName, float]
    noise: Mapping[ChannelName, float]
    vetoed: bool
    how: str


@dataclass(frozen=True)
class Weighed:
    """A hypothesis with its evidence (natural logarithm), from the linear model or from a refit (`posterior`)."""

    hypothesis: Hypothesis
    log_evidence: float
    linear: bool
    posterior: Posterior | None
    z: float
    probability: float
    heldout: HeldOut | None
