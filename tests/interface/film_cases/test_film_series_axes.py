"""Logarithmic axes of a study have numbers that do not lie on each other."""

from itertools import pairwise

import numpy as np
import pytest
import xarray

from swashfilm.output.touch.panels import layout_of, panels_of
from swashfilm.runs.film.series.plots import number_plot


@pytest.mark.parametrize(
    ("low", "high", "count", "shown"),
    [(5e-6, 50e-6, 40, ["5", "10", "20", "50"]), (1e-6, 500e-6, 9, ["1", "2", "5", "10"]), (6e-6, 9e-6, 5, ["6", "9"])],
)
def test_numbers_of_a_logarithmic_axis_stand_apart(low, high, count, shown):
    gap, mu = np.geomspace(low, high, count), np.array([0.01, 0.03, 0.1])
    coordinates = {"constants.gap": ("constants.gap", gap, {"units": "m"}), "film.viscosity": ("film.viscosity", mu)}
    load = xarray.DataArray(np.outer(1.0 / gap**2, mu), coords=coordinates, dims=("constants.gap", "film.viscosity"))
    figure = number_plot(load.to_dataset(name="load_N"), "load_N")
    figure.canvas.draw()
    axis = figure.axes[0].xaxis
    drawn = [label for label in (*axis.get_ticklabels(), *axis.get_ticklabels(minor=True)) if label.get_text()]
    left, right = figure.axes[0].get_window_extent().intervalx
    boxes = [label.get_window_extent() for label in drawn]
    seen = sorted(
        (box.x0, box.x1, label.get_text())
        for box, label in zip(boxes, drawn, strict=True)
        if left <= box.x1 and box.x0 <= right
    )
    assert {*shown} <= {text for *_, text in seen}
    assert all(one[1] < other[0] for one, other in pairwise(seen))
    assert layout_of(figure, panels_of(figure))["xaxis"]["type"] == "log"
