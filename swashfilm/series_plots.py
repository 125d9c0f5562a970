"""Plots of a study: each number over what varied, and the Stribeck curve."""

from __future__ import annotations

import io
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.headline import sizes, titled

if TYPE_CHECKING:
    import xarray

LEAST_CHANGE = 1e-9  # of the size of such numbers: one that varies less is not drawn
LOG_FROM = 30.0  # ratio of an axis' ends from which it is drawn in logarithms
MOST_LINES = 12
STRIBECK = ("friction_coefficient", "hersey_number_m")


def study_plots(data: xarray.Dataset) -> dict[str, bytes]:
    """A PNG of every number that varies, by its key: lines over one key, maps over two that are numbers.

    Three keys and more are lines over the first, one for each value of the others. `stribeck`, where the Hersey
    number varies, is the friction coefficient over it.
    """
    ordered = data.sortby([dim for dim in data.dims if dim in data.coords and _is_numeric(data[dim].values)])
    numbers = {str(key): data[key].values for key in data.data_vars if key not in ("status", "reason")}
    size = sizes({key: float(np.nanmax(np.abs(values))) for key, values in numbers.items()}, {})
    keys = [
        key for key, values in numbers.items() if np.nanmax(values) - np.nanmin(values) > LEAST_CHANGE * size[key]
    ]
    pictures = {key: _picture(ordered, key) for key in keys}
    if set(STRIBECK) <= set(keys):
        pictures["stribeck"] = _stribeck(ordered)
    return pictures


def _is_numeric(values: np.ndarray) -> bool:
    return bool(np.issubdtype(values.dtype, np.number))


def _picture(data: xarray.Dataset, key: str) -> bytes:
    figure, axes = _figure()
    field = data[key]
    numeric = [_is_numeric(data[dim].values) for dim in field.dims if dim in data.coords]
    if field.ndim == 2 and len(numeric) == 2 and all(numeric) and min(field.shape) > 1:
        _map(figure, axes, data, key)
    else:
        _lines(axes, data, key)
    axes.set_title(titled(key), fontsize=10)
    return _png(figure)


def _lines(axes: Any, data: xarray.Dataset, key: str) -> None:
    field = data[key]
    along, *others = field.dims
    places, labels = _places(data, str(along))
    lines = list(product(*(range(data.sizes[dim]) for dim in others)))
    for index in lines[:MOST_LINES]:
        at = dict(zip(others, index, strict=True))
        shown = ", ".join(
            f"{dim} = {_text(data[dim].values[k])} {data[dim].attrs.get('units', '')}".strip()
            for dim, k in at.items()
        )
        axes.plot(places, field.isel(at).values, "o-", markersize=3.5, label=shown or None)
    if others:
        axes.legend(fontsize=7, title=None if len(lines) <= MOST_LINES else f"{MOST_LINES} of {len(lines)} lines")
    if labels:
        axes.set_xticks(places, labels, rotation=20, ha="right", fontsize=7)
    elif _is_wide(places):
        axes.set_xscale("log")
    axes.set(xlabel=_axis_title(data, str(along)), ylabel=titled(key))
    axes.grid(visible=True, alpha=0.3)


def _map(figure: Any, axes: Any, data: xarray.Dataset, key: str) -> None:
    across, along = (str(dim) for dim in data[key].dims)
    x, y, values = data[across].values, data[along].values, data[key].values.T
    drawn = axes.pcolormesh(x, y, values, shading="nearest")
    if np.isfinite(values).all() and min(values.shape) > 2:
        lines = axes.contour(x, y, values, colors="white", linewidths=0.7)
        axes.clabel(lines, fontsize=6)
    for places, scale in ((x, axes.set_xscale), (y, axes.set_yscale)):
        if _is_wide(places):
            scale("log")
    axes.set(xlabel=_axis_title(data, across), ylabel=_axis_title(data, along))
    figure.colorbar(drawn, ax=axes)


def _stribeck(data: xarray.Dataset) -> bytes:
    figure, axes = _figure()
    friction, hersey = (data[key].values.ravel() for key in STRIBECK)
    order = np.argsort(hersey)
    axes.plot(hersey[order], friction[order], "o-" if data[STRIBECK[0]].ndim == 1 else "o", markersize=3.5)
    if _is_wide(hersey):
        axes.set_xscale("log")
    axes.set(xlabel="Hersey number mu U/p_mean / m", ylabel="friction coefficient", title="Stribeck curve")
    axes.grid(visible=True, alpha=0.3)
    return _png(figure)


def _places(data: xarray.Dataset, dim: str) -> tuple[np.ndarray, list[str]]:
    """Where a dimension's points are drawn, and the labels they need where they are texts."""
    values = data[dim].values if dim in data.coords else None
    if values is not None and _is_numeric(values):
        return values, []
    count = data.sizes[dim]
    if values is not None:
        return np.arange(count), [_text(value) for value in values]
    along = [name for name in data.coords if data[name].dims == (dim,)]
    return np.arange(count), [", ".join(_text(data[name].values[k]) for name in along) for k in range(count)]


def _axis_title(data: xarray.Dataset, dim: str) -> str:
    if dim not in data.coords:
        return ", ".join(_axis_title(data, str(name)) for name in data.coords if data[name].dims == (dim,))
    unit = data[dim].attrs.get("units", "")
    return f"{dim} / {f'({unit})' if '/' in unit or ' ' in unit else unit}" if unit else dim


def _text(value: object) -> str:
    shown = f"{value:.4g}" if isinstance(value, (float, np.floating)) else str(value)
    return shown if len(shown) <= 24 else f"{shown[:23]}..."


def _is_wide(values: np.ndarray) -> bool:
    known = values[np.isfinite(values)]
    return bool(known.size) and bool(known.min() > 0.0) and bool(known.max() > LOG_FROM * known.min())


def _figure() -> tuple[Any, Any]:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.2, 3.7), layout="constrained")
    return figure, figure.subplots()


def _png(figure: Any) -> bytes:
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=110)
    return picture.getvalue()
