"""Assembly of a balance between elastic walls as a dense matrix, compiled once by numba."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from numba import njit

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}


@njit(**_FAST)
def assemble(number, rigid, slope, wider, pressures, out):
    """out = A + B C P of the unknowns that have a number (size,), from 0; others, negative, are left out.

    rigid: indptr, indices and data of A by columns; slope: those of B by rows; wider (vertices, size): C; pressures
    (size,): P's diagonal.
    """
    indptr, indices, data = rigid
    out[:] = 0.0
    for j in range(len(number)):
        if number[j] >= 0:
            for k in range(indptr[j], indptr[j + 1]):
                if number[indices[k]] >= 0:
                    out[number[indices[k]], number[j]] += data[k]
    begins, vertices, slopes = slope
    for i in range(len(number)):
        if number[i] < 0:
            continue
        row = out[number[i]]
        for k in range(begins[i], begins[i + 1]):
            opened, share = wider[vertices[k]], slopes[k]
            for j in range(len(number)):
                if number[j] >= 0 and pressures[j] != 0.0:
                    row[number[j]] += share * opened[j]
