"""A transient case: the pump, its control pressure over time, and how long; from a TOML file, validated."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.case.gap.pump import CasePump, operating_rows, own_rows, read_case_pump
from system.inputs.faults import InputFaults
from system.inputs.toml_table import Table, fault_lines, quoted, read_toml
from system.inputs.units import Dimension, QuantityError, format_quantity, parse_quantity
from system.multibody.kinematics import swash_angle
from system.multibody.transient.solver import ControlPressure, TransientCase, Transition
from system.pump.chamber_kinds import kinds
from system.pump.laws.kinematics import drive_at_ratio
from system.pump.lumped import full_drive

FORMAT = 1
MOST_TURNS = 1000.0
EXAMPLE = '"2.5 MPa", or rows such as [["0 s", "2.5 MPa"], ["50 ms", "0.6 MPa"]]'


@dataclass(frozen=True)
class StatedTransient:
    """A transient as its file states it: name, text, the same resolved, and what is asked (SI)."""

    name: str
    text: str
    resolved: str
    asked: TransientCase


def load_transient(path: Path) -> StatedTransient:
    """The transient of a file; raises InputFaults with every fault of it at once."""
    text, tables = read_toml(path)
    top = Table("", tables, [])
    if top.get("format") != FORMAT:
        top.fault("format", repr(tables.get("format")), f"format = {FORMAT}")
    table = top.table("transient", needed="with pump, end and control_pressure")
    pump = read_case_pump(top, table, path.parent) if table else None
    asked = _asked(table, pump) if table else None
    top.close()
    if top.faults or asked is None or pump is None:
        raise InputFaults(str(path), top.faults, fault_lines(text, top.faults))
    return StatedTransient(path.stem, text, _resolved(asked, pump), asked)


def _asked(table: Table, pump: CasePump | None) -> TransientCase | None:
    end = table.positive("end", Dimension.TIME)
    step = None if table.get("step") is None else table.positive("step", Dimension.ANGLE)
    course = table.choice("course", Transition, Transition.STEP)
    schedule = None if course is None else _schedule(table, course)
    table.close()
    if pump is None:
        return None
    _hold_pump(table, pump, end, schedule)
    if end is None or schedule is None:
        return None
    return TransientCase(pump.rotor.pump, pump.rotor.point, schedule, end, step)


def _schedule(table: Table, course: Transition) -> ControlPressure | None:
    """The control pressure; None with its faults told."""
    raw = table.get("control_pressure")
    rows = [["0 s", raw]] if isinstance(raw, str) else raw
    if not isinstance(rows, list) or not rows or not all(isinstance(row, list) and len(row) == 2 for row in rows):
        table.fault("control_pressure", "no such key" if raw is None else repr(raw), EXAMPLE)
        return None
    read = []
    for number, row in enumerate(rows):
        try:
            read.append([parse_quantity(row[0], Dimension.TIME), parse_quantity(row[1], Dimension.PRESSURE)])
        except QuantityError as reason:
            table.fault(f"control_pressure[{number}]", reason.found, reason.expected, reason.nearest)
    if len(read) < len(rows):
        return None
    times, values = np.array(read).T
    if times[0] != 0.0 or np.any(np.diff(times) <= 0.0):
        table.fault(
            "control_pressure", f"times {', '.join(str(row[0]) for row in rows)}", "times that rise from 0 s"
        )
        return None
    return ControlPressure(times, values, course)


def _hold_pump(table: Table, pump: CasePump, end: float | None, schedule: ControlPressure | None) -> None:
    """Tell what of pump and point no transient can have."""
    whole, point = pump.rotor.pump, pump.rotor.point
    if not kinds(whole).alike:
        table.fault("pump", "chambers that differ", "chambers that are alike")
    stop = whole.swash_plate.angle_min or 0.0
    start = swash_angle(drive_at_ratio(full_drive(whole), point.displacement_ratio))
    if start < stop:
        found = f"{format_quantity(start, Dimension.ANGLE, digits=4)} at the start"
        limit = f"at least [swash_plate] angle_min, {format_quantity(stop, Dimension.ANGLE, digits=4)}"
        table.fault("pump (operating.displacement_ratio)", found, limit)
    if end is not None and end * point.shaft_speed > MOST_TURNS * 2.0 * np.pi:
        table.fault("end", str(table.values["end"]), f"at most {MOST_TURNS:g} turns of the shaft")
    if schedule is not None and whole.actuator.area is None and schedule.values.max() <= point.case_pressure:
        found = f"at most {format_quantity(float(schedule.values.max()), Dimension.PRESSURE, digits=4)}"
        table.fault("control_pressure", found, "more than the case's pressure, or [pump.actuator] area")


def _resolved(asked: TransientCase, pump: CasePump) -> str:
    """A case file that gives this very case."""
    schedule = asked.control_pressure
    rows = ", ".join(
        f"[{quoted(format_quantity(float(time), Dimension.TIME))}, "
        f"{quoted(format_quantity(float(value), Dimension.PRESSURE))}]"
        for time, value in zip(schedule.times, schedule.values, strict=True)
    )
    stated: list[Any] = [
        f"format = {FORMAT}", "", "[transient]", f"pump = {quoted(pump.source)}",
        f"end = {quoted(format_quantity(asked.end, Dimension.TIME))}", f"control_pressure = [{rows}]",
        f"course = {quoted(schedule.course.value)}",
    ]  # fmt: skip
    if asked.step is not None:
        stated.append(f"step = {quoted(format_quantity(asked.step, Dimension.ANGLE))}")
    return "\n".join([*stated, *own_rows(pump.stated), "", *operating_rows(pump.rotor.point)]) + "\n"
