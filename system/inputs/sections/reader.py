"""Sections from tables of TOML: a frozen dataclass in SI, and every fault of the file at once."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from reynolds.errors import InputError
from system.inputs.faults import Fault, InputFaults, UnknownKey, nearest_choice, stated
from system.inputs.sections.fields import AnySection, FieldType, FormulaOf, FromTable, fields_of
from system.inputs.sections.values import HERE, broken_limit, names_of, read_value, wanted
from system.inputs.toml_table import Table
from system.inputs.units import QuantityError, to_gauge, without_absolute

ABSOLUTE = "_abs"  # a pressure key that ends so is absolute


@dataclass
class Reading:
    """State of a file that is read: its faults, the paths with a fault, and the paths whose values are good.

    `folder`: base of the paths of files in it. `special`: keys by path that are read otherwise, as (raw value, table,
    reading) -> SI values by key. `numbered`: paths of tables that hold single parts too. `formula` returns the content
    of a formula; it raises QuantityError.
    """

    folder: Path = HERE
    special: Mapping[str, Special] = field(default_factory=dict)
    numbered: Collection[str] = ()
    faults: list[Fault] = field(default_factory=list)
    faulty: set[str] = field(default_factory=set)
    trusted: set[str] = field(default_factory=set)
    formula: Callable[[FormulaOf, object], object] | None = None

    def fault(self, path: str, found: str, expected: str, nearest: str = "") -> None:
        """Note a fault of a path."""
        self.faults.append(Fault(path, found, expected, nearest))
        self.faulty.add(path)

    def unknown(self, section: str, key: str, known: Sequence[str]) -> None:
        """Note an unknown key; the known one that it is spelt like gets no fault of its own."""
        fault = UnknownKey.among(f"{section}{key}", key, known)
        self.faults.append(fault)
        self.faulty |= {fault.path, f"{section}{fault.nearest}"}

    def keys(self, path: str, model: type[Any]) -> list[str]:
        """Keys that a table may have."""
        own = (key.rpartition(".") for key in self.special)
        return list(dict.fromkeys([*fields_of(model), *(key for table, _, key in own if table == path)]))


Special = Callable[[object, Mapping[str, object], Reading], Mapping[str, object]]


def read_section(
    path: str, model: type[AnySection], table: object, reading: Reading, base: AnySection | None = None
) -> AnySection:
    """Return one table, the file itself at the path "", as its section; with faults, one of the good values only.

    Values that the table leaves out are those of `base`, whose own faults are noted elsewhere. Numbered tables in it
    are left to the caller: single parts.
    """
    if not isinstance(table, dict):
        reading.fault(path, repr(table), f"a table [{path}] with {', '.join(reading.keys(path, model))}")
        return partial_section(model, {})
    stated = _values(path, model, table, reading)
    values: dict[str, Any] = {**(vars(base) if base is not None else {}), **stated}
    for key, own in fields_of(model).items():
        if limit := broken_limit(own, stated.get(key)):
            reading.fault(under(path, key), str(table.get(key, table.get(key + ABSOLUTE))), limit)
        elif own.required and key not in values and under(path, key) not in reading.faulty and base is None:
            reading.fault(under(path, key), "missing", wanted(own))
    good = {key: value for key, value in values.items() if under(path, key) not in reading.faulty}
    reading.trusted |= {under(path, key) for key in good}
    if any(one.startswith(under(path, "")) for one in reading.faulty) or not _complete(model, good):
        return partial_section(model, good)
    try:
        return model(**good)
    except InputError as reason:
        reading.fault(under(path, reason.where), reason.found, reason.expected)
    except ValueError as reason:
        reading.fault(path, ", ".join(stated) or "an empty table", str(reason))
    return partial_section(model, good)


def table_section(
    top: Table, name: str, model: type[AnySection], folder: Path = HERE, *, left_out: bool = False
) -> AnySection | None:
    """Return a table of a file as its section; None with its faults listed, and without a table.

    With `left_out` a table that is left out counts as an empty one.
    """
    table = top.table(name) or (Table(name, {}, top.faults) if left_out else None)
    if table is None:
        return None
    reading = Reading(folder, faults=top.faults)
    stated = read_section(name, model, table.values, reading)
    return None if reading.faulty else stated


def with_values(section: AnySection, **values: object) -> AnySection:
    """Copy of a section with other values, also of one that lacks some of its keys."""
    return partial_section(type(section), {**vars(section), **values})


def partial_section(model: type[AnySection], values: Mapping[str, object]) -> AnySection:
    """Section with these values and its defaults; a required key that is missing is an attribute that it lacks."""
    section = object.__new__(model)
    vars(section).update(values)
    return section


def _complete(model: type[Any], values: Mapping[str, object]) -> bool:
    return all(key in values for key, own in fields_of(model).items() if own.required)


def left_out_section(path: str, model: type[AnySection], reading: Reading, *, required: bool) -> AnySection:
    """Return a table that the file does not have: the empty one, with a fault where it is required."""
    if required and path not in reading.faulty:
        reading.fault(path, "missing", f"a table [{path}] with {', '.join(reading.keys(path, model))}")
    return partial_section(model, {})


def section_of(model: type[AnySection], values: Mapping[str, Any]) -> AnySection:
    """Return a section of SI values by key, tables in it as mappings.

    Raises ValueError for an unknown key, and for a value outside its limits.
    """
    types, found = fields_of(model), {}
    for key, value in values.items():
        if key not in types:
            raise ValueError(f"{model.__name__}: found {key}, expected one of {', '.join(types)}")
        inner = types[key].table
        found[key] = section_of(inner, value) if inner is not None and isinstance(value, Mapping) else value
        if isinstance(value, (int, float)) and not types[key].whole:
            found[key] = float(value)
        if limit := broken_limit(types[key], found[key]):
            raise ValueError(f"{model.__name__}: found {key} = {value}, expected {limit}")
    return model(**found)


def under(path: str, key: str) -> str:
    """Return the path of a key in a table; at the path "" stands the file itself."""
    return f"{path}.{key}" if path else key


def is_number(key: str) -> bool:
    """True for the name of a single part's table: a chamber's number, written one way only."""
    return key.isdecimal() and key == str(int(key))


def _values(path: str, model: type[Any], table: Mapping[str, object], reading: Reading) -> dict[str, object]:
    """Return the SI values of a table, and note every entry without a valid value."""
    values: dict[str, object] = {}
    types = fields_of(model)
    for written, raw in table.items():
        key = written.removesuffix(ABSOLUTE)
        own, absolute = types.get(key), key != written
        if read := reading.special.get(under(path, written)):
            values |= read(raw, table, reading)
        elif path in reading.numbered and is_number(written):
            continue
        elif own is None or (absolute and not own.may_be_absolute):
            reading.unknown(under(path, ""), written, reading.keys(path, model))
        elif absolute and key in table:
            reading.fault(under(path, written), f"both {key} and {written}", "one of the two, gauge or absolute")
        elif (
            value := read_entry(under(path, written), own, without_absolute(raw) if absolute else raw, reading)
        ) is None:
            reading.faulty.add(under(path, key))
        else:
            values[key] = _gauge(value) if absolute else value
    return values


def _gauge(value: Any) -> float | tuple[float, ...]:
    return tuple(map(to_gauge, value)) if isinstance(value, tuple) else to_gauge(value)


def read_entry(path: str, own: FieldType, raw: object, reading: Reading) -> object:
    """Return the value of an entry, or None with its faults noted; of a table also its valid part."""
    found: object
    if own.tables is not None:
        return _inner_tables(path, own.tables, raw, reading)
    if own.several is not None:
        return _several(path, own, own.several.count, raw, reading)
    if own.table is not None:
        found = read_section(path, own.table, raw, reading)
    elif own.named is not None:
        found = _named(path, own.named, raw, reading)
    elif own.forms and isinstance(raw, dict):
        found = read_form(path, own, raw, reading)
    elif own.from_table is not None and isinstance(raw, dict):
        found = _from_table(path, own.from_table, raw, reading)
    else:
        return _value(path, own, raw, reading)
    _note_inner_faults(path, reading)
    return found


def _value(path: str, own: FieldType, raw: object, reading: Reading) -> object:
    """Return the value of an entry that is no table, or None with its faults noted."""
    try:
        if own.formula is not None and reading.formula is not None:
            return reading.formula(own.formula, raw)
        return read_value(own, raw, reading.folder)
    except QuantityError as reason:
        reading.fault(path, reason.found, reason.expected, reason.nearest)
    except InputFaults as reason:
        for fault in reason.faults:
            reading.fault(path, f"{fault.path}: {fault.found}", fault.expected, fault.nearest)
    return None


def _from_table(path: str, made: FromTable, table: Mapping[str, object], reading: Reading) -> object:
    """Return the value that a table stands for, or None with its faults noted."""
    section = read_section(path, made.section, table, reading)
    faulty = set(reading.faulty)
    for check in made.checks:
        if not any(under(path, key) in faulty for key in check.keys):
            for fault in check.faults(section):
                reading.fault(under(path, fault.path), fault.found, fault.expected, fault.nearest)
    return None if _note_inner_faults(path, reading) else made.value(section)


def _several(path: str, own: FieldType, count: int, raw: object, reading: Reading) -> tuple[object, ...] | None:
    """Return a list of `count` values (0: of any number, or one value) as a tuple; None with the faults noted."""
    entries = raw if isinstance(raw, list) else [raw]
    if not entries or (count and (not isinstance(raw, list) or len(raw) != count)):
        reading.fault(path, repr(raw), wanted(own))
        return None
    found: list[object] = []
    for n, one in enumerate(entries):
        where = f"{path}[{n}]" if count else path
        if (value := _value(where, own, one, reading)) is None:
            continue
        if limit := broken_limit(own, value):
            reading.fault(where, repr(one), limit)
        else:
            found.append(value)
    return tuple(found) if len(found) == len(entries) else None


def _named(path: str, own: FieldType, raw: object, reading: Reading) -> dict[str, object] | None:
    """Return the entries of a table of any names; None with its fault noted."""
    if not isinstance(raw, dict):
        reading.fault(path, repr(raw), f"a table [{path}], each name in it with {wanted(own)}")
        return None
    return {name: read_entry(under(path, name), own, one, reading) for name, one in raw.items()}


def read_form(path: str, own: FieldType, table: Mapping[str, object], reading: Reading) -> object:
    """Return a table as that of a field's forms whose first key it has, of a choice with the form's own value.

    None with the fault noted without such a form; a key of another form is a fault.
    """
    form = next((one for one in own.forms if _fits(one, table)), None)
    if form is None:
        _note_no_form(path, own, table, reading)
        return None
    head, *_ = fields_of(form)
    others = {key for one in own.forms for key in fields_of(one)} - {*fields_of(form)}
    for key in filter(others.__contains__, table):
        reading.fault(under(path, key), f"{key} beside {head} = {table[head]!r}", wanted(own))
    return read_section(path, form, {key: value for key, value in table.items() if key not in others}, reading)


def _fits(form: type[Any], table: Mapping[str, object]) -> bool:
    head, own = next(iter(fields_of(form).items()))
    return head in table and (not own.choices or table[head] in [one.value for one in own.choices])


def _note_no_form(path: str, own: FieldType, table: Mapping[str, object], reading: Reading) -> None:
    """Note the choice that selects the form where it is wrong, or missing in all of them; else the table."""
    heads = [next(iter(fields_of(form).items())) for form in own.forms]
    of_choice = [head for head, first in heads if first.choices]
    if of_choice and (of_choice[0] in table or len(of_choice) == len(heads)):
        key, choices = of_choice[0], [one for _, first in heads for one in first.choices]
        near = nearest_choice(str(table.get(key)), [str(one.value) for one in choices])
        reading.fault(under(path, key), stated(table.get(key)), f"one of {names_of(choices)}", near)
    else:
        reading.fault(path, ", ".join(table) or "an empty table", wanted(own))


def _inner_tables(path: str, model: type[Any], raw: object, reading: Reading) -> tuple[Any, ...]:
    """Return the tables of a list of tables; none where one has a fault."""
    if not isinstance(raw, list):
        reading.fault(path, repr(raw), f"a list of tables with {', '.join(reading.keys(path, model))}")
        return ()
    found = tuple(read_section(f"{path}.{n}", model, table, reading) for n, table in enumerate(raw, start=1))
    return () if _note_inner_faults(path, reading) else found


def _note_inner_faults(path: str, reading: Reading) -> bool:
    """True where an entry of a table has a fault; its path then counts as one with a fault."""
    found = any(fault.path.startswith(f"{path}.") for fault in reading.faults)
    if found:
        reading.faulty.add(path)
    return found
