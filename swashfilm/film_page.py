"""The page of one film: report.html with its picture and its numbers, made from the run folder's own files."""

from __future__ import annotations

import base64
import io
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.film_refine import refinement_head, refinement_rows
from swashfilm.headline import named
from swashfilm.maps import draw_map
from system.faults import Fault, InputFaults


def write_film_page(folder: Path) -> Path:
    """Write report.html of a film's run folder from its summary.json, resolved.toml and results.nc.

    The page is one file that needs no other. Raises InputFaults where one of the three is not there.
    """
    from jinja2 import Environment, PackageLoader

    missing = [name for name in ("summary.json", "resolved.toml", "results.nc") if not (folder / name).is_file()]
    if missing:
        raise InputFaults(str(folder), [Fault(name, "no such file", "a film's run folder") for name in missing])
    summary = json.loads((folder / "summary.json").read_text("utf-8"))
    template = Environment(loader=PackageLoader("swashfilm"), autoescape=True).get_template("film.html.jinja")
    page = template.render(
        name=summary["name"],
        picture=base64.b64encode(film_picture(folder / "results.nc")).decode("ascii"),
        rows=list(summary_rows(summary)),
        warnings=summary["warnings"],
        refinement=[refinement_head(found), *refinement_rows(found)]
        if (found := summary.get("refinement"))
        else [],
        case=(folder / "resolved.toml").read_text("utf-8"),
    )
    path = folder / "report.html"
    path.write_text(page, encoding="utf-8")
    return path


def summary_rows(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """(what, value with its unit) of every number of a film's summary, in its order."""
    for key, value in summary.items():
        if key in ("format", "kind", "name", "warnings", "refinement"):
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


def film_picture(results: Path) -> bytes:
    """Maps of film pressure (MPa) and film thickness (um) over the film plane (mm), as a PNG."""
    import xarray
    from matplotlib.figure import Figure

    with xarray.open_dataset(results, engine="h5netcdf") as fields:
        fields.load()
    place = (fields["x"].values * 1e3, fields["y"].values * 1e3)
    wide = np.ptp(place[0]) > 1.7 * np.ptp(place[1])
    figure = Figure(figsize=(8.0, 7.0) if wide else (10.0, 4.2), layout="constrained")
    one, two = figure.subplots(2, 1) if wide else figure.subplots(1, 2)
    cells = fields["cells"].values
    draw_map(one, place, cells, fields["film_pressure"].values * 1e-6, "film pressure / MPa")
    thickness = fields["film_thickness_cell"].values * 1e6
    draw_map(two, place, cells, thickness, "film thickness / um", colours="cividis")
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=130)
    return picture.getvalue()
