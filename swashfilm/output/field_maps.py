"""Maps of a film's fields over its plane."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from swashfilm.output.touch.fields import keep_field, on_grid
from system.inputs.shown import shown_in, title_in

UNIFORM = 1e-9
"""Variation of a field, relative to its size, below which it is uniform."""


@dataclass(frozen=True)
class MapField:
    """A field on a page: its name, words and SI unit; drawn `always`, or only where it varies."""

    name: str
    words: str
    unit: str
    colours: str = "viridis"
    always: bool = False

    @property
    def title(self) -> str:
        """Words and unit."""
        return title_in(self.words, self.unit)

    def in_unit(self, values: np.ndarray) -> np.ndarray:
        """Return the values in the title's unit."""
        return np.asarray(shown_in(self.unit, self.words).of(values))


def draw_map(
    axes: Any,
    place: tuple[np.ndarray, np.ndarray],
    cells: np.ndarray,
    values: np.ndarray,
    title: str,
    labels: tuple[str, str] = ("x [mm]", "y [mm]"),
    colours: str = "viridis",
    limits: tuple[float, float] | None = None,
) -> Any:
    """Draw a field of vertices (smooth) or cells (flat) over `place` with a colour bar; texts name the units.

    `limits`: ends of the colour scale, by default those of the field. A uniform field has its value in the title in
    place of the bar. Returns the artist.
    """
    x, y = place
    uniform = bool(np.ptp(values) <= UNIFORM * np.max(np.abs(values)))
    drawn = paint(axes, place, cells, np.full_like(values, np.mean(values)) if uniform else values, colours, limits)
    axes.set(xlabel=labels[0], ylabel=labels[1], title=title)
    if labels == ("x [mm]", "y [mm]") and np.ptp(x) < 5.0 * np.ptp(y) and np.ptp(y) < 5.0 * np.ptp(x):
        axes.set_aspect("equal")
    if uniform and limits is None:
        axes.set_title(f"{title}: {float(np.mean(values)):.4g} everywhere")
    else:
        axes.figure.colorbar(drawn, ax=axes)
    return drawn


def paint(
    axes: Any,
    place: tuple[np.ndarray, np.ndarray],
    cells: np.ndarray,
    values: np.ndarray,
    colours: str,
    limits: tuple[float, float] | None = None,
) -> Any:
    """Draw the field alone, without axis titles and colour bar; return the artist."""
    from matplotlib.tri import Triangulation

    x, y = place
    quads = cells.shape[1] == 4
    triangles = np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]]) if quads else cells
    mesh = Triangulation(x, y, triangles)
    least, most = limits or (None, None)
    if len(values) == len(x):
        drawn = axes.tripcolor(mesh, values, shading="gouraud", cmap=colours, vmin=least, vmax=most)
    else:
        values = np.tile(values, 2 if quads else 1)
        drawn = axes.tripcolor(mesh, facecolors=values, cmap=colours, vmin=least, vmax=most)
    keep_field(drawn, on_grid(mesh, values))
    return drawn
