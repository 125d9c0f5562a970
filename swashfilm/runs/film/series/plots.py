"""Plots of a study: each number over the varied keys, and the Stribeck curve."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.output.figures import figure_of
from swashfilm.output.headline import shown_of, sizes, titled_key
from system.inputs.shown import Shown, shown_in, titled

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEAST_CHANGE = 1e-5  # relative variation below which a number is not drawn
LOG_FROM = 30.0  # ratio of an axis' ends above which the axis is logarithmic
FEW_PLAIN, MOST_PLAIN = 8.0, 1e3  # ratios of a logarithmic axis' ends: of equal steps, of 1, 2 and 5 of each ten
LOG_TO = 1e6  # ratio of an axis' ends above which the small end counts as zero
MOST_LINES = 12
LEGEND_LINE = 0.17  # height of a line of the legend, inches
STRIBECK = ("friction_coefficient", "hersey_number_m")
CONTACT = "contact_load_fraction"
COURSES = "course_"  # series over the shaft angle, drawn by `courses`


def study_plots(data: xarray.Dataset) -> dict[str, Figure]:
    """Return a figure of every number that varies, by its key: lines over one key, maps over two numeric keys.

    Three keys and more yield lines over the first, one for each value of the others. `stribeck`, where the Hersey
    number varies, is the friction coefficient over it.
    """
    ordered, keys = _ordered(data), _varying(data)
    stribeck = stribeck_plot(data)
    first = {} if stribeck is None else {"stribeck": stribeck}
    return first | {key: number_plot(ordered, key) for key in keys}


def stribeck_plot(data: xarray.Dataset) -> Figure | None:
    """Draw the friction coefficient over the Hersey number; None where one of them does not vary."""
    return _stribeck(_ordered(data)) if set(STRIBECK) <= set(_varying(data)) else None


def _ordered(data: xarray.Dataset) -> xarray.Dataset:
    return data.sortby([dim for dim in data.dims if dim in data.coords and _is_numeric(data[dim].values)])


def _varying(data: xarray.Dataset) -> list[str]:
    """Return the keys of the numbers that vary."""
    variables = [str(key) for key in data.data_vars if key not in ("status", "reason")]
    numbers = {key: data[key].values for key in variables if not key.startswith(COURSES)}
    size = sizes({key: float(np.nanmax(np.abs(values))) for key, values in numbers.items()}, {})
    return [key for key, values in numbers.items() if np.nanmax(values) - np.nanmin(values) > LEAST_CHANGE * size[key]]


def _is_numeric(values: np.ndarray) -> bool:
    return bool(np.issubdtype(values.dtype, np.number))


def number_plot(data: xarray.Dataset, key: str) -> Figure:
    """Draw a number of a study: a map over two numeric keys, lines otherwise."""
    figure, axes = figure_axes()
    field = data[key]
    numeric = [_is_numeric(data[dim].values) for dim in field.dims if dim in data.coords]
    if field.ndim == 2 and len(numeric) == 2 and all(numeric) and min(field.shape) > 1:
        _map(figure, axes, data, key)
    else:
        _lines(axes, data, key)
    axes.set_title(titled_key(key), fontsize=10)
    return figure


def _lines(axes: Any, data: xarray.Dataset, key: str) -> None:
    field = data[key]
    along, *others = field.dims
    places, labels = _places(data, str(along))
    lines = list(product(*(range(data.sizes[dim]) for dim in others)))
    for index in lines[:MOST_LINES]:
        at = dict(zip(others, index, strict=True))
        axes.plot(places, shown_of(key).of(field.isel(at).values), "o-", markersize=3.5, label=where(data, at) or None)
    if others:
        name_lines(axes, None if len(lines) <= MOST_LINES else f"{MOST_LINES} of {len(lines)} lines")
    if labels:
        axes.set_xticks(places, labels, rotation=20, ha="right", fontsize=7)
    elif _is_geometric(places):
        _set_log(axes, "x", places)
    if _is_wide(field.values):
        axes.set_yscale("log")
    axes.set(xlabel=_axis_title(data, str(along)), ylabel=titled_key(key))
    axes.grid(visible=True, alpha=0.3)


def _map(figure: Any, axes: Any, data: xarray.Dataset, key: str) -> None:
    """Draw colours and contours over two keys, logarithmic for a number with a large span."""
    across, along = (str(dim) for dim in data[key].dims)
    x, y = (axis_unit(data, dim).of(data[dim].values) for dim in (across, along))
    values = shown_of(key).of(data[key].values.T)
    for places, axis in ((x, "x"), (y, "y")):
        if _is_geometric(places):
            _set_log(axes, axis, places)
    norm = "log" if _is_wide(values) else "linear"
    whole = np.isfinite(values).all() and min(values.shape) > 2
    drawn = axes.pcolormesh(x, y, values, shading="gouraud" if whole else "nearest", norm=norm)
    if whole:
        lines = axes.contour(x, y, values, levels=_levels(values), colors="white", linewidths=0.7)
        axes.clabel(lines, fontsize=7, fmt="%.3g")
        axes.plot(*(part.ravel() for part in np.meshgrid(x, y)), ".", color="black", markersize=1.5)
    axes.set(xlabel=_axis_title(data, across), ylabel=_axis_title(data, along))
    figure.colorbar(drawn, ax=axes)


def _set_log(axes: Any, axis: str, places: np.ndarray) -> None:
    """Make an axis logarithmic; over less than MOST_PLAIN its few numbers are written in full."""
    from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter, StrMethodFormatter

    getattr(axes, f"set_{axis}scale")("log")
    own, ratio = getattr(axes, f"{axis}axis"), float(places.max() / places.min())
    if ratio < MOST_PLAIN:
        own.set_major_locator(MaxNLocator(5) if ratio < FEW_PLAIN else LogLocator(subs=(1.0, 2.0, 5.0)))
        own.set_major_formatter(StrMethodFormatter("{x:.4g}"))
        own.set_minor_formatter(NullFormatter())


def _levels(values: np.ndarray) -> np.ndarray:
    """Return about seven round values within the range."""
    from matplotlib.ticker import LogLocator, MaxNLocator

    least, most = float(values.min()), float(values.max())
    if not _is_wide(values):
        found = np.asarray(MaxNLocator(7).tick_values(least, most))
        return found[(found > least + 1e-3 * (most - least)) & (found < most)]
    steps = (1.0, 3.0) if most > 300.0 * least else (1.0, 2.0, 5.0)
    return np.asarray(LogLocator(subs=steps, numticks=12).tick_values(least, most))


def _stribeck(data: xarray.Dataset) -> Figure:
    """Draw the friction coefficient over the Hersey number: one line with the contact's share, or many."""
    figure, axes = figure_axes()
    friction, speeds = (data[key].transpose(*data[STRIBECK[0]].dims) for key in STRIBECK)
    hersey = shown_of(STRIBECK[1])
    along, *others = (str(dim) for dim in friction.dims)
    lines = list(product(*(range(data.sizes[dim]) for dim in others)))[:MOST_LINES]
    for index in lines:
        at = dict(zip(others, index, strict=True))
        y, x = friction.isel(at).values, speeds.isel(at).values
        order = np.argsort(x)
        axes.plot(hersey.of(x[order]), y[order], "o-", markersize=3.5, label=where(data, at) or None)
    axes.set_xscale("log")
    if _is_wide(friction.values):
        axes.set_yscale("log")
    axes.margins(y=0.15)
    axes.set(
        xlabel=titled("Hersey number mu U/p_mean", hersey.unit), ylabel="friction coefficient", title="Stribeck curve"
    )
    axes.grid(visible=True, alpha=0.3)
    if others:
        name_lines(axes)
    else:
        _with_least_and_contact(axes, data, along)
    return figure


