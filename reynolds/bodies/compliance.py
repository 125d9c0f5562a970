"""Compliance of elastic walls, as the film solver needs it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, issparse, vstack

from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class LowRank:
    """A compliance as a product, left (vertices, rank) @ right (rank, size): never multiplied out.

    The two together have the unit m/Pa. Exact for a body whose face has fewer nodes than the film has unknowns
    (`reynolds.bodies.wall.face_wall`).
    """

    left: Array
    right: Array | csr_array

    @property
    def shape(self) -> tuple[int, int]:
        """(vertices, size), the shape of the product."""
        return self.left.shape[0], self.right.shape[1]

    @property
    def rank(self) -> int:
        """Columns of the left factor, no less than the rank of the product."""
        return int(self.left.shape[1])

    def __matmul__(self, pressure: Array) -> Array:
        """Deformation (vertices, ...) m by pressures (size, ...) Pa."""
        return self.left @ (self.right @ pressure)

    def toarray(self) -> Array:
        """The matrix itself, (vertices, size) m/Pa."""
        return self.left @ full(self.right)

    def beside(self, other: LowRank) -> LowRank:
        """Sum of the deformations of both walls of a film."""
        both = self.right, other.right
        sparse = all(issparse(part) for part in both)
        right = csr_array(vstack(both)) if sparse else np.vstack([full(part) for part in both])
        return LowRank(np.hstack([self.left, other.left]), right)


WallMatrix: TypeAlias = Array | csr_array | LowRank


class Product(Protocol):
    """Deformation by pressures with contact, (I - C S)^-1 C, not multiplied out."""

    @property
    def compliance(self) -> WallMatrix:
        """C, the compliance without contact."""

    @property
    def contact(self) -> csr_array:
        """S: pressure of contact on each unknown by the gap at each vertex, (size, vertices) Pa/m."""

    def __matmul__(self, pressure: Array) -> Array:
        """Deformation (vertices, ...) m by pressures (size, ...) Pa."""

    def columns(self, unknowns: NDArray[np.intp]) -> Array:
        """Columns of the matrix for some unknowns, (vertices, unknowns) m/Pa."""


WallOperator: TypeAlias = WallMatrix | Product


def full(matrix: WallMatrix) -> Array:
    """A compliance multiplied out, as an array."""
    return matrix if isinstance(matrix, np.ndarray) else np.asarray(matrix.toarray())


def compliance_of(operator: WallOperator) -> WallMatrix:
    """The walls' own compliance, (vertices, size) m/Pa."""
    return operator if isinstance(operator, LowRank | np.ndarray | csr_array) else operator.compliance


def contact_of(operator: WallOperator) -> csr_array:
    """Pressure of contact by the gap, (size, vertices) Pa/m: no entries without contact."""
    if isinstance(operator, LowRank | np.ndarray | csr_array):
        return csr_array(operator.shape[::-1])
    return operator.contact


def columns_of(matrix: WallOperator, unknowns: NDArray[np.intp]) -> Array:
    """Deformation (vertices, unknowns) m by unit pressure at some unknowns."""
    if isinstance(matrix, LowRank):
        return matrix.left @ full(matrix.right[:, unknowns])
    if isinstance(matrix, np.ndarray | csr_array):
        return full(matrix[:, unknowns])
    return matrix.columns(unknowns)


def transposed_product(matrix: WallMatrix, force: Array) -> Array:
    """C^T force, (size,): an output's slope by pressures, from `force` (vertices,), its slope by the deformation."""
    if isinstance(matrix, LowRank):
        return np.asarray(matrix.right.T @ (matrix.left.T @ force))
    return np.asarray(matrix.T @ force)


class ElasticWalls(Protocol):
    """Both walls of a film together, as one linear operator."""

    @property
    def matrix(self) -> WallMatrix:
        """Deformation at the mesh's vertices by unit pressure at each unknown, (vertices, size) m/Pa."""
