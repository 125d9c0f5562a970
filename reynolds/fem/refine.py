"""A film mesh refined uniformly: every edge halved, names kept, data interpolated."""

from dataclasses import dataclass, replace

import numpy as np
import skfem
from numpy.typing import NDArray

from reynolds.fem.arcs import arc_middles
from reynolds.fem.mesh import FilmMesh
from reynolds.numerics.arrays import Array

THINNEST = 0.25  # of a corner's area: a middle of an edge that leaves less stays on its chord


@dataclass(frozen=True)
class RefinedMesh:
    """A mesh twice as fine as another, with the interpolation of the coarse one's data.

    `parent` (cells,) is the coarse cell of each fine cell; `sources` (vertices, 4) are the coarse vertices whose
    mean a fine vertex is (a vertex four times itself, an edge's ends twice each, a quadrilateral's corners).
    """

    film_mesh: FilmMesh
    parent: NDArray[np.int64]
    sources: NDArray[np.int64]

    def point_data(self, values: Array) -> Array:
        """Data of coarse vertices, interpolated to the fine ones within the coarse cells, (vertices,)."""
        return np.asarray(values, dtype=float)[self.sources].mean(axis=1)

    def cell_data(self, values: Array) -> Array:
        """Data of coarse cells, inherited by the fine ones, (cells,)."""
        return np.asarray(values, dtype=float)[self.parent]


def refine_mesh(film_mesh: FilmMesh) -> RefinedMesh:
    """The mesh with every cell cut into four by the middles of its edges (and of the cell, in quadrilaterals).

    Boundary names and seams are kept: each named edge becomes two. The middle of an edge on a circle (`arcs`) lies on
    it, unless the cells beside it are thinner than the edge's rise over its chord.
    """
    mesh = film_mesh.mesh
    vertices, facets, cells = mesh.p.shape[1], mesh.facets.shape[1], mesh.t.shape[1]
    sources = [np.tile(np.arange(vertices)[:, None], 4), np.repeat(mesh.facets.T, 2, axis=1)]
    corners, middles = mesh.t, vertices + mesh.t2f
    children: list[tuple[NDArray[np.int64], ...]]
    if len(corners) == 3:
        a, b, c = corners
        ab, bc, ac = middles
        children = [(a, ab, ac), (ab, b, bc), (ac, bc, c), (ab, bc, ac)]
    else:
        sources.append(mesh.t.T)
        a, b, c, d = corners
        ab, bc, cd, da = middles
        centre = vertices + facets + np.arange(cells)
        children = [(a, ab, centre, da), (ab, b, bc, centre), (centre, bc, c, cd), (da, centre, cd, d)]
    where = np.concatenate(sources)
    cut = np.ascontiguousarray(np.concatenate([np.vstack(child) for child in children], axis=1))
    fine = type(mesh)(np.ascontiguousarray(_rounded(mesh, mesh.p[:, where].mean(axis=2), cut)), cut)
    halves = {name: _halves(mesh, fine, np.asarray(on)) for name, on in (mesh.boundaries or {}).items()}
    named = replace(fine, _boundaries=halves)
    return RefinedMesh(FilmMesh(named, film_mesh.seams), np.tile(np.arange(cells), 4), where)


def _rounded(mesh: skfem.Mesh, points: Array, cut: NDArray[np.int64]) -> Array:
    """Points (2, n) of the fine cells `cut` (corners, cells), the middles of edges on circles moved onto them."""
    facets, middles = arc_middles(mesh)
    nodes = mesh.p.shape[1] + facets
    moved = points.copy()
    moved[:, nodes] = middles
    left = _corner_areas(moved, cut) / _corner_areas(points, cut)
    thin = np.intersect1d(cut[:, (left < THINNEST).any(axis=0)], nodes)
    moved[:, thin] = points[:, thin]
    return moved


def _corner_areas(points: Array, cells: NDArray[np.int64]) -> Array:
    """Signed area of the parallelogram at each corner of each cell, (corners, cells)."""
    place = points[:, cells]
    ahead, behind = np.roll(place, -1, axis=1) - place, np.roll(place, 1, axis=1) - place
    return np.asarray(ahead[0] * behind[1] - ahead[1] * behind[0])


def _halves(mesh: skfem.Mesh, fine: skfem.Mesh, on: NDArray[np.int64]) -> NDArray[np.int64]:
    """Fine facets that the coarse facets `on` fall into."""
    vertices = mesh.p.shape[1]
    size = fine.p.shape[1]
    keys = np.sort(fine.facets, axis=0)
    keys = keys[0] * size + keys[1]
    order = np.argsort(keys)
    # Both halves run from a coarse vertex to the edge's middle, whose number is larger.
    wanted = (mesh.facets[:, on] * size + vertices + on).ravel()
    return np.sort(order[np.searchsorted(keys, wanted, sorter=order)])
