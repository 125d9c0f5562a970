"""Element loops over modes: what a mode of the film's thickness weighs, and what it does to the flow balance.

`basis` and `points` are tuples as in `kernels`; modes (cells, points, k) stand at the quadrature points.
"""

from numba import njit

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}


@njit(**_FAST)
def weigh(dofs, value, area, modes, basis, points, out):
    """out[i, j] = int f_i phi_j, m2 times the mode's unit."""
    out[:] = 0.0
    for e in range(dofs.shape[0]):
        for i in range(len(basis)):
            for q in range(len(points)):
                share = area[e, q] * value[q, i]
                for j in range(modes.shape[2]):
                    out[dofs[e, i], j] += share * modes[e, q, j]


@njit(**_FAST)
def thicken(
    dofs, shape, value, steep, gradient, area, driven_x, driven_y, carried_x, carried_y, stored, filling, modes,
    basis, points, out,
):  # fmt: skip
    """out[i, j] = int phi_j (driven . grad f_i - carried . grad f_i + stored filling_i f_i).

    driven goes with the gradients of the conductance (steep), carried with the others, both area element times
    gradient as `ElementTensors` has them; stored is a rate per thickness (1/s) in a lumped term.
    """
    out[:] = 0.0
    for e in range(dofs.shape[0]):
        s = shape[e]
        for i in range(len(basis)):
            row = dofs[e, i]
            for q in range(len(points)):
                flow = driven_x[e, q] * steep[s, q, i, 0] + driven_y[e, q] * steep[s, q, i, 1]
                flow -= carried_x[e, q] * gradient[s, q, i, 0] + carried_y[e, q] * gradient[s, q, i, 1]
                flow += stored[e, q] * filling[row] * area[e, q] * value[q, i]
                for j in range(modes.shape[2]):
                    out[row, j] += flow * modes[e, q, j]
