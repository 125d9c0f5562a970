"""Supports of a body, and the motions that they leave free."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array, csc_array

from reynolds.bodies.space import BodySpace, Nodes
from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array

SINGULAR = 1e-8  # of the largest singular value: supports that hold a motion no better do not hold it
FAR = 0.1  # of the body's size: a held point no farther than this from a node means that node


@dataclass(frozen=True)
class Supports:
    """Supports of a body: clamped faces, faces that only slide (symmetry planes), points (m) by the nearest node.

    Without any the body is free. The displacement under a force on a held point grows as its cells shrink: points
    are for bodies whose loads balance each other.
    """

    clamped: tuple[str, ...] = ()
    symmetry: tuple[str, ...] = ()
    points: tuple[tuple[float, ...], ...] = ()


def constraints(space: BodySpace, supports: Supports) -> tuple[csc_array, csc_array]:
    """Orthonormal bases of the motions that supports hold (dofs, held) and allow (dofs, free).

    Raises FilmInputError for an unknown face and for a point far from the body.
    """
    dim = space.dim
    directions: dict[int, list[Array]] = {}
    for name in supports.clamped:
        for node in space.face(name).nodes.tolist():
            directions.setdefault(node, []).append(np.eye(dim))
    for point in supports.points:
        distance = np.linalg.norm(space.places - np.asarray(point), axis=1)
        node = int(np.argmin(distance))
        if not distance[node] <= FAR * np.ptp(space.places, axis=0).max():
            raise FilmInputError(
                "held point", f"{point} m, {distance[node]:.3g} m from any node", "a point of the body"
            )
        directions.setdefault(node, []).append(np.eye(dim))
    for name in supports.symmetry:
        face = space.face(name)
        local = np.einsum("aq,fqd->fad", np.abs(face.value), face.area)
        normals = np.array([
            np.bincount(face.facets.ravel(), weights=local[:, :, i].ravel()) for i in range(dim)
        ]).T  # fmt: skip
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        for node, normal in zip(face.nodes.tolist(), normals, strict=True):
            directions.setdefault(node, []).append(normal[None])
    return _bases(space, directions)


def _bases(space: BodySpace, directions: dict[int, list[Array]]) -> tuple[csc_array, csc_array]:
    dim, size = space.dim, space.places.size
    untouched = np.setdiff1d(np.arange(len(space.places)), list(directions))
    plain = (dim * untouched[:, None] + np.arange(dim)).ravel()
    held: list[tuple[int, Array]] = []
    free: list[tuple[int, Array]] = []
    for node, wanted in directions.items():
        _, strength, rows = np.linalg.svd(np.vstack(wanted))
        rank = int(np.count_nonzero(strength > SINGULAR))
        held += [(node, row) for row in rows[:rank]]
        free += [(node, row) for row in rows[rank:]]

    def matrix(columns: list[tuple[int, Array]], more: Nodes) -> csc_array:
        rows = [dim * node + np.arange(dim) for node, _ in columns]
        entries = [direction for _, direction in columns]
        row = np.concatenate([*rows, more]).astype(int)
        column = np.concatenate([np.repeat(np.arange(len(columns)), dim), len(columns) + np.arange(len(more))])
        values = np.concatenate([*entries, np.ones(len(more))])
        return csc_array(coo_array((values, (row, column)), shape=(size, len(columns) + len(more))))

    return matrix(held, np.empty(0, dtype=np.int64)), matrix(free, plain)


def rigid_motions(space: BodySpace) -> Array:
    """Rigid motions (dofs, 6), of a section (dofs, 1): translations, and rotations about the middle of the nodes.

    Rotations are scaled by the body's size, so that all are about one.
    """
    nodes, dim = space.places.shape
    if dim == 2:
        return np.tile([0.0, 1.0], nodes)[:, None]
    arm = space.places - space.places.mean(axis=0)
    arm = arm / np.abs(arm).max()
    turned = [np.cross(axis, arm).ravel() for axis in np.eye(3)]
    return np.column_stack([*(np.tile(axis, nodes) for axis in np.eye(3)), *turned])
