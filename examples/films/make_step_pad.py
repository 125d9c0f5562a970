"""Writes step_pad.vtu: a 10 mm x 10 mm pad of 40 x 2 quadrilaterals, 20 um deep up to x = 7 mm, 10 um after."""

from pathlib import Path

import meshio
import numpy as np

cells_x, cells_y = 40, 2
x, y = np.meshgrid(np.linspace(0.0, 10e-3, cells_x + 1), np.linspace(0.0, 10e-3, cells_y + 1))
corner = np.arange(x.size).reshape(x.shape)
quads = np.stack([corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]], axis=-1).reshape(-1, 4)
middle = x.ravel()[quads].mean(axis=1)
meshio.write_points_cells(
    Path(__file__).with_name("step_pad.vtu"),
    np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)]),
    [("quad", quads)],
    cell_data={"film_thickness": [np.where(middle < 7e-3, 20e-6, 10e-6)]},
)
