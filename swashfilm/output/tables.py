"""Tables of text, on a terminal and in CSV files."""

import csv
import io
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from reynolds.numerics.files import LARGEST_DATA, read_text
from system.inputs.faults import Fault, InputFaults

_FORMULA = re.compile(r"[=+\-@\t\r]")
_NUMBER = re.compile(r"[+-] ?(\d|\.\d)[^|!()=@]*|[+-]+|[+-](inf|nan)")
"""A number, with its unit or error, and a mere sign."""
Table = tuple[str, Sequence[Sequence[str]]]
"""Title and rows of cells."""


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Return rows of text as lines of aligned columns, two blanks before and between."""
    columns = max((len(row) for row in rows), default=0)
    widths = [max(len(row[k]) for row in rows if len(row) > k) for k in range(columns)]
    return [
        "  " + "  ".join(f"{cell:<{width}}" for cell, width in zip(row, widths, strict=False)).rstrip() for row in rows
    ]


def parted(title: str) -> tuple[str, str]:
    """Return name and unit of a head `name [unit]`; the unit is empty if absent."""
    name, _, unit = title.partition(" [")
    return name, unit.removesuffix("]")


def write_csv(path: Path, head: Iterable[str], rows: Iterable[Iterable[object]]) -> None:
    """Write a head and rows of cells as CSV; no text in it is a formula to a spreadsheet program."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(map(harmless, head))
        table.writerows(map(harmless, row) for row in rows)


def harmless(cell: object) -> object:
    """Return a cell; a text that a spreadsheet program would run as a formula gets a leading apostrophe."""
    return f"'{cell}" if isinstance(cell, str) and _FORMULA.match(cell) and not _NUMBER.fullmatch(cell) else cell


def read_csv(path: Path) -> list[list[str]]:
    """Return the rows of a CSV by `write_csv`, the head first; raise InputFaults for a file of another form."""
    try:
        return list(csv.reader(io.StringIO(read_text(path, LARGEST_DATA))))
    except (OSError, ValueError, csv.Error) as reason:
        raise InputFaults(str(path), [Fault("file", f"cannot be read: {reason}", "a table of a run")]) from None
