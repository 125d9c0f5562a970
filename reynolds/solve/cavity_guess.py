"""First guess of the cavity from coarser problems, for the active set.

The front of a cavity moves by about one cell per step of the active set, so that a cold start costs steps in proportion
to the mesh. Coarse problems are made of neighbouring unknowns (aggregation: Vanek, Mandel and Brezina 1996), so any
mesh has them; each starts from the answer of the next coarser one (cascade: Bornemann and Deuflhard 1996).
"""

from copy import copy
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array

from reynolds.fem import kernels
from reynolds.linear.factor import Factor
from reynolds.linear.multigrid.grid import Grid
from reynolds.numerics.array_kernels import norm
from reynolds.numerics.arrays import Array

COARSEST = 200  # unknowns: below this a cold start takes no more than a few steps
FINEST = 20_000  # unknowns: above this a coarse problem costs more than the steps that it saves
ACROSS = 3.0  # cells from the middle of an aggregate to the middle of the next
MAX_STEPS = 10  # per level: a guess need not converge
ROUGHLY = 1e-4  # of the load: only the sign of a pressure matters


@dataclass(frozen=True)
class Obstacle:
    """Find u >= 0 with A u - load >= 0 and u (A u - load) = 0, and u = 0 where it is `held`.

    entries: the upper triangle of A (n, n), symmetric positive definite and the identity where held, on a separate
    pattern; load (n,), zero where held.
    """

    entries: Array
    load: Array
    held: NDArray[np.bool_]


@dataclass(frozen=True)
class Coarser:
    """The next coarser problem of a pattern.

    aggregate (n,): coarse unknown of each unknown; crossing (couplings,): the entries of the finer upper triangle
    that couple two of them; slots: their indices in the coarser one, `upper`, whose own entries are not used.
    """

    aggregate: NDArray[np.int32]
    crossing: NDArray[np.int64]
    slots: NDArray[np.int32]
    upper: csc_array
    factor: Factor


class Cascade:
    """The coarse problems of one pattern, kept between films."""

    def __init__(self, upper: csc_array, grid: Grid | None = None) -> None:
        """`upper`: an upper triangle of the pattern; `grid`: rows and columns of the unknowns (`grid_of`)."""
        self._pattern = upper
        self._levels: list[Coarser] = []
        rows = None if grid is None else grid.unknowns
        while upper.shape[0] > COARSEST:
            aggregate, rows = _gather(upper) if rows is None else _blocks(rows)
            if len(aggregate) == aggregate.max() + 1:
                break  # no unknown has a neighbour
            self._levels.append(_coarser(upper, aggregate))
            upper = self._levels[-1].upper

    def cavity(self, problem: Obstacle) -> NDArray[np.bool_]:
        """The cavity: unknowns (n,) with u = 0 that are not held, to within a few cells.

        A guess, best where A has the signs of a film operator (no positive couplings): `active_set` makes it exact.
        """
        problems, tied = [problem], self._tied(problem)
        for level in self._levels:
            tied = _summed(tied, level.aggregate, level.upper.shape[0])
            problems.append(_gathered(level, problems[-1], tied))
        cavity = np.zeros(len(problems[-1].load), dtype=bool)
        for level, coarse in zip(reversed(self._levels), reversed(problems), strict=False):
            if len(coarse.load) <= FINEST:
                cavity = active_set(level.upper, level.factor, coarse, cavity)
            cavity = cavity[level.aggregate]
        return cavity & ~problem.held

    def _tied(self, problem: Obstacle) -> Array:
        """Row sums of A: couplings of each free unknown to held ones, (n,)."""
        tied, size = np.zeros(len(problem.load)), np.zeros(len(problem.load))
        entries, one = problem.entries, np.ones(len(problem.load))
        kernels.convect(self._pattern.indptr, self._pattern.indices, entries, entries, one, tied, size)
        return np.where(problem.held, 0.0, tied)


