"""Is there a mismatch beyond noise and tolerance?"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from diagnosis.study import Candidate
from system.channels import ChannelName
from system.estimation.evidence import Score


@dataclass(frozen=True)
class ChannelMisfit:
    """One channel's chi-square per reading, and its share of the whole mismatch."""

    chi2_per_dof: float
    share: float


@dataclass(frozen=True)
class Region:
    """A part of the map where a channel stands out: bounds in SI by input name, contrast in sigma, and words."""

    channel: ChannelName
    lower: Mapping[str, float]
    upper: Mapping[str, float]
    contrast: float
    text: str


@dataclass(frozen=True)
class Detection:
    """Goodness of fit (p by bootstrap), the smallest p of all candidates after Holm, the strongest, and flags."""

    p_value: float
    chi2_per_dof: float
    channels: Mapping[ChannelName, ChannelMisfit]
    holm_p: float
    strongest: tuple[tuple[Candidate, Score], ...]
    flags: tuple[Region, ...]
