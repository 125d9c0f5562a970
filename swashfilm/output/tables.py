"""Tables of text, on a terminal and in CSV files."""

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path

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
    """Return name and unit of a head `name [unit]`; the unit is empty where there is none."""
    name, _, unit = title.partition(" [")
    return name, unit.removesuffix("]")


def write_csv(path: Path, head: Iterable[str], rows: Iterable[Iterable[object]]) -> None:
    """Write a head and rows of cells as CSV."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(head)
        table.writerows(rows)


def read_csv(path: Path) -> list[list[str]]:
    """Return the rows of a CSV, the head first."""
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.reader(file))
