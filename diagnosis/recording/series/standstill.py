"""Standstill of the pump in a series: samples at which it does not turn or deliver."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.ndimage import binary_dilation

from diagnosis.recording.series.stretches import Mask, stretches, times
from diagnosis.recording.tables.table import TableFault
from diagnosis.recording.units import channel_unit, reading
from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName

REST = 0.05  # of the usual reading of a pump at work: below it the pump rests
WORKING = 0.8  # quantile of the magnitudes that is the usual reading
MARGIN = 3  # samples beside a rest in which the pump runs up or down
_OF_REST = (ChannelName.SPEED, ChannelName.Q_OUT, ChannelName.Q_IN)
"""Channels that indicate a rest; the first measured one decides."""


def without_standstill(time: Array, readings: Array, names: Sequence[ChannelName]) -> tuple[Array, tuple[str, ...]]:
    """Readings (T, C) without those of a pump at rest, and notes; columns as `names`, time (T,) in s.

    Raises TableFault for a series at rest throughout.
    """
    rests = at_rest(readings, names)
    if not rests.any():
        return readings, ()
    name = _of_rest(names)
    assert name is not None
    column = readings[:, list(names).index(name)]
    if not np.any(np.abs(column) > 0.0):
        raise TableFault(f"{name.value} at 0 throughout", "a pump that turns")
    aside = binary_dilation(rests, iterations=MARGIN)
    limit = f"{reading(name, _limit(column)):.3g} {channel_unit(name)}"
    note = f"{name.value} is below {limit}, the pump at rest, {times(time, stretches(rests))}: put aside"
    return np.where(aside[:, None], np.nan, readings), (note,)


def at_rest(readings: Array, names: Sequence[ChannelName]) -> Mask:
    """Samples (T,) at which the pump rests: by speed, or by flow where speed is not measured and the swash plate is
    not known to be at zero; readings (T, C) in SI.
    """
    name = _of_rest(names)
    if name is None:
        return np.zeros(len(readings), dtype=bool)
    rests = _low(readings[:, list(names).index(name)])
    if name is not ChannelName.SPEED and ChannelName.DISPLACEMENT_RATIO in names:
        rests &= ~(np.abs(readings[:, list(names).index(ChannelName.DISPLACEMENT_RATIO)]) < REST)
    return rests


def all_at_rest(readings: Array, names: Sequence[ChannelName]) -> Mask:
    """Samples (T,) at which speed and each measured port flow are at rest; none where only one of them is measured.

    A single one may be low because its unit changes.
    """
    columns = [list(names).index(name) for name in _OF_REST if name in names]
    if len(columns) < 2:
        return np.zeros(len(readings), dtype=bool)
    return np.all([_low(readings[:, column]) for column in columns], axis=0)


def _low(column: Array) -> Mask:
    """Samples (T,) that are a small share of the usual reading of their channel at work."""
    with np.errstate(invalid="ignore"):
        return np.asarray(np.abs(column) <= _limit(column))


def _of_rest(names: Sequence[ChannelName]) -> ChannelName | None:
    return next((one for one in _OF_REST if one in names), None)


def _limit(column: Array) -> float:
    """Magnitude up to which the pump rests: a share of the usual reading at work; 0 if all readings are 0."""
    size = np.abs(column[np.isfinite(column)])
    working = size[size > 0.0]
    return REST * float(np.quantile(working, WORKING)) if len(working) else 0.0
