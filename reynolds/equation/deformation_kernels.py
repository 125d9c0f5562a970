"""Element loop for the slopes of the flow balance by the walls' deformation at the vertices.

`basis` and `points` are tuples as in `kernels`.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from numba import njit

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}


@njit(**_FAST)
def slopes_by_deformation(
    dofs, slots, shape, value, steep, gradient, corner, signs, area, driven_x, driven_y, hourglass, drag_x,
    drag_y, stored, filling, rows, basis, points, data,
):  # fmt: skip
    """data[slots[e, i, v]] += rows_i int f_v (driven . grad f_i - drag . grad f_i + stored f_i), m2/s.

    With the flow of the hourglass mode (`hourglass_kernels.changed`) times each corner's sign.
    """
    data[:] = 0.0
    for e in range(dofs.shape[0]):
        for i in range(len(basis)):
            row, content = rows[dofs[e, i]], filling[dofs[e, i]]
            for q in range(len(points)):
                driven = driven_x[e, q] * steep[shape[e], q, i, 0] + driven_y[e, q] * steep[shape[e], q, i, 1]
                driven += hourglass[e, q] * signs[i]
                drag = drag_x[e, q] * gradient[shape[e], q, i, 0] + drag_y[e, q] * gradient[shape[e], q, i, 1]
                total = row * (driven - drag + stored[e, q] * area[e, q] * value[q, i] * content)
                for v in range(corner.shape[1]):
                    data[slots[e, i, v]] += total * corner[q, v]
