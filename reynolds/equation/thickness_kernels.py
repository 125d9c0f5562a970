"""Modes of the film's thickness: their integrals and sums, and the slopes of the flow balance by them.

`basis` and `points` are tuples as in `fem.kernels`; modes (cells, points, k) are given at the quadrature points.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

from reynolds.fem.kernels import LEAST_MIXING

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}


@njit(**_FAST)
def integrate(dofs, value, area, modes, basis, points, out):
    """out[i, j] = int f_i phi_j, m2 times the mode's unit."""
    out[:] = 0.0
    for e in range(dofs.shape[0]):
        for i in range(len(basis)):
            for q in range(len(points)):
                share = area[e, q] * value[q, i]
                for j in range(modes.shape[2]):
                    out[dofs[e, i], j] += share * modes[e, q, j]


@njit(**_FAST)
def mixed(modes, shares):
    """sum_j modes_j shares[j, m], (cells, points, m)."""
    out = np.zeros((modes.shape[0], modes.shape[1], shares.shape[1]))
    for e in range(modes.shape[0]):
        for q in range(modes.shape[1]):
            for j in range(modes.shape[2]):
                for m in range(shares.shape[1]):
                    out[e, q, m] += modes[e, q, j] * shares[j, m]
    return out


@njit(inline="always")
def _risen(e, q, i, s, row, value, steep, gradient, signs, area, driven_x, driven_y, hourglass, drag_x, drag_y,
           stored, filling):  # fmt: skip
    """Flow out of a cell's unknown per growth of the film at one of its points: see `thicken`."""
    flow = driven_x[e, q] * steep[s, q, i, 0] + driven_y[e, q] * steep[s, q, i, 1]
    flow += hourglass[e, q] * signs[i]
    flow -= drag_x[e, q] * gradient[s, q, i, 0] + drag_y[e, q] * gradient[s, q, i, 1]
    return flow + stored[e, q] * filling[row] * area[e, q] * value[q, i]


@njit(**_FAST)
def thicken(
    dofs, shape, value, steep, gradient, signs, area, driven_x, driven_y, hourglass, drag_x, drag_y, stored,
    filling, modes, basis, points, out,
):  # fmt: skip
    """out[i, j] = int phi_j (driven . grad f_i - drag . grad f_i + stored filling_i f_i).

    driven takes the gradients of the conductance (steep), drag the others, both area element times gradient of
    `ElementTensors`; stored is a rate per thickness (1/s) in a lumped term. With the flow of the hourglass mode
    (`hourglass_kernels.changed`) times each corner's sign.
    """
    out[:] = 0.0
    for e in range(dofs.shape[0]):
        s = shape[e]
        for i in range(len(basis)):
            row = dofs[e, i]
            for q in range(len(points)):
                flow = _risen(
                    e, q, i, s, row, value, steep, gradient, signs, area, driven_x, driven_y, hourglass, drag_x,
                    drag_y, stored, filling,
                )  # fmt: skip
                for j in range(modes.shape[2]):
                    out[row, j] += flow * modes[e, q, j]


@njit(**_FAST)
def levered(
    dofs, shape, value, steep, gradient, signs, area, driven_x, driven_y, hourglass, drag_x, drag_y, stored,
    filling, weight, basis, points, out,
):  # fmt: skip
    """out[e, q] = sum_i weight_i times the addition of `thicken` to i for a growth at this point: its transpose."""
    for e in range(dofs.shape[0]):
        s = shape[e]
        for q in range(len(points)):
            total = 0.0
            for i in range(len(basis)):
                row = dofs[e, i]
                total += weight[row] * _risen(
                    e, q, i, s, row, value, steep, gradient, signs, area, driven_x, driven_y, hourglass, drag_x,
                    drag_y, stored, filling,
                )  # fmt: skip
            out[e, q] = total


