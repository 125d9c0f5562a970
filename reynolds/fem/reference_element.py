"""Basis, geometry and quadrature on the reference cell of a film's elements."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import skfem

from reynolds.numerics.arrays import Array

# Quadrature exact enough that h^3 of a linear film costs no order of convergence: degree of the film
# conductance (3) is not needed in full, the classical rule 2 k - 1 plus one is (Strang and Fix 1973).
ELEMENTS = {
    (skfem.MeshTri1, 1): (skfem.ElementTriP1(), 2),
    (skfem.MeshQuad1, 1): (skfem.ElementQuad1(), 3),
    (skfem.MeshTri1, 2): (skfem.ElementTriP2(), 4),
    (skfem.MeshQuad1, 2): (skfem.ElementQuad2(), 5),
}
"""Element and order of its quadrature, by kind of mesh and degree."""


@dataclass(frozen=True)
class ReferenceElement:
    """Basis and geometry on the reference element at its quadrature points.

    `steep` tables belong to the conductance: for a bilinear quadrilateral they are evaluated at the corner next to the
    point, which integrates as exactly (trapezium rule) and leaves no positive coupling between unknowns of any
    rectangle: pressure and film fraction do not overshoot. `equation.hourglass` removes the excess stiffness. Other
    cells have the same tables for both.
    """

    value: Array  # (points, basis)
    gradient: Array  # (points, basis, 2)
    geometry_value: Array  # (points, corners)
    geometry_gradient: Array  # (points, corners, 2)
    steep_gradient: Array  # (points, basis, 2)
    steep_value: Array  # (points, corners)
    steep_geometry: Array  # (points, corners, 2)
    weights: Array  # (points,)

    @cached_property
    def loops(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Indices of the basis and of the points, as tuples: see `kernels`."""
        points, basis = self.value.shape
        return tuple(range(basis)), tuple(range(points))

    @cached_property
    def to_basis(self) -> Array:
        """Values at the points -> the nearest field of the basis, (basis, points)."""
        return np.asarray(np.linalg.pinv(self.value))

    @cached_property
    def to_corners(self) -> Array:
        """Values at the points -> the nearest field of the corners, (corners, points)."""
        return np.asarray(np.linalg.pinv(self.geometry_value))


def reference(mesh: skfem.Mesh, element: skfem.Element, points: Array, weights: Array) -> ReferenceElement:
    """Tables of an element of ELEMENTS at quadrature points (2, points) with their weights."""
    geometry = skfem.ElementTriP1() if isinstance(mesh, skfem.MeshTri1) else skfem.ElementQuad1()

    def table(kind: skfem.Element, count: int, points: Array = points) -> tuple[Array, Array]:
        values, slopes = zip(*(kind.lbasis(points, i) for i in range(count)), strict=True)
        at = np.array([np.broadcast_to(v, points.shape[1:]) for v in values]).T
        slope = np.array([np.broadcast_to(s, points.shape) for s in slopes]).transpose(2, 0, 1)
        return np.ascontiguousarray(at, dtype=float), np.ascontiguousarray(slope, dtype=float)

    value, gradient = table(element, len(element.doflocs))
    corner, corner_gradient = table(geometry, len(geometry.doflocs))
    steep, steep_at, steep_corner = gradient, corner, corner_gradient
    if isinstance(element, skfem.ElementQuad1):
        corners = np.round(points)
        _, steep = table(element, 4, corners)
        steep_at, steep_corner = table(geometry, 4, corners)
    return ReferenceElement(
        value, gradient, corner, corner_gradient, steep, steep_at, steep_corner, np.ascontiguousarray(weights)
    )
