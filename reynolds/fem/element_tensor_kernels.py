"""Loops over the shapes of cells that make the element tensors, compiled once by numba."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

from reynolds.fem.kernels import _inverse_map

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}


@njit(**_FAST)
def part(edges, first, shape, near):
    """Number cells whose edges differ by more than `near` m from those of the cell first[shape] anew; such cells.

    edges (cells, n) m; each such cell has a shape of its own, after all others.
    """
    own, count = np.empty(len(edges), np.int64), 0
    for e in range(len(edges)):
        like = first[shape[e]]
        for k in range(edges.shape[1]):
            if abs(edges[e, k] - edges[like, k]) > near:
                own[count] = e
                count += 1
                break
    for k in range(count):
        shape[own[k]] = len(first) + k
    return own[:count]


@njit(**_FAST)
def weighted_gradients(places, cells, gradient, geometry, weights, out):
    """out[shape, q, i] = area element times grad f_i (m), of cells with corners cells[shape] among `places` m.

    gradient (points, basis, 2) and geometry (points, corners, 2) are tables on the reference cell.
    """
    for s in range(cells.shape[0]):
        for q in range(weights.shape[0]):
            det, ixx, ixy, iyx, iyy = _inverse_map(places, cells[s], geometry, q)
            area = abs(det) * weights[q]
            for i in range(gradient.shape[1]):
                gx, gy = gradient[q, i, 0], gradient[q, i, 1]
                out[s, q, i, 0] = area * (ixx * gx + ixy * gy)
                out[s, q, i, 1] = area * (iyx * gx + iyy * gy)


@njit(**_FAST)
def products(places, cells, geometry, weights, weighted, xx, yy, xy, both):
    """xx[shape, pair, q] = area element times df_i/dx df_j/dx, i < j, and so on; xy doubled, both = xx + yy.

    weighted (shapes, points, basis, 2) m: of `weighted_gradients`, with the same tables.
    """
    for s in range(cells.shape[0]):
        for q in range(weights.shape[0]):
            det, _, _, _, _ = _inverse_map(places, cells[s], geometry, q)
            area = abs(det) * weights[q]
            pair = 0
            for i in range(weighted.shape[2]):
                xi, yi = weighted[s, q, i, 0] / area, weighted[s, q, i, 1] / area
                for j in range(i + 1, weighted.shape[2]):
                    xj, yj = weighted[s, q, j, 0], weighted[s, q, j, 1]
                    xx[s, pair, q] = xi * xj
                    yy[s, pair, q] = yi * yj
                    xy[s, pair, q] = xi * yj + yi * xj
                    both[s, pair, q] = xi * xj + yi * yj
                    pair += 1