@njit(**_FAST)
def _apart(indptr, indices, level):
    """True for an unknown with a neighbour at another level, (size,)."""
    found = np.zeros(len(level), dtype=np.bool_)
    for j in range(len(level)):
        for k in range(indptr[j], indptr[j + 1] - 1):
            if level[indices[k]] != level[j]:
                found[indices[k]] = found[j] = True
    return found


@njit(inline="always")
def _convected(e, q, i, j, s, swapped, value, gradient, slope_x, slope_y):
    """Slopes of the convection's entry of a cell's unknowns i and j and of its mirror by the film at one point."""
    fx, fy = slope_x[e, q], slope_y[e, q]
    c_ij = -value[q, j] * (fx * gradient[s, q, i, 0] + fy * gradient[s, q, i, 1])
    c_ji = -value[q, i] * (fx * gradient[s, q, j, 0] + fy * gradient[s, q, j, 1])
    return (c_ji, c_ij) if swapped else (c_ij, c_ji)


@njit(**_FAST)
def _convection_slopes(
    dofs, slots, shape, value, gradient, slope_x, slope_y, modes, wanted, basis, points, upper, lower
):
    """Slopes (entries, k) of `kernels.convection` by the modes, at the wanted unknowns (size,)."""
    for e in range(dofs.shape[0]):
        needed = False
        for i in range(len(basis)):
            needed = needed or wanted[dofs[e, i]]
        if not needed:
            continue
        s, k = shape[e], 0
        for i in range(len(basis)):
            for j in range(i, len(basis)):
                slot, one, two = slots[e, k], dofs[e, i], dofs[e, j]
                k += 1
                if one == two:  # nothing that unknowns exchange
                    continue
                for q in range(len(points)):
                    c_ij, c_ji = _convected(e, q, i, j, s, one > two, value, gradient, slope_x, slope_y)
                    for m in range(modes.shape[2]):
                        upper[slot, m] += c_ij * modes[e, q, m]
                        lower[slot, m] += c_ji * modes[e, q, m]


@njit(inline="always")
def _largest_slope(upper, lower, more_upper, more_lower):
    """Slope of max(0, upper, lower)."""
    if upper <= 0.0 and lower <= 0.0:
        return 0.0
    return more_upper if upper > lower else more_lower


@njit(**_FAST)
def _exchanging(indptr, indices, leaves, level):
    """Entries beside an edge without inflow; entries between two levels; the column of each entry."""
    columns = np.empty(len(indices), dtype=np.int32)
    beside, uneven = np.empty(len(indices), dtype=np.int32), np.empty(len(indices), dtype=np.int32)
    one = two = 0
    for j in range(len(level)):
        for k in range(indptr[j], indptr[j + 1]):
            i, columns[k] = indices[k], j
            if leaves[i] != leaves[j]:
                beside[one] = k
                one += 1
            if level[i] != level[j] and not (leaves[i] and leaves[j]):
                uneven[two] = k
                two += 1
    return beside[:one], uneven[:two], columns


@njit(**_FAST)
def mixed_more(
    dofs, slots, shape, value, gradient, slope_x, slope_y, modes, basis, points,
    indptr, indices, upper, lower, leaves, level, out,
):  # fmt: skip
    """out[i, m] += change of the exchange of `kernels.upwinding` between levels, by the film's growth along modes.

    upper and lower are the convection's entries, slope_x and slope_y (cells, points) of its flux by the thickness.
    """
    wanted, count = _apart(indptr, indices, level), modes.shape[2]
    more_up, more_low = np.zeros((len(indices), count)), np.zeros((len(indices), count))
    _convection_slopes(
        dofs, slots, shape, value, gradient, slope_x, slope_y, modes, wanted, basis, points, more_up, more_low
    )
    beside, uneven, columns = _exchanging(indptr, indices, leaves, level)
    size = indptr.shape[0] - 1
    for m in range(count):
        taken, brought, taken_more, brought_more = np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(size)
        for k in beside:
            j = columns[k]
            at, c, more = (indices[k], upper[k], more_up[k, m]) if leaves[j] else (j, lower[k], more_low[k, m])
            taken[at] += max(0.0, c)
            brought[at] += max(0.0, -c)
            if c > 0.0:
                taken_more[at] += more
            else:
                brought_more[at] -= more
        for k in uneven:
            i, j = indices[k], columns[k]
            more = _largest_slope(upper[k], lower[k], more_up[k, m], more_low[k, m])
            if leaves[i] != leaves[j]:
                at, c, grown = (i, upper[k], more_up[k, m]) if leaves[j] else (j, lower[k], more_low[k, m])
                if c < 0.0 and taken[at] < brought[at]:
                    share = taken[at] / brought[at]
                    steeper = (taken_more[at] - share * brought_more[at]) / brought[at]
                    grown = share * grown + c * steeper
                more = LEAST_MIXING * more + (1.0 - LEAST_MIXING) * grown
            flow = -more * (level[j] - level[i])
            out[i, m] += flow
            out[j, m] -= flow


