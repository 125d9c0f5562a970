"""Sensitivity of a film in its files: numbers of the summary, fields, and table and picture of the page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.figures import figure_of
from swashfilm.output.headline import named
from swashfilm.output.scenes.field_maps import draw_map
from swashfilm.runs.film.solve.growth import CONSTANT
from swashfilm.runs.film.solve.study import FilmStudy

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

FIELD = "sensitivity_"
_KEYS = {"N": "N", "N m": "Nm", "m3/s": "m3_per_s", "W": "W"}
_SHOWN = {"m3/s": (6e7, "mL/min"), "N m": (1e3, "N mm")}  # factor and unit of page and picture; others keep theirs
PER_AREA_AND_FILM = 1e-12  # of 1/m3 in 1/(mm2 um)


def sensitivity_summary(study: FilmStudy) -> dict[str, Any]:
    """Return the derivatives of each output by the parameters of the film's shape, SI, units in keys.

    by_KEY: change of the output per unit of the parameter; left_out: why a parameter has no derivative;
    weakly_active_unknowns: see the warning of that name.
    """
    found = study.sensitivity
    if found is None:
        return {}
    outputs = {
        _key(name, one.unit): {
            "value": one.value,
            **{f"by_{by.key}": one.along(by.at_points, by.at_vertices, by.squeeze) for by in found.growth},
        }
        for name, one in found.gradients.items()
    }
    parameters = {grown.key: grown.value for grown in found.growth if grown.value is not None}
    return {
        "sensitivity": {
            "kept": found.kept, "weakly_active_unknowns": found.weak, "parameters": parameters, "outputs": outputs,
            "left_out": dict(found.left_out),
        }
    }  # fmt: skip


def _key(name: str, unit: str) -> str:
    """Return the key of an output: `flow_m3_per_s.left` of `flow.left`."""
    stem, *part = name.split(".", 1)
    return ".".join([f"{stem}_{_KEYS[unit]}", *part])


def sensitivity_fields(study: FilmStudy) -> dict[str, tuple[np.ndarray, str]]:
    """Return the derivatives per area by the thickness at the vertices with their units, by name of the field."""
    if study.sensitivity is None:
        return {}
    return {
        f"{FIELD}{name.replace('.', '_')}": (one.density, f"({one.unit})/m3")
        for name, one in study.sensitivity.gradients.items()
    }


def sensitivity_rows(summary: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """Return (output, parameter, derivative) of every pair, with a head; no rows for a film without derivatives.

    Of a parameter with a value also the change of the output by 1 % of it.
    """
    found = summary.get("sensitivity")
    return [] if found is None else [("output", "parameter", "derivative", "by 1 % of the parameter"), *_rows(found)]


def _rows(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    for key, numbers in found["outputs"].items():
        words, si = named(key)
        factor, unit = _SHOWN.get(si, (1.0, si))
        for by, in_si in numbers.items():
            if by == "value":
                continue
            parameter = by.removeprefix("by_")
            value, slope = found["parameters"].get(parameter), factor * in_si
            change = "" if not value else f"{0.01 * value * slope:.4g} {unit}"
            yield words, *_derivative(parameter, slope, unit), change
    for parameter, why in found.get("left_out", {}).items():
        words = parameter.removeprefix(CONSTANT) if parameter.startswith(CONSTANT) else named(parameter)[0]
        yield "every output", words, f"left out: {why}", ""


def _derivative(parameter: str, slope: float, unit: str) -> tuple[str, str]:
    """Return name of a parameter and the derivative by it: per um of a length, else per SI unit."""
    constant = parameter.startswith(CONSTANT)
    words, per = (parameter.removeprefix(CONSTANT), "") if constant else named(parameter)
    if per == "m":
        return words, f"{1e-6 * slope:.4g} {unit} per um"
    return words, f"{slope:.4g} {unit} per {per}" if per else f"{slope:.4g} {unit} per SI unit"


def sensitivity_figure(fields: xarray.Dataset) -> Figure | None:
    """Draw each output's derivative by the film at every place, per mm2 and um; None without derivatives."""
    shown = [name for name in fields if str(name).startswith(FIELD)]
    if not shown:
        return None
    place = fields["x"].values * 1e3, fields["y"].values * 1e3
    wide = np.ptp(place[0]) > 1.7 * np.ptp(place[1])
    rows, columns = (len(shown), 1) if wide else ((len(shown) + 1) // 2, 2)
    figure = figure_of(*((8.0, 3.5 * rows) if wide else (10.0, 4.2 * rows)))
    for number, name in enumerate(shown, start=1):
        unit = fields[name].attrs["units"].removeprefix("(").removesuffix(")/m3")
        factor, symbol = _SHOWN.get(unit, (1.0, unit))
        values = factor * PER_AREA_AND_FILM * fields[name].values
        most = float(np.percentile(np.abs(values), 99.0)) or 1.0  # a peak at a corner must not hide the rest
        title = f"{str(name).removeprefix(FIELD).replace('_', ' ')} by film / ({symbol}/(mm2 um))"
        axes = figure.add_subplot(rows, columns, number)
        draw_map(axes, place, fields["cells"].values, values, title, colours="coolwarm", limits=(-most, most))
    return figure
