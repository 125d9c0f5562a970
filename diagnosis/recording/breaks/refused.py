"""Recordings that are several in one file: faults of units and pumps that change from one row on."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from diagnosis.recording.breaks.two_pumps import pump_changes, pumps_named
from diagnosis.recording.breaks.unit_changes import unit_changes
from diagnosis.recording.channel_form import ChannelForm
from diagnosis.recording.series.standstill import all_at_rest, at_rest
from diagnosis.recording.tables.columns import ColumnReader
from diagnosis.recording.tables.table import TableColumns
from reynolds.numerics.arrays import Array
from system.inputs.channels import ChannelName

SPLIT = "a recording for each pump: split the table there"
STROKE = "the displacement_ratio as a channel, where the stroke was set anew"


def refuse_breaks(
    section: str, channels: Sequence[ChannelForm], readings: Array, columns: TableColumns, reader: ColumnReader
) -> None:
    """Add the faults of a table, [`section`], of readings (N, C) in SI as `channels`: a unit that changes, two pumps.

    A flow that jumps by a change of its unit, or because the pump rests, does not indicate another pump; nor does a
    reading about zero beside a pump at rest indicate another unit.
    """
    for column, rows in pumps_named(columns, {channel.column for channel in channels}):
        reader.fault(f"{section}.file", f"several pumps in the column {column!r}: {rows}", SPLIT)
    names = [channel.name for channel in channels]
    turning = np.where(all_at_rest(readings, names)[:, None], np.nan, readings)
    changes = list(unit_changes(turning, channels))
    for change in changes:
        path = f"channel.{change.channel.name.value}.unit"
        reader.fault(path, change.text, "one unit in all rows", f"convert the rows in '{change.unit}'")
    if not changes:
        at_work = np.where(at_rest(readings, names)[:, None], np.nan, readings)
        for jump in pump_changes(at_work, names):
            expected = SPLIT if ChannelName.DISPLACEMENT_RATIO in names else f"{SPLIT}; or {STROKE}"
            reader.fault(f"{section}.file", f"a jump of {jump}: two pumps or two settings?", expected)
