"""Influence of a turned cylindrical part on a film's own numbers, compiled once by numba."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from numba import njit

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}


@njit(**_FAST)
def add_turned(influence, after, share, vertices, unknowns, matrix):
    """Add a part's influence (rows, period, columns, rows), turned by `after` + `share` columns, to a film's matrix.

    vertices (rows, columns + 1) and unknowns (rows, columns) of the film; matrix (vertices, size). Between two columns
    the mean of the part turned to either.
    """
    rows, period, columns, _ = influence.shape
    for k in range(1 if period == 1 else 2):
        weight = 1.0 if period == 1 else (share if k else 1.0 - share)
        for i in range(rows):
            for c in range(columns + 1):
                own = (c - after - k) % columns
                same = own % period
                opened = matrix[vertices[i, c]]
                for d in range(columns):
                    pressed = influence[i, same, (d - after - k - own + same) % columns]
                    for j in range(rows):
                        opened[unknowns[j, d]] += weight * pressed[j]
