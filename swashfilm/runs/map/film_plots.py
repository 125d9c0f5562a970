"""Pictures of a map's films: thickness, hottest oil and contact of each gap over two inputs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of
from swashfilm.output.gap_names import TITLES
from swashfilm.runs.map.plots import Slice, contours, held_words, levels_of, shown, slice_of
from system.inputs.units import Dimension, in_unit
from system.maps.data import MapData
from system.maps.plan import MapInput
from system.points.table.means import GAP_PAIRS

if TYPE_CHECKING:
    from matplotlib.figure import Figure


MEAN = "mean film [um]"


def film_plots(data: MapData) -> dict[str, Figure]:
    """Return the pictures of the films by caption, over pressure and speed and over pressure and displacement."""
    found = {}
    for up in (MapInput.SPEED, MapInput.RATIO):
        piece = slice_of(data, MapInput.PRESSURE, up)
        if piece is not None and (drawn := film_plot(data, piece)) is not None:
            found[f"Films of the gaps {held_words(data, piece)}"] = drawn
    return found


def film_plot(data: MapData, piece: Slice) -> Figure | None:
    """Draw a row for each quantity that varies on the slice, a panel for each gap; None where films are given."""
    found = _quantities(data, piece)
    if not _varies(found[MEAN]):
        return None
    rows = [(words, fields) for words, fields in found.items() if _varies(fields)]
    figure = figure_of(11.0, 3.2 * len(rows))
    panels = figure.subplots(len(rows), len(GAP_PAIRS), squeeze=False)
    for own, (words, fields) in zip(panels, rows, strict=True):
        for axes, (gap, field) in zip(own, fields.items(), strict=True):
            contours(axes, data, piece, field, levels_of(shown(data, piece, field)))
            axes.set_title(f"{TITLES[gap]}: {words}", fontsize=9)
    return figure


def _quantities(data: MapData, piece: Slice) -> dict[str, dict[str, Array]]:
    """Return the fields on a slice by quantity and gap, in the units of their names."""
    values = data.values
    return {
        MEAN: {gap: 1e6 * piece.of(values[f"film_mean.{gap}"]) for gap in GAP_PAIRS},
        "least film [um]": {gap: 1e6 * piece.of(values[f"film_least.{gap}"]) for gap in GAP_PAIRS},
        "hottest oil [degC]": {gap: _celsius(piece.of(values[f"film_temperature.{gap}"])) for gap in GAP_PAIRS},
        "contact [W]": {
            gap: piece.of(values[f"pair_loss_coulomb.{pair.value}"]) for gap, pair in GAP_PAIRS.items()
        },
    }  # fmt: skip


def _celsius(kelvin: Array) -> Array:
    """Return temperatures in degC."""
    return kelvin + in_unit(0.0, "degC", Dimension.TEMPERATURE)


def _varies(fields: dict[str, Array]) -> bool:
    return any(np.nanmax(field) - np.nanmin(field) > 1e-9 * np.nanmax(np.abs(field)) for field in fields.values())
