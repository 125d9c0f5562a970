"""Rows of nine-point stencils, compiled once by numba: their layout, couplings and direct solution.

Layout: a level of m rows takes m + 2 rows of the arrays: after its own one of zeros, which is the neighbour
where there is none, and one that repeats its first, which is the neighbour of the last where columns close on
themselves. Columns 1 to n are the unknowns, 0 and n + 1 repeat the far end where rows close on themselves.

Numba's cache watches a function's own file only: after a change here, touch the kernels that import it.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}


class Levels(NamedTuple):
    """Operators and vectors of all levels; arrays (all rows, n + 2).

    The symmetric stencil of an unknown: centre, and its coupling east, north, north-east and north-west.
    `pivot` is the inverse diagonal of each row's L D L^T; `closing` the row's answer to its last unknown.
    """

    centre: NDArray[np.float64]
    east: NDArray[np.float64]
    north: NDArray[np.float64]
    north_east: NDArray[np.float64]
    north_west: NDArray[np.float64]
    pivot: NDArray[np.float64]
    closing: NDArray[np.float64]
    answer: NDArray[np.float64]
    load: NDArray[np.float64]
    first: NDArray[np.int64]
    rows: NDArray[np.int64]
    around_x: bool
    around_y: bool


@njit(inline="always")
def below(a, level, j):
    """Array row of the southern neighbour of row j."""
    if j > 0:
        return a.first[level] + j - 1
    m = a.rows[level]
    return a.first[level] + (m - 1 if a.around_y else m)


@njit(inline="always")
def above(a, level, j):
    """Array row of the northern neighbour of row j."""
    m = a.rows[level]
    if j < m - 1:
        return a.first[level] + j + 1
    return a.first[level] + (m + 1 if a.around_y else m)


@njit(**_FAST)
def couple_north(out, load, north, east, west, beyond):
    """out = load minus the couplings to the row north of it; all of one row."""
    centre, right, left = beyond[1:-1], beyond[2:], beyond[:-2]
    o, f, n, e, w = out[1:-1], load[1:-1], north[1:-1], east[1:-1], west[1:-1]
    for i in range(o.shape[0]):
        o[i] = f[i] - n[i] * centre[i] - e[i] * right[i] - w[i] * left[i]


@njit(**_FAST)
def couple_south(out, north, east, west, beyond):
    """out -= the couplings to the row south of it, which holds them."""
    centre, right, left = beyond[1:-1], beyond[2:], beyond[:-2]
    o, n, e, w = out[1:-1], north[1:-1], east[:-2], west[2:]
    for i in range(o.shape[0]):
        o[i] -= n[i] * centre[i] + e[i] * left[i] + w[i] * right[i]


@njit(**_FAST)
def off_row(a, out, load, level, j):
    """out = load minus all couplings of row j to its two neighbours, which are taken from `answer`."""
    r, s, t = a.first[level] + j, below(a, level, j), above(a, level, j)
    couple_north(out, load, a.north[r], a.north_east[r], a.north_west[r], a.answer[t])
    couple_south(out, a.north[s], a.north_east[s], a.north_west[s], a.answer[s])


@njit(**_FAST)
def substitute(x, pivot, east, n):
    """Both substitutions of one row, in place, over its first n unknowns."""
    y = 0.0
    multiplier = 0.0
    for i in range(1, n + 1):
        y = x[i] - multiplier * y
        x[i] = y
        multiplier = east[i] * pivot[i]
    y = 0.0
    for i in range(n, 0, -1):
        y = pivot[i] * x[i] - (east[i] * pivot[i]) * y
        x[i] = y


@njit(**_FAST)
def substitute_two(x, z, pivot, east, n):
    """The same for two right-hand sides of one row at once."""
    y = w = multiplier = 0.0
    for i in range(1, n + 1):
        y = x[i] - multiplier * y
        w = z[i] - multiplier * w
        x[i], z[i] = y, w
        multiplier = east[i] * pivot[i]
    y = w = 0.0
    for k in range(n):
        i = n - k
        y = pivot[i] * x[i] - (east[i] * pivot[i]) * y
        w = pivot[i] * z[i] - (east[i] * pivot[i]) * w
        x[i], z[i] = y, w


@njit(**_FAST)
def _substitute_four(x, pivot, east, r, step, n):
    """The same in rows r, r + step, r + 2 step, r + 3 step at once: four chains hide each other's latency."""
    xa, xb, xc, xd = x[r], x[r + step], x[r + 2 * step], x[r + 3 * step]
    pa, pb, pc, pd = pivot[r], pivot[r + step], pivot[r + 2 * step], pivot[r + 3 * step]
    ea, eb, ec, ed = east[r], east[r + step], east[r + 2 * step], east[r + 3 * step]
    ya = yb = yc = yd = 0.0
    ma = mb = mc = md = 0.0
    for i in range(1, n + 1):
        ya = xa[i] - ma * ya
        yb = xb[i] - mb * yb
        yc = xc[i] - mc * yc
        yd = xd[i] - md * yd
        xa[i], xb[i], xc[i], xd[i] = ya, yb, yc, yd
        ma, mb, mc, md = ea[i] * pa[i], eb[i] * pb[i], ec[i] * pc[i], ed[i] * pd[i]
    ya = yb = yc = yd = 0.0
    for k in range(n):
        i = n - k
        ya = pa[i] * xa[i] - (ea[i] * pa[i]) * ya
        yb = pb[i] * xb[i] - (eb[i] * pb[i]) * yb
        yc = pc[i] * xc[i] - (ec[i] * pc[i]) * yc
        yd = pd[i] * xd[i] - (ed[i] * pd[i]) * yd
        xa[i], xb[i], xc[i], xd[i] = ya, yb, yc, yd


