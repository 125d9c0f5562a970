"""A mismatch that no entry explains, described by the exponents of what it grows with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from system.channels import ChannelName


@dataclass(frozen=True)
class Scaling:
    """Residual of a channel ~ powers of speed, pressure, displacement, viscosity: exponents and their sigma."""

    channel: ChannelName
    exponents: Mapping[str, float]
    sigma: Mapping[str, float]
