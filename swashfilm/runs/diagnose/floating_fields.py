"""Floating films of the pump without and with a finding, side by side."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.data.files import RESULTS, read_netcdf
from swashfilm.output.data.gap_names import TITLES
from swashfilm.output.figures import figure_of
from swashfilm.output.scenes.field_maps import draw_map
from swashfilm.runs.film.revolution.plots import MAPPED, unit_of
from system.inputs.shown import titled

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure


def floating_pictures(folders: Sequence[Path], names: Sequence[str]) -> dict[str, Figure]:
    """Films of each gap of two floating runs by caption, at the kept angle where their pressures differ the most.

    Empty where a folder holds no floating run.
    """
    if not all((folder / f"{gap}.csv").is_file() for folder in folders for gap in TITLES):
        return {}
    found = {}
    for gap, title in TITLES.items():
        data = [read_netcdf(folder / RESULTS, gap) for folder in folders]
        at = _most_apart(data)
        angle = np.degrees(data[0]["film_angle"].values[at])
        found[f"Film {title} at {angle:.0f} deg of the shaft, without and with the finding"] = _beside(data, names, at)
    return found


def _most_apart(data: Sequence[xarray.Dataset]) -> int:
    """Number of the kept film with the largest difference of pressures, rms over the film."""
    one, other = (each["film_pressure"].values for each in data)
    return int(np.argmax(np.sqrt(np.mean((one - other) ** 2, axis=1))))


def _beside(data: Sequence[xarray.Dataset], names: Sequence[str], at: int) -> Figure:
    """A line of maps for each field; films without temperature have that of the case."""
    fields = [name for name in MAPPED if any(name in each for each in data)]
    figure = figure_of(10.0, 3.7 * len(fields))
    for line, field in zip(figure.subplots(len(fields), 2, squeeze=False), fields, strict=True):
        shown = [each[field].values[at] for each in data if field in each]
        limits = min(float(one.min()) for one in shown), max(float(one.max()) for one in shown)
        for axes, each, name in zip(line, data, names, strict=True):
            if field in each:
                _draw(axes, each, field, at, name, limits)
            else:
                axes.set_axis_off()
                axes.text(0.5, 0.5, f"{name}: as warm as the case", ha="center", transform=axes.transAxes)
    return figure


def _draw(axes: Any, data: xarray.Dataset, field: str, at: int, name: str, limits: tuple[float, float]) -> None:
    """A film's field in its customary unit; limits: ends of its colours, SI."""
    how, (words, colours) = unit_of(data, field), MAPPED[field]
    low, high = map(float, how.of(np.array(limits)))
    place = data["x"].values[at] * 1e3, data["y"].values[at] * 1e3
    values, cells = how.of(data[field].values[at]), data["cells"].values
    draw_map(axes, place, cells, values, f"{titled(words, how.unit)}, {name}", colours=colours, limits=(low, high))