def _with_least_and_contact(axes: Any, data: xarray.Dataset, along: str) -> None:
    sorted_by_hersey = data.isel({along: np.argsort(data[STRIBECK[1]].values)})
    friction, hersey = (shown_of(key).of(sorted_by_hersey[key].values) for key in STRIBECK)
    least = int(np.nanargmin(friction))
    if 0 < least < len(friction) - 1:
        axes.plot(hersey[least], friction[least], "v", color="black")
        axes.set_title(f"Stribeck curve, least {friction[least]:.3g} (triangle)")
    if CONTACT in data:
        beside = axes.twinx()
        beside.plot(hersey, sorted_by_hersey[CONTACT].values, "--", color="tab:orange", linewidth=1.0)
        beside.set_ylim(-0.02, 1.02)
        beside.set_ylabel("contact's share of the load", color="tab:orange")


def where(data: xarray.Dataset, at: Mapping[Any, int]) -> str:
    """Return the values of a line's keys, with their units."""
    return ", ".join(f"{dim} = {value_text(data, str(dim), k)}" for dim, k in at.items())


def value_text(data: xarray.Dataset, dim: str, k: int) -> str:
    """Return the k-th value of a varied key, with its unit."""
    value = data[dim].values[k]
    return axis_unit(data, dim).stated(float(value)) if _is_numeric(data[dim].values) else _text(value)


