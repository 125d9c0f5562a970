"""Kernels of the film with oil in its cavities (see `cavitated`), compiled once by numba.

The matrix is stored by columns, both triangles: indptr, indices, entries.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from reynolds.linear.multigrid.cycle_kernels import cycle, put, take

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}
_SUMS = _FAST | {"fastmath": {"contract", "reassoc", "nsz"}}  # lets a sum run in several parts at once

NEGLIGIBLE = 1e-12  # of an unknown's flow downstream: less is round-off, and sets no order
MOST_RETURNED = 1.0 - 1e-3  # a film that cavities return all to would have no level


class CavitatedColumns(NamedTuple):
    """A matrix in columns (indptr, indices, entries) and its diagonal (n,); separately, the cavity's transport.

    order: the cavity's unknowns downstream; begin, row, value: their columns without diagonal; edge: the entries
    by which columns of the film, edge_column, reach the cavity.
    """

    indptr: NDArray[np.int32]
    indices: NDArray[np.int32]
    entries: NDArray[np.float64]
    diagonal: NDArray[np.float64]
    cavity: NDArray[np.bool_]
    order: NDArray[np.int32]
    begin: NDArray[np.int32]
    row: NDArray[np.int32]
    value: NDArray[np.float64]
    edge: NDArray[np.int32]
    edge_column: NDArray[np.int32]


@njit(**_FAST)
def film_part(indptr, indices, upper, lower, cavity, returned, out):
    """The upper triangle of the film alone, symmetric, the identity in the cavity.

    Flow that the film's pressure drives into an unknown of the cavity and the cavity returns at once is not lost
    to the film: where a film reforms, the cavity before it does not hold its pressure. `returned` (n,) is the
    share, found on the way.
    """
    n = indptr.shape[0] - 1
    returned[:] = 0.0
    for j in range(n):
        for k in range(indptr[j], indptr[j + 1]):
            i = indices[k]
            if cavity[i] and not cavity[j]:
                returned[i] -= lower[k]
            elif cavity[j] and not cavity[i]:
                returned[j] -= upper[k]
    for j in range(n):
        d = indptr[j + 1] - 1
        if cavity[j]:
            returned[j] = min(max(returned[j] / upper[d], 0.0), MOST_RETURNED)
        out[d] = 1.0 if cavity[j] else upper[d]
    for j in range(n):
        for k in range(indptr[j], indptr[j + 1] - 1):
            i = indices[k]
            out[k] = 0.0 if cavity[i] or cavity[j] else 0.5 * (upper[k] + lower[k])
            if cavity[i] and not cavity[j]:
                out[indptr[j + 1] - 1] += returned[i] * upper[k]
            elif cavity[j] and not cavity[i]:
                out[indptr[i + 1] - 1] += returned[j] * lower[k]


@njit(inline="always")
def _transports(entries, diagonal, k, j):
    return abs(entries[k]) > NEGLIGIBLE * abs(diagonal[j])


@njit(**_FAST)
def flow_order(indptr, indices, entries, diagonal, cavity, order, waits):
    """Cavity unknowns with those upstream first (Kahn 1962); a ring of flow is entered somewhere. Their number."""
    n = cavity.shape[0]
    waits[:] = 0
    for j in range(n):
        if cavity[j]:
            for k in range(indptr[j], indptr[j + 1]):
                if indices[k] != j and _transports(entries, diagonal, k, j):
                    waits[indices[k]] += 1
    end = 0
    for j in range(n):
        if cavity[j] and waits[j] == 0:
            order[end] = j
            end += 1
    begin, ring = 0, 0
    while True:
        while begin < end:
            j = order[begin]
            begin += 1
            for k in range(indptr[j], indptr[j + 1]):
                i = indices[k]
                if i != j and cavity[i] and _transports(entries, diagonal, k, j):
                    waits[i] -= 1
                    if waits[i] == 0:
                        order[end] = i
                        end += 1
        while ring < n and not (cavity[ring] and waits[ring] > 0):
            ring += 1
        if ring == n:
            return end
        waits[ring] = -n
        order[end] = ring
        end += 1


@njit(**_FAST)
def sort_columns(m):
    """Fill the cavity's part of `CavitatedColumns`; the number of edges."""
    at = edges = 0
    for place in range(m.order.shape[0]):
        j = m.order[place]
        m.begin[place] = at
        for k in range(m.indptr[j], m.indptr[j + 1]):
            if m.indices[k] != j and m.entries[k] != 0.0:
                m.row[at], m.value[at] = m.indices[k], m.entries[k]
                at += 1
    m.begin[m.order.shape[0]] = at
    for j in range(m.cavity.shape[0]):
        if not m.cavity[j]:
            for k in range(m.indptr[j], m.indptr[j + 1]):
                if m.cavity[m.indices[k]]:
                    m.edge[edges], m.edge_column[edges] = k, j
                    edges += 1
    return edges


@njit(**_FAST)
def _multiply(m, x, out):
    """out = A x."""
    out[:] = 0.0
    for j in range(x.shape[0]):
        if not m.cavity[j]:
            for k in range(m.indptr[j], m.indptr[j + 1]):
                out[m.indices[k]] += m.entries[k] * x[j]
    for place in range(m.order.shape[0]):
        j = m.order[place]
        out[j] += m.diagonal[j] * x[j]
        for k in range(m.begin[place], m.begin[place + 1]):
            out[m.row[k]] += m.value[k] * x[j]


