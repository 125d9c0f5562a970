"""Direct solves of small films: elimination in the narrow band of a good order of the unknowns.

A film around a ring, numbered from one line across it both ways round, couples only to unknowns at most two lines away.
Below some thousand unknowns its elimination costs less than a few iterations do, and each further right-hand side
almost nothing. Film columns are symmetric and diagonally dominant, those of a cavity transport downstream: such a
matrix needs no exchange of rows (Golub and Van Loan 2013, 3.4.10); where one does, the residual shows it.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array

from reynolds.linear import band_kernels as kernels
from reynolds.linear.band_ordering import line_order
from reynolds.linear.triangles import BothTriangles, both_triangles
from reynolds.numerics.arrays import Array
from reynolds.numerics.lanes import WIDTH

MOST_WORK = 1e7  # unknowns times the square of half the band: beyond, iterations are faster
MOST_UNKNOWNS = 5000
CROWDED = 3  # times the couplings of most unknowns: a pocket
MOST_HUBS = 20
REFINEMENTS = 2


class BandedFactor:
    """Factors of one pattern: `update` with new entries, `solve` with any number of right-hand sides."""

    def __init__(self, both: BothTriangles, order: NDArray[np.intp], hubs: int) -> None:
        """`order` (n,): the new number of each unknown, of hubs last."""
        size = len(order) - hubs
        row, column = order[both.indices], order[both.column]
        inside = (row < size) & (column < size)
        half, reach = _reach(row[inside], column[inside], size)
        width = 2 * half + 1
        rows, border = np.zeros(size * width), np.zeros((hubs, size))
        self._both, self._order = both, order
        self._place = np.where(inside, row * width + column - row + half, -1)
        self._border = np.flatnonzero(~inside)
        self._band = kernels.Band(rows, border, border.copy(), np.zeros((hubs, hubs)), reach, half)
        self._entries: Array = np.zeros(0)
        self._inverse: Array = np.zeros((hubs, hubs))

    @property
    def work(self) -> float:
        """Unknowns times the square of half the band."""
        return float(len(self._band.reach)) * self._band.half**2

    def update(self, upper: Array, lower: Array) -> bool:
        """Set the entries of the upper triangle and their mirror; False where a pivot vanishes."""
        both = self._both
        self._entries = both.entries(upper, lower)
        kernels.fill(self._place, self._border, both.column, both.indices, self._entries, self._order, self._band)
        if not kernels.eliminate(self._band):
            return False
        if not len(self._inverse):
            return True
        try:
            self._inverse = np.asarray(np.linalg.inv(self._band.corner))
        except np.linalg.LinAlgError:
            return False
        return True

    def solve(self, loads: Array, tolerance: float) -> tuple[Array, float]:
        """Rows x of (m, n) with |A x - load| <= tolerance |load|, or as near as refinement comes; the residual."""
        found = np.empty_like(loads)
        pattern = self._both.indptr, self._both.indices
        left = kernels.solve(
            self._band, self._inverse, self._order, pattern, self._entries, loads, tolerance, REFINEMENTS, found
        )
        return found, left


def _reach(row: NDArray[np.intp], column: NDArray[np.intp], size: int) -> tuple[int, NDArray[np.int64]]:
    """Half the width of a band, rounded up to eights, and the last row that an elimination has reached at each."""
    reach = np.arange(size)
    np.maximum.at(reach, column, row)
    reach = np.maximum.accumulate(reach)
    most = int((reach - np.arange(size)).max(initial=1))
    return -(-most // WIDTH) * WIDTH, reach


def banded(upper: csc_array) -> BandedFactor | None:
    """A factor of matrices whose upper triangle has this pattern; None where its band is too wide to pay.

    Unknowns that couple to far more than others do (pockets) come last.
    """
    if upper.shape[0] > MOST_UNKNOWNS:
        return None
    both = both_triangles(upper)
    degree = np.diff(both.indptr)
    crowded = degree > CROWDED * np.median(degree)
    plain, hubs = np.flatnonzero(~crowded), np.flatnonzero(crowded)
    if not len(plain) or len(hubs) > MOST_HUBS:
        return None
    pattern = csr_array(both.matrix(np.ones(len(both.indices)))[plain][:, plain])
    order = np.empty(len(degree), dtype=np.intp)
    order[np.concatenate([plain[line_order(pattern)], hubs])] = np.arange(len(degree))
    factor = BandedFactor(both, order, len(hubs))
    return factor if factor.work <= MOST_WORK else None
