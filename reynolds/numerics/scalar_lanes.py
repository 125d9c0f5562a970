"""Lanes as arrays of eight numbers: plain loops, slow, for any numba."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

WIDTH = 8


@njit
def lanes(array, at):
    """array[at : at + 8] of an array of one axis."""
    out = np.empty(WIDTH, array.dtype)
    for k in range(WIDTH):
        out[k] = array[at + k]
    return out


@njit
def put_lanes(array, at, value):
    """array[at : at + 8] = value, in the array's precision."""
    for k in range(WIDTH):
        array[at + k] = value[k]


@njit
def lanes_like(array, value):
    """Eight numbers in the precision of an array."""
    return value.astype(array.dtype)


@njit
def all_lanes(array, number):
    """Eight times the same number, in the precision of an array."""
    out = np.empty(WIDTH, array.dtype)
    for k in range(WIDTH):
        out[k] = number
    return out


@njit
def where_positive(test, one, other):
    """Lane by lane: one where test > 0, else other."""
    out = np.empty_like(one)
    for k in range(WIDTH):
        out[k] = one[k] if test[k] > 0.0 else other[k]
    return out


@njit
def apart(a, b):
    """(a, b) -> their even and their odd numbers: a0 a2 .. b6 and a1 a3 .. b7."""
    even, odd = np.empty_like(a), np.empty_like(a)
    for k in range(WIDTH // 2):
        even[k], even[k + WIDTH // 2] = a[2 * k], b[2 * k]
        odd[k], odd[k + WIDTH // 2] = a[2 * k + 1], b[2 * k + 1]
    return even, odd


@njit
def together(a, b):
    """The mirror of `apart`: (a, b) -> a0 b0 .. a3 b3 and a4 b4 .. a7 b7."""
    low, high = np.empty_like(a), np.empty_like(a)
    for k in range(WIDTH // 2):
        low[2 * k], low[2 * k + 1] = a[k], b[k]
        high[2 * k], high[2 * k + 1] = a[k + WIDTH // 2], b[k + WIDTH // 2]
    return low, high
