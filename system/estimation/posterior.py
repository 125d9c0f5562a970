"""What readings say about parameters: the posterior about its peak."""

from __future__ import annotations

from dataclasses import dataclass

from system.estimation.observations import Array
from system.estimation.parameters import Parameter
from system.estimation.whitening import Whitening


@dataclass(frozen=True)
class FitLimits:
    """When a fit ends: steps at most, change of the objective, largest step in xi, renewals of the whitening."""

    steps: int = 30
    change: float = 1e-2
    largest_step: float = 2.0
    whitening_rounds: int = 2


@dataclass(frozen=True)
class Effort:
    """What a fit has cost: predictions, slopes (maps of one column each), seconds of process time."""

    predictions: int
    slopes: int
    seconds: float


@dataclass(frozen=True)
class Posterior:
    """Parameters at the peak of the posterior, or at the peak of its linear form about the prior mean.

    xi, values: (k,), standard numbers and SI values. residual: (n,), whitened, one for each reading;
    slopes: (n, k), d prediction / d xi, whitened; precision: (k, k) = slopes^T slopes + 1; objective: residual^2 +
    xi^2; log_evidence: natural logarithm, without the constants that all hypotheses on these readings share;
    predictions: (N, C) in SI.
    """

    parameters: tuple[Parameter, ...]
    xi: Array
    values: Array
    residual: Array
    slopes: Array
    precision: Array
    objective: float
    log_evidence: float
    predictions: Array
    whitening: Whitening
    effort: Effort
