"""The linear film on the nodes of a quadratic one, whose operator has nearly the spectrum of the quadratic operator.

With linear elements on the quadratic elements' own nodes the two energies of any nodal field differ by a bounded factor
on any mesh (Orszag 1980; Deville and Mund 1985). So a cycle of multigrid for the linear film preconditions the
quadratic one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from reynolds.equation.balance import stiffness
from reynolds.equation.coefficients import Tensor, isotropic
from reynolds.fem import kernels
from reynolds.fem.reference_element import ReferenceElement
from reynolds.fem.refine import refine_mesh
from reynolds.fem.space import FilmSpace, film_space
from reynolds.linear.multigrid.grid import grid_of
from reynolds.linear.quadratic import QuadraticFilm
from reynolds.numerics.arrays import Array

CHILDREN = np.array([(0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3)])
"""Nodes of a biquadratic cell at the corners of the four cells that `refine_mesh` cuts it into."""


@dataclass(frozen=True)
class Companion:
    """A linear space on the nodes of a quadratic one.

    sources (vertices, 4): vertices of the quadratic mesh whose mean a vertex of the linear one is; unknowns (size,):
    linear unknown of each quadratic one; quarters (points, 4): weights of the quadratic points in the mean of a field
    over each quarter of a cell.
    """

    space: FilmSpace
    sources: NDArray[np.int64]
    unknowns: NDArray[np.int32]
    quarters: Array

    def moved(self, vertices: Array) -> Companion:
        """The companion of the quadratic space with other vertices, (n, 2) m."""
        return replace(self, space=self.space.moved(vertices[self.sources].mean(axis=1)))

    def entries(self, conductance: Tensor, fixed: NDArray[np.bool_]) -> Array:
        """Entries of the linear operator over its largest, the identity where `fixed` (size,), upper triangle.

        `conductance`: as in `balance.stiffness`, at the quadratic points.
        """
        xx, yy, xy = (self._means(part) for part in conductance)
        given = stiffness(self.space, isotropic(xx) if conductance[0] is conductance[1] else (xx, yy, xy))
        held, data, pattern = np.empty_like(fixed), np.empty_like(given), self.space.pattern
        held[self.unknowns] = fixed
        unit = float(given.max()) or 1.0
        kernels.hold(pattern.indptr, pattern.indices, given, 1.0 / unit, held, np.zeros(len(held)), data)
        return data

    def _means(self, field: Array) -> Array:
        """Means of a field (cells | 1, points | 1) over the linear cells, (cells | 1, 1)."""
        if field.size == 1:
            return field
        means = field @ self.quarters if field.shape[1] > 1 else np.repeat(field, 4, axis=1)
        return np.ascontiguousarray(means.T).reshape(-1, 1)


def companion_of(space: FilmSpace) -> Companion | None:
    """The companion of a quadratic space; None where cells are triangles or unknowns are tied to a pocket."""
    if space.degree != 2 or space.dofs.shape[1] != 9:
        return None
    refined = refine_mesh(space.film_mesh)
    linear = film_space(refined.film_mesh, sphere=space.sphere)
    if linear.size != space.size:
        return None
    cells, unknowns = len(space.cells), np.empty(space.size, dtype=np.int32)
    for child, nodes in enumerate(CHILDREN):
        unknowns[space.dofs[:, nodes]] = linear.dofs[child * cells : (child + 1) * cells]
    return Companion(linear, refined.sources, unknowns, _quarters(space.reference))


def film_on_nodes(companion: Companion) -> QuadraticFilm | None:
    """The solver of the quadratic film; None where its nodes are no grid."""
    space, grid = companion.space, grid_of(companion.space)
    if grid is None:
        return None
    return QuadraticFilm(grid, space.matrix(np.ones(len(space.pattern.indices))), companion.unknowns)


def _quarters(reference: ReferenceElement) -> Array:
    """Weights of a cell's points by quarters: the rule's own weights, halved on the lines between two quarters."""
    place = np.round(2.0 * (reference.geometry_value @ np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])), 6)
    low, high = 0.5 * (1.0 + np.sign(1.0 - place.T)), 0.5 * (1.0 + np.sign(place.T - 1.0))
    shares = np.column_stack([low[0] * low[1], high[0] * low[1], high[0] * high[1], low[0] * high[1]])
    weights = reference.weights[:, None] * shares
    return np.asarray(weights / weights.sum(axis=0))
