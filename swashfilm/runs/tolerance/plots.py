"""Pictures of a tolerance: the distributions of a series, and the shares of its dimensions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.figures import figure_of
from swashfilm.runs.tolerance.rows import LEAST_SHARE, dearest
from system.variation.measures import DRAIN, EFFICIENCY, LOSS, MEASURES

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOUR, ALONE, LIMIT = "#3c7a8c", "#8fb9c5", "#b5523b"
SHOWN = (EFFICIENCY, DRAIN, LOSS)
MOST = 12
"""Bars of a panel."""


def scatter_plot(summary: Mapping[str, Any], data: xarray.Dataset) -> Figure:
    """Draw histograms of efficiency, case drain and loss of the series, with 5, 50, 95 % and the stated limits."""
    figure = figure_of(11.0, 3.4)
    for axes, name in zip(figure.subplots(1, len(SHOWN)), SHOWN, strict=True):
        measure = MEASURES[name]
        values = data["value"].sel(measure=name).values * measure.scale
        axes.hist(values, bins=min(60, max(10, len(values) // 25)), color=ALONE)
        for quantile in summary["measures"][name]["quantiles"]:
            axes.axvline(quantile["value"] * measure.scale, color=COLOUR, linewidth=1.2)
        for limit in summary["limits"]:
            if limit["measure"] == name:
                axes.axvline(limit["value"] * measure.scale, color=LIMIT, linewidth=1.6, linestyle="--")
        axes.set_xlabel(f"{measure.words} / {measure.shown}")
        axes.set_ylabel("pumps" if name == SHOWN[0] else "")
    return figure


def share_plot(summary: Mapping[str, Any]) -> Figure:
    """Draw the total and the first share of the dimensions in efficiency, case drain and loss."""
    rows = {name: _shown(summary, name) for name in SHOWN}
    height = max(len(own) for own in rows.values())
    figure = figure_of(12.0, 0.3 * height + 1.2)
    for axes, (name, own) in zip(figure.subplots(1, len(SHOWN)), rows.items(), strict=True):
        _bars(axes, own)
        axes.set_title(MEASURES[name].words, fontsize=10, loc="left")
    return figure


def _shown(summary: Mapping[str, Any], name: str) -> list[Mapping[str, Any]]:
    return [one for one in dearest(summary, name) if one["total"]["value"] >= LEAST_SHARE][:MOST]


def _bars(axes: Axes, rows: list[Mapping[str, Any]]) -> None:
    places = np.arange(len(rows))
    total = np.array([100.0 * one["total"]["value"] for one in rows])
    first = [100.0 * one["first"]["value"] for one in rows]
    ends = 100.0 * np.array([(one["total"]["low"], one["total"]["high"]) for one in rows]).reshape(-1, 2)
    axes.barh(places, total, color=ALONE, xerr=np.abs(ends.T - total), ecolor="#666666", label="with interactions")
    axes.barh(places, first, height=0.4, color=COLOUR, label="alone")
    axes.set_yticks(places, ["\n".join(one["names"]) for one in rows], fontsize=8)
    axes.invert_yaxis()
    axes.set_xlabel("share of the variance [%]")
    axes.grid(visible=True, axis="x", alpha=0.3)
    axes.legend(fontsize=8, loc="lower right")
