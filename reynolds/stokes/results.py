"""Results of a solved flow: flux, pressure at an end, and places of separation and reattachment along a wall."""

from typing import Any

import numpy as np
import skfem

from reynolds.numerics.arrays import Array
from reynolds.stokes.flow import Flow
from reynolds.stokes.space import Symmetry


def flux(flow: Flow, boundary: str) -> float:
    """Volume flow through an end along +x: m2/s per metre of width, about an axis m3/s of the whole turn."""
    space = flow.problem.space
    basis = space.beside(boundary)

    @skfem.Functional
    def through(w: Any) -> Any:
        return w.velocity[0] * space.weight(w.x)

    turn = 2.0 * np.pi if space.symmetry is Symmetry.AXIAL else 1.0
    return turn * float(through.assemble(basis, velocity=basis.interpolate(flow.velocity)))


def mean_pressure(flow: Flow, boundary: str) -> float:
    """Mean over the area of a named boundary, Pa."""
    space = flow.problem.space
    basis = space.pressure_beside(boundary)

    @skfem.Functional
    def force(w: Any) -> Any:
        return w.pressure * space.weight(w.x)

    @skfem.Functional
    def area(w: Any) -> Any:
        return space.weight(w.x)

    return float(force.assemble(basis, pressure=basis.interpolate(flow.pressure)) / area.assemble(basis))


def wall_shear(flow: Flow, height: float) -> tuple[Array, Array]:
    """Places x in m along the walls y = height, ascending, and mu du_x/dy there in Pa."""
    space = flow.problem.space
    facets = space.mesh.boundaries["wall"]
    at_height = np.all(np.isclose(space.mesh.p[1, space.mesh.facets[:, facets]], height), axis=0)
    basis = skfem.FacetBasis(space.mesh, space.velocity.elem, facets=facets[at_height], intorder=6)
    slope = flow.problem.viscosity * basis.interpolate(flow.velocity).grad[0, 1].ravel()
    places = np.asarray(basis.global_coordinates())[0].ravel()
    order = np.argsort(places)
    return places[order], slope[order]


def turning_places(flow: Flow, height: float) -> Array:
    """Places x in m, ascending, on walls y = height where the shear changes sign: flow separates or reattaches."""
    x, shear = wall_shear(flow, height)
    at = np.nonzero(shear[:-1] * shear[1:] < 0.0)[0]
    return np.asarray(x[at] - shear[at] * (x[at + 1] - x[at]) / (shear[at + 1] - shear[at]))
