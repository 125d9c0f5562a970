"""Tables and columns that a recording names, with faults for those not found and notes on the tables."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from diagnosis.recording.model import DataNote, NoteKind
from diagnosis.recording.tables.read import read_columns
from diagnosis.recording.tables.table import TableColumns, TableFault, TableSource
from reynolds.numerics.arrays import Array
from system.inputs.faults import Fault, nearest_choice


@dataclass
class ColumnReader:
    """Collects faults and notes of one recording while its tables are read."""

    faults: list[Fault]
    notes: list[DataNote] = field(default_factory=list)

    def fault(self, path: str, found: str, expected: str, nearest: str = "") -> None:
        """Add one fault."""
        self.faults.append(Fault(path, found, expected, nearest))

    def note(self, text: str) -> None:
        """Add a note on the data."""
        self.notes.append(DataNote(NoteKind.NOTED, None, (), text))

    def warn(self, text: str) -> None:
        """Add a warning on the data; reports begin with the warnings."""
        self.notes.append(DataNote(NoteKind.WARNED, None, (), text))

    def columns(self, section: str, source: TableSource) -> TableColumns | None:
        """The columns of a section's table; None with the fault added."""
        try:
            columns = read_columns(source)
        except TableFault as reason:
            self.fault(f"{section}.file", reason.found, reason.expected, reason.nearest)
            return None
        for text in columns.notes:
            self.note(f"{source.path.name}: {text}")
        return columns

    def column(self, path: str, name: str, columns: TableColumns, likely: str = "") -> Array | None:
        """A column by name, for the key at `path`; None with the fault added. likely: a possible column without a
        similar name.
        """
        if name in columns.values:
            return columns.values[name]
        expected = f"one of the columns {', '.join(columns.values)}"
        self.fault(path, repr(name), expected, nearest_choice(name, columns.values) or likely)
        return None


def rising(columns: TableColumns) -> str:
    """Name of the first column that rises from row to row, as a time does; empty without one."""
    rises = (name for name, column in columns.values.items() if len(column) > 1 and np.all(np.diff(column) > 0.0))
    return next(rises, "")
