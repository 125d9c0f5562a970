"""A film as a relief over its plane: height and colour show a selectable field at a selectable shaft angle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.touch.explorer import Control, Explorer, Pick
from swashfilm.output.touch.meshes import coarsened, triangles
from swashfilm.output.touch.packing import short
from swashfilm.output.touch.traces import scale_of

DIGITS = 4
PLACE = "<br>x [mm]: %{x:.4~g}<br>y [mm]: %{y:.4~g}"
MOST, NUMBERS = 1500, 30_000
"""Largest number of vertices, and of vertices times states; a finer mesh is thinned out."""
HEIGHT = 520  # pixels
LONG = 1.5
"""Length of the longer side of the film's plane in the view; the relief is as high as HIGH."""
HIGH = 0.6
CAMERA = {"eye": {"x": -1.1, "y": -2.0, "z": 1.3}, "center": {"x": 0.0, "y": 0.0, "z": -0.15}}


@dataclass(frozen=True)
class ReliefField:
    """A field of vertices over the states of the film (k, n), its title with the unit, its colours."""

    title: str
    values: Array
    colours: str = "viridis"


def relief(place: tuple[Array, Array], cells: Array, fields: Sequence[ReliefField], states: Sequence[str]) -> Explorer:
    """Return the film over its plane: vertices (k, n) x and y in mm, cells (c, 3 or 4), names of the k states."""
    import plotly.graph_objects as go

    count, first = len(states), fields[0]
    flat = np.stack([one[0] for one in place], axis=1)
    kept, corner = coarsened(flat, triangles(cells), min(MOST, NUMBERS // count))
    x, y = (short(one[:, kept], DIGITS) for one in place)
    trace = go.Mesh3d(
        x=x[0], y=y[0], i=corner[:, 0].tolist(), j=corner[:, 1].tolist(), k=corner[:, 2].tolist(),
        colorbar={"thickness": 12, "len": 0.8, "title": {"text": first.title, "side": "right"}},
        lighting={"ambient": 0.75, "diffuse": 0.4, "specular": 0.05},
    )  # fmt: skip
    ends = [_ends(one.values) for one in fields]
    tables = {
        "x": x, "y": y, "values": [row for one in fields for row in short(one.values[:, kept], DIGITS)],
        "titles": [one.title for one in fields], "scales": [_scale(one.colours) for one in fields],
        "ends": ends, "low": [low for low, _ in ends], "high": [high for _, high in ends],
        "hover": [f"{one.title}: %{{z:.4~g}}{PLACE}<extra></extra>" for one in fields],
    }  # fmt: skip
    which = list(range(len(fields)))
    by_field: list[tuple[tuple[str | int, ...], str]] = [
        (("data", 0, "colorbar", "title", "text"), "titles"), (("layout", "scene", "zaxis", "title", "text"), "titles"),
        (("layout", "scene", "zaxis", "range"), "ends"), (("data", 0, "cmin"), "low"), (("data", 0, "cmax"), "high"),
        (("data", 0, "colorscale"), "scales"), (("data", 0, "hovertemplate"), "hover"),
    ]  # fmt: skip
    picks = [Pick(path, table, (0,), which) for path, table in by_field]
    every = list(range(len(fields) * count))
    picks += [Pick(("data", 0, name), "values", (0, 1), every) for name in ("z", "intensity")]
    if any(np.ptp(one, axis=0).max() > 0.0 for one in place):
        picks += [Pick(("data", 0, name), name, (1,), list(range(count))) for name in "xy"]
    else:
        tables |= {"x": [], "y": []}
    controls = (Control("field", tables["titles"]), Control("shaft angle", states, _highest(first), slider=True))
    return Explorer(go.Figure(data=[trace], layout=_layout(place, first.title)), controls, picks, tables=tables)


def _highest(field: ReliefField) -> int:
    """Return the state at which a field has its largest value."""
    return int(np.argmax(np.nanmax(field.values, axis=1)))


def _ends(values: Array) -> list[float]:
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    room = 0.02 * (high - low) or 0.5 * abs(high) or 1.0
    return short([low - room, high + room], DIGITS)


def _scale(name: str) -> list[list[object]]:
    from matplotlib import colormaps

    return scale_of(colormaps[name])


def _layout(place: tuple[Array, Array], title: str) -> dict[str, object]:
    wide, deep = (float(np.ptp(one)) for one in place)
    longest = max(wide, deep)
    ratio = {"x": LONG * max(wide / longest, 0.3), "y": LONG * max(deep / longest, 0.3), "z": HIGH}
    titles = {"x": "x [mm]", "y": "y [mm]", "z": title}
    axes = {f"{name}axis": {"title": {"text": text}, "showbackground": False} for name, text in titles.items()}
    scene = {"aspectmode": "manual", "aspectratio": ratio, "camera": CAMERA}
    return {"height": HEIGHT, "margin": {"l": 0, "r": 0, "t": 0, "b": 0}, "scene": scene | axes, "uirevision": "kept"}
