"""One value of a pump file: from TOML to what the description holds, and back; what it should be, in words."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from enum import Enum
from pathlib import Path
from typing import Any

from pydantic.fields import FieldInfo

from system.inputs.faults import nearest_choice, nearest_path
from system.inputs.fields import (
    Points,
    Section,
    Text,
    choice_of,
    dimension_of,
    layouts_of,
    tables_of,
    text_of,
    whole,
)
from system.inputs.point_files import read_rows, wanted_file
from system.inputs.units import Dimension, QuantityError, format_quantity, parse_quantity, with_point

HERE = Path()
"""Where files are looked for that a built-in pump's own values name: the working directory."""
_BOUNDS = {"gt": "more than", "ge": "at least", "lt": "less than", "le": "at most"}


def read_value(info: FieldInfo, raw: object, folder: Path = HERE) -> object:
    """Return what an entry of a table means, in SI: a number, a choice, rows of numbers, a path or names.

    Rows may stand in a CSV file, named like any file by its path from the folder. Raises QuantityError (found,
    expected, nearest) for what the field does not hold.
    """
    dimension, layouts, choice = dimension_of(info), layouts_of(info), choice_of(info)
    if dimension is not None:
        return parse_quantity(raw, dimension)
    if layouts:
        return read_rows(folder / raw, layouts) if isinstance(raw, str) else listed_rows(raw, layouts)
    if choice is not None:
        return _choice(raw, choice)
    if (text := text_of(info)) is not None:
        return _text(raw, text, folder)
    if isinstance(raw, bool) or not isinstance(raw, (int, float)):
        raise QuantityError(repr(raw), wanted(info), with_point(raw) if isinstance(raw, str) else "")
    return raw


def written_value(info: FieldInfo, value: object) -> str:
    """Return a value as TOML, so that `read_value` gives it back to the last bit."""
    dimension, layouts = dimension_of(info), layouts_of(info)
    if layouts and isinstance(value, tuple):
        columns = _layout(layouts, value).columns
        rows = (", ".join(map(_written_quantity, row, columns)) for row in value)
        return "[" + ", ".join(f"[{row}]" for row in rows) + "]"
    if tables_of(info) is not None and isinstance(value, tuple):
        return "[" + ", ".join(map(_written_table, value)) + "]"
    if isinstance(value, Enum):
        return json.dumps(value.value)
    if text_of(info) is not None:
        return json.dumps(value if isinstance(value, tuple) else str(value), ensure_ascii=False)
    if dimension is not None and isinstance(value, float):
        return _written_quantity(value, dimension)
    return repr(value)


def wanted(info: FieldInfo) -> str:
    """Return what a key holds, in words."""
    dimension, layouts, choice = dimension_of(info), layouts_of(info), choice_of(info)
    if dimension is not None:
        return f"{dimension.noun} with its unit, such as '{dimension.example}'"
    if layouts:
        return f"{_wanted_rows(layouts)}; or {wanted_file(layouts)}"
    if choice is not None:
        return f"one of {_names(choice)}"
    if (text := text_of(info)) is not None:
        return text.value
    return "a whole number" if whole(info) else "a bare number (the value has no unit)"


def bound(info: FieldInfo, limits: Mapping[str, Any]) -> str:
    """Return the bound that a value broke, in words and with its unit; what is wanted where it broke none."""
    dimension = dimension_of(info)
    for short, words in _BOUNDS.items():
        if short in limits:
            limit = float(limits[short])
            shown = f"{limit:g}" if dimension is None else format_quantity(limit, dimension, digits=4)
            return f"{words} {shown}"
    if "min_length" in limits:
        return f"at least {limits['min_length']} rows, {wanted(info)}"
    return wanted(info)


def units_shown(info: FieldInfo) -> str:
    """Return the example units of a key's columns, such as "mm" or "mm, um"; "-" for what has none."""
    layouts, dimension = layouts_of(info), dimension_of(info)
    examples = layouts[0].example if layouts else (dimension.example,) if dimension else ()
    return ", ".join(example.split(" ", 1)[1] for example in examples) or "-"


def _written_table(table: Section) -> str:
    stated = {key: value for key, value in dict(table).items() if value is not None}
    fields = type(table).model_fields
    return "{ " + ", ".join(f"{key} = {written_value(fields[key], value)}" for key, value in stated.items()) + " }"


def listed_rows(raw: object, layouts: tuple[Points, ...]) -> tuple[tuple[float, ...], ...]:
    """Return a list of rows in SI, of the layout of the first; a fault names the row, from 1, and its column."""
    if not isinstance(raw, list) or not all(isinstance(row, list) for row in raw):
        raise QuantityError(repr(raw), f"{_wanted_rows(layouts)}; or {wanted_file(layouts)}")
    layout = _layout(layouts, raw)
    return tuple(_row(number, row, layout) for number, row in enumerate(raw, start=1))


def _layout(layouts: tuple[Points, ...], rows: Sequence[Sequence[object]]) -> Points:
    """Return the layout with as many columns as the first row has; the first one where none has."""
    return next((one for one in layouts if rows and len(one.columns) == len(rows[0])), layouts[0])


def _row(number: int, row: list[object], points: Points) -> tuple[float, ...]:
    if len(row) != len(points.columns):
        raise QuantityError(f"{len(row)} values in row {number}, {row!r}", _wanted_rows((points,)))
    found = []
    for cell, dimension, head in zip(row, points.columns, points.heads, strict=True):
        try:
            found.append(parse_quantity(cell, dimension))
        except QuantityError as reason:
            where = f"{reason.found} as {head} of row {number}"
            raise QuantityError(where, reason.expected, reason.nearest) from None
    return tuple(found)


def _choice(raw: object, choices: type[Enum]) -> Enum:
    for member in choices:
        if member.value == raw:
            return member
    names = [str(member.value) for member in choices]
    raise QuantityError(repr(raw), f"one of {_names(choices)}", nearest_choice(str(raw), names))


def _text(raw: object, text: Text, folder: Path) -> Path | str | tuple[str, ...]:
    """A path from the folder, made absolute; a name; names."""
    names = raw if text is Text.NAMES else [raw]
    if not (isinstance(names, list) and names and all(isinstance(name, str) and name for name in names)):
        raise QuantityError(repr(raw), text.value)
    if text is Text.NAMES:
        return tuple(names)
    if text is Text.NAME:
        return str(raw)
    path = (folder / str(raw)).resolve()
    if not path.is_file():
        raise QuantityError(f"'{path}', which is no file", text.value, nearest_path(path))
    return path


def _names(choices: type[Enum]) -> str:
    return ", ".join(f"'{member.value}'" for member in choices)


def _wanted_rows(layouts: tuple[Points, ...]) -> str:
    heads = ", or of ".join(", ".join(points.heads) for points in layouts)
    return f"rows of {heads}, each with its unit, such as [{list(layouts[0].example)}, ...]"


def _written_quantity(value: float, dimension: Dimension) -> str:
    return f'"{format_quantity(value, dimension)}"'
