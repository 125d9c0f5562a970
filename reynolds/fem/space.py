"""The discrete film: unknowns, quadrature and the fixed sparsity pattern of one mesh.

Built once for a mesh; films of changing thickness, wall velocity and even moved vertices reuse it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import skfem
from numpy.typing import NDArray
from scipy.sparse import csc_array
from scipy.spatial import cKDTree

from reynolds.errors import FilmInputError
from reynolds.fem import kernels
from reynolds.fem.element_tensors import ElementTensors, element_tensors, stretched
from reynolds.fem.mesh import FilmMesh
from reynolds.fem.reference_element import ELEMENTS, ReferenceElement, reference
from reynolds.fem.ruled_quadrature import Ruling, ruling_of
from reynolds.fem.sparsity import Pattern, pattern_of
from reynolds.fem.sphere import PLANE, Sphere
from reynolds.numerics.arrays import Array

_ONE = np.ones((1, 1))


@dataclass(frozen=True)
class Rim:
    """Facets of all named boundaries, one after another; the cell beside each, its unknowns (2 | 3, facets)."""

    facets: NDArray[np.int64]
    cells: NDArray[np.int64]
    dofs: NDArray[np.int64]


@dataclass(frozen=True)
class FilmSpace:
    """Unknowns and geometry of a film mesh.

    vertices (n, 2) m, cells (cells, corners), dofs (cells, basis) into `size` unknowns; `edge_dofs` and
    `facet_dofs` (2 | 3, facets) give a named boundary's unknowns, sorted, and those of each of its facets.
    `degree` is 1 (P1, Q1) or 2 (P2, Q2). On a `sphere` vertices and points are those of its map; areas, lengths
    and gradients, and with them all fields, those of the sphere.
    """

    film_mesh: FilmMesh
    degree: int
    vertices: Array
    cells: NDArray[np.int32]
    dofs: NDArray[np.int32]
    size: int
    reference: ReferenceElement
    pattern: Pattern
    edge_dofs: Mapping[str, NDArray[np.int64]]
    facet_dofs: Mapping[str, NDArray[np.int64]]
    rim: Rim
    sphere: Sphere = PLANE

    @cached_property
    def area(self) -> Array:
        """Area element of each quadrature point, (cells, points), m2."""
        return self._measured(self.reference.geometry_gradient, self.scale)

    @cached_property
    def steep_area(self) -> Array:
        """Area element at the steep gradients, (cells, points), m2."""
        return self._measured(self.reference.steep_geometry, self.steep_scale)

    @cached_property
    def scale(self) -> Array:
        """Length on the film over length on its map at the quadrature points, (cells | 1, points | 1)."""
        return _ONE if self.sphere.is_plane else self.sphere.scale(*self.points)

    @cached_property
    def steep_scale(self) -> Array:
        """The same at the steep gradients."""
        if self.sphere.is_plane:
            return _ONE
        return self.sphere.scale(*self._places(self.reference.steep_value))

    def on_film(self, gradient: tuple[Array, Array], scale: Array) -> tuple[Array, Array]:
        """Gradient along the film of a gradient along the map (cells, points), by `scale` at its points."""
        return gradient if self.sphere.is_plane else (gradient[0] / scale, gradient[1] / scale)

    def _measured(self, geometry_gradient: Array, scale: Array) -> Array:
        area = np.empty((len(self.cells), len(self.reference.weights)))
        kernels.measure(self.vertices, self.cells, geometry_gradient, self.reference.weights, area)
        return area if self.sphere.is_plane else area * scale**2

    @cached_property
    def share(self) -> Array:
        """Integral of each unknown's basis over the film (size,), m2."""
        return self._lumped(np.ones(self.area.shape))

    def lumped(self, field: Array) -> Array:
        """Integral of a field (cells | 1, points | 1) times each unknown's basis, (size,): its unit times m2."""
        return float(field[0, 0]) * self.share if field.size == 1 else self._lumped(self.everywhere(field))

    def _lumped(self, field: Array) -> Array:
        out = np.empty(self.size)
        kernels.lump(self.dofs, self.reference.value, self.area, field, *self.reference.loops, out)
        return out

    def everywhere(self, field: Array) -> Array:
        """A field (cells | 1, points | 1) at every quadrature point (cells, points), for kernels."""
        shape = self.area.shape
        return field if field.shape == shape else np.ascontiguousarray(np.broadcast_to(field, shape))

    @cached_property
    def tensors(self) -> ElementTensors:
        """The geometry's part of the operators."""
        tables = self.reference
        of_map = element_tensors(
            self.vertices, self.cells, tables.gradient, tables.geometry_gradient, tables.steep_gradient,
            tables.steep_geometry, tables.weights,
        )  # fmt: skip
        return of_map if self.sphere.is_plane else stretched(of_map, self.scale, self.steep_scale)

    @cached_property
    def points(self) -> Array:
        """Coordinates of the quadrature points, (2, cells, points), m."""
        return self._places(self.reference.geometry_value)

    @cached_property
    def points_in_space(self) -> tuple[Array, Array, Array]:
        """Places of the quadrature points in space, x, y, z (cells, points) m; z = 0 in a plane."""
        return self.sphere.place(*self.points)

    @cached_property
    def axial_area(self) -> Array:
        """Area element projected along z, the film's normal at the origin, (cells, points) m2."""
        return self.area if self.sphere.is_plane else self.area * self.axial_share

    @cached_property
    def axial_share(self) -> Array:
        """Share of z in the film's normal at the quadrature points, (cells | 1, points | 1)."""
        return _ONE if self.sphere.is_plane else self.sphere.normal(*self.points)[2]

    def _places(self, shares: Array) -> Array:
        return np.stack([along[self.cells] @ shares.T for along in self.vertices.T])

    @cached_property
    def edge_share(self) -> dict[str, Array]:
        """Integral of each unknown's basis along each named boundary (m), in the order of edge_dofs."""
        return {
            name: self._along(name, np.hypot(*_tangent(self, self.film_mesh.mesh.boundaries[name])))
            for name in self.edge_dofs
        }

    @cached_property
    def edge_normal(self) -> dict[str, Array]:
        """The same integral of basis times outward normal, (unknowns, 2) m; zero on a line inside the film."""
        return {
            name: np.column_stack([self._along(name, n) for n in self._facet_normal[name]]) for name in self.edge_dofs
        }

    @cached_property
    def _facet_normal(self) -> dict[str, Array]:
        ends = np.cumsum([dofs.shape[1] for dofs in self.facet_dofs.values()])[:-1]
        return dict(zip(self.facet_dofs, np.split(self.rim_normal, ends, axis=1), strict=True))

    @cached_property
    def rim_normal(self) -> Array:
        """Outward normal of each facet of `rim` times its length, (2, facets) m."""
        return _outward(self, self.rim.facets)

    @cached_property
    def _rim_length(self) -> Array:
        return np.asarray(np.hypot(*self.rim_normal))

    def edge_outflow(self, flux: tuple[Array, Array]) -> tuple[Array, Array]:
        """Flow (m3/s) out over each facet of all named boundaries, and its greatest possible magnitude.

        (facets,) each, one boundary after another in the order of `facet_dofs`. `flux` (cells | 1, points | 1)
        m2/s; both zero for a line inside the film.
        """
        normal, cells = self.rim_normal, self.rim.cells
        x, y = (np.mean(part if len(part) == 1 else part[cells], axis=1) for part in flux)
        return x * normal[0] + y * normal[1], np.hypot(x, y) * self._rim_length

    def _along(self, name: str, per_facet: Array) -> Array:
        """Trapezium rule for a linear basis, Simpson's for a quadratic one: exact integrals of the basis."""
        facets = self.facet_dofs[name]
        weights = np.array([0.5, 0.5]) if len(facets) == 2 else np.array([1.0, 1.0, 4.0]) / 6.0
        total = np.bincount(facets.ravel(), weights=np.outer(weights, per_facet).ravel(), minlength=self.size)
        return np.asarray(total[self.edge_dofs[name]], dtype=float)

    @cached_property
    def vertex_dofs(self) -> NDArray[np.int32]:
        """Unknown at each vertex (vertices,): scikit-fem numbers a cell's corner unknowns first."""
        found = np.empty(len(self.vertices), dtype=np.int32)
        corners = self.cells.shape[1]
        found[self.cells] = self.dofs[:, :corners]
        return found

    def place(self, unknown: int) -> tuple[float, float]:
        """Place of an unknown, x and y (m); one of many for a tied unknown (seam, pocket)."""
        cell, local = (int(k[0]) for k in np.nonzero(self.dofs == unknown))
        corners = self.vertices[self.cells[cell]]
        geometry = skfem.ElementTriP1() if len(corners) == 3 else skfem.ElementQuad1()
        at = ELEMENTS[type(self.film_mesh.mesh), self.degree][0].doflocs[local][:, None]
        share = np.array([geometry.lbasis(at, corner)[0][0] for corner in range(len(corners))])
        x, y = share @ corners
        return float(x), float(y)

    def sample(self, field: Callable[[Array, Array], Array | float] | float) -> Array:
        """A field at the quadrature points: a function of x, y (m) or a constant; (cells|1, points|1)."""
        if callable(field):
            x, y = self.points
            return np.ascontiguousarray(np.broadcast_to(field(x, y), x.shape), dtype=float)
        return np.full((1, 1), float(field))

    @cached_property
    def ruling(self) -> Ruling | None:
        """The rows and columns of the quadrature points; None where they have none."""
        return ruling_of(self.points)

    def sample_ruled(self, field: Callable[[Array, Array], Array | float]) -> Array:
        """As `sample`, for a formula that numpy may broadcast: see `ruled_quadrature`."""
        return self.sample(field) if self.ruling is None else self.ruling.sample(field)

    def sample_vertices(self, nodal: Array) -> Array:
        """A continuous field given at the vertices (vertices,) at the quadrature points."""
        return np.ascontiguousarray(np.asarray(nodal, dtype=float)[self.cells] @ self.reference.geometry_value.T)

    def sample_cells(self, per_cell: Array) -> Array:
        """A field constant in each cell (cells,), which jumps between cells, as (cells, 1)."""
        return np.ascontiguousarray(np.asarray(per_cell, dtype=float)[:, None])

    def to_vertices(self, field: Array) -> Array:
        """Field at quadrature points -> vertices, exact for a linear field; jumps are averaged (plots)."""
        return self._average(field, self.reference.to_corners, self.cells, len(self.vertices))

    def to_unknowns(self, field: Array) -> Array:
        """Field at quadrature points -> unknowns (size,), exact for a field of the space; jumps are averaged."""
        return self._average(field, self.reference.to_basis, self.dofs, self.size)

    def _average(self, field: Array, inverse: Array, numbers: NDArray[np.int32], size: int) -> Array:
        local = np.broadcast_to(field, self.area.shape) @ inverse.T
        total = np.bincount(numbers.ravel(), weights=local.ravel(), minlength=size)
        return total / np.maximum(np.bincount(numbers.ravel(), minlength=size), 1)

    def moved(self, vertices: Array) -> FilmSpace:
        """The same topology and pattern with other vertex coordinates, (vertices, 2) m; else FilmInputError."""
        if np.shape(vertices) != self.vertices.shape or not np.isfinite(vertices).all():
            raise FilmInputError("moved vertices", f"an array of shape {np.shape(vertices)}", "a place for each vertex")
        return replace(self, vertices=np.ascontiguousarray(vertices))

    def matrix(self, data: Array) -> csc_array:
        """Upper triangle of the operator with these entries."""
        upper = copy(self.pattern.empty)
        upper.data = data
        return upper


