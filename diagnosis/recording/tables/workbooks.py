"""Tables in Excel workbooks and Parquet files."""

from __future__ import annotations

import zipfile
from typing import Any

import numpy as np

from diagnosis.recording.tables.cells import columns_of
from diagnosis.recording.tables.table import TableColumns, TableFault, TableSource, expect_few, foreign

UNPACKED = 500_000_000
"""Bytes of a workbook's parts."""
INSTALL = "pip install '.[recordings]' in the checkout"


def read_workbook(source: TableSource) -> TableColumns:
    """Return the columns of the stated sheet of an .xlsx workbook, or of its only sheet.

    Formulas have the value that the last program saved. Raises TableFault where openpyxl is not installed, for an
    unknown sheet, and for several sheets without a stated one.
    """
    try:
        from openpyxl import load_workbook
    except ImportError:
        raise missing("openpyxl", "Excel workbooks") from None
    with foreign(source, "an .xlsx workbook"):
        with zipfile.ZipFile(source.path) as parts:
            if (size := sum(part.file_size for part in parts.infolist())) > UNPACKED:
                raise TableFault(f"{size / 1e6:.0f} MB unpacked", f"at most {UNPACKED / 1e6:.0f} MB")
        rows = _rows(load_workbook(source.path, read_only=True, data_only=True), source)
    return columns_of(rows, source.decimal or ".")


def _rows(book: Any, source: TableSource) -> list[tuple[Any, ...]]:
    """The rows of the stated sheet, or of the only one."""
    try:
        names = book.sheetnames
        if not source.sheet and len(names) > 1:
            raise TableFault(f"the sheets {', '.join(names)}", "sheet = the name of one of them", f'"{names[0]}"')
        if source.sheet and source.sheet not in names:
            raise TableFault(f"no sheet {source.sheet!r}", f"one of {', '.join(names)}")
        rows: list[tuple[Any, ...]] = []
        cells = 0
        for row in book[source.sheet or names[0]].iter_rows(values_only=True):
            expect_few(cells := cells + len(row) + 1)
            rows.append(row)
        return rows
    finally:
        book.close()


def read_parquet(source: TableSource) -> TableColumns:
    """Return the number columns of a Parquet file; a column of times in seconds from its first.

    Raises TableFault where pyarrow is not installed or the file is no Parquet file.
    """
    try:
        from pyarrow import parquet
    except ImportError:
        raise missing("pyarrow", "Parquet files") from None
    with foreign(source, "a Parquet file"):
        stated = parquet.read_metadata(source.path)
        expect_few(stated.num_rows * stated.num_columns)
        table = parquet.read_table(source.path)
        return _arrow_columns(table)


def _arrow_columns(table: Any) -> TableColumns:
    """The columns of an Arrow table."""
    import pyarrow

    values, words, notes = {}, {}, []
    for name, column in zip(table.column_names, table.columns, strict=True):
        kind = column.type
        if pyarrow.types.is_timestamp(kind):
            nanoseconds = column.cast(pyarrow.timestamp("ns")).to_numpy()
            values[name] = (nanoseconds - nanoseconds[0]) / np.timedelta64(1, "s")
            notes.append(f"column {name!r}: times, taken as seconds from the first")
        elif pyarrow.types.is_integer(kind) or pyarrow.types.is_floating(kind) or pyarrow.types.is_decimal(kind):
            values[name] = column.cast(pyarrow.float64()).to_numpy().astype(float)
        else:
            words[name] = tuple("" if cell is None else str(cell) for cell in column.to_pylist())
            notes.append(f"column {name!r} holds no numbers ({kind}) and is left out")
    return TableColumns(values, tuple(notes), words=words)


def missing(library: str, what: str) -> TableFault:
    """The fault of a file that only an optional library reads."""
    return TableFault(f"no library {library}, with which {what} are read", "the extra 'recordings'", INSTALL)
