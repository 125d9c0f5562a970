"""Contours of a field over a slice of a map: one panel as a picture of its own, or several in one figure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of
from swashfilm.output.touch.fields import GridField, keep_field
from swashfilm.runs.map.contour_levels import levels_of
from swashfilm.runs.map.slices import FINE, Slice, axis_label, grids, shown
from system.maps.data import MapData

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIDE_BY_SIDE = 3
SMALL, LARGE = (4.8, 3.4), (6.8, 4.0)
"""Sizes of a panel in inches: one of several, and one alone."""
POWERS = 6
"""Largest number of lines of constant power."""
POWER_INK = "#e8590c"


@dataclass(frozen=True)
class Panel:
    """A field to draw: title, slice, values on it, contour levels, and whether a star marks its largest value."""

    title: str
    piece: Slice
    field: Array
    levels: Array
    best: bool = False
    colours: str = "viridis"
    ink: str = "white"


def panel_figure(data: MapData, panel: Panel, size: tuple[float, float] = SMALL, powers: bool = False) -> Figure:
    """Return one panel as a figure, with lines of constant shaft power on request."""
    figure = figure_of(*size)
    axes = figure.subplots()
    draw_panel(axes, data, panel)
    if powers:
        _power_lines(axes, data, panel.piece)
    return figure


def panels_figure(data: MapData, panels: Sequence[Panel]) -> Figure | None:
    """Return panels in rows of three, none left empty; None without panels."""
    if not panels:
        return None
    rows, columns = -(-len(panels) // SIDE_BY_SIDE), min(SIDE_BY_SIDE, len(panels))
    figure = figure_of(3.7 * columns, 3.3 * rows)
    for k, panel in enumerate(panels):
        draw_panel(figure.add_subplot(rows, columns, k + 1), data, panel)
    return figure


def draw_panel(axes: Any, data: MapData, panel: Panel) -> None:
    """Draw the field with the map's interpolation: solved points, failed ones, lines, a colour bar."""
    from matplotlib.colors import BoundaryNorm

    field, levels = panel.field, panel.levels
    x, y = grids(data, panel.piece)
    between = shown(data, panel.piece, field)
    places = _fine(x, y) if np.all(np.isfinite(field)) else [x, y]
    painted = axes.contourf(*places, between, levels=levels, cmap=panel.colours, norm=BoundaryNorm(levels, 256))
    keep_field(painted, GridField(places[0][0], places[1][:, 0], between, levels))
    lines = axes.contour(*places, between, levels=levels, colors=panel.ink, linewidths=0.5)
    axes.clabel(lines, fontsize=8)
    axes.figure.colorbar(painted, ax=axes, ticks=levels).ax.tick_params(labelsize=8)
    good = np.isfinite(field)
    _mark(axes, x[good], y[good], ".", "#1c2328", 2.5)
    _mark(axes, x[~good], y[~good], "x", "#b55a00", 6.0)
    if panel.best and good.any():
        at = np.unravel_index(int(np.nanargmax(field)), field.shape)
        _mark(axes, x[at], y[at], "*", "#b55a00", 12.0)
    axes.set(xlabel=axis_label(data, panel.piece.across), ylabel=axis_label(data, panel.piece.up))
    axes.set_title(panel.title, fontsize=10)


def _power_lines(axes: Any, data: MapData, piece: Slice) -> None:
    """Draw dashed lines of constant shaft power with their value in kW."""
    from contourpy import contour_generator
    from matplotlib.ticker import MaxNLocator

    power = 1e-3 * piece.of(data.values["shaft_power"])
    x, y = grids(data, piece)
    whole = np.all(np.isfinite(power))
    levels = MaxNLocator(POWERS).tick_values(float(np.nanmin(power)), float(np.nanmax(power)))
    across, up = _fine(x, y) if whole else [x, y]
    curves = contour_generator(across, up, shown(data, piece, power), line_type="Separate")
    for level in levels:
        for line in cast("list[Array]", curves.lines(level)):
            axes.plot(*line.T, "--", color=POWER_INK, linewidth=1.0)
            middle = line[len(line) // 2]
            axes.text(*middle, f"{level:g} kW", color=POWER_INK, fontsize=8, ha="center", va="bottom", clip_on=True)


def _fine(x: Array, y: Array) -> list[Array]:
    return [*np.meshgrid(*(np.linspace(ends.min(), ends.max(), FINE) for ends in (x, y)))]


def _mark(axes: Any, x: Array, y: Array, sign: str, colour: str, size: float) -> None:
    """Draw marks unclipped, also on the frame, without changing the limits."""
    (drawn,) = axes.plot(x, y, sign, color=colour, markersize=size, clip_on=False)
    drawn.set_in_layout(False)


def even_panel(data: MapData, title: str, piece: Slice, field: Array) -> Panel:
    """Return a panel with equidistant contours."""
    return Panel(title, piece, field, levels_of(shown(data, piece, field)))
