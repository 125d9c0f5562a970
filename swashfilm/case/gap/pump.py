"""Pump of a gap case: a built-in one or a file, with the values that the case sets."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from system.description.assumptions import Assumption
from system.description.pump import PumpDescription
from system.films.rotor import Rotor, rotor
from system.inputs.faults import Fault, InputFaults
from system.inputs.sections.fields import fields_of
from system.inputs.sections.json_schema import Schema, section_schema
from system.inputs.toml_table import Table
from system.pump.film_thickness import moved_to, unpressed
from system.pump.operating import operating_point
from system.pump_file.file import builtin_pumps, load_known_pump, load_pump

OPERATING = "operating"
TEMPERATURE = f"{OPERATING}.temperature"
FILE_KEYS = (".body.mesh", ".profile.trace")


@dataclass(frozen=True)
class CasePump:
    """A pump at its operating point, its source, and the values that the case sets, by path (`piston.mass`).

    rotor: with the films of the point's temperature and case pressure; pump: as described, its [operating] temperature
    that of its file, at which its films have the thickness stated; assumptions: for the values that its file leaves
    out.
    """

    rotor: Rotor
    pump: PumpDescription
    source: str
    stated: Mapping[str, Any]
    assumptions: tuple[Assumption, ...]


def read_case_pump(top: Table, film: Table, folder: Path) -> CasePump | None:
    """Return the pump of a table, with [operating] and [pump.SECTION] of the case; None with the faults listed.

    A value of the case replaces that of the pump file and has the same form; paths of files (rows, meshes) are
    relative to the case's folder.
    """
    source = film.get("pump")
    operating = top.table(OPERATING)
    own = top.table("pump") if top is not film else None
    if not isinstance(source, str):
        found = "missing" if source is None else repr(source)
        film.fault("pump", found, f"a built-in pump ({', '.join(builtin_pumps())}) or a pump file beside the case")
        return None
    if own and OPERATING in own.values:
        top.fault(f"pump.{OPERATING}", "the operating point", f"a table [{OPERATING}] of the case")
    ours = {key: part for key, part in own.values.items() if key != OPERATING} if own else {}
    stated = {path: _beside(path, value, folder) for path, value in _flat(ours)}
    at_point = {f"{OPERATING}.{key}": value for key, value in operating.values.items()} if operating else {}
    place = source if source in builtin_pumps() else str(folder / source)
    try:
        known = load_known_pump(place, stated | at_point)
        pump = known.pump
        described = _at_own_temperature(pump, place, stated | at_point)
    except InputFaults as reason:
        top.faults += [_at_case(fault, stated, film.name("pump")) for fault in reason.faults]
        return None
    point = operating_point(pump)
    warm = moved_to(described, pump.operating)
    return CasePump(rotor(unpressed(warm, point.case_pressure), point), described, place, stated, known.assumptions)


def _at_own_temperature(pump: PumpDescription, place: str, values: Mapping[str, Any]) -> PumpDescription:
    """The pump with the temperature that its file states; [physics.thermal_clearance] counts from it."""
    if TEMPERATURE not in values or pump.physics.thermal_clearance is None:
        return pump
    own = load_pump(place, {path: value for path, value in values.items() if path != TEMPERATURE})
    return replace(pump, operating=replace(pump.operating, temperature=own.operating.temperature))


def own_rows(stated: Mapping[str, Any]) -> list[str]:
    """Return the table [pump] of a resolved case, empty where the case sets no values."""
    if not stated:
        return []
    return ["", "[pump]", *(f"{path} = {json.dumps(value)}" for path, value in stated.items())]


def pump_tables_schema() -> Schema:
    """Return JSON Schemas of the tables [pump] and [operating] of a case, by name: any key of a pump file."""
    tables = {
        name: section_schema(own.table, complete=False, inner_complete=False)
        for name, own in fields_of(PumpDescription).items()
        if own.table is not None
    }
    operating = tables.pop(OPERATING)
    return {"pump": {"type": "object", "properties": tables, "additionalProperties": False}, OPERATING: operating}


def _flat(tables: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """Yield (dotted path, value) of every entry that is not a table."""
    for key, value in tables.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{above}{key}.")
        else:
            yield above + key, value


def _beside(path: str, value: Any, folder: Path) -> Any:
    """Return a value; the path of a file (rows, a trace, a part's mesh) is completed with the case's folder."""
    of_file = isinstance(value, str) and (value.lower().endswith(".csv") or path.endswith(FILE_KEYS))
    return str((folder / value).absolute()) if of_file else value


def _at_case(fault: Fault, stated: Mapping[str, Any], source: str) -> Fault:
    """Return a fault of the pump at the key of the case that causes it, or at that of its `source`."""
    path = fault.path
    if any(own == path or own.startswith(f"{path}.") for own in stated):
        where = f"pump.{path}"
    elif path.startswith(f"{OPERATING}."):
        where = path
    else:
        where = source if path == "pump" else f"{source} ({path})"
    return Fault(where, fault.found, fault.expected, fault.nearest)
