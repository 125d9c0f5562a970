"""Kept films of a gap over the turn, to choose field and shaft angle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swashfilm.output.touch.explorer import Explorer
from swashfilm.output.touch.relief import ReliefField, relief
from swashfilm.runs.film.revolution.plots import MAPPED, unit_of
from system.inputs.shown import titled

if TYPE_CHECKING:
    import xarray


def revolution_explorer(data: xarray.Dataset) -> Explorer:
    """Return the relief of film pressure, thickness and, where solved, temperature at the kept angles."""
    fields = []
    for name, (words, colours) in MAPPED.items():
        if name in data:
            how = unit_of(data, name)
            fields.append(ReliefField(titled(words, how.unit), how.of(data[name].values), colours))
    angles = [f"{angle:.0f} deg" for angle in np.degrees(data["film_angle"].values)]
    place = data["x"].values * 1e3, data["y"].values * 1e3
    return relief(place, data["cells"].values, fields, angles)
