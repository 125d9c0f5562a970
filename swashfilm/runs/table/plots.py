"""Pictures of a response table: error of each output, held-out points, and outputs over each input."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gaps.response import Axis, Response, Spacing
from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of
from swashfilm.output.headline import named
from system.inputs.shown import Shown, shown_in, titled
from system.inputs.units import Dimension
from system.points.table.response_table import LARGE_ERROR, axis_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLOURS = {"piston": "#3c7a8c", "slipper": "#8c5a3c", "valve_plate": "#5b9a5b", "socket": "#b8862b", "": "#3c7a8c"}
NEGLIGIBLE = 1e-4
"""Error below which outputs share a row of a table, and are left out of a picture."""
COURSE = 80
"""Points of a line."""
COLUMNS = 5
"""Pictures side by side."""
FEW_TICKS = 3.0
"""Ratio of an axis' ends below which a logarithmic scale has too few plain numbers."""
Groups = Mapping[str, Sequence[tuple[str, int]]]
"""Outputs in one picture: outputs of one kind, each with its gap ("" for a gap alone) and its column."""


def table_plots(response: Response, record: Mapping[str, Any]) -> dict[str, Figure]:
    """Return a table's pictures by caption; `record` holds dimensions of the axes and units of the outputs."""
    return {
        "Error of held-out points, rms and largest; dashed: the limit above which a warning is given": _errors(
            response
        ),
        "Held-out points, solved and by the table": _parity(response, record),
        "Outputs over each input through the middle of the box; dots: held-out points at any values of the other "
        "inputs": _courses(response, record),
    }


def _groups(response: Response) -> Groups:
    """Return the groups: `piston.leakage` and `slipper.leakage` together; outputs that vanish are left out."""
    found: dict[str, list[tuple[str, int]]] = {}
    for column, output in enumerate(response.outputs):
        whose, _, what = output.name.rpartition(".")
        if not np.abs(response.learnt.values[:, column]).max() < output.least:
            found.setdefault(what, []).append((whose, column))
    return found


def words_of(name: str) -> str:
    """Return the name of an output in words, without its unit."""
    return named(name)[0].replace("_", " ")


def _errors(response: Response) -> Figure:
    """Draw rms and largest error of each output as bars, negligible ones left out."""
    error = response.held_out_error
    told = np.flatnonzero(error.largest >= NEGLIGIBLE)
    figure = figure_of(6.8, max(2.4, 0.3 * len(told)))
    axes, rows = figure.subplots(), np.arange(len(told))
    axes.barh(rows - 0.2, error.largest[told], 0.38, color="#c8a27c", label="largest")
    axes.barh(rows + 0.2, error.rms[told], 0.38, color="#3c7a8c", label="rms")
    axes.axvline(LARGE_ERROR, color="#b55a00", linestyle="--")
    names = [f"{words_of(response.outputs[k].name)} ({response.outputs[k].measure.value})" for k in told]
    axes.set_yticks(rows, names)
    most = float(error.largest.max())
    axes.set(xscale="log", xlabel="error", xlim=(0.1 * NEGLIGIBLE, max(0.1, 1.3 * most)))
    axes.invert_yaxis()
    axes.legend(loc="best", fontsize=8)
    axes.grid(visible=True, axis="x", alpha=0.3)
    return figure


def _parity(response: Response, record: Mapping[str, Any]) -> Figure:
    groups = _groups(response)
    lines = -(-len(groups) // COLUMNS)
    figure = figure_of(11.0, 2.6 * lines)
    solved, by_table = response.held_out.values, response.at(response.held_out.points)
    places = figure.subplots(lines, COLUMNS, squeeze=False).ravel()
    for axes, (what, members) in zip(places, groups.items(), strict=False):
        title, how = _shown(what, members, record)
        for whose, k in members:
            axes.plot(
                how.of(solved[:, k]), how.of(by_table[:, k]), "o", markersize=3.5, alpha=0.8,
                color=COLOURS[whose], label=words_of(whose),
            )  # fmt: skip
        ends = [*axes.get_xlim(), *axes.get_ylim()]
        axes.plot([min(ends), max(ends)], [min(ends), max(ends)], color="#1c2328", linewidth=0.8)
        axes.set_title(title, fontsize=8)
        axes.set_xlabel("solved", fontsize=8)
        axes.tick_params(labelsize=7)
        axes.locator_params(nbins=3)
    for axes in places[len(groups) :]:
        axes.set_axis_off()
    places[0].set_ylabel("by the table", fontsize=8)
    _legend(figure)
    return figure


def _courses(response: Response, record: Mapping[str, Any]) -> Figure:
    groups = _groups(response)
    figure = figure_of(max(5.0, 2.75 * len(response.axes)), 1.7 * len(groups))
    grid = figure.subplots(len(groups), len(response.axes), sharey="row", squeeze=False)
    middle = np.array([float(axis.from_unit(np.array(0.5))) for axis in response.axes])
    for j, (axis, row) in enumerate(zip(response.axes, record["axes"], strict=True)):
        along = np.tile(middle, (COURSE, 1))
        along[:, j] = axis.from_unit(np.linspace(0.0, 1.0, COURSE))
        by_table, label = response.at(along), _axis_words(axis, row)
        places, dots = (_places(row, values[:, j]) for values in (along, response.held_out.points))
        for i, (what, members) in enumerate(groups.items()):
            title, how = _shown(what, members, record)
            axes = grid[i, j]
            for whose, k in members:
                axes.plot(places, how.of(by_table[:, k]), color=COLOURS[whose], label=words_of(whose))
                axes.plot(dots, how.of(response.held_out.values[:, k]), ".", color=COLOURS[whose], alpha=0.35)
            if axis.spacing is Spacing.LOGARITHMIC and axis.upper > FEW_TICKS * axis.lower:
                _logarithmic(axes)
            axes.grid(visible=True, alpha=0.3)
            axes.tick_params(labelsize=7, which="both")
            if j == 0:
                axes.set_ylabel(title, fontsize=8)
        grid[-1, j].set_xlabel(label, fontsize=8)
    _legend(figure)
    return figure


def _shown(what: str, members: Sequence[tuple[str, int]], record: Mapping[str, Any]) -> tuple[str, Shown]:
    """Return the title of outputs in one picture, with their unit, and that unit."""
    how = shown_in(record["outputs"][members[0][1]]["unit"], what)
    return titled(words_of(what), how.unit), how


def _axis_words(axis: Axis, row: Mapping[str, Any]) -> str:
    return titled(axis_words(axis.name), _unit(row).unit)


def _unit(row: Mapping[str, Any]) -> Shown:
    unit = Dimension[row["dimension"]].si_unit if row["dimension"] else "1"
    return shown_in(unit, row["name"], row["upper"])


def _places(row: Mapping[str, Any], values: Array) -> Array:
    """Return values of an input in the unit of its axis."""
    return np.asarray(_unit(row).of(values))


def _legend(figure: Any) -> None:
    """Draw one legend for several gaps."""
    pairs = [axes.get_legend_handles_labels() for axes in figure.axes]
    curves = {label: handle for handles, labels in pairs for handle, label in zip(handles, labels, strict=True)}
    if len(curves) > 1:
        figure.legend(curves.values(), curves, loc="outside upper center", ncols=len(curves), fontsize=8)


def _logarithmic(axes: Any) -> None:
    """Scale x logarithmically, with plain numbers at 1, 2, 5, 10, .."""
    from matplotlib.ticker import LogLocator, NullFormatter, ScalarFormatter

    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.xaxis.set_minor_formatter(NullFormatter())
