"""Deformation of rough elastic walls against their contact, by the table of the gap, compiled once by numba.

Plain loops: numba compiles matrix products and slices several times as long.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

from reynolds.compiled.gap_table import CONTACT
from reynolds.compiled.gap_table_kernels import place, read
from reynolds.equation.deformation import LEAST_GAIN, MAX_STEPS, MOST_HALVINGS, ROOM
from reynolds.numerics.array_kernels import largest

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}


@njit(**_FAST)
def _touched(table, compliance, seats, shares, given, alone, found, bears, slopes, rest):
    """Contact (vertices,) Pa and its slope Pa/m at a deformation; rest: residual of the deformation, m. Its norm."""
    seated = compliance.shape[1]
    pressed, borne, count = np.zeros(seated), np.empty(seated, np.int64), 0
    for v in range(len(found)):
        bears[v] = slopes[v] = 0.0
        if shares[v] > 0.0:
            knot, share, steep = place(table, given[v] + found[v])
            bears[v], slopes[v] = read(table, knot, share, steep, CONTACT)
            if bears[v] != 0.0:
                if pressed[seats[v]] == 0.0:
                    borne[count] = seats[v]
                    count += 1
                pressed[seats[v]] += shares[v] * bears[v]
    square = 0.0
    for v in range(len(found)):
        missing = found[v] - alone[v]
        for k in range(count):
            missing -= compliance[v, borne[k]] * pressed[borne[k]]
        rest[v] = missing
        square += missing * missing
    return np.sqrt(square)


@njit(**_FAST)
def _solve(matrix, x):
    """x := A^-1 x by elimination with exchange of rows, A (n, n) overwritten; not finite where A is singular."""
    n = len(x)
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > abs(matrix[pivot, k]):
                pivot = i
        if pivot != k:
            for j in range(k, n):
                matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
            x[k], x[pivot] = x[pivot], x[k]
        for i in range(k + 1, n):
            share = matrix[i, k] / matrix[k, k]
            if share != 0.0:
                for j in range(k + 1, n):
                    matrix[i, j] -= share * matrix[k, j]
                x[i] -= share * x[k]
    for k in range(n - 1, -1, -1):
        for j in range(k + 1, n):
            x[k] -= matrix[k, j] * x[j]
        x[k] /= matrix[k, k]


@njit(**_FAST)
def _step(compliance, seats, shares, slopes, stiff, rest, change):
    """change := x with x - C dp_c/dh x = rest, contact counted where it is stiffer than `stiff` (Pa/m)."""
    felt, count = np.empty(len(rest), np.int64), 0
    for v in range(len(rest)):
        change[v] = rest[v]
        if -slopes[v] > stiff:
            felt[count] = v
            count += 1
    matrix, here = np.empty((count, count)), np.empty(count)
    for k in range(count):
        v, here[k] = felt[k], rest[felt[k]]
        for i in range(count):
            matrix[i, k] = -compliance[felt[i], seats[v]] * (shares[v] * slopes[v])
        matrix[k, k] += 1.0
    _solve(matrix, here)
    for k in range(count):
        seat, pressed = seats[felt[k]], shares[felt[k]] * slopes[felt[k]] * here[k]
        for v in range(len(rest)):
            change[v] += compliance[v, seat] * pressed


@njit(**_FAST)
def settle(table, compliance, seats, shares, given, alone, start, lowest, enough, stiff):
    """Deformation g = C (p + p_c(given + g)) of walls that film pressure alone deforms by `alone` (vertices,) m.

    As `equation.deformation.settled_deformation`. Also contact (vertices,) Pa and its slope Pa/m there, and whether
    the iteration has converged; lowest m: the gap at which the law of contact ends.
    """
    count = len(start)
    found, new, change = np.empty(count), np.empty(count), np.empty(count)
    bears, slopes, rest = np.empty(count), np.empty(count), np.empty(count)
    for v in range(count):
        found[v] = start[v]
    missing = _touched(table, compliance, seats, shares, given, alone, found, bears, slopes, rest)
    for _ in range(MAX_STEPS):
        if largest(rest) < enough:
            return found, bears, slopes, True
        _step(compliance, seats, shares, slopes, stiff, rest, change)
        share = 1.0
        for v in range(count):
            beyond = ROOM * (found[v] + given[v] - lowest)
            if change[v] > beyond:
                share = min(share, beyond / change[v])
        for _ in range(MOST_HALVINGS):
            for v in range(count):
                new[v] = found[v] - share * change[v]
            after = _touched(table, compliance, seats, shares, given, alone, new, bears, slopes, rest)
            if after < (1.0 - LEAST_GAIN * share) * missing:
                break
            share *= 0.5
        for v in range(count):
            found[v] = new[v]
        missing = after
    return found, bears, slopes, False
