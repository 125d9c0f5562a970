"""Duty cycle by a map: energies, losses, mean efficiency."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.formats.versions import headed
from swashfilm.output.data.files import Column, write_columns
from swashfilm.output.run_folder import write_json
from swashfilm.runs.map.duty.page import COURSE, write_duty_page
from swashfilm.runs.map.duty.plots import RATIO
from system.inputs.faults import Fault, InputFaults
from system.maps.data import MapData, warning_counts
from system.maps.duty import Cycle, Duty, Energy, duty
from system.maps.interpolation import MapError, MapInterpolant, left_out_error
from system.maps.plan import MapInput
from system.maps.rating import rating_warnings
from system.pump.efficiency import EfficiencyDefinition

FINE = 400
"""Number of instants in the written and drawn time series."""


def run_duty(data: MapData, error: MapError | None, cycle: Cycle, given: Path, folder: Path) -> dict[str, Any]:
    """Run a cycle, of the file `given`, by a map; write cycle.csv, course.csv, summary.json, report.html.

    Returns the summary. The error is that of the map's file; without it, the error at inner levels left out.
    Raises InputFaults for a cycle beyond the map, and for an incomplete map.
    """
    interpolant = MapInterpolant(data)
    found = duty(interpolant, cycle, known_error(data, error))
    shutil.copy(given, folder / "cycle.csv")
    _write_course(folder / COURSE, interpolant, cycle)
    told = [*cycle_warnings(data, cycle), *point_warnings(data, found)]
    summary = duty_summary(data, found) | {"warnings": told}
    write_json(folder / "summary.json", summary)
    write_duty_page(folder)
    return summary


def known_error(data: MapData, error: MapError | None) -> MapError:
    """Return the error of a map between levels; without one, that at inner levels left out.

    Raises InputFaults for a map with neither.
    """
    known = error or left_out_error(data)
    if known is None:
        expected = "three levels or more of each input that varies, or a map with --check 8"
        raise InputFaults(data.name, [Fault("map", "no measure of its error between levels", expected)])
    return known


def duty_summary(data: MapData, found: Duty) -> dict[str, Any]:
    """Return the summary of a cycle, SI."""
    return {
        **headed("duty"),
        "name": data.name,
        "solver": data.words,
        "duration_s": found.duration,
        "shown_by": found.shown_by,
        "held": held_inputs(data),
        "volume_m3": asdict(found.volume),
        "energy_J": {words: asdict(energy) for words, energy in found.energies.items()},
        "efficiency": {
            definition.value: _ratio(found.efficiency.get(definition))
            | {"label": definition.label, "formula": definition.formula}
            for definition in EfficiencyDefinition
        },
        "marked": dict(found.marked),
    }


def cycle_warnings(data: MapData, cycle: Cycle, prefix: str = "") -> Iterator[str]:
    """Yield the warnings of a cycle whose rows exceed the pump's rating, as those of a map."""
    held = {axis.input: np.full(cycle.time.shape, axis.values[0]) for axis in data.axes}
    yield from rating_warnings(data, held | dict(cycle.inputs), "rows of the cycle", prefix)


def point_warnings(data: MapData, found: Duty) -> Iterator[str]:
    """Yield each warning of the map's points that the cycle passes by, with their number and the time beside them."""
    counts, solved = warning_counts(data), int(np.sum(data.solved))
    for name, part in found.marked.items():
        count, text = counts[name]
        yield (
            f"{name}: at {count} of {solved} points of the map, beside which the cycle spends {part:.1%} of its time; "
            f"at the first: {text}"
        )


def _ratio(energy: Energy | None) -> dict[str, float | None]:
    """Return a mean efficiency and its error, None of a cycle without one."""
    return {"value": None, "error": None} if energy is None else asdict(energy)


def held_inputs(data: MapData) -> str:
    """Return the inputs with one level in the map, in words."""
    held = [axis for axis in data.axes if len(axis.values) == 1 and axis.input is not MapInput.RATIO]
    return ", ".join(f"{axis.input.words} {axis.input.text(axis.values[0])}" for axis in held)


def _write_course(path: Path, interpolant: MapInterpolant, cycle: Cycle) -> None:
    """Write inputs, loss and efficiency over time, evenly and at every row of the cycle (both sides of a step)."""
    even = np.setdiff1d(np.linspace(cycle.time[0], cycle.time[-1], FINE), cycle.time)
    before = np.searchsorted(cycle.time, even)
    time = np.insert(cycle.time, before, even)
    inputs = {
        given: np.insert(values, before, np.interp(even, cycle.time, values)) for given, values in cycle.inputs.items()
    }
    numbers = interpolant.at(inputs)
    shaft, hydraulic = numbers["shaft_power"], numbers["hydraulic_power"]
    ratio = np.divide(hydraulic, shaft, out=np.full_like(shaft, np.nan), where=shaft > 0.0)
    columns = {
        "time": (time, "s"),
        **{given.words: (values, given.unit) for given, values in inputs.items()},
        "shaft power": (shaft, "W"),
        "hydraulic power": (hydraulic, "W"),
        "loss": (shaft - hydraulic, "W"),
        RATIO: (ratio, "1"),
        "delivery flow": (numbers["delivery_flow"], "m3/s"),
    }
    write_columns(
        path, [Column(name, np.broadcast_to(values, time.shape), unit) for name, (values, unit) in columns.items()]
    )
