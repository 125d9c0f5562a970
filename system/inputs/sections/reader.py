"""Sections from tables of TOML: a frozen dataclass in SI, and every fault of the file at once."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.sections.fields import AnySection, FieldType, fields_of, partial_section
from system.inputs.sections.values import HERE, broken_limit, read_value, wanted
from system.inputs.units import QuantityError, to_gauge

ABSOLUTE = "_abs"  # a pressure key that ends so is absolute


@dataclass
class Reading:
    """State of a file that is read: its faults, the paths with a fault, and the paths whose values are good.

    `folder`: from where the paths of files in it are counted. `special`: keys by path that are read otherwise,
    as (raw value, table, reading) -> SI values by key. `numbered`: paths of tables that hold single parts too.
    """

    folder: Path = HERE
    special: Mapping[str, Special] = field(default_factory=dict)
    numbered: Collection[str] = ()
    faults: list[Fault] = field(default_factory=list)
    faulty: set[str] = field(default_factory=set)
    trusted: set[str] = field(default_factory=set)

    def fault(self, path: str, found: str, expected: str, nearest: str = "") -> None:
        """Note a fault of a path."""
        self.faults.append(Fault(path, found, expected, nearest))
        self.faulty.add(path)

    def unknown(self, section: str, key: str, known: Sequence[str]) -> None:
        """Note an unknown key; the known one that it is spelt like gets no fault of its own."""
        near = nearest_choice(key, known)
        self.fault(f"{section}{key}", "unknown key", f"one of {', '.join(known)}", near)
        self.faulty.add(f"{section}{near}")

    def keys(self, path: str, model: type[Any]) -> list[str]:
        """Keys that a table may have."""
        own = (key.rpartition(".") for key in self.special)
        return list(dict.fromkeys([*fields_of(model), *(key for table, _, key in own if table == path)]))


Special = Callable[[object, Mapping[str, object], Reading], Mapping[str, object]]


def read_section(
    path: str, model: type[AnySection], table: object, reading: Reading, base: AnySection | None = None
) -> AnySection:
    """Return one table, the file itself at the path "", as its section; with faults, one of the good values only.

    What the table leaves out is that of `base`, whose own faults are noted elsewhere. Numbered tables in it are
    left to the caller: single parts.
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
    except ValueError as reason:
        reading.fault(path, ", ".join(stated) or "an empty table", str(reason))
        return partial_section(model, good)


def _complete(model: type[Any], values: Mapping[str, object]) -> bool:
    return all(key in values for key, own in fields_of(model).items() if own.required)


def left_out_section(path: str, model: type[AnySection], reading: Reading, *, required: bool) -> AnySection:
    """Return a table that the file does not have: the empty one, with a fault where it is required."""
    if required and path not in reading.faulty:
        reading.fault(path, "missing", f"a table [{path}] with {', '.join(reading.keys(path, model))}")
    return partial_section(model, {})


def section_of(model: type[AnySection], values: Mapping[str, Any]) -> AnySection:
    """Return a section of SI values by key, tables in it as mappings.

    Raises ValueError for a key that it has not, and for a value outside its limits.
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
    """Return the SI values of a table, and note every entry that gives none."""
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
        elif own.tables is not None:
            values[key] = _inner_tables(under(path, key), own.tables, raw, reading)
        elif own.table is not None:
            values[key] = read_section(under(path, key), own.table, raw, reading)
            _note_inner_faults(under(path, key), reading)
        elif (value := read_entry(under(path, written), own, raw, reading)) is None:
            reading.faulty.add(under(path, key))
        else:
            values[key] = to_gauge(value) if absolute and isinstance(value, float) else value
    return values


def read_entry(path: str, own: FieldType, raw: object, reading: Reading) -> object:
    """Return the value of an entry, or None with its faults noted."""
    if own.several:
        return _several(path, own, raw, reading)
    try:
        return read_value(own, raw, reading.folder)
    except QuantityError as reason:
        reading.fault(path, reason.found, reason.expected, reason.nearest)
    except InputFaults as reason:
        for fault in reason.faults:
            reading.fault(path, f"{fault.path}: {fault.found}", fault.expected, fault.nearest)
    return None


def _several(path: str, own: FieldType, raw: object, reading: Reading) -> tuple[object, ...] | None:
    """Return one value or a list of them as a tuple; None with a fault for each that is no such value."""
    found: list[object] = []
    entries = raw if isinstance(raw, list) else [raw]
    for one in entries:
        try:
            value = read_value(own, one, reading.folder)
        except QuantityError as reason:
            reading.fault(path, reason.found, reason.expected, reason.nearest)
            continue
        if limit := broken_limit(own, value):
            reading.fault(path, repr(one), limit)
        else:
            found.append(value)
    if not entries:
        reading.fault(path, "an empty list", wanted(own))
    return tuple(found) if found and len(found) == len(entries) else None


def _inner_tables(path: str, model: type[Any], raw: object, reading: Reading) -> tuple[Any, ...]:
    """Return the tables of a list of such; none where one has a fault."""
    if not isinstance(raw, list):
        reading.fault(path, repr(raw), f"a list of tables with {', '.join(reading.keys(path, model))}")
        return ()
    found = tuple(read_section(f"{path}.{n}", model, table, reading) for n, table in enumerate(raw, start=1))
    return () if _note_inner_faults(path, reading) else found


def _note_inner_faults(path: str, reading: Reading) -> bool:
    """True where something in a table has a fault; its path then counts as one with a fault."""
    found = any(fault.path.startswith(f"{path}.") for fault in reading.faults)
    if found:
        reading.faulty.add(path)
    return found
