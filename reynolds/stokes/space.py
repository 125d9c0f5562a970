"""Taylor-Hood elements on a section of a gap, plane or about an axis, and the forms of viscous flow on them.

Velocity of degree 2, pressure of degree 1, both continuous: Taylor and Hood (1973), "A numerical solution of the
Navier-Stokes equations using the finite element technique", Computers and Fluids 1. About an axis x is along it, y
the distance r from it; integrals are per radian, with r as their weight, in place of per metre of width.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np
import skfem
from skfem.helpers import ddot, div, dot, sym_grad

from reynolds.numerics.arrays import Array

Sparse = Any
"""A scipy sparse matrix."""
QUADRATURE = 5
"""Order that integrates the viscous form of degree 2 with the weight r exactly on straight cells."""


class Symmetry(Enum):
    """Symmetry of a section: a plane gap of any width, or one of revolution about the x axis."""

    PLANE = "plane"
    AXIAL = "axial"


@dataclass(frozen=True)
class StokesSpace:
    """The unknowns of a flow on one mesh: `velocity` of N, `pressure` of M unknowns."""

    mesh: skfem.Mesh
    velocity: skfem.CellBasis
    pressure: skfem.CellBasis
    symmetry: Symmetry

    @property
    def size(self) -> int:
        """Number of all unknowns, N + M."""
        return int(self.velocity.N + self.pressure.N)

    def weight(self, place: Array) -> Array:
        """Weight of an area of the section at places (2, ..) in m: one, or its distance from the axis."""
        return place[1] if self.symmetry is Symmetry.AXIAL else np.ones_like(place[1])

    def beside(self, boundary: str) -> skfem.FacetBasis:
        """The velocity on one named boundary of the mesh, to be integrated there."""
        return skfem.FacetBasis(
            self.mesh, self.velocity.elem, facets=self.mesh.boundaries[boundary], intorder=QUADRATURE
        )

    def pressure_beside(self, boundary: str) -> skfem.FacetBasis:
        """The pressure on one named boundary of the mesh, to be integrated there."""
        return skfem.FacetBasis(
            self.mesh, self.pressure.elem, facets=self.mesh.boundaries[boundary], intorder=QUADRATURE
        )


def taylor_hood(mesh: skfem.Mesh, symmetry: Symmetry = Symmetry.PLANE) -> StokesSpace:
    """The Taylor-Hood space on a mesh in m of quadrilaterals (Q2-Q1) or triangles (P2-P1)."""
    quads = isinstance(mesh, skfem.MeshQuad1)
    second, first = (
        (skfem.ElementQuad2(), skfem.ElementQuad1()) if quads else (skfem.ElementTriP2(), skfem.ElementTriP1())
    )
    velocity = skfem.Basis(mesh, skfem.ElementVector(second), intorder=QUADRATURE)
    return StokesSpace(mesh, velocity, velocity.with_element(first), symmetry)


def viscous(space: StokesSpace) -> Sparse:
    """The matrix (N, N) of 2 sym grad u : sym grad v, for a viscosity of one; about an axis 2 u_r v_r/r^2 too."""

    @skfem.BilinearForm
    def form(u: Any, v: Any, w: Any) -> Any:
        found = 2.0 * ddot(sym_grad(u), sym_grad(v)) * space.weight(w.x)
        if space.symmetry is Symmetry.AXIAL:
            found = found + 2.0 * u[1] * v[1] / w.x[1]  # points of the quadrature never lie on the axis
        return found

    return form.assemble(space.velocity)


def divergence(space: StokesSpace) -> Sparse:
    """The matrix (M, N) of - q div u: continuity, and transposed the pressure's force on the momentum."""

    @skfem.BilinearForm
    def form(u: Any, q: Any, w: Any) -> Any:
        found = div(u) * space.weight(w.x)
        if space.symmetry is Symmetry.AXIAL:
            found = found + u[1]
        return -found * q

    return form.assemble(space.velocity, space.pressure)


def convection(space: StokesSpace, velocity: Array) -> tuple[Array, Sparse]:
    """(u . grad) u tested with v for a density of one: the vector (N,) and its derivative by u, (N, N)."""
    at = space.velocity.interpolate(velocity)

    @skfem.LinearForm
    def rate(v: Any, w: Any) -> Any:
        return dot(_along(w.carrier, w.carrier.grad), v) * space.weight(w.x)

    @skfem.BilinearForm
    def slope(u: Any, v: Any, w: Any) -> Any:
        return dot(_along(w.carrier, u.grad) + _along(u, w.carrier.grad), v) * space.weight(w.x)

    return rate.assemble(space.velocity, carrier=at), slope.assemble(space.velocity, carrier=at)


def body_force(space: StokesSpace, force: Callable[[Array], Array]) -> Array:
    """The vector (N,) of a force per volume in N/m3, given as (2, ..) at places (2, ..) in m."""

    @skfem.LinearForm
    def form(v: Any, w: Any) -> Any:
        return dot(force(w.x), v) * space.weight(w.x)

    return np.asarray(form.assemble(space.velocity))


def _along(carrier: Any, gradient: Any) -> Any:
    """(carrier . grad) of a field whose gradient is given, (2, ..)."""
    return np.einsum("j...,ij...->i...", carrier, gradient)
