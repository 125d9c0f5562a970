"""The pump in space, rotatable with the mouse: films in the colours of a field between translucent solids.

Solids move as rigid bodies, so that a page holds each of them once with its motions; films are kept at every angle.
"""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.scenes.field_maps import MapField
from swashfilm.output.touch.explorer import Control, Copies, Explorer, Move, Pick
from swashfilm.output.touch.meshes import coarsened, triangles
from swashfilm.output.touch.packing import short
from swashfilm.output.touch.traces import scale_of
from swashfilm.runs.pump.data import PICTURED_TURN
from swashfilm.runs.pump.scene.blocks import OIL, PUMP, nearest
from swashfilm.runs.pump.scene.surfaces import TURN
from swashfilm.runs.pump.scene.views import FILM, LOOKS, part_of

MM = 1e3
PLACE_DECIMALS = 2  # of mm
DIGITS = 3  # of fields
MOST, NUMBERS = 1000, 42_000
"""Largest number of vertices of a film, and of those of all kept films; finer meshes are thinned out."""
BEYOND = 0.02
"""Share of the vertices whose values may lie above the scale."""
RIGID = 2e-5
"""Largest departure of a body from a rigid motion, m: the single precision of its file, which is not visible."""
CAMERA = {"eye": {"x": 0.3, "y": -1.0, "z": 0.42}, "projection": {"type": "orthographic"}}
HEIGHT = 620  # pixels
INK = "#1c2328"
"""Colour that the page replaces by that of its own text."""
ABOVE = 0.2
"""Height of a chamber's number above the middle of its slipper's film, in radii of the film."""


FIELDS = (
    MapField("film_pressure [Pa]", "film pressure", "Pa"),
    MapField("film_thickness [m]", "film thickness", "m", colours="cividis"),
    MapField("film_temperature [K]", "film temperature", "K", colours="inferno"),
)
"""Fields of the films' files, by their heads there."""


@dataclass
class _View:
    """Parts of the explorer while it is built."""

    traces: list[Any] = field(default_factory=list)
    picks: list[Pick] = field(default_factory=list)
    moves: list[Move] = field(default_factory=list)
    copies: list[Copies] = field(default_factory=list)
    tables: dict[str, Any] = field(default_factory=dict)


Blocks = Sequence[dict[str, str]]
"""File of each named block, for each shaft angle."""


def pump_view(folder: Path) -> Explorer | None:
    """Return the view of a run folder with the pump's blocks (`write_pump`); None without one."""
    import plotly.graph_objects as go

    lists = sorted((folder / PUMP).glob("pump_*.vtm"))
    if not lists:
        return None
    degrees, blocks = zip(*(_read_list(path) for path in lists), strict=True)
    view = _View()
    solids = [name for name in blocks[0] if not name.endswith(FILM) and name != OIL]
    films = [name for name in blocks[0] if name.endswith(FILM)]
    fields = _films(view, folder, blocks, films)
    for part, names in _alike(blocks[0], solids).items():
        _solid(view, folder, blocks, part[0], names)
    _numbers(view, folder, blocks, [name for name in films if part_of(name) == "slipper"])
    controls = (
        Control("colour", [one.title for one in fields]),
        Control("shaft angle", [f"{angle:.0f} deg" for angle in degrees], _pictured(degrees), slider=True),
    )
    scene = {"aspectmode": "data", "camera": CAMERA} | {f"{name}axis": {"visible": False} for name in "xyz"}
    layout = {"height": HEIGHT, "margin": {"l": 0, "r": 0, "t": 0, "b": 0}, "scene": scene, "uirevision": "kept"}
    figure = go.Figure(data=view.traces, layout=layout)
    return Explorer(figure, controls, view.picks, view.moves, view.copies, view.tables)


def _pictured(degrees: Sequence[float]) -> int:
    """Return the number of the angle that the static picture has."""
    return nearest(np.radians(degrees), TURN, TURN * PICTURED_TURN)


