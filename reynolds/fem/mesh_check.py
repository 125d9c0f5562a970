"""Checks of a film mesh from a file: all faults of its points and cells at once."""

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array

Cells = NDArray[np.int64]

FLATTEST = 1e-12  # least corner area of a cell / square of its longest edge: below it round-off decides the sign
NEAREST = 1e-9  # least distance of two points / size of the mesh


def mesh_faults(points: Array, cells: Cells) -> list[str]:
    """Faults of plane points (n, 2) m and cells (cells, 3 | 4); empty for a valid film mesh.

    Faults: cells with points that do not exist, points in no cell or without coordinates, cells without area or crossed
    or not convex, overlapping cells, coincident points. Cells may be numbered either way round.
    """
    if cells.min() < 0 or cells.max() >= len(points):
        return [f"cells name points up to number {cells.max()}, of {len(points)} (from 0)"]
    found = []
    if loose := len(points) - len(np.unique(cells)):
        found.append(f"{loose} points in no cell (gmsh: SaveAll = 0 leaves them out)")
    if not np.isfinite(points).all():
        return [*found, f"{np.count_nonzero(~np.isfinite(points).all(axis=1))} points without finite coordinates"]
    corner = corner_areas(points, cells)
    bad = (corner.min(axis=1) * corner.max(axis=1) <= 0.0) | (np.abs(corner).min(axis=1) < FLATTEST)
    if bad.any():
        found.append(f"{bad.sum()} cells without area, crossed or not convex, the first {_at(points, cells, bad)}")
    else:
        found += _overlaps(points, np.where(corner[:, :1] < 0.0, cells[:, ::-1], cells))
    if pairs := _coincident(points[np.unique(cells)]):
        found.append(f"{pairs} points in the place of another, where the film would be cut (merge them)")
    return found


def corner_areas(points: Array, cells: Cells) -> Array:
    """Cross product of the two edges at each corner over the square of the cell's longest edge, (cells, corners).

    Of one sign throughout a cell where it is convex, which makes its map from the reference cell one to one.
    """
    corners = points[cells]
    ahead = np.roll(corners, -1, axis=1) - corners
    behind = np.roll(corners, 1, axis=1) - corners
    cross = ahead[..., 0] * behind[..., 1] - ahead[..., 1] * behind[..., 0]
    longest = (ahead**2).sum(axis=2).max(axis=1)
    return np.asarray(cross / np.where(longest > 0.0, longest, 1.0)[:, None])


def _overlaps(points: Array, cells: Cells) -> list[str]:
    """Fault of overlapping cells: else anticlockwise cells pass an edge only once in each direction."""
    first, second = cells.ravel(), np.roll(cells, -1, axis=1).ravel()
    _, where, count = np.unique(first * len(points) + second, return_inverse=True, return_counts=True)
    shared = (count[where] > 1).reshape(cells.shape).any(axis=1)
    if not shared.any():
        return []
    return [f"{shared.sum()} cells that lie on each other, the first {_at(points, cells, shared)}"]


def _coincident(points: Array) -> int:
    places = np.round((points - points.min(axis=0)) / (NEAREST * np.ptp(points, axis=0).max()))
    return len(points) - len(np.unique(places, axis=0))


def _at(points: Array, cells: Cells, which: NDArray[np.bool_]) -> str:
    x, y = points[cells[int(np.argmax(which))]].mean(axis=0)
    return f"about x = {x:.4g} m, y = {y:.4g} m"
