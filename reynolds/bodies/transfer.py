"""Transfer between a film and a body's face with meshes that need not match: forces to it, deformation back.

Every point of the film's rule is found in the face, along the film's normal. With N its shape functions there,

    force at face node i = int p N_i dA          deformation w: int psi (w - sum_i N_i w_i) dA = 0 for all hats psi

so that the force, its moments and, since one is the other's transpose, the work p w are the same on either side for any
meshes (Farhat, Lesoinne and Le Tallec 1998); the work exactly for a linear film without pockets. On a cylinder N is
scaled by the nearly unit factor that makes its nodes' normals add up to the normal.

Two meshes approximate one circle by different polygons. A film point that lies beyond the edge of the face by no more
than that uses the nearest point of the face: force and work stay the same, moments up to that distance.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.spatial import cKDTree

from reynolds.bodies.chart import Chart, face_normals, on_section
from reynolds.bodies.film_quadrature import FilmRule, film_rule
from reynolds.bodies.space import Face, tabulated
from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array

INSIDE = 1e-6  # of a facet: largest distance outside its edges of a point that still belongs to it
OFF_FACE = 0.1  # of a facet's size: largest distance of the film from the face along the normal
BEYOND = 0.15  # of the longer edge of both: how far beyond the face; a hexagon strays by 0.134 of one from its circle
STEPS = 6  # of Newton's method within a facet; four are enough for one that is not folded
CONVERGED = 1e-13  # of a facet
MOST_SPLITS = 8
FAR_OUTSIDE = 0.3  # of a facet
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

    def deformation(self, into: Array) -> Array:
        """Deformation (vertices, ...) m from displacements (face nodes, ...) m into the body, in mean square."""
        return self.rule.fitted(csr_array(self.rule.by_vertex.T @ self.normal_share) @ into)

    def temperature(self, nodal: Array) -> Array:
        """Temperature (vertices, ...) from values at the face nodes (face nodes, ...), in mean square."""
        return self.rule.fitted(self.heat.T @ nodal)


def transfer(film: FilmSpace, face: Face, chart: Chart) -> Transfer:
    """Find the film's points in the face of a body along the chart's normal.

    A film of revolution acts on a section (r, z) by its mean around the turn. Raises FilmInputError where the face ends
    before the film by more than the difference of the meshes or lies off it by more than a tenth of a facet: how many
    points, where, and how far from the face.
    """
    rule = film_rule(film, _splits(film, face))
    places = chart.places(rule.points)
    normals = np.asarray(chart.normals(places))
    if face.places.shape[1] == 2:
        places, normals = on_section(places, normals)
    facet, reference = _found(face, places, normals, rule)
    value, _ = tabulated(face.element, reference.T, face.facets.shape[1])
    rows = np.repeat(np.arange(len(places)), face.facets.shape[1])
    columns = face.facets[facet].ravel()
    share = csr_array(coo_array((value.T.ravel(), (rows, columns)), shape=(len(places), len(face.nodes))))
    length = ((share @ face_normals(chart, face.places)) * normals).sum(axis=1)
    scaled = csr_array(share.multiply(1.0 / length[:, None]))
    return Transfer(rule, share, scaled)


def _splits(film: FilmSpace, face: Face) -> int:
    """Parts along the edge of a film cell, about as long as facets are."""
    cell = np.median(_longest_edge(film.vertices[film.cells]))
    if face.places.shape[1] == 3:
        facet = np.sqrt(np.linalg.norm(face.area.sum(axis=1), axis=1))
    else:
        facet = _longest_edge(face.places[face.facets[:, :2]])
    return int(np.clip(np.round(cell / np.median(facet)), 1, MOST_SPLITS))


def _found(face: Face, places: Array, normals: Array, rule: FilmRule) -> tuple[NDArray[np.int64], Array]:
    """The facet that holds each film point or is nearest, (points,), and where in it, (points, dim - 1)."""
    slack = BEYOND * np.repeat(_longest_edge(rule.film.vertices[rule.film.cells]), rule.area.shape[1])
    corners = {3: 2, 6: 3}.get(face.facets.shape[1], 4)  # of a facet: the first of its nodes
    edge = BEYOND * _longest_edge(face.places[face.facets[:, :corners]])
    point, facet = _candidates(face, places, normals, float(slack.max()))
    reference, off = _projected(face, facet, places[point], normals[point])
    size = np.linalg.norm(np.ptp(face.places[face.facets], axis=1), axis=1)[facet]
    near = np.abs(off) <= OFF_FACE * size  # false for NaN
    outside = np.where(near, _outside(face, reference), np.inf)
    within = outside <= INSIDE
    met = np.where(within[:, None], reference, _nearest(face, reference))
    away = np.where(within, 0.0, _apart(face, facet, met, places[point], normals[point]))
    order = np.lexsort((outside, np.where(near, away, np.inf), point))
    first = order[np.unique(point[order], return_index=True)[1]]
    held = np.zeros(len(places), dtype=bool)
    held[point[first]] = near[first] & (away[first] <= np.maximum(slack[point[first]], edge[facet[first]]))
    if not held.all():
        raise FilmInputError(f"body face {face.name}", *_not_covered(face, places[~held], rule.points, held))
    return facet[first], met[first]


def _not_covered(face: Face, lost: Array, flat: Array, held: NDArray[np.bool_]) -> tuple[str, str]:
    """Message on film points that no face lies under, and the expectation."""
    far = float(cKDTree(face.places).query(lost)[0].max())
    (x0, y0), (x1, y1) = flat[~held].min(axis=0), flat[~held].max(axis=0)
    found = (
        f"{len(lost)} of {len(flat)} film points have no face under them, x {x0:.6g} to {x1:.6g} m, y {y0:.6g} to "
        f"{y1:.6g} m, up to {far * 1e3:.4g} mm from its nearest node"
    )
    return found, "a face that reaches under the whole film"


def _longest_edge(corners: Array) -> Array:
    """Longest edge (n,) m of polygons or, of two corners, lines (n, corners, dim)."""
    return np.asarray(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1))


def _candidates(face: Face, places: Array, normals: Array, slack: float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Pairs of film points and facets near each other (m beyond their reach) whose normals have about one direction."""
    corners = face.places[face.facets]
    centre = corners.mean(axis=1)
    reach = np.linalg.norm(corners - centre[:, None], axis=2).max(axis=1)
    near = cKDTree(places).query_ball_point(centre, (1.0 + max(OFF_FACE, 2.0 * BEYOND)) * reach + slack)
    facet = np.repeat(np.arange(len(centre)), [len(found) for found in near])
    point = np.concatenate([np.asarray(found, dtype=np.int64) for found in near])
    outward = face.area.sum(axis=1)
    outward /= np.linalg.norm(outward, axis=1)[:, None]
    facing = (outward[facet] * normals[point]).sum(axis=1) > FACING
    return point[facing], facet[facing]


