"""Pictures of the paper's figures, one for each panel, and the verdicts on all statements."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.figures import figure_of
from system.paper.figure import FigureAxis, Panel, PanelKind, Unit
from system.paper.judge import StatementVerdict

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLOURS = ("#3c7a8c", "#b55a00", "#5b9a5b", "#b8862b", "#6d5a9c", "#8c5a3c", "#9aa4ab")
LEVELS = 12
"""Number of contour lines of a field."""
MANY = 6
"""Number of curves from which the legend is beside them."""
VERDICT_COLOURS = {
    StatementVerdict.REACHED: "#5b9a5b",
    StatementVerdict.MISSED: "#b8862b",
    StatementVerdict.CONTRADICTED: "#8c3c3c",
}


def panel_pictures(panels: Sequence[Panel]) -> dict[str, Figure]:
    """Return a picture of each panel of a figure by its title."""
    found = {}
    for panel in panels:
        figure = figure_of(5.4, 3.9)
        _draw(figure, figure.subplots(), panel)
        found[panel.title] = figure
    return found


def verdict_bars(counts: Mapping[str, Mapping[str, int]]) -> Figure:
    """Draw the number of statements with each verdict, a bar for each figure; `counts` by figure and verdict."""
    figure = figure_of(6.8, max(2.0, 0.28 * len(counts) + 0.9))
    axes, left = figure.subplots(), np.zeros(len(counts))
    for verdict, colour in VERDICT_COLOURS.items():
        widths = np.array([own.get(verdict.value, 0) for own in counts.values()], float)
        axes.barh([*counts], widths, left=left, color=colour, label=verdict.value)
        left += widths
    axes.invert_yaxis()
    axes.locator_params(axis="x", integer=True)
    axes.set_xlabel("statements, each reading counted")
    figure.legend(loc="outside upper center", ncols=len(VERDICT_COLOURS), fontsize=9)
    return figure


def _draw(figure: Any, axes: Any, panel: Panel) -> None:
    match panel.kind:
        case PanelKind.FIELD:
            _field(figure, axes, panel)
        case PanelKind.STACKED:
            _stacked(axes, panel)
        case PanelKind.BARS:
            _bars(axes, panel)
        case _:
            _lines(axes, panel)
    axes.set_title(panel.title, fontsize=9)
    if panel.x.words:
        axes.set_xlabel(_words(panel.x), fontsize=8)
    axes.set_ylabel(_words(panel.y), fontsize=8)
    axes.tick_params(labelsize=7)


def _lines(axes: Any, panel: Panel) -> None:
    few = max(curve.x.size for curve in panel.curves) < 10
    for k, curve in enumerate(panel.curves):
        marker, dashes = ("o" if few else ""), ("-" if k % 2 == 0 else "--")
        x, y = panel.x.unit.factor * curve.x, panel.y.unit.factor * curve.y
        sigma = None if curve.sigma is None else panel.y.unit.factor * curve.sigma
        axes.errorbar(x, y, sigma, fmt=dashes, marker=marker, markersize=3.0, linewidth=1.3, elinewidth=0.8,
                      capsize=2.0, color=COLOURS[k % len(COLOURS)], label=curve.name)  # fmt: skip
    axes.grid(visible=True, alpha=0.3)
    _legend(axes, panel)
    if panel.kind is PanelKind.LOGARITHMIC:
        axes.set_yscale("log")
    elif panel.kind is PanelKind.TRUE_SCALE:
        axes.set_aspect("equal", adjustable="datalim")
    elif min(float(curve.y.min()) for curve in panel.curves) >= 0.0:
        axes.set_ylim(0.0, 1.06 * panel.y.unit.factor * max(float(curve.y.max()) for curve in panel.curves))
    if panel.x.unit is Unit.ANGLE:
        axes.locator_params(axis="x", nbins=9)


def _legend(axes: Any, panel: Panel) -> None:
    """Draw the legend without covering data: beside many curves, under a locus."""
    if len(panel.curves) >= MANY:
        axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    elif panel.kind is PanelKind.TRUE_SCALE:
        axes.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=2)
    else:
        axes.legend(fontsize=7)


def _bars(axes: Any, panel: Panel) -> None:
    heights = [panel.y.unit.factor * float(curve.y[0]) for curve in panel.curves]
    drawn = axes.bar([curve.name for curve in panel.curves], heights, 0.5, color=COLOURS)
    axes.bar_label(drawn, fmt="{:.4g}" if max(heights) < 1e3 else "{:.0f}", fontsize=8)
    axes.margins(y=0.12)


def _stacked(axes: Any, panel: Panel) -> None:
    x = panel.x.unit.factor * panel.curves[0].x
    shares = [panel.y.unit.factor * curve.y for curve in panel.curves]
    axes.stackplot(x, shares, labels=[curve.name for curve in panel.curves], colors=COLOURS, alpha=0.9)
    axes.set(xlim=(float(x.min()), float(x.max())), ylim=(0.0, 100.0))
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))


def _field(figure: Any, axes: Any, panel: Panel) -> None:
    field = panel.field
    if field is None:
        raise ValueError(f"panel {panel.title}: found no field, expected one")
    x, y, values = (panel.x.unit.factor * field.x, panel.y.unit.factor * field.y, field.axis.unit.factor * field.values)
    filled = axes.contourf(x, y, values, LEVELS, cmap="viridis")
    lines = axes.contour(x, y, values, filled.levels, colors="white", linewidths=0.6)
    axes.clabel(lines, fontsize=7, fmt="%g")
    bar = figure.colorbar(filled, ax=axes)
    bar.set_label(_words(field.axis), fontsize=8)
    bar.ax.tick_params(labelsize=7)
    for mark in panel.curves:
        own_x, own_y = panel.x.unit.factor * mark.x, panel.y.unit.factor * mark.y
        axes.plot(own_x, own_y, "*", color="#b5002a", markersize=11, label=mark.name, clip_on=False)
    if panel.curves:
        axes.legend(fontsize=7, loc="lower right")
    if x.size * y.size < 100:
        axes.plot(*(one.ravel() for one in np.meshgrid(x, y)), ".", color="white", markersize=2.5)


def _words(axis: FigureAxis) -> str:
    return axis.words if axis.unit is Unit.NUMBER else f"{axis.words} [{axis.unit.shown}]"
