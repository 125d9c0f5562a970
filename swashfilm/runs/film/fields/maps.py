"""Maps of a film's fields over its plane, and their relief."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swashfilm.output.figures import figure_of
from swashfilm.output.scenes.field_maps import MapField, draw_map
from swashfilm.output.touch.explorer import Explorer
from swashfilm.output.touch.meshes import triangles
from swashfilm.output.touch.relief import ReliefField, relief

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

FIELDS = (
    MapField("film_pressure", "film pressure", "Pa", always=True),
    MapField("film_thickness_cell", "film thickness", "m", colours="cividis", always=True),
    MapField("film_fraction", "film fraction", "1", colours="Blues"),
    MapField("temperature", "film temperature, mean over the thickness", "K", colours="inferno"),
    MapField("deformation", "deformation of the walls", "m", colours="cividis"),
    MapField("contact_pressure", "contact pressure", "Pa", colours="magma"),
)
LARGEST_STEP = 0.02
"""Difference, relative to the thickest film, of a cell and its corners above which the film has a step."""


def film_figure(fields: xarray.Dataset) -> Figure:
    """Draw maps over the film plane (mm): pressure (MPa), thickness (um), and other fields of FIELDS that vary."""
    shown = [
        field for field in FIELDS if field.name in fields and (field.always or np.ptp(fields[field.name].values) > 0.0)
    ]
    place = (fields["x"].values * 1e3, fields["y"].values * 1e3)
    wide = np.ptp(place[0]) > 1.7 * np.ptp(place[1])
    rows, columns = (len(shown), 1) if wide else ((len(shown) + 1) // 2, 2)
    figure = figure_of(*((8.0, 3.5 * rows) if wide else (10.0, 4.2 * rows)))
    for number, field in enumerate(shown, start=1):
        axes = figure.add_subplot(rows, columns, number)
        values = field.in_unit(fields[smooth_name(fields, field.name)].values)
        draw_map(axes, place, fields["cells"].values, values, field.title, colours=field.colours)
    return figure


def surface_figure(fields: xarray.Dataset) -> Figure:
    """Draw film pressure as a surface over the film plane (mm)."""
    figure, pressure = figure_of(8.0, 5.0), FIELDS[0]
    axes = figure.add_subplot(projection="3d")
    place = (fields[axis].values * 1e3 for axis in "xy")
    height, corners = pressure.in_unit(fields[pressure.name].values), triangles(fields["cells"].values)
    axes.plot_trisurf(*place, height, triangles=corners, cmap=pressure.colours, rasterized=True)
    axes.set(xlabel="x [mm]", ylabel="y [mm]", zlabel=pressure.title)
    return figure


def film_relief(fields: xarray.Dataset) -> Explorer:
    """Return the relief of the fields of FIELDS at the vertices."""
    known = [(field, smooth_name(fields, field.name)) for field in FIELDS if field.name in fields]
    shown = [
        ReliefField(field.title, field.in_unit(fields[name].values[None]), field.colours)
        for field, name in known
        if fields[name].dims == fields["x"].dims
    ]
    place = fields["x"].values[None] * 1e3, fields["y"].values[None] * 1e3
    return relief(place, fields["cells"].values, shown, ("as solved",))


def smooth_name(fields: xarray.Dataset, name: str) -> str:
    """Return the field at the vertices in place of that of the cells, `name`, where no step lies between the cells."""
    at_vertices = name.removesuffix("_cell")
    if at_vertices == name or at_vertices not in fields:
        return name
    by_cell = fields[name].values
    across = fields[at_vertices].values[fields["cells"].values].mean(axis=1)
    return at_vertices if np.max(np.abs(across - by_cell)) < LARGEST_STEP * np.max(by_cell) else name
