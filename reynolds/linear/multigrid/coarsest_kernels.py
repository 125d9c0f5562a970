"""The coarsest level of multigrid on lines, at most eight of them, solved at once; compiled once by numba.

Unknowns i of all lines are one block of eight, coupled to the next one only: block elimination along the lines.
With D_i the coupling within block i and B_i that to block i + 1: S_i = D_i - B_(i-1)^T W_(i-1), W_i = S_i^-1 B_i.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from typing import Any, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from reynolds.numerics.lanes import WIDTH, all_lanes, apart, lanes, lanes_like, put_lanes, together

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}

SQUARE = WIDTH * WIDTH


class Coarsest(NamedTuple):
    """Blocks 0 to n + 1, row by row in flat arrays: S^-1, W and B transposed; `x`, 8 a block, is work space."""

    inverse: NDArray[np.floating[Any]]
    onward: NDArray[np.floating[Any]]
    back: NDArray[np.floating[Any]]
    x: NDArray[np.floating[Any]]


@njit(inline="always")
def _times(rows, at, factors, first):
    """Sum of eight rows, each times its factor."""
    one = lanes(rows, at) * all_lanes(rows, factors[first])
    other = lanes(rows, at + WIDTH) * all_lanes(rows, factors[first + 1])
    for k in range(2, WIDTH, 2):
        one += lanes(rows, at + k * WIDTH) * all_lanes(rows, factors[first + k])
        other += lanes(rows, at + (k + 1) * WIDTH) * all_lanes(rows, factors[first + k + 1])
    return one + other


@njit(**_FAST)
def eliminate_blocks(c, a, level):
    """S^-1, W and B of a level of at most eight lines; False where it is not positive definite."""
    room, identity, good = np.zeros(SQUARE, c.x.dtype), np.eye(WIDTH, dtype=c.x.dtype).ravel(), True
    for i in range(1, a.length + 1):
        at = i * SQUARE
        _within(a, level, i, c.inverse, at)
        for k in range(WIDTH):
            less = _times(c.onward, at - SQUARE, c.back, at - SQUARE + k * WIDTH)
            put_lanes(c.inverse, at + k * WIDTH, lanes(c.inverse, at + k * WIDTH) - less)
        good &= _invert(c.inverse, at, identity)
        _to_next(a, level, i, room)
        for k in range(WIDTH):
            put_lanes(c.onward, at + k * WIDTH, _times(room, 0, c.inverse, at + k * WIDTH))
            for j in range(WIDTH):
                c.back[at + j * WIDTH + k] = room[k * WIDTH + j]
    return good


@njit(inline="always")
def _place(a, level, i, k):
    """Index of unknown i of line k."""
    odd = k % 2
    return a.start[level, odd] + i * a.slots[level] + k // 2 + odd


@njit(**_FAST)
def _within(a, level, i, out, at):
    """D_i, the identity for lines that are not there."""
    m = a.lines[level]
    out[at : at + SQUARE] = 0.0
    for k in range(WIDTH):
        out[at + k * WIDTH + k] = a.centre[_place(a, level, i, k)] if k < m else 1.0
    for k in range(m - 1 + a.around):
        above = (k + 1) % m
        coupling = a.north[_place(a, level, i, k)]
        out[at + k * WIDTH + above] += coupling
        out[at + above * WIDTH + k] += coupling


@njit(**_FAST)
def _to_next(a, level, i, out):
    """B_i."""
    m = a.lines[level]
    out[:] = 0.0
    for k in range(m):
        out[k * WIDTH + k] = a.east[_place(a, level, i, k)]
    for k in range(m - 1 + a.around):
        above = (k + 1) % m
        out[k * WIDTH + above] += a.north_east[_place(a, level, i, k)]
        out[above * WIDTH + k] += a.north_west[_place(a, level, i + 1, k)]


@njit(**_FAST)
def _invert(matrix, at, identity):
    """A symmetric block inverted in place (Gauss and Jordan); False where a pivot is not positive."""
    good = True
    for p in range(WIDTH):
        row, unit = at + p * WIDTH, lanes(identity, p * WIDTH)
        pivot = matrix[row + p]
        good &= 0.0 < pivot < np.inf
        own = (lanes(matrix, row) - all_lanes(matrix, pivot - 1.0) * unit) * all_lanes(matrix, 1.0 / pivot)
        put_lanes(matrix, row, own)
        for k in range(WIDTH):
            if k != p:
                other = at + k * WIDTH
                less = all_lanes(matrix, matrix[other + p]) * (unit + own)
                put_lanes(matrix, other, lanes(matrix, other) - less)
    return good


@njit(**_FAST)
def solve_blocks(c, a, level):
    """answer = A^-1 load of a level of at most eight lines."""
    none = all_lanes(c.x, 0.0)
    for i in range(1, a.length + 1):
        even, odd = _place(a, level, i, 0), _place(a, level, i, 1)
        load, _ = together(lanes(a.load, even), lanes(a.load, odd))
        k = i * WIDTH
        put_lanes(c.x, k, lanes_like(c.x, load) - _times(c.onward, (i - 1) * SQUARE, c.x, k - WIDTH))
    for i in range(a.length, 0, -1):
        k, at = i * WIDTH, i * SQUARE
        put_lanes(c.x, k, lanes(c.x, k) - _times(c.back, at, c.x, k + WIDTH))
        x = _times(c.inverse, at, c.x, k)
        put_lanes(c.x, k, x)
        even, odd = apart(x, none)
        put_lanes(a.answer, _place(a, level, i, 0), even)
        put_lanes(a.answer, _place(a, level, i, 1), odd)
