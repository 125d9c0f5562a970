"""Tables of numbers in CSV files: `opening [mm2], reynolds [1]` names each column and its unit, # is a comment."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.faults import Fault, InputFaults, nearest_choice, nearest_path
from system.inputs.units import Dimension, QuantityError, parse_quantity

Heads = Mapping[str, Dimension | None]
"""Names of the columns a table must have, and what each measures; None: a bare number, `[1]`."""
_HEAD = re.compile(r"\s*(.+?)\s*\[(.+)\]\s*")


@dataclass(frozen=True)
class CsvTable:
    """Columns (N,) in SI by name, the line of the file of each row, and the comments without their sign."""

    path: Path
    columns: Mapping[str, Array]
    lines: tuple[int, ...]
    comments: tuple[str, ...]

    def comment(self, key: str) -> str:
        """The rest of the first comment `key: ..`; empty where there is none."""
        return next((line[len(key) + 1 :].strip() for line in self.comments if line.startswith(f"{key}:")), "")


def read_table(path: Path, heads: Heads) -> CsvTable:
    """The table of a CSV file, columns in any order and any fitting unit.

    Raises InputFaults with everything that is wrong with it: no file, other columns, units and numbers that are
    none, each with its line.
    """
    try:
        text = path.read_text("utf-8-sig")
    except FileNotFoundError:
        fault = Fault("file", "no such file", _wanted(heads), nearest_path(path))
        raise InputFaults(str(path), [fault]) from None
    except (OSError, UnicodeDecodeError) as reason:
        raise InputFaults(str(path), [Fault("file", f"cannot be read: {reason}", _wanted(heads))]) from None
    rows = [(number, cells) for number, cells in enumerate(csv.reader(text.splitlines()), start=1) if any(cells)]
    comments = [",".join(cells).lstrip(" #").strip() for _, cells in rows if cells[0].lstrip().startswith("#")]
    rows = [(number, cells) for number, cells in rows if not cells[0].lstrip().startswith("#")]
    if len(rows) < 2:
        raise InputFaults(str(path), [Fault("file", "no rows of numbers", _wanted(heads))])
    units = _units(path, rows[0][1], heads)
    faults: list[Fault] = []
    numbers = [_numbers(number, cells, units, heads, faults) for number, cells in rows[1:]]
    if faults:
        raise InputFaults(str(path), faults)
    columns = dict(zip(units, np.array(numbers).T, strict=True))
    return CsvTable(path, columns, tuple(number for number, _ in rows[1:]), tuple(comments))


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


def _units(path: Path, head: list[str], heads: Heads) -> dict[str, str]:
    """The unit of each column by name, in the file's order; raises InputFaults for other columns than wanted."""
    matches = [_HEAD.fullmatch(cell) for cell in head]
    names = [
        match[1].replace(" ", "_").lower() if match else cell.strip() for match, cell in zip(matches, head, strict=True)
    ]
    faults = [
        Fault(f"column '{cell.strip()}'", "no unit" if name in heads else "unknown column", _wanted(heads),
              f"'{name} [..]'" if name in heads else nearest_choice(name, heads))
        for name, match, cell in zip(names, matches, head, strict=True) if not match or name not in heads
    ]  # fmt: skip
    faults += [
        Fault(f"column '{name}'", f"{n} columns of this name" if n else "missing", "one")
        for name in heads
        if (n := names.count(name)) != 1
    ]
    if faults:
        raise InputFaults(str(path), faults)
    return {name: match[2].strip() for name, match in zip(names, matches, strict=True) if match}


def _numbers(number: int, cells: list[str], units: Mapping[str, str], heads: Heads, faults: list[Fault]) -> list[float]:
    """One line in SI; what is wrong with it goes to the faults."""
    if len(cells) != len(units):
        faults.append(Fault(f"line {number}", f"{len(cells)} values", f"{len(units)} values"))
        return []
    found = []
    for cell, (name, unit) in zip(cells, units.items(), strict=True):
        try:
            found.append(_number(cell.strip(), unit, heads[name]))
        except QuantityError as reason:
            faults.append(Fault(f"line {number}, {name}", reason.found, reason.expected, reason.nearest))
    return found


def _number(cell: str, unit: str, kind: Dimension | None) -> float:
    """One cell in SI; raises QuantityError."""
    if kind is not None:
        return parse_quantity(f"{cell} {unit}", kind)
    if unit != "1":
        raise QuantityError(f"the unit [{unit}]", "a bare number, [1]")
    try:
        value = float(cell)
    except ValueError:
        raise QuantityError(repr(cell), "a number") from None
    if not np.isfinite(value):
        raise QuantityError(repr(cell), "a finite number")
    return value
