"""Pictures of a duty cycle: the course over time, and the losses by kind."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of
from swashfilm.runs.map.plots import COLOURS
from system.inputs.shown import titled
from system.maps.plan import MapInput

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

BALANCE = ("shaft", "hydraulic", "loss")
"""Energies of a cycle that are no loss."""
_INPUTS = {MapInput.SPEED: "speed", MapInput.PRESSURE: "pressure", MapInput.RATIO: "displacement ratio"}
"""Inputs that the picture of a cycle shows, with their short names."""
RATIO = "sum p Q over shaft power"


def course_of(data: xarray.Dataset) -> dict[str, Array]:
    """Return the columns of course.csv by name, SI."""
    return {str(name): column.values for name, column in data.data_vars.items()}


def course_plot(course: Mapping[str, Array]) -> Figure:
    """Draw the cycle over time: inputs, loss, and sum p Q over shaft power."""
    shown = [given for given in _INPUTS if given.words in course]
    figure = figure_of(7.6, 1.5 * (len(shown) + 2))
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


def sinks_of(summary: Mapping[str, Any]) -> dict[str, Mapping[str, float]]:
    """Return the energies lost by kind, the largest first."""
    sinks = {words: energy for words, energy in summary["energy_J"].items() if words not in BALANCE}
    return dict(sorted(sinks.items(), key=lambda item: -float(item[1]["value"])))


def share_text(value: float, loss: float, digits: int = 0) -> str:
    """Return the share of an energy lost in the whole loss, %; empty where nothing is lost."""
    return f"{100.0 * value / loss:.{digits}f} %" if loss > 0.0 else ""


def sinks_plot(summary: Mapping[str, Any]) -> Figure:
    """Draw the energy lost by kind as bars, each with its share of the loss and the error of interpolation."""
    sinks, loss = sinks_of(summary), summary["energy_J"]["loss"]["value"]
    figure = figure_of(7.6, max(2.4, 0.3 * len(sinks)))
    axes = figure.subplots()
    values = [energy["value"] * 1e-3 for energy in sinks.values()]
    bars = axes.barh([*sinks], values, xerr=[energy["error"] * 1e-3 for energy in sinks.values()], color=COLOURS[0])
    axes.bar_label(bars, [share_text(1e3 * value, loss, 1) for value in values], padding=4, fontsize=9)
    axes.invert_yaxis()
    axes.margins(x=0.12)
    axes.set_xlabel("energy lost [kJ]")
    axes.grid(visible=True, axis="x", alpha=0.3)
    return figure
