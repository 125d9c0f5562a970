"""Linear elasticity of a body: one factorisation, any number of loads.

    div sigma + b = 0,   sigma = lambda div u I + 2 mu eps(u),   lambda = E nu/((1+nu)(1-2nu)), mu = E/(2(1+nu))

In the rigid motions that the supports leave, the body is a free body: loads are balanced by inertia forces of uniform
density (inertia relief), and the displacement has no rigid part in the mean square over the volume. The body's mean
position is then the gap's own position, and compliance stays symmetric. Validity: small strain, one isotropic material,
no vibration.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.linalg
from scipy.sparse import coo_array, csc_array
from scipy.sparse.linalg import splu

from reynolds.bodies.space import BodySpace, Face, assembled
from reynolds.bodies.supports import SINGULAR, Supports, constraints, rigid_motions
from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array

BLOCK = 64  # right-hand sides at a time: bounds the memory of a compliance beside its result


@dataclass(frozen=True)
class Elastic:
    """Young's modulus (Pa) and Poisson's ratio; raises FilmInputError outside E > 0, -1 < nu < 0.5."""

    youngs_modulus: float
    poisson_ratio: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.youngs_modulus) and self.youngs_modulus > 0.0 and -1.0 < self.poisson_ratio < 0.5):
            found = f"E = {self.youngs_modulus:.4g} Pa, nu = {self.poisson_ratio:.4g}"
            raise FilmInputError("elastic material", found, "E above zero, nu between -1 and 0.5")

    @property
    def lame(self) -> tuple[float, float]:
        """Lame's constants lambda and mu (Pa)."""
        e, nu = self.youngs_modulus, self.poisson_ratio
        return e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu))


@dataclass(frozen=True)
class Structure:
    """A supported body, factorised.

    `motions` (dofs, k) are the rigid motions that the supports leave, of unit square integral over the body, and
    `inertia` (dofs, k) their integrals with the shape functions; `allowed` (dofs, free) is a basis of all other
    motions.
    """

    space: BodySpace
    elastic: Elastic
    allowed: csc_array
    motions: Array
    inertia: Array
    factor: Any

    def displaced(self, forces: Array) -> Array:
        """Displacement (dofs, k) m by nodal forces (dofs, k) N; dof = dim x node + direction."""
        balanced = forces - self.inertia @ (self.motions.T @ forces)
        moved = self.allowed @ self.factor.solve(np.asarray(self.allowed.T @ balanced))
        return np.asarray(moved - self.motions @ (self.inertia.T @ moved))


