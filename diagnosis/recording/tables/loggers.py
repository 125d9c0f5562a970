"""Tables in the files of measurement loggers: NI TDMS and ASAM MDF 4."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

import numpy as np

from diagnosis.recording.tables.table import TableColumns, TableFault, TableSource, expect_few, foreign
from diagnosis.recording.tables.workbooks import missing

_ARITHMETIC = re.compile(r"(?:[\w\s+\-*/^%(),<>=!&|]|\.(?![A-Za-z_]))*", re.ASCII)
TIME = "time"
"""Column of time in s that a logger's file holds without naming it."""
APPLIED_SCALES = frozenset(
    {"Linear", "Polynomial", "RTD", "Table", "Thermocouple", "Thermistor", "Strain", "Add", "Subtract", "AdvancedAPI"}
)
"""Scale types that npTDMS 1.x applies; of a channel with any other it returns raw counts."""


def read_tdms(source: TableSource) -> TableColumns:
    """Return the channels of the stated group of a TDMS file, or of its only group, scaled.

    A channel's own time base is the column `time`. Channels of another length than most are left out, with a note.
    Raises TableFault where npTDMS is not installed, for an unknown group, and for a channel with a scale that npTDMS
    does not apply (it returns raw counts: npTDMS issue 91).
    """
    try:
        from nptdms import TdmsFile
    except ImportError:
        raise missing("npTDMS", "TDMS files") from None
    with foreign(source, "a TDMS file"):
        with TdmsFile.read_metadata(source.path) as stated:
            expect_few(sum(len(channel) for group in stated.groups() for channel in group.channels()))
        return _tdms_columns(TdmsFile.read(source.path), source)


def _tdms_columns(file: Any, source: TableSource) -> TableColumns:
    """The channels of a group of a TDMS file."""
    names = [group.name for group in file.groups()]
    if (source.group or len(names) != 1) and source.group not in names:
        raise TableFault(f"the groups {', '.join(names)}", "group = the name of one of them")
    channels = file[source.group or names[0]].channels()
    for channel in channels:
        _scaled(channel)
    found = {c.name: np.asarray(c[:], dtype=float) for c in channels if np.asarray(c[:]).dtype.kind in "fiu"}
    rows = _usual([len(column) for column in found.values()])
    short = [name for name, column in found.items() if len(column) != rows]
    values = {name: column for name, column in found.items() if len(column) == rows}
    based = [c for c in channels if c.name in values and "wf_increment" in c.properties]
    if based and TIME not in values:
        values[TIME] = np.asarray(based[0].time_track(), dtype=float)
    units = {c.name: str(c.properties["unit_string"]) for c in channels if c.properties.get("unit_string")}
    return TableColumns(values, (f"left out, since of another length: {', '.join(short)}",) if short else (), units)


def _scaled(channel: Any) -> None:
    """Raise TableFault for a channel whose numbers npTDMS would leave raw."""
    count = int(channel.properties.get("NI_Number_Of_Scales", 0))
    for k in range(count):
        kind = channel.properties.get(f"NI_Scale[{k}]_Scale_Type")
        if kind is not None and kind not in APPLIED_SCALES:
            raise TableFault(
                f"channel {channel.name!r} with the scale {kind!r}, which npTDMS does not apply",
                f"a scale of {', '.join(sorted(APPLIED_SCALES))}",
                "export the scaled values, for instance as CSV",
            )


def read_mdf(source: TableSource) -> TableColumns:
    """Return the number channels of an MDF file over the union of their times, interpolated, as physical values.

    The column `time` holds s from the start. Raises TableFault where asammdf is not installed or cannot read.
    """
    try:
        from asammdf import MDF
    except ImportError:
        raise missing("asammdf", "MDF files") from None
    with foreign(source, "an MDF file"), MDF(source.path) as file:
        groups = [(group.channel_group.cycles_nr, len(group.channels)) for group in file.groups]
        expect_few(sum(rows for rows, _ in groups) * sum(channels for _, channels in groups))
        _expect_arithmetic(channel for group in file.groups for channel in group.channels)
        units = {channel.name: str(channel.unit) for group in file.groups for channel in group.channels if channel.unit}
        frame = file.to_dataframe(time_from_zero=False, use_interpolation=True)
    values = {str(name): frame[name].to_numpy(dtype=float) for name in frame if frame[name].dtype.kind in "fiu"}
    left_out = [str(name) for name in frame if str(name) not in values]
    values.setdefault(TIME, frame.index.to_numpy(dtype=float))
    return TableColumns(values, (f"left out, since not numbers: {', '.join(left_out)}",) if left_out else (), units)


def _expect_arithmetic(channels: Iterable[Any]) -> None:
    """Raise TableFault for a conversion whose formula is more than arithmetic, since a library evaluates it."""
    for channel in channels:
        formula = getattr(channel.conversion, "formula", "")
        if formula and ("__" in formula or not _ARITHMETIC.fullmatch(formula)):
            raise TableFault(
                f"channel {channel.name!r} with the formula {formula[:80]!r}", "a formula of numbers and X"
            )


def _usual(lengths: list[int]) -> int:
    """The most frequent length."""
    return max(set(lengths), key=lengths.count, default=0)
