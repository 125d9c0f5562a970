"""Both triangles of a matrix of symmetric pattern by columns, from its upper triangle and the mirrored entries."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array

from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class BothTriangles:
    """The pattern by columns, rows sorted; `source` places each entry in (upper data, mirrored data).

    `column` is that of each entry, `diagonal` the place of each diagonal entry.
    """

    indptr: NDArray[np.int32]
    indices: NDArray[np.int32]
    column: NDArray[np.int32]
    diagonal: NDArray[np.int64]
    source: NDArray[np.int64]

    def entries(self, upper: Array, lower: Array) -> Array:
        """The entries of both triangles; lower[k] is (j, i) where upper[k] is (i, j), the diagonal is upper's."""
        return np.asarray(np.take(np.concatenate([upper, lower]), self.source))

    def matrix(self, entries: Array) -> csc_array:
        """The matrix of such entries, by columns."""
        size = len(self.diagonal)
        return csc_array((entries, self.indices, self.indptr), shape=(size, size))


def both_triangles(upper: csc_array) -> BothTriangles:
    """The pattern of both triangles of a matrix whose upper triangle, diagonal included, has this pattern."""
    size, count = upper.shape[0], len(upper.indices)
    column = np.repeat(np.arange(size, dtype=np.int32), np.diff(upper.indptr))
    off = np.flatnonzero(upper.indices != column)
    row = np.concatenate([upper.indices, column[off]])
    number = np.concatenate([np.arange(count), count + off])
    full = coo_array((number + 1, (row, np.concatenate([column, upper.indices[off]]))), shape=upper.shape).tocsc()
    full.sort_indices()
    indptr, indices = full.indptr.astype(np.int32), full.indices.astype(np.int32)
    column = np.repeat(np.arange(size, dtype=np.int32), np.diff(indptr))
    return BothTriangles(indptr, indices, column, np.flatnonzero(indices == column), full.data - 1)
