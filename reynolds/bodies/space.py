"""The discrete body: quadratic elements, their integrals and the nodes of its named faces.

Hexahedra of 27 nodes (quadrilaterals of 9) and quadratic tetrahedra (triangles): none of them locks in bending.
The 20-node hexahedron is not used: on cells that are no parallelepipeds, as in all round bodies, it
loses its order (Arnold, Boffi and Falk 2002) and has four times the error on a thin clamped disc (measured).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import skfem
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
from skfem.quadrature import get_quadrature

from reynolds.bodies.mesh import BodyMesh
from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array

Nodes = NDArray[np.int64]

_HEX = (skfem.ElementHex2(), skfem.ElementQuad2())
_TET = (skfem.ElementTetP2(), skfem.ElementTriP2())
_QUAD = (skfem.ElementQuad2(), skfem.ElementLineP2())
_TRI = (skfem.ElementTriP2(), skfem.ElementLineP2())
_ELEMENTS = {
    skfem.MeshHex1: _HEX, skfem.MeshHex2: _HEX, skfem.MeshTet1: _TET, skfem.MeshTet2: _TET,
    skfem.MeshQuad1: _QUAD, skfem.MeshQuad2: _QUAD, skfem.MeshTri1: _TRI, skfem.MeshTri2: _TRI,
}  # fmt: skip
SAME_PLACE = 1e-9  # of the body's size
ORDER = 4  # stiffness of a straight element is of degree 4 at most; 27 points in a hexahedron


@dataclass(frozen=True)
class Face:
    """A named face: its nodes (n,) in the body, their places (n, dim) m, and its facets.

    facets (facets, local) number the face's own nodes; area (facets, points, dim) is the outward area vector of
    each quadrature point, m2 (with 2 pi r in a section); value (local, points) the shape functions there.
    """

    name: str
    element: skfem.Element
    nodes: Nodes
    places: Array
    facets: Nodes
    area: Array
    value: Array

    def gathered(self, density: Array | float) -> Array:
        """Integral of each face node's shape function times a density (facets | 1, points | 1), (nodes,)."""
        weights = np.broadcast_to(density, self.area.shape[:2]) * np.linalg.norm(self.area, axis=2)
        local = weights @ self.value.T
        total = np.bincount(self.facets.ravel(), weights=local.ravel(), minlength=len(self.nodes))
        return np.asarray(total, dtype=float)

    @property
    def mass(self) -> csc_array:
        """Integral of the products of two shape functions over the face, (nodes, nodes) m2."""
        weights = np.linalg.norm(self.area, axis=2)
        local = np.einsum("aq,bq,fq->fab", self.value, self.value, weights)
        return assembled(self.facets, self.facets, local, (len(self.nodes),) * 2)


@dataclass(frozen=True)
class BodySpace:
    """Nodes and integrals of a body.

    places (nodes, dim) m; cells (cells, local); value (local, points) and gradient (cells, local, dim, points) 1/m
    of the shape functions; volume (cells, points) m3 of each quadrature point (with 2 pi r in a section).
    """

    body: BodyMesh
    basis: skfem.CellBasis
    places: Array
    cells: Nodes
    value: Array
    gradient: Array
    volume: Array

    @property
    def dim(self) -> int:
        """Coordinates of a place: 3, or 2 of an axisymmetric body."""
        return self.places.shape[1]

    @property
    def dofs(self) -> Nodes:
        """Displacements of each cell, dim x node + direction, (cells, local dim)."""
        dofs = self.dim * self.cells[:, :, None] + np.arange(self.dim)
        return dofs.reshape(len(self.cells), -1)

    @property
    def radius(self) -> Array:
        """Distance of the quadrature points from the axis of a section, (cells, points) m."""
        return np.asarray(self.places[self.cells, 0] @ self.value)

    @cached_property
    def mass(self) -> csc_array:
        """Integral of the products of two shape functions over the body, (nodes, nodes) m3."""
        local = np.einsum("aq,bq,eq->eab", self.value, self.value, self.volume, optimize=True)
        return assembled(self.cells, self.cells, local, (len(self.places),) * 2)

    def face(self, name: str) -> Face:
        """The named face; raises FilmInputError for a name that the body does not have."""
        return _face(self, name)


def body_space(body: BodyMesh) -> BodySpace:
    """The discrete body.

    Raises FilmInputError for cells turned inside out or into their neighbours, for points that lie in one place,
    and for a body in several pieces.
    """
    mesh = body.mesh
    if type(mesh) not in _ELEMENTS or (mesh.dim() == 2) != body.axisymmetric:
        expected = "hexahedra or tetrahedra, or the plane section of an axisymmetric body"
        raise FilmInputError("body mesh", f"{type(mesh).__name__} in {mesh.dim()} dimensions", expected)
    basis = skfem.CellBasis(mesh, _ELEMENTS[type(mesh)][0], intorder=ORDER)
    turned = np.linalg.det(np.moveaxis(basis.mapping.DF(basis.X), (0, 1), (-2, -1)))
    if (bad := np.count_nonzero(turned.min(axis=1) * turned.max(axis=1) <= 0.0)) > 0:
        raise FilmInputError("body mesh", f"{bad} cells folded or without volume", "cells of positive volume")
    cells = np.ascontiguousarray(basis.dofs.element_dofs.T)
    places = np.ascontiguousarray(basis.doflocs.T)
    value = np.array([np.broadcast_to(np.asarray(part[0]), basis.dx.shape)[0] for part in basis.basis])
    gradient = np.stack([part[0].grad for part in basis.basis]).transpose(2, 0, 1, 3)
    volume = np.asarray(basis.dx)
    if body.axisymmetric:
        radius = places[cells, 0] @ value
        if radius.min() <= 0.0:
            raise FilmInputError("body mesh", f"radius down to {places[:, 0].min():.4g} m", "a section at r >= 0")
        volume = volume * 2.0 * np.pi * radius
    pattern = coo_array((np.ones(cells.size, dtype=bool), (cells.ravel(), np.repeat(cells[:, 0], cells.shape[1]))))
    pattern.resize((len(places),) * 2)
    if (pieces := connected_components(pattern, directed=False)[0]) > 1:
        raise FilmInputError("body mesh", f"{pieces} pieces", "one body (merge points that lie in one place)")
    _whole(mesh)
    return BodySpace(body, basis, places, cells, value, np.ascontiguousarray(gradient), volume)


