"""Tables of a scant pump file, completed: each value that the file leaves out is REF90's, scaled."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from system.description.assumptions import Assumption
from system.description.pump import FORMAT
from system.inputs.faults import Fault, InputFaults
from system.inputs.sections.fields import fields_of
from system.inputs.sections.values import HERE
from system.inputs.units import Dimension, format_quantity
from system.pump_file.scaled.facts import Facts, facts_of
from system.pump_file.scaled.open_circuit import OPEN_OPERATING, open_circuit_values
from system.pump_file.scaled.scaling import SIZED, scaled_tables
from system.pump_file.tables import faults_as_written, pump_of_tables

NEEDED = ("slipper", "valve_plate", "ports")
"""Tables without which a pump file is a scant one."""
WIDE = "wide, since the pump is scaled from another"
SCALED = "REF90's, scaled to displacement and pistons"
TAKEN = "REF90's"
OPEN = "usual in an open circuit"
"""Reasons of assumptions: of a tolerance, of a value that goes with the size, of one that does not, of a circuit."""
_WIDE: dict[str, float | str] = {
    "film_thickness": 0.5,
    "eccentricity_ratio": 0.2,
    "bulk_modulus": 0.1,
    "friction": 0.6,
    "guide_friction": 0.6,
    "bearing_friction": 0.6,
    "displacement": 0.005,
    "dead_volume": 0.3,
    "flow_coefficient": 0.3,
    "viscosity_slope": "0.001 1/K",  # a grade leaves the index open: 95 to 115 of mineral oils are .0025 1/K apart
    "inlet_share": 0.5,
}
"""[tolerance] of scaled values, which a recording determines: the films of HST 196 are 1.5 to 1.9 times REF90's."""


@dataclass(frozen=True)
class Completed:
    """Tables of a pump file, complete; the paths that the file itself states, and assumptions for the others."""

    tables: Mapping[str, Any]
    stated: frozenset[str]
    assumptions: tuple[Assumption, ...]

    def in_open_circuit(self) -> Completed:
        """Return the pump with inlet, case, spring and ports of one that draws from a tank."""
        tables = {name: dict(own) if isinstance(own, dict) else own for name, own in self.tables.items()}
        tables["operating"] |= OPEN_OPERATING
        values = open_circuit_values(pump_of_tables(self.tables["name"], tables))
        for path, value in values.items():
            *sections, key = path.split(".")
            table: Any = tables
            for section in sections:
                table = table.setdefault(section, {})
            table[key] = value
        others = [one for one in self.assumptions if one.path not in values]
        taken = [Assumption(path, value, OPEN) for path, value in values.items()]
        return Completed(tables, self.stated, (*others, *taken))


def is_scant(tables: Mapping[str, Any]) -> bool:
    """Return True for a pump file that lacks one of the tables NEEDED."""
    return any(name not in tables for name in NEEDED)


def completed(
    label: str, stated: Mapping[str, Any], name: str, lines: Mapping[str, int | None] | None = None, folder: Path = HERE
) -> Completed:
    """Return the tables of a scant file with REF90's, scaled, for missing values; `name` is the pump's if unnamed.

    Raises InputFaults under the name `label` if displacement, pistons or oil is not stated, with the faults of all that
    is; files in values are sought in `folder`.
    """
    faults: list[Fault] = []
    facts = facts_of(stated, faults)
    if facts is None:
        own = {f"pump.{key}" for key in fields_of(Facts)} | {fault.path for fault in faults}
        faults += [fault for fault in faults_as_written(stated, folder) if fault.path not in own]
        raise InputFaults(label, faults, lines)
    tables: dict[str, Any] = {"name": name, "format": FORMAT, **scaled_tables(facts), "tolerance": dict(_WIDE)}
    paths = set()
    for key, table in stated.items():
        if isinstance(table, dict) and isinstance(tables.get(key, {}), dict):
            if key == "oil" and "grade" not in table:
                tables["oil"].pop("grade")
            tables[key] = {**tables.get(key, {}), **table}
            paths |= {f"{key}.{own}" for own in table}
        else:
            tables[key] = table
    tables["pump"]["displacement"] = format_quantity(facts.displacement, Dimension.DISPLACEMENT)
    return Completed(tables, frozenset(paths), _assumptions(tables, paths))


def _assumptions(tables: Mapping[str, Any], stated: set[str]) -> tuple[Assumption, ...]:
    """Values that the file does not state, with their reasons."""
    return tuple(
        Assumption(path, str(value), WIDE if path.startswith("tolerance.") else SCALED if path in SIZED else TAKEN)
        for name, table in tables.items()
        if isinstance(table, dict)
        for path, value in _values(name, table, stated)
    )


def _values(path: str, table: Mapping[str, Any], stated: set[str]) -> Iterator[tuple[str, Any]]:
    """Yield path and value of a table's entries, and of those of the tables in it, but the stated ones."""
    for key, value in table.items():
        own = f"{path}.{key}"
        if own not in stated and isinstance(value, dict):
            yield from _values(own, value, stated)
        elif own not in stated:
            yield own, value
