"""One value of a file: from TOML to the value of a section's field, and back; the expected value, in words."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import is_dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from reynolds.numerics.files import is_file
from system.inputs.faults import nearest_choice, nearest_path, printable
from system.inputs.sections.fields import FieldType, Points, Section, Text, fields_of
from system.inputs.sections.point_files import read_rows, wanted_file
from system.inputs.toml_table import quoted
from system.inputs.units import (
    Dimension,
    QuantityError,
    format_quantity,
    parse_quantity,
    parse_share,
    unit_in,
    unit_scale,
    with_point,
)
from system.inputs.versions import LATER

PURE_UNITS = {"1": 1.0, "%": 0.01}
"""Units of a pure number, with their factors."""
HERE = Path()
"""Folder of the files that a built-in pump's values name: the working directory."""


def read_value(field: FieldType, raw: object, folder: Path = HERE) -> object:
    """Return the value of a table's entry, in SI: a number, a choice, rows of numbers, text, a file's table.

    Rows may come from a CSV file, named like any file by its path from the folder. Raises QuantityError (found,
    expected, nearest) for an entry of another kind, InputFaults for a file that is not of its kind.
    """
    if field.forms and not isinstance(raw, str):
        raise QuantityError(repr(raw), wanted(field))
    if field.dimension is not None:
        return parse_quantity(raw, field.dimension, difference=field.difference, example=field.example)
    if field.unit is not None:
        return _unit(raw, field.unit.dimension)
    if field.layouts:
        return read_rows(folder / raw, field.layouts) if isinstance(raw, str) else listed_rows(raw, field.layouts)
    if field.choices:
        return _choice(raw, field)
    if field.text is not None:
        text = _text(raw, field.text, folder)
        return field.file.read(text) if field.file is not None and isinstance(text, Path) else text
    if isinstance(raw, bool) or not isinstance(raw, (int, float)):
        raise QuantityError(repr(raw), wanted(field), _bare(raw, field) if isinstance(raw, str) else "")
    if not math.isfinite(raw) or (field.whole and raw != int(raw)):
        raise QuantityError(str(raw), wanted(field))
    if field.format is not None and not 1 <= raw <= field.format.number:
        raise QuantityError(str(raw), wanted(field), LATER if raw > field.format.number else "")
    return int(raw) if field.whole else float(raw)


def _bare(text: str, field: FieldType) -> str:
    """Return the bare number that a text probably means, "2.6 %" or one with a comma; else an empty string."""
    try:
        return f"{parse_share(text):g}" if text.endswith("%") and not field.whole else with_point(text)
    except QuantityError:
        return with_point(text)


def written_value(field: FieldType, value: Any) -> str:
    """Return a value as TOML, so that `read_value` gives it back to the last bit."""
    if field.several and isinstance(value, tuple):
        return "[" + ", ".join(written_value(field, one) for one in value) + "]"
    if field.layouts and isinstance(value, tuple):
        columns = _layout(field.layouts, value).columns
        rows = (", ".join(map(_written_quantity, row, columns)) for row in value)
        return "[" + ", ".join(f"[{row}]" for row in rows) + "]"
    if field.tables is not None and isinstance(value, tuple):
        return "[" + ", ".join(map(_written_table, value)) + "]"
    if isinstance(value, Mapping):
        return _inline(written_entries(field, value))
    if type(value) in field.forms or (field.table is not None and is_dataclass(value)):
        return _written_table(value)
    if isinstance(value, Enum):
        return json.dumps(value.value)
    if field.formula is not None:
        return quoted(str(value))
    if field.text is not None:
        shown = value if isinstance(value, tuple) else str(value.path if field.file is not None else value)
        return json.dumps(shown, ensure_ascii=False)
    if field.unit is not None:
        return json.dumps(value)
    if field.dimension is not None and isinstance(value, float):
        if field.difference and field.dimension is Dimension.TEMPERATURE:
            return f'"{value!r} K"'
        return _written_quantity(value, field.dimension)
    return repr(value)


