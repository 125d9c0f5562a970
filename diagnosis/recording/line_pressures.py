"""Pressures of the lines at inlet and case: set at several levels, or held."""

from __future__ import annotations

import numpy as np

from diagnosis.recording.model import Recording, reading_sigma
from system.inputs.channels import ChannelName
from system.inputs.units import STANDARD_ATMOSPHERE

LINES = (ChannelName.P_IN, ChannelName.P_CASE)
LEAST_SHARE = 0.1  # of the largest absolute pressure: less is the accuracy of its control
NOISE = 8.0  # sigma: the range of noise alone in any recording


def varied_lines(recording: Recording) -> tuple[ChannelName, ...]:
    """Those of the LINES whose pressure varies over the recording, beyond control and scatter."""
    return tuple(name for name in LINES if _varies(recording, name))


def _varies(recording: Recording, name: ChannelName) -> bool:
    column, channel = recording.steady.column(name), recording.channel(name)
    known = column[np.isfinite(column)]
    if not known.size:
        return False
    scatter = 0.0 if channel is None else NOISE * float(np.median(reading_sigma(channel, known)))
    return bool(np.ptp(known) > max(LEAST_SHARE * float(np.max(np.abs(known + STANDARD_ATMOSPHERE))), scatter))
