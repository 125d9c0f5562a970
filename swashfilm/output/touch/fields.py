"""Fields behind the areas of a static picture, kept with its artist so that hovering shows their values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array

POINTS = 72
"""Number of points along the longer side of a resampled field."""


@dataclass(frozen=True)
class GridField:
    """Values (m, n) over x (n,) and y (m,); drawn between `levels`."""

    x: Array
    y: Array
    values: Array
    levels: Array | None = None


_FIELD = "_swashfilm_field"


def keep_field(artist: Any, field: GridField) -> None:
    """Keep the field that an artist shows."""
    setattr(artist, _FIELD, field)


def kept_field(artist: Any) -> GridField | None:
    """Return the field that an artist shows, if it was kept."""
    found: GridField | None = getattr(artist, _FIELD, None)
    return found


def on_grid(mesh: Any, values: Array) -> GridField:
    """Return a field of the vertices or triangles of a matplotlib Triangulation on a regular grid, nan outside."""
    from matplotlib.tri import LinearTriInterpolator

    ends = [(float(one.min()), float(one.max())) for one in (mesh.x, mesh.y)]
    inset = [1e-6 * (high - low) for low, high in ends]  # points on the edge may count as outside
    x, y = (np.linspace(low + gap, high - gap, POINTS) for (low, high), gap in zip(ends, inset, strict=True))
    places = np.meshgrid(x, y)
    if len(values) == len(mesh.x):
        found = np.ma.filled(LinearTriInterpolator(mesh, values)(*places), np.nan)
    else:
        cell = mesh.get_trifinder()(*places)
        found = np.where(cell >= 0, np.asarray(values)[cell], np.nan)
    return GridField(x, y, found)
