"""Sections through a film: pressure, thickness and temperature along cuts through its outstanding places."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array
from swashfilm.output.data.files import Column, write_columns
from swashfilm.output.figures import figure_of, legend_below
from swashfilm.output.touch.meshes import triangles
from swashfilm.runs.film.fields.maps import FIELDS, smooth_name
from system.inputs.shown import title_in
from system.inputs.units import TURN

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

SHOWN = ("film_pressure", "film_thickness_cell", "temperature")
POINTS = 201
ENDS = 0.5 * TURN - 1e-6
"""Angle from which a vertex of a ring counts as one at both ends of the turn."""
INSET = 1e-6
"""Distance from the film's edge, as share of its size, of a cut along it: points on the edge may count as outside."""
ALIKE = 1e-6
"""Relative difference of two film thicknesses below which both are the least."""
LEVEL = 1e-3
"""Range of a line, as share of the largest in its row, below which it is drawn level."""
HIGHEST, LEAST = "highest pressure", "least film"
PLACES = {HIGHEST: "the highest pressure (filled mark)", LEAST: "the least film (hollow mark)"}
LOOKS = {HIGHEST: ("#3c7a8c", "-", "full"), LEAST: ("#b5523b", "--", "none")}
"""Colour, line and filling of the mark of each place."""


@dataclass(frozen=True)
class Cut:
    """Line in a film's plane: its direction in words, title of its coordinate, and that coordinate (n,) as shown.

    x, y: places (n,), m. at: coordinate of the place through which it runs, as shown.
    """

    words: str
    title: str
    along: Array
    x: Array
    y: Array
    at: float


@dataclass(frozen=True)
class Plane:
    """Triangles of a film in the plane of its interpolation.

    vertices (points,), cells (triangles,): numbers of the film's own vertices and triangles; of: place there of x, y.
    """

    mesh: Any
    vertices: NDArray[np.intp]
    cells: NDArray[np.intp]
    of: Callable[[Array, Array], tuple[Array, Array]]


@dataclass(frozen=True)
class Section:
    """Fields (n,) along a cut through a place, SI, by their names in FIELDS; nan outside the film."""

    place: str
    cut: Cut
    values: Mapping[str, Array]


def sections(fields: xarray.Dataset) -> tuple[Section, ...]:
    """Return the sections of a film at one time: two cuts through each of its `places`.

    The cuts run along x and y; of a ring about the origin along its radius and round it. Values between vertices are
    linear, of a ring in angle and radius; a film with steps between its cells has the value of each cell.
    """
    from matplotlib.tri import Triangulation

    corners = triangles(fields["cells"].values)
    mesh = Triangulation(fields["x"].values, fields["y"].values, corners)
    shown = [field.name for field in FIELDS if field.name in SHOWN and field.name in fields]
    unrolled = unroll(mesh) if _is_ring(mesh) else None
    plane = unrolled or Plane(mesh, np.arange(len(mesh.x)), np.arange(len(corners)), lambda x, y: (x, y))
    of_fields = {name: _interpolated(plane, fields, name) for name in shown}
    cuts = _straight_cuts if unrolled is None else _round_cuts
    return tuple(
        Section(place, cut, {name: of(cut.x, cut.y) for name, of in of_fields.items()})
        for place, at in places(fields).items()
        for cut in cuts(mesh, at)
    )


def places(fields: xarray.Dataset) -> dict[str, Array]:
    """Return the places (2,) m of the highest pressure and, for a film of varying thickness, of the least film.

    Of equally thin places it is that of the highest pressure.
    """
    points = np.column_stack([fields["x"].values, fields["y"].values])
    pressure, thickness = fields["film_pressure"].values, fields["film_thickness"].values
    found = {HIGHEST: points[int(np.argmax(pressure))]}
    if np.ptp(thickness) > ALIKE * thickness.max():
        least = np.flatnonzero(thickness <= (1.0 + ALIKE) * thickness.min())
        found[LEAST] = points[least[np.argmax(pressure[least])]]
    return found


