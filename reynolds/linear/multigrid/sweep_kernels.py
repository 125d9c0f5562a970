"""Sweeps over the lines of a level of multigrid, compiled once by numba.

A line is eliminated from one end on and substituted from the other: even lines up first, odd ones down. So the one
colour's substitution and the next operation run through the rows the same way, in one sweep, some rows apart: half the
passes through memory, and two independent chains of operations in place of one dependent chain.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from numba import njit

from reynolds.linear.multigrid.line_kernels import repeat_row, width
from reynolds.numerics.lanes import WIDTH, all_lanes, apart, lanes, lanes_like, put_lanes, together

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract"}}
BEHIND = 4  # rows by which one colour follows the other: one would do, but numbers just stored are slow to load


@njit(inline="always")
def own(a, x, q, slots):
    """Coupling of unknowns q to themselves and along their line."""
    along = lanes(a.east, q) * lanes(x, q + slots) + lanes(a.east, q - slots) * lanes(x, q - slots)
    return lanes(a.centre, q) * lanes(x, q) + along


@njit(inline="always")
def others(a, x, q, t, slots):
    """Coupling of unknowns q to the next line on both sides; t is their slot in the other block."""
    corners = lanes(a.north_east, q) * lanes(x, t + slots + 1) + lanes(a.north_west, q) * lanes(x, t - slots + 1)
    south = lanes(a.north_east, t - slots) * lanes(x, t - slots) + lanes(a.north_west, t + slots) * lanes(x, t + slots)
    return lanes(a.north, q) * lanes(x, t + 1) + lanes(a.north, t) * lanes(x, t) + corners + south


@njit(inline="always")
def _forward(a, row, wide, over, slots, back):
    """A row of a colour's elimination: load less the others' part and its row at `back` (slots, -slots)."""
    for q in range(row, row + wide, WIDTH):
        rest = lanes(a.load, q) - others(a, a.answer, q, q + over, slots)
        rest -= lanes(a.east, q + min(back, 0)) * lanes(a.answer, q + back)
        put_lanes(a.answer, q, lanes(a.pivot, q) * rest)


@njit(inline="always")
def _back(a, row, wide, on):
    """A row of a colour's substitution, after its row at `on` (slots, -slots): its answer."""
    for q in range(row, row + wide, WIDTH):
        less = lanes(a.pivot, q) * lanes(a.east, q + min(on, 0)) * lanes(a.answer, q + on)
        put_lanes(a.answer, q, lanes(a.answer, q) - less)


@njit(inline="always")
def _left(a, q, over, slots, whole):
    """The residual of even lines already solved, or of any."""
    rest = all_lanes(a.load, 0.0) - others(a, a.answer, q, q + over, slots)
    if whole:
        rest += lanes(a.load, q) - own(a, a.answer, q, slots)
    return rest


@njit(inline="always")
def _hand_down_row(a, b, row, even, odd, half, over, slots, whole):
    """A row of the even lines' residual as the load of the next level, at `even` and `odd`."""
    for k in range(0, half, WIDTH):
        q = row + 2 * k
        one, other = apart(_left(a, q, over, slots, whole), _left(a, q + WIDTH, over, slots, whole))
        put_lanes(b.load, even + k, one)
        put_lanes(b.load, odd + k, other)


@njit(inline="always")
def _lift_row(a, b, row, even, odd, half, old):
    """A row of the next level's answer, on the even lines: added to `old` (0 or 1) times the value there."""
    kept = all_lanes(a.answer, old)
    for k in range(0, half, WIDTH):
        first, second = together(lanes(b.answer, even + k), lanes(b.answer, odd + k))
        q = row + 2 * k
        put_lanes(a.answer, q, kept * lanes(a.answer, q) + lanes_like(a.answer, first))
        put_lanes(a.answer, q + WIDTH, kept * lanes(a.answer, q + WIDTH) + lanes_like(a.answer, second))


