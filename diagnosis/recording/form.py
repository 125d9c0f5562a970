"""Content of a `recording.toml`: tables, channels with their units and noise, steady windows, traces."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from diagnosis.recording.channel_form import ChannelForm, PressureReference, TimeForm, read_channel, read_time
from diagnosis.recording.model import Circuit
from diagnosis.recording.tables.table import TableSource
from system.inputs.channels import ChannelName
from system.inputs.faults import stated
from system.inputs.toml_table import Table
from system.inputs.units import Dimension

FORMAT = 1
_SOURCE_KEYS = ("sheet", "decimal", "separator", "group", "variable")
WINDOW = 10.0  # s
STANDARD_ERRORS = 3.0
_TRACED = (ChannelName.ANGLE, ChannelName.P_CHAMBER)


@dataclass(frozen=True)
class SteadyForm:
    """[steady]: one row a steady point. repeats: column whose equal values mark one set point, or empty."""

    source: TableSource
    repeats: str
    time: TimeForm | None


@dataclass(frozen=True)
class SeriesForm:
    """[series]: a time series. Steady: window in s, slope in standard errors; raster in s, 0 for as is."""

    source: TableSource
    time: TimeForm
    window: float
    slope: float
    raster: float


@dataclass(frozen=True)
class TraceForm:
    """[traces]: chamber pressure over shaft angle; point, cycles: columns (cycles may be empty)."""

    source: TableSource
    point: str
    cycles: str
    angle: ChannelForm
    pressure: ChannelForm


@dataclass(frozen=True)
class RecordingForm:
    """A whole `recording.toml`, checked by itself; `points` is [steady] or [series].

    reference_stated: the file states the zero of its pressures (else they are gauge).
    """

    title: str
    pump: str
    oil: str
    circuit: Circuit
    reference_stated: bool
    points: SteadyForm | SeriesForm
    channels: tuple[ChannelForm, ...]
    traces: TraceForm | None


def read_form(top: Table, folder: Path, data: Path | None) -> RecordingForm | None:
    """Return the content of the file; None with faults added to `top`.

    Files are named from `folder`; `data` is the file of [steady] or [series] if none is stated.
    """
    _format(top)
    title, pump, oil = (_text(top, key) for key in ("title", "pump", "oil"))
    _text(top, "order")
    circuit = top.choice("circuit", Circuit, Circuit.OPEN)
    reference = (
        top.choice("pressure_reference", PressureReference, PressureReference.GAUGE) or PressureReference.GAUGE
    )
    points = _points(top, folder, data)
    channels = _channels(top, reference)
    traces = _traces(top, folder, reference)
    top.close()
    if top.faults or points is None or circuit is None:
        return None
    return RecordingForm(
        title or folder.name, pump, oil, circuit, "pressure_reference" in top.values, points, channels, traces
    )


def _format(top: Table) -> None:
    number = top.get("format")
    if isinstance(number, bool) or number != FORMAT:
        top.fault("format", stated(number), f"format = {FORMAT}, the recording format of this version")


def _text(table: Table, key: str) -> str:
    """A text, empty where the key is left out."""
    raw = table.get(key)
    if raw is not None and not isinstance(raw, str):
        table.fault(key, repr(raw), "a text")
    return raw if isinstance(raw, str) else ""


def _source(table: Table, folder: Path, data: Path | None) -> TableSource:
    """The table's file and the stated form."""
    file = _text(table, "file")
    if not file and data is None:
        table.fault("file", "missing", "the path of the table, from the folder of the recording")
    form: dict[str, Any] = {key: _text(table, key) for key in _SOURCE_KEYS}
    return TableSource(folder / file if file else (data or folder), **form)


def _points(top: Table, folder: Path, data: Path | None) -> SteadyForm | SeriesForm | None:
    steady, series = top.table("steady"), top.table("series")
    if (steady is None) == (series is None):
        found = "both [steady] and [series]" if steady else "neither [steady] nor [series]"
        top.fault("steady", found, "one of the two: a table of steady points or a time series")
    if steady is not None:
        form = SteadyForm(_source(steady, folder, data), _text(steady, "repeats"), read_time(steady, needed=False))
        steady.close()
        return form
    return None if series is None else _series(series, folder, data)


def _series(series: Table, folder: Path, data: Path | None) -> SeriesForm | None:
    source, time = _source(series, folder, data), read_time(series, needed=True)
    raster = series.positive("raster", Dimension.TIME) if "raster" in series.values else 0.0
    rule = series.table("steady")
    window: float | None = WINDOW
    slope: float | None = STANDARD_ERRORS
    if rule is not None:
        window = rule.positive("window", Dimension.TIME, WINDOW)
        slope = rule.number("slope", STANDARD_ERRORS)
        if slope is not None and slope <= 0.0:
            rule.fault("slope", repr(slope), "a number of standard errors above zero")
        rule.close()
    series.get("raster")
    series.close()
    if time is None or window is None or slope is None or raster is None:
        return None
    return SeriesForm(source, time, window, slope, raster)


def _channels(top: Table, reference: PressureReference) -> tuple[ChannelForm, ...]:
    table = top.table("channel", needed="with at least one channel")
    if table is None:
        return ()
    names = [name for name in ChannelName if name not in _TRACED]
    forms = []
    for name in names:
        if (one := table.table(name.value)) is not None:
            forms.append(read_channel(one, name, reference))
    table.close()
    if not table.values:
        top.fault("channel", "no channel", f"at least one of {', '.join(name.value for name in names)}")
    return tuple(form for form in forms if form is not None)


def _traces(top: Table, folder: Path, reference: PressureReference) -> TraceForm | None:
    table = top.table("traces")
    if table is None:
        return None
    source, point, cycles = _source(table, folder, None), _text(table, "point"), _text(table, "cycles")
    if not point:
        table.fault("point", "missing", "the column that names the steady point of each row")
    parts = [table.table(name.value, needed="with column and unit") for name in _TRACED]
    read = [
        None if part is None else read_channel(part, name, reference)
        for part, name in zip(parts, _TRACED, strict=True)
    ]
    offset = table.positive("encoder_offset", Dimension.ANGLE) if "encoder_offset" in table.values else None
    table.get("encoder_offset")
    table.close()
    angle, pressure = read
    if angle is None or pressure is None:
        return None
    return TraceForm(source, point, cycles, replace(angle, zero=offset), pressure)
