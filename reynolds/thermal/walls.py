"""Thermal conditions of a wall: given temperature, adiabatic, convection outside, a body, a turning shaft.

Heat flux q (W/m2) counts from the oil into the wall. The film is coupled to each wall by its conductance g
(W/(m2 K)), of the order of k/h.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class GivenTemperature:
    """A surface at this temperature (K), one number or one for each vertex (vertices,)."""

    temperature: float | Array


@dataclass(frozen=True)
class Adiabatic:
    """A surface without heat flux."""


@dataclass(frozen=True)
class Convecting:
    """Local heat transfer through a coefficient H (W/(m2 K)) to an outer temperature (K): q = H (T - T_outer).

    Numbers, or one for each vertex (vertices,). A wall of thickness d and conductivity k has H = k/d.
    """

    coefficient: float | Array
    outer_temperature: float | Array


class WallResponse(Protocol):
    """Response to the heat flux q (vertices,) W/m2 into a wall: reference + matrix @ q."""

    @property
    def reference(self) -> Array:
        """Value without flux, (vertices,)."""

    @property
    def matrix(self) -> Array:
        """Change by unit flux at each vertex, (vertices, vertices)."""


@dataclass(frozen=True)
class ConductingBody:
    """A body of its own heat equation, steady: T = reference + matrix @ q at the vertices.

    reference (vertices,) K, matrix (vertices, vertices) K/(W/m2). `deformation`, of a body that expands, is that
    of the film at the vertices, m by W/m2 (`bodies.wall.heated_wall` gives both).
    """

    reference: Array
    matrix: Array
    deformation: WallResponse | None = None


@dataclass(frozen=True)
class Turning:
    """A wall that turns fast under the film and so has one temperature, at which it absorbs `heat` (W)."""

    heat: float = 0.0


Wall = GivenTemperature | Adiabatic | Convecting | ConductingBody | Turning


@dataclass(frozen=True)
class WallRows:
    """Equations of a wall's temperature at the unknowns (size,): own T - by_flux q = right (K).

    `coupled(T, q)` (size,), if given, is the full left side; own and by_flux are its diagonal.
    """

    own: Array
    by_flux: Array
    right: Array
    coupled: Callable[[Array, Array], Array] | None = None

    @property
    def of_uniform(self) -> Array:
        """Left side of a uniform temperature of 1 K without flux (size,)."""
        if self.coupled is None:
            return self.own
        return self.coupled(np.ones_like(self.own), np.zeros_like(self.own))


def wall_rows(wall: Wall, space: FilmSpace, area: Array, conductance: Array) -> WallRows:
    """The equations of one wall; area (size,) m2 and conductance g (size,) of the film at each unknown.

    Raises FilmInputError for a field that is not of the vertices, that is not finite, or a coefficient below zero.
    """
    one, none = np.ones(space.size), np.zeros(space.size)
    match wall:
        case GivenTemperature(temperature):
            return WallRows(one, none, _nodal(space, temperature, "wall temperature", "K"))
        case Adiabatic():
            return WallRows(none, 1.0 / conductance, none)
        case Convecting(coefficient, outer):
            given = _nodal(space, coefficient, "heat transfer coefficient", "W/(m2 K)")
            if given.min() < 0.0:
                raise FilmInputError("heat transfer coefficient", f"{given.min():.4g} W/(m2 K)", "at least 0")
            # H T - q = H T_outer, scaled to suit both H = 0 and H without bound.
            share = given / (given + conductance)
            return WallRows(share, 1.0 / (given + conductance), share * _nodal(space, outer, "outer temperature", "K"))
        case ConductingBody(reference, matrix, _):
            return _body(space, _nodal(space, reference, "body temperature", "K"), matrix)
        case Turning(heat):
            return _turning(heat, area, conductance)


def deformation_by_heat(wall: Wall, space: FilmSpace, flux: Array) -> Array:
    """Deformation of the film (vertices,) m as the wall expands under the heat flux (size,) W/m2 into it.

    Raises FilmInputError for a deformation that is not of the vertices.
    """
    count = len(space.vertices)
    if not isinstance(wall, ConductingBody) or wall.deformation is None:
        return np.zeros(count)
    grows = wall.deformation
    shapes = np.shape(grows.reference), np.shape(grows.matrix)
    if shapes != ((count,), (count, count)):
        raise FilmInputError("deformation of a warm body", f"shapes {shapes}", f"({count},) and ({count}, {count})")
    return np.asarray(grows.reference + grows.matrix @ flux[space.vertex_dofs])


def _body(space: FilmSpace, reference: Array, matrix: Array) -> WallRows:
    count = len(space.vertices)
    if np.shape(matrix) != (count, count) or not np.isfinite(matrix).all():
        raise FilmInputError("body matrix", f"shape {np.shape(matrix)}", f"finite numbers ({count}, {count})")

    def coupled(temperature: Array, flux: Array) -> Array:
        return np.asarray(temperature - _mean_of_vertices(space, matrix @ flux[space.vertex_dofs]))

    response = np.abs(_mean_of_vertices(space, matrix.sum(axis=1)))
    return WallRows(np.ones(space.size), response, reference, coupled)


def _turning(heat: float, area: Array, conductance: Array) -> WallRows:
    whole, share = float(area @ conductance), area / area.sum()

    def coupled(temperature: Array, flux: Array) -> Array:
        return np.asarray(temperature - share @ temperature - area @ flux / whole)

    size = len(area)
    return WallRows(np.ones(size), 1.0 / conductance, np.full(size, -heat / whole), coupled)


def _nodal(space: FilmSpace, given: float | Array, name: str, unit: str) -> Array:
    values = np.asarray(given, dtype=float)
    if values.shape not in ((), (len(space.vertices),)) or not np.isfinite(values).all():
        found = f"an array of shape {values.shape} or a value that is not finite"
        raise FilmInputError(name, found, f"{unit}: one number or {len(space.vertices)}, one for each vertex")
    return _mean_of_vertices(space, np.broadcast_to(values, len(space.vertices)))


def _mean_of_vertices(space: FilmSpace, values: Array) -> Array:
    """At each unknown the mean over its vertices: one, two on a seam, many in a pocket."""
    count = np.bincount(space.vertex_dofs, minlength=space.size)
    return np.asarray(np.bincount(space.vertex_dofs, weights=values, minlength=space.size) / count)
