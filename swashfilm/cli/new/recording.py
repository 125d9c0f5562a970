"""A new recording: `recording.toml` beside a bare table."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from shlex import quote

from diagnosis.recording.guess.written import GuessedRecording, guessed_recording
from diagnosis.recording.model import Circuit
from diagnosis.recording.reader import FILE, recording_of_tables
from diagnosis.recording.tables.read import read_columns
from diagnosis.recording.tables.table import TableFault, TableSource
from reynolds.numerics.files import is_file
from swashfilm.cli.new.file import NewFile
from system.inputs.channels import OUTPUTS
from system.inputs.faults import Fault, InputFaults, nearest_choice, nearest_path
from system.inputs.toml_table import parse_toml

_PARTS: Mapping[str, Callable[[TableSource, str], TableSource]] = {
    ".xlsx": lambda source, name: replace(source, sheet=name),
    ".tdms": lambda source, name: replace(source, group=name),
    ".mat": lambda source, name: replace(source, variable=name),
}
"""A table's named part, by the extension of tables that have several."""
_ASKS_PART = re.compile(r"\b(sheet|group|variable) = ")


def new_recording(
    table: str | None, part: str | None, circuit: str | None, path: Path, faults: list[Fault]
) -> NewFile | None:
    """Return the recording of a table, which lies beside it; None with faults added.

    Of several tables in a folder each may have a recording of its own name.
    """
    known = [one.value for one in Circuit]
    if circuit is not None and circuit not in known:
        near = nearest_choice(circuit, known)
        faults.append(Fault("--circuit", repr(circuit), f"one of {', '.join(known)}", near))
    source = _source(table, part, faults)
    if source is not None and path.parent.resolve() != source.path.parent.resolve():
        near = str(source.path.parent / path.name)
        faults.append(Fault("--output", f"'{path}'", "a file beside the table, which it names", near))
    if source is None or faults:
        return None
    try:
        guess = guessed_recording(source, read_columns(source), None if circuit is None else Circuit(circuit))
    except TableFault as reason:
        asks = part is None and _ASKS_PART.search(reason.expected)
        mend = f"--part {quote(reason.nearest.split(', ')[0] or 'NAME')}" if asks else reason.nearest
        faults.append(Fault("TABLE", reason.found, reason.expected, mend))
        return None
    faults += _faults(guess)
    if faults:
        return None
    word = quote(str(source.path if path.name == FILE else path))
    told = (*guess.told, *_doubts(guess, path), f"next: swashfilm check {word}")
    return NewFile(path, "recording", guess.text, (*told, f"then: swashfilm diagnose PUMP {word}"))


def _doubts(guess: GuessedRecording, path: Path) -> Iterator[str]:
    """Yield the faults of the readings with the guessed columns: a wrong guess is corrected in the file."""
    try:
        recording_of_tables(str(path), parse_toml(guess.text), path.parent)
    except InputFaults as reason:
        yield from (f"warning: {one.path}: {one.found}; expected {one.expected}" for one in reason.faults)


def _source(table: str | None, part: str | None, faults: list[Fault]) -> TableSource | None:
    """Return the table and its part; None with the fault added."""
    if table is None or not is_file(Path(table)):
        found = "missing" if table is None else f"'{table}', no such file"
        expected = "a table (.csv, .xlsx, .tdms, .mf4, .mat, .parquet)"
        faults.append(Fault("TABLE", found, expected, nearest_path(Path(table)) if table else ""))
        return None
    source = TableSource(Path(table))
    if part is None:
        return source
    extension = source.path.suffix.lower()
    if extension not in _PARTS:
        faults.append(Fault("--part", repr(part), f"no part, or a table of {', '.join(_PARTS)}"))
        return None
    return _PARTS[extension](source, part)


def _faults(guess: GuessedRecording) -> list[Fault]:
    """Return the fault of a table without any output of a pump's simulation."""
    if any(one.name in OUTPUTS for one in guess.channels):
        return []
    found = ", ".join(one.column for one in guess.channels) or "no column that heads tell"
    expected = "heads of a flow, a torque, a motor power or the outlet's temperature, such as 'Q_out [L/min]'"
    return [Fault("TABLE", found, expected)]
