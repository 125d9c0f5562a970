"""Multigrid on lines, compiled once by numba: set-up, cycles and conjugate gradients.

Every second row is coarsened away (semicoarsening), rows are solved as a whole, even ones and odd ones in turn:
fast whatever the anisotropy, for a strong coupling along the rows is solved and one across them is coarsened.
Interpolation follows the operator (Schaffer 1998): T w = -B 1 for T the row and B its coupling to a neighbour,
and coarse operators are P^T A P, again of nine points. Rows of all levels have one length, so that all levels
stand in one array, one below the other.

Layout: a level of m rows takes m + 2 rows of the arrays: after its own one of zeros, which is the neighbour
where there is none, and one that repeats its first, which is the neighbour of the last where columns close on
themselves. Columns 1 to n are the unknowns, 0 and n + 1 repeat the far end where rows close on themselves.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}
_SUMS = _FAST | {"fastmath": {"contract", "reassoc", "nsz"}}  # lets a sum run in several parts at once


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
def _below(a, level, j):
    """Array row of the southern neighbour of row j."""
    if j > 0:
        return a.first[level] + j - 1
    m = a.rows[level]
    return a.first[level] + (m - 1 if a.around_y else m)


@njit(inline="always")
def _above(a, level, j):
    m = a.rows[level]
    if j < m - 1:
        return a.first[level] + j + 1
    return a.first[level] + (m + 1 if a.around_y else m)


@njit(**_FAST)
def _couple(out, load, north, east, west, beyond):
    """out = load minus the couplings to the row north of it; all of one row."""
    centre, right, left = beyond[1:-1], beyond[2:], beyond[:-2]
    o, f, n, e, w = out[1:-1], load[1:-1], north[1:-1], east[1:-1], west[1:-1]
    for i in range(o.shape[0]):
        o[i] = f[i] - n[i] * centre[i] - e[i] * right[i] - w[i] * left[i]


@njit(**_FAST)
def _couple_south(out, north, east, west, beyond):
    """out -= the couplings to the row south of it, which holds them."""
    centre, right, left = beyond[1:-1], beyond[2:], beyond[:-2]
    o, n, e, w = out[1:-1], north[1:-1], east[:-2], west[2:]
    for i in range(o.shape[0]):
        o[i] -= n[i] * centre[i] + e[i] * left[i] + w[i] * right[i]


@njit(**_FAST)
def _off_row(a, out, load, level, j):
    """out = load minus all couplings of row j to its two neighbours, which are taken from `answer`."""
    r, s, t = a.first[level] + j, _below(a, level, j), _above(a, level, j)
    _couple(out, load, a.north[r], a.north_east[r], a.north_west[r], a.answer[t])
    _couple_south(out, a.north[s], a.north_east[s], a.north_west[s], a.answer[s])


@njit(**_FAST)
def _substitute(x, pivot, east, n):
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
def _substitute_two(x, z, pivot, east, n):
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
def _close(x, pivot, east, closing):
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
def _substitute_rows(x, pivot, east, r, step, count, n):
    """Both substitutions of `count` rows in place."""
    done = 0
    while done + 4 <= count:
        _substitute_four(x, pivot, east, r + done * step, step, n)
        done += 4
    for k in range(done, count):
        q = r + k * step
        _substitute(x[q], pivot[q], east[q], n)


@njit(**_FAST)
def _solve_rows(a, r, step, count):
    """Solve `count` rows of `answer` in place."""
    _substitute_rows(a.answer, a.pivot, a.east, r, step, count, a.answer.shape[1] - 2 - a.around_x)
    if a.around_x:
        for k in range(count):
            q = r + k * step
            _close(a.answer[q], a.pivot[q], a.east[q], a.closing[q])


@njit(**_FAST)
def _relax(a, level, odd):
    """Solve the even or the odd rows of a level for their load and what they couple to."""
    first, m = a.first[level], a.rows[level]
    if a.around_y:
        a.answer[first + m + 1] = a.answer[first]
    for j in range(odd, m, 8):
        count = min(4, (m - j + 1) // 2)
        for k in range(count):
            _off_row(a, a.answer[first + j + 2 * k], a.load[first + j + 2 * k], level, j + 2 * k)
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
        _off_row(a, out, out, level, j)


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
        _pivots_four(a.centre, a.east, a.pivot, first + done, inner)
        done += 4
    for r in range(first + done, first + m):
        _pivots(a.centre[r], a.east[r], a.pivot[r], inner)
    if a.around_x:
        z = a.closing
        for r in range(first, first + m):
            z[r] = 0.0
            z[r, 1] = a.east[r, n]
            z[r, n - 1] += a.east[r, n - 1]
        _substitute_rows(z, a.pivot, a.east, first, 1, m, inner)
        for r in range(first, first + m):
            a.pivot[r, n] = 1.0 / (a.centre[r, n] - a.east[r, n] * z[r, 1] - a.east[r, n - 1] * z[r, n - 1])
    good = True
    for r in range(first, first + m):
        p = a.pivot[r]
        for i in range(1, n + 1):
            good &= 0.0 < p[i] < np.inf
    return good


@njit(**_FAST)
def _pivots(c, e, p, n):
    inverse = coupling = 0.0
    for i in range(1, n + 1):
        inverse = 1.0 / (c[i] - coupling * coupling * inverse)
        coupling = e[i]
        p[i] = inverse


@njit(**_FAST)
def _pivots_four(centre, east, pivot, r, n):
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


@njit(**_FAST)
def _weights(a, level, j, scratch):
    """Interpolation of odd row j from its neighbours: T w = - sum of its couplings to that neighbour.

    T is the row, with as much diagonal as makes the two weights one together where there are two neighbours:
    what a held end of the row has taken out of the matrix shall not shorten them.
    """
    south, north, pivot, closing = scratch[0], scratch[1], scratch[2], scratch[3]
    n = south.shape[0] - 2
    r, s = a.first[level] + j, _below(a, level, j)
    b, be, bw = a.north[s], a.north_east[s, :-1], a.north_west[s, 1:]
    c, ce, cw = a.north[r], a.north_east[r], a.north_west[r]
    centre, east, west = a.centre[r], a.east[r], a.east[r, :-1]
    for i in range(1, n + 1):
        south[i] = -b[i] - be[i - 1] - bw[i]
        north[i] = -c[i] - ce[i] - cw[i]
        whole = south[i] + north[i] - east[i] - west[i - 1]
        pivot[i] = whole if b[i] != 0.0 and c[i] != 0.0 and whole > 0.0 else centre[i]
    _pivots(pivot, east, pivot, n - a.around_x)
    _substitute_two(south, north, pivot, east, n - a.around_x)
    if a.around_x:
        last = pivot[n]
        closing[:] = 0.0
        closing[1] = east[n]
        closing[n - 1] += east[n - 1]
        _substitute(closing, pivot, east, n - 1)
        pivot[n] = 1.0 / (last - east[n] * closing[1] - east[n - 1] * closing[n - 1])
        _close(south, pivot, east, closing)
        _close(north, pivot, east, closing)


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


@njit(**_SUMS)
def _apply(a, x, out):
    """out = A x on the finest level; x has its repeated columns and rows. Returns x . A x."""
    n, m = x.shape[1] - 2, a.rows[0]
    total = 0.0
    for j in range(m):
        s, t = _below(a, 0, j), _above(a, 0, j)
        c, e, r = a.centre[j], a.east[j], out[j]
        x_row = x[j]
        for i in range(1, n + 1):
            r[i] = -c[i] * x_row[i] - e[i] * x_row[i + 1] - e[i - 1] * x_row[i - 1]
        _couple(r, r, a.north[j], a.north_east[j], a.north_west[j], x[t])
        _couple_south(r, a.north[s], a.north_east[s], a.north_west[s], x[s])
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
