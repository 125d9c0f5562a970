"""Coarse levels of multigrid on lines, compiled once by numba: weights, operators P^T A P and row factors.

Interpolation follows the operator (Schaffer 1998): T w = -B 1 for T an odd row and B its coupling to a neighbour.
Coarse operators have nine-point stencils again.
"""

import numpy as np
from numba import njit

from reynolds.line_kernels import (
    below,
    close_row,
    pivots,
    pivots_four,
    substitute,
    substitute_rows,
    substitute_two,
)

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}


@njit(**_FAST)
def set_up(a):
    """Coarse operators and row factors of all levels from the finest stencil; False where it is not positive."""
    n = a.centre.shape[1] - 2
    scratch = np.zeros((4, n + 2))
    for level in range(a.first.shape[0]):
        first, m = a.first[level], a.rows[level]
        if a.around_x:
            for r in range(first, first + m):
                a.east[r, 0] = a.east[r, n]
                a.north_east[r, 0] = a.north_east[r, n]
                a.north_west[r, n + 1] = a.north_west[r, 1]
        if not _factorise(a, first, m):
            return False
        if level + 1 < a.first.shape[0]:
            _coarsen(a, level, scratch)
    return True


@njit(**_FAST)
def _factorise(a, first, m):
    """L D L^T of every row of a level; False where a pivot is not positive."""
    n = a.centre.shape[1] - 2
    inner = n - a.around_x
    done = 0
    while done + 4 <= m:
        pivots_four(a.centre, a.east, a.pivot, first + done, inner)
        done += 4
    for r in range(first + done, first + m):
        pivots(a.centre[r], a.east[r], a.pivot[r], inner)
    if a.around_x:
        z = a.closing
        for r in range(first, first + m):
            z[r] = 0.0
            z[r, 1] = a.east[r, n]
            z[r, n - 1] += a.east[r, n - 1]
        substitute_rows(z, a.pivot, a.east, first, 1, m, inner)
        for r in range(first, first + m):
            a.pivot[r, n] = 1.0 / (a.centre[r, n] - a.east[r, n] * z[r, 1] - a.east[r, n - 1] * z[r, n - 1])
    good = True
    for r in range(first, first + m):
        p = a.pivot[r]
        for i in range(1, n + 1):
            good &= 0.0 < p[i] < np.inf
    return good


@njit(**_FAST)
def _weights(a, level, j, scratch):
    """Interpolation of odd row j from its neighbours: T w = - sum of its couplings to that neighbour.

    T is the row, with as much diagonal as makes the two weights one together where there are two neighbours:
    what a held end of the row has taken out of the matrix shall not shorten them.
    """
    south, north, pivot, closing = scratch[0], scratch[1], scratch[2], scratch[3]
    n = south.shape[0] - 2
    r, s = a.first[level] + j, below(a, level, j)
    b, be, bw = a.north[s], a.north_east[s, :-1], a.north_west[s, 1:]
    c, ce, cw = a.north[r], a.north_east[r], a.north_west[r]
    centre, east, west = a.centre[r], a.east[r], a.east[r, :-1]
    for i in range(1, n + 1):
        south[i] = -b[i] - be[i - 1] - bw[i]
        north[i] = -c[i] - ce[i] - cw[i]
        whole = south[i] + north[i] - east[i] - west[i - 1]
        # By all three couplings: the straight one alone may vanish where the corners carry everything.
        pivot[i] = whole if south[i] != 0.0 and north[i] != 0.0 and whole > 0.0 else centre[i]
    pivots(pivot, east, pivot, n - a.around_x)
    substitute_two(south, north, pivot, east, n - a.around_x)
    if a.around_x:
        last = pivot[n]
        closing[:] = 0.0
        closing[1] = east[n]
        closing[n - 1] += east[n - 1]
        substitute(closing, pivot, east, n - 1)
        pivot[n] = 1.0 / (last - east[n] * closing[1] - east[n - 1] * closing[n - 1])
        close_row(south, pivot, east, closing)
        close_row(north, pivot, east, closing)


@njit(**_FAST)
def _coarsen(a, level, scratch):
    """The next level's operator P^T A P, row by row."""
    south, north = scratch[0], scratch[1]
    first, m = a.first[level], a.rows[level]
    below, half = a.first[level + 1], a.rows[level + 1]
    for k in range(half):
        a.centre[below + k] = a.centre[first + 2 * k]
        a.east[below + k] = a.east[first + 2 * k]
    seam = a.around_y and m % 2 == 1  # the last even row meets the first without an odd one between
    if m % 2 == 1:
        direct = first + (m - 1 if seam else m)
        a.north[below + half - 1] = a.north[direct]
        a.north_east[below + half - 1] = a.north_east[direct]
        a.north_west[below + half - 1] = a.north_west[direct]
    for j in range(1, m, 2):
        _weights(a, level, j, scratch)
        k = j // 2
        _eliminate_row(a, first + j, below + k, south, north)
        if j + 1 < m:
            _add_north(a, first + j, below + k + 1, north)
        elif a.around_y:
            _add_north(a, first + j, below, north)
    if half == 1 and a.around_y:
        _fold(a, below)


@njit(**_FAST)
def _eliminate_row(a, r, k, ws, wn):
    """What odd row r adds to the coarse row k south of it, and that row's coupling to the one north of it."""
    n = ws.shape[0] - 2
    c, e, b = a.centre[r], a.east[r], a.north[r - 1]
    be, bw = a.north_east[r - 1], a.north_west[r - 1]
    nn, ne, nw = a.north[r], a.north_east[r], a.north_west[r]
    centre, east = a.centre[k], a.east[k]
    for i in range(1, n + 1):
        centre[i] += ws[i] * (ws[i] * c[i] + 2.0 * b[i])
        east[i] += ws[i] * (ws[i + 1] * e[i] + bw[i + 1]) + ws[i + 1] * be[i]
    north, north_east, north_west = a.north[k], a.north_east[k], a.north_west[k]
    for i in range(1, n + 1):
        north[i] = ws[i] * (c[i] * wn[i] + nn[i]) + b[i] * wn[i]
        north_east[i] = ws[i] * (e[i] * wn[i + 1] + ne[i]) + be[i] * wn[i + 1]
        north_west[i] = ws[i] * (e[i - 1] * wn[i - 1] + nw[i]) + bw[i] * wn[i - 1]


@njit(**_FAST)
def _add_north(a, r, k, wn):
    """What odd row r adds to the coarse row k north of it."""
    n = wn.shape[0] - 2
    c, e, nn, ne, nw = a.centre[r], a.east[r], a.north[r], a.north_east[r], a.north_west[r]
    centre, east = a.centre[k], a.east[k]
    for i in range(1, n + 1):
        centre[i] += wn[i] * (wn[i] * c[i] + 2.0 * nn[i])
        east[i] += wn[i] * (wn[i + 1] * e[i] + ne[i]) + wn[i + 1] * nw[i + 1]


@njit(**_FAST)
def _fold(a, k):
    """A single row that is its own northern neighbour: its couplings to itself belong to the row."""
    n = a.centre.shape[1] - 2
    if a.around_x:
        a.north_west[k, n + 1] = a.north_west[k, 1]
    for i in range(1, n + 1):
        a.centre[k, i] += 2.0 * a.north[k, i]
        a.east[k, i] += a.north_east[k, i] + a.north_west[k, i + 1]
    a.north[k] = 0.0
    a.north_east[k] = 0.0
    a.north_west[k] = 0.0