@njit(**_FAST)
def mixed_levered(
    dofs, slots, shape, value, gradient, slope_x, slope_y, weight, basis, points,
    indptr, indices, upper, lower, leaves, level, out,
):  # fmt: skip
    """out[e, q] += sum_i weight_i times the addition of `mixed_more` to i for a growth at this point: its transpose."""
    of_upper, of_lower = _mixing_levers(indptr, indices, upper, lower, leaves, level, weight)
    for e in range(dofs.shape[0]):
        s, k = shape[e], 0
        for i in range(len(basis)):
            for j in range(i, len(basis)):
                slot, one, two = slots[e, k], dofs[e, i], dofs[e, j]
                k += 1
                if one == two or (of_upper[slot] == 0.0 and of_lower[slot] == 0.0):
                    continue
                for q in range(len(points)):
                    c_ij, c_ji = _convected(e, q, i, j, s, one > two, value, gradient, slope_x, slope_y)
                    out[e, q] += of_upper[slot] * c_ij + of_lower[slot] * c_ji


@njit(**_FAST)
def _mixing_levers(indptr, indices, upper, lower, leaves, level, weight):
    """Slopes of sum_i weight_i exchange_i by the convection's entries and their mirrors, (entries,) each."""
    of_upper, of_lower = np.zeros(len(indices)), np.zeros(len(indices))
    beside, uneven, columns = _exchanging(indptr, indices, leaves, level)
    size = indptr.shape[0] - 1
    taken, brought, of_taken, of_brought = np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(size)
    for k in beside:
        at, c = (indices[k], upper[k]) if leaves[columns[k]] else (columns[k], lower[k])
        taken[at] += max(0.0, c)
        brought[at] += max(0.0, -c)
    for k in uneven:
        i, j = indices[k], columns[k]
        felt = -(weight[i] - weight[j]) * (level[j] - level[i])
        largest = felt
        if leaves[i] != leaves[j]:
            largest, own = LEAST_MIXING * felt, (1.0 - LEAST_MIXING) * felt
            at, c = (i, upper[k]) if leaves[j] else (j, lower[k])
            if c < 0.0 and taken[at] < brought[at]:
                share = taken[at] / brought[at]
                of_taken[at] += own * c / brought[at]
                of_brought[at] -= own * c * share / brought[at]
                own *= share
            if leaves[j]:
                of_upper[k] += own
            else:
                of_lower[k] += own
        of_upper[k] += largest * _largest_slope(upper[k], lower[k], 1.0, 0.0)
        of_lower[k] += largest * _largest_slope(upper[k], lower[k], 0.0, 1.0)
    for k in beside:
        j = columns[k]
        at, c = (indices[k], upper[k]) if leaves[j] else (j, lower[k])
        own = of_taken[at] if c > 0.0 else -of_brought[at]
        if leaves[j]:
            of_upper[k] += own
        else:
            of_lower[k] += own
    return of_upper, of_lower
