"""Tables of numbers in CSV files: `opening [mm2], reynolds [1]` names each column and its unit, # is a comment."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from reynolds.numerics.arrays import Array
from reynolds.numerics.files import LARGEST_DATA, read_text
from system.inputs.faults import Fault, InputFaults, nearest_choice, nearest_path
from system.inputs.units import Dimension, QuantityError, parse_quantity

Heads = Mapping[str, Dimension | None]
"""Names of the columns a table must have, and their quantities; None: a bare number, `[1]`."""
SEPARATORS = (";", "\t", ",")
"""Separators of cells; the first one in the head is the file's."""
_COMMA = re.compile(r"[+-]?\d+,\d+([eE][+-]?\d+)?")
_POINT = re.compile(r"[+-]?\d*\.\d+([eE][+-]?\d+)?")
_HEAD = re.compile(r"\s*(.+?)\s*\[(.+)\]\s*")
Line = tuple[int, list[str]]
"""Number of a line in its file, from 1, and its cells."""


@dataclass(frozen=True)
class CsvText:
    """A CSV file as text: cells of its head, the lines below it, and the comments without their sign."""

    head: list[str]
    rows: tuple[Line, ...]
    comments: tuple[str, ...]


@dataclass(frozen=True)
class Column:
    """A column of a CSV file: its name, the unit in its head (None without one), and its quantity."""

    name: str
    unit: str | None
    kind: Dimension | None = None


@dataclass(frozen=True)
class CsvTable:
    """Columns (N,) in SI by name, the line of the file of each row, and the comments without their sign."""

    path: Path
    columns: Mapping[str, Array]
    lines: tuple[int, ...]
    comments: tuple[str, ...]

    def comment(self, key: str) -> str:
        """The rest of the first comment `key: ..`, or empty."""
        return next((line[len(key) + 1 :].strip() for line in self.comments if line.startswith(f"{key}:")), "")


def read_table(path: Path, heads: Heads) -> CsvTable:
    """The table of a CSV file, columns in any order and any fitting unit.

    Raises InputFaults with all its faults: no file, other columns, invalid units and numbers, each with its line.
    """
    try:
        text = read_csv_text(path, _wanted(heads))
    except QuantityError as reason:
        raise InputFaults(str(path), [Fault("file", reason.found, reason.expected, reason.nearest)]) from None
    if not text.rows:
        raise InputFaults(str(path), [Fault("file", "no rows of numbers", _wanted(heads))])
    columns = _columns(path, text.head, heads)
    faults: list[Fault] = []
    rows = [row_numbers(f"line {number}", cells, columns, faults) for number, cells in text.rows]
    if faults:
        raise InputFaults(str(path), faults)
    named = zip((column.name for column in columns), np.array(rows).T, strict=True)
    return CsvTable(path, dict(named), tuple(number for number, _ in text.rows), text.comments)


def read_csv_text(path: Path, wanted: str) -> CsvText:
    """The lines of a CSV file without those that are empty or begin with #.

    Cells are separated by the first of SEPARATORS in the head. Where this is no comma, and no cell has a decimal point,
    cells may have a decimal comma. Raises QuantityError where there is no file, one that cannot be read or one without
    a head; `wanted` describes the expected file.
    """
    lines = [line for line in enumerate(_text(path, wanted).splitlines(), start=1) if line[1].strip(" ;,\t")]
    comments = tuple(line.strip(' \t"#;,') for _, line in lines if _is_comment(line))
    lines = [line for line in lines if not _is_comment(line[1])]
    if not lines:
        raise QuantityError(f"'{path}', which is empty", wanted)
    separator = next((sign for sign in SEPARATORS if sign in lines[0][1]), ",")
    cells = [_cells(path, number, line, separator, wanted) for number, line in lines]
    head, *rows = cells if separator == "," else _with_points(cells)
    return CsvText(head, tuple(zip((number for number, _ in lines[1:]), rows, strict=True)), comments)


def _text(path: Path, wanted: str) -> str:
    """The text of a file; raises QuantityError in plain words."""
    try:
        return read_text(path, LARGEST_DATA)
    except FileNotFoundError:
        raise QuantityError(f"'{path}', which is no file", wanted, nearest_path(path)) from None
    except UnicodeDecodeError:
        raise QuantityError(f"'{path}', which is no text in UTF-8", wanted, "save it as 'CSV UTF-8'") from None
    except OSError as reason:
        raise QuantityError(f"'{path}', which cannot be read: {reason.strerror}", wanted) from None


