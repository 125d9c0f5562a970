"""Pictures of recorded chamber pressures beside simulated ones, from the table of a diagnosis's run folder."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of
from swashfilm.output.tables import parted
from swashfilm.runs.diagnose.files import head_of
from system.inputs.shown import titled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Row = Mapping[str, str]
FITS = {
    "stated": ("#a274ad", "tolerances fitted to the traces alone"),
    "before": ("#b55a00", "fit without the finding"),
    "after": ("#3c7a8c", "fit with it"),
}
AGREED_FITS = {"stated": FITS["stated"], "before": ("#b55a00", "its fit")}
NOISE, WINDOW = "#9aa4ab", "#e8d9a0"
MOST_TRACES, AGREED_TRACES = 4, 2
QUARTERS = np.arange(0, 361, 90)


def trace_residuals(
    rows: Sequence[Row], window: Sequence[float] | None, settings: Mapping[str, str], claimed: bool = True
) -> Figure:
    """The traces that differ most before: recorded pressure, and recorded less simulated, on one scale.

    window: shaft angles in deg of the local mismatch; settings: by point, the text above it. Without a claim there
    is one fit.
    """
    points = worst_points(rows, MOST_TRACES if claimed else AGREED_TRACES)
    rows = [row for row in rows if row["point"] in points]
    unit = parted(head_of(rows[0], "measured"))[1]
    figure = figure_of(10.0, 0.8 + 1.9 * len(points))
    fits = FITS if claimed else AGREED_FITS
    most = max(float(np.max(np.abs(_residual(rows, key)))) for key in fits)
    grid = figure.subplots(len(points), 2, squeeze=False, sharex=True, sharey="col", width_ratios=(1, 2))
    for line, point in zip(grid, points, strict=True):
        own = [row for row in rows if row["point"] == point]
        angle, measured, sigma = (_column(own, key) for key in ("angle", "measured", "sigma"))
        line[0].plot(angle, measured, color="#1c2328", linewidth=1.0)
        line[0].set_ylabel(titled("chamber pressure", unit), fontsize=8)
        line[0].set_title(settings.get(point, ""), fontsize=8, loc="left")
        line[1].fill_between(
            angle, -2 * sigma, 2 * sigma, color=NOISE, alpha=0.35, linewidth=0, label="twice the scatter"
        )
        for key, (colour, label) in fits.items():
            line[1].plot(angle, _residual(own, key), color=colour, linewidth=1.2, label=label)
        line[1].set_ylabel(titled("measured - simulated", unit), fontsize=8)
        line[1].set_ylim(-1.1 * most, 1.1 * most)
        for axes in line:
            for start, end in _spans(window):
                axes.axvspan(start, end, color=WINDOW, alpha=0.5, zorder=0)
            axes.set(xlim=(0.0, 360.0), xticks=QUARTERS)
            axes.tick_params(labelsize=8)
            axes.grid(visible=True, alpha=0.3)
    grid[0, 1].legend(fontsize=8, ncols=4, loc="lower right", bbox_to_anchor=(1.0, 1.0), frameon=False)
    for axes in grid[-1]:
        axes.set_xlabel("shaft angle from the inner dead centre [deg]", fontsize=8)
    return figure


def _residual(rows: Sequence[Row], key: str) -> Array:
    """Measured minus predicted."""
    return _column(rows, "measured") - _column(rows, key)


def _spans(window: Sequence[float] | None) -> list[tuple[float, float]]:
    """The window between 0 and 360 deg, split at the inner dead centre."""
    if not window:
        return []
    start, end = window
    return [(start, end)] if start <= end else [(start, 360.0), (0.0, end)]


def worst_points(rows: Sequence[Row], most: int = MOST_TRACES) -> list[str]:
    """Points of the traces with the largest misfit before, in the order of the recording."""
    misfit: dict[str, float] = {}
    for row in rows:
        misfit[row["point"]] = misfit.get(row["point"], 0.0) + float(row["pull_before"]) ** 2
    worst = sorted(misfit, key=lambda point: -misfit[point])[:most]
    return sorted(worst, key=int)


def _column(rows: Sequence[Row], name: str) -> Array:
    head = head_of(rows[0], name)
    return np.array([float(row[head]) for row in rows])
