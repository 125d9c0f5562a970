"""A table of numbers: its source, its named columns, its faults."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from reynolds.numerics.arrays import Array
from reynolds.numerics.files import LARGEST_CELLS

_IN_BRACKETS = re.compile(r"[\[(]([^\])]+)[\])]\s*$")
_CONTROL = re.compile(rb"[\x00-\x08\x0b\x0c\x0e-\x1f]")


class TableFault(Exception):
    """A file that cannot be read as a table: found, expected, and the nearest choice."""

    def __init__(self, found: str, expected: str, nearest: str = "") -> None:
        super().__init__(f"found {found}, expected {expected}")
        self.found, self.expected, self.nearest = found, expected, nearest


@dataclass(frozen=True)
class TableSource:
    """Source of a table: its file, and the file's form as a recording states it (empty: to be found).

    sheet: of a workbook; decimal, separator: of text; group: of TDMS; variable: of a MAT file, struct or matrix.
    """

    path: Path
    sheet: str = ""
    decimal: str = ""
    separator: str = ""
    group: str = ""
    variable: str = ""


@dataclass(frozen=True)
class TableColumns:
    """Columns by name, all of one length, nan where a cell holds no number; notes: on the form found, as text.

    units: by name of a column, from the row below the head, a property of the channel, or in brackets in the name;
    words: the cells of columns that hold no number.
    """

    values: Mapping[str, Array]
    notes: tuple[str, ...] = field(default=())
    units: Mapping[str, str] = field(default_factory=dict)
    words: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @property
    def rows(self) -> int:
        """Number of rows."""
        return next((len(column) for column in self.values.values()), 0)


def units_of(names: Iterable[str]) -> dict[str, str]:
    """Units in brackets at the end of column names, by name."""
    return {name: found[1] for name in names if (found := _IN_BRACKETS.search(name))}


@contextmanager
def foreign(source: TableSource, kind: str) -> Iterator[None]:
    """Convert any exception of a format's library on a broken file to a TableFault; kind: the file it should be."""
    try:
        yield
    except TableFault:
        raise
    except (Exception, SystemExit) as reason:  # the libraries have no common class of faults
        words = " ".join(str(reason).split()) or type(reason).__name__
        other = source.path.with_suffix(".csv").name
        near = f"text, to be named {other}" if _is_text(source.path) and other != source.path.name else ""
        raise TableFault(f"'{source.path.name}', unreadable: {words}", kind, near) from reason


def _is_text(path: Path) -> bool:
    """True for a file that begins with text: lines without control characters."""
    try:
        with path.open("rb") as file:
            head = file.read(4096)
    except OSError:
        return False
    return b"\n" in head and not _CONTROL.search(head)


def expect_few(cells: int) -> None:
    """Raise TableFault for more cells than memory should hold."""
    if cells > LARGEST_CELLS:
        raise TableFault(f"{cells:.3g} cells", f"at most {LARGEST_CELLS:.3g} cells in all")
