"""A recording from its folder: form, tables, units, noise, traces; all faults at once."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from shlex import quote
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diagnosis.recording.breaks.refused import refuse_breaks
from diagnosis.recording.breaks.sampled_rows import rows_are_samples
from diagnosis.recording.channel_form import ChannelForm
from diagnosis.recording.channel_noise import recorded_channel
from diagnosis.recording.form import RecordingForm, SeriesSection, SteadySection, read_form
from diagnosis.recording.guess.unit_text import read_unit
from diagnosis.recording.model import RecordedChannel, Recording, SteadyTable
from diagnosis.recording.replicates import repeatability, set_points
from diagnosis.recording.series.points import SeriesPoints, series_points
from diagnosis.recording.tables.columns import ColumnReader, rising
from diagnosis.recording.tables.read import ENDINGS
from diagnosis.recording.tables.table import TableColumns, TableFault
from diagnosis.recording.traces import ReadTraces, read_traces
from reynolds.numerics.arrays import Array
from system.inputs.channels import INPUTS, ChannelName
from system.inputs.faults import Fault, InputFaults, nearest_path
from system.inputs.sections.reader import Reading
from system.inputs.toml_table import fault_lines, read_toml
from system.inputs.units import unit_scale

FILE = "recording.toml"


def read_recording(path: Path | str) -> Recording:
    """Return a recording in SI with gauge pressures: from its folder, its `recording.toml`, or a table that has a
    `recording.toml` beside it (then the table's file need not be stated, and is that one).

    Raises InputFaults with all faults of the file, its tables and their columns. Readings are checked by
    `checks.check.check_recording`.
    """
    path = Path(path)
    if not path.exists():
        expected = f"a recording's folder, its {FILE}, or a table beside one"
        raise InputFaults(str(path), [Fault("file", "no such file", expected, nearest_path(path))])
    stated, data = _places(path)
    if data is None and not stated.exists():
        expected = f"a {FILE} in the recording's folder"
        raise InputFaults(str(path), [Fault("file", f"no {FILE}", expected, _first_step(path))])
    if data is not None and not stated.exists():
        expected = f"a {FILE} beside the table"
        near = f"swashfilm new recording {quote(str(path))}"
        raise InputFaults(str(path), [Fault("file", f"no {stated}", expected, near)])
    text, tables = read_toml(stated)
    try:
        return recording_of_tables(str(stated), tables, stated.parent, data)
    except InputFaults as reason:
        raise InputFaults(reason.source, reason.faults, fault_lines(text, reason.faults)) from None


def recording_of_tables(label: str, tables: Mapping[str, Any], folder: Path, data: Path | None = None) -> Recording:
    """Return the recording of a `recording.toml`'s tables, as `read_recording` does; files are named from the folder.

    data: the file of [steady] or [series] if none is stated. Raises InputFaults under the name `label`.
    """
    reading = Reading(folder)
    form = read_form(tables, reading, data)
    reader = ColumnReader(reading.faults)
    recording = None if form is None else _recording(form, reader)
    if recording is None or reading.faults:
        raise InputFaults(label, reading.faults)
    return recording


def _first_step(folder: Path) -> str:
    """A recording of another name in a folder, or the command that makes one of its first table; empty without both."""
    files = sorted(one for one in folder.iterdir() if one.is_file())
    own = next((str(one) for one in files if one.suffix.lower() == ".toml"), "")
    table = next((str(one) for one in files if one.suffix.lower() in ENDINGS), "")
    return own or (f"swashfilm new recording {quote(table)}" if table else "")


def _places(path: Path) -> tuple[Path, Path | None]:
    """The recording.toml of a path, and the table at the path, if it is one."""
    if path.is_dir():
        return path / FILE, None
    if path.suffix.lower() == ".toml":
        return path, None
    return path.parent / FILE, path


@dataclass(frozen=True)
class _Points:
    """Readings (N, C) by channel of the form; set points, hours, standard errors (N, C) of means, and the table's own
    columns where its rows are the points. series: means over a time series and data on its meters; if they are
    quasi-steady, their standard errors replace a stated repeatability.
    """

    readings: Array
    numbers: NDArray[np.int64]
    hours: Array
    errors: Array | None
    columns: Mapping[str, Array]
    series: SeriesPoints | None = None

    @property
    def quasi(self) -> bool:
        return self.series is not None and self.series.quasi


def columns_of(channels: Sequence[ChannelForm]) -> list[int]:
    """Columns of some channels in a `SteadyTable`."""
    return [list(ChannelName).index(channel.name) for channel in channels]


def _recording(form: RecordingForm, reader: ColumnReader) -> Recording | None:
    """The recording of a form; None with the faults added."""
    section = "steady" if isinstance(form.points, SteadySection) else "series"
    columns = reader.columns(section, form.source)
    points = None if columns is None else _points(section, form, columns, reader)
    if points is None:
        return None
    if form.stated.pressure_reference is None and any(channel.is_pressure for channel in form.channels):
        reader.note("pressure_reference is not stated: pressures are taken as gauge")
    channels = _channels(form.channels, points, reader)
    traces = ReadTraces()
    if form.traces is not None:
        rows = points.columns.get(form.traces.stated.point)
        traces = read_traces(form.traces, reader, rows, len(points.readings))
    values = np.full((len(points.readings), len(ChannelName)), np.nan)
    values[:, columns_of(form.channels)] = points.readings
    errors = np.full_like(values, np.nan)
    if points.quasi and points.errors is not None:
        errors[:, columns_of(form.channels)] = points.errors
    series, directions = points.series, None
    if series is not None and series.directions is not None:
        directions = np.zeros((*values.shape, series.directions.shape[2]))
        directions[:, columns_of(form.channels)] = series.directions
    warming = None if series is None else series.warming
    steady = SteadyTable(values, points.numbers, points.hours, errors, directions, warming)
    channels += traces.channels
    for channel in channels:
        if channel.assumed:
            reader.note(_assumed(channel))
    stated, notes = form.stated, tuple(reader.notes)
    return Recording(form.title, stated.pump, stated.oil, stated.circuit, channels, steady, traces.blocks, notes)


def _points(section: str, form: RecordingForm, columns: TableColumns, reader: ColumnReader) -> _Points | None:
    """The steady points; None with the faults added."""
    found = [reader.column(f"channel.{c.name.value}.column", c.column, columns) for c in form.channels]
    timed = form.points.time
    time = None if timed is None else reader.column(f"{section}.time.column", timed.column, columns, rising(columns))
    _hold_units(form.channels, columns, reader)
    known = [column for column in found if column is not None]
    if len(known) < len(found) or (timed is not None and time is None):
        return None
    readings = np.stack([c.si(column) for c, column in zip(form.channels, known, strict=True)], axis=1)
    seconds = None if timed is None or time is None else timed.factor * time
    refuse_breaks(section, form.channels, readings, columns, reader)
    if isinstance(form.points, SteadySection):
        if _is_series(form, form.points, readings):
            told = f"{len(readings)} rows that hardly differ from one to the next: samples of a series, not points"
            reader.fault("steady", told, "[series] with its time, or the points' own time or repeats")
            return None
        return _steady_points(form.points, readings, seconds, columns, reader)
    return None if seconds is None else _series_points(form.points, readings, seconds, form.channels, reader)


def _is_series(form: RecordingForm, points: SteadySection, readings: Array) -> bool:
    """True for a table of points, without their time and repeats, whose rows are samples of a series."""
    names = [channel.name for channel in form.channels]
    return points.time is None and points.repeats is None and rows_are_samples(readings, names)


def _hold_units(channels: Sequence[ChannelForm], columns: TableColumns, reader: ColumnReader) -> None:
    """Warn of each channel whose unit in the table itself differs from the stated one."""
    for channel in channels:
        in_table, dimension = columns.units.get(channel.column, ""), channel.name.dimension
        own = read_unit(in_table) if in_table and dimension else None
        if own is None or dimension is None or own.dimension is not dimension:
            continue
        if not math.isclose(unit_scale(own.unit, dimension)[0], unit_scale(channel.unit, dimension)[0]):
            reader.warn(f"{channel.name.value}: read in {channel.unit} as stated; the table says {in_table}")


def _steady_points(
    form: SteadySection, readings: Array, seconds: Array | None, columns: TableColumns, reader: ColumnReader
) -> _Points | None:
    """Rows of a steady table, unchanged."""
    count = len(readings)
    marks = reader.column("steady.repeats", form.repeats, columns) if form.repeats else None
    if form.repeats and marks is None:
        return None
    numbers = np.arange(count, dtype=np.int64) if marks is None else set_points(marks)
    stamps = np.full(count, np.nan) if seconds is None else seconds
    hours = (stamps - np.min(stamps, initial=np.inf, where=np.isfinite(stamps))) / 3600.0
    return _Points(readings, numbers, hours, None, columns.values)


def _series_points(
    form: SeriesSection, readings: Array, seconds: Array, channels: Sequence[ChannelForm], reader: ColumnReader
) -> _Points | None:
    """Means over the steady stretches of a series."""
    silent = [one for one, column in zip(channels, readings.T, strict=True) if _is_silent(one, column)]
    for one in silent:
        _refuse_silent(one, reader)
    if silent:
        return None
    try:
        series = series_points(form, seconds, readings, channels)
    except TableFault as reason:
        reader.fault("series", reason.found, reason.expected, reason.nearest)
        return None
    for note in series.notes:
        reader.note(note)
    numbers = np.arange(len(series.means), dtype=np.int64)
    return _Points(series.means, numbers, series.hours, series.errors, {}, series)


def _is_silent(channel: ChannelForm, readings: Array) -> bool:
    """True without any reading; of the torque meter with the pump uncoupled, which is read where it suits, never."""
    return channel.name is not ChannelName.TORQUE_UNCOUPLED and not np.isfinite(readings).any()


def _refuse_silent(channel: ChannelForm, reader: ColumnReader) -> None:
    name = channel.name.value
    reader.fault(f"channel.{name}", f"{name} has no reading at any point", "readings as they were taken")


def _channels(forms: Sequence[ChannelForm], points: _Points, reader: ColumnReader) -> tuple[RecordedChannel, ...]:
    """Channels with their noise; a fault for each without a reading, and for each without a repeatability."""
    inputs = points.readings[:, [k for k, form in enumerate(forms) if form.name in INPUTS]]
    channels = []
    for k, form in enumerate(forms):
        if _is_silent(form, points.readings[:, k]):
            _refuse_silent(form, reader)
            continue
        followed = inputs[:, :0] if form.name in INPUTS else inputs
        found = repeatability(points.readings[:, k], followed, points.numbers)
        if found is None and points.errors is not None and np.isfinite(points.errors[:, k]).any():
            found = float(np.sqrt(np.nanmean(points.errors[:, k] ** 2)))
        held = replace(form, sigma=None, sigma_relative=None, quantum=0.0) if points.quasi else form
        channel = recorded_channel(held, points.readings[:, k], found)
        if channel is not None and points.quasi:  # standard errors of the means are known
            channel = replace(channel, assumed=tuple(one for one in channel.assumed if one != "sigma"))
        if channel is None:
            reader.fault(
                f"channel.{form.name.value}.sigma",
                "missing, and too few repeated set points to estimate it",
                "sigma or sigma_relative (one sigma of repeatability), or a repeats column with 5 or more repeats",
            )
        else:
            channels.append(_with_zero(channel, 0.0 if points.series is None else float(points.series.zeros[k])))
    return tuple(channels)


def _with_zero(channel: RecordedChannel, least: float) -> RecordedChannel:
    """The channel with a zero no better than its readings show, if not stated."""
    unknown = "zero" in channel.assumed
    return replace(channel, zero_sigma=max(channel.zero_sigma, least)) if unknown else channel


def _assumed(channel: RecordedChannel) -> str:
    """Assumptions for a channel as text, in the unit of its file."""
    dimension = channel.name.dimension
    factor = 1.0 if dimension is None else unit_scale(channel.unit, dimension)[0]
    unit = "" if dimension is None else f" {channel.unit}"
    values = {
        "sigma": f"repeatability from its scatter, {channel.sigma / factor:.3g}{unit}",
        "quantum": f"step of its readings {channel.quantum / factor:.3g}{unit}",
        "gain": f"gain good to {channel.gain_sigma:.2%}",
        "zero": f"zero good to {channel.zero_sigma / factor:.3g}{unit}",
    }
    return f"{channel.name.value}: not stated, taken: {'; '.join(values[name] for name in channel.assumed)}"
