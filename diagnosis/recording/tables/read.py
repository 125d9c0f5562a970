"""Table files as named columns: the reader of each file format."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from diagnosis.recording.tables.loggers import read_mdf, read_tdms
from diagnosis.recording.tables.matlab import read_matlab
from diagnosis.recording.tables.table import TableColumns, TableFault, TableSource, units_of
from diagnosis.recording.tables.text import read_text
from diagnosis.recording.tables.workbooks import read_parquet, read_workbook
from reynolds.numerics.files import UnfitFile, expect_regular
from system.inputs.faults import nearest_path

_READERS: Mapping[str, Callable[[TableSource], TableColumns]] = {
    **dict.fromkeys((".csv", ".txt", ".tsv", ".dat"), read_text),
    ".xlsx": read_workbook,
    ".parquet": read_parquet,
    ".mat": read_matlab,
    ".tdms": read_tdms,
    **dict.fromkeys((".mf4", ".mdf"), read_mdf),
}
"""Readers by file ending."""
ENDINGS = tuple(_READERS)


def read_columns(source: TableSource) -> TableColumns:
    """Return the columns of a table, numbers as in the file.

    Read by ending: .csv .txt .tsv .dat as text, .xlsx, .parquet, .mat, .tdms, .mf4 and .mdf. Raises TableFault
    for a file that is absent, of another kind, damaged, without rows, or whose library is not installed.
    """
    path = source.path
    try:
        expect_regular(path)
    except UnfitFile as reason:
        raise TableFault(f"'{path}', {reason}", "a file with a table") from None
    except (OSError, ValueError):
        raise TableFault(f"'{path}', which is no file", "the path of a table", nearest_path(path)) from None
    reader = _READERS.get(path.suffix.lower())
    if reader is None:
        raise TableFault(f"'{path.name}'", f"a file that ends in one of {', '.join(_READERS)}")
    columns = reader(source)
    if columns.rows == 0:
        raise TableFault(f"no row of numbers in '{path.name}'", "a head with column names and rows of numbers")
    return replace(columns, units={**units_of(columns.values), **columns.units})