def _places(data: xarray.Dataset, dim: str) -> tuple[np.ndarray, list[str]]:
    """Return the positions of a dimension's points, and their labels where they are texts."""
    values = data[dim].values if dim in data.coords else None
    if values is not None and _is_numeric(values):
        return np.asarray(axis_unit(data, dim).of(values)), []
    count = data.sizes[dim]
    if values is not None:
        return np.arange(count), [_text(value) for value in values]
    along = [name for name in data.coords if data[name].dims == (dim,)]
    return np.arange(count), [", ".join(_text(data[name].values[k]) for name in along) for k in range(count)]


def _axis_title(data: xarray.Dataset, dim: str) -> str:
    if dim not in data.coords:
        return ", ".join(_axis_title(data, str(name)) for name in data.coords if data[name].dims == (dim,))
    return titled(dim, axis_unit(data, dim).symbol)


def axis_unit(data: xarray.Dataset, dim: str) -> Shown:
    """Return the unit in which the numbers of a varied key are shown."""
    largest = float(np.max(np.abs(data[dim].values))) if _is_numeric(data[dim].values) else 0.0
    return shown_in(data[dim].attrs.get("units", ""), dim, largest)


def _text(value: object) -> str:
    shown = f"{value:.4g}" if isinstance(value, (float, np.floating)) else str(value)
    return shown if len(shown) <= 24 else f"{shown[:23]}..."


def _is_wide(values: np.ndarray) -> bool:
    known = values[np.isfinite(values)]
    if not known.size or not known.min() > 0.0:
        return False
    return bool(LOG_FROM < known.max() / known.min() < LOG_TO)


def _is_geometric(places: np.ndarray) -> bool:
    """Return True for positions of equal ratio or with a large span."""
    if len(places) < 3 or not places.min() > 0.0:
        return _is_wide(places)
    return _is_wide(places) or bool(np.ptp(np.diff(np.log(places))) < 1e-6)


def name_lines(axes: Any, title: str | None = None) -> None:
    """Name the lines below the picture, which grows by the height of the names."""
    figure, (_, labels) = axes.figure, axes.get_legend_handles_labels()
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + LEGEND_LINE * len(labels))
    figure.legend(fontsize=7, title=title, loc="outside lower center")


def figure_axes() -> tuple[Figure, Axes]:
    """Return a figure of a study's size, with its axes."""
    figure = figure_of(5.2, 3.7)
    return figure, figure.subplots()
