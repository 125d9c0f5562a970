"""Pictures of a comparison: efficiency of both maps and its difference, and the losses of both."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swashfilm.output.figures import figure_of
from swashfilm.runs.map.contour_levels import difference_levels, efficiency_levels
from swashfilm.runs.map.panels import LARGE, Panel, panel_figure
from swashfilm.runs.map.slices import Slice, further_slices, held_words, main_slice, shown
from system.maps.compare import MapComparison
from system.maps.data import LOSSES
from system.maps.definitions import HEADLINE

if TYPE_CHECKING:
    from matplotlib.figure import Figure

INK = "#55616a"
FIRST, FURTHER, BOTH, LOSS_BARS = "difference", "levels", "efficiency", "losses"
"""Names of the page's groups of pictures."""
Names = tuple[str, str]


def compare_pictures(found: MapComparison, names: Names) -> dict[str, dict[str, Figure]]:
    """Return the pictures of a comparison by group and caption; no empty group."""
    piece = main_slice(found.one)
    bars = {f"Mean losses of {names[0]} (A) and {names[1]} (B) over the common levels": _losses(found)}
    if piece is None:
        return {FIRST: bars}
    others = further_slices(found.one, piece)
    first = _difference_panel(found, piece, difference_levels(_difference(found, piece)))
    levels = difference_levels(np.concatenate([_difference(found, one).ravel() for one in others or (piece,)]))
    groups = {
        FIRST: {_caption(found, piece): panel_figure(found.one, first, LARGE)},
        FURTHER: {
            _caption(found, one): panel_figure(found.one, _difference_panel(found, one, levels)) for one in others
        },
        BOTH: _efficiencies(found, piece, names),
        LOSS_BARS: bars,
    }
    return {name: pictures for name, pictures in groups.items() if pictures}


def _caption(found: MapComparison, piece: Slice) -> str:
    where = held_words(found.one, piece)
    return f"Overall efficiency of B less that of A in percentage points{f', {where}' if where else ''}"


def _difference(found: MapComparison, piece: Slice) -> np.ndarray:
    one, other = (piece.of(data.efficiency(HEADLINE).overall) for data in (found.one, found.other))
    return np.asarray(shown(found.one, piece, 100.0 * (other - one)))


def _difference_panel(found: MapComparison, piece: Slice, levels: np.ndarray) -> Panel:
    one, other = (piece.of(data.efficiency(HEADLINE).overall) for data in (found.one, found.other))
    title = "B - A / percentage points"
    return Panel(title, piece, 100.0 * (other - one), levels, colours="RdBu", ink=INK)


def _efficiencies(found: MapComparison, piece: Slice, names: Names) -> dict[str, Figure]:
    fields = [100.0 * piece.of(data.efficiency(HEADLINE).overall) for data in (found.one, found.other)]
    levels = efficiency_levels(*(shown(found.one, piece, field) for field in fields))
    where = held_words(found.one, piece)
    return {
        f"{letter}, {name}: overall efficiency in % by ISO 4409{f', {where}' if where else ''}": panel_figure(
            found.one, Panel(f"{letter}: overall efficiency [%]", piece, field, levels, best=True)
        )
        for letter, name, field in zip("AB", names, fields, strict=True)
    }


def _losses(found: MapComparison) -> Figure:
    sinks = {
        words: [float(np.mean(data.values[column])) * 1e-3 for data in (found.one, found.other)]
        for column, words in LOSSES.items()
    }
    sinks = {words: pair for words, pair in sinks.items() if any(pair)}
    figure = figure_of(7.6, max(2.6, 0.36 * len(sinks)))
    axes, rows = figure.subplots(), np.arange(len(sinks))
    one, other = zip(*sinks.values(), strict=True)
    axes.barh(rows - 0.2, one, 0.38, color="#3c7a8c", label="A")
    axes.barh(rows + 0.2, other, 0.38, color="#8c5a3c", label="B")
    axes.set_yticks(rows, list(sinks))
    axes.invert_yaxis()
    axes.set_xlabel("mean loss [kW]")
    axes.legend()
    axes.grid(visible=True, axis="x", alpha=0.3)
    return figure
