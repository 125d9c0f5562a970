"""Pictures of two maps side by side: where one is better, and what takes the difference."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swashfilm.output.figures import figure_of
from swashfilm.runs.map.plots import (
    Slice,
    contours,
    difference_levels,
    efficiency_levels,
    held_words,
    shown,
    slice_of,
)
from system.maps.compare import Comparison
from system.maps.data import LOSSES
from system.maps.plan import MapInput
from system.pump.efficiency import EfficiencyDefinition

if TYPE_CHECKING:
    from matplotlib.figure import Figure

INK = "#55616a"
SHOWN = (EfficiencyDefinition.PAPER, EfficiencyDefinition.ENERGY_RETURNED)


def compare_plots(found: Comparison) -> dict[str, Figure]:
    """Captions and PNGs of a comparison."""
    pictures = {}
    for up in (MapInput.RATIO, MapInput.SPEED):
        piece = slice_of(found.one, MapInput.PRESSURE, up)
        if piece is not None:
            where = held_words(found.one, piece)
            pictures[f"Overall efficiency of A and B in %, and B - A in percentage points, {where}"] = _slices(
                found, piece
            )
    pictures["Mean power of every loss over the common levels"] = _losses(found)
    return pictures


def _slices(found: Comparison, piece: Slice) -> Figure:
    figure = figure_of(11.0, 6.8)
    panels = figure.subplots(len(SHOWN), 3)
    for row, definition in zip(panels, SHOWN, strict=True):
        one, other = (100.0 * piece.of(data.efficiency(definition).overall) for data in (found.one, found.other))
        levels = efficiency_levels(*(shown(found.one, piece, field) for field in (one, other)))
        for axes, field, words in zip(row, (one, other), "AB", strict=False):
            contours(axes, found.one, piece, field, levels)
            axes.set_title(f"{words} / %: {definition.label}", fontsize=8)
        apart = other - one
        levels = difference_levels(shown(found.one, piece, apart))
        contours(row[-1], found.one, piece, apart, levels, colours="RdBu", ink=INK)
        row[-1].set_title(f"B - A / percentage points: {definition.label}", fontsize=8)
    return figure


def _losses(found: Comparison) -> Figure:
    sinks = {
        words: [float(np.mean(data.values[column])) * 1e-3 for data in (found.one, found.other)]
        for column, words in LOSSES.items()
    }
    sinks = {words: pair for words, pair in sinks.items() if any(pair)}
    figure = figure_of(9.0, max(2.6, 0.4 * len(sinks)))
    axes, rows = figure.subplots(), np.arange(len(sinks))
    one, other = zip(*sinks.values(), strict=True)
    axes.barh(rows - 0.2, one, 0.38, color="#3c7a8c", label="A")
    axes.barh(rows + 0.2, other, 0.38, color="#8c5a3c", label="B")
    axes.set_yticks(rows, list(sinks))
    axes.invert_yaxis()
    axes.set_xlabel("mean loss / kW")
    axes.legend()
    axes.grid(visible=True, axis="x", alpha=0.3)
    return figure
