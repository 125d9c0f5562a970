"""Pictures of `swashfilm reference`: flow through a passage, and its coefficients over the Reynolds number."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.output.figures import figure_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from matplotlib.tri import Triangulation

    from reynolds.stokes.flow import Flow
    from swashfilm.runs.reference.passages import SolvedPassage

MOST_PICTURES = 4
NEAR = 5.0
"""Film thicknesses or diameters on either side of the passage in a picture."""
GRID = 240
MOST_NAMED = 12
RIGHT = {"flow_coefficient": "flow coefficient", "whole_extra_length": "whole extra length / h"}
"""Quantity in the right picture, for a port and for a film."""


def flow_plots(solved: Sequence[SolvedPassage]) -> dict[str, Figure]:
    """Return pictures by file name, of at most MOST_PICTURES passages at their last Reynolds number."""
    return {f"flow_{number}.png": _flow(one) for number, one in enumerate(solved[:MOST_PICTURES], start=1)}


def coefficient_plot(summary: Mapping[str, Any]) -> Figure:
    """Draw the passages' coefficients over the Reynolds number."""
    named = len(summary["passages"]) <= MOST_NAMED
    figure = figure_of(9.0, 3.0 + 0.16 * named * len(summary["passages"]))
    left, right = figure.subplots(1, 2)
    shown, words = next(pair for pair in RIGHT.items() if summary["passages"][0]["rows"][0][pair[0]] is not None)
    for passage in summary["passages"]:
        rows = passage["rows"]
        numbers = [row["reynolds"] for row in rows]
        left.plot(numbers, [row["loss_factor"] for row in rows], "o-", markersize=4, label=passage["words"])
        right.plot(numbers, [row[shown] for row in rows], "o-", markersize=4)
    left.set_ylabel("loss factor")
    right.set_ylabel(words)
    for axes in (left, right):
        axes.set_xlabel("Reynolds number")
        axes.set_xscale("symlog", linthresh=1.0)
        axes.grid(visible=True, alpha=0.3)
    if named:
        figure.legend(loc="outside lower center", ncols=1, fontsize=7)
    return figure


def _flow(one: SolvedPassage) -> Figure:
    """Draw speed and stream lines near the passage, lengths over its film thickness or diameter."""
    flow = one.correction.flow
    x, y, across, along = _window(flow)
    places, u, v = _velocity(flow)
    figure = figure_of(9.0, float(np.clip(9.0 * across / along + 1.2, 2.6, 6.5)))
    axes = figure.subplots()
    shown = axes.tripcolor(places, np.hypot(u, v), shading="gouraud", cmap="viridis")
    figure.colorbar(shown, ax=axes, label="speed / mean", shrink=0.9)
    along_x, along_y = (_on_grid(places, values, x, y) for values in (u, v))
    axes.streamplot(x, y, along_x, along_y, color="white", linewidth=0.5, arrowsize=0.6, density=1.4)
    axes.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]), aspect="equal", xlabel="x / thickness", ylabel="y / thickness")
    axes.set_title(f"{one.passage.words}, Re = {flow.density:g}", fontsize=9)
    return figure


def _window(flow: Flow) -> tuple[Array, Array, float, float]:
    """Return the picture's grid along x and y, and its size across and along."""
    low, high = flow.problem.space.mesh.p.min(axis=1), flow.problem.space.mesh.p.max(axis=1)
    across = high[1] - low[1]
    start, end = max(low[0], -NEAR - across), min(high[0], NEAR + 2.0 * across)
    return np.linspace(start, end, GRID), np.linspace(low[1], high[1], GRID // 2), across, end - start


def _velocity(flow: Flow) -> tuple[Triangulation, Array, Array]:
    """Return the mesh's vertices as triangles, and the velocity there."""
    from matplotlib.tri import Triangulation

    mesh, basis = flow.problem.space.mesh, flow.problem.space.velocity
    u, v = flow.velocity[basis.nodal_dofs]
    corners = mesh.t
    return Triangulation(mesh.p[0], mesh.p[1], np.hstack([corners[[0, 1, 2]], corners[[0, 2, 3]]]).T), u, v


def _on_grid(places: Triangulation, values: Array, x: Array, y: Array) -> Array:
    """Return values at vertices on a grid (len(y), len(x)), masked outside the mesh."""
    from matplotlib.tri import LinearTriInterpolator

    return LinearTriInterpolator(places, values)(*np.meshgrid(x, y))
