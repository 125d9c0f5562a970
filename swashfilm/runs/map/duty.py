"""Duty cycle by a map: energies, losses, mean efficiency, page."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.data.files import Column, read_columns, write_columns
from swashfilm.output.figures import figure_of
from swashfilm.output.page import keep_pictures, read_summary, write_page
from swashfilm.output.run_folder import write_json
from swashfilm.runs.map.plots import COLOURS
from system.inputs.faults import Fault, InputFaults
from system.inputs.shown import titled
from system.maps.data import MapData
from system.maps.duty import Cycle, Duty, duty
from system.maps.interpolation import MapError, MapInterpolant, left_out_error
from system.maps.plan import MapInput

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

COURSE = "course.csv"
ENERGY_HEAD = ("", "energy", "error", "mean power", "share of the loss")
EFFICIENCY_HEAD = ("definition", "mean efficiency", "error", "overall, volumetric")
FINE = 400
"""Number of instants in the written and drawn time series."""


_INPUTS = {MapInput.SPEED: "speed", MapInput.PRESSURE: "pressure", MapInput.RATIO: "displacement ratio"}
"""Inputs that a picture of a cycle shows, with their short names."""
RATIO = "sum p Q over shaft power"


def run_duty(data: MapData, error: MapError | None, cycle: Cycle, given: Path, folder: Path) -> dict[str, Any]:
    """Run a cycle, of the file `given`, by a map; write cycle.csv, course.csv, summary.json, report.html.

    Returns the summary. The error is that of the map's file; without it, the error at inner levels left out.
    Raises InputFaults for a cycle beyond the map, and for an incomplete map.
    """
    interpolant = MapInterpolant(data)
    known = error or left_out_error(data)
    if known is None:
        expected = "a map with three levels of an input, or checked at fresh points (--check N)"
        raise InputFaults(data.name, [Fault("map", "no measure of its error between levels", expected)])
    found = duty(interpolant, cycle, known)
    shutil.copy(given, folder / "cycle.csv")
    _write_course(folder / COURSE, interpolant, cycle)
    summary = duty_summary(data, found)
    write_json(folder / "summary.json", summary)
    write_duty_page(folder)
    return summary


def duty_summary(data: MapData, found: Duty) -> dict[str, Any]:
    """Return the summary of a cycle, SI."""
    return {
        "format": 1,
        "kind": "duty",
        "name": data.name,
        "solver": data.words,
        "duration_s": found.duration,
        "shown_by": found.shown_by,
        "volume_m3": asdict(found.volume),
        "energy_J": {words: asdict(energy) for words, energy in found.energies.items()},
        "efficiency": {
            definition.value: asdict(energy) | {"label": definition.label, "formula": definition.formula}
            for definition, energy in found.efficiency.items()
        },
        "marked": dict(found.marked),
    }


def energy_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (name, energy, error, mean power, share of the loss)."""
    duration, loss = summary["duration_s"], summary["energy_J"]["loss"]["value"]
    for words, energy in summary["energy_J"].items():
        share = "" if words in ("shaft", "hydraulic", "loss") else f"{100.0 * energy['value'] / loss:.2f} %"
        yield (
            words,
            f"{energy['value'] * 1e-3:.5g} kJ",
            f"{energy['error'] * 1e-3:.2g} kJ",
            f"{energy['value'] / duration * 1e-3:.4g} kW",
            share,
        )
    volume = summary["volume_m3"]
    yield "delivered", f"{volume['value'] * 1e3:.5g} L", f"{volume['error'] * 1e3:.2g} L", "", ""


