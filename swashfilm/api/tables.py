"""A case of Python values as a case of a file: numbers in SI get their unit, paths of files their folder."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import cache
from itertools import zip_longest
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from swashfilm.case.gap.instant import InstantSection
from swashfilm.case.gap.position import Load, Position
from swashfilm.case.schema import SECTIONS
from swashfilm.case.tables.boundary import BoundaryTables
from swashfilm.case.tables.film import FilmSection
from swashfilm.runs.reference.case import ReferenceFile
from swashfilm.runs.transient.case import TransientSection
from swashfilm.runs.variation.optimise.case import OptimiseSection
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, InputFaults
from system.inputs.sections.fields import FieldType, Text, field_type, fields_of
from system.inputs.sections.reader import ABSOLUTE, is_number, under
from system.inputs.sections.values import wanted
from system.inputs.toml_table import parse_toml, quoted
from system.inputs.units import Dimension
from system.pump_file.file import builtin_pumps

VARIED = ("study", "table")
"""Tables of dotted keys of the case."""
BESIDE = ("pump", "film.pump", "transient.pump", "optimise.pump", "optimise.table")
"""Keys with a name, or the path of a file beside the case."""
BY_REYNOLDS = "an array or a function goes to reynolds.film, at the points of a film_space: space.sample(function)"


@dataclass
class _Filing:
    """State of a case: folder of its relative paths, its faults, and its completed paths by the stated ones."""

    folder: Path
    faults: list[Fault] = field(default_factory=list)
    completed: dict[str, str] = field(default_factory=dict)


def tables_of_file(tables: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Return tables as those of a case file: quantities as text, paths completed with a folder.

    A number is in the SI unit of its key. Raises InputFaults for values that a file does not hold.
    """
    filing = _Filing(folder)
    found = _filed_table("", tables, filing)
    if filing.faults:
        raise InputFaults("case", filing.faults)
    return found


