"""Coarse levels of multigrid on lines, compiled once by numba: weights, operators P^T A P and line factors.

Every second line remains. Interpolation follows the operator (Schaffer 1998): T w = -B 1 for T an odd line and B
its coupling to a neighbour. Coarse operators have nine-point stencils again. The layout is that of `line_kernels`.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

from reynolds.linear.multigrid.coarsest_kernels import eliminate_blocks
from reynolds.linear.multigrid.line_kernels import (
    coloured,
    eliminate,
    factorise,
    factorise_down,
    plain,
    repeat_last,
    substitute,
    width,
)
from reynolds.numerics.lanes import WIDTH, all_lanes, apart, lanes, put_lanes, where_positive

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}


@njit(**_FAST)
def take_in(data, places, entries, fine, top, coarse, coarsest):
    """Set up with the entries of an upper triangle, each at its place in the finest stencils (flat: `entries`)."""
    for k in range(places.shape[0]):
        entries[places[k]] = data[k]
    return set_up(fine, top, coarse, coarsest)


@njit(**_FAST)
def set_up(fine, top, coarse, coarsest):
    """Coarse operators and factors of all levels from the finest stencil; False where it is not positive.

    `top` is `fine`, or rounded from it.
    """
    levels = coarse.lines.shape[0]
    if fine.around:
        _repeat_stencils(fine, plain(0))
    if top.centre.itemsize < fine.centre.itemsize:
        _round_stencils(fine, top)
    if levels == 0:
        return eliminate_blocks(coarsest, top, plain(0))
    _coarsen(top, plain(0), coarse, plain(0))
    good = _factorise(top, plain(0))
    for level in range(levels - 1):
        _coarsen(coarse, level, coarse, level + 1)
        good = good and _factorise(coarse, level)
    return good and eliminate_blocks(coarsest, coarse, levels - 1)


@njit(**_FAST)
def _round_stencils(fine, top):
    """The stencils of one level in the precision of another."""
    for k in range(0, fine.centre.shape[0], WIDTH):
        put_lanes(top.centre, k, lanes(fine.centre, k))
        put_lanes(top.east, k, lanes(fine.east, k))
        put_lanes(top.north, k, lanes(fine.north, k))
        put_lanes(top.north_east, k, lanes(fine.north_east, k))
        put_lanes(top.north_west, k, lanes(fine.north_west, k))


@njit(**_FAST)
def _factorise(a, level):
    """L D L^T of every line of a level, of odd ones from the other end; False where a pivot is not positive."""
    slots, good = a.slots[level], True
    for odd in range(2):
        begin = a.start[level, odd] + odd
        if odd:
            factorise_down(a.centre, a.east, a.pivot, begin, slots, width(a, level, 1), a.length)
        else:
            factorise(a.centre, a.east, a.pivot, begin, slots, width(a, level, 0), a.length)
        for row in range(begin + slots, begin + (a.length + 1) * slots, slots):
            for q in range(row, row + coloured(a, level, odd)):
                good &= 0.0 < a.pivot[q] < np.inf
    return good


@njit(**_FAST)
def _weights(a, level):
    """Interpolation of the odd lines from their neighbours: T w = - sum of their couplings to that neighbour.

    Afterwards the odd block of `answer` has the southern weights, that of `load` the northern ones. T is the line, with
    the diagonal at which the two weights of two neighbours have the sum one: couplings to a held end of the line, which
    the matrix lacks, must not reduce them.
    """
    slots, begin, wide = a.slots[level], a.start[level, 1] + 1, width(a, level, 1)
    over = a.start[level, 0] - begin
    south, north, pivot = a.answer, a.load, a.pivot  # unused while operators are made
    none = all_lanes(a.centre, 0.0)
    for i in range(1, a.length + 1):
        for q in range(begin + i * slots, begin + i * slots + wide, WIDTH):
            t = q + over
            s = none - lanes(a.north, t) - lanes(a.north_east, t - slots) - lanes(a.north_west, t + slots)
            n = none - lanes(a.north, q) - lanes(a.north_east, q) - lanes(a.north_west, q)
            centre = lanes(a.centre, q)
            whole = s + n - lanes(a.east, q) - lanes(a.east, q - slots)
            # By all three couplings: the straight one may vanish where all coupling is through corners.
            made = where_positive(s * s, where_positive(n * n, where_positive(whole, whole, centre), centre), centre)
            put_lanes(south, q, s)
            put_lanes(north, q, n)
            put_lanes(pivot, q, made)
    factorise(pivot, a.east, pivot, begin, slots, wide, a.length)
    for side in (south, north):
        eliminate(side, pivot, a.east, begin, slots, wide, a.length)
        substitute(side, pivot, a.east, begin, slots, wide, a.length)
    if a.around:
        end = coloured(a, level, 1) + 1
        for row in range(a.start[level, 1] + slots, a.start[level, 1] + (a.length + 1) * slots, slots):
            south[row + end] = north[row + end] = 0.0
            north[row] = north[row + end - 1] if a.lines[level] % 2 == 0 else 0.0


@njit(**_FAST)
def _coarsen(a, level, b, below):
    """The operator P^T A P of the next level, `below` of b."""
    _weights(a, level)
    slots = a.slots[level]
    for i in range(1, a.length + 1):
        row, there = a.start[level, 0] + i * slots, i * b.slots[below]
        for k in range(0, width(b, below, 0), WIDTH):
            first = _coarse_stencils(a, level, row + 2 * k)
            second = _coarse_stencils(a, level, row + 2 * k + WIDTH)
            even, odd = b.start[below, 0] + there + k, b.start[below, 1] + there + k + 1
            _put_apart(b.centre, even, odd, first[0], second[0])
            _put_apart(b.east, even, odd, first[1], second[1])
            _put_apart(b.north, even, odd, first[2], second[2])
            _put_apart(b.north_east, even, odd, first[3], second[3])
            _put_apart(b.north_west, even, odd, first[4], second[4])
    if a.around:
        _join_ends(a, level, b, below)
        _repeat_stencils(b, below)
    for odd in range(2):
        begin = a.start[level, odd]
        a.answer[begin : begin + (a.length + 2) * slots] = 0.0
        a.load[begin : begin + (a.length + 2) * slots] = 0.0


@njit(**_FAST)
def _repeat_stencils(a, level):
    for stencil in (a.centre, a.east, a.north, a.north_east, a.north_west):
        repeat_last(stencil, a, level)


@njit(inline="always")
def _put_apart(stencil, even, odd, first, second):
    one, other = apart(first, second)
    put_lanes(stencil, even, one)
    put_lanes(stencil, odd, other)


@njit(inline="always")
def _coarse_stencils(a, level, t):
    """Coarse stencils of the even lines at t: their own, and those added by the odd lines north and south."""
    slots = a.slots[level]
    q = t + a.start[level, 1] - a.start[level, 0] + 1
    p = q - 1
    b, be, bw = lanes(a.north, t), lanes(a.north_east, t), lanes(a.north_west, t)
    s, s_east = lanes(a.answer, q), lanes(a.answer, q + slots)
    n, n_east, n_west = lanes(a.load, q), lanes(a.load, q + slots), lanes(a.load, q - slots)
    c, e = lanes(a.centre, q), lanes(a.east, q)
    centre = lanes(a.centre, t) + s * (s * c + b + b)
    east = lanes(a.east, t) + s * (s_east * e + lanes(a.north_west, t + slots)) + s_east * be
    m, m_east = lanes(a.load, p), lanes(a.load, p + slots)
    centre += m * (m * lanes(a.centre, p) + lanes(a.north, p) + lanes(a.north, p))
    east += m * (m_east * lanes(a.east, p) + lanes(a.north_east, p)) + m_east * lanes(a.north_west, p + slots)
    north = s * (c * n + lanes(a.north, q)) + b * n
    north_east = s * (e * n_east + lanes(a.north_east, q)) + be * n_east
    north_west = s * (lanes(a.east, q - slots) * n_west + lanes(a.north_west, q)) + bw * n_west
    return centre, east, north, north_east, north_west


@njit(**_FAST)
def _join_ends(a, level, b, below):
    """Couplings across the seam where the last line is next to the first: that of two even ones stays.

    The pad after the coarse lines, to which the last odd line has added too, is one again.
    """
    lines = b.lines[below]
    last = b.start[below, (lines - 1) % 2] + (lines - 1) // 2 + (lines - 1) % 2
    pad = b.start[below, lines % 2] + lines // 2 + lines % 2
    for i in range(1, a.length + 1):
        row, fine = i * b.slots[below], a.start[level, 0] + i * a.slots[level] + lines - 1
        if a.lines[level] % 2:
            b.north[last + row] = a.north[fine]
            b.north_east[last + row] = a.north_east[fine]
            b.north_west[last + row] = a.north_west[fine]
        b.centre[pad + row] = 1.0
        b.east[pad + row] = b.north[pad + row] = b.north_east[pad + row] = b.north_west[pad + row] = 0.0
