"""Pictures of a duty cycle: what the pump does over time, and where its energy goes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of
from swashfilm.runs.map.plots import COLOURS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_INPUTS = {
    "shaft speed [rad/s]": (30.0 / np.pi, "speed / rpm"),
    "delivery pressure [Pa]": (1e-6, "pressure / MPa"),
    "displacement ratio [1]": (1.0, "displacement ratio"),
}


def duty_plots(course: Mapping[str, Array], summary: Mapping[str, Any]) -> dict[str, Figure]:
    """Captions and PNGs of a cycle."""
    return {
        "The cycle: what is asked of the pump, its loss, and sum p Q over shaft power": _course(course),
        "Energy lost over the cycle, by what takes it; bars: the error of interpolation": _sinks(summary),
    }


def _course(course: Mapping[str, Array]) -> Figure:
    shown = {head: row for head, row in _INPUTS.items() if head in course}
    figure = figure_of(10.0, 1.7 * (len(shown) + 2))
    panels = figure.subplots(len(shown) + 2, 1, sharex=True)
    time = course["time [s]"]
    for axes, (head, (scale, label)) in zip(panels, shown.items(), strict=False):
        axes.plot(time, course[head] * scale, color="#3c7a8c")
        axes.set_ylabel(label)
    panels[-2].plot(time, course["loss [W]"] * 1e-3, color="#8c5a3c")
    panels[-2].set_ylabel("loss / kW")
    panels[-1].plot(time, 100.0 * course["sum p Q / shaft power [1]"], color="#5b9a5b")
    panels[-1].set(ylabel="sum p Q / (w T) / %", xlabel="time / s")
    for axes in panels:
        axes.grid(visible=True, alpha=0.3)
        axes.set_xlim(time[0], time[-1])
    return figure


def _sinks(summary: Mapping[str, Any]) -> Figure:
    sinks = {
        words: energy
        for words, energy in summary["energy_J"].items()
        if words not in ("shaft", "hydraulic", "loss")
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
    axes.set_xlabel("energy / kJ")
    axes.grid(visible=True, axis="x", alpha=0.3)
    return figure
