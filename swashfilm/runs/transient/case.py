"""Transient case of a TOML file: pump, control pressure over time, and duration, validated."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np

from swashfilm.case.gap.pump import CasePump, own_rows, pump_tables_schema, read_case_pump
from swashfilm.case.settings import read_set
from system.description.assumptions import Assumption
from system.inputs.faults import InputFaults
from system.inputs.sections.fields import Points, Positive, Text
from system.inputs.sections.json_schema import Schema, quantity_schema, section_schema, tables_schema
from system.inputs.sections.reader import Reading, read_section
from system.inputs.sections.writer import section_rows
from system.inputs.toml_table import Table, fault_lines
from system.inputs.units import TURN, Dimension, QuantityError, format_quantity, parse_quantity
from system.inputs.versions import version_fault
from system.multibody.kinematics import swash_angle
from system.multibody.transient.solver import ControlPressure, TransientCase, Transition
from system.pump.chamber_kinds import kinds
from system.pump.laws.kinematics import drive_at_ratio
from system.pump.lumped import full_drive

FORMAT = 1
MOST_TURNS = 1000.0
EXAMPLE = '"2.5 MPa", or rows such as [["0 s", "2.5 MPa"], ["50 ms", "0.6 MPa"]]'
PressureRows = Annotated[
    tuple[tuple[float, float], ...],
    Points((Dimension.TIME, Dimension.PRESSURE), ("time", "pressure"), ("50 ms", "0.6 MPa")),
]


@dataclass(frozen=True, kw_only=True)
class TransientSection:
    """[transient]: displacement of a pump in time."""

    pump: Annotated[str, Text.NAME]  # a built-in pump, or a pump file beside the case
    end: Annotated[float, Dimension.TIME, Positive]
    control_pressure: PressureRows  # one value, or rows from 0 s on
    course: Transition = Transition.STEP  # between the rows
    step: Annotated[float, Dimension.ANGLE, Positive] | None = None  # of the shaft


@dataclass(frozen=True)
class StatedTransient:
    """A transient case: name, text of the file, resolved text, and the case in SI.

    assumptions: for the values that the pump file leaves out.
    """

    name: str
    text: str
    resolved: str
    asked: TransientCase
    assumptions: tuple[Assumption, ...]


def load_transient(path: Path, values: Mapping[str, object] | None = None) -> StatedTransient:
    """Return the transient of a file with other `values` of dotted keys; raise InputFaults with every fault."""
    text, tables = read_set(path, values or {})
    top = Table("", tables, [])
    if fault := version_fault("format", top.get("format"), FORMAT, "transient"):
        top.faults.append(fault)
    table = top.table("transient", needed="with pump, end and control_pressure")
    pump = read_case_pump(top, table, path.parent) if table else None
    section = _section(table) if table else None
    top.close()
    if table and section and pump:
        _hold_pump(table, pump, section)
    if top.faults or section is None or pump is None:
        raise InputFaults(str(path), top.faults, fault_lines(text, top.faults))
    return StatedTransient(path.stem, text, _resolved(section, pump), _asked(section, pump), pump.assumptions)


def transient_schema() -> Schema:
    """Return the JSON Schema of a transient case."""
    table = section_schema(TransientSection)
    rows = table["properties"]["control_pressure"]
    table["properties"]["control_pressure"] = {"anyOf": [quantity_schema(Dimension.PRESSURE.example), rows]}
    properties = {"format": {"const": FORMAT}, "transient": table, **pump_tables_schema()}
    return tables_schema("Swashfilm transient", properties, ("format", "transient"))


def _section(table: Table) -> TransientSection:
    """Return the section of the table; with faults, a section of the valid values only."""
    special = {"transient.control_pressure": _control_pressure, "transient.pump": lambda raw, *_: {"pump": raw}}
    reading = Reading(special=special, faults=table.faults, faulty={"transient.pump"})
    return read_section("transient", TransientSection, table.values, reading)


def _control_pressure(raw: object, _: Mapping[str, object], reading: Reading) -> Mapping[str, object]:
    """Return the rows of the control pressure; none with the faults listed."""
    key = "transient.control_pressure"
    rows = [["0 s", raw]] if isinstance(raw, str) else raw
    if not isinstance(rows, list) or not rows or not all(isinstance(row, list) and len(row) == 2 for row in rows):
        reading.fault(key, repr(raw), EXAMPLE)
        return {}
    read = []
    for number, row in enumerate(rows):
        try:
            read.append((parse_quantity(row[0], Dimension.TIME), parse_quantity(row[1], Dimension.PRESSURE)))
        except QuantityError as reason:
            reading.fault(f"{key}[{number}]", reason.found, reason.expected, reason.nearest)
            reading.faulty.add(key)
    times = [time for time, _ in read]
    if len(read) == len(rows) and (times[0] != 0.0 or np.any(np.diff(times) <= 0.0)):
        reading.fault(key, f"times {', '.join(str(row[0]) for row in rows)}", "times that rise from 0 s")
    return {"control_pressure": tuple(read)}


def _asked(section: TransientSection, pump: CasePump) -> TransientCase:
    times, values = np.array(section.control_pressure).T
    schedule = ControlPressure(times, values, section.course)
    return TransientCase(pump.pump, pump.rotor.point, schedule, section.end, section.step)


def _hold_pump(table: Table, pump: CasePump, section: TransientSection) -> None:
    """List faults of pump and operating point that a transient excludes."""
    whole, point = pump.pump, pump.rotor.point
    if not kinds(whole).alike:
        table.fault("pump", "chambers that differ", "identical chambers")
    stop = whole.swash_plate.angle_min or 0.0
    start = swash_angle(drive_at_ratio(full_drive(whole), point.displacement_ratio))
    if start < stop:
        found = f"{format_quantity(start, Dimension.ANGLE, digits=4)} at the start"
        limit = f"at least [swash_plate] angle_min, {format_quantity(stop, Dimension.ANGLE, digits=4)}"
        table.fault("pump (operating.displacement_ratio)", found, limit)
    if getattr(section, "end", 0.0) * point.shaft_speed > MOST_TURNS * TURN:
        table.fault("end", str(table.values["end"]), f"at most {MOST_TURNS:g} turns of the shaft")


def _resolved(section: TransientSection, pump: CasePump) -> str:
    """Return the text of this case."""
    rows = section_rows("transient", replace(section, pump=pump.source))
    operating = section_rows("operating", pump.rotor.pump.operating)
    return "\n".join([f"format = {FORMAT}", *rows, *own_rows(pump.stated), *operating]) + "\n"
