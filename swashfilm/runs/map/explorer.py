"""A selectable slice of a map's numbers: quantity, two axes, and the level of every other axis."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.data.files import CSV_DIGITS
from swashfilm.output.data.gap_names import TITLES
from swashfilm.output.touch.explorer import Control, Explorer
from swashfilm.output.touch.packing import short
from swashfilm.output.touch.traces import scale_of
from swashfilm.runs.map.files import PARTS
from swashfilm.runs.map.plots import shared_fields
from system.inputs.shown import shown_in, title_in, titled
from system.maps.data import MapData
from system.maps.definitions import HEADLINE
from system.maps.interpolation import weights
from system.maps.plan import MapAxis, MapInput, reading_levels
from system.pump.efficiency import EfficiencyDefinition

FINE = 41
"""Points along an axis of the interpolated field."""
HEIGHT = 520  # pixels
ACROSS = (MapInput.SPEED, MapInput.PRESSURE)
"""Axes of the first slice, as far as they have several levels."""
NUMBERS = {
    "delivery_flow": ("delivery flow [L/min]", 6e4), "drain_flow": ("case drain flow [L/min]", 6e4),
    "shaft_torque": ("shaft torque [N m]", 1.0), "shaft_power": ("shaft power [kW]", 1e-3),
}  # fmt: skip
"""Numbers of the pump, their titles and factors from SI."""
OF_GAPS = {
    "leakage_flow": ("leakage [L/min]", 6e4, 0.0), "film_mean": ("mean film [um]", 1e6, 0.0),
    "film_least": ("least film [um]", 1e6, 0.0), "film_temperature": ("hottest oil [degC]", 1.0, 273.15),
}  # fmt: skip
"""Numbers of each gap, their titles, factors and zeros from SI."""


def map_explorer(data: MapData) -> Explorer | None:
    """Return the explorer of a map; None where fewer than two axes have several levels.

    A slice without failed points is drawn with the map's own interpolation; solved points have their own numbers.
    """
    import plotly.graph_objects as go

    several = [k for k, axis in enumerate(data.axes) if len(axis.values) > 1]
    if len(several) < 2:
        return None
    wanted = [k for given in ACROSS for k in several if data.axes[k].input is given]
    first = (*wanted, *(k for k in several if k not in wanted))[:2]
    pairs = sorted(permutations(several, 2), key=lambda pair: pair != first)
    quantities = [
        {"title": title, "values": short(values.ravel(), CSV_DIGITS)}
        for title, values in _quantities(data)
        if np.isfinite(values).any()
    ]
    axes = [_axis(axis) for axis in data.axes]
    names = [" over ".join(data.axes[k].input.words for k in pair[::-1]) for pair in pairs]
    controls = [Control("quantity", [one["title"] for one in quantities]), Control("axes", names)]
    controls += [
        Control(axis.input.words, [axis.input.text(value) for value in axis.values], _first(axis), slider=True)
        for axis in data.axes
    ]
    figure = go.Figure(data=_traces(), layout=_layout())
    grid = {"axes": axes, "quantities": quantities, "pairs": pairs}
    return Explorer(figure, controls, grid=grid)


def _first(axis: MapAxis) -> int:
    """Return the level that is shown first: the largest one, of conditions the first one."""
    return 0 if axis.input in (MapInput.TEMPERATURE, MapInput.INLET_PRESSURE) else len(axis.values) - 1


def _quantities(data: MapData) -> Iterator[tuple[str, Array]]:
    """Yield (title with unit, values over the axes)."""
    for part in PARTS:
        fields = {one: getattr(data.efficiency(one), part) for one in (HEADLINE, *EfficiencyDefinition)}
        for shared in shared_fields(fields):
            yield f"{part} efficiency [%], {shared.definitions[0].label}", 100.0 * shared.field
    yield "loss (shaft power less p Q) [kW]", 1e-3 * data.loss
    for words, loss in data.losses.items():
        yield f"{words} [W]", loss
    for name, (title, factor) in NUMBERS.items():
        yield title, factor * data.values[name]
    yield title_in("highest chamber pressure", "Pa"), shown_in("Pa").of(data.values["chamber_pressure_peak"])
    for name, (title, factor, zero) in OF_GAPS.items():
        for gap, words in TITLES.items():
            yield f"{words}: {title}", factor * (data.values[f"{name}.{gap}"] - zero)


def _axis(axis: MapAxis) -> dict[str, Any]:
    """Return title, levels, and points between them with their weights of the levels' values."""
    levels = reading_levels(axis)
    fine = np.linspace(axis.values[0], axis.values[-1], FINE if len(axis.values) > 1 else 1)
    return {
        "title": titled(axis.input.words, axis.input.shown.unit),
        "levels": short(levels),
        "fine": short(np.linspace(levels[0], levels[-1], len(fine))),
        "weights": short(weights(axis, fine)),
    }


def _traces() -> list[dict[str, Any]]:
    from matplotlib import colormaps

    labels = {"coloring": "heatmap", "showlabels": True, "labelfont": {"size": 11, "color": "white"}}
    field = {
        "type": "contour", "ncontours": 14, "contours": labels, "line": {"color": "white", "width": 0.5},
        "colorscale": scale_of(colormaps["viridis"]), "colorbar": {"thickness": 12, "title": {"side": "right"}},
    }  # fmt: skip
    marker = {"size": 6, "color": "white", "line": {"color": "#1c2328", "width": 1}}
    return [field, {"type": "scatter", "mode": "markers", "marker": marker, "showlegend": False, "cliponaxis": False}]


def _layout() -> dict[str, Any]:
    axis = {"ticks": "outside", "showline": True, "zeroline": False, "title": {"text": ""}, "automargin": True}
    return {
        "height": HEIGHT, "margin": {"l": 50, "r": 20, "t": 16, "b": 50}, "xaxis": axis, "yaxis": axis,
        "hovermode": "closest", "uirevision": "kept",
    }  # fmt: skip
