"""Logically rectangular meshes, found by walking from cell to cell, for multigrid on lines.

Coordinates are not used: a ring, a stretched or a moved rectangle and one with sewn seams are all grids.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reynolds.fem.space import FilmSpace
from reynolds.linear.multigrid import grid_kernels


@dataclass(frozen=True)
class Grid:
    """The unknowns in lines side by side: `unknowns` (lines, length), each once.

    `around`: the last line is next to the first. Unknowns couple only to their eight neighbours.
    """

    unknowns: NDArray[np.int32]
    around: bool


def grid_of(space: FilmSpace) -> Grid | None:
    """The lines of a linear space (P1 on split quadrilaterals, Q1); None where the mesh has none.

    None too for holes, unknowns tied to a pocket, fewer than three cells around a seam, and films that close on
    themselves both ways. Triangles count as halves of quadrilaterals as scikit-fem cuts them: triangle k with
    triangle k + cells/2. Lines run from side to side of a film that closes on itself, else the shorter way.
    """
    if space.degree != 1:
        return None
    cells = space.dofs if space.dofs.shape[1] == 4 else _joined(space.dofs)
    if cells is None or not len(cells):
        return None
    corners, around_x, around_y = grid_kernels.walk(cells, space.size)
    unknowns = _agreed(corners, around_x, around_y) if corners.size else None
    if unknowns is None or not np.array_equal(np.sort(unknowns.ravel()), np.arange(space.size)):
        return None
    if around_x and around_y:
        return None
    if around_x or (not around_y and unknowns.shape[1] > unknowns.shape[0]):
        unknowns = np.ascontiguousarray(unknowns.T)
    return Grid(unknowns, around_x or around_y)


def _joined(triangles: NDArray[np.int32]) -> NDArray[np.int32] | None:
    """Quadrilaterals (cells, 4) of pairs of triangles that share a side; None where a pair shares none."""
    half = len(triangles) // 2
    if len(triangles) != 2 * half:
        return None
    first, second = triangles[:half], triangles[half:]
    shared = (first[:, :, None] == second[:, None, :]).any(axis=2)
    apart = (second[:, :, None] == first[:, None, :]).any(axis=2)
    if not (np.all(shared.sum(axis=1) == 2) and np.all(apart.sum(axis=1) == 2)):
        return None
    rows, alone = np.arange(half), np.argmin(shared, axis=1)
    corner, left, right = (first[rows, (alone + k) % 3] for k in range(3))
    across = second[rows, np.argmin(apart, axis=1)]
    return np.ascontiguousarray(np.column_stack([corner, left, across, right]))


def _agreed(corners: NDArray[np.int32], around_x: bool, around_y: bool) -> NDArray[np.int32] | None:
    """Unknowns (rows, columns) of the corners of all cells; None where cells side by side do not share them."""
    south_west, south_east, north_east, north_west = np.moveaxis(corners, 2, 0)
    closed_x = south_west[:, :1] if around_x else south_east[:, -1:]
    below = np.hstack([south_west, closed_x])
    top = below[:1] if around_y else np.hstack([north_west[-1:], north_east[-1:, -1:]])
    if around_x and not around_y:
        top = np.hstack([north_west[-1:], north_west[-1:, :1]])
    nodes = np.vstack([below, top])
    joined = (nodes[:-1, :-1], nodes[:-1, 1:], nodes[1:, 1:], nodes[1:, :-1])
    if not all(
        np.array_equal(a, b) for a, b in zip(joined, (south_west, south_east, north_east, north_west), strict=True)
    ):
        return None
    rows, columns = corners.shape[0] + (not around_y), corners.shape[1] + (not around_x)
    return np.ascontiguousarray(nodes[:rows, :columns])
