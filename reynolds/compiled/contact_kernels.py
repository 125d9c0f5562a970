"""Deformation of rough elastic walls against their contact, by the table of the gap, compiled once by numba."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

from reynolds.compiled.gap_table import CONTACT
from reynolds.compiled.gap_table_kernels import place, read
from reynolds.equation.deformation import LEAST_GAIN, MAX_STEPS, MOST_HALVINGS, ROOM

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}


@njit(**_FAST)
def _touched(table, compliance, seats, shares, given, alone, found, bears, slopes, rest):
    """Contact (vertices,) Pa and its slope Pa/m at a deformation; rest: what is missing of it, m. Its norm."""
    pressed = np.zeros(compliance.shape[1])
    for v in range(len(found)):
        bears[v] = slopes[v] = 0.0
        if shares[v] > 0.0:
            knot, share, steep = place(table, given[v] + found[v])
            bears[v], slopes[v] = read(table, knot, share, steep, CONTACT)
            pressed[seats[v]] += shares[v] * bears[v]
    rest[:] = found - alone
    if pressed.any():
        rest -= np.dot(compliance, pressed)
    return np.sqrt(np.dot(rest, rest))


@njit(**_FAST)
def _step(compliance, seats, shares, slopes, stiff, rest):
    """x with x - C dp_c/dh x = rest, contact felt where it is stiffer than `stiff` (Pa/m)."""
    felt = np.flatnonzero(-slopes > stiff)
    if not len(felt):
        return rest.copy()
    columns = np.empty((len(rest), len(felt)))
    for k in range(len(felt)):
        columns[:, k] = compliance[:, seats[felt[k]]] * (shares[felt[k]] * slopes[felt[k]])
    here = np.linalg.solve(np.eye(len(felt)) - columns[felt], rest[felt])
    return rest + columns @ here


@njit(**_FAST)
def settle(table, compliance, seats, shares, given, alone, start, lowest, enough, stiff):
    """Deformation g = C (p + p_c(given + g)) of walls that film pressure alone deforms by `alone` (vertices,) m.

    As `equation.deformation.settled_deformation`. Also contact (vertices,) Pa and its slope Pa/m there, and whether
    the iteration has converged; lowest m: the gap at which the law of contact ends.
    """
    count = len(start)
    found, new = start.copy(), np.empty(count)
    bears, slopes, rest = np.empty(count), np.empty(count), np.empty(count)
    missing = _touched(table, compliance, seats, shares, given, alone, found, bears, slopes, rest)
    for _ in range(MAX_STEPS):
        if np.abs(rest).max() < enough:
            return found, bears, slopes, True
        change = _step(compliance, seats, shares, slopes, stiff, rest)
        share = 1.0
        for v in range(count):
            beyond = ROOM * (found[v] + given[v] - lowest)
            if change[v] > beyond:
                share = min(share, beyond / change[v])
        for _ in range(MOST_HALVINGS):
            new[:] = found - share * change
            after = _touched(table, compliance, seats, shares, given, alone, new, bears, slopes, rest)
            if after < (1.0 - LEAST_GAIN * share) * missing:
                break
            share *= 0.5
        found[:] = new
        missing = after
    return found, bears, slopes, False
