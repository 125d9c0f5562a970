"""Pictures of a map's films: thickness, hottest oil and contact of each gap over two inputs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.data.gap_names import TITLES
from swashfilm.runs.map.panels import even_panel, panel_figure
from swashfilm.runs.map.slices import Slice, held_words, main_slice
from system.inputs.units import Dimension, in_unit
from system.maps.data import MapData
from system.points.table.means import GAP_PAIRS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MEAN = "mean film [um]"


def film_pictures(data: MapData) -> dict[str, Figure]:
    """Return a picture of each quantity and gap on the main slice by caption; none for given films."""
    piece = main_slice(data)
    if piece is None:
        return {}
    quantities = _quantities(data, piece)
    if not _varies(quantities[MEAN]):
        return {}
    return {
        f"{TITLES[gap]}: {words} {held_words(data, piece)}".strip(): panel_figure(
            data, even_panel(data, f"{TITLES[gap]}: {words}", piece, field)
        )
        for words, fields in quantities.items()
        if _varies(fields)
        for gap, field in fields.items()
    }


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
