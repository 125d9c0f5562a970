"""Workbook of a run folder: its numbers and its CSV files, a sheet each, for a spreadsheet program."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swashfilm.output.data.files import CSV_DIGITS
from swashfilm.output.headline import named
from swashfilm.output.page import read_summary
from swashfilm.output.tables import read_csv
from system.inputs.shown import shown_in

if TYPE_CHECKING:
    from openpyxl import Workbook
    from openpyxl.cell import WriteOnlyCell

SUMMARY_HEAD = ("number", "value", "unit")
LONGEST_NAME, WIDEST = 31, 60
"""Characters of a sheet's name that programs read, and of a column that is shown whole."""
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_NOT_IN_NAMES = re.compile(r"[\\/*?:\[\]]")
_OMITTED = ("format", "kind", "scale")
Cell = str | float | int


def write_workbook(folder: Path, path: Path) -> None:
    """Write the workbook of a run folder to `path`.

    The first sheet is summary.json in the units that people read, then follows each CSV file. Numbers are numbers, and
    texts are never formulas; the head stays in view.
    """
    from openpyxl import Workbook

    book = Workbook(write_only=True)
    summary = read_summary(folder)
    _write_sheet(book, "summary", [SUMMARY_HEAD, *summary_rows(summary)])
    for table in sorted(folder.rglob("*.csv")):
        name = table.relative_to(folder).with_suffix("").as_posix()
        head, *rows = read_csv(table) or [[]]
        _write_sheet(book, name, [head, *([_value(cell) for cell in row] for row in rows)])
    book.save(path)


def summary_rows(summary: Mapping[str, Any], above: str = "", unit: str = "") -> Iterator[tuple[Cell, ...]]:
    """Yield (number, value, unit) of every number and text of a summary, its tables by their path in words.

    above, unit: words and SI unit of the keys above.
    """
    for key, value in summary.items():
        if key in _OMITTED:
            continue
        own, own_unit = named(str(key))
        words, si = ", ".join(filter(None, (above, own))), own_unit or unit
        if isinstance(value, Mapping):
            yield from summary_rows(value, words, si)
        elif isinstance(value, (bool, str)):
            yield words, str(value), ""
        elif isinstance(value, (int, float)):
            shown = shown_in(si, words)
            yield words, float(f"{shown.of(value):.{CSV_DIGITS}g}"), shown.symbol
        elif isinstance(value, list) and all(isinstance(one, str) for one in value):
            yield from ((words, one, "") for one in value)


def _value(text: str) -> Cell:
    return float(text) if _NUMBER.fullmatch(text) else text


def _write_sheet(book: Workbook, name: str, rows: Sequence[Sequence[Cell]]) -> None:
    from openpyxl.utils import get_column_letter

    sheet = book.create_sheet(_sheet_name(name, book.sheetnames))
    sheet.freeze_panes = "A2"
    for k in range(len(rows[0])):
        longest = max(
            len(f"{row[k]:.8g}" if isinstance(row[k], float) else str(row[k])) for row in rows if len(row) > k
        )
        sheet.column_dimensions[get_column_letter(k + 1)].width = min(longest, WIDEST) + 2
    for number, row in enumerate(rows):
        sheet.append([_cell(sheet, value, head=number == 0) for value in row])


def _cell(sheet: Any, value: Cell, *, head: bool) -> WriteOnlyCell | Cell:
    """Return a cell: a text stays a text, also where it begins like a formula."""
    from openpyxl.cell import WriteOnlyCell
    from openpyxl.cell.cell import ILLEGAL_CHARACTERS_RE
    from openpyxl.styles import Font

    if not isinstance(value, str):
        return value
    cell = WriteOnlyCell(sheet, ILLEGAL_CHARACTERS_RE.sub("", value))
    cell.data_type = "s"
    cell.quotePrefix = value[:1] in ("=", "+", "-", "@")
    if head:
        cell.font = Font(bold=True)
    return cell


def _sheet_name(name: str, taken: Sequence[str]) -> str:
    """Return a valid name of a sheet that differs from those in use, also without regard to case."""
    plain = _NOT_IN_NAMES.sub(" ", name)
    known = {one.lower() for one in taken}
    for number in range(1, len(taken) + 2):
        end = "" if number == 1 else f" {number}"
        found = plain[: LONGEST_NAME - len(end)] + end
        if found.lower() not in known:
            return found
    raise AssertionError("one of more names than sheets is free")