def film_space(
    film_mesh: FilmMesh, *, degree: int = 1, pockets: Iterable[str] = (), sphere: Sphere = PLANE
) -> FilmSpace:
    """The discrete film on a mesh, of a plane or of a sphere's map: P1/Q1 (degree 1) or P2/Q2 (degree 2).

    Afterwards seams are sewn (both sides have the same unknowns) and each boundary named in `pockets` is one
    unknown: a pocket, groove or chamber of uniform pressure. Raises FilmInputError for another degree or mesh, a
    seam whose sides do not match under a translation and a pocket whose name is not in the mesh.
    """
    mesh = film_mesh.mesh
    if (type(mesh), degree) not in ELEMENTS:
        found = f"degree {degree} on a {type(mesh).__name__}"
        raise FilmInputError("film_space", found, "degree 1 or 2 on MeshTri or MeshQuad of straight cells")
    element, order = ELEMENTS[type(mesh), degree]
    # Only the numbering is used: the basis is tabulated in one element.
    dofs = skfem.Basis(mesh, element, intorder=order, elements=np.array([0]))
    tied = _tie(film_mesh, dofs, tuple(pockets))
    numbers, joined = np.unique(tied, return_inverse=True)
    cell_dofs = joined[dofs.dofs.element_dofs.T].astype(np.int32)
    facet_dofs = _facet_dofs(film_mesh, dofs, joined)
    return FilmSpace(
        film_mesh=film_mesh,
        degree=degree,
        vertices=np.ascontiguousarray(mesh.p.T),
        cells=np.ascontiguousarray(mesh.t.T, dtype=np.int32),
        dofs=np.ascontiguousarray(cell_dofs),
        size=len(numbers),
        reference=reference(mesh, element, dofs.X, dofs.W),
        pattern=pattern_of(cell_dofs, len(numbers)),
        edge_dofs={name: np.unique(on) for name, on in facet_dofs.items()},
        facet_dofs=facet_dofs,
        rim=_rim(film_mesh, degree, facet_dofs),
        sphere=sphere,
    )


