"""Meshes of a size that a page can hold."""

from __future__ import annotations

import numpy as np

from reynolds.numerics.arrays import Array

GROWTH = 1.1
"""Factor between trials of the spacing."""


def triangles(cells: np.ndarray) -> np.ndarray:
    """Return cells of three or four corners as triangles (n, 3)."""
    if cells.shape[1] == 3:
        return cells
    return np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])


def coarsened(points: Array, corners: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Return at most `most` of the vertices (n, d) by number, and triangles (m, 3) between them.

    Vertices in one cube of an even grid become the one next to their mean, so that values at kept vertices are
    those of the whole mesh. Source: vertex clustering, Rossignac and Borrel 1993.
    """
    if len(points) <= most:
        return np.arange(len(points)), corners
    low = points.min(axis=0)
    spacing = float(np.max(np.ptp(points, axis=0))) / most
    while True:
        _, cube = np.unique(np.floor((points - low) / spacing).astype(int), axis=0, return_inverse=True)
        cube = cube.ravel()
        if cube.max() < most:
            break
        spacing *= GROWTH
    count = np.bincount(cube)
    mean = np.stack([np.bincount(cube, column) / count for column in points.T], axis=1)
    away = np.linalg.norm(points - mean[cube], axis=1)
    order = np.lexsort((away, cube))
    kept = order[np.searchsorted(cube[order], np.arange(len(count)))]
    found = cube[corners]
    whole = (found[:, 0] != found[:, 1]) & (found[:, 1] != found[:, 2]) & (found[:, 2] != found[:, 0])
    return kept, found[whole]
