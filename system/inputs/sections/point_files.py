"""Rows of quantities in a CSV file whose head names each column with its unit: `place [mm], taken off [um]`."""

from __future__ import annotations

import csv
import re
from pathlib import Path

from system.inputs.faults import nearest_choice, nearest_path
from system.inputs.sections.fields import Points
from system.inputs.units import QuantityError, parse_quantity

_HEAD = re.compile(r"\s*(.+?)\s*\[(.+)\]\s*")


def read_rows(path: Path, layouts: tuple[Points, ...]) -> tuple[tuple[float, ...], ...]:
    """Return the rows of a CSV file in SI, columns in the order of that layout whose heads the file has.

    Any order and any fitting unit; empty lines and those that begin with # do not count. Raises QuantityError for
    what is no such file, naming line and column.
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
    layout, units, places = _columns(path, lines[0][1], layouts)
    return tuple(_row(path, number, cells, layout, units, places) for number, cells in lines[1:])


def wanted_file(layouts: tuple[Points, ...]) -> str:
    """Return what such a file holds, in words."""
    heads = " or ".join(f"'{', '.join(_example_heads(layout))}'" for layout in layouts)
    return f"a CSV file with the head {heads}, in any units that fit"


def _example_heads(layout: Points) -> list[str]:
    units = (example.split(" ", 1)[1] for example in layout.example)
    return [f"{head} [{unit}]" for head, unit in zip(layout.heads, units, strict=True)]


def _columns(path: Path, head: list[str], layouts: tuple[Points, ...]) -> tuple[Points, list[str], list[int]]:
    """The layout of a head, and the unit and the index in the file of each of its columns."""
    matches = [_HEAD.fullmatch(cell) for cell in head]
    names = [
        match[1].replace("_", " ").lower() if match else cell.strip() for match, cell in zip(matches, head, strict=True)
    ]
    for layout in layouts:
        if all(matches) and sorted(names) == sorted(layout.heads):
            places = [names.index(name) for name in layout.heads]
            return layout, [match[2] for match in (matches[place] for place in places) if match], places
    found = f"the head '{', '.join(cell.strip() for cell in head)}' of {path.name}"
    known = sorted({name for layout in layouts for name in layout.heads})
    unknown = [near for name in names if name not in known and (near := nearest_choice(name, known))]
    parted = "cells parted by commas, numbers with a point" if any(";" in cell for cell in head) else ""
    raise QuantityError(found, wanted_file(layouts), f"'{unknown[0]}'" if unknown else parted)


def _row(
    path: Path, number: int, cells: list[str], layout: Points, units: list[str], places: list[int]
) -> tuple[float, ...]:
    """One line in SI, in the layout's order."""
    if len(cells) != len(places):
        raise QuantityError(f"{len(cells)} values in line {number} of {path.name}", f"{len(places)} values")
    found = []
    for head, dimension, unit, place in zip(layout.heads, layout.columns, units, places, strict=True):
        try:
            found.append(parse_quantity(f"{cells[place].strip()} {unit}", dimension))
        except QuantityError as reason:
            where = f"{reason.found} as {head} in line {number} of {path.name}"
            raise QuantityError(where, f"a number; the head says [{unit}]", reason.nearest) from None
    return tuple(found)