@njit(**_FAST)
def substitute_rows(x, pivot, east, r, step, count, n):
    """Both substitutions of `count` rows in place."""
    done = 0
    while done + 4 <= count:
        _substitute_four(x, pivot, east, r + done * step, step, n)
        done += 4
    for k in range(done, count):
        q = r + k * step
        substitute(x[q], pivot[q], east[q], n)


@njit(**_FAST)
def close_row(x, pivot, east, closing):
    """The last unknown of a row closed on itself, then the others, once the others are solved without it."""
    n = x.shape[0] - 2
    last = (x[n] - east[n] * x[1] - east[n - 1] * x[n - 1]) * pivot[n]
    o, z = x[1:n], closing[1:n]
    for i in range(n - 1):
        o[i] -= last * z[i]
    x[n] = last
    x[0] = last
    x[n + 1] = x[1]


@njit(**_FAST)
def pivots(c, e, p, n):
    """Inverse pivots p of a row with diagonal c and couplings e, over its first n unknowns; p may be c."""
    inverse = coupling = 0.0
    for i in range(1, n + 1):
        inverse = 1.0 / (c[i] - coupling * coupling * inverse)
        coupling = e[i]
        p[i] = inverse


@njit(**_FAST)
def pivots_four(centre, east, pivot, r, n):
    """The same in four rows at once, from row r on."""
    ca, cb, cc, cd = centre[r], centre[r + 1], centre[r + 2], centre[r + 3]
    ea, eb, ec, ed = east[r], east[r + 1], east[r + 2], east[r + 3]
    pa, pb, pc, pd = pivot[r], pivot[r + 1], pivot[r + 2], pivot[r + 3]
    a = b = c = d = 0.0
    ka = kb = kc = kd = 0.0
    for i in range(1, n + 1):
        a = 1.0 / (ca[i] - ka * ka * a)
        b = 1.0 / (cb[i] - kb * kb * b)
        c = 1.0 / (cc[i] - kc * kc * c)
        d = 1.0 / (cd[i] - kd * kd * d)
        ka, kb, kc, kd = ea[i], eb[i], ec[i], ed[i]
        pa[i], pb[i], pc[i], pd[i] = a, b, c, d
