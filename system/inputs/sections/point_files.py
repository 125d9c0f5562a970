"""Rows of quantities in a CSV file whose head names each column with its unit: `place [mm], taken off [um]`."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from system.inputs.csv_table import Column, head_columns, read_csv_text, row_numbers
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.sections.fields import Points
from system.inputs.units import QuantityError

SHOWN = 10
"""Faults of one file that are reported; the rest are counted."""


@dataclass(frozen=True)
class _Order:
    """Columns of a file in its own order, their places in the layout's order, and the sign of the layout's last."""

    columns: tuple[Column, ...]
    places: tuple[int, ...]
    sign: float


def read_rows(path: Path, layouts: tuple[Points, ...]) -> tuple[tuple[float, ...], ...]:
    """Return the rows of a CSV file in SI, columns in the order of that layout whose heads the file has.

    Any order and any fitting unit; empty lines and those that begin with # do not count. A last column by its
    opposite name changes its sign. Raises QuantityError for a file that cannot be read or has another head,
    InputFaults with every faulty line, each with its number and column.
    """
    text = read_csv_text(path, wanted_file(layouts))
    order = _order(path, text.head, layouts)
    faults: list[Fault] = []
    rows = tuple(_row(f"line {number} of {path.name}", cells, order, faults) for number, cells in text.rows)
    if len(faults) > SHOWN:
        rest = Fault(path.name, f"{len(faults) - SHOWN} more faults", "numbers in every line")
        faults = [*faults[:SHOWN], rest]
    if faults:
        raise InputFaults(str(path), faults)
    return rows


def wanted_file(layouts: tuple[Points, ...]) -> str:
    """Return the content of such a file, in words."""
    heads = " or ".join(f"'{', '.join(_example_heads(layout))}'" for layout in layouts)
    swaps = {f"; '{one.opposite}' in place of '{one.heads[-1]}' is its negative" for one in layouts if one.opposite}
    return f"a CSV file with the head {heads}, in any units that fit{''.join(sorted(swaps))}"


def _example_heads(layout: Points) -> list[str]:
    units = (example.split(" ", 1)[1] for example in layout.example)
    return [f"{head} [{unit}]" for head, unit in zip(layout.heads, units, strict=True)]


def _order(path: Path, head: list[str], layouts: tuple[Points, ...]) -> _Order:
    """The columns that a head names; raises QuantityError where they match no layout."""
    columns = head_columns(head)
    names = [column.name for column in columns]
    for layout in layouts:
        for heads, sign in ((layout.heads, 1.0), ((*layout.heads[:-1], layout.opposite), -1.0)):
            if all(column.unit for column in columns) and sorted(names) == sorted(heads):
                kinds = dict(zip(heads, layout.columns, strict=True))
                typed = tuple(replace(column, kind=kinds[column.name]) for column in columns)
                return _Order(typed, tuple(names.index(name) for name in heads), sign)
    found = f"the head '{', '.join(cell.strip() for cell in head)}' of {path.name}"
    known = sorted({name for layout in layouts for name in (*layout.heads, layout.opposite) if name})
    unknown = [near for name in names if name not in known and (near := nearest_choice(name, known))]
    parted = "cells parted by commas, numbers with a point" if any(";" in cell for cell in head) else ""
    raise QuantityError(found, wanted_file(layouts), f"'{unknown[0]}'" if unknown else parted)


def _row(where: str, cells: list[str], order: _Order, faults: list[Fault]) -> tuple[float, ...]:
    """One line in SI, in the layout's order; its faults are added to the list."""
    numbers = row_numbers(where, cells, order.columns, faults)
    if len(numbers) != len(order.places):
        return ()
    *first, last = (numbers[place] for place in order.places)
    return (*first, last if order.sign > 0.0 else 0.0 - last)
