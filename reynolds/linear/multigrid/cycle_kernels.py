"""Multigrid on lines, compiled once by numba: cycles and conjugate gradients.

Every second line is coarsened away (semicoarsening), lines are solved as a whole, even ones and odd ones in turn:
fast for any anisotropy, since a strong coupling along the lines is solved and one across them is coarsened.
The layout is that of `line_kernels`. Cycles only precondition, in any precision: `top` is their finest level,
`coarse` holds the others; the last of them, of at most eight lines, is solved as a whole. `fine` is the operator
in double precision: `top` itself, or its unrounded original.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

from reynolds.linear.multigrid.coarsest_kernels import solve_blocks
from reynolds.linear.multigrid.line_kernels import coloured, plain, repeat_lines, width
from reynolds.linear.multigrid.sweep_kernels import (
    finish_even,
    finish_even_start_odd,
    finish_odd_hand_down,
    finish_odd_start_even,
    lift_start_odd,
    others,
    own,
    start_even,
)
from reynolds.numerics.lanes import WIDTH, all_lanes, lanes, lanes_like, put_lanes

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}


@njit(**_FAST)
def _descend(a, level, b, below):
    """From nothing: relax even lines, then odd ones, and hand the residual of the even ones to the next level."""
    start_even(a, level)
    finish_even_start_odd(a, level)
    finish_odd_hand_down(a, level, b, below, False)


@njit(**_FAST)
def _ascend(a, level, b, below):
    """Add the next level's answer to the even lines, relax odd ones and even ones: the mirror of `_descend`."""
    lift_start_odd(a, level, b, below, 1.0)
    finish_odd_start_even(a, level)
    finish_even(a, level)


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
    """The load of the next level while the even lines are zero."""
    a.answer[a.start[level, 0] : a.start[level, 1]] = 0.0
    finish_even_start_odd(a, level)
    finish_odd_hand_down(a, level, b, below, True)


@njit(**_FAST)
def _improve(a, level, b, below):
    """From the next level's answer: relax odd lines, and hand down the residual of the even ones."""
    lift_start_odd(a, level, b, below, 0.0)
    finish_odd_hand_down(a, level, b, below, True)


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
                image = own(a, x, q, slots) + others(a, x, q, q + over, slots)
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
    """Add to x the solution of A x = load of `fine`, to |load - A x| <= goal; returns steps.

    The load becomes the residual. Hestenes and Stiefel 1952. Stops short where the operator or the
    cycle is not positive.
    """
    load, single = fine.load, top.load.itemsize < fine.load.itemsize
    left, steps, before, unit = _dot(load, load), 0, 1.0, 1.0
    while goal * goal < left < np.inf and steps < most:
        if single:
            unit = np.sqrt(left)  # of the residual, whose numbers may be too small for single precision
            _rounded(load, 1.0 / unit, top.load)
        cycle(top, coarse, coarsest)
        now = unit * _dot(load, top.answer)  # pads have no load
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

    Returns steps and residual over |load|. Unknown k is at slots[k]; `work` (2, slots) is work space.
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
    """|load - A x| on the finest level, whose load becomes that residual; `image` is overwritten."""
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
    """Scatter values into a flat array, out[places] = values."""
    for k in range(places.shape[0]):
        out[places[k]] = values[k]


@njit(**_FAST)
def take(flat, places, out):
    """Gather values of a flat array: out = flat[places]."""
    for k in range(places.shape[0]):
        out[k] = flat[places[k]]