def active_set(pattern: csc_array, factor: Factor, problem: Obstacle, cavity: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The cavity from a guess near it: converged, or after MAX_STEPS steps of the active set.

    `factor` takes matrices of `pattern`, an upper triangle whose entries are not used.
    """
    indptr, indices, load = pattern.indptr, pattern.indices, problem.load
    upper, nothing, answer = copy(pattern), np.zeros(len(load)), np.zeros(len(load))
    upper.data, enough = np.empty_like(problem.entries), ROUGHLY * norm(load)
    for _ in range(MAX_STEPS):
        fixed = cavity | problem.held
        kernels.hold(indptr, indices, problem.entries, 1.0, fixed, nothing, upper.data)
        factor.update(upper)
        answer = np.where(fixed, 0.0, answer)
        left = np.where(fixed, 0.0, -_lack(pattern, problem, answer))
        if (size := norm(left)) > enough:
            answer += factor.solve(left, enough / size)
        lack = _lack(pattern, problem, answer)
        now = np.where(cavity, lack > 0.0, answer < 0.0) & ~problem.held
        if np.array_equal(now, cavity):
            break
        cavity = now
    return cavity


def _lack(pattern: csc_array, problem: Obstacle, answer: Array) -> Array:
    """A u - load, (n,)."""
    lack, size = -problem.load, np.zeros(len(answer))
    entries = problem.entries
    kernels.convect(pattern.indptr, pattern.indices, entries, entries, answer, lack, size)
    return lack


def _blocks(rows: NDArray[np.int32]) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Blocks of three by three unknowns in rows and columns, and the rows and columns of the blocks."""
    row, column = np.indices(rows.shape) // 3
    blocks = np.arange((row.max() + 1) * (column.max() + 1), dtype=np.int32).reshape(row.max() + 1, -1)
    aggregate = np.empty(rows.size, dtype=np.int32)
    aggregate[rows] = blocks[row, column]
    return aggregate, blocks


def _gather(upper: csc_array) -> tuple[NDArray[np.int32], None]:
    """Unknowns with those around them: patches about three across."""
    row, column = upper.indices, _columns(upper)
    ends = np.concatenate([row, column]), np.concatenate([column, row])
    graph = coo_array((np.ones(2 * len(row), dtype=bool), ends), shape=upper.shape).tocsr()
    return kernels.gather(graph.indptr, graph.indices), None


def _columns(upper: csc_array) -> NDArray[np.int32]:
    return np.repeat(np.arange(upper.shape[0], dtype=np.int32), np.diff(upper.indptr))


def _coarser(upper: csc_array, aggregate: NDArray[np.int32]) -> Coarser:
    row, column, count = upper.indices, _columns(upper), int(aggregate.max()) + 1
    one, two = aggregate[row], aggregate[column]
    crossing = np.flatnonzero(one != two)
    first, second = np.minimum(one, two), np.maximum(one, two)
    coarse = coo_array((np.zeros(len(row)), (first, second)), shape=(count, count)).tocsc()
    slots = np.empty((len(crossing), 1), dtype=np.int32)
    kernels.find_slots(coarse.indptr, coarse.indices, first[crossing, None], second[crossing, None], slots)
    return Coarser(aggregate, crossing, slots.ravel(), coarse, Factor())


def _gathered(level: Coarser, fine: Obstacle, tied: Array) -> Obstacle:
    """The coarser problem, without the held unknowns of the finer one.

    `tied` (n,): couplings of its unknowns to held ones. A level that is constant over each aggregate
    falls from one to the next within one cell instead of three, so that their couplings are three times too stiff.
    """
    indptr, indices = level.upper.indptr, level.upper.indices
    entries = _summed(fine.entries[level.crossing] / ACROSS, level.slots, len(indices))
    kernels.close_rows(indptr, indices, entries)
    diagonal = indptr[1:] - 1
    entries[diagonal] += tied
    held = np.bincount(level.aggregate[~fine.held], minlength=len(diagonal)) == 0
    entries[diagonal[held]] = 1.0
    return Obstacle(entries, _summed(fine.load, level.aggregate, len(diagonal)), held)


def _summed(values: Array, place: NDArray[np.int32], size: int) -> Array:
    """Sum of the values at each place, (size,)."""
    return np.asarray(np.bincount(place, weights=values, minlength=size), dtype=float)