def _tie(film_mesh: FilmMesh, basis: skfem.Basis, pockets: tuple[str, ...]) -> NDArray[np.int64]:
    """Leader of each unknown: itself, or the one it is tied to by a seam or a pocket."""
    leader = np.arange(basis.N)
    mesh = film_mesh.mesh
    for master, slave in film_mesh.seams:
        first = basis.get_dofs(mesh.boundaries[master]).flatten()
        second = basis.get_dofs(mesh.boundaries[slave]).flatten()
        shift = basis.doflocs[:, second].mean(axis=1) - basis.doflocs[:, first].mean(axis=1)
        near = 1e-6 * np.ptp(basis.doflocs, axis=1).max()
        if len(first) != len(second):
            raise FilmInputError(
                f"seam {master}/{slave}", f"{len(first)} and {len(second)} nodes", "two sides that match"
            )
        distance, partner = cKDTree(basis.doflocs[:, first].T).query((basis.doflocs[:, second] - shift[:, None]).T)
        if distance.max() > near or len(np.unique(partner)) != len(partner):
            raise FilmInputError(
                f"seam {master}/{slave}", f"nodes up to {distance.max():.3g} m apart", "two sides that match"
            )
        leader[second] = leader[first[partner]]
    leader = leader[leader]
    for name in pockets:
        if name not in (mesh.boundaries or {}):
            raise FilmInputError(f"pocket {name}", "no such boundary", f"one of {film_mesh.boundary_names}")
        members = leader[basis.get_dofs(mesh.boundaries[name]).flatten()]
        leader[np.isin(leader, members)] = members.min()
    return leader


