"""Multigrid on lines, compiled once by numba: cycles and conjugate gradients.

Every second line is coarsened away (semicoarsening), lines are solved as a whole, even ones and odd ones in turn:
fast whatever the anisotropy, for a strong coupling along the lines is solved and one across them is coarsened.
The layout is that of `line_kernels`. Cycles only precondition, in any precision: `top` is their finest level,
`coarse` holds the others; the last of them, of at most eight lines, is solved as a whole. `fine` is the operator
in double precision: `top` itself, or what that is rounded from.
"""

import numpy as np
from numba import njit

from reynolds.coarsest_kernels import solve_blocks
from reynolds.lanes import WIDTH, all_lanes, apart, lanes, lanes_like, put_lanes, together
from reynolds.line_kernels import coloured, plain, repeat_lines, substitute, width

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}


@njit(inline="always")
def _own(a, x, q, slots):
    """What unknowns q couple to themselves and along their line."""
    along = lanes(a.east, q) * lanes(x, q + slots) + lanes(a.east, q - slots) * lanes(x, q - slots)
    return lanes(a.centre, q) * lanes(x, q) + along


@njit(inline="always")
def _others(a, x, q, t, slots):
    """What unknowns q couple to the next line on both sides; t is their slot in the other block."""
    corners = lanes(a.north_east, q) * lanes(x, t + slots + 1) + lanes(a.north_west, q) * lanes(x, t - slots + 1)
    south = lanes(a.north_east, t - slots) * lanes(x, t - slots) + lanes(a.north_west, t + slots) * lanes(
        x, t + slots
    )
    return lanes(a.north, q) * lanes(x, t + 1) + lanes(a.north, t) * lanes(x, t) + corners + south


@njit(**_FAST)
def _begin(a, level):
    """Solve the even lines for their load alone, from nothing."""
    slots, begin, wide = a.slots[level], a.start[level, 0], width(a, level, 0)
    for i in range(1, a.length + 1):
        for q in range(begin + i * slots, begin + i * slots + wide, WIDTH):
            rest = lanes(a.load, q) - lanes(a.east, q - slots) * lanes(a.answer, q - slots)
            put_lanes(a.answer, q, lanes(a.pivot, q) * rest)
    substitute(a.answer, a.pivot, a.east, begin, slots, wide, a.length)


@njit(**_FAST)
def _relax(a, level, odd):
    """Solve the even or the odd lines of a level for their load and what they couple to."""
    if a.around:
        repeat_lines(a.answer, a, level, 1 - odd)
    slots, begin, wide = a.slots[level], a.start[level, odd] + odd, width(a, level, odd)
    over = a.start[level, 1 - odd] - begin
    for i in range(1, a.length + 1):
        for q in range(begin + i * slots, begin + i * slots + wide, WIDTH):
            rest = lanes(a.load, q) - _others(a, a.answer, q, q + over, slots)
            rest -= lanes(a.east, q - slots) * lanes(a.answer, q - slots)
            put_lanes(a.answer, q, lanes(a.pivot, q) * rest)
    substitute(a.answer, a.pivot, a.east, begin, slots, wide, a.length)


@njit(inline="always")
def _left(a, q, over, slots, whole):
    """The residual of even lines that hold for themselves, or of any."""
    rest = all_lanes(a.load, 0.0) - _others(a, a.answer, q, q + over, slots)
    if whole:
        rest += lanes(a.load, q) - _own(a, a.answer, q, slots)
    return rest


@njit(**_FAST)
def _hand_down(a, level, b, below, whole):
    """The residual of the even lines as the load of the next level.

    They have just been solved, but for the odd lines; unless they are to be taken as a `whole`.
    """
    if a.around:
        repeat_lines(a.answer, a, level, 1)
    slots, begin = a.slots[level], a.start[level, 0]
    over = a.start[level, 1] - begin
    for i in range(1, a.length + 1):
        row, out = begin + i * slots, i * b.slots[below]
        for k in range(0, width(b, below, 0), WIDTH):
            q = row + 2 * k
            even, odd = apart(_left(a, q, over, slots, whole), _left(a, q + WIDTH, over, slots, whole))
            put_lanes(b.load, b.start[below, 0] + out + k, even)
            put_lanes(b.load, b.start[below, 1] + out + k + 1, odd)


