"""Between a film and the face of a body whose meshes need not match: forces one way, openings back.

Every point of the film's rule is found in the face, along the film's normal. With N its shape functions there,

    force at face node i = int p N_i dA          opening w: int psi (w - sum_i N_i w_i) dA = 0 for all hats psi

so that the force, its moments and, since one is the other's transpose, the work p w are the same on either side
whatever the meshes (Farhat, Lesoinne and Le Tallec 1998); the work exactly for a linear film without pockets. On a
cylinder N is scaled by the nearly unit factor that makes its nodes' normals add up to the normal.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.spatial import cKDTree

from reynolds.bodies.body_space import Face, tabulated
from reynolds.bodies.chart import Chart, face_normals, on_section
from reynolds.bodies.film_rule import FilmRule, film_rule
from reynolds.errors import FilmInputError
from reynolds.mesh import Array
from reynolds.space import FilmSpace

INSIDE = 1e-6  # of a facet: how far outside its edges a point still belongs to it
OFF_FACE = 0.1  # of a facet's size: how far off the face along the normal the film may lie
STEPS = 12  # of Newton's method within a facet; four are enough for one that is not folded
CONVERGED = 1e-13  # of a facet
FACING = 0.2  # least cosine between a facet's and the film's normal


@dataclass(frozen=True)
class Transfer:
    """Shape functions of a face at the points of a film's rule.

    share (points, face nodes): rows add up to one (heat); normal_share: scaled so that normals do (force).
    """

    rule: FilmRule
    share: csr_array
    normal_share: csr_array

    @cached_property
    def force(self) -> csr_array:
        """Normal force (N) into the body at each face node by nodal film pressure, (face nodes, size) m2."""
        return csr_array(self.normal_share.T @ self.rule.by_unknown)

    @cached_property
    def heat(self) -> csr_array:
        """Heat (W) into the body at each face node by flux at the film's vertices, (face nodes, vertices) m2."""
        return csr_array(self.share.T @ self.rule.by_vertex)

    def opening(self, into: Array) -> Array:
        """Opening (vertices, ...) m from displacements (face nodes, ...) m into the body, in mean square."""
        return self.rule.fitted(csr_array(self.rule.by_vertex.T @ self.normal_share) @ into)

    def opening_by_force(self, compliance: Array) -> Array:
        """Opening by film pressure (vertices, size) m/Pa from a face's compliance (nodes, nodes) m/N."""
        return np.asarray((self.force.T @ self.opening(compliance).T).T)

    def temperature(self, nodal: Array) -> Array:
        """Temperature (vertices, ...) from values at the face nodes (face nodes, ...), in mean square."""
        return self.rule.fitted(self.heat.T @ nodal)


def transfer(film: FilmSpace, face: Face, chart: Chart) -> Transfer:
    """Find the film's points in the face of a body along the chart's normal.

    A film of revolution on a section (r, z) is met by its mean around the turn. Raises FilmInputError where the
    face does not reach under the film or lies off it by more than a tenth of a facet: how many points, and where.
    """
    rule = film_rule(film)
    places = chart.places(rule.points)
    normals = np.asarray(chart.normals(places))
    if face.places.shape[1] == 2:
        places, normals = on_section(places, normals)
    facet, reference = _found(face, places, normals, rule.points)
    value, _ = tabulated(face.element, reference.T, face.facets.shape[1])
    rows = np.repeat(np.arange(len(places)), face.facets.shape[1])
    columns = face.facets[facet].ravel()
    share = csr_array(coo_array((value.T.ravel(), (rows, columns)), shape=(len(places), len(face.nodes))))
    length = ((share @ face_normals(chart, face.places)) * normals).sum(axis=1)
    scaled = csr_array(share.multiply(1.0 / length[:, None]))
    return Transfer(rule, share, scaled)