def structure(space: BodySpace, elastic: Elastic, supports: Supports) -> Structure:
    """A body with its supports, ready for any load. Raises FilmInputError for an unknown face."""
    held, free = constraints(space, supports)
    rigid = rigid_motions(space)
    if held.shape[1]:
        _, strength, rows = np.linalg.svd(np.linalg.qr(np.asarray(held.T @ rigid), mode="r"))
        strength = np.pad(strength, (0, rigid.shape[1] - len(strength)))
        rigid = rigid @ rows[strength <= SINGULAR * np.linalg.norm(rigid, axis=0).max()].T
    inertia = _weighted(space, rigid)
    lower = np.linalg.cholesky(rigid.T @ inertia)
    motions, inertia = (np.linalg.solve(lower, part.T).T for part in (rigid, inertia))
    # Balanced loads pull at no pin: as many dofs as there are motions, those that hold them best, are pinned.
    pins = scipy.linalg.qr(np.asarray(free.T @ motions).T, mode="r", pivoting=True)[1][: motions.shape[1]]
    allowed = csc_array(free[:, np.setdiff1d(np.arange(free.shape[1]), pins)])
    reduced = csc_array(allowed.T @ stiffness(space, elastic) @ allowed)
    factor = splu(reduced, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return Structure(space, elastic, allowed, motions, inertia, factor)


def stiffness(space: BodySpace, elastic: Elastic) -> csc_array:
    """Stiffness (dofs, dofs) N/m: integral of lambda div u div v + 2 mu eps(u) : eps(v)."""
    cells, local, dim, points = space.gradient.shape
    lam, mu = elastic.lame
    slope = space.gradient.reshape(cells, local * dim, points)
    weighted = (slope * space.volume[:, None, :]) @ slope.transpose(0, 2, 1)
    products = weighted.reshape(cells, local, dim, local, dim)
    matrix = mu * products.transpose(0, 1, 4, 3, 2)
    along = np.einsum("eakbk->eab", products)
    for i in range(dim):
        matrix[:, :, i, :, i] += mu * along
    if space.body.axisymmetric:
        hoop = space.value[None] / space.radius[:, None, :]
        matrix[:, :, 0, :, 0] += 2.0 * mu * np.einsum("eaq,ebq,eq->eab", hoop, hoop, space.volume, optimize=True)
    spread = divergence(space).reshape(cells, local * dim, points)
    matrix += lam * ((spread * space.volume[:, None, :]) @ spread.transpose(0, 2, 1)).reshape(products.shape)
    matrix = matrix.reshape(cells, local * dim, local * dim)
    return assembled(space.dofs, space.dofs, matrix, (space.places.size,) * 2)


def divergence(space: BodySpace) -> Array:
    """Divergence of each cell's unit displacements at the quadrature points, (cells, local, dim, points) 1/m."""
    if not space.body.axisymmetric:
        return space.gradient
    spread = space.gradient.copy()
    spread[:, :, 0] += space.value[None] / space.radius[:, None, :]
    return spread


def pressure_forces(space: BodySpace, face: Face, pressure: float) -> Array:
    """Nodal forces (dofs,) N of a uniform pressure (Pa) on a face: -p times the integral of N n."""
    local = -pressure * np.einsum("aq,fqd->fad", face.value, face.area)
    dofs = space.dim * face.nodes[face.facets][:, :, None] + np.arange(space.dim)
    total = np.bincount(dofs.ravel(), weights=local.ravel(), minlength=space.places.size)
    return np.asarray(total, dtype=float)


def centrifugal_forces(space: BodySpace, density: float, speed: float, axis: tuple[float, float] = (0.0, 0.0)) -> Array:
    """Nodal forces (dofs,) N of rotation at `speed` (rad/s) about a line along z through axis (x, y) m.

    Body force density x speed^2 x distance, outwards. In a free body inertia relief leaves the part that strains it.
    """
    away = space.places.copy()
    away[:, -1] = 0.0
    away[:, : space.dim - 1] -= np.asarray(axis)[: space.dim - 1]
    if space.body.axisymmetric and axis != (0.0, 0.0):
        raise FilmInputError("centrifugal axis", f"{axis} m of a body of revolution", "its own axis (0, 0)")
    return density * speed**2 * _weighted(space, away.reshape(-1, 1))[:, 0]


def normal_forces(space: BodySpace, face: Face, normals: Array) -> csc_array:
    """Unit normal forces into the body at each face node, (dofs, face nodes)."""
    count, dim = normals.shape
    rows = (dim * face.nodes[:, None] + np.arange(dim)).ravel()
    columns = np.repeat(np.arange(count), dim)
    return csc_array(coo_array((-normals.ravel(), (rows, columns)), shape=(space.places.size, count)))


def face_compliance(body: Structure, face: Face, normals: Array) -> Array:
    """Displacement into the body at each face node by unit normal force into it, (nodes, nodes) m/N.

    Symmetric, positive semidefinite; exactly condensed: the film needs no other part of the body.
    """
    into = normal_forces(body.space, face, normals)
    result = np.empty((into.shape[1], into.shape[1]))
    for start in range(0, into.shape[1], BLOCK):
        columns = slice(start, start + BLOCK)
        result[:, columns] = into.T @ body.displaced(into[:, columns].toarray())
    return 0.5 * (result + result.T)


def face_deformation(body: Structure, face: Face, normals: Array, forces: Array) -> Array:
    """Displacement into the body (nodes,) m at each face node by a load case: nodal forces (dofs,) N."""
    return np.asarray(normal_forces(body.space, face, normals).T @ body.displaced(forces[:, None])[:, 0])


def _weighted(space: BodySpace, motion: Array) -> Array:
    """Integral of the shape functions times displacements (dofs, k), (dofs, k)."""
    nodal = motion.reshape(len(space.places), -1)
    return np.asarray(space.mass @ nodal).reshape(motion.shape)