@njit(**_FAST)
def start_even(a, level):
    """Up the even lines: eliminate them for their load alone, from nothing."""
    slots, begin, wide = a.slots[level], a.start[level, 0], width(a, level, 0)
    for i in range(1, a.length + 1):
        for q in range(begin + i * slots, begin + i * slots + wide, WIDTH):
            rest = lanes(a.load, q) - lanes(a.east, q - slots) * lanes(a.answer, q - slots)
            put_lanes(a.answer, q, lanes(a.pivot, q) * rest)


@njit(**_FAST)
def finish_even_start_odd(a, level):
    """Down: the answer of the even lines, and the elimination of the odd ones, some rows behind."""
    slots, even, odd, n = a.slots[level], a.start[level, 0], a.start[level, 1] + 1, a.length
    wide, other, around = width(a, level, 0), width(a, level, 1), a.around
    for i in range(n, -BEHIND, -1):
        if i >= 1:
            _back(a, even + i * slots, wide, slots)
            if around:
                repeat_row(a.answer, a, level, 0, i)
        if i + BEHIND <= n:
            _forward(a, odd + (i + BEHIND) * slots, other, even - odd, slots, slots)


@njit(**_FAST)
def finish_odd_hand_down(a, level, b, below, whole):
    """Up: the answer of the odd lines, and the residual of the even ones as the load of the next level.

    The even ones have just been solved, except for the odd lines, unless `whole`.
    """
    slots, even, odd, n = a.slots[level], a.start[level, 0], a.start[level, 1] + 1, a.length
    wide, half, around = width(a, level, 1), width(b, below, 0), a.around
    narrow, low, high = b.slots[below], b.start[below, 0], b.start[below, 1] + 1
    for i in range(1, n + BEHIND + 1):
        if i <= n:
            _back(a, odd + i * slots, wide, -slots)
            if around:
                repeat_row(a.answer, a, level, 1, i)
        j = i - BEHIND
        if j >= 1:
            at = j * narrow
            _hand_down_row(a, b, even + j * slots, low + at, high + at, half, odd - 1 - even, slots, whole)


@njit(**_FAST)
def lift_start_odd(a, level, b, below, old):
    """Down: the next level's answer on the even lines (see `_lift_row`), and the elimination of the odd ones."""
    slots, even, odd, n = a.slots[level], a.start[level, 0], a.start[level, 1] + 1, a.length
    wide, half, around = width(a, level, 1), width(b, below, 0), a.around
    narrow, low, high = b.slots[below], b.start[below, 0], b.start[below, 1] + 1
    for i in range(n, -BEHIND, -1):
        if i >= 1:
            _lift_row(a, b, even + i * slots, low + i * narrow, high + i * narrow, half, old)
            if around:
                repeat_row(a.answer, a, level, 0, i)
        if i + BEHIND <= n:
            _forward(a, odd + (i + BEHIND) * slots, wide, even - odd, slots, slots)


@njit(**_FAST)
def finish_odd_start_even(a, level):
    """Up: the answer of the odd lines, and the elimination of the even ones."""
    slots, even, odd, n = a.slots[level], a.start[level, 0], a.start[level, 1] + 1, a.length
    wide, other, around = width(a, level, 1), width(a, level, 0), a.around
    for i in range(1, n + BEHIND + 1):
        if i <= n:
            _back(a, odd + i * slots, wide, -slots)
            if around:
                repeat_row(a.answer, a, level, 1, i)
        if i > BEHIND:
            _forward(a, even + (i - BEHIND) * slots, other, odd - 1 - even, slots, -slots)


@njit(**_FAST)
def finish_even(a, level):
    """Down: the answer of the even lines."""
    slots, begin, wide = a.slots[level], a.start[level, 0], width(a, level, 0)
    for i in range(a.length, 0, -1):
        _back(a, begin + i * slots, wide, slots)
