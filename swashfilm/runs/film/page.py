"""Page of one film: report.html with picture and numbers, from the files of the run folder."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.answer import Answer
from swashfilm.output.data.files import read_columns, read_netcdf
from swashfilm.output.figures import figure_of
from swashfilm.output.headline import named, number_text, numbers_text, shown_of, summary_scales, titled_key
from swashfilm.output.page import inlined, kept_text, read_summary, write_page
from swashfilm.output.refinement import refinement_head, refinement_rows
from swashfilm.output.scenes.field_maps import MapField, draw_map
from swashfilm.output.touch.explorer import Explorer
from swashfilm.output.touch.meshes import triangles
from swashfilm.output.touch.relief import ReliefField, relief
from swashfilm.runs.film.answer import film_tiles, film_words
from swashfilm.runs.film.history import last_of
from swashfilm.runs.film.sensitivity import sensitivity_figure, sensitivity_rows

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
CAPTION = "Maps of the film over its plane; pressures are gauge"
HISTORY = ("load_N", "pressure_max_Pa", "film_thickness_min_m", "temperature_max_K")


def write_film_page(folder: Path) -> Path:
    """Write report.html of a film's run folder from its summary.json, resolved.toml and results.nc.

    The page is self-contained. Raises InputFaults where one of the three files is missing.
    """
    summary = read_summary(folder, ("summary.json", "resolved.toml", "results.nc"), "a film's run folder")
    fields = last_of(read_netcdf(folder / "results.nc"))
    picture, costs = inlined(film_figure(fields)), sensitivity_figure(fields)
    return write_page(
        folder,
        "film",
        answer=Answer(tuple(film_tiles(summary)), film_words(summary), picture, CAPTION),
        name=summary["name"],
        surface=inlined(surface_figure(fields), film_relief(fields)),
        of_gap="required_load_N" in summary,
        sensitivity=sensitivity_rows(summary),
        kept=summary.get("sensitivity", {}).get("kept", ""),
        costs=None if costs is None else inlined(costs),
        history=inlined(history_picture(history)) if (history := folder / "history.csv").is_file() else None,
        rows=list(summary_rows(summary)),
        warnings=summary["warnings"],
        assumptions=summary.get("assumptions", []),
        refinement=[refinement_head(found), *refinement_rows(found)] if (found := summary.get("refinement")) else [],
        case=kept_text(folder, "resolved.toml"),
    )


def summary_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (name, value with its unit) of every number of a film's summary, in its order."""
    scales = summary_scales(summary)
    for key, value in summary.items():
        if key in ("format", "kind", "name", "warnings", "refinement", "assumptions", "scale", "sensitivity"):
            continue
        words = named(key)[0]
        if value is None:
            yield words, "none"
        elif isinstance(value, dict):
            for part, number in value.items():
                yield f"{words}, {part}", number_text(key, number, scales)
        elif isinstance(value, list):
            yield words, numbers_text(key, value, scales)
        elif isinstance(value, float):
            yield words, number_text(key, value, scales)
        else:
            yield words, f"{value} {named(key)[1]}".strip()


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


def history_picture(history: Path) -> Figure:
    """Draw load, largest pressure, least film and temperature (if any) over time, from history.csv."""
    steps = read_columns(history)
    shown = [key for key in HISTORY if named(key)[0] in steps]
    figure = figure_of(8.0, 2.2 * len(shown))
    for axes, key in zip(figure.subplots(len(shown), 1, sharex=True), shown, strict=True):
        axes.plot(steps["time"], shown_of(key).of(steps[named(key)[0]]))
        axes.set_ylabel(titled_key(key))
        axes.grid(visible=True, alpha=0.3)
    axes.set_xlabel("time [s]")
    return figure