def _read_list(path: Path) -> tuple[float, dict[str, str]]:
    """Return shaft angle (deg) and the file of each named block in the run folder."""
    root = ElementTree.parse(path).getroot()
    angle = root.find(".//FieldData/DataArray")
    degrees = float(angle.text or 0.0) if angle is not None else 0.0
    return degrees, {one.attrib["name"]: one.attrib["file"].removeprefix("../") for one in root.iter("DataSet")}


def _alike(files: dict[str, str], names: Sequence[str]) -> dict[tuple[str, str], list[str]]:
    """Return names of blocks by part and folder: those of a kind have one shape."""
    found: dict[tuple[str, str], list[str]] = {}
    for name in names:
        found.setdefault((part_of(name), str(Path(files[name]).parent)), []).append(name)
    return found


def _mesh(folder: Path, file: str) -> Any:
    import meshio

    return meshio.read(folder / file)


def _rows(blocks: Blocks, names: Sequence[str]) -> tuple[list[str], list[list[int]]]:
    """Return the files of these blocks, and their numbers for each angle."""
    files = sorted({one[name] for one in blocks for name in names})
    number = {file: k for k, file in enumerate(files)}
    return files, [[number[one[name]] for name in names] for one in blocks]


def _corners(mesh: Any) -> np.ndarray:
    """Return the triangles (n, 3) of a mesh."""
    return np.concatenate([triangles(cells.data) for cells in mesh.cells])


def _lists(corners: np.ndarray) -> dict[str, list[int]]:
    """Return triangles as plotly's three lists."""
    return {name: column.tolist() for name, column in zip("ijk", corners.T, strict=True)}


def _solid(view: _View, folder: Path, blocks: Blocks, part: str, names: Sequence[str]) -> None:
    """Add bodies of one shape as a translucent mesh."""
    import plotly.graph_objects as go

    files, rows = _rows(blocks, names)
    meshes = [_mesh(folder, file) for file in files]
    colour, opacity = LOOKS[part]
    at = len(view.traces)
    view.copies.append(Copies(at, len(names), len(meshes[0].points)))
    _place(view, [one.points.astype(float) * MM for one in meshes], f"place {at}", rows)
    view.traces.append(
        go.Mesh3d(
            **_lists(_corners(meshes[0])), color=colour, opacity=opacity, hoverinfo="skip", flatshading=True, name=part,
        )
    )  # fmt: skip


def _numbers(view: _View, folder: Path, blocks: Blocks, slippers: Sequence[str]) -> None:
    """Add the numbers of the chambers, each in the middle of its slipper's film and just above it."""
    import plotly.graph_objects as go

    files, rows = _rows(blocks, slippers)
    points = [_mesh(folder, file).points.astype(float) * MM for file in files]
    middles = np.array([one.mean(axis=0) for one in points])
    middles[:, 2] += ABOVE * float(np.linalg.norm(points[0] - points[0].mean(axis=0), axis=1).max())
    at = len(view.traces)
    for letter, places in zip("xyz", np.round(middles.T, PLACE_DECIMALS), strict=True):
        view.tables[f"numbers {letter}"] = [places[row].tolist() for row in rows]
    view.picks += [Pick(("data", at, letter), f"numbers {letter}", (1,), list(range(len(rows)))) for letter in "xyz"]
    numbers = [name.removesuffix(FILM).split()[-1] for name in slippers]
    look = {"size": 15, "color": INK}
    view.traces.append(
        go.Scatter3d(
            x=[], y=[], z=[], mode="text", text=numbers, textfont=look, textposition="middle center", hoverinfo="skip",
            showlegend=False, name="chambers",
        )
    )  # fmt: skip


def _place(view: _View, places: Sequence[Array], table: str, rows: list[list[int]]) -> None:
    """Add the places (n, 3) mm of the next trace's bodies, as motions of the first one where all are rigid."""
    at = len(view.traces)
    motions = [motion(places[0], one) for one in places]
    if all(one is not None for one in motions):
        view.tables[table] = [np.round(one, 6).tolist() for one in motions if one is not None]
        view.moves.append(Move(at, np.round(places[0], PLACE_DECIMALS).tolist(), table, (1,), rows))
        return
    for k, letter in enumerate("xyz"):
        view.tables[f"{table} {letter}"] = [np.round(one[:, k], PLACE_DECIMALS).tolist() for one in places]
        view.picks.append(Pick(("data", at, letter), f"{table} {letter}", (1,), rows))


