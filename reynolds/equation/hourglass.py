"""Reduced hourglass stiffness of bilinear quadrilaterals, limited so that the matrix stays an M-matrix.

Gradients at its corners (`reference_element.ReferenceElement`) make a cell too stiff against its hourglass mode,
the pressures g = (1, -1, 1, -1) of its corners. With s the least and S the sum of the couplings of its four sides,

    K_cell = sum over corners k grad f_i . grad f_j - t g_i g_j,    t = max(0, min(S/6, s))

In a uniform film K is then the exact integral for rectangles of sides up to 1 to sqrt 2. Cells without parallel
sides keep t = 0, since there a linear pressure has a part of the mode. Mode: Flanagan and Belytschko 1981.
"""

import numpy as np
from numpy.typing import NDArray

from reynolds.equation import hourglass_kernels as kernels
from reynolds.equation.coefficients import Tensor
from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array


def has_hourglass_mode(space: FilmSpace) -> bool:
    """True for bilinear quadrilaterals."""
    return space.dofs.shape[1] == 4


def as_one(space: FilmSpace, tensor: Tensor) -> tuple[Array, Array, tuple[int, ...]]:
    """Field (cells, n), its pairs (shapes, pairs, n) of `ElementTensors`, and the numbers up to n.

    n is the number of points, or three times that for a tensor (xx, yy, xy) not the same in all directions.
    """
    xx, yy, xy = tensor
    tensors, points = space.tensors, space.reference.loops[1]
    if xx is yy:
        return space.everywhere(xx), tensors.pairs, points
    fields = np.hstack([space.everywhere(part) for part in (xx, yy, xy)])
    pairs = np.concatenate([tensors.pairs_xx, tensors.pairs_yy, tensors.pairs_xy], axis=2)
    return fields, np.ascontiguousarray(pairs), tuple(range(3 * len(points)))


def hourglass_slope(space: FilmSpace, conductance: Tensor, slope: Tensor, pressure: Array) -> Array:
    """Flow into corners 0 and 2 and out of 1 and 3 by a growth `slope` of the conductance, (cells, points).

    `conductance` and `slope`: (cells | 1, points | 1), both isotropic or both not; m3/s per unit of the slope's
    variable. Zero on other cells.
    """
    if not has_hourglass_mode(space):
        return np.zeros((1, 1))
    field, pairs, points = as_one(space, conductance)
    grown, _, _ = as_one(space, slope)
    out = np.empty((len(space.dofs), len(points)))
    kernels.changed(space.dofs, space.tensors.shape, pairs, space.tensors.parallel, field, grown, pressure, points, out)
    return np.ascontiguousarray(out.reshape(len(out), -1, len(space.reference.weights)).sum(axis=1))


def saved_heat(space: FilmSpace, conductance: Tensor, pressure: Array) -> Array:
    """Dissipation of the pressure flow by which the reduction lowers each cell, (cells,) W."""
    out = np.zeros(len(space.dofs))
    if has_hourglass_mode(space):
        field, pairs, points = as_one(space, conductance)
        kernels.saved(space.dofs, space.tensors.shape, pairs, space.tensors.parallel, field, pressure, points, out)
    return out


def signs(space: FilmSpace) -> NDArray[np.float64]:
    """1, -1, 1, -1 for the unknowns of a bilinear quadrilateral, zeros for those of other cells, (basis,)."""
    basis = space.dofs.shape[1]
    return np.array([1.0, -1.0, 1.0, -1.0]) if has_hourglass_mode(space) else np.zeros(basis)