def section_words(found: Sequence[Section]) -> str:
    """Return a sentence on the sections of a film for its page."""
    left, right = dict.fromkeys(one.cut.words for one in found)
    both = f"{PLACES[HIGHEST]} and {PLACES[LEAST]}" if any(one.place == LEAST for one in found) else PLACES[HIGHEST]
    return f"Cuts through the place of {both}: on the left along {left}, on the right along {right}."


def section_figure(found: Sequence[Section]) -> Figure:
    """Draw each field over both cuts, a line for each place with its mark."""
    shown = [field for field in FIELDS if field.name in found[0].values]
    cuts = list(dict.fromkeys(one.cut.words for one in found))
    figure = figure_of(10.0, 2.3 * len(shown) + 0.6)
    panels = figure.subplots(len(shown), len(cuts), sharex="col", squeeze=False)
    for row, field in zip(panels, shown, strict=True):
        for axes, words in zip(row, cuts, strict=True):
            for one in (section for section in found if section.cut.words == words):
                _draw(axes, one, field.in_unit(one.values[field.name]))
            axes.grid(visible=True, alpha=0.3)
        _level(row)
        row[0].set_ylabel(title_in(field.words.partition(",")[0], field.unit))
    for axes, words in zip(panels[-1], cuts, strict=True):
        axes.set_xlabel(next(one.cut.title for one in found if one.cut.words == words))
    legend_below(panels[-1][0], columns=1)
    return figure


def write_sections(path: Path, found: Sequence[Section]) -> None:
    """Write a row for each point of each section: place and cut in words, x, y and the fields, units in the heads."""
    joined = {name: np.concatenate([one.values[name] for one in found]) for name in found[0].values}
    lengths = [len(one.cut.x) for one in found]
    words = {"through": [one.place for one in found], "along": [one.cut.words for one in found]}
    units = {field.name: field.unit for field in FIELDS}
    write_columns(
        path,
        [
            *(Column(head, np.repeat(texts, lengths)) for head, texts in words.items()),
            *(Column(axis, np.concatenate([getattr(one.cut, axis) for one in found]), "m") for axis in "xy"),
            *(Column(name.removesuffix("_cell"), values, units[name]) for name, values in joined.items()),
        ],
    )


def _level(row: Sequence[Any]) -> None:
    """Give panels of a row whose lines are level beside it the range of the row, in which round-off is no wave."""
    spans = [axes.dataLim.intervaly for axes in row]
    widest = max(np.ptp(span) for span in spans)
    for axes, span in zip(row, spans, strict=True):
        if np.ptp(span) < LEVEL * widest:
            axes.set_ylim(np.mean(span) - 0.55 * widest, np.mean(span) + 0.55 * widest)


def _draw(axes: Any, one: Section, values: Array) -> None:
    """Draw a field along a section with the mark of its place, named once."""
    colour, line, filling = LOOKS[one.place]
    cut = one.cut
    axes.plot(cut.along, values, line, color=colour, label=f"through the {one.place}")
    near = int(np.nanargmin(np.where(np.isnan(values), np.nan, np.abs(cut.along - cut.at))))
    axes.plot(cut.along[near], values[near], "o", color=colour, fillstyle=filling)


def _interpolated(plane: Plane, fields: xarray.Dataset, name: str) -> Any:
    """Return a field of vertices or cells as a function of places x, y (n,); nan outside the film."""
    from matplotlib.tri import LinearTriInterpolator

    drawn = smooth_name(fields, name)
    values, cells = fields[drawn].values, fields["cells"].values
    if fields[drawn].dims == fields["x"].dims:
        linear = LinearTriInterpolator(plane.mesh, values[plane.vertices])
        return lambda x, y: np.ma.filled(linear(*plane.of(x, y)), np.nan)
    of_triangles, finder = np.tile(values, 2 if cells.shape[1] == 4 else 1)[plane.cells], plane.mesh.get_trifinder()

    def of_cells(x: Array, y: Array) -> Array:
        inside = finder(*plane.of(x, y))
        return np.where(inside >= 0, of_triangles[inside], np.nan)

    return of_cells