def motion(start: Array, end: Array) -> Array | None:
    """Return the rigid motion [R | t] (3, 4) of points (n, 3) mm, by Kabsch's method; None if not rigid.

    Source: Kabsch, Acta Crystallographica A32 (1976) 922.
    """
    middle, reached = start.mean(axis=0), end.mean(axis=0)
    left, _, right = np.linalg.svd((start - middle).T @ (end - reached))
    turned = np.diag([1.0, 1.0, np.sign(np.linalg.det(right.T @ left.T))])
    rotation = right.T @ turned @ left.T
    found = np.column_stack([rotation, reached - rotation @ middle])
    error = float(np.abs(start @ rotation.T + found[:, 3] - end).max())
    return found if error <= RIGID * MM else None


def _films(view: _View, folder: Path, blocks: Blocks, names: Sequence[str]) -> list[MapField]:
    """Add the films, a mesh for each kind; return the fields that all of them have."""
    import plotly.graph_objects as go

    kinds = [(own, *_rows(blocks, own)) for own in _alike(blocks[0], names).values()]
    meshes = [[_mesh(folder, file) for file in files] for _, files, _ in kinds]
    fields = [one for one in FIELDS if all(one.name in own[0].point_data for own in meshes)]
    values = [[np.array([one.in_unit(mesh.point_data[one.name]) for mesh in own]) for one in fields] for own in meshes]
    ends = [_ends([own[k] for own in values]) for k in range(len(fields))]
    which = list(range(len(fields)))
    view.tables |= {
        "titles": [one.title for one in fields], "low": [low for low, _ in ends], "high": [high for _, high in ends],
        "scales": [_scale(one.colours) for one in fields],
        "hover": [f"{one.title}: %{{text:.3~g}}<extra></extra>" for one in fields],
    }  # fmt: skip
    for (own, files, rows), parts, shown in zip(kinds, meshes, values, strict=True):
        at = len(view.traces)
        most = min(MOST, NUMBERS // (len(files) * len(kinds)))
        kept, corners = coarsened(parts[0].points, _corners(parts[0]), most)
        view.copies.append(Copies(at, len(own), len(kept)))
        _place(view, [mesh.points[kept].astype(float) * MM for mesh in parts], f"place {at}", rows)
        view.tables[f"fields {at}"] = [row for one in shown for row in short(one[:, kept], DIGITS)]
        both = [[k * len(files) + row for row in some] for k in which for some in rows]
        view.picks += [Pick(("data", at, name), f"fields {at}", (0, 1), both) for name in ("intensity", "text")]
        by_field = {"cmin": "low", "cmax": "high", "colorscale": "scales", "hovertemplate": "hover"}
        view.picks += [Pick(("data", at, name), table, (0,), which) for name, table in by_field.items()]
        view.picks.append(Pick(("data", at, "colorbar", "title", "text"), "titles", (0,), which))
        view.traces.append(
            go.Mesh3d(
                **_lists(corners), showscale=at == 0, name=f"{part_of(own[0])}{FILM}",
                lighting={"ambient": 0.9, "diffuse": 0.2, "specular": 0.0},
                colorbar={"thickness": 12, "len": 0.8, "title": {"text": fields[0].title, "side": "right"}},
            )
        )  # fmt: skip
    return fields


def _ends(values: Sequence[Array]) -> tuple[float, float]:
    every = np.concatenate([one.ravel() for one in values])
    low, high = short([float(every.min()), float(np.quantile(every, 1.0 - BEYOND))], 4)
    return low, high


def _scale(name: str) -> list[list[Any]]:
    from matplotlib import colormaps

    return scale_of(colormaps[name])