@njit(**_FAST)
def _sweep(m, rest):
    """Solve for the cavity downstream, in place: `rest` of the film ends less the cavity's flow into it."""
    for place in range(m.order.shape[0]):
        j = m.order[place]
        scaled = rest[j] / m.diagonal[j]
        for k in range(m.begin[place], m.begin[place + 1]):
            rest[m.row[k]] -= m.value[k] * scaled
        rest[j] = scaled


@njit(**_FAST)
def _precondition(levels, slots, m, load, rest, out):
    """out = M load: the cavity, a cycle on the film with the cavity's flow, and the cavity once more."""
    fine, coarse, coarsest = levels
    rest[:] = load
    _sweep(m, rest)
    for j in m.order:
        rest[j] = 0.0
    put(rest, slots, fine.load)
    cycle(fine, coarse, coarsest)
    take(fine.answer, slots, out)
    rest[:] = load
    for k in range(m.edge.shape[0]):
        rest[m.indices[m.edge[k]]] -= m.entries[m.edge[k]] * out[m.edge_column[k]]
    _sweep(m, rest)
    for j in m.order:
        out[j] = rest[j]


@njit(**_FAST)
def _multiply_transposed(m, x, out):
    """out = A^T x."""
    for j in range(x.shape[0]):
        total = 0.0
        for k in range(m.indptr[j], m.indptr[j + 1]):
            total += m.entries[k] * x[m.indices[k]]
        out[j] = total


@njit(**_FAST)
def _sweep_back(m, load, out):
    """Solve the transpose for the cavity upstream, in `out`, which has the film's part."""
    for place in range(m.order.shape[0] - 1, -1, -1):
        j = m.order[place]
        total = load[j]
        for k in range(m.begin[place], m.begin[place + 1]):
            total -= m.value[k] * out[m.row[k]]
        out[j] = total / m.diagonal[j]


@njit(**_FAST)
def _precondition_transposed(levels, slots, m, load, rest, out):
    """out = M^T load: the steps of `_precondition` backwards, each transposed."""
    fine, coarse, coarsest = levels
    out[:] = 0.0
    _sweep_back(m, load, out)
    rest[:] = load
    for k in range(m.edge.shape[0]):
        rest[m.edge_column[k]] -= m.entries[m.edge[k]] * out[m.indices[m.edge[k]]]
    for j in m.order:
        rest[j] = 0.0
    put(rest, slots, fine.load)
    cycle(fine, coarse, coarsest)
    take(fine.answer, slots, out)
    _sweep_back(m, load, out)


@njit(**_FAST)
def _conditioned(levels, slots, m, transposed, load, rest, out):
    if transposed:
        _precondition_transposed(levels, slots, m, load, rest, out)
    else:
        _precondition(levels, slots, m, load, rest, out)


@njit(**_FAST)
def _times(m, transposed, x, out):
    if transposed:
        _multiply_transposed(m, x, out)
    else:
        _multiply(m, x, out)


@njit(**_SUMS)
def _dot(a, b):
    total = 0.0
    for i in range(a.shape[0]):
        total += a[i] * b[i]
    return total


@njit(**_FAST)
def gmres(levels, slots, m, transposed, load, tolerance, basis, x):
    """One round of GMRES (Saad and Schultz 1986) preconditioned from the right, added to x; |load - A x|, steps.

    A is the matrix or, `transposed`, its transpose; `basis` (steps + 3, n) is room for the directions.
    """
    most = basis.shape[0] - 3
    image, rest = basis[most + 1], basis[most + 2]
    _times(m, transposed, x, image)
    for i in range(x.shape[0]):
        basis[0, i] = load[i] - image[i]
    size = np.sqrt(_dot(basis[0], basis[0]))
    if not tolerance < size < np.inf:
        return size, 0
    basis[0] /= size
    h = np.zeros((most + 1, most))
    cosine, sine, right = np.zeros(most), np.zeros(most), np.zeros(most + 1)
    right[0] = size
    steps = 0
    while steps < most and abs(right[steps]) > tolerance:
        k = steps
        _conditioned(levels, slots, m, transposed, basis[k], rest, image)
        _times(m, transposed, image, basis[k + 1])
        for j in range(k + 1):
            h[j, k] = _dot(basis[j], basis[k + 1])
            _add(basis[k + 1], basis[j], -h[j, k])
        h[k + 1, k] = np.sqrt(_dot(basis[k + 1], basis[k + 1]))
        for j in range(k):
            a, b = h[j, k], h[j + 1, k]
            h[j, k], h[j + 1, k] = cosine[j] * a + sine[j] * b, cosine[j] * b - sine[j] * a
        radius = np.hypot(h[k, k], h[k + 1, k])
        steps += 1
        if not 0.0 < radius < np.inf:
            steps -= 1
            break
        cosine[k], sine[k] = h[k, k] / radius, h[k + 1, k] / radius
        if h[k + 1, k] > 0.0:
            basis[k + 1] /= h[k + 1, k]
        h[k, k], right[k], right[k + 1] = radius, cosine[k] * right[k], -sine[k] * right[k]
    for k in range(steps - 1, -1, -1):
        for j in range(k + 1, steps):
            right[k] -= h[k, j] * right[j]
        right[k] /= h[k, k]
    total = basis[most]
    total[:] = 0.0
    for k in range(steps):
        _add(total, basis[k], right[k])
    _conditioned(levels, slots, m, transposed, total, rest, image)
    _add(x, image, 1.0)
    _times(m, transposed, x, image)
    for i in range(x.shape[0]):
        image[i] = load[i] - image[i]
    return np.sqrt(_dot(image, image)), steps


@njit(**_FAST)
def _add(out, x, factor):
    for i in range(out.shape[0]):
        out[i] += factor * x[i]
