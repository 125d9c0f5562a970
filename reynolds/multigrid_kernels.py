"""Multigrid on lines, compiled once by numba: cycles and conjugate gradients.

Every second row is coarsened away (semicoarsening), rows are solved as a whole, even ones and odd ones in turn:
fast whatever the anisotropy, for a strong coupling along the rows is solved and one across them is coarsened.
The layout is that of `line_kernels`.
"""

import numpy as np
from numba import njit

from reynolds.line_kernels import above, below, close_row, couple_north, couple_south, off_row, substitute_rows

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}
_SUMS = _FAST | {"fastmath": {"contract", "reassoc", "nsz"}}  # lets a sum run in several parts at once


@njit(**_FAST)
def _solve_rows(a, r, step, count):
    """Solve `count` rows of `answer` in place."""
    substitute_rows(a.answer, a.pivot, a.east, r, step, count, a.answer.shape[1] - 2 - a.around_x)
    if a.around_x:
        for k in range(count):
            q = r + k * step
            close_row(a.answer[q], a.pivot[q], a.east[q], a.closing[q])


@njit(**_FAST)
def _relax(a, level, odd):
    """Solve the even or the odd rows of a level for their load and what they couple to."""
    first, m = a.first[level], a.rows[level]
    if a.around_y:
        a.answer[first + m + 1] = a.answer[first]
    for j in range(odd, m, 8):
        count = min(4, (m - j + 1) // 2)
        for k in range(count):
            off_row(a, a.answer[first + j + 2 * k], a.load[first + j + 2 * k], level, j + 2 * k)
        _solve_rows(a, first + j, 2, count)


@njit(**_FAST)
def _descend(a, level):
    """From nothing: relax even rows, then odd ones, and hand what is left in the even ones to the next level."""
    first, m = a.first[level], a.rows[level]
    for j in range(0, m, 8):
        count = min(4, (m - j + 1) // 2)
        for k in range(count):
            a.answer[first + j + 2 * k, 1:-1] = a.load[first + j + 2 * k, 1:-1]
        _solve_rows(a, first + j, 2, count)
    _relax(a, level, 1)
    _hand_down(a, level)


@njit(**_FAST)
def _hand_down(a, level):
    """The residual of even rows that hold for themselves, as the load of the next level."""
    first, m = a.first[level], a.rows[level]
    below = a.first[level + 1]
    if a.around_y:
        a.answer[first + m + 1] = a.answer[first]
    for j in range(0, m, 2):
        out = a.load[below + j // 2]
        out[:] = 0.0
        off_row(a, out, out, level, j)


@njit(**_FAST)
def _ascend(a, level):
    """Add the next level's answer to the even rows, relax odd ones and even ones: the mirror of `_descend`."""
    first, below = a.first[level], a.first[level + 1]
    for k in range(a.rows[level + 1]):
        x, e = a.answer[first + 2 * k], a.answer[below + k]
        for i in range(x.shape[0]):
            x[i] += e[i]
    _relax(a, level, 1)
    _relax(a, level, 0)


@njit(**_FAST)
def _coarsest(a):
    last = a.first.shape[0] - 1
    a.answer[a.first[last], 1:-1] = a.load[a.first[last], 1:-1]
    _solve_rows(a, a.first[last], 1, 1)


@njit(**_FAST)
def cycle(a):
    """answer of the finest level = M load: a symmetric V-cycle from nothing."""
    last = a.first.shape[0] - 1
    for level in range(last):
        _descend(a, level)
    _coarsest(a)
    for level in range(last - 1, -1, -1):
        _ascend(a, level)


@njit(**_FAST)
def full_cycle(a):
    """answer of the finest level: full multigrid, a cycle on every level from the coarsest up (Brandt 1977)."""
    last = a.first.shape[0] - 1
    for level in range(last):
        first, m = a.first[level], a.rows[level]
        for j in range(0, m, 2):
            a.answer[first + j] = 0.0
        _relax(a, level, 1)
        _hand_down(a, level)
        _add_own(a, level)
    _coarsest(a)
    for level in range(last - 1, -1, -1):
        _ascend_to(a, level)
        _relax(a, level, 1)
        _hand_down(a, level)
        _add_own(a, level)
        for k in range(level + 1, last):
            _descend(a, k)
        _coarsest(a)
        for k in range(last - 1, level - 1, -1):
            _ascend(a, k)


@njit(**_FAST)
def _add_own(a, level):
    """Add load minus the row's own couplings of even rows to the load of the next level."""
    n = a.answer.shape[1] - 2
    for k in range(a.rows[level + 1]):
        r = a.first[level] + 2 * k
        out, f, x, c, e = a.load[a.first[level + 1] + k], a.load[r], a.answer[r], a.centre[r], a.east[r]
        for i in range(1, n + 1):
            out[i] += f[i] - c[i] * x[i] - e[i] * x[i + 1] - e[i - 1] * x[i - 1]


@njit(**_FAST)
def _ascend_to(a, level):
    """The next level's answer as this level's first guess."""
    first, below = a.first[level], a.first[level + 1]
    for k in range(a.rows[level + 1]):
        a.answer[first + 2 * k] = a.answer[below + k]
    _relax(a, level, 1)
    _relax(a, level, 0)


@njit(**_SUMS)
def _apply(a, x, out):
    """out = A x on the finest level; x has its repeated columns and rows. Returns x . A x."""
    n, m = x.shape[1] - 2, a.rows[0]
    total = 0.0
    for j in range(m):
        s, t = below(a, 0, j), above(a, 0, j)
        c, e, r = a.centre[j], a.east[j], out[j]
        x_row = x[j]
        for i in range(1, n + 1):
            r[i] = -c[i] * x_row[i] - e[i] * x_row[i + 1] - e[i - 1] * x_row[i - 1]
        couple_north(r, r, a.north[j], a.north_east[j], a.north_west[j], x[t])
        couple_south(r, a.north[s], a.north_east[s], a.north_west[s], x[s])
        for i in range(1, n + 1):
            r[i] = -r[i]
            total += r[i] * x_row[i]
    return total


@njit(**_FAST)
def _repeat(a, x):
    """Fill the repeated columns and the repeated row of a vector of the finest level."""
    n, m = x.shape[1] - 2, a.rows[0]
    if a.around_x:
        for j in range(m):
            x[j, 0] = x[j, n]
            x[j, n + 1] = x[j, 1]
    if a.around_y:
        x[m + 1] = x[0]


@njit(**_FAST)
def conjugate_gradients(a, x, direction, tolerance, most):
    """Solve A x = load of the finest level, which is lost; returns steps and |load|.

    Hestenes and Stiefel 1952. Stops short where the operator or the cycle is not positive.
    """
    m = a.rows[0]
    load, answer = a.load[:m], a.answer[:m]
    size = _dot(load, load)
    if not 0.0 < size < np.inf:
        x[:] = 0.0
        return 0, size
    goal = tolerance * tolerance * size
    x[:] = 0.0
    left, steps, before = size, 0, 1.0
    while left > goal and steps < most:
        cycle(a)
        now = _dot(load, answer)
        if not now > 0.0:
            break
        _combine(direction, answer, now / before if steps else 0.0)
        _repeat(a, direction)
        curvature = _apply(a, direction, answer)  # the cycle's answer is no longer needed
        if not curvature > 0.0:
            break
        length = now / curvature
        _move(x, direction, length, m)
        left = _step(load, answer, length)
        before = now
        steps += 1
    return steps, np.sqrt(size)


@njit(**_FAST)
def left_of(a, x):
    """|load - A x| on the finest level, whose load ends as that residual."""
    _repeat(a, x)
    m = a.rows[0]
    _apply(a, x, a.answer)
    return np.sqrt(_step(a.load[:m], a.answer[:m], 1.0))


@njit(**_SUMS)
def _dot(a, b):
    total = 0.0
    for j in range(a.shape[0]):
        p, q = a[j], b[j]
        part = 0.0
        for i in range(1, p.shape[0] - 1):
            part += p[i] * q[i]
        total += part
    return total


@njit(**_FAST)
def _combine(direction, answer, beta):
    for j in range(answer.shape[0]):
        p, q = direction[j], answer[j]
        for i in range(p.shape[0]):
            p[i] = q[i] + beta * p[i]


@njit(**_FAST)
def _move(x, direction, length, m):
    for j in range(m):
        p, q = x[j], direction[j]
        for i in range(p.shape[0]):
            p[i] += length * q[i]


@njit(**_SUMS)
def _step(residual, image, length):
    """residual -= length image; returns its square."""
    total = 0.0
    for j in range(residual.shape[0]):
        p, q = residual[j], image[j]
        for i in range(1, p.shape[0] - 1):
            p[i] -= length * q[i]
            total += p[i] * p[i]
    return total


@njit(**_FAST)
def spread(data, places, stencils):
    """Put the entries of the upper triangle where they stand in the stencils."""
    flat = stencils.ravel()
    for k in range(places.shape[0]):
        flat[places[k]] = data[k]


@njit(**_FAST)
def to_rows(values, unknowns, out):
    """A vector over the unknowns as rows of the finest level."""
    for j in range(unknowns.shape[0]):
        for i in range(unknowns.shape[1]):
            out[j, i + 1] = values[unknowns[j, i]]


@njit(**_FAST)
def from_rows(x, unknowns, out):
    """Rows of the finest level as a vector over the unknowns."""
    for j in range(unknowns.shape[0]):
        for i in range(unknowns.shape[1]):
            out[unknowns[j, i]] = x[j, i + 1]
