"""Elimination in a narrow band, compiled once by numba: rows in one flat array, eight numbers at a time.

`half`, the band's half width, is a multiple of eight. Row i keeps columns i - half .. i + half; entry (i, j)
is at i * width + j - i + half, width = 2 half + 1. Some last unknowns, coupled beyond the band
(pockets), border it: columns `across` (hubs, n), rows `down` (hubs, n) and `corner` (hubs, hubs). Vectors have
`half` zeros before and after their n numbers, so that eights may be read beyond their ends.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from reynolds.numerics.lanes import WIDTH, all_lanes, lanes, put_lanes

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract", "reassoc"}}

Reals = NDArray[np.float64]


class Band(NamedTuple):
    """A matrix of n unknowns in a band and its border, then its factors L (unit diagonal) and U in their place.

    `reach` (n,): the last row (and column) that couples to one so far.
    """

    rows: Reals
    across: Reals
    down: Reals
    corner: Reals
    reach: NDArray[np.int64]
    half: int


@njit(**_FAST)
def fill(place, border, column, row, entries, order, band):
    """Spread entries (row, column) over the band: to `place` (entries,) in `rows`, negative for the border's.

    `order` (n,) is the new number of each unknown, those of hubs last; `border` lists the entries of the border.
    """
    size = len(band.reach)
    band.rows[:] = 0.0
    band.across[:] = 0.0
    band.down[:] = 0.0
    band.corner[:] = 0.0
    for k in range(len(place)):
        if place[k] >= 0:
            band.rows[place[k]] = entries[k]
    for k in border:
        i, j = order[row[k]], order[column[k]]
        if i < size and j >= size:
            band.across[j - size, i] = entries[k]
        elif i >= size and j < size:
            band.down[i - size, j] = entries[k]
        else:
            band.corner[i - size, j - size] = entries[k]


@njit(**_FAST)
def eliminate(band):
    """L and U in place of the matrix, without exchange of rows; False where a pivot vanishes.

    Afterwards `across` is the band's inverse times itself and `corner` the hubs' matrix without the others.
    """
    a, half, size = band.rows, band.half, len(band.reach)
    for k in range(size):
        own = k * (2 * half + 1) + half
        if not abs(a[own]) > 0.0:
            return False
        inverse = 1.0 / a[own]
        for i in range(k + 1, band.reach[k] + 1):
            at = own + (i - k) * 2 * half
            if a[at] != 0.0:
                a[at] *= inverse
                share = all_lanes(a, a[at])
                for c in range(1, band.reach[k] - k + 1, WIDTH):
                    put_lanes(a, at + c, lanes(a, at + c) - share * lanes(a, own + c))
    wide = np.zeros(size + 2 * half)
    for hub in range(len(band.across)):
        for j in range(size):
            wide[half + j] = band.across[hub, j]
        substitute(band, wide)
        for j in range(size):
            band.across[hub, j] = wide[half + j]
    for hub in range(len(band.across)):
        for other in range(len(band.across)):
            taken = 0.0
            for j in range(size):
                taken += band.down[hub, j] * band.across[other, j]
            band.corner[hub, other] -= taken
    return True


@njit(**_FAST)
def substitute(band, x):
    """x := (L U)^-1 x within the band; x has `half` zeros on either side."""
    a, half, size = band.rows, band.half, len(band.reach)
    width, eight = 2 * half + 1, np.zeros(WIDTH)
    for i in range(size):
        total = all_lanes(a, 0.0)
        for c in range(0, half, WIDTH):
            total += lanes(a, i * width + c) * lanes(x, i + c)
        put_lanes(eight, 0, total)
        x[half + i] -= eight.sum()
    for i in range(size - 1, -1, -1):
        total = all_lanes(a, 0.0)
        for c in range(half + 1, width, WIDTH):
            total += lanes(a, i * width + c) * lanes(x, i + c)
        put_lanes(eight, 0, total)
        x[half + i] = (x[half + i] - eight.sum()) / a[i * width + half]


@njit(**_FAST)
def substitute_rows(band, x):
    """x := (L U)^-1 x within the band for eight right-hand sides, x (n WIDTH,) with those of an unknown side by side.

    Each entry of the factors is read once for all eight.
    """
    a, half, size = band.rows, band.half, len(band.reach)
    width = 2 * half + 1
    for i in range(size):
        total = lanes(x, i * WIDTH)
        for j in range(max(0, i - half), i):
            entry = a[i * width + half + j - i]
            if entry != 0.0:
                total -= all_lanes(a, entry) * lanes(x, j * WIDTH)
        put_lanes(x, i * WIDTH, total)
    for i in range(size - 1, -1, -1):
        total = lanes(x, i * WIDTH)
        for j in range(i + 1, band.reach[i] + 1):
            total -= all_lanes(a, a[i * width + half + j - i]) * lanes(x, j * WIDTH)
        put_lanes(x, i * WIDTH, total / all_lanes(a, a[i * width + half]))


@njit(**_FAST)
def answers(band, inverse, order, loads, found):
    """Rows of found (m, n) := A^-1 rows of loads; `inverse` of the corner, `order` the new number of each unknown."""
    size, hubs = len(band.reach), len(band.across)
    wide, rest, hub_answers = np.zeros(size * WIDTH), np.zeros((hubs, WIDTH)), np.empty((hubs, WIDTH))
    for first in range(0, loads.shape[0], WIDTH):
        some = min(WIDTH, loads.shape[0] - first)
        for i in range(loads.shape[1]):
            for m in range(some):
                if order[i] < size:
                    wide[order[i] * WIDTH + m] = loads[first + m, i]
                else:
                    rest[order[i] - size, m] = loads[first + m, i]
        substitute_rows(band, wide)
        for hub in range(hubs):
            for j in range(size):
                down = band.down[hub, j]
                if down != 0.0:
                    for m in range(some):
                        rest[hub, m] -= down * wide[j * WIDTH + m]
        for hub in range(hubs):  # a matrix product would take seconds to compile
            for m in range(WIDTH):
                hub_answers[hub, m] = 0.0
                for other in range(hubs):
                    hub_answers[hub, m] += inverse[hub, other] * rest[other, m]
        for hub in range(hubs):
            for j in range(size):
                across = band.across[hub, j]
                for m in range(some):
                    wide[j * WIDTH + m] -= across * hub_answers[hub, m]
        for i in range(loads.shape[1]):
            for m in range(some):
                here = wide[order[i] * WIDTH + m] if order[i] < size else hub_answers[order[i] - size, m]
                found[first + m, i] = here


@njit(**_FAST)
def residual(indptr, indices, entries, load, x, left):
    """left := load - A x, A by columns; its norm, and that of the load."""
    for i in range(len(load)):
        left[i] = load[i]
    for j in range(len(load)):
        for k in range(indptr[j], indptr[j + 1]):
            left[indices[k]] -= entries[k] * x[j]
    rest = size = 0.0
    for i in range(len(load)):
        rest += left[i] * left[i]
        size += load[i] * load[i]
    return np.sqrt(rest), np.sqrt(size)


@njit(**_FAST)
def solve(band, inverse, order, pattern, entries, loads, tolerance, rounds, found):
    """Rows of found (m, n) := A^-1 rows of loads, refined until |A x - load| <= tolerance |load|; the residual.

    `pattern`: indptr and indices by columns. The residual is the largest |A x - load|/|load|.
    """
    answers(band, inverse, order, loads, found)
    worst, rest, more = 0.0, np.empty((1, loads.shape[1])), np.empty((1, loads.shape[1]))
    for m in range(loads.shape[0]):
        left, size = residual(pattern[0], pattern[1], entries, loads[m], found[m], rest[0])
        for _ in range(rounds):
            if left <= tolerance * size:
                break
            answers(band, inverse, order, rest, more)
            for i in range(loads.shape[1]):
                more[0, i] += found[m, i]
            less, size = residual(pattern[0], pattern[1], entries, loads[m], more[0], rest[0])
            if not less < left:
                break
            left = less
            for i in range(loads.shape[1]):
                found[m, i] = more[0, i]
        worst = max(worst, left / max(size, 1e-300)) if left == left else np.inf
    return worst
