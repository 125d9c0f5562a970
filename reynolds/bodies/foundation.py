"""Elastic walls without a mesh of their own, and the sum of two walls."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array, csr_array

from reynolds.bodies.compliance import ElasticWalls, LowRank, WallMatrix, full
from reynolds.bodies.elasticity import Elastic
from reynolds.bodies.memory import physical_memory
from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array

DENSE_COPIES = 4  # of the influences at a time, as measured
BLOCK = 128  # points at a time: bounds the memory beside the result


@dataclass(frozen=True)
class Compliance:
    """Deformation at the film's vertices by unit pressure at each unknown, (vertices, size) m/Pa."""

    matrix: WallMatrix


def winkler(space: FilmSpace, stiffness: float) -> Compliance:
    """Springs side by side, deformation = p/k with k in Pa/m (Winkler 1867): a thin soft layer on a rigid wall.

    Validity: layer much thinner than the pressure field is long. Raises FilmInputError unless k > 0.
    """
    if not (np.isfinite(stiffness) and stiffness > 0.0):
        raise FilmInputError("stiffness of the wall", f"{stiffness:.4g} Pa/m", "above zero")
    count = len(space.vertices)
    entries = (np.full(count, 1.0 / stiffness), (np.arange(count), space.vertex_dofs))
    return Compliance(csr_array(coo_array(entries, shape=(count, space.size))))


def half_space(space: FilmSpace, elastic: Elastic) -> Compliance:
    """A half-space: Boussinesq's influence of each cell's mean pressure.

        deformation(x) = (1 - nu^2)/(pi E) sum over cells of mean p times integral over the cell of dA/|x - x'|

    Love's (1929) integral of a rectangle, and likewise of any convex cell; symmetric in mean square up to the
    error of the mesh. Validity: plane film, much smaller than the body; rigid motion is not removed (the
    reference is the body far away). Raises FilmInputError for a film with seams: an unrolled cylinder is no plane; and
    where the influences need more memory than the machine has (`half_space_memory`).
    """
    if space.film_mesh.seams:
        raise FilmInputError("half-space", "a film sewn at a seam", "a plane film (an unrolled one takes a body)")
    needed = half_space_memory(len(space.vertices), space.size)
    if needed > physical_memory():
        raise FilmInputError("half-space", *too_large(needed, space.size))
    count = space.dofs.shape[0]
    mean = space.area @ space.reference.value / space.area.sum(axis=1)[:, None]
    rows = np.repeat(np.arange(count), space.dofs.shape[1])
    average = csr_array(coo_array((mean.ravel(), (rows, space.dofs.ravel())), shape=(count, space.size)))
    factor = (1.0 - elastic.poisson_ratio**2) / (np.pi * elastic.youngs_modulus)
    influence = factor * polygon_potential(space.vertices, space.vertices[space.cells])
    return Compliance(np.asarray((average.T @ influence.T).T))


def half_space_memory(vertices: int, unknowns: int) -> float:
    """Memory, bytes, in which a film between half-spaces is solved: its dense influences and what the solver makes."""
    return DENSE_COPIES * 8.0 * vertices * unknowns


def too_large(needed: float, unknowns: int) -> tuple[str, str]:
    """Texts of a fault, found and expected: the influences of a film need more bytes than the machine has memory."""
    there = physical_memory()
    fit = int(np.sqrt(there / (8.0 * DENSE_COPIES)))
    found = f"{unknowns} unknowns, each of which deforms all others: about {needed * 1e-9:.3g} GB"
    expected = f"at most the {there * 1e-9:.3g} GB of this machine, about {fit} unknowns: fewer cells or meshes, or a"
    return found, f"{expected} body with sizes (plate, disc, ring) in place of half_space"


def polygon_potential(points: Array, corners: Array) -> Array:
    """Integral of dA/|x - x'| over each convex polygon (cells, corners, 2) at points (n, 2), (n, cells) m.

    Sum over the edges of d [asinh(t2/d) - asinh(t1/d)], d the distance to the edge's line, t along it; an edge in
    line with the point gives nothing. Of a rectangle it is Love's (1929) formula.
    """
    blocks = [_potential(points[k : k + BLOCK], corners) for k in range(0, len(points), BLOCK)]
    return np.vstack(blocks)


def _potential(points: Array, corners: Array) -> Array:
    total = np.zeros((len(points), len(corners)))
    ahead = np.roll(corners, -1, axis=1)
    turn = np.sign(_cross(ahead[:, 0] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    for start, end in zip(corners.swapaxes(0, 1), ahead.swapaxes(0, 1), strict=True):
        length = np.linalg.norm(end - start, axis=1)
        along = (end - start) / length[:, None]
        to_start = start[None] - points[:, None]
        distance = turn * _cross(to_start, along[None])
        first = (to_start * along[None]).sum(axis=2)
        clear = np.abs(distance) > 1e-12 * length
        safe = np.where(clear, np.abs(distance), 1.0)
        angle = np.arcsinh((first + length) / safe) - np.arcsinh(first / safe)
        total += np.where(clear, distance * angle, 0.0)
    return total


def both(first: ElasticWalls, second: ElasticWalls) -> Compliance:
    """Sum of both walls of one film."""
    one, two = first.matrix, second.matrix
    if isinstance(one, LowRank) and isinstance(two, LowRank):
        beside = one.beside(two)
        return Compliance(beside.toarray() if beside.shape[1] <= beside.rank else beside)
    if isinstance(one, csr_array) and isinstance(two, csr_array):
        return Compliance(csr_array(one + two))
    return Compliance(full(one) + full(two))


def _cross(one: Array, two: Array) -> Array:
    return one[..., 0] * two[..., 1] - one[..., 1] * two[..., 0]
