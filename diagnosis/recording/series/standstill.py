"""Standstill of the pump in a series: samples at which it does not turn or deliver."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from diagnosis.recording.series.stretches import stretches, times
from diagnosis.recording.tables.table import TableFault
from diagnosis.recording.units import channel_unit, reading
from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName

REST = 0.05  # of the usual reading of a pump at work: below it the pump rests
WORKING = 0.8  # quantile of the magnitudes that is the usual reading
MARGIN = 3  # samples beside a rest in which the pump runs up or down
_OF_REST = (ChannelName.SPEED, ChannelName.Q_OUT, ChannelName.Q_IN)
"""Channels that show a rest; the first of them that is measured decides."""


def without_standstill(time: Array, readings: Array, names: Sequence[ChannelName]) -> tuple[Array, tuple[str, ...]]:
    """Readings (T, C) without those of a pump at rest, and notes; columns as `names`, time (T,) in s.

    By speed, or by flow where speed is not measured and the swash plate is not known to be at zero. Raises TableFault
    for a series at rest throughout.
    """
    name = next((one for one in _OF_REST if one in names), None)
    if name is None:
        return readings, ()
    size = np.abs(readings[:, list(names).index(name)])
    known = size[np.isfinite(size)]
    if not len(known):
        return readings, ()
    if not np.any(known > 0.0):
        raise TableFault(f"{name.value} at 0 throughout", "a pump that turns")
    with np.errstate(invalid="ignore"):
        rests = size < REST * np.quantile(known[known > 0.0], WORKING)
    if name is not ChannelName.SPEED and ChannelName.DISPLACEMENT_RATIO in names:
        ratio = np.abs(readings[:, list(names).index(ChannelName.DISPLACEMENT_RATIO)])
        with np.errstate(invalid="ignore"):
            rests &= ~(ratio < REST)
    if not rests.any():
        return readings, ()
    aside = np.convolve(rests, np.ones(2 * MARGIN + 1), "same") > 0.5
    limit = f"{reading(name, REST * float(np.quantile(known[known > 0.0], WORKING))):.3g} {channel_unit(name)}"
    note = f"{name.value} is below {limit}, the pump at rest, {times(time, stretches(rests))}: put aside"
    return np.where(aside[:, None], np.nan, readings), (note,)
