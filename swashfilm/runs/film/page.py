"""Page of one film: report.html with picture and numbers, from the files of the run folder."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.answer import Answer
from swashfilm.output.field_maps import MapField, draw_map
from swashfilm.output.figures import figure_of
from swashfilm.output.headline import named
from swashfilm.output.page import inlined, read_summary, write_page
from swashfilm.output.refinement import refinement_head, refinement_rows
from swashfilm.output.result import read_netcdf
from swashfilm.runs.film.answer import film_tiles, film_words
from swashfilm.runs.film.history import last_of
from swashfilm.runs.film.sensitivity import sensitivity_figure, sensitivity_rows

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

FIELDS = (
    MapField("film_pressure", "film pressure / MPa", 1e-6, always=True),
    MapField("film_thickness_cell", "film thickness / um", 1e6, colours="cividis", always=True),
    MapField("film_fraction", "film fraction", colours="Blues"),
    MapField("temperature", "film temperature, mean over the thickness / degC", zero=273.15, colours="inferno"),
    MapField("deformation", "deformation of the walls / um", 1e6, colours="cividis"),
    MapField("contact_pressure", "contact pressure / MPa", 1e-6, colours="magma"),
)


LARGEST_STEP = 0.02
"""Difference, relative to the thickest film, of a cell and its corners above which the film has a step."""
CAPTION = "Maps of the film over its plane; pressures are gauge"
HISTORY = ("load / N", "pressure max / Pa", "film thickness min / m", "temperature max / K")


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
        of_gap="required_load_N" in summary,
        sensitivity=sensitivity_rows(summary),
        kept=summary.get("sensitivity", {}).get("kept", ""),
        costs=None if costs is None else inlined(costs),
        history=inlined(history_picture(history)) if (history := folder / "history.csv").is_file() else None,
        rows=list(summary_rows(summary)),
        warnings=summary["warnings"],
        assumptions=summary.get("assumptions", []),
        refinement=[refinement_head(found), *refinement_rows(found)] if (found := summary.get("refinement")) else [],
        case=(folder / "resolved.toml").read_text("utf-8"),
    )


def summary_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield (name, value with its unit) of every number of a film's summary, in its order."""
    for key, value in summary.items():
        if key in ("format", "kind", "name", "warnings", "refinement", "assumptions", "sensitivity"):
            continue
        words, unit = named(key)
        if value is None:
            yield words, "none"
        elif isinstance(value, dict):
            for part, number in value.items():
                yield f"{words}, {part}", f"{number:.6g} {unit}".strip()
        elif isinstance(value, list):
            yield words, f"({', '.join(f'{number:.6g}' for number in value)}) {unit}".strip()
        elif isinstance(value, float):
            yield words, f"{value:.6g} {unit}".strip()
        else:
            yield words, f"{value} {unit}".strip()


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
    with history.open(newline="", encoding="utf-8") as file:
        steps = list(csv.DictReader(file))
    shown = [name for name in HISTORY if name in steps[0]]
    figure = figure_of(8.0, 2.2 * len(shown))
    for axes, name in zip(figure.subplots(len(shown), 1, sharex=True), shown, strict=True):
        axes.plot(*([float(step[key]) for step in steps] for key in ("time / s", name)))
        axes.set_ylabel(name)
        axes.grid(visible=True, alpha=0.3)
    axes.set_xlabel("time / s")
    return figure
