"""Linear solves with one sparsity pattern: symmetric positive definite (`Factor`) and general (`GeneralFactor`).

Symmetric ones by size. On a grid, multigrid solves them from 400 unknowns on, those of quadratic elements from 3000 on,
preconditioned by the linear film on the same nodes. QDLDL (Stellato
et al. 2020) keeps its symbolic part between calls and is the fastest of the freely licensed direct solvers below
about 1e5 unknowns; above, conjugate gradients with algebraic multigrid (Ruge-Stueben 1987, pyamg) take over,
since fill grows faster than the mesh. Where one stalls, the next one takes over.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import qdldl
from numpy.typing import NDArray
from scipy.sparse import csc_array, csc_matrix, csr_array, triu
from scipy.sparse.linalg import SuperLU, splu

from reynolds.errors import FilmNotConverged
from reynolds.linear.band import BandedFactor, banded
from reynolds.linear.cavitated import CavitatedFilm
from reynolds.linear.multigrid.grid import Grid
from reynolds.linear.multigrid.solver import Multigrid
from reynolds.linear.quadratic import QuadraticFilm
from reynolds.linear.triangles import BothTriangles, both_triangles
from reynolds.numerics.array_kernels import norm
from reynolds.numerics.arrays import Array

DIRECT_LIMIT = 60_000
GRID_LEAST = 400  # unknowns: below, a direct solve of a grid is as fast as multigrid
ITERATIVE_TOLERANCE = 1e-11
STALLED = 1e3  # times the tolerance: residual allowed by round-off; beyond, the next solver
ROUND_OFF = 1e-13  # of the answer, in units of the scaled matrix
GENERAL_TOLERANCE = 1e-10  # residual over load beyond which an elimination without pivots is done again with them


Solve = Callable[[Array, float], Array]
"""(load, tolerance) -> x with A x = load."""


def row_by_row(solve: Solve) -> Solve:
    """The same for a load (n,) and for rows of loads (m, n)."""

    def solved(load: Array, tolerance: float) -> Array:
        if load.ndim == 1:
            return solve(load, tolerance)
        return np.array([solve(np.ascontiguousarray(row), tolerance) for row in load]).reshape(load.shape)

    return solved


class Factor:
    """The factorised operator of one pattern: `update` with new entries, then `solve` any number of times."""

    def __init__(self, grid: Grid | None = None, quadratic: QuadraticFilm | None = None) -> None:
        """`grid`: the rows and columns of the unknowns (`grid_of`), None where the mesh is no grid.

        quadratic: the solver of a quadratic film, None where the film is linear or its nodes are no grid.
        """
        self._grid = grid if grid is not None and grid.unknowns.size >= GRID_LEAST else None
        self._on_grid: Multigrid | QuadraticFilm | None = quadratic
        self._direct: tuple[csc_matrix, qdldl.Solver] | None = None
        self._multigrid: tuple[csr_array, Any] | None = None
        self._upper: csc_array | None = None
        self._stalled = False

    def update(self, upper: csc_array, linear: Array | None = None) -> None:
        """Set the upper triangle of a symmetric positive definite matrix; the pattern never changes.

        linear: entries of a quadratic film's companion.
        """
        self._upper = upper
        if self._taken_on_grid(upper, linear):
            return
        self._leave_grid()
        self._off_grid(upper)

    def _taken_on_grid(self, upper: csc_array, linear: Array | None) -> bool:
        if isinstance(self._on_grid, QuadraticFilm):
            return linear is not None and self._on_grid.update(upper, linear)
        if self._on_grid is None and self._grid is not None:
            self._on_grid = Multigrid(self._grid, upper)
        return self._on_grid is not None and self._on_grid.update(upper.data)

    def solve(self, load: Array, tolerance: float = ITERATIVE_TOLERANCE) -> Array:
        """x with A x = load, (n,), at least to |A x - load| = tolerance |load|.

        Where multigrid stalls (films that jump many times over) by a direct solve.
        """
        assert self._upper is not None
        if self._on_grid is not None:
            answer, effort = self._on_grid.solve(load, tolerance)
            enough = max(STALLED * ITERATIVE_TOLERANCE, tolerance)
            # Entries are of order one: the residual is at least the answer's round-off, however small the load.
            if effort.left <= enough or (effort.left - enough) * norm(load) <= ROUND_OFF * norm(answer):
                return answer
            self._leave_grid()
            self._off_grid(self._upper)
        if self._multigrid is not None:
            answer, converged = _conjugate_gradients(*self._multigrid, load)
            if converged:
                return answer
            self._stalled = True
            self._factorise(self._upper)
        assert self._direct is not None
        return np.asarray(self._direct[1].solve(load))

    def _leave_grid(self) -> None:
        self._grid = self._on_grid = None

    def _off_grid(self, upper: csc_array) -> None:
        if upper.shape[0] > DIRECT_LIMIT and not self._stalled:
            self._multigrid = multigrid(upper)
        else:
            self._factorise(upper)

    def _factorise(self, upper: csc_array) -> None:
        self._multigrid = None
        if self._direct is None:
            matrix = csc_matrix((upper.data, upper.indices, upper.indptr), shape=upper.shape)
            self._direct = matrix, qdldl.Solver(matrix, upper=True)
        else:
            matrix, direct = self._direct
            matrix.data = upper.data  # scipy checks every new matrix, which takes as long as a small elimination
            direct.update(matrix, upper=True)


def multigrid(upper: csc_array, max_coarse: int = 10) -> tuple[csr_array, Any]:
    """The full matrix of an upper triangle and its algebraic multigrid, no coarser than about `max_coarse`."""
    import pyamg

    full = csr_array(upper + triu(upper, 1).T)
    full.indices, full.indptr = full.indices.astype(np.int32), full.indptr.astype(np.int32)
    # The minimum norm keeps positive couplings of stretched quadrilaterals out of the strength graph.
    strength = ("classical", {"theta": 0.25, "norm": "min"})
    return full, pyamg.ruge_stuben_solver(full, strength=strength, max_coarse=max_coarse)


def _conjugate_gradients(matrix: csr_array, hierarchy: Any, load: Array) -> tuple[Array, bool]:
    """The solution, and True if its residual is near ITERATIVE_TOLERANCE of the load."""
    answer = hierarchy.solve(load, tol=ITERATIVE_TOLERANCE, accel="cg", maxiter=200)
    reached = norm(load - matrix @ answer)
    return answer, reached <= STALLED * ITERATIVE_TOLERANCE * norm(load)


class GeneralFactor:
    """A matrix of symmetric pattern and any values, factorised: `update`, then `solve` any number of times.

    Made for the film with oil in its cavities, with columns symmetric in the film and upwind transport in the
    cavity. A small one is eliminated in its band (`band`), on a grid an iteration solves it (`CavitatedFilm`).
    Else, and where those fail, an elimination with pivots on the diagonal, and where that fails, with any pivots.
    """

    def __init__(self, grid: Grid | None = None) -> None:
        """`grid`: the rows and columns of the unknowns (`grid_of`), None where the mesh is no grid."""
        self._grid = grid if grid is not None and grid.unknowns.size >= GRID_LEAST else None
        self._on_grid: CavitatedFilm | None = None
        self._band: BandedFactor | None = None
        self._patterned = self._in_band = False
        self._both: BothTriangles | None = None
        self._given: tuple[csc_array, Array] | None = None
        self._matrix: csc_array | None = None
        self._scale: tuple[Array, Array] | None = None
        self._lu: SuperLU | None = None

    def update(self, upper: csc_array, lower: Array, cavity: NDArray[np.bool_] | None = None) -> None:
        """Set the upper triangle with its diagonal, the mirrored entries and which columns are the cavity's.

        lower[k] is the entry (j, i) where upper.data[k] is (i, j); on the diagonal it is not used. The
        pattern never changes. Without `cavity` (size,) the elimination solves it. Raises FilmNotConverged for a
        row or column of zeros.
        """
        self._given, self._matrix = (upper, lower), None
        if not self._patterned:
            self._patterned, self._band = True, banded(upper)
        self._in_band = self._band is not None and self._band.update(upper.data, lower)
        if self._in_band:
            return
        if self._grid is not None and cavity is not None:
            if self._on_grid is None:
                self._on_grid = CavitatedFilm(self._grid, upper)
            if self._on_grid.update(upper.data, lower, cavity):
                return
            self._leave_grid()
        self._eliminated()

    def solve(self, load: Array, tolerance: float = ITERATIVE_TOLERANCE) -> Array:
        """x with A x = load, (n,) or rows (m, n), at least to |A x - load| = tolerance |load|.

        Raises FilmNotConverged where the matrix is singular.
        """
        if self._in_band:
            assert self._band is not None
            answers, left = self._band.solve(np.atleast_2d(load), tolerance)
            if left <= max(GENERAL_TOLERANCE, tolerance):
                return answers.reshape(load.shape)
            self._in_band = False
            self._eliminated()
        return row_by_row(self._solved)(load, tolerance)

    def _solved(self, load: Array, tolerance: float) -> Array:
        if self._on_grid is not None and self._matrix is None:
            answer, effort = self._on_grid.solve(load, tolerance)
            if effort.left <= max(GENERAL_TOLERANCE, tolerance):
                return answer
            self._leave_grid()
            self._eliminated()
        assert self._matrix is not None
        assert self._scale is not None
        rows, columns = self._scale
        answer, good = _refined(self._lu, self._matrix, rows * load)
        if not good:
            self._lu = eliminate(self._matrix, threshold=1.0)
            answer, good = _refined(self._lu, self._matrix, rows * load)
        if not good:
            raise FilmNotConverged("the linearised film balance is singular", "a boundary that holds a pressure")
        return columns * answer

    def _leave_grid(self) -> None:
        self._grid = self._on_grid = None

    def _eliminated(self) -> None:
        """Afterwards `_lu` is an elimination with pivots on the diagonal."""
        self._scaled()
        assert self._matrix is not None
        self._lu = eliminate(self._matrix)

    def _scaled(self) -> None:
        """Both triangles, with rows and columns scaled to a largest entry of one."""
        assert self._given is not None
        upper, lower = self._given
        if self._both is None:
            self._both = both_triangles(upper)
        entries = self._both.entries(upper.data, lower)
        columns = _largest(np.abs(entries), self._both.column, upper.shape[0])
        rows = _largest(np.abs(entries) / columns[self._both.column], self._both.indices, upper.shape[0])
        self._scale = 1.0 / rows, 1.0 / columns
        scaled = entries * self._scale[0][self._both.indices] * self._scale[1][self._both.column]
        self._matrix = self._both.matrix(scaled)


def _largest(values: Array, place: NDArray[np.int32], size: int) -> Array:
    """Largest value at each place, (size,)."""
    found = np.zeros(size)
    np.maximum.at(found, place, values)
    if not found.all():
        raise FilmNotConverged("a film balance that nothing enters", "a boundary that holds a pressure")
    return found


def eliminate(matrix: csc_array, threshold: float = 1e-3) -> SuperLU | None:
    """SuperLU (Li 2005); None where a pivot vanishes.

    threshold: of the largest in its column, below which a pivot is left; below 1 pivots are those of the diagonal
    where they can be, for a matrix of symmetric pattern.
    """
    options = {"SymmetricMode": threshold < 1.0, "Equil": False}
    order = "MMD_AT_PLUS_A" if threshold < 1.0 else "COLAMD"
    try:
        return splu(matrix, permc_spec=order, diag_pivot_thresh=threshold, options=options)
    except RuntimeError:  # "Factor is exactly singular"
        return None


def _refined(lu: SuperLU | None, matrix: csc_array, load: Array) -> tuple[Array, bool]:
    """Solution after one step of refinement, and True if its residual is small."""
    if lu is None:
        return load, False
    answer = lu.solve(load)
    answer += lu.solve(load - matrix @ answer)
    left = norm(load - matrix @ answer)
    # Rows are of order one: a backward stable answer has a residual of its own round-off, however small the load.
    allowed = GENERAL_TOLERANCE * norm(load) + ROUND_OFF * norm(answer)
    return answer, bool(left <= allowed)