def settings_of_file(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return values of dotted keys of a case or a pump file as those of a file; raise InputFaults as `tables_of_file`.

    Paths of files are as stated.
    """
    filing = _Filing(Path())
    found = {}
    for key, value in values.items():
        own = _field_at(key) or _field_below(field_type(PumpDescription), key)
        found[key] = value if isinstance(value, (str, Path)) else _filed(key, own, value, filing)
    if filing.faults:
        raise InputFaults("values", filing.faults)
    return found


def text_of_file(text: str, folder: Path) -> str:
    """Return the text of a case with its relative paths completed with a folder; any other text as it is."""
    filing = _Filing(folder)
    try:
        _filed_table("", parse_toml(text), filing)
    except ValueError:
        return text  # the reader of the file tells
    for stated, whole in filing.completed.items():
        for written in (quoted(stated), f"'{stated}'"):
            text = text.replace(written, quoted(whole))
    return text


@cache
def _top() -> Mapping[str, FieldType]:
    """Return the fields of a case's keys and tables."""
    of_pump = fields_of(PumpDescription)
    models = {"transient": TransientSection, "optimise": OptimiseSection, **SECTIONS}
    return {
        **fields_of(InstantSection),
        "film": field_type(FilmSection | InstantSection),
        "boundary": BoundaryTables,
        "position": field_type(Position),
        "load": field_type(Load),
        "pump": field_type(PumpDescription),
        "operating": of_pump["operating"],
        "reference": fields_of(ReferenceFile)["reference"],
        **{name: field_type(model) for name, model in models.items()},
    }


def _field_at(key: str) -> FieldType | None:
    """Return the field of a dotted key, such as `film.velocity[0]`."""
    head, _, rest = key.partition("[")[0].partition(".")
    return _field_below(_top().get(head), rest) if rest else _top().get(head)


def _field_below(own: FieldType | None, key: str) -> FieldType | None:
    for name in key.split("."):
        own = _inner(own, name)
    return own


def _inner(own: FieldType | None, key: str) -> FieldType | None:
    """Return the field of a key in a table; of the ends of a range that of the varied key."""
    if own is None or is_number(key):
        return own
    if own.named is not None:
        return own.named
    sections = [*own.forms, own.table, own.tables, own.from_table.section if own.from_table else None]
    found = (fields_of(one).get(key.removesuffix(ABSOLUTE)) for one in sections if one is not None)
    return next((one for one in found if one is not None), own if key in ("from", "to") else None)


def _filed_table(path: str, table: Mapping[str, Any], filing: _Filing, own: FieldType | None = None) -> dict[str, Any]:
    found = {}
    for key, value in table.items():
        where = under(path, str(key))
        if not isinstance(key, str):
            filing.faults.append(Fault(where, f"the key {key!r}", "keys that are text"))
            continue
        of_key = _field_at(key) if path in VARIED else _inner(own, key) if path else _top().get(key)
        found[key] = _filed(where, of_key, value, filing)
    return found


def _filed(path: str, own: FieldType | None, value: Any, filing: _Filing) -> Any:
    """Return a value as a file has it; a value that no file has is listed as a fault."""
    match value:
        case Mapping():
            return _filed_table(path, value, filing, own)
        case Enum():
            return value.value
        case bool() | np.bool_():
            return bool(value)
        case str() | Path():
            return _completed(path, own, str(value), filing)
        case int() | float() | np.integer() | np.floating():
            return _with_unit(value.item() if isinstance(value, np.generic) else value, own)
        case list() | tuple():
            return _listed(path, own, value, filing)
        case np.ndarray() if value.ndim and (path.startswith(VARIED) or (own and (own.several or own.layouts))):
            return _listed(path, own, value.tolist(), filing)
        case _:
            return _unfit(path, own, value, filing)


def _listed(path: str, own: FieldType | None, values: Sequence[Any], filing: _Filing) -> list[Any]:
    """Return a list; each row of a list of rows has the columns of its key."""
    if own is not None and (columns := _columns(own)) and all(isinstance(row, (list, tuple)) for row in values):
        fields = [field_type(Annotated[float, one]) for one in columns]
        return [
            [_filed(f"{path}[{n}]", one, cell, filing) for cell, one in zip_longest(row, fields[: len(row)])]
            for n, row in enumerate(values)
        ]
    return [_filed(f"{path}[{n}]", own, one, filing) for n, one in enumerate(values)]


def _columns(own: FieldType) -> Sequence[Dimension]:
    """Return the dimensions of the columns of a key with rows; of a chamber pressure angle and pressure."""
    if own.layouts:
        return own.layouts[0].columns
    return (Dimension.ANGLE, Dimension.PRESSURE) if own.several and own.dimension is Dimension.PRESSURE else ()


def _with_unit(number: float, own: FieldType | None) -> float | str:
    """Return a number with the SI unit of its key; as it is where the key has none."""
    if own is None:
        return number
    of_formula = own.formula.dimension if own.formula else None
    dimension = own.dimension or of_formula or (own.layouts[0].columns[-1] if own.layouts else None)
    return number if dimension is None else f"{number!r} {dimension.si_unit}"


def _completed(path: str, own: FieldType | None, text: str, filing: _Filing) -> str:
    """Return a text of a case, the path of a file with the folder of the case."""
    beside = path in BESIDE and text not in builtin_pumps()
    of_file = own is not None and (own.file is not None or own.text is Text.FILE)
    chosen = own is not None and text in [one.value for one in own.choices]
    if not text or chosen or not (beside or of_file or text.lower().endswith(".csv")):
        return text
    filing.completed[text] = str((filing.folder / text).absolute())
    return filing.completed[text]


def _unfit(path: str, own: FieldType | None, value: Any, filing: _Filing) -> None:
    """List the fault of a value that no file holds."""
    found = f"a value of type {type(value).__name__}"
    if isinstance(value, np.ndarray):
        found = f"an array of shape {value.shape}"
    elif value is None:
        found = "None"
    elif callable(value):
        found = f"a function, {getattr(value, '__name__', type(value).__name__)}"
    expected = wanted(own) if own else "text, a number, true or false, a list or a table"
    of_field = own is not None and own.formula is not None and value is not None
    remedy = BY_REYNOLDS if of_field else "a key without a value is left out" if value is None else ""
    filing.faults.append(Fault(path, found, expected, remedy))
