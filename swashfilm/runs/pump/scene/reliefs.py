"""Films of a pump's gaps at given positions over the turn, with selectable field and shaft angle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swashfilm.output.touch.explorer import Explorer
from swashfilm.output.touch.relief import ReliefField, relief
from swashfilm.runs.pump.plots import GAP_FIELDS

if TYPE_CHECKING:
    import xarray


def gap_explorer(data: xarray.Dataset, gap: str) -> Explorer:
    """Return the relief of the fields of a gap that the data set has, at all its angles."""
    fields = [
        ReliefField(field.title, field.in_unit(data[f"{gap}_{field.name}"].values), field.colours)
        for field in GAP_FIELDS
        if f"{gap}_{field.name}" in data
    ]
    angles = [f"{angle:.0f} deg" for angle in np.degrees(data[f"{gap}_angle"].values)]
    place = data[f"{gap}_x"].values * 1e3, data[f"{gap}_y"].values * 1e3
    return relief(place, data[f"{gap}_cells"].values, fields, angles)
