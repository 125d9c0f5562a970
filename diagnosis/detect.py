"""Is there a mismatch beyond noise and tolerance?"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from diagnosis.contrasts import contrasts, misfit
from diagnosis.map_axes import axis_values
from diagnosis.multiplicity import family_chance, log_chances
from diagnosis.regions import Region, flagged
from diagnosis.study import Candidate, Study
from diagnosis.thresholds import Thresholds
from system.channels import ChannelName
from system.estimation.evidence import Score, score


@dataclass(frozen=True)
class ChannelMisfit:
    """One channel's chi-square per degree of freedom, and its share of all channels' excess."""

    chi2_per_dof: float
    share: float


@dataclass(frozen=True)
class Detection:
    """Goodness of fit, the candidates by strength, how surprising the strongest is, and flags.

    p_value, chi2_per_dof: of the objective of the linear posterior with n degrees of freedom, n readings; chance:
    of any candidate as striking as the strongest where nothing is there.
    """

    p_value: float
    chi2_per_dof: float
    channels: Mapping[ChannelName, ChannelMisfit]
    chance: float
    strongest: tuple[tuple[Candidate, Score], ...]
    flags: tuple[Region, ...]


def detect(study: Study, thresholds: Thresholds) -> Detection:
    """What in the readings the simulator, its tolerances and the noise do not account for.

    The objective r.r + xi.xi at the peak is that of the readings' own distribution N(0, 1 + A A^T): it is
    chi-square distributed with n degrees of freedom where noise is normal, without a bootstrap. Heavy tails of
    the noise raise it; the directed scores of the candidates are averages over many readings and stand them.
    """
    base = study.base
    scored = [(candidate, score(base, candidate.column)) for candidate in study.candidates]
    log_p = log_chances(np.array([found.z for _, found in scored]), study.candidates)
    order = np.argsort(log_p, kind="stable")
    by_channel = {
        ChannelName.named(channel.name): contrasts(base, at)
        for at, channel in enumerate(study.observations.channels)
    }
    readings = base.residual.size
    return Detection(
        p_value=float(chi2.sf(base.objective, readings)),
        chi2_per_dof=base.objective / readings,
        channels=channel_misfits(study),
        chance=family_chance(base, study.candidates, log_p, thresholds.mismatch.draws, thresholds.seeds.detect),
        strongest=tuple(scored[at] for at in order),
        flags=flagged(by_channel, axis_values(study.recording), thresholds.mismatch.flag_rate),
    )


def channel_misfits(study: Study) -> dict[ChannelName, ChannelMisfit]:
    """Chi-square of each channel over what the model leaves it free, and its share of the excess."""
    found = misfit(study.base)
    observed, free = (found.pull**2).sum(axis=0), found.variance.sum(axis=0)
    excess = np.maximum(observed - free, 0.0)
    share = excess / excess.sum() if excess.any() else excess
    return {
        ChannelName.named(channel.name): ChannelMisfit(float(observed[at] / free[at]), float(share[at]))
        for at, channel in enumerate(study.observations.channels)
        if free[at] > 0
    }
