"""Rows of quantities in a CSV file whose head names each column with its unit: `place [mm], taken off [um]`."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

from system.inputs.faults import Fault, InputFaults, nearest_choice, nearest_path
from system.inputs.sections.fields import Points
from system.inputs.units import QuantityError, parse_quantity

_HEAD = re.compile(r"\s*(.+?)\s*\[(.+)\]\s*")
SHOWN = 10
"""Faults of one file that are told; the rest are counted."""


@dataclass(frozen=True)
class _Columns:
    """Layout of a file: heads as written there, units and indices in the file, and the sign of the last column."""

    layout: Points
    heads: tuple[str, ...]
    units: tuple[str, ...]
    places: tuple[int, ...]
    sign: float


def read_rows(path: Path, layouts: tuple[Points, ...]) -> tuple[tuple[float, ...], ...]:
    """Return the rows of a CSV file in SI, columns in the order of that layout whose heads the file has.

    Any order and any fitting unit; empty lines and those that begin with # do not count. A last column by its
    opposite name changes its sign. Raises QuantityError for what is no such file, InputFaults with every line that is
    none, each with its number and column.
    """
    try:
        text = path.read_text("utf-8-sig")
    except FileNotFoundError:
        raise QuantityError(f"'{path}', which is no file", wanted_file(layouts), nearest_path(path)) from None
    except (OSError, UnicodeDecodeError) as reason:
        raise QuantityError(f"'{path}', which cannot be read: {reason}", wanted_file(layouts)) from None
    lines = [
        (number, cells)
        for number, cells in enumerate(csv.reader(text.splitlines()), start=1)
        if "".join(cells).strip() and not cells[0].lstrip().startswith("#")
    ]
    if not lines:
        raise QuantityError(f"'{path}', which is empty", wanted_file(layouts))
    columns = _columns(path, lines[0][1], layouts)
    faults: list[Fault] = []
    rows = tuple(_row(f"line {number} of {path.name}", cells, columns, faults) for number, cells in lines[1:])
    if len(faults) > SHOWN:
        rest = Fault(path.name, f"{len(faults) - SHOWN} more faults", "numbers in every line")
        faults = [*faults[:SHOWN], rest]
    if faults:
        raise InputFaults(str(path), faults)
    return rows


def wanted_file(layouts: tuple[Points, ...]) -> str:
    """Return what such a file holds, in words."""
    heads = " or ".join(f"'{', '.join(_example_heads(layout))}'" for layout in layouts)
    swaps = {f"; '{one.opposite}' in place of '{one.heads[-1]}' is its negative" for one in layouts if one.opposite}
    return f"a CSV file with the head {heads}, in any units that fit{''.join(sorted(swaps))}"


def _example_heads(layout: Points) -> list[str]:
    units = (example.split(" ", 1)[1] for example in layout.example)
    return [f"{head} [{unit}]" for head, unit in zip(layout.heads, units, strict=True)]


def _columns(path: Path, head: list[str], layouts: tuple[Points, ...]) -> _Columns:
    """The columns that a head names; raises QuantityError where they are none of the layouts'."""
    matches = [_HEAD.fullmatch(cell) for cell in head]
    names = [
        match[1].replace("_", " ").lower() if match else cell.strip() for match, cell in zip(matches, head, strict=True)
    ]
    for layout in layouts:
        for heads, sign in ((layout.heads, 1.0), ((*layout.heads[:-1], layout.opposite), -1.0)):
            if all(matches) and sorted(names) == sorted(heads):
                places = tuple(names.index(name) for name in heads)
                units = tuple(match[2] for match in (matches[place] for place in places) if match)
                return _Columns(layout, heads, units, places, sign)
    found = f"the head '{', '.join(cell.strip() for cell in head)}' of {path.name}"
    known = sorted({name for layout in layouts for name in (*layout.heads, layout.opposite) if name})
    unknown = [near for name in names if name not in known and (near := nearest_choice(name, known))]
    parted = "cells parted by commas, numbers with a point" if any(";" in cell for cell in head) else ""
    raise QuantityError(found, wanted_file(layouts), f"'{unknown[0]}'" if unknown else parted)


def _row(where: str, cells: list[str], columns: _Columns, faults: list[Fault]) -> tuple[float, ...]:
    """One line in SI, in the layout's order; what is wrong with it goes to the faults."""
    if len(cells) != len(columns.places):
        faults.append(Fault(where, f"{len(cells)} values", f"{len(columns.places)} values"))
        return ()
    found = []
    for head, dimension, unit, place in zip(
        columns.heads, columns.layout.columns, columns.units, columns.places, strict=True
    ):
        try:
            found.append(parse_quantity(f"{cells[place].strip()} {unit}", dimension))
        except QuantityError as reason:
            expected = f"a number; the head says [{unit}]"
            faults.append(Fault(f"{where}, {head}", reason.found, expected, reason.nearest))
            return ()
    return (*found[:-1], found[-1] if columns.sign > 0.0 else 0.0 - found[-1])