def _found(face: Face, places: Array, normals: Array, flat: Array) -> tuple[NDArray[np.int64], Array]:
    """The facet that holds each film point, and where in it, (points,) and (points, dim - 1)."""
    point, facet = _candidates(face, places, normals)
    reference, off = _projected(face, facet, places[point], normals[point])
    size = np.linalg.norm(np.ptp(face.places[face.facets], axis=1), axis=1)[facet]
    near = np.abs(off) <= OFF_FACE * size  # false for NaN
    outside = np.where(near, _outside(face, reference), np.inf)
    order = np.lexsort((outside, point))
    first = order[np.unique(point[order], return_index=True)[1]]
    held = np.zeros(len(places), dtype=bool)
    held[point[first]] = outside[first] <= INSIDE
    if not held.all():
        lost = flat[~held]
        found = (
            f"{len(lost)} of {len(flat)} film points have no face under them, x {lost[:, 0].min():.6g} to "
            f"{lost[:, 0].max():.6g} m, y {lost[:, 1].min():.6g} to {lost[:, 1].max():.6g} m"
        )
        raise FilmInputError(f"body face {face.name}", found, "a face that reaches under the whole film")
    return facet[first], reference[first]


def _candidates(face: Face, places: Array, normals: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Pairs of film points and facets that lie near each other and look the same way."""
    corners = face.places[face.facets]
    centre = corners.mean(axis=1)
    reach = np.linalg.norm(corners - centre[:, None], axis=2).max(axis=1)
    near = cKDTree(places).query_ball_point(centre, (1.0 + OFF_FACE) * reach)
    facet = np.repeat(np.arange(len(centre)), [len(found) for found in near])
    point = np.concatenate([np.asarray(found, dtype=np.int64) for found in near])
    outward = face.area.sum(axis=1)
    outward /= np.linalg.norm(outward, axis=1)[:, None]
    facing = (outward[facet] * normals[point]).sum(axis=1) > FACING
    return point[facing], facet[facing]


def _projected(face: Face, facet: NDArray[np.int64], places: Array, normals: Array) -> tuple[Array, Array]:
    """Newton's method for the point of a facet that lies on a film point's normal; and how far along it.

    NaN where there is none near the facet.
    """
    corners = face.places[face.facets]
    across = _tangents(normals)
    reference = np.full((len(facet), corners.shape[2] - 1), 1.0 / 3.0)
    moving = np.arange(len(facet))
    for _ in range(STEPS):
        value, slope = tabulated(face.element, reference[moving].T, corners.shape[1])
        nodes = corners[facet[moving]]
        gap = np.einsum("an,nak->nk", value, nodes) - places[moving]
        residual = np.einsum("nik,nk->ni", across[moving], gap)
        jacobian = np.einsum("nik,ndk->nid", across[moving], np.einsum("dan,nak->ndk", slope, nodes))
        # Points of other facets need not converge: they only must not run away.
        after = np.clip(reference[moving] - _solved(jacobian, residual), -0.5, 1.5)
        step = np.abs(after - reference[moving]).max(axis=1)
        reference[moving] = after
        moving = moving[step > CONVERGED]
    reference[moving] = np.nan
    value, _ = tabulated(face.element, reference.T, corners.shape[1])
    gap = np.einsum("an,nak->nk", value, corners[facet]) - places
    return reference, (gap * normals).sum(axis=1)


def _solved(jacobian: Array, residual: Array) -> Array:
    """Two by two (one by one) solves; a singular one does not move."""
    if residual.shape[1] == 1:
        determinant, adjugate = jacobian[:, 0, 0], np.ones_like(jacobian)
    else:
        (a, b), (c, d) = np.moveaxis(jacobian, 0, -1)
        determinant = a * d - b * c
        adjugate = np.moveaxis(np.array([[d, -b], [-c, a]]), -1, 0)
    safe = np.where(determinant == 0.0, np.inf, determinant)
    return np.einsum("nij,nj->ni", adjugate, residual) / safe[:, None]


def _tangents(normals: Array) -> Array:
    """Unit vectors across each normal, (n, dim - 1, dim)."""
    if normals.shape[1] == 2:
        return (normals[:, ::-1] * np.array([1.0, -1.0]))[:, None, :]
    least = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    first = np.cross(normals, least)
    first /= np.linalg.norm(first, axis=1)[:, None]
    return np.stack([first, np.cross(normals, first)], axis=1)


def _outside(face: Face, reference: Array) -> Array:
    """How far outside the reference facet a point lies (<= 0 inside)."""
    if face.facets.shape[1] == 6:
        return np.maximum((-reference).max(axis=1), reference.sum(axis=1) - 1.0)
    return np.maximum(-reference, reference - 1.0).max(axis=1)
