"""Content of a `recording.toml`: tables, channels with their units and noise, steady windows, traces."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, make_dataclass, replace
from pathlib import Path
from shlex import quote
from typing import Annotated, Any

from diagnosis.recording.channel_form import (
    ChannelForm,
    ChannelSection,
    Column,
    PressureReference,
    channel_form,
    channel_section,
)
from diagnosis.recording.model import Circuit
from diagnosis.recording.tables.table import TableSource
from system.inputs.channels import ChannelName
from system.inputs.sections.fields import Format, Positive, Section, Text, UnitOf
from system.inputs.sections.json_schema import Schema, file_schema, section_schema
from system.inputs.sections.reader import Reading, read_section
from system.inputs.units import Dimension, unit_scale

AngleSection, ChamberSection = channel_section(ChannelName.ANGLE), channel_section(ChannelName.P_CHAMBER)
_MEASURED = tuple(name for name in ChannelName if name not in (ChannelName.ANGLE, ChannelName.P_CHAMBER))
Words = Annotated[str, Text.WORDS]
TIME = 'time = { column = "time", unit = "s" }, a column of the table: where it has none, row number over sampling rate'
"""Remedy for a series without its time."""
Duration = Annotated[float, Dimension.TIME, Positive]


@dataclass(frozen=True, kw_only=True)
class TimeColumnSection:
    """time: column of time."""

    column: Column
    unit: Annotated[str, UnitOf(Dimension.TIME)]

    @property
    def factor(self) -> float:
        """Seconds of one unit."""
        return unit_scale(self.unit, Dimension.TIME)[0]


@dataclass(frozen=True, kw_only=True)
class TableSection:
    """A table, and its form where the program cannot detect it."""

    sheet: Words = ""  # of a workbook with several
    decimal: Words = ""  # "." or "," in text
    separator: Words = ""  # of cells in text
    group: Words = ""  # of a TDMS file with several
    variable: Words = ""  # of a MAT file: the struct or matrix

    def source(self, path: Path) -> TableSource:
        """Return the table in this form at a path."""
        return TableSource(path, self.sheet, self.decimal, self.separator, self.group, self.variable)


@dataclass(frozen=True, kw_only=True)
class PointsSection(TableSection):
    """Table of the points."""

    file: Words = ""  # the table, from the folder of the recording


@dataclass(frozen=True, kw_only=True)
class SteadySection(PointsSection):
    """[steady]: one row is one steady point."""

    repeats: Column | None = None  # numbers, equal for points that repeat a set point
    time: TimeColumnSection | None = None


@dataclass(frozen=True, kw_only=True)
class SteadinessSection:
    """[series.steady]: the rule by which a stretch is steady."""

    window: Duration = 10.0  # shortest stretch
    slope: Annotated[float, Positive] = 3.0  # standard errors


@dataclass(frozen=True, kw_only=True)
class SeriesSection(PointsSection):
    """[series]: a time series, of which the steady stretches are the points."""

    time: TimeColumnSection
    steady: SteadinessSection = SteadinessSection()
    raster: Duration | None = None  # step on which the series is averaged first


@dataclass(frozen=True, kw_only=True)
class TracesSection(TableSection):
    """[traces]: chamber pressure over shaft angle from the inner dead centre."""

    file: Annotated[str, Text.NAME]  # the table, from the folder of the recording
    point: Column  # names the steady point of each row
    cycles: Column | None = None  # numbers the turns
    angle: AngleSection  # type: ignore[valid-type]
    p_chamber: ChamberSection  # type: ignore[valid-type]
    encoder_offset: Annotated[float, Dimension.ANGLE, Positive] | None = None  # one sigma of the angle's zero


def _at_least_one(channels: Section) -> None:
    """Raise ValueError for a table without a channel."""
    if not any(vars(channels).values()):
        raise ValueError(f"at least one of {', '.join(name.value for name in _MEASURED)}")


ChannelTables = make_dataclass(
    "ChannelTables",
    [(name.value, channel_section(name) | None, None) for name in _MEASURED],
    frozen=True,
    namespace={"__doc__": "[channel]: what is measured at the points.", "__post_init__": _at_least_one},
)


@dataclass(frozen=True, kw_only=True)
class RecordingSection:
    """A recording: the tables of readings and the channels in them."""

    format: Annotated[int, Format(1, "recording")]
    title: Words = ""  # left out: the folder's name
    pump: Words = ""  # the pump on the bench
    oil: Words = ""  # on the bench; compared with the pump file's
    order: Words = ""  # for the reader: the order of the points
    circuit: Circuit = Circuit.OPEN
    pressure_reference: PressureReference | None = None  # left out: gauge, with a note
    steady: SteadySection | None = None
    series: SeriesSection | None = None
    channel: ChannelTables  # type: ignore[valid-type]
    traces: TracesSection | None = None


@dataclass(frozen=True)
class TraceForm:
    """[traces]: its table, and its two channels in SI."""

    source: TableSource
    stated: TracesSection
    angle: ChannelForm
    pressure: ChannelForm


@dataclass(frozen=True)
class RecordingForm:
    """A whole `recording.toml`, checked by itself; points: [steady] or [series], source: its table."""

    title: str
    stated: RecordingSection
    points: SteadySection | SeriesSection
    source: TableSource
    channels: tuple[ChannelForm, ...]
    traces: TraceForm | None


def read_form(tables: Mapping[str, Any], reading: Reading, data: Path | None) -> RecordingForm | None:
    """Return the content of the file; None with its faults noted.

    Files are named from the folder of the reading; `data` is the file of [steady] or [series] if none is stated.
    """
    stated = read_section("", RecordingSection, tables, reading)
    points = [name for name in ("steady", "series") if name in tables]
    if len(points) != 1:
        found = "both [steady] and [series]" if points else "neither [steady] nor [series]"
        reading.fault("steady", found, "one of the two: a table of steady points or a time series")
    for name in points:
        if data is None and not getattr(getattr(stated, name), "file", "stated with another fault"):
            expected = "the path of the table, from the folder of the recording"
            reading.fault(f"{name}.file", "missing", expected)
        if data is not None:
            _hold_table(name, stated, reading, data)
    absent = ("series.time", "missing")
    reading.faults[:] = [
        replace(one, nearest=TIME) if (one.path, one.found) == absent else one for one in reading.faults
    ]
    own = getattr(stated, "steady", None) or getattr(stated, "series", None)
    if reading.faults or own is None:
        return None
    folder, reference = reading.folder, stated.pressure_reference or PressureReference.GAUGE
    source = own.source(folder / own.file if own.file else (data or folder))
    channels = tuple(channel_form(ChannelName.named(key), one, reference) for key, one in _stated(stated.channel))
    traces = None if stated.traces is None else _trace_form(stated.traces, folder, reference)
    return RecordingForm(stated.title or folder.name, stated, own, source, channels, traces)


def _hold_table(name: str, stated: object, reading: Reading, data: Path) -> None:
    """Add the fault of a recording that names other tables than the one asked for, `data`, which lies beside it."""
    own, traces = (getattr(getattr(stated, part, None), "file", "") for part in (name, "traces"))
    if not own or data.resolve() in [(reading.folder / file).resolve() for file in (own, traces) if file]:
        return
    expected = f"'{data.name}', the table asked for; or no file, for any table beside the recording.toml"
    table, toml = quote(str(data)), quote(str(data.with_suffix(".toml")))
    near = f"a recording of its own: swashfilm new recording {table} -o {toml}"
    reading.fault(f"{name}.file", repr(own), expected, near)


def recording_schema() -> Schema:
    """Return the JSON Schema of a `recording.toml`; a table beside one need not be named as its file."""
    schema = section_schema(RecordingSection)
    schema["oneOf"] = [{"required": [name]} for name in ("steady", "series")]
    schema["properties"]["channel"]["minProperties"] = 1
    return file_schema("Swashfilm recording", schema)


def _stated(channels: Section) -> list[tuple[str, ChannelSection]]:
    return [(key, one) for key, one in vars(channels).items() if one is not None]


def _trace_form(stated: TracesSection, folder: Path, reference: PressureReference) -> TraceForm:
    angle = replace(channel_form(ChannelName.ANGLE, stated.angle, reference), zero=stated.encoder_offset)
    pressure = channel_form(ChannelName.P_CHAMBER, stated.p_chamber, reference)
    return TraceForm(stated.source(folder / stated.file), stated, angle, pressure)
