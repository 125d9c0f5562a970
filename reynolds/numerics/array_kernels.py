"""Loops over the numbers of one array, compiled once by numba: one pass where numpy takes several."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}
_SUMS = _FAST | {"fastmath": {"contract", "reassoc"}}  # lets a sum run in several parts at once


@njit(**_SUMS)
def all_finite(values):
    """True if every value of an array (n,) is finite."""
    total = 0.0
    for k in range(values.shape[0]):
        total += 0.0 * values[k]  # NaN for an infinite value
    return total == 0.0


@njit(**_FAST)
def all_equal(values, value):
    """True if every entry of an array (n,) is this value."""
    same = True
    for k in range(values.shape[0]):
        same &= values[k] == value
    return same


@njit(**_FAST)
def scaled_free(values, factor, held):
    """factor times the values (n,) that are not held, zero for those that are."""
    out = np.empty(values.shape[0])
    for k in range(values.shape[0]):
        out[k] = 0.0 if held[k] else factor * values[k]
    return out


@njit(**_FAST | {"fastmath": {"contract", "nnan"}})
def cubes(values, unit, out):
    """out = unit values^3, (n,) of numbers; the least and the largest of them."""
    least, most = np.inf, -np.inf
    for k in range(values.shape[0]):
        out[k] = unit * (values[k] * values[k] * values[k])
        least, most = min(least, out[k]), max(most, out[k])
    return least, most


@njit(**_SUMS)
def norm(vector):
    """Euclidean norm, without the threads of a BLAS library, which do not pay here."""
    total = 0.0
    for k in range(vector.shape[0]):
        total += vector[k] * vector[k]
    return np.sqrt(total)


@njit(**_FAST)
def largest(values):
    """Largest magnitude of an array (n,), 0 of an empty one; NaN if one is."""
    found = 0.0
    for k in range(values.shape[0]):
        size = abs(values[k])
        if np.isnan(size):
            return size
        found = max(found, size)
    return found


@njit(**_FAST)
def largest_share(rest, size, weak, held):
    """Largest |rest| of those not held, (n,), over their size and `weak` times the largest size; NaN if one is."""
    largest, found = 0.0, 0.0
    for k in range(size.shape[0]):
        largest = max(largest, size[k])
    least = max(weak * largest, 1e-300)
    for k in range(rest.shape[0]):
        if not held[k]:
            share = abs(rest[k]) / (size[k] + least)
            if np.isnan(share):
                return share
            found = max(found, share)
    return found