def _whole(mesh: skfem.Mesh) -> None:
    """Raise FilmInputError for neighbours on one side of the facet between them, and for points in one place."""
    inner = np.flatnonzero(mesh.f2t[1] >= 0)
    corners = mesh.p[:, mesh.facets[:, inner]]
    middle, along = corners.mean(axis=1), corners[:, 1:] - corners[:, :1]
    normal = np.cross(along[:, 0], along[:, 1], axis=0) if len(mesh.p) == 3 else along[::-1, 0] * [[1.0], [-1.0]]
    sides = [
        np.sign(((mesh.p[:, mesh.t[:, mesh.f2t[side, inner]]].mean(axis=1) - middle) * normal).sum(axis=0))
        for side in (0, 1)
    ]
    if folded := int(np.count_nonzero(sides[0] == sides[1])):
        raise FilmInputError("body mesh", f"{folded} pairs of cells folded into each other", "cells side by side")
    used = np.unique(mesh.t)
    size = float(np.ptp(mesh.p[:, used], axis=1).max())
    if twice := len(cKDTree(mesh.p[:, used].T).query_pairs(SAME_PLACE * size)):
        raise FilmInputError("body mesh", f"{twice} pairs of points in one place", "no cracks (merge them)")


def _face(space: BodySpace, name: str) -> Face:
    mesh = space.body.mesh
    if name not in (mesh.boundaries or {}):
        raise FilmInputError(f"body face {name}", "no such face", f"one of {', '.join(space.body.face_names)}")
    facets = np.asarray(mesh.boundaries[name])
    if len(facets) == 0 or (mesh.f2t[1, facets] >= 0).any():
        raise FilmInputError(f"body face {name}", "facets inside the body, or none", "facets of its surface")
    owner = mesh.f2t[0, facets]
    element = _ELEMENTS[type(mesh)][1]
    local = _local_facets(space)
    which = np.argmax(mesh.t2f[:, owner] == facets, axis=0)
    joined = space.cells[owner[:, None], local[which]]
    nodes, numbers = np.unique(joined, return_inverse=True)
    numbers = numbers.reshape(joined.shape)
    value, area = _measured(space, element, joined, space.places[space.cells[owner]].mean(axis=1))
    return Face(name, element, nodes, space.places[nodes], numbers, area, value)


def _local_facets(space: BodySpace) -> Nodes:
    """A cell's own numbers of the nodes of each of its facets, in the order of the facet's element."""
    reference = space.body.mesh.elem.refdom
    corners = reference.nnodes
    if space.dim == 2:
        return np.array([[a, b, corners + k] for k, (a, b) in enumerate(reference.facets)])
    edge = {frozenset(pair): corners + k for k, pair in enumerate(reference.edges)}
    facets = [
        [*loop, *(edge[frozenset(pair)] for pair in zip(loop, [*loop[1:], loop[0]], strict=True))]
        for loop in reference.facets
    ]
    if corners == 8:  # a hexahedron has a node in the middle of each facet too
        facets = [[*nodes, corners + len(edge) + k] for k, nodes in enumerate(facets)]
    return np.array(facets)


def tabulated(element: skfem.Element, points: Array, count: int) -> tuple[Array, Array]:
    """Shape functions (count, n) and slopes (dim, count, n) at reference points (dim, n)."""
    values, slopes = zip(*(element.lbasis(points, i) for i in range(count)), strict=True)
    value = np.array([np.broadcast_to(v, points.shape[1:]) for v in values])
    return value, np.array([np.broadcast_to(s, points.shape) for s in slopes]).transpose(1, 0, 2)


def _measured(space: BodySpace, element: skfem.Element, joined: Nodes, inside: Array) -> tuple[Array, Array]:
    points, weights = get_quadrature(element.refdom, ORDER)
    value, slope = tabulated(element, points, joined.shape[1])
    corners = space.places[joined]
    tangent = np.einsum("daq,fak->fqdk", slope, corners)
    if space.dim == 3:
        area = np.cross(tangent[:, :, 0], tangent[:, :, 1])
    else:
        radius = np.einsum("aq,fa->fq", value, corners[:, :, 0])
        area = tangent[:, :, 0, ::-1] * np.array([1.0, -1.0]) * 2.0 * np.pi * radius[:, :, None]
    away = corners.mean(axis=1) - inside
    outward = np.sign((area.sum(axis=1) * away).sum(axis=1))
    return value, area * weights[None, :, None] * outward[:, None, None]


def assembled(rows: Nodes, columns: Nodes, local: Array, shape: tuple[int, int]) -> csc_array:
    """Sum of element matrices (cells, rows, columns)."""
    i = np.broadcast_to(rows[:, :, None], local.shape).astype(np.int32).ravel()
    j = np.broadcast_to(columns[:, None, :], local.shape).astype(np.int32).ravel()
    return csc_array(coo_array((local.ravel(), (i, j)), shape=shape))
