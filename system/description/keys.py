"""Numbers of a pump file by table and key: the subjects of sensitivities and tolerances."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, is_dataclass, replace
from typing import Any

from system.description.pump import PumpDescription
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.sections.fields import FieldType, fields_of
from system.inputs.sections.values import broken_limit
from system.inputs.units import Dimension, format_quantity

LEFT_OUT = {
    "pump.displacement": "it follows from the geometry",
    "pump.rated_speed": "it only warns",
    "pump.rated_pressure": "it only warns",
}
"""Numbers that are no dimensions of the pump, each with the reason."""
_NO_DIMENSIONS = ("operating", "tolerance")


@dataclass(frozen=True)
class PumpKey:
    """A number of a pump file: its `path` (table and key), its value in SI, and its field."""

    path: str
    value: float
    field: FieldType

    @property
    def dimension(self) -> Dimension | None:
        """Kind of the quantity; None for a pure number."""
        return self.field.dimension

    @property
    def text(self) -> str:
        """The value as people read it."""
        return self.shown(self.value)

    def shown(self, value: float, digits: int = 5) -> str:
        """Another value of the key as people read it."""
        return f"{value:.{digits}g}" if self.dimension is None else format_quantity(value, self.dimension, digits)


def pump_keys(pump: PumpDescription) -> dict[str, PumpKey]:
    """Return every dimension of a pump by its path, in the order of the file.

    All stated numbers that are no whole numbers: lengths, angles, areas, coefficients, oil, stiffnesses. Not the
    operating point, the tolerances, rows of numbers and those of `LEFT_OUT`. The tables of a list are numbered from 1
    (`ports.grooves.1.start`).
    """
    tables = {name: own.table for name, own in fields_of(PumpDescription).items() if own.table}
    found = (one for name in tables if name not in _NO_DIMENSIONS for one in _keys_in(name, getattr(pump, name)))
    return {one.path: one for one in found if one.path not in LEFT_OUT}


def _keys_in(path: str, section: Any) -> Iterator[PumpKey]:
    for key, own in fields_of(type(section)).items():
        value, where = getattr(section, key), f"{path}.{key}"
        if isinstance(value, float) and not (own.whole or own.several or own.forms):
            yield PumpKey(where, value, own)
        elif own.table is not None and is_dataclass(value):
            yield from _keys_in(where, value)
        elif own.tables is not None and isinstance(value, tuple):
            for number, one in enumerate(value, start=1):
                yield from _keys_in(f"{where}.{number}", one)


def with_values(pump: PumpDescription, values: Mapping[str, float]) -> PumpDescription:
    """Return the pump with other values (SI) of some of its `pump_keys`, its stated displacement left to follow.

    Limits of single values hold; `system.pump_file.file.check_pump` knows those of the geometry. Raises InputFaults
    with every value that no such key has.
    """
    if faults := [*_value_faults(pump, values)]:
        raise InputFaults(pump.name, faults)
    changed: Any = replace(pump, pump=replace(pump.pump, displacement=None))
    for path, value in values.items():
        changed = _with_value(changed, path.split("."), float(value))
    made: PumpDescription = changed
    return made


def _value_faults(pump: PumpDescription, values: Mapping[str, float]) -> Iterator[Fault]:
    """Yield the fault of each value beyond the limits of its key."""
    known = pump_keys(pump)
    for path, value in values.items():
        if limit := broken_limit(known[path].field, value):
            yield Fault(path, known[path].shown(value), limit)


def key_value(pump: PumpDescription, path: str) -> float:
    """Return the value (SI) of one of a pump's `pump_keys`."""
    item: Any = pump
    for name in path.split("."):
        item = item[int(name) - 1] if isinstance(item, tuple) else getattr(item, name)
    return float(item)


def key_dimension(path: str) -> Dimension | None:
    """Return the kind of the quantity at a path of any pump's `pump_keys`; None for a pure number.

    Raises KeyError for a path that no pump has.
    """
    section: Any = PumpDescription
    *tables, last = path.split(".")
    for name in tables:
        if not name.isdecimal():
            own = fields_of(section)[name]
            section = own.table or own.tables
    return fields_of(section)[last].dimension


def _with_value(item: Any, path: list[str], value: float) -> Any:
    name, *rest = path
    if isinstance(item, tuple):
        at = int(name) - 1
        return (*item[:at], _with_value(item[at], rest, value), *item[at + 1 :])
    if rest:
        return replace(item, **{name: _with_value(getattr(item, name), rest, value)})
    return replace(item, **{name: value})


def unknown_key(where: str, path: str, known: Mapping[str, PumpKey]) -> Fault:
    """Return the fault of a path that is no dimension of the pump: why, and the nearest one."""
    found = f"'{path}', {LEFT_OUT[path]}" if path in LEFT_OUT else f"'{path}', no dimension that the pump states"
    near = nearest_choice(path, known) or _by_last(path, known)
    return Fault(where, found, "table and key of a number of the pump file, such as 'piston.radial_clearance'", near)


def _by_last(path: str, known: Mapping[str, PumpKey]) -> str:
    """Return the path whose key alone is spelt like that of `path`, or like it."""
    last = path.rpartition(".")[2]
    by_key = {one.rpartition(".")[2]: one for one in reversed([*known])}
    near = nearest_choice(last, by_key)
    return by_key[near] if near else ""
