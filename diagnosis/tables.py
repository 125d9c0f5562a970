"""A file of numbers as named columns, whatever program wrote it: what a table is, and which reader takes it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from reynolds.numerics.arrays import Array
from system.faults import nearest_path


class TableFault(Exception):
    """A file that cannot be read as a table: what was found, what was expected, what to do."""

    def __init__(self, found: str, expected: str, nearest: str = "") -> None:
        super().__init__(f"found {found}, expected {expected}")
        self.found, self.expected, self.nearest = found, expected, nearest


@dataclass(frozen=True)
class TableSource:
    """Where a table stands: its file, and what a recording states of the file's form (empty: to be found).

    sheet: of a workbook; decimal, separator: of text; group: of TDMS; variable: of a MAT file, struct or matrix.
    """

    path: Path
    sheet: str = ""
    decimal: str = ""
    separator: str = ""
    group: str = ""
    variable: str = ""


@dataclass(frozen=True)
class Columns:
    """Columns by name, all of one length, nan where a cell holds no number; `told`: what was found, in words.

    units: by name of a column what stands in the row below the head, or in brackets in the head.
    """

    values: Mapping[str, Array]
    told: tuple[str, ...] = field(default=())
    units: Mapping[str, str] = field(default_factory=dict)

    @property
    def rows(self) -> int:
        """Number of rows."""
        return next((len(column) for column in self.values.values()), 0)


def read_columns(source: TableSource) -> Columns:
    """Return the columns of a table, numbers as they stand in the file.

    Read by ending: .csv .txt .tsv .dat as text, .xlsx, .parquet, .mat, .tdms, .mf4 and .mdf. Raises TableFault
    for a file that is absent, of another kind, damaged, without rows, or whose library is not installed.
    """
    path = source.path
    if not path.is_file():
        raise TableFault(f"'{path}', which is no file", "the path of a table", nearest_path(path))
    reader = _readers().get(path.suffix.lower())
    if reader is None:
        raise TableFault(f"'{path.name}'", f"a file that ends in one of {', '.join(_readers())}")
    columns = reader(source)
    if columns.rows == 0:
        raise TableFault(f"no row of numbers in '{path.name}'", "a head with column names and rows of numbers")
    return columns


def _readers() -> Mapping[str, Callable[[TableSource], Columns]]:
    """Readers by ending; imported here, since they import what a table is from this file."""
    from diagnosis.book_tables import read_parquet, read_workbook
    from diagnosis.logger_tables import read_mdf, read_tdms
    from diagnosis.matlab_tables import read_matlab
    from diagnosis.text_tables import read_text

    return {
        **dict.fromkeys((".csv", ".txt", ".tsv", ".dat"), read_text),
        ".xlsx": read_workbook,
        ".parquet": read_parquet,
        ".mat": read_matlab,
        ".tdms": read_tdms,
        **dict.fromkeys((".mf4", ".mdf"), read_mdf),
    }
