"""Detection of a mismatch beyond noise and tolerance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import chi2

from diagnosis.detect.contrasts import misfit
from diagnosis.detect.multiplicity import family_chance, log_chances
from diagnosis.study.model import Candidate, Study
from diagnosis.thresholds import Thresholds
from system.estimation.evidence import Score, score
from system.estimation.posterior import Posterior, settled
from system.inputs.channels import ChannelName


@dataclass(frozen=True)
class ChannelMisfit:
    """One channel's chi-square per degree of freedom, and its share of all channels' excess."""

    chi2_per_dof: float
    share: float


@dataclass(frozen=True)
class Detection:
    """Goodness of fit, the candidates by strength, and the significance of the strongest.

    p_value, chi2_per_dof: of the objective of the linear posterior with n degrees of freedom, n readings; chance: of
    any candidate as significant as the strongest without a mismatch.
    """

    p_value: float
    chi2_per_dof: float
    channels: Mapping[ChannelName, ChannelMisfit]
    chance: float
    strongest: tuple[tuple[Candidate, Score], ...]


def detect(study: Study, thresholds: Thresholds) -> Detection:
    """Mismatch of the readings beyond the simulator, its tolerances and the noise.

    The objective r.r + xi.xi at the peak is that of the readings' own distribution N(0, 1 + A A^T): it is
    chi-square distributed with n degrees of freedom where noise is normal, without a bootstrap. Heavy tails of
    the noise raise it; the directed scores of the candidates, averages over many readings, are robust to them.
    """
    base = study.base
    chance, strongest = most_striking(base, study.candidates, thresholds)
    readings = base.residual.size
    return Detection(
        p_value=float(chi2.sf(base.objective, readings)),
        chi2_per_dof=base.objective / readings,
        channels=channel_misfits(study),
        chance=chance,
        strongest=strongest,
    )


def confirmed(study: Study, found: Detection, null: Posterior, thresholds: Thresholds) -> Detection:
    """The same with the chance about the null's fit, where that holds and gives the larger chance.

    About the prior mean the curvature within tolerances (leakage grows with the cube of a film) looks like a mismatch.
    Far from the prior mean, at a fit that does not hold (`holds`), its slopes are useless.
    """
    if not holds(null, thresholds):
        return found
    chance = most_striking(settled(null), study.candidates, thresholds)[0]
    return replace(found, chance=max(found.chance, chance))


def holds(null: Posterior, thresholds: Thresholds) -> bool:
    """True if chance explains the goodness of the null's fit and the pulls of its parameters."""
    limits = thresholds.mismatch
    fits = chi2.sf(null.objective, null.residual.size) >= limits.chance
    return bool(fits) and float(np.abs(null.pulls).max(initial=0.0)) <= limits.pull


def most_striking(
    posterior: Posterior, candidates: Sequence[Candidate], thresholds: Thresholds
) -> tuple[float, tuple[tuple[Candidate, Score], ...]]:
    """Candidates by the significance of their scores about a fit; the chance of such a one without a mismatch."""
    scored = [(candidate, score(posterior, candidate.column)) for candidate in candidates]
    log_p = log_chances(np.array([found.z for _, found in scored]), candidates)
    chance = family_chance(posterior, candidates, log_p, thresholds.mismatch.draws, thresholds.seeds.detect)
    return chance, tuple(scored[at] for at in np.argsort(log_p, kind="stable"))


def channel_misfits(study: Study) -> dict[ChannelName, ChannelMisfit]:
    """Chi-square of each channel over its free part beside the model, and its share of the excess."""
    found = misfit(study.base)
    observed, free = (found.pull**2).sum(axis=0), found.variance.sum(axis=0)
    observed, free = map(study.by_shown, (observed, free))
    excess = np.maximum(observed - free, 0.0)
    share = excess / excess.sum() if excess.any() else excess
    return {
        name: ChannelMisfit(float(observed[at] / free[at]), float(share[at]))
        for at, name in enumerate(study.shown_channels)
        if free[at] > 0
    }
