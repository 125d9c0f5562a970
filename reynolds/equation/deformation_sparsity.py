"""The fixed sparsity patterns of a balance between elastic walls: made once for a mesh."""

from copy import copy
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array, csr_array

from reynolds.fem.space import FilmSpace
from reynolds.linear.triangles import BothTriangles, both_triangles
from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class DeformationPattern:
    """Pattern of the unknowns' slopes by the deformation of vertices: `empty` (size, vertices), by rows.

    slots (cells, basis, corners): index of each cell's entries.
    """

    empty: csr_array
    slots: NDArray[np.int32]

    @property
    def entries(self) -> int:
        """Entries of the pattern."""
        return len(self.empty.indices)

    def matrix(self, data: Array) -> csr_array:
        """The matrix with these entries: a copy, since scipy checks indices of every new matrix."""
        filled = copy(self.empty)
        filled.data = data
        return filled


def deformation_pattern(space: FilmSpace) -> DeformationPattern:
    """The pattern of a film: each cell's unknowns depend on its corners."""
    rows = np.repeat(space.dofs, space.cells.shape[1], axis=1)
    columns = np.tile(space.cells, (1, space.dofs.shape[1]))
    key = rows.astype(np.int64) * len(space.vertices) + columns
    found, slots = np.unique(key.ravel(), return_inverse=True)
    row, column = np.divmod(found, len(space.vertices))
    shape = (space.size, len(space.vertices))
    empty = csr_array(coo_array((np.zeros(len(found)), (row, column)), shape=shape))
    return DeformationPattern(empty, slots.reshape(*space.dofs.shape, -1).astype(np.int32))


@dataclass(frozen=True)
class ElasticPatterns:
    """Both patterns of the films on one mesh, made on first use."""

    space: FilmSpace

    @cached_property
    def deformation(self) -> DeformationPattern:
        """Unknowns by vertices."""
        return deformation_pattern(self.space)

    @cached_property
    def _both(self) -> tuple[BothTriangles, csc_array]:
        both = both_triangles(self.space.matrix(np.ones(len(self.space.pattern.indices))))
        return both, both.matrix(np.zeros(len(both.source)))

    def full_matrix(self, upper: Array, lower: Array) -> csc_array:
        """The operator with upper triangle and mirrored entries in the pattern's order."""
        both, empty = self._both
        filled = copy(empty)
        filled.data = both.entries(upper, lower)
        return filled
