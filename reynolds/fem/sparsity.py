"""The fixed sparsity pattern of one mesh: coupled unknowns and the indices of their entries."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array
from scipy.sparse.csgraph import connected_components

from reynolds.fem import kernels


@dataclass(frozen=True)
class Pattern:
    """Upper triangle by columns, and the index of each element entry in its data."""

    indptr: NDArray[np.int32]
    indices: NDArray[np.int32]
    slots: NDArray[np.int32]  # (cells, basis (basis + 1) / 2)

    @cached_property
    def columns(self) -> NDArray[np.int32]:
        """Column of each entry (entries,)."""
        return np.repeat(np.arange(len(self.indptr) - 1, dtype=np.int32), np.diff(self.indptr))

    @cached_property
    def diagonal(self) -> NDArray[np.int32]:
        """Index of each diagonal entry, (size,)."""
        return self.indptr[1:] - 1

    @cached_property
    def empty(self) -> csc_array:
        """An upper triangle of zeros to copy, since scipy checks indices of every new matrix."""
        size = len(self.indptr) - 1
        return csc_array((np.zeros(len(self.indices)), self.indices, self.indptr), shape=(size, size))

    @cached_property
    def pieces(self) -> tuple[int, NDArray[np.int32]]:
        """Number of separate pieces of the film, and the piece of each unknown (size,)."""
        size = len(self.indptr) - 1
        graph = csc_array((np.ones(len(self.indices), dtype=bool), self.indices, self.indptr), shape=(size, size))
        count, piece = connected_components(graph, directed=False)
        return int(count), piece

    def pieces_without(self, marked: NDArray[np.bool_]) -> NDArray[np.intp]:
        """Numbers of the pieces of the film in which no unknown is marked."""
        count, piece = self.pieces
        reached = np.zeros(count, dtype=bool)
        reached[piece[marked]] = True
        return np.flatnonzero(~reached)


def pattern_of(dofs: NDArray[np.int32], size: int) -> Pattern:
    """The pattern of `size` unknowns, all unknowns of a cell coupled, dofs (cells, basis)."""
    rows, columns = np.triu_indices(dofs.shape[1])
    a, b = dofs[:, rows], dofs[:, columns]
    row, column = np.minimum(a, b), np.maximum(a, b)
    entries = coo_array((np.ones(row.size, dtype=bool), (row.ravel(), column.ravel())), shape=(size, size)).tocsc()
    entries.sum_duplicates()
    indptr, indices = entries.indptr.astype(np.int32), entries.indices.astype(np.int32)
    slots = np.empty(row.shape, dtype=np.int32)
    kernels.find_slots(indptr, indices, row, column, slots)
    return Pattern(indptr, indices, slots)
