"""Pictures of a response table: its error by output, held-out points, and its course over each input."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import numpy as np

from gaps.response import Response, Spacing
from system.response_tables import LARGE_ERROR
from system.table_means import GAP_PAIRS, OF_EVERY_GAP

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLOURS = {"piston": "#3c7a8c", "slipper": "#8c5a3c", "valve_plate": "#5b9a5b"}
INPUTS = {
    "shaft_speed": (30.0 / np.pi, "shaft speed / (r/min)"),
    "delivery_pressure": (1e-6, "delivery pressure, gauge / MPa"),
    "displacement_ratio": (1.0, "displacement ratio"),
    "viscosity": (1e3, "viscosity / (mPa s)"),
}
COURSE = 80
"""Points of a line."""


def table_plots(response: Response) -> dict[str, bytes]:
    """Captions and PNGs of a table's pictures."""
    return {
        "Error of held-out points, rms and largest; dashed: the limit from which an output is warned of": _errors(
            response
        ),
        "Held-out points, solved and by the table": _parity(response),
        "Course over each input through the middle of the box: ratios to the lumped law; dots: held-out points, "
        "wherever the other inputs stand": _courses(response),
    }


def _words(name: str) -> str:
    return name.replace(".", ", ").replace("_", " ")


def _errors(response: Response) -> bytes:
    figure = _figure(9.0, 4.8)
    axes = figure.subplots()
    names = [_words(output.name) for output in response.outputs]
    error, rows = response.held_out_error, np.arange(len(names))
    axes.barh(rows - 0.2, np.maximum(error.largest, 1e-6), 0.38, color="#c8a27c", label="largest")
    axes.barh(rows + 0.2, np.maximum(error.rms, 1e-6), 0.38, color="#3c7a8c", label="rms")
    axes.axvline(LARGE_ERROR, color="#b55a00", linestyle="--")
    axes.set_yticks(rows, [f"{n} ({o.measure.value})" for n, o in zip(names, response.outputs, strict=True)])
    axes.set(xscale="log", xlabel="error", xlim=(1e-5, max(0.1, 1.3 * float(error.largest.max()))))
    axes.tick_params(axis="y", labelsize=8)
    axes.invert_yaxis()
    axes.legend(loc="lower right")
    axes.grid(visible=True, axis="x", alpha=0.3)
    return _png(figure)


def _parity(response: Response) -> bytes:
    figure = _figure(11.0, 2.9)
    solved, told = response.held_out.values, response.at(response.held_out.points)
    columns = {output.name: k for k, output in enumerate(response.outputs)}
    for axes, name in zip(figure.subplots(1, len(OF_EVERY_GAP)), OF_EVERY_GAP, strict=True):
        for gap in GAP_PAIRS:
            k = columns[f"{gap}.{name}"]
            axes.plot(
                solved[:, k], told[:, k], "o", markersize=3.5, alpha=0.8, color=COLOURS[gap], label=_words(gap)
            )
        ends = [*axes.get_xlim(), *axes.get_ylim()]
        axes.plot([min(ends), max(ends)], [min(ends), max(ends)], color="#1c2328", linewidth=0.8)
        axes.set_title(_words(name), fontsize=9)
        axes.set_xlabel("solved", fontsize=8)
        axes.tick_params(labelsize=7)
    figure.axes[0].set_ylabel("by the table", fontsize=8)
    figure.axes[0].legend(fontsize=7)
    return _png(figure)


def _courses(response: Response) -> bytes:
    figure = _figure(11.0, 9.0)
    grid = figure.subplots(len(OF_EVERY_GAP), len(response.axes), sharey="row")
    columns = {output.name: k for k, output in enumerate(response.outputs)}
    middle = np.array([float(axis.from_unit(np.array(0.5))) for axis in response.axes])
    for j, axis in enumerate(response.axes):
        scale, label = INPUTS[axis.name]
        along = np.tile(middle, (COURSE, 1))
        along[:, j] = axis.from_unit(np.linspace(0.0, 1.0, COURSE))
        told = response.at(along)
        for i, name in enumerate(OF_EVERY_GAP):
            axes = grid[i, j]
            for gap in GAP_PAIRS:
                k = columns[f"{gap}.{name}"]
                axes.plot(scale * along[:, j], told[:, k], color=COLOURS[gap], label=_words(gap))
                dots = response.held_out
                axes.plot(scale * dots.points[:, j], dots.values[:, k], ".", color=COLOURS[gap], alpha=0.35)
            if axis.spacing is Spacing.LOGARITHMIC:
                _logarithmic(axes)
            axes.grid(visible=True, alpha=0.3)
            axes.tick_params(labelsize=7, which="both")
        grid[-1, j].set_xlabel(label, fontsize=8)
    for i, name in enumerate(OF_EVERY_GAP):
        grid[i, 0].set_ylabel(_words(name), fontsize=9)
    figure.legend(*grid[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3, fontsize=8)
    return _png(figure)


def _logarithmic(axes: Any) -> None:
    """Logarithms along x, plain numbers at 1, 2, 5, 10, .."""
    from matplotlib.ticker import LogLocator, NullFormatter, ScalarFormatter

    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.xaxis.set_minor_formatter(NullFormatter())


def _figure(width: float, height: float) -> Figure:
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def _png(figure: Any) -> bytes:
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=110)
    return picture.getvalue()
