"""Lines of nine-point stencils, compiled once by numba: memory layout, and operations on many at once.

Layout: the lines of a level lie side by side, so that eight of them share a vector register; odd ones and even ones
apart, since each colour needs the other only. A block is n + 2 rows of `slots` numbers: row i has unknowns i of its
lines, rows 0 and n + 1 are zero. Line 2 k is in slot k of the even block, line 2 k + 1 in slot k + 1 of the odd one:
line k of a colour has its southern neighbour in slot k of the other block, its northern one in slot k + 1. The other
slots are pads: the centre of their stencil is one, all else zero, except a copy of the line at the other end where the
last line is next to the first.

Numba's cache watches a function's own file only: after a change here, touch the kernels that import it.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from typing import Any, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from reynolds.numerics.lanes import WIDTH, all_lanes, lanes, put_lanes

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}


class GridLevels(NamedTuple):
    """Operators and vectors of some levels, each one flat array: level by level, even block and odd block.

    The symmetric stencil of an unknown: centre, and its coupling east (along the line), north (to the next line),
    north-east and north-west. `pivot` is the inverse diagonal of each line's L D L^T, of odd lines from their
    other end on. `start` (levels, 2) of the blocks, `slots` (levels,) of their rows, `lines` (levels,) of length
    `length`; `around`: last next to first.
    """

    centre: NDArray[np.floating[Any]]
    east: NDArray[np.floating[Any]]
    north: NDArray[np.floating[Any]]
    north_east: NDArray[np.floating[Any]]
    north_west: NDArray[np.floating[Any]]
    pivot: NDArray[np.floating[Any]]
    answer: NDArray[np.floating[Any]]
    load: NDArray[np.floating[Any]]
    start: NDArray[np.int64]
    slots: NDArray[np.int64]
    lines: NDArray[np.int64]
    length: int
    around: bool


@njit(**_FAST)
def plain(number):
    """A number unknown to the compiler, which compiles a function anew for each constant argument."""
    return number + 0


@njit(inline="always")
def coloured(a, level, odd):
    """Number of even (odd = 0) or odd (1) lines of a level."""
    return (a.lines[level] + 1 - odd) // 2


@njit(inline="always")
def width(a, level, odd):
    """Slots that the lines of a colour take, to the next full register."""
    return -(-coloured(a, level, odd) // WIDTH) * WIDTH


@njit(inline="always")
def repeat_row(x, a, level, odd, i):
    """Fill the pads of row i of a block of a vector where the last line is next to the first."""
    evens, odds = coloured(a, level, 0), coloured(a, level, 1)
    even, other = a.start[level, 0] + i * a.slots[level], a.start[level, 1] + i * a.slots[level]
    if odd and evens > odds:
        x[other], x[other + odds + 1] = x[even + evens - 1], x[even]
    elif odd:
        x[other] = x[other + odds]
    elif evens == odds:
        x[even + evens] = x[even]


@njit(**_FAST)
def repeat_lines(x, a, level, odd):
    """The same of all its rows."""
    for i in range(a.length + 2):
        repeat_row(x, a, level, odd, i)


@njit(**_FAST)
def repeat_last(stencil, a, level):
    """Fill the pad before the odd lines where the last line is next to the first: with that last line."""
    evens, odds = coloured(a, level, 0), coloured(a, level, 1)
    last = a.start[level, 0] + evens - 1 if evens > odds else a.start[level, 1] + odds
    for row in range(0, (a.length + 2) * a.slots[level], a.slots[level]):
        stencil[a.start[level, 1] + row] = stencil[last + row]


@njit(**_FAST)
def factorise(centre, east, pivot, begin, slots, wide, n):
    """Inverse pivots of the lines of a block from `begin` on; the same place in all three arrays."""
    one = all_lanes(pivot, 1.0)
    for i in range(1, n + 1):
        for q in range(begin + i * slots, begin + i * slots + wide, WIDTH):
            e = lanes(east, q - slots)
            put_lanes(pivot, q, one / (lanes(centre, q) - e * e * lanes(pivot, q - slots)))


@njit(**_FAST)
def factorise_down(centre, east, pivot, begin, slots, wide, n):
    """The same from the other end of the lines."""
    one = all_lanes(pivot, 1.0)
    for i in range(n, 0, -1):
        for q in range(begin + i * slots, begin + i * slots + wide, WIDTH):
            e = lanes(east, q)
            put_lanes(pivot, q, one / (lanes(centre, q) - e * e * lanes(pivot, q + slots)))


@njit(**_FAST)
def eliminate(x, pivot, east, begin, slots, wide, n):
    """Forward substitution of lines in place: x = D^-1 L^-1 x."""
    for i in range(1, n + 1):
        for q in range(begin + i * slots, begin + i * slots + wide, WIDTH):
            rest = lanes(x, q) - lanes(east, q - slots) * lanes(x, q - slots)
            put_lanes(x, q, lanes(pivot, q) * rest)


@njit(**_FAST)
def substitute(x, pivot, east, begin, slots, wide, n):
    """Backward substitution of lines in place: x = L^-T x."""
    for i in range(n - 1, 0, -1):
        for q in range(begin + i * slots, begin + i * slots + wide, WIDTH):
            put_lanes(x, q, lanes(x, q) - lanes(pivot, q) * lanes(east, q) * lanes(x, q + slots))
