"""Assembly of a balance between elastic walls as a dense matrix, compiled once by numba."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from numba import njit

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}


@njit(**_FAST)
def mark_alone(rigid, slope, pressures, alone):
    """Mark the unknowns without a free pressure that couple to no other, by rigid (columns) and slope (rows)."""
    indptr, indices, data = rigid
    begins, _, slopes = slope
    alone[:] = False
    for j in range(len(alone)):
        for k in range(indptr[j], indptr[j + 1]):
            if indices[k] == j and data[k] != 0.0:
                alone[j] = pressures[j] == 0.0
    for j in range(len(alone)):
        for k in range(indptr[j], indptr[j + 1]):
            if indices[k] != j and data[k] != 0.0:
                alone[j] = alone[indices[k]] = False
        for k in range(begins[j], begins[j + 1]):
            if slopes[k] != 0.0:
                alone[j] = False


@njit(**_FAST)
def assemble(number, rigid, slope, wider, out):
    """out = A + B C P of the unknowns that have a number (size,), from 0; others, negative, are left out.

    rigid: indptr, indices and data of A by columns; slope: those of B by rows; wider (vertices, numbers): C P of these.
    """
    indptr, indices, data = rigid
    begins, vertices, slopes = slope
    out[:] = 0.0
    for i in range(len(number)):
        if number[i] < 0:
            continue
        row = out[number[i]]
        for k in range(begins[i], begins[i + 1]):
            opened, share = wider[vertices[k]], slopes[k]
            for j in range(len(row)):
                row[j] += share * opened[j]
    for j in range(len(number)):
        if number[j] >= 0:
            for k in range(indptr[j], indptr[j + 1]):
                if number[indices[k]] >= 0:
                    out[number[indices[k]], number[j]] += data[k]