def _projected(face: Face, facet: NDArray[np.int64], places: Array, normals: Array) -> tuple[Array, Array]:
    """Newton's method for the point of a facet that lies on a film point's normal; and its distance along it.

    NaN without such a point near the facet.
    """
    corners = face.places[face.facets]
    across = _tangents(normals)
    reference = np.full((len(facet), corners.shape[2] - 1), 1.0 / 3.0)
    moving = np.arange(len(facet))
    for taken in range(STEPS):
        value, slope = tabulated(face.element, reference[moving].T, corners.shape[1])
        nodes = corners[facet[moving]]
        gap = np.einsum("an,nak->nk", value, nodes) - places[moving]
        residual = np.einsum("nik,nk->ni", across[moving], gap)
        jacobian = np.einsum("nik,ndk->nid", across[moving], np.einsum("dan,nak->ndk", slope, nodes))
        # Points of other facets need not converge, but must stay bounded.
        after = np.clip(reference[moving] - _solved(jacobian, residual), -0.5, 1.5)
        step = np.abs(after - reference[moving]).max(axis=1)
        reference[moving] = after
        # A point far outside after two steps belongs to another facet, or to this one's nearest edge.
        moving = moving[(step > CONVERGED) & ((_outside(face, after) < FAR_OUTSIDE) | (taken == 0))]
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
    """Distance of a point outside the reference facet (<= 0 inside)."""
    if face.facets.shape[1] == 6:
        return np.maximum((-reference).max(axis=1), reference.sum(axis=1) - 1.0)
    return np.maximum(-reference, reference - 1.0).max(axis=1)


def _nearest(face: Face, reference: Array) -> Array:
    """The point of the reference facet next to one outside it."""
    if face.facets.shape[1] != 6:
        return np.clip(reference, 0.0, 1.0)
    inside = np.maximum(reference, 0.0)
    over = inside.sum(axis=1, keepdims=True) - 1.0
    across = np.clip(inside - 0.5 * over, 0.0, 1.0)
    return np.where(over > 0.0, across / np.maximum(across.sum(axis=1, keepdims=True), 1.0), inside)


def _apart(face: Face, facet: NDArray[np.int64], reference: Array, places: Array, normals: Array) -> Array:
    """Distance (m) of points of facets from film points, across the film's normal."""
    value, _ = tabulated(face.element, reference.T, face.facets.shape[1])
    gap = np.einsum("an,nak->nk", value, face.places[face.facets[facet]]) - places
    return np.asarray(np.linalg.norm(gap - (gap * normals).sum(axis=1)[:, None] * normals, axis=1))