def _facet_dofs(film_mesh: FilmMesh, basis: skfem.Basis, joined: NDArray[np.int64]) -> dict[str, NDArray[np.int64]]:
    """Unknowns of the facets of each named boundary: both ends, and the middle of a quadratic one."""
    found = {}
    for name in film_mesh.boundary_names:
        facets = film_mesh.mesh.boundaries[name]
        on = basis.dofs.nodal_dofs[0][film_mesh.mesh.facets[:, facets]]
        if basis.dofs.facet_dofs.size:
            on = np.vstack([on, basis.dofs.facet_dofs[0][facets]])
        found[name] = joined[on]
    return found


def _rim(film_mesh: FilmMesh, degree: int, facet_dofs: Mapping[str, NDArray[np.int64]]) -> Rim:
    mesh = film_mesh.mesh
    facets = np.concatenate([np.zeros(0, dtype=np.int64), *(mesh.boundaries[name] for name in facet_dofs)])
    dofs = np.hstack([np.zeros((degree + 1, 0), dtype=np.int64), *facet_dofs.values()])
    return Rim(facets, np.asarray(mesh.f2t[0, facets]), np.ascontiguousarray(dofs))


def _tangent(space: FilmSpace, facets: NDArray[np.int64]) -> Array:
    """Facets as vectors along the film, (2, facets) m."""
    first, second = space.vertices[space.film_mesh.mesh.facets[:, facets]]
    along = np.asarray((second - first).T)
    return along if space.sphere.is_plane else along * space.sphere.scale(*(0.5 * (first + second)).T)


def _outward(space: FilmSpace, facets: NDArray[np.int64]) -> Array:
    """Outward normal times length of each facet, (2, facets) m; zero for a facet with film on both sides."""
    mesh = space.film_mesh.mesh
    tangent = _tangent(space, facets)
    normal = np.stack([tangent[1], -tangent[0]])
    inside = space.vertices[space.cells[mesh.f2t[0, facets]]].mean(axis=1)
    away = (space.vertices[mesh.facets[0, facets]] - inside).T
    towards = np.sign((normal * away).sum(axis=0))
    return np.where(mesh.f2t[1, facets] < 0, normal * towards, 0.0)
