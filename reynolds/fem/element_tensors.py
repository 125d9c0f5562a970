"""Element tensors of a mesh: the geometry's part of the operators, once for each shape of cell.

Cells of one shape share their tensors, so that a regular mesh has a handful of them however fine it is; where no
two cells are alike each has its own. Assembly is then field times tensor, summed into a fixed pattern.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from reynolds.fem import element_tensor_kernels as kernels
from reynolds.numerics.array_kernels import largest
from reynolds.numerics.arrays import Array

PARALLEL = 1e-6  # of a cell's size, by which opposite sides may differ
SAME = 1e-10  # of the largest cell: corners nearer than this are at the same place of a shape


@dataclass(frozen=True)
class ElementTensors:
    """Tensors of the shapes and the shape of each cell (cells,).

    pairs (shapes, pairs, points): g_i g_j times the area element for i < j in the order of np.triu_indices, and
    its xx, yy and (doubled) xy part, with the steep gradients g of the conductance; gradient and steep_gradient
    (shapes, points, basis, 2) m: the area element times each gradient; parallel (shapes,): 1 for parallelograms,
    0 for other shapes.
    """

    shape: NDArray[np.int32]
    pairs_xx: Array
    pairs_yy: Array
    pairs_xy: Array
    pairs: Array
    gradient: Array
    steep_gradient: Array
    parallel: Array


def element_tensors(
    vertices: Array,
    cells: NDArray[np.int32],
    gradient: Array,
    geometry: Array,
    steep: Array,
    steep_geometry: Array,
    weights: Array,
) -> ElementTensors:
    """Tensors of cells (cells, corners) between vertices (n, 2) m; tables of `ReferenceElement`."""
    shape, first = _shapes(vertices[cells])
    cells, points, basis = cells[first], len(weights), gradient.shape[1]
    weighted, steeply = (np.empty((len(first), points, basis, 2)) for _ in range(2))
    kernels.weighted_gradients(vertices, cells, gradient, geometry, weights, weighted)
    kernels.weighted_gradients(vertices, cells, steep, steep_geometry, weights, steeply)
    xx, yy, xy, both = (np.empty((len(first), basis * (basis - 1) // 2, points)) for _ in range(4))
    kernels.products(vertices, cells, steep_geometry, weights, steeply, xx, yy, xy, both)
    return ElementTensors(shape, xx, yy, xy, both, weighted, steeply, _parallel(vertices[cells]))


def stretched(tensors: ElementTensors, scale: Array, steep_scale: Array) -> ElementTensors:
    """Tensors of a film whose lengths are `scale` (cells, points) those of its map, each cell a shape of its own.

    Area times a gradient grows with the scale, area times two gradients does not. `steep_scale`: at the steep ones.
    """
    of = tensors.shape
    return replace(
        tensors,
        shape=np.arange(len(of), dtype=np.int32),
        pairs_xx=tensors.pairs_xx[of],
        pairs_yy=tensors.pairs_yy[of],
        pairs_xy=tensors.pairs_xy[of],
        pairs=tensors.pairs[of],
        gradient=tensors.gradient[of] * scale[:, :, None, None],
        steep_gradient=tensors.steep_gradient[of] * steep_scale[:, :, None, None],
        parallel=tensors.parallel[of],
    )


def _parallel(corners: Array) -> Array:
    """1 where the corners (cells, corners, 2) are those of a parallelogram, else 0."""
    if corners.shape[1] != 4:
        return np.zeros(len(corners))
    skew = np.abs(corners[:, 0] - corners[:, 1] + corners[:, 2] - corners[:, 3]).max(axis=1)
    return (skew <= PARALLEL * np.ptp(corners, axis=1).max(axis=1)).astype(float)


def _shapes(corners: Array) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
    """Number of each cell's shape (cells,), and a cell of each shape."""
    edges = (corners[:, 1:] - corners[:, :1]).reshape(len(corners), -1)
    near = SAME * largest(edges.ravel())
    # One number a shape: a fixed combination of its edges, rounded. Of many cells some have it by chance.
    key = np.rint(edges / near) @ np.sqrt(np.arange(2.0, 2.0 + edges.shape[1]))
    _, first, shape = np.unique(np.rint(key), return_index=True, return_inverse=True)
    own = kernels.part(edges, first, shape, near)
    return shape.astype(np.int32), np.concatenate([first, own])