def unroll(mesh: Any) -> Plane | None:
    """Return a ring about the origin over a turn of angle and radius, None where its cells are too coarse for it.

    Circles of vertices are straight there, so that values on such a circle lie between its own vertices alone. Cells
    across the half turn appear at both ends.
    """
    from matplotlib.tri import Triangulation

    corners, radii, size = mesh.triangles, np.hypot(mesh.x, mesh.y), float(np.hypot(mesh.x, mesh.y).max())
    angles = np.arctan2(mesh.y, mesh.x)[corners]
    turns = -np.round((angles - angles[:, :1]) / TURN).astype(int)
    angles = angles + TURN * turns
    high, low = angles.max(axis=1) > ENDS, angles.min(axis=1) < -ENDS
    cells = np.concatenate([np.arange(len(corners)), np.flatnonzero(high), np.flatnonzero(low)])
    shift = np.repeat([0, -1, 1], [len(corners), high.sum(), low.sum()])
    places, numbers = np.unique(
        np.stack([corners[cells], turns[cells] + shift[:, None]], axis=-1).reshape(-1, 2), axis=0, return_inverse=True
    )
    vertices, turn = places.T
    along = np.arctan2(mesh.y, mesh.x)[vertices] + TURN * turn
    found = Triangulation(along, radii[vertices] / size, numbers.reshape(-1, 3))
    if (_areas(found) * -_areas(mesh)[cells] <= 0.0).any():
        return None
    return Plane(found, vertices, cells, lambda x, y: (np.arctan2(y, x), np.hypot(x, y) / size))


def _areas(mesh: Any) -> Array:
    """Return the signed area (triangles,) of each triangle, in the units of its coordinates."""
    (x1, x2, x3), (y1, y2, y3) = mesh.x[mesh.triangles].T, mesh.y[mesh.triangles].T
    return np.asarray(0.5 * ((x2 - x1) * (y3 - y1) - (x3 - x1) * (y2 - y1)))


def _is_ring(mesh: Any) -> bool:
    """Return whether the film surrounds the origin, which is not part of it."""
    angles = np.sort(np.arctan2(mesh.y, mesh.x))
    widest = np.max(np.diff(angles, append=angles[0] + TURN))
    return bool(widest < 0.25 * TURN and mesh.get_trifinder()(0.0, 0.0) < 0)


def _straight_cuts(mesh: Any, place: Array) -> Iterator[Cut]:
    """Yield the cuts along x and along y through a place."""
    ends = [(float(one.min()), float(one.max())) for one in (mesh.x, mesh.y)]
    gaps = [INSET * (high - low) for low, high in ends]
    inside = [np.clip(at, low + gap, high - gap) for at, (low, high), gap in zip(place, ends, gaps, strict=True)]
    for axis, letter in enumerate("xy"):
        (low, high), gap = ends[axis], gaps[axis]
        along = np.unique([*np.linspace(low + gap, high - gap, POINTS), inside[axis]])
        across = np.full(along.shape, inside[1 - axis])
        x, y = (along, across) if axis == 0 else (across, along)
        yield Cut(letter, f"{letter} [mm]", along * 1e3, x, y, float(inside[axis]) * 1e3)


def _round_cuts(mesh: Any, place: Array) -> Iterator[Cut]:
    """Yield the cut along the radius through a place of a ring, on its side, and the cut round the ring."""
    radii = np.hypot(mesh.x, mesh.y)
    gap = INSET * float(np.ptp(radii))
    low, high = float(radii.min()) + gap, float(radii.max()) - gap
    angle, radius = float(np.arctan2(place[1], place[0])), float(np.clip(np.hypot(*place), low, high))
    along = np.unique([*np.linspace(low, high, POINTS), radius])
    yield Cut("the radius", "radius [mm]", along * 1e3, along * np.cos(angle), along * np.sin(angle), radius * 1e3)
    turn = np.unique([*np.linspace(-0.5 * TURN, 0.5 * TURN, 2 * POINTS - 1), angle])
    x, y = radius * np.cos(turn), radius * np.sin(turn)
    yield Cut("the circumference", "angle [deg]", np.degrees(turn), x, y, float(np.degrees(angle)))
