"""The film's side of a transfer: a quadrature finer than the film's own, and fields at its vertices.

A film cell may lie across several facets of the body, whose shape functions have kinks there: at points as sparse as
the film's own the load on the body would be concentrated in spots. Where facets are much smaller than cells, cells are
split.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import skfem
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array, csr_array
from scipy.sparse.linalg import splu
from skfem.quadrature import get_quadrature

from reynolds.bodies.space import tabulated
from reynolds.fem.space import FilmSpace, film_space
from reynolds.numerics.arrays import Array

ORDER = 6  # 12 points in a triangle, 16 in a quadrilateral
_BASIS = {
    (3, 1): skfem.ElementTriP1(), (3, 2): skfem.ElementTriP2(),
    (4, 1): skfem.ElementQuad1(), (4, 2): skfem.ElementQuad2(),
}  # fmt: skip


@dataclass(frozen=True)
class FilmRule:
    """Points (n, 2) m of the film plane; area (cells, points of a cell) m2 of each on the wall, in the same order.

    by_unknown (n, size) and by_vertex (n, vertices): area of each point times the basis there, m2. Vertices' hats
    are linear (bilinear).
    """

    film: FilmSpace
    points: Array
    area: Array
    by_unknown: csr_array
    by_vertex: csr_array
    hats: csr_array

    def fitted(self, moments: Array) -> Array:
        """The field at the vertices (vertices, ...) whose integrals with the hats are `moments` (vertices, ...).

        One value on both sides of a seam.
        """
        solved = self._mass.solve(np.ascontiguousarray(self._sewn.T @ moments))
        return np.asarray(self._sewn @ solved)

    @cached_property
    def _sewn(self) -> csr_array:
        """Vertices by the distinct vertices of a film with sewn seams."""
        count, same = len(self.film.vertices), film_space(self.film.film_mesh).vertex_dofs
        return csr_array(coo_array((np.ones(count), (np.arange(count), same)), shape=(count, same.max() + 1)))

    @cached_property
    def _mass(self) -> Any:
        hats = csr_array(self.hats @ self._sewn)
        return splu(csc_array(hats.T @ csr_array(self.by_vertex @ self._sewn)))


def film_rule(film: FilmSpace, splits: int = 1) -> FilmRule:
    """Quadrature for the transfer of a film's fields to a body, each cell split into `splits` squared parts."""
    corners = film.cells.shape[1]
    basis, geometry = _BASIS[corners, film.degree], _BASIS[corners, 1]
    at, weights = _composite(get_quadrature(geometry.refdom, ORDER), corners, splits)
    value, _ = tabulated(basis, at, film.dofs.shape[1])
    hat, slope = tabulated(geometry, at, corners)
    places = film.vertices[film.cells]
    tangent = np.einsum("daq,eak->eqdk", slope, places)
    measure = tangent[:, :, 0, 0] * tangent[:, :, 1, 1] - tangent[:, :, 0, 1] * tangent[:, :, 1, 0]
    points = np.einsum("aq,eak->eqk", hat, places).reshape(-1, 2)
    area = np.abs(measure) * weights * film.sphere.scale(*points.T).reshape(measure.shape) ** 2
    return FilmRule(
        film, points, area,
        _at_points(area[:, :, None] * value.T, film.dofs, film.size),
        _at_points(area[:, :, None] * hat.T, film.cells, len(film.vertices)),
        _at_points(np.broadcast_to(hat.T, (*area.shape, corners)), film.cells, len(film.vertices)),
    )  # fmt: skip


def _composite(rule: tuple[Array, Array], corners: int, splits: int) -> tuple[Array, Array]:
    """A rule, points (2, n) and weights (n,), in each of `splits` squared parts of the triangle or square."""
    i, j = (part.ravel()[:, None] for part in np.meshgrid(np.arange(splits), np.arange(splits), indexing="ij"))
    (x, y), weights = rule
    parts = [i + x, j + y]
    if corners == 3:  # beyond the long side the parts lie the other way round
        inside = i + j < splits
        parts = [np.where(inside, i + x, splits - i - x), np.where(inside, j + y, splits - j - y)]
    count = splits**2
    return np.vstack([part.ravel() for part in parts]) / splits, np.tile(weights, count) / count


def _at_points(entries: Array, numbers: NDArray[np.int32], width: int) -> csr_array:
    """Matrix (points, width) of entries (cells, points of a cell, local) of the cells' numbers (cells, local)."""
    cells, points, _ = entries.shape
    row = np.arange(cells * points).reshape(cells, points, 1)
    rows = np.broadcast_to(row, entries.shape).ravel()
    columns = np.broadcast_to(numbers[:, None, :], entries.shape).ravel()
    return csr_array(coo_array((entries.ravel(), (rows, columns)), shape=(cells * points, width)))
