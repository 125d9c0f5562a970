"""A `recording.toml` for a bare table: guessed channels, each guess marked, and missing data listed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from diagnosis.recording.channel_form import PressureReference
from diagnosis.recording.guess.channels import GuessedChannel, GuessedColumns, guessed_columns
from diagnosis.recording.missing_inputs import origin
from diagnosis.recording.model import Circuit
from diagnosis.recording.replicates import FEWEST
from diagnosis.recording.tables.table import TableColumns, TableSource
from reynolds.numerics.arrays import Array
from system.inputs.channels import INPUTS, OUTPUTS, ChannelName
from system.inputs.toml_table import quoted
from system.inputs.units import LPM, Dimension, unit_scale

SERIES_ROWS, SERIES_STEP = 100, 10.0
"""Rows at least, and s between them at most (median), of a table with a time that counts as a time series."""
RISING = 0.95
"""Share of the steps of a time that rise."""
CHARGED = 5e5
"""Pa gauge: inlet pressure from which a circuit counts as closed."""
RARE = (ChannelName.Q_PISTON, ChannelName.Q_SLIPPER, ChannelName.Q_VALVE_PLATE)
"""Drains of one gap, which hardly a bench has: none is missing."""
NO_SHARE = "no share of full stroke: a column of tan(angle) / tan(largest angle) is the displacement_ratio"
AMBIENT = (7e4, 1.3e5)
"""Pa: inlet pressure of an open circuit that is absolute where nothing is stated."""
SIGMA_SHARE = 0.002
SIGMAS = {Dimension.TEMPERATURE: 0.3, Dimension.PRESSURE: 1e3, Dimension.VOLUME_FLOW: 0.01 / LPM}
"""One sigma of an unknown repeatability: share of the median reading, and at least this, SI."""
_COLUMN = 60  # of the comments


@dataclass(frozen=True)
class GuessedRecording:
    """A recording of a bare table: its text, its channels, guesses and missing data, in words."""

    text: str
    channels: tuple[GuessedChannel, ...]
    told: tuple[str, ...]


def guessed_recording(source: TableSource, table: TableColumns, circuit: Circuit | None) -> GuessedRecording:
    """Return the recording of a table; its text is that of a `recording.toml` beside it.

    circuit: None: guessed from the inlet pressure.
    """
    columns = guessed_columns(table)
    series = _is_series(columns, table)
    found, of_circuit = _circuit(circuit, columns, table.values)
    absent = _missing(columns, found)
    reference = next((one.reference for one in columns.channels if one.reference), None)
    rows = [
        f'# Recording of {source.path.name}. What is marked "guessed" or "assumed" the table does not tell: hold it',
        "# against the bench, correct it and delete the mark. swashfilm check shows the recording as it is read.",
        "format = 1",
        _line(f"title = {quoted(source.path.stem)}", "of the report"),
        _line(f"circuit = {quoted(found.value)}", of_circuit),
        _reference_line(reference, columns, table.values),
        *_section(source, columns, table, series),
        *_channel_rows(columns, table.values, reference, series),
        *(f"# missing: {line}" for line in absent),
        *(f"# not used: column {name!r}{f', {NO_SHARE}' if name in columns.angles else ''}" for name in columns.others),
    ]
    return GuessedRecording("\n".join(rows) + "\n", columns.channels, _told(columns, absent))


def _line(entry: str, words: str) -> str:
    return f"{entry + ' ':{_COLUMN}}# {words}"


def _is_series(columns: GuessedColumns, table: TableColumns) -> bool:
    """True for a table with many rows close to each other in time."""
    if columns.time is None or table.rows < SERIES_ROWS:
        return False
    name, unit = columns.time
    steps = np.diff(table.values[name]) * unit_scale(unit, Dimension.TIME)[0]
    return _rises(table.values[name]) and bool(np.nanmedian(steps) <= SERIES_STEP)


def _circuit(circuit: Circuit | None, columns: GuessedColumns, values: Mapping[str, Array]) -> tuple[Circuit, str]:
    """Return the circuit, and its origin in words."""
    if circuit is not None:
        return circuit, "or open, closed"
    middle = _inlet_pressure(columns, values)
    if middle is None:
        return Circuit.OPEN, "guessed: no inlet pressure; or closed"
    words = f"guessed: by the inlet pressure, {middle * 1e-5:.3g} bar"
    return Circuit.CLOSED if middle > CHARGED else Circuit.OPEN, words


def _inlet_pressure(columns: GuessedColumns, values: Mapping[str, Array]) -> float | None:
    """Return the median inlet pressure in Pa as read; None without its channel."""
    inlet = next((one for one in columns.channels if one.name is ChannelName.P_IN), None)
    return None if inlet is None else _median(values[inlet.column]) * unit_scale(inlet.unit, Dimension.PRESSURE)[0]


def _reference_line(reference: PressureReference | None, columns: GuessedColumns, values: Mapping[str, Array]) -> str:
    """Return the line of the zero of pressures, stated or guessed."""
    if reference is not None:
        return _line(f"pressure_reference = {quoted(reference.value)}", "of all pressures that state no other")
    middle = _inlet_pressure(columns, values)
    if middle is not None and AMBIENT[0] <= middle <= AMBIENT[1]:
        words = f"guessed: by the inlet pressure, {middle * 1e-5:.3g} bar; or gauge"
        return _line(f"pressure_reference = {quoted(PressureReference.ABSOLUTE.value)}", words)
    return _line(f"pressure_reference = {quoted(PressureReference.GAUGE.value)}", "guessed; or absolute")


def _section(source: TableSource, columns: GuessedColumns, table: TableColumns, series: bool) -> list[str]:
    """Return the table [steady] or [series]."""
    head = "[series]" if series else "[steady]"
    words = "a time series: its steady stretches are the points" if series else "a row is a steady point"
    rows = ["", _line(head, f"guessed: {words}"), f"file = {quoted(source.path.name)}"]
    parts = {"sheet": source.sheet, "group": source.group, "variable": source.variable}
    rows += [f"{key} = {quoted(name)}" for key, name in parts.items() if name]
    if columns.time is not None and (series or _rises(table.values[columns.time[0]])):
        name, unit = columns.time
        rows.append(f"time = {{ column = {quoted(name)}, unit = {quoted(unit)} }}")
    return rows


def _rises(times: Array) -> bool:
    """True for times that rise, but for some stamps written twice and a clock that is set back."""
    return len(times) > 1 and bool(np.mean(np.diff(times) > 0.0) >= RISING)


def _channel_rows(
    columns: GuessedColumns, values: Mapping[str, Array], reference: PressureReference | None, series: bool
) -> list[str]:
    """Return the table [channel], an entry a line."""
    rows = ["", _line("[channel]", "column of the table and its unit")]
    if not series:
        rows += [
            "# sigma: one sigma of repeatability in the channel's unit. Verdicts depend on it: state your bench's, or",
            f"# name a column that numbers set points ([steady] repeats) where {FEWEST} and more points repeat one.",
        ]
    for one in columns.channels:
        parts = [f"column = {quoted(one.column)}", f"unit = {quoted(one.unit)}"]
        doubts = [f"guessed: {words}" for words in one.doubts]
        sigma = None if series else _sigma(one, values[one.column])
        if sigma is not None:
            parts += [f"sigma = {sigma:.2g}", 'accuracy_class = "A"']
            doubts.append("assumed: sigma and class")
        if one.reference is not None and one.reference is not reference:
            parts.append(f"reference = {quoted(one.reference.value)}")
        entry = f"{one.name.value} = {{ {', '.join(parts)} }}"
        rows.append(_line(entry, "; ".join(doubts)) if doubts else entry)
    return rows


def _sigma(channel: GuessedChannel, readings: Array) -> float | None:
    """Return an assumed repeatability in the channel's unit; None for a setting, which has none."""
    dimension = channel.name.dimension
    if dimension is None:
        return None
    share = 0.0 if dimension is Dimension.TEMPERATURE else SIGMA_SHARE * abs(_median(readings))
    return max(share, SIGMAS.get(dimension, 0.0) / unit_scale(channel.unit, dimension)[0])


def _median(readings: Array) -> float:
    known = readings[np.isfinite(readings)]
    return float(np.median(known)) if len(known) else 0.0


def _missing(columns: GuessedColumns, circuit: Circuit) -> list[str]:
    """Return data for a diagnosis that the table lacks."""
    names = {one.name for one in columns.channels}
    taken = {name: origin(name, names, circuit).value for name in INPUTS if name not in names}
    lines = [f"{name.value}, taken from {where}" for name, where in taken.items()]
    return lines + [f"{name.value}, not compared" for name in OUTPUTS if name not in names and name not in RARE]


def _told(columns: GuessedColumns, absent: Sequence[str]) -> tuple[str, ...]:
    """Return the guess in lines for the terminal."""
    shown = [
        f"  {one.name.value}: column {one.column!r} in {one.unit}" + "".join(f"; {words}" for words in one.doubts)
        for one in columns.channels
    ]
    plain = [name for name in columns.others if name not in columns.angles]
    unused = [f"  not used: {', '.join(map(repr, plain))}"] if plain else []
    unused += [f"  not used: {name!r}, {NO_SHARE}" for name in columns.angles]
    return (*shown, *unused, *(f"  missing: {line}" for line in absent))
