"""Pictures of a plan: suspects against each other, and the points over speed and pressure."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.figures import figure_of
from swashfilm.runs.plan.summary import hopeless
from system.inputs.shown import shown_in

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PLANNED, ADDED, NEVER = "#8fb9c5", "#b5523b", "#d4d4d4"
COLOURS = ["#f3c9b5", "#f8e6dc", "#b9d3da", "#6fa3b2", "#2f6678"]
"""Of distances: below half of the required one, below it, above, well above, far above."""
LETTERS, LETTER, LEGEND, NUMBERS = 9, 0.0082, 1.9, 1.1
"""Size of letters in points; width in inches of one by its size, and of the legend; height of numbers and legend."""
FEW = 12
"""Number of suspects up to which cells have numbers."""


def apart_plot(summary: Mapping[str, Any]) -> Figure:
    """Draw the distance of every two suspects: pale not separated, dark separated, grey never.

    Of more than `FEW` the columns have the numbers of the rows in place of names, and the legend is below.
    """
    from matplotlib.colors import BoundaryNorm, ListedColormap

    count, wanted = len(summary["suspects"]), summary["apart_sigma"]
    distances = np.array(summary["distances"])
    grey = hopeless(summary) | np.eye(count, dtype=bool)
    shown = np.ma.masked_where(grey, distances)
    many = count > FEW
    words = [f"{one['words']}  {at}" if many else one["words"] for at, one in enumerate(summary["suspects"], 1)]
    cells, named = max(0.45 * min(count, FEW), 0.19 * count), 0.3 + LETTER * LETTERS * max(map(len, words))
    wide, tall = (cells + named, cells + NUMBERS) if many else (cells + named + LEGEND, cells + named)
    figure = figure_of(wide, tall)
    axes = figure.subplots()
    edges = [0.0, 0.5 * wanted, wanted, 1.5 * wanted, 2.5 * wanted, 1e9]
    colours = ListedColormap(COLOURS).with_extremes(bad=NEVER)
    axes.imshow(shown, cmap=colours, norm=BoundaryNorm(edges, colours.N), interpolation="nearest")
    below = [str(at + 1) for at in range(count)] if many else words
    axes.set_xticks(range(count), below, rotation=90, fontsize=LETTERS)
    axes.set_yticks(range(count), words, fontsize=LETTERS)
    axes.set_facecolor(NEVER)
    axes.set_anchor("E" if many else "C")
    if not many:
        for one, other in zip(*np.nonzero(~np.eye(count, dtype=bool)), strict=True):
            dark = distances[one, other] > edges[3] and not grey[one, other]
            ink = "white" if dark else "black"
            text = f"{distances[one, other]:.1f}"
            axes.text(other, one, text, ha="center", va="center", fontsize=8, color=ink)
    _legend(axes, colours, wanted, below=many)
    return figure


def _legend(axes: Axes, colours: Any, wanted: float, below: bool) -> None:
    from matplotlib.patches import Patch

    half, more, far = 0.5 * wanted, 1.5 * wanted, 2.5 * wanted
    words = (
        f"below {half:.1f} sigma", f"to {wanted:.1f}: open", f"{wanted:.1f} to {more:.1f}: told apart",
        f"to {far:.1f}", f"above {far:.1f}",
    )  # fmt: skip
    handles = [Patch(color=colours(at), label=text) for at, text in enumerate(words)]
    handles.append(Patch(color=NEVER, label="never, by points"))
    place: dict[str, Any] = {"loc": "upper left", "bbox_to_anchor": (1.01, 1.0), "fontsize": 8}
    if below:
        place = {"loc": "upper right", "bbox_to_anchor": (1.0, -0.06), "ncols": 3, "fontsize": LETTERS}
    axes.legend(handles=handles, frameon=False, **place)


def points_plot(summary: Mapping[str, Any]) -> Figure:
    """Draw the points over speed and pressure, a panel for each displacement, planned and added ones."""
    ratios = sorted({round(one["displacement_ratio"], 3) for one in summary["points"]})
    groups = np.array_split(ratios, min(len(ratios), 3))
    figure = figure_of(4.2 * len(groups) + 0.4, 3.8)
    speed, pressure = shown_in("rad/s"), shown_in("Pa")
    panels = np.atleast_1d(figure.subplots(1, len(groups), sharey=True, sharex=True))
    for axes, own in zip(panels, groups, strict=True):
        for name, colour, marker in (("planned", PLANNED, "o"), ("added", ADDED, "D")):
            some = [
                one for one in summary["points"]
                if round(one["displacement_ratio"], 3) in own and bool(one["planned"]) is (name == "planned")
            ]  # fmt: skip
            if not some:
                continue
            x = speed.of(np.array([one["speed"] for one in some]))
            y = pressure.of(np.array([one["p_out"] for one in some]))
            warm = np.array([one["T_case"] for one in some])
            shift = 0.012 * (warm - 323.15) / 15.0 * float(speed.of(summary["box"]["speed"][1]))
            sizes = [45.0 * one["repeats"] for one in some]
            axes.scatter(x + shift, y, s=sizes, c=colour, marker=marker, label=name, alpha=0.85, edgecolors="white")
        ends = f"{own[0]:.2g}" if own[0] == own[-1] else f"{own[0]:.2g} to {own[-1]:.2g}"
        axes.set_title(f"displacement ratio {ends}", fontsize=10, loc="left")
        axes.set_xlabel(f"speed [{speed.unit}]")
        axes.grid(visible=True, alpha=0.3)
    panels[0].set_ylabel(f"delivery pressure [{pressure.unit}]")
    marks = {name: mark for axes in panels for mark, name in zip(*axes.get_legend_handles_labels(), strict=True)}
    figure.legend(marks.values(), marks.keys(), fontsize=8, loc="outside lower center", ncols=2, frameon=False)
    return figure