@njit(**_FAST)
def _lift(a, level, b, below, old):
    """The next level's answer on the even lines, added to `old` (0 or 1) times what stands there."""
    for i in range(1, a.length + 1):
        row, there = a.start[level, 0] + i * a.slots[level], i * b.slots[below]
        for k in range(0, width(b, below, 0), WIDTH):
            even = lanes(b.answer, b.start[below, 0] + there + k)
            odd = lanes(b.answer, b.start[below, 1] + there + k + 1)
            first, second = together(even, odd)
            kept, q = all_lanes(a.answer, old), row + 2 * k
            put_lanes(a.answer, q, kept * lanes(a.answer, q) + lanes_like(a.answer, first))
            put_lanes(a.answer, q + WIDTH, kept * lanes(a.answer, q + WIDTH) + lanes_like(a.answer, second))


@njit(**_FAST)
def _descend(a, level, b, below):
    """From nothing: relax even lines, then odd ones, and hand what is left in the even ones to the next level."""
    _begin(a, level)
    _relax(a, level, 1)
    _hand_down(a, level, b, below, False)


@njit(**_FAST)
def _ascend(a, level, b, below):
    """Add the next level's answer to the even lines, relax odd ones and even ones: the mirror of `_descend`."""
    _lift(a, level, b, below, 1.0)
    _relax(a, level, 1)
    _relax(a, level, 0)


@njit(**_FAST)
def cycle(top, coarse, coarsest):
    """answer of the finest level = M load: a symmetric V-cycle from nothing."""
    if coarse.lines.shape[0] == 0:
        solve_blocks(coarsest, top, plain(0))
    else:
        _descend(top, plain(0), coarse, plain(0))
        _cycle_from(coarse, plain(0), coarsest)
        _ascend(top, plain(0), coarse, plain(0))


@njit(**_FAST)
def _cycle_from(a, top, coarsest):
    """The cycle of one of these levels and those below it."""
    last = a.lines.shape[0] - 1
    for level in range(top, last):
        _descend(a, level, a, level + 1)
    solve_blocks(coarsest, a, last)
    for level in range(last - 1, top - 1, -1):
        _ascend(a, level, a, level + 1)


@njit(**_FAST)
def full_cycle(top, coarse, coarsest):
    """answer of the finest level: full multigrid, a cycle on every level from the coarsest up (Brandt 1977)."""
    last = coarse.lines.shape[0] - 1
    if last < 0:
        solve_blocks(coarsest, top, plain(0))
        return
    _first_load(top, plain(0), coarse, plain(0))
    for level in range(last):
        _first_load(coarse, level, coarse, level + 1)
    solve_blocks(coarsest, coarse, last)
    for level in range(last - 1, -1, -1):
        _improve(coarse, level, coarse, level + 1)
        _cycle_from(coarse, level + 1, coarsest)
        _ascend(coarse, level, coarse, level + 1)
    _improve(top, plain(0), coarse, plain(0))
    _cycle_from(coarse, plain(0), coarsest)
    _ascend(top, plain(0), coarse, plain(0))


@njit(**_FAST)
def _first_load(a, level, b, below):
    """The load of the next level where the even lines are still nothing."""
    a.answer[a.start[level, 0] : a.start[level, 1]] = 0.0
    _relax(a, level, 1)
    _hand_down(a, level, b, below, True)


@njit(**_FAST)
def _improve(a, level, b, below):
    """From the next level's answer: relax odd lines, and hand down what is left in the even ones."""
    _lift(a, level, b, below, 0.0)
    _relax(a, level, 1)
    _hand_down(a, level, b, below, True)


@njit(**_FAST)
def apply(a, x, out):
    """out = A x on the finest level; returns x . A x. Repeats of x are filled, out has none."""
    if a.around:
        for odd in range(2):
            repeat_lines(x, a, plain(0), odd)
    slots, total, less = a.slots[0], all_lanes(x, 0.0), 0.0
    for odd in range(2):
        begin, wide = a.start[0, odd] + odd, width(a, 0, odd)
        over = a.start[0, 1 - odd] - begin
        for i in range(1, a.length + 1):
            for q in range(begin + i * slots, begin + i * slots + wide, WIDTH):
                image = _own(a, x, q, slots) + _others(a, x, q, q + over, slots)
                put_lanes(out, q, image)
                total += lanes(x, q) * image
        if a.around:
            for row in range(a.start[0, odd], a.start[0, odd] + (a.length + 2) * slots, slots):
                for q in range(row + odd + coloured(a, 0, odd), row + odd + wide):
                    less += x[q] * out[q]
                out[row] *= 1 - odd
                out[row + odd + coloured(a, 0, odd) : row + slots] = 0.0
    return _sum(total) - less


