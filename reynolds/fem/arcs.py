"""Arcs of circles among the boundary edges of a film mesh, and the middles of their edges on them."""

import numpy as np
import skfem
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array

WINDOW = 5  # vertices in a row that must lie on one circle
OFF = 0.02  # of an edge's rise over its chord: largest distance of a vertex from the circle
FLATTEST = 1e-7  # rise over length of an edge; flatter ones are straight
WIDEST = np.radians(46.0)  # largest angle of an edge: a polygon of fewer than eight edges is no circle


def arc_middles(mesh: skfem.Mesh) -> tuple[NDArray[np.int64], Array]:
    """Boundary facets that lie on circles, and the middles (2, facets) m of their arcs.

    An edge lies on a circle where five vertices in a row do, within a fiftieth of its rise over the chord.
    """
    facets, middles = [np.zeros(0, dtype=np.int64)], [np.zeros((2, 0))]
    for loop, edges in _loops(mesh):
        count = len(loop)
        if count < WINDOW:
            continue
        around = (np.arange(count)[:, None] + np.arange(WINDOW)) % count
        centre, radius, sound = _circles(mesh.p[:, loop].T[around])
        chords = 0.5 * (mesh.p[:, loop] + mesh.p[:, np.roll(loop, -1)]).T
        total, hits = np.zeros((count, 2)), np.zeros(count)
        for k in range(WINDOW - 1):  # edge k of each window
            edge = around[sound, k]
            out = chords[edge] - centre[sound]
            reach = radius[sound] / np.hypot(out[:, 0], out[:, 1])
            np.add.at(total, edge, centre[sound] + reach[:, None] * out)
            np.add.at(hits, edge, 1.0)
        on = hits > 0.0
        facets.append(edges[on])
        middles.append((total[on] / hits[on, None]).T)
    return np.concatenate(facets), np.concatenate(middles, axis=1)


def _loops(mesh: skfem.Mesh) -> list[tuple[NDArray[np.int64], NDArray[np.int64]]]:
    """Boundary loops: vertices in a row, and the facet from each vertex to the next; loops that touch are left out."""
    boundary = mesh.boundary_facets()
    beside: dict[int, list[tuple[int, int]]] = {}
    for facet, (a, b) in zip(boundary.tolist(), mesh.facets[:, boundary].T.tolist(), strict=True):
        beside.setdefault(a, []).append((b, facet))
        beside.setdefault(b, []).append((a, facet))
    found, seen = [], set[int]()
    for first in beside:
        vertices, facets, at = list[int](), list[int](), first
        while at not in seen and len(beside[at]) == 2:
            seen.add(at)
            vertices.append(at)
            following, facet = next(one for one in beside[at] if not facets or one[1] != facets[-1])
            facets.append(facet)
            at = following
        if vertices and at == first:
            found.append((np.array(vertices), np.array(facets)))
    return found


def _circles(points: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Circles of least squares through the points (windows, n, 2): centre, radius, and whether all lie on it."""
    middle = points.mean(axis=1, keepdims=True)
    place = points - middle
    size = np.abs(place).max(axis=(1, 2), keepdims=True)
    place = place / size
    rows = np.concatenate([2.0 * place, np.ones((*place.shape[:2], 1))], axis=2)
    fit = np.einsum("wij,wj->wi", np.linalg.pinv(rows), np.sum(place**2, axis=2))
    radius = np.sqrt(np.maximum(fit[:, 2] + np.sum(fit[:, :2] ** 2, axis=1), 0.0))
    distance = np.hypot(*(place - fit[:, None, :2]).transpose(2, 0, 1))
    steps = np.diff(place, axis=1)
    length = np.hypot(steps[..., 0], steps[..., 1])
    half = np.arcsin(np.minimum(0.5 * length / np.maximum(radius, 1e-300)[:, None], 1.0))
    rise = radius * (1.0 - np.cos(half.max(axis=1)))
    turns = steps[:, :-1, 0] * steps[:, 1:, 1] - steps[:, :-1, 1] * steps[:, 1:, 0]
    sound = np.abs(distance - radius[:, None]).max(axis=1) <= OFF * rise
    sound &= (rise > FLATTEST * length.max(axis=1)) & (2.0 * half.max(axis=1) < WIDEST)
    sound &= (turns > 0.0).all(axis=1) | (turns < 0.0).all(axis=1)
    return fit[:, :2] * size[:, 0] + middle[:, 0], radius * size[:, 0, 0], sound
