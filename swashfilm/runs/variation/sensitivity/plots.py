"""Pictures of a sensitivity: the cost of one micrometre, one degree and one per cent."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from swashfilm.output.figures import figure_of
from swashfilm.runs.variation.sensitivity.rows import Row, cost, kind_of, ranked
from system.variation.measures import EFFICIENCY, LOSS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MORE, LESS = "#b5523b", "#3c7a8c"
MOST, LEAST = 14, 0.005
"""Bars of a panel at most, and the shortest, of the longest."""
PANELS = {"1 um": "lengths: +1 um", "1 deg": "angles: +1 deg", "1 %": "all others: +1 %"}


def cost_plot(summary: Mapping[str, Any]) -> Figure | None:
    """Draw the loss in W and the efficiency in points by one um, one deg and one per cent, the costliest first.

    None where no dimension has a cost.
    """
    kinds = [kind for kind in PANELS if _shown(summary, kind)]
    if not kinds:
        return None
    counts = [len(_shown(summary, kind)) for kind in kinds]
    figure = figure_of(10.0, 0.28 * sum(counts) + 1.1 * len(kinds))
    panels = figure.subplots(len(kinds), 2, squeeze=False, height_ratios=[count + 1 for count in counts])
    for (left, right), kind in zip(panels, kinds, strict=True):
        rows = _shown(summary, kind)
        _bars(left, rows, LOSS, 1.0)
        _bars(right, rows, EFFICIENCY, 100.0)
        left.set_title(PANELS[kind], loc="left", fontsize=10)
        right.set_yticklabels([])
        left.set_xlabel("change of the loss [W]")
        right.set_xlabel("change of the overall efficiency / points")
    return figure


def tolerance_plot(summary: Mapping[str, Any]) -> Figure | None:
    """Draw the loss by one standard deviation of each dimension's tolerance; None where no tolerance is stated."""
    rows = [row for row in ranked(summary) if row["sigma"] is not None]
    if not rows:
        return None
    rows = sorted(rows, key=lambda row: -abs(cost(row, LOSS, "sigma")))[:MOST]
    figure = figure_of(10.0, 0.28 * len(rows) + 1.0)
    axes = figure.subplots()
    _bars(axes, rows, LOSS, 1.0, "sigma", [f"{row['key']}, {row['sigma_text']}" for row in rows])
    axes.set_xlabel("change of the loss [W]")
    return figure


def _shown(summary: Mapping[str, Any], kind: str) -> list[Row]:
    """Return the costliest dimensions of a kind, without those whose bar would not be visible."""
    rows = ranked(summary, kind)[:MOST]
    return [row for row in rows if abs(cost(row, LOSS)) >= LEAST * abs(cost(rows[0], LOSS))]


def _bars(
    axes: Axes, rows: list[Row], measure: str, scale: float, by: str = "change", names: list[str] | None = None
) -> None:
    """Draw changes as bars: those that lose more red."""
    values = [scale * cost(row, measure, by) for row in rows]
    dearer = [value > 0.0 if measure == LOSS else value < 0.0 for value in values]
    axes.barh(range(len(rows)), values, color=[MORE if more else LESS for more in dearer])
    axes.set_yticks(range(len(rows)), names or [_name(row) for row in rows], fontsize=8)
    axes.invert_yaxis()
    axes.axvline(0.0, color="#888888", linewidth=0.8)
    axes.grid(visible=True, axis="x", alpha=0.3)


def _name(row: Row) -> str:
    """Return a dimension with its value, and with its change where that is not the one of its kind."""
    exact = row["change_text"] if kind_of(row) == "1 %" and row["change_text"] != "1 %" else ""
    return f"{row['key']} = {row['text']}" + (f", +{exact}" if exact else "")