@njit(**_FAST)
def conjugate_gradients(fine, top, coarse, coarsest, x, direction, goal, most):
    """Add to x what solves A x = load of `fine`, to |load - A x| <= goal; returns steps.

    The load is what is left of it afterwards. Hestenes and Stiefel 1952. Stops short where the operator or the
    cycle is not positive.
    """
    load, single = fine.load, top.load.itemsize < fine.load.itemsize
    left, steps, before, unit = _dot(load, load), 0, 1.0, 1.0
    while goal * goal < left < np.inf and steps < most:
        if single:
            unit = np.sqrt(left)  # of what is left, whose numbers may be too small for single precision
            _rounded(load, 1.0 / unit, top.load)
        cycle(top, coarse, coarsest)
        now = unit * _dot(load, top.answer)  # no load stands in pads
        if not now > 0.0:
            break
        _combine(direction, top.answer, unit, now / before if steps else 0.0)
        curvature = apply(fine, direction, fine.answer)  # the cycle's answer is no longer needed
        if not curvature > 0.0:
            break
        left = _advance(x, direction, load, fine.answer, now / curvature)
        before = now
        steps += 1
    return steps


@njit(**_FAST)
def solve(fine, top, coarse, coarsest, slots, load, x, started, work, tolerance, most):
    """x (n,) with |load - A x| <= tolerance |load|, from x where it is `started`, else from nothing.

    Returns steps and what is left over |load|. Unknown k stands at slots[k]; `work` (2, slots) is room.
    """
    flat, direction = work[0], work[1]
    put(load, slots, fine.load)
    size = np.sqrt(_dot(fine.load, fine.load))
    if not 0.0 < size < np.inf:
        x[:] = 0.0
        return 0, 0.0 if size == 0.0 else np.inf
    if started:
        put(x, slots, flat)
        left_of(fine, flat, fine.answer)
    else:
        flat[:] = 0.0
    steps = conjugate_gradients(fine, top, coarse, coarsest, flat, direction, tolerance * size, most)
    put(load, slots, fine.load)
    left = left_of(fine, flat, direction)
    take(flat, slots, x)
    return steps, left / size


@njit(**_FAST)
def left_of(fine, x, image):
    """|load - A x| on the finest level, whose load ends as that residual; `image` is lost."""
    apply(fine, x, image)
    return np.sqrt(_less(fine.load, image))


@njit(inline="always")
def _sum(parts):
    """The sum of eight lanes."""
    eight = np.empty(WIDTH)
    put_lanes(eight, 0, parts)
    return eight.sum()


@njit(**_FAST)
def _dot(a, b):
    total = all_lanes(a, 0.0)
    for k in range(0, a.shape[0], WIDTH):
        total += lanes(a, k) * lanes_like(a, lanes(b, k))
    return _sum(total)


@njit(**_FAST)
def _rounded(values, factor, out):
    """out = factor values, in the precision of out."""
    much = all_lanes(values, factor)
    for k in range(0, values.shape[0], WIDTH):
        put_lanes(out, k, much * lanes(values, k))


@njit(**_FAST)
def _less(a, b):
    """a -= b; returns its square."""
    total = all_lanes(a, 0.0)
    for k in range(0, a.shape[0], WIDTH):
        rest = lanes(a, k) - lanes(b, k)
        put_lanes(a, k, rest)
        total += rest * rest
    return _sum(total)


@njit(**_FAST)
def _combine(direction, answer, unit, beta):
    """direction = unit answer + beta direction."""
    one, much = all_lanes(direction, unit), all_lanes(direction, beta)
    for k in range(0, answer.shape[0], WIDTH):
        more = one * lanes_like(direction, lanes(answer, k))
        put_lanes(direction, k, more + much * lanes(direction, k))


@njit(**_FAST)
def _advance(x, direction, residual, image, length):
    """x += length direction, residual -= length image; returns its square."""
    far, total = all_lanes(x, length), all_lanes(x, 0.0)
    for k in range(0, x.shape[0], WIDTH):
        put_lanes(x, k, lanes(x, k) + far * lanes(direction, k))
        rest = lanes(residual, k) - far * lanes(image, k)
        put_lanes(residual, k, rest)
        total += rest * rest
    return _sum(total)


@njit(**_FAST)
def put(values, places, out):
    """Values where they stand in a flat array, out[places] = values."""
    for k in range(places.shape[0]):
        out[places[k]] = values[k]


@njit(**_FAST)
def take(flat, places, out):
    """The mirror of `put`: out = flat[places]."""
    for k in range(places.shape[0]):
        out[k] = flat[places[k]]
