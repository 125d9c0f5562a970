"""Pictures of an optimisation: the Pareto set with start and chosen design, its growth, dimensions along it."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.figures import figure_of
from system.variation.measures import MEASURES

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SET, TRIED, MISSED, START, CHOSEN = "#3c7a8c", "#8fb9c5", "#d9d9d9", "#b5523b", "#1d2f36"
MOST_PANELS = 6


def pareto_plot(summary: Mapping[str, Any], data: xarray.Dataset) -> Figure:
    """Draw all designs over each pair of objectives, of one objective over the designs in their order."""
    names = [one["name"] for one in summary["objectives"]]
    if len(names) == 1:
        return _course_plot(summary, data, names[0])
    pairs = list(combinations(names, 2))[:MOST_PANELS]
    columns = min(len(pairs), 3)
    lines = -(-len(pairs) // columns)
    figure = figure_of(7.5 if len(pairs) == 1 else 4.2 * columns, 4.6 if len(pairs) == 1 else 3.8 * lines)
    panels = figure.subplots(lines, columns, squeeze=False).ravel()
    for axes, pair in zip(panels, pairs, strict=False):
        _pair(axes, summary, data, pair)
    for axes in panels[len(pairs) :]:
        axes.set_axis_off()
    panels[0].legend(fontsize=8)
    return figure


def growth_plot(summary: Mapping[str, Any]) -> Figure:
    """Draw the hypervolume of the Pareto set over the generations."""
    growth = 100.0 * np.array(summary["convergence"]["growth"])
    figure = figure_of(7.5, 2.6)
    axes = figure.subplots()
    axes.plot(np.arange(1, len(growth) + 1), growth, color=SET)
    axes.set_xlabel("generation")
    axes.set_ylabel("hypervolume / % of the last")
    axes.grid(visible=True, alpha=0.3)
    return figure


def dimension_plot(summary: Mapping[str, Any], data: xarray.Dataset) -> Figure:
    """Draw each dimension of the Pareto set, from 0 at its lower bound to 1, over the first objective."""
    own = data.isel(design=np.flatnonzero(data["pareto"].values))
    name = summary["objectives"][0]["name"]
    along = _shown(own["value"], name)
    figure = figure_of(7.5, 3.6)
    axes = figure.subplots()
    for one in summary["dimensions"]:
        values = own["dimension"].sel(key=one["name"]).values
        axes.scatter(along, (values - one["low"]) / (one["high"] - one["low"]), s=12, label=one["name"])
    axes.set_xlabel(_label(name))
    axes.set_ylabel("lower bound 0, upper 1")
    axes.grid(visible=True, alpha=0.3)
    axes.legend(fontsize=8)
    return figure


def _pair(axes: Axes, summary: Mapping[str, Any], data: xarray.Dataset, pair: tuple[str, str]) -> None:
    feasible, member = data["feasible"].values == 1, data["pareto"].values == 1
    x, y = (_shown(data["value"], name) for name in pair)
    solved = np.isfinite(x) & np.isfinite(y)
    rows = ((solved & ~feasible, MISSED, 6, "misses a constraint"), (feasible & ~member, TRIED, 8, "feasible"),
            (member, SET, 16, "Pareto set"))  # fmt: skip
    for chosen, colour, size, label in rows:
        if np.any(chosen):
            axes.scatter(x[chosen], y[chosen], s=size, color=colour, label=label)
    ends = [_place(summary, name) for name in pair]
    axes.scatter([ends[0][0]], [ends[1][0]], s=70, color=START, marker="s", label="start")
    label = "chosen" if summary["chosen"]["feasible"] else "nearest"
    axes.scatter([ends[0][1]], [ends[1][1]], s=90, color=CHOSEN, marker="D", label=label)
    _window(axes.set_xlim, x, solved, feasible, ends[0])
    _window(axes.set_ylim, y, solved, feasible, ends[1])
    axes.set_xlabel(_label(pair[0]))
    axes.set_ylabel(_label(pair[1]))
    axes.grid(visible=True, alpha=0.3)


def _window(
    limit: Any, values: np.ndarray, solved: np.ndarray, feasible: np.ndarray, ends: tuple[float, float]
) -> None:
    """Show all feasible designs, start and chosen one; of the others those that lie among them."""
    shown = np.concatenate([values[feasible if np.any(feasible) else solved], ends])
    room = 0.06 * float(np.ptp(shown)) or 1.0
    limit(shown.min() - room, shown.max() + room)


def _course_plot(summary: Mapping[str, Any], data: xarray.Dataset, name: str) -> Figure:
    """Draw one objective over the designs in their order."""
    feasible, values = data["feasible"].values == 1, _shown(data["value"], name)
    order = np.arange(1, len(values) + 1)
    solved = np.isfinite(values)
    figure = figure_of(7.5, 4.2)
    axes = figure.subplots()
    for chosen, colour, label in ((solved & ~feasible, MISSED, "misses a constraint"), (feasible, TRIED, "feasible")):
        if np.any(chosen):
            axes.scatter(order[chosen], values[chosen], s=10, color=colour, label=label)
    start, chosen_value = _place(summary, name)
    axes.axhline(start, color=START, linewidth=1.2, linestyle="--", label="start")
    if summary["chosen"]["design"] is not None:
        axes.scatter([summary["chosen"]["design"]], [chosen_value], s=90, color=CHOSEN, marker="D",
                     label="chosen" if summary["chosen"]["feasible"] else "nearest")  # fmt: skip
    axes.set_xlabel("design")
    axes.set_ylabel(_label(name))
    axes.grid(visible=True, alpha=0.3)
    axes.legend(fontsize=8)
    return figure


def _shown(values: xarray.DataArray, name: str) -> np.ndarray:
    return np.asarray(MEASURES[name].read(values.sel(measure=name).values))


def _place(summary: Mapping[str, Any], name: str) -> tuple[float, float]:
    """Return a measure of start and chosen design as people read it."""
    one = summary["measures"][name]
    start, chosen = (float(MEASURES[name].read(np.asarray(one[side]))) for side in ("start", "chosen"))
    return start, chosen


def _label(name: str) -> str:
    return f"{MEASURES[name].words} / {MEASURES[name].shown}"
