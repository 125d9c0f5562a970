"""Bilinear quadrilaterals relieved of a resistance to twisting, as far as no coupling turns positive.

Gradients at its corners (`reference.Reference`) make a cell too stiff against the pressures g = (1, -1, 1, -1) of
its corners. With s the least and S the sum of what its four sides couple with,

    K_cell = sum over corners k grad f_i . grad f_j - t g_i g_j,    t = max(0, min(S/6, s))

In a uniform film K is then the exact integral for rectangles of sides up to 1 to sqrt 2. Cells without parallel
sides keep t = 0: to them a linear pressure is twisted. The shape g: Flanagan and Belytschko 1981.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from reynolds.equation import hourglass_kernels as kernels
from reynolds.equation.coefficients import Tensor
from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array


def relieved(space: FilmSpace) -> bool:
    """Whether cells are bilinear quadrilaterals."""
    return space.dofs.shape[1] == 4


def as_one(space: FilmSpace, tensor: Tensor) -> tuple[Array, Array, tuple[int, ...]]:
    """Field (cells, n), its pairs (shapes, pairs, n) as `ElementTensors` has them, and the numbers up to n.

    n is the number of points, or three times that for a tensor (xx, yy, xy) not the same in all directions.
    """
    xx, yy, xy = tensor
    tensors, points = space.tensors, space.reference.loops[1]
    if xx is yy:
        return space.everywhere(xx), tensors.pairs, points
    fields = np.hstack([space.everywhere(part) for part in (xx, yy, xy)])
    pairs = np.concatenate([tensors.pairs_xx, tensors.pairs_yy, tensors.pairs_xy], axis=2)
    return fields, np.ascontiguousarray(pairs), tuple(range(3 * len(points)))


def twisting_slope(space: FilmSpace, conductance: Tensor, slope: Tensor, pressure: Array) -> Array:
    """What a growth of the conductance by `slope` sends into corners 0 and 2 and out of 1 and 3, (cells, points).

    `conductance` and `slope`: (cells | 1, points | 1), alike the same in every direction or not; m3/s per unit of
    what the slope is taken by. Zero on other cells.
    """
    if not relieved(space):
        return np.zeros((1, 1))
    field, pairs, points = as_one(space, conductance)
    grown, _, _ = as_one(space, slope)
    out = np.empty((len(space.dofs), len(points)))
    kernels.changed(
        space.dofs, space.tensors.shape, pairs, space.tensors.parallel, field, grown, pressure, points, out
    )
    return np.ascontiguousarray(out.reshape(len(out), -1, len(space.reference.weights)).sum(axis=1))


def spared(space: FilmSpace, conductance: Tensor, pressure: Array) -> Array:
    """Heat that pressure spends less in each cell than with gradients at its corners, (cells,) W."""
    out = np.zeros(len(space.dofs))
    if relieved(space):
        field, pairs, points = as_one(space, conductance)
        kernels.saved(space.dofs, space.tensors.shape, pairs, space.tensors.parallel, field, pressure, points, out)
    return out


def signs(space: FilmSpace) -> NDArray[np.float64]:
    """1, -1, 1, -1 for the unknowns of a bilinear quadrilateral, zeros for those of other cells, (basis,)."""
    basis = space.dofs.shape[1]
    return np.array([1.0, -1.0, 1.0, -1.0]) if relieved(space) else np.zeros(basis)