def _cells(path: Path, number: int, line: str, separator: str, wanted: str) -> list[str]:
    """The cells of a line; raises QuantityError for a line that cannot be split."""
    try:
        return next(csv.reader([line], delimiter=separator))
    except csv.Error as reason:
        raise QuantityError(f"'{path}', line {number}: {reason}", wanted) from None


def _with_points(rows: list[list[str]]) -> list[list[str]]:
    """Rows with decimal points in place of decimal commas; unchanged where a cell has a decimal point."""
    if any(_POINT.fullmatch(cell.strip()) for row in rows for cell in row):
        return rows
    return [[cell.replace(",", ".") if _COMMA.fullmatch(cell.strip()) else cell for cell in row] for row in rows]


def _is_comment(line: str) -> bool:
    return line.lstrip(' \t"').startswith("#")


def head_columns(head: list[str]) -> list[Column]:
    """The columns that a head names: `Place_x [mm]` is `place x` in mm; a cell without a unit keeps its text."""
    matches = [_HEAD.fullmatch(cell) for cell in head]
    return [
        Column(match[1].replace("_", " ").lower(), match[2].strip()) if match else Column(cell.strip(), None)
        for match, cell in zip(matches, head, strict=True)
    ]


def row_numbers(where: str, cells: list[str], columns: Sequence[Column], faults: list[Fault]) -> list[float]:
    """One line in SI; each fault with `where`, the line's name, and its column."""
    if len(cells) != len(columns):
        faults.append(Fault(where, f"{len(cells)} values", f"{len(columns)} values"))
        return []
    found = []
    for cell, column in zip(cells, columns, strict=True):
        try:
            found.append(_number(cell.strip(), column))
        except QuantityError as reason:
            faults.append(Fault(f"{where}, {column.name}", reason.found, reason.expected, reason.nearest))
    return found


def write_table(path: Path, comments: Mapping[str, str], columns: Mapping[str, Array]) -> None:
    """Write columns named by their heads (`opening [mm2]`), in that unit, below comments `# key: text`."""
    lines = [f"# {key}: {' '.join(text.split())}" for key, text in comments.items()]
    lines += [
        ", ".join(columns),
        *(", ".join(f"{value:.6g}" for value in row) for row in zip(*columns.values(), strict=True)),
    ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _wanted(heads: Heads) -> str:
    """The head of such a file, in words."""
    shown = (f"{name} [{kind.example.split(' ', 1)[1] if kind else '1'}]" for name, kind in heads.items())
    return f"a CSV file with the head '{', '.join(shown)}'"


def _columns(path: Path, head: list[str], heads: Heads) -> list[Column]:
    """The columns in the file's order; raises InputFaults for other columns than wanted."""
    columns = [replace(column, name=column.name.replace(" ", "_")) for column in head_columns(head)]
    names = [column.name for column in columns]
    faults = [
        Fault(f"column '{cell.strip()}'", "no unit" if column.name in heads else "unknown column", _wanted(heads),
              f"'{column.name} [..]'" if column.name in heads else nearest_choice(column.name, heads))
        for column, cell in zip(columns, head, strict=True) if column.unit is None or column.name not in heads
    ]  # fmt: skip
    faults += [
        Fault(f"column '{name}'", f"{n} columns of this name" if n else "missing", "one")
        for name in heads
        if (n := names.count(name)) != 1
    ]
    if faults:
        raise InputFaults(str(path), faults)
    return [replace(column, kind=heads[column.name]) for column in columns]


def _number(cell: str, column: Column) -> float:
    """One cell in SI; raises QuantityError."""
    if column.kind is not None:
        try:
            return parse_quantity(f"{cell} {column.unit}", column.kind)
        except QuantityError as reason:
            expected = f"a number; the head says [{column.unit}]"
            raise QuantityError(reason.found, expected, reason.nearest) from None
    if column.unit != "1":
        raise QuantityError(f"the unit [{column.unit}]", "a bare number, [1]")
    try:
        value = float(cell)
    except ValueError:
        raise QuantityError(repr(cell), "a number") from None
    if not np.isfinite(value):
        raise QuantityError(repr(cell), "a finite number")
    return value