def wanted(field: FieldType) -> str:
    """Return the meaning of a key, in words."""
    if field.several is None:
        return _wanted_one(field)
    if not field.several.count:
        return f"{_wanted_one(field)}, or a list of them"
    meaning = f" ({field.meaning})" if field.meaning else ""
    return f"a list of {field.several.count}{meaning}, each {_wanted_one(field)}"


def _wanted_one(field: FieldType) -> str:
    if field.dimension is not None:
        return f"{field.dimension.noun} with its unit, such as '{field.example}'"
    if field.layouts:
        table = f"; or {_wanted_form(field.from_table.section)}" if field.from_table else ""
        return f"{_wanted_rows(field.layouts)}; or {wanted_file(field.layouts)}{table}"
    if field.formula is not None:
        return _wanted_formula(field.formula.dimension)
    alone = f"one of {names_of(field.choices)}" if field.choices else field.text.value if field.text else ""
    if alone or field.forms:
        return "; or ".join([*([alone] if alone else []), *map(_wanted_form, field.forms)])
    if field.unit is not None:
        return _wanted_unit(field.unit.dimension)
    if field.format is not None:
        return f"format = {field.format.number}, the {field.format.kind} format of this version"
    if inner := field.table or field.tables:
        return f"{'a table' if field.table else 'a list of tables'} with {', '.join(fields_of(inner))}"
    return "a whole number" if field.whole else "a bare number (the value has no unit)"


def broken_limit(field: FieldType, value: object) -> str:
    """Return the limit that a value violates, in words and with its unit; empty within the limits."""
    limits = field.limits
    if isinstance(value, tuple) and field.several is not None:
        return next((words for one in value if (words := broken_limit(field, one))), "")
    if isinstance(value, (tuple, str)):
        return f"at least {limits.fewest} rows, {wanted(field)}" if len(value) < limits.fewest else ""
    if not isinstance(value, (int, float)):
        return ""
    for words, limit, kept in (
        ("more than", limits.above, float.__gt__),
        ("at least", limits.least, float.__ge__),
        ("less than", limits.below, float.__lt__),
        ("at most", limits.most, float.__le__),
    ):
        if limit is not None and not kept(float(value), float(limit)):
            dimension = None if field.difference else field.dimension
            shown = f"{limit:g}" if dimension is None else format_quantity(limit, dimension, digits=4)
            return f"{words} {shown}" + (f": {limits.why}" if limits.why else "")
    return ""


def units_shown(field: FieldType) -> str:
    """Return the example units of a key's columns, such as "mm" or "mm, um"; "-" without one."""
    examples = field.layouts[0].example if field.layouts else (field.example,) if field.dimension else ()
    return ", ".join(map(unit_in, examples)) or "-"


def written_entries(field: FieldType, values: Mapping[str, Any]) -> Iterator[str]:
    """Yield the lines of a table of any names, the field's values by name."""
    of_each = field.named or field
    yield from (f"{_written_key(name)} = {written_value(of_each, one)}" for name, one in values.items())


def _written_table(table: Section) -> str:
    types = fields_of(type(table))
    stated = {key: value for key in types if (value := getattr(table, key)) not in (None, ())}
    return _inline(f"{key} = {written_value(types[key], value)}" for key, value in stated.items())


def _inline(entries: Iterable[str]) -> str:
    return "{ " + ", ".join(entries) + " }"


def _written_key(name: str) -> str:
    return name if _BARE.fullmatch(name) else quoted(name)


_BARE = re.compile(r"[A-Za-z0-9_-]+")


def listed_rows(raw: object, layouts: tuple[Points, ...]) -> tuple[tuple[float, ...], ...]:
    """Return a list of rows in SI, of the layout of the first; a fault names the row, from 1, and its column."""
    if not isinstance(raw, list) or not all(isinstance(row, list) for row in raw):
        raise QuantityError(repr(raw), f"{_wanted_rows(layouts)}; or {wanted_file(layouts)}")
    layout = _layout(layouts, raw)
    return tuple(_row(number, row, layout) for number, row in enumerate(raw, start=1))