def efficiency_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (definition, mean efficiency, error, formula): ratios of energies, not means of ratios."""
    for one in summary["efficiency"].values():
        yield one["label"], f"{100.0 * one['value']:.3f} %", f"{100.0 * one['error']:.2g} %", one["formula"]


def marked_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (warning, fraction of the time next to points with it)."""
    for name, part in summary["marked"].items():
        yield name, f"{100.0 * part:.1f} % of the time"


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
    columns = {
        "time": (time, "s"),
        **{given.words: (values, given.unit) for given, values in inputs.items()},
        "shaft power": (shaft, "W"),
        "hydraulic power": (hydraulic, "W"),
        "loss": (shaft - hydraulic, "W"),
        RATIO: (hydraulic / shaft, "1"),
        "delivery flow": (numbers["delivery_flow"], "m3/s"),
    }
    write_columns(
        path, [Column(name, np.broadcast_to(values, time.shape), unit) for name, (values, unit) in columns.items()]
    )


def write_duty_page(folder: Path) -> Path:
    """Write report.html and plots/ of a duty's run folder from its summary.json and course.csv."""
    summary = read_summary(folder)
    pictures = duty_plots(read_columns(folder / COURSE), summary)
    return write_page(
        folder,
        "duty",
        summary=summary,
        energies=list(energy_rows(summary)),
        energy_head=ENERGY_HEAD,
        efficiencies=list(efficiency_rows(summary)),
        efficiency_head=EFFICIENCY_HEAD,
        marked=list(marked_rows(summary)),
        pictures=keep_pictures(folder, "duty", pictures),
    )


def held_inputs(data: MapData) -> str:
    """Return the inputs with one level in the map, in words."""
    held = [axis for axis in data.axes if len(axis.values) == 1 and axis.input is not MapInput.RATIO]
    return ", ".join(f"{axis.input.words} {axis.input.text(axis.values[0])}" for axis in held)


def duty_plots(course: Mapping[str, Array], summary: Mapping[str, Any]) -> dict[str, Figure]:
    """Return the pictures of a cycle by caption."""
    return {
        "Operating point, loss, and sum p Q over shaft power during the cycle": course_plot(course),
        "Energy lost over the cycle, by kind of loss; bars: the error of interpolation": _sinks(summary),
    }


def course_of(data: xarray.Dataset) -> dict[str, Array]:
    """Return the columns of course.csv by name, SI."""
    return {str(name): column.values for name, column in data.data_vars.items()}


def course_plot(course: Mapping[str, Array]) -> Figure:
    """Draw the cycle over time: inputs, loss, and sum p Q over shaft power."""
    shown = [given for given in _INPUTS if given.words in course]
    figure = figure_of(10.0, 1.7 * (len(shown) + 2))
    panels = figure.subplots(len(shown) + 2, 1, sharex=True)
    time = course["time"]
    for axes, given in zip(panels, shown, strict=False):
        axes.plot(time, given.shown.of(course[given.words]), color="#3c7a8c")
        axes.set_ylabel(titled(_INPUTS[given], given.shown.unit))
    panels[-2].plot(time, course["loss"] * 1e-3, color="#8c5a3c")
    panels[-2].set_ylabel("loss [kW]")
    panels[-1].plot(time, 100.0 * course[RATIO], color="#5b9a5b")
    panels[-1].set(ylabel="sum p Q / (w T) [%]", xlabel="time [s]")
    for axes in panels:
        axes.grid(visible=True, alpha=0.3)
        axes.set_xlim(time[0], time[-1])
    return figure


def _sinks(summary: Mapping[str, Any]) -> Figure:
    sinks = {
        words: energy for words, energy in summary["energy_J"].items() if words not in ("shaft", "hydraulic", "loss")
    }
    figure = figure_of(9.0, max(2.4, 0.32 * len(sinks)))
    axes = figure.subplots()
    names = list(sinks)
    axes.barh(
        names,
        [sinks[name]["value"] * 1e-3 for name in names],
        xerr=[sinks[name]["error"] * 1e-3 for name in names],
        color=[COLOURS[k % len(COLOURS)] for k in range(len(names))],
    )
    axes.invert_yaxis()
    axes.set_xlabel("energy [kJ]")
    axes.grid(visible=True, axis="x", alpha=0.3)
    return figure
