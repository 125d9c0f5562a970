"""Table [points] of an optimisation: operating points as levels of inputs, or a duty cycle."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from swashfilm.console.levels import map_axis
from swashfilm.runs.map.command import LEVELS
from swashfilm.runs.variation.case import cycle_axes
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, InputFaults, stated
from system.inputs.toml_table import Table
from system.maps.plan import MapAxis, MapInput, MapPlan, map_plan

KEYS = {option.removeprefix("--").replace("-", "_"): option for option in LEVELS}
"""Keys of the table, with the option of `swashfilm map` that means the same."""
CYCLE = "cycle"


def points_plan(top: Table, pump: PumpDescription, folder: Path) -> tuple[MapPlan | None, Path | None]:
    """Return the plan of [points] and its duty cycle's file; without a table the pump's own operating point.

    None with the faults listed.
    """
    table, faults = top.table("points"), len(top.faults)
    axes = [axis for key in KEYS if table and (axis := _axis(table, key)) is not None]
    cycle = _cycle(table, folder) if table else None
    if table:
        table.close()
    if len(top.faults) > faults:
        return None, None
    try:
        plan = map_plan(pump, axes if cycle is None else cycle_axes(pump, axes, cycle))
    except InputFaults as reason:
        top.faults += [Fault(f"points.{CYCLE}", f"{fault.path}: {fault.found}", fault.expected, fault.nearest)
                       for fault in reason.faults]  # fmt: skip
        return None, None
    top.faults += plan.checked().faults
    return plan, cycle


def _axis(table: Table, key: str) -> MapAxis | None:
    """Return the levels of a key; None without levels, or with its fault listed."""
    raw: Any = table.get(key)
    if raw is None:
        return None
    name, example, _ = LEVELS[KEYS[key]]
    listed = raw if isinstance(raw, list) else [raw]
    if not listed or not all(isinstance(one, str | int | float) and not isinstance(one, bool) for one in listed):
        table.fault(key, stated(raw), f'levels, such as "{example}"')
        return None
    found = map_axis(table.name(key), ",".join(map(str, listed)), MapInput[name], f'"{example}"')
    if isinstance(found, Fault):
        table.faults.append(found)
        return None
    return found


def _cycle(table: Table, folder: Path) -> Path | None:
    raw = table.get(CYCLE)
    if raw is None or isinstance(raw, str):
        return None if raw is None else folder / raw
    table.fault(CYCLE, stated(raw), "the path of a CSV file beside this one, such as 'cycle.csv'")
    return None