def _layout(layouts: tuple[Points, ...], rows: Sequence[Sequence[object]]) -> Points:
    """Return the layout with as many columns as the first row has; otherwise the first one."""
    return next((one for one in layouts if rows and len(one.columns) == len(rows[0])), layouts[0])


def _row(number: int, row: list[object], points: Points) -> tuple[float, ...]:
    if len(row) != len(points.columns):
        raise QuantityError(f"{len(row)} values in row {number}, {row!r}", _wanted_rows((points,)))
    found = []
    for cell, dimension, head, example in zip(row, points.columns, points.heads, points.example, strict=True):
        try:
            found.append(parse_quantity(cell, dimension, example=example))
        except QuantityError as reason:
            where = f"{reason.found} as {head} of row {number}"
            raise QuantityError(where, reason.expected, reason.nearest) from None
    return tuple(found)


def _unit(raw: object, dimension: Dimension | None) -> str:
    """A unit of the dimension; of a pure number "1" or "%"."""
    if dimension is not None and isinstance(raw, str):
        unit_scale(raw, dimension)
    elif dimension is not None or raw not in PURE_UNITS:
        raise QuantityError(repr(raw), _wanted_unit(dimension))
    return str(raw)


def _wanted_unit(dimension: Dimension | None) -> str:
    if dimension is None:
        return " or ".join(map(repr, PURE_UNITS))
    return f"a unit of {dimension.noun}, such as '{unit_in(dimension.example)}'"


def _choice(raw: object, field: FieldType) -> Enum:
    for member in field.choices:
        if member.value == raw:
            return member
    names = [str(member.value) for member in field.choices]
    raise QuantityError(repr(raw), wanted(field), nearest_choice(str(raw), names))


def _text(raw: object, text: Text, folder: Path) -> Path | str | tuple[str, ...]:
    """A path from the folder, made absolute; a name; names."""
    names = raw if text is Text.NAMES else [raw]
    may_be_empty = text is Text.WORDS
    if not (isinstance(names, list) and names and all(isinstance(one, str) and (one or may_be_empty) for one in names)):
        raise QuantityError(repr(raw), text.value)
    if unfit := next((one for one in names if printable(one) != one), None):
        raise QuantityError(repr(unfit), f"{text.value}, without control signs")
    if text is Text.NAMES:
        return tuple(names)
    if text is not Text.FILE:
        return str(raw)
    path = folder / str(raw)
    if not is_file(path):
        raise QuantityError(f"'{path}', which is no file", text.value, nearest_path(path))
    return path.resolve()


def names_of(choices: Iterable[Enum]) -> str:
    """Return the values of choices in one line."""
    return ", ".join(f"'{member.value}'" for member in choices)


def _wanted_form(form: type[Any]) -> str:
    """Return the keys of a form, those first that it must have; a choice with its values."""
    of_key = {
        key: f"{key} = {names_of(own.choices)}" if len(own.choices) == 1 else key
        for key, own in fields_of(form).items()
    }
    return f"a table with {', '.join(of_key.values())}"


def _wanted_formula(dimension: Dimension | None) -> str:
    if dimension is None:
        return "a number, or a formula (text in quotes)"
    return f"{dimension.noun} with its unit, such as '{dimension.example}', or a formula in {dimension.si_unit}"


def _wanted_rows(layouts: tuple[Points, ...]) -> str:
    heads = ", or of ".join(", ".join(points.heads) for points in layouts)
    return f"rows of {heads}, each with its unit, such as [{list(layouts[0].example)}, ...]"


def _written_quantity(value: float, dimension: Dimension) -> str:
    return f'"{format_quantity(value, dimension)}"'
