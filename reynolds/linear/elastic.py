"""Linear solver of the film coupled to elastic walls, J = A + B C, for any load.

A, sparse, is the balance between rigid walls, B, sparse, its slope by the deformation, C the walls' compliance. A film
smooths the walls' feedback: except for a few smooth pressures A^-1 B C is small, on any mesh, so that GMRES (Saad and
Schultz 1986) on J A^-1 takes a few tens of solves with A, where a dense factor of J costs size^3. Up to DENSE_LIMIT
free pressures the factor is cheaper all the same (803 of 1575 unknowns: 28 ms, and .4 ms a load; GMRES takes 30 to 100
steps of .9 ms a load). Beyond, for more loads on one balance or on similar ones, the dense factor is made and kept:
GMRES on J J_before^-1 takes a few steps.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack
from scipy.sparse import csc_array, csr_array
from scipy.sparse.linalg import SuperLU, splu

from reynolds.bodies.compliance import WallOperator, columns_of, compliance_of, contact_of
from reynolds.errors import FilmNotConverged
from reynolds.linear import elastic_kernels as kernels
from reynolds.linear.factor import eliminate
from reynolds.numerics.arrays import Array
from reynolds.numerics.gmres import gmres

DENSE_LIMIT = 1500  # free pressures up to which a dense factor is as fast as GMRES on two loads
SMALL = 600  # coupled unknowns up to which the whole matrix is factorised as fast as it is reduced
KEPT_LIMIT = 4000  # unknowns up to which a dense factor is kept: 128 MB
MOST_STEPS = 150  # of GMRES; one that needs more is cheaper with the dense factor
WORTH = 1.0 / 80.0  # steps over unknowns that cost as much as the dense factor
GOOD_ENOUGH = 1e-9  # residual over load, where round-off allows no less
Answer = Callable[[Array, float], Array]
"""(load (size,), tolerance) -> change (size,) with |J change - load| <= tolerance |load|, round-off allowing."""


def rows_of(answer: Answer) -> Answer:
    """The answer for rows of loads (m, size): at once by a dense factor, else one by one."""

    def solved(loads: Array, tolerance: float) -> Array:
        if isinstance(answer, _Iterated):
            return np.array([answer(load, tolerance) for load in loads])
        return np.asarray(answer(np.ascontiguousarray(loads.T), tolerance).T)

    return solved


class NearFactor:
    """The dense factor of a balance, kept for later ones."""

    def __init__(self) -> None:
        self.answer: Answer | None = None


@dataclass(frozen=True)
class WallBalance:
    """J = A + B C P: A `rigid` (size, size), B `slope` (size, vertices), C `wider` (vertices, size).

    P is the diagonal `pressures` (size,), one where an unknown is a free pressure, else zero.
    """

    rigid: csc_array
    slope: csr_array
    wider: WallOperator
    pressures: Array

    def __matmul__(self, change: Array) -> Array:
        """J change, (size,)."""
        return np.asarray(self.rigid @ change + self.slope @ (self.wider @ (self.pressures * change)))


def compliant_answer(balance: WallBalance, near: NearFactor | None = None) -> Answer:
    """The answer of J; every factor is made once.

    `near` keeps the dense factor of a balance for later ones of its size. Raises FilmNotConverged where J is singular.
    """
    size = len(balance.pressures)
    if isinstance(balance.wider, csr_array):
        return sparse_answer(csc_array(balance.rigid + balance.slope @ (balance.wider * balance.pressures[None, :])))
    if np.count_nonzero(balance.pressures) <= DENSE_LIMIT:
        alone = _alone(balance)
        return reduced_answer(balance) if size - np.count_nonzero(alone) > SMALL else _coupled_answer(balance, alone)
    return _Iterated(balance, NearFactor() if near is None or size > KEPT_LIMIT else near)


class _Iterated:
    """Answer by GMRES, with the factor of a similar balance or of the rigid one, until its own factor pays."""

    def __init__(self, balance: WallBalance, near: NearFactor) -> None:
        self._balance, self._near = balance, near
        self._size = len(balance.pressures)
        # Rows are scaled, since flows of a thin film nearly vanish.
        diagonal = np.abs(balance.rigid.diagonal())
        self._rows = 1.0 / np.where(diagonal > 0.0, diagonal, 1.0)
        self._before = near.answer or _rigid_answer(balance.rigid)
        self._steps = 0
        self._own: Answer | None = None

    def __call__(self, load: Array, tolerance: float) -> Array:
        if self._own is None and self._before is not None and self._steps < WORTH * self._size:
            found = self._iterated(self._before, load, tolerance)
            if found is not None:
                return found
        if self._own is None:  # J need not be singular where A is
            self._own = self._near.answer = reduced_answer(self._balance)
        return self._own(load, tolerance)

    def _iterated(self, before: Answer, load: Array, tolerance: float) -> Array | None:
        def image(part: Array) -> Array:
            self._steps += 1
            return self._rows * (self._balance @ before(part, 0.0))

        most = MOST_STEPS if self._near.answer is None else max(1, int(WORTH * self._size))
        part, left = gmres(image, self._rows * load, tolerance, most)
        return before(part, 0.0) if left <= max(tolerance, GOOD_ENOUGH) else None


def reduced_answer(balance: WallBalance) -> Answer:
    """The answer of J by the dense factor of its Schur complement for the pressures on the walls."""
    alone = _alone(balance)
    rest = np.flatnonzero((balance.pressures == 0.0) & ~alone)
    factor = eliminate(csc_array(csr_array(balance.rigid)[rest][:, rest])) if rest.size else None
    if factor is None and rest.size:  # J need not be singular where the part without deformation is
        return _whole_answer(balance, np.flatnonzero(balance.pressures))
    return _Reduced(balance, np.flatnonzero(alone), rest, factor)


class _Reduced:
    """J by the pressures t of oil and contact together.

    With C the walls' own compliance, S the contact's pressure by the gap and w = C t: p = t - S w, and J p = A t +
    (B - A S) C t, so that the compliance with contact is not needed. Held unknowns, `alone`, couple to no other.
    The `rest`, a cavity's film fractions, deform no wall: of J_rr, J_rt; J_tr, J_tt the first column is sparse,
    and J_tt - J_tr J_rr^-1 J_rt remains.
    """

    def __init__(
        self, balance: WallBalance, alone: NDArray[np.intp], rest: NDArray[np.intp], factor: SuperLU | None
    ) -> None:
        rigid, contact = csr_array(balance.rigid), contact_of(balance.wider)
        free = np.flatnonzero(balance.pressures)
        self._free, self._alone, self._rest = free, alone, rest
        # Contact presses on the walls of a cavity too, where the oil's pressure is constant.
        touched = np.flatnonzero((np.diff(contact.indptr) > 0) & (balance.pressures == 0.0))
        self._opens = columns_of(compliance_of(balance.wider), np.concatenate([free, touched]))
        slope = csr_array(balance.slope - rigid[:, free] @ contact[free])
        left = np.vstack([slope[free] @ self._opens, -(contact[touched] @ self._opens)])
        _add(left, csr_array(rigid[free][:, free]))
        left[range(free.size, len(left)), range(free.size, len(left))] += 1.0
        self._forth = np.asarray(slope[rest] @ self._opens)
        _add(self._forth, csr_array(rigid[rest][:, free]))
        coupled = csr_array(rigid[free][:, rest])
        self._met = np.flatnonzero(np.diff(coupled.indptr))  # next to the rest: few
        self._back = np.zeros((len(self._met), rest.size))
        if factor is not None:
            self._back = factor.solve(coupled[self._met].toarray().T, trans="T").T
            left[self._met] -= self._back @ self._forth
        self._factor, self._reduced, self._size = factor, dense_answer(left), len(left)
        self._contact, self._diagonal = csr_array(contact[free]), rigid.diagonal()[alone]

    def __call__(self, load: Array, tolerance: float) -> Array:
        change, wanted = np.empty_like(load), np.zeros((self._size, *load.shape[1:]))
        wanted[: self._free.size] = load[self._free]
        wanted[self._met] -= self._back @ load[self._rest]
        solved = self._reduced(wanted, tolerance)
        change[self._free] = solved[: self._free.size]
        if self._contact.nnz:
            change[self._free] -= self._contact @ (self._opens @ solved)
        change[self._alone] = (load[self._alone].T / self._diagonal).T
        if self._factor is not None:
            change[self._rest] = self._factor.solve(load[self._rest] - self._forth @ solved)
        return change


def _alone(balance: WallBalance) -> NDArray[np.bool_]:
    """Held unknowns, which couple to no other, (size,)."""
    alone, rigid, slope = np.empty(len(balance.pressures), dtype=bool), balance.rigid, balance.slope
    kernels.mark_alone(_parts(rigid), _parts(slope), balance.pressures, alone)
    return alone


def _parts(matrix: csc_array | csr_array) -> tuple[NDArray[np.int32], NDArray[np.int32], Array]:
    return matrix.indptr, matrix.indices, matrix.data


def _add(dense: Array, sparse: csr_array) -> None:
    """Add a sparse matrix to the first columns and rows of a dense one."""
    entries = sparse.tocoo()
    np.add.at(dense, entries.coords, entries.data)


def _coupled_answer(balance: WallBalance, alone: NDArray[np.bool_]) -> Answer:
    """The answer of J by the dense factor of its unknowns except held ones, `alone`, which couple to no other."""
    number, coupled = np.where(alone, -1, np.cumsum(~alone) - 1), np.flatnonzero(~alone)
    wider = columns_of(balance.wider, coupled) * balance.pressures[coupled]
    matrix = np.empty((len(coupled), len(coupled)))
    kernels.assemble(number, _parts(balance.rigid), _parts(balance.slope), wider, matrix)
    inner, diagonal = dense_answer(matrix), balance.rigid.diagonal()

    def answer(load: Array, tolerance: float) -> Array:
        change = (load.T / diagonal).T
        change[coupled] = inner(load[coupled], tolerance)
        return np.asarray(change)

    return answer


def _whole_answer(balance: WallBalance, free: NDArray[np.intp]) -> Answer:
    """The answer of J by its dense factor, nothing eliminated beforehand; `free`: where pressures are free."""
    whole = balance.rigid.toarray(order="F")
    whole[:, free] += balance.slope @ columns_of(balance.wider, free)
    return dense_answer(whole)


def _rigid_answer(rigid: csc_array) -> Answer | None:
    factor = eliminate(rigid)
    return None if factor is None else lambda load, _: np.asarray(factor.solve(load))


def sparse_answer(matrix: csc_array) -> Answer:
    """The answer of a sparse matrix, for loads of any number of columns. Raises FilmNotConverged if singular."""
    try:
        factor = splu(matrix)
    except RuntimeError as reason:  # "Factor is exactly singular"
        raise _singular(str(reason)) from None
    return lambda load, tolerance: np.asarray(factor.solve(load))


def dense_answer(matrix: Array) -> Answer:
    """The answer of a dense matrix, for loads of any number of columns. Raises FilmNotConverged if singular.

    A matrix by rows is factorised as the transpose that it is by columns, in its place.
    """
    if not matrix.size:
        return lambda load, tolerance: load
    by_rows = matrix.flags.c_contiguous
    factor, pivots, fault = lapack.dgetrf(matrix.T if by_rows else matrix, overwrite_a=by_rows)
    if fault:
        raise _singular("a pivot is zero")
    return lambda load, tolerance: np.asarray(lapack.dgetrs(factor, pivots, load, trans=by_rows)[0])


def _singular(reason: str) -> FilmNotConverged:
    """The error of a singular balance."""
    what = f"the balance between elastic walls is singular ({reason})"
    return FilmNotConverged(what, "stiffer walls, or a thicker film")
