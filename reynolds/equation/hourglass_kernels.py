"""Reduced hourglass stiffness, compiled once by numba: see `hourglass`.

A cell's unknowns are numbered around it, 0 to 3; w = p_0 - p_1 + p_2 - p_3 is the amplitude of the hourglass mode.
pairs[shape, pair, q] as `ElementTensors`; parallel (shapes,) is 1 for parallelograms, whose linear pressures
have no part of the mode, and 0 for other shapes.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

from numba import njit

from reynolds.fem.kernels import _any_couples, at_index

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}
SIDES = (0, 2, 3, 5)  # pairs of neighbours among (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)


@njit(inline="always")
def _coupled(conductance, pairs, e, s, pair, points):
    """Coupling of two of a cell's unknowns by gradients at its corners: int k grad f_i . grad f_j."""
    total = 0.0
    for q in range(len(points)):
        total += conductance[e, q] * pairs[s, pair, q]
    return total


@njit(inline="always")
def sides_of(conductance, pairs, e, s, points):
    """Couplings of the four sides, below zero where they conduct."""
    return (
        _coupled(conductance, pairs, e, s, SIDES[0], points),
        _coupled(conductance, pairs, e, s, SIDES[1], points),
        _coupled(conductance, pairs, e, s, SIDES[2], points),
        _coupled(conductance, pairs, e, s, SIDES[3], points),
    )


@njit(inline="always")
def reduction_of(sides):
    """Reduction of a cell's hourglass stiffness, by the couplings of its sides.

    A sixth of their sum makes gradients at the corners those at Gauss's points, for a uniform film between
    parallel sides; the least of them is the most that leaves no positive coupling.
    """
    south, west, east, north = sides
    whole = -(south + west + east + north) / 6.0
    return max(0.0, min(whole, -max(max(south, west), max(east, north))))


@njit(**_FAST)
def stiffness(slots, shape, pairs, parallel, conductance, points, data):
    """data += int k grad f_i . grad f_j, i < j, in the fixed pattern, less reduction times g_i g_j.

    The diagonal is left to `kernels.close_rows`. Gradients at the corners of rectangles do not couple opposite
    corners: such sums are passed over.
    """
    crossed = _any_couples(pairs, 1) or _any_couples(pairs, 4)
    for e in range(slots.shape[0]):
        s = at_index(shape[e])
        south, west, east, north = sides = sides_of(conductance, pairs, e, s, points)
        less = parallel[s] * reduction_of(sides)
        rising = falling = -less
        if crossed:
            rising += _coupled(conductance, pairs, e, s, 1, points)
            falling += _coupled(conductance, pairs, e, s, 4, points)
        data[at_index(slots[e, 1])] += south + less
        data[at_index(slots[e, 2])] += rising
        data[at_index(slots[e, 3])] += west + less
        data[at_index(slots[e, 5])] += east + less
        data[at_index(slots[e, 6])] += falling
        data[at_index(slots[e, 8])] += north + less


@njit(inline="always")
def mode_of(dofs, pressure, e):
    """Amplitude of the hourglass mode of a cell's pressures."""
    return pressure[dofs[e, 0]] - pressure[dofs[e, 1]] + pressure[dofs[e, 2]] - pressure[dofs[e, 3]]


@njit(**_FAST)
def changed(dofs, shape, pairs, parallel, conductance, slope, pressure, points, out):
    """out[e, q] = - w d(reduction)/dk_q slope_q: flow into corners 0 and 2 by a change of the conductance."""
    for e in range(dofs.shape[0]):
        s = shape[e]
        sides = sides_of(conductance, pairs, e, s, points)
        less, w = reduction_of(sides), mode_of(dofs, pressure, e)
        weakest = 0
        for k in range(4):
            if sides[k] > sides[weakest]:
                weakest = k
        limited = less == -sides[weakest]
        for q in range(len(points)):
            total = 0.0
            for k in range(4):
                if less > 0.0 and (k == weakest or not limited):
                    total += pairs[s, SIDES[k], q] * (1.0 if limited else 1.0 / 6.0)
            out[e, q] = parallel[s] * w * total * slope[e, q]


@njit(**_FAST)
def saved(dofs, shape, pairs, parallel, conductance, pressure, points, out):
    """out[e] = reduction w^2, the dissipation taken off the cell, W."""
    for e in range(dofs.shape[0]):
        s = shape[e]
        less = reduction_of(sides_of(conductance, pairs, e, s, points))
        out[e] = parallel[s] * less * mode_of(dofs, pressure, e) ** 2


@njit(**_FAST)
def convected(dofs, slots, value, flow, points, upper, lower):
    """upper += int f_j flow times corner i's sign, i <= j, lower the mirror: slots as in `kernels.convection`."""
    for e in range(dofs.shape[0]):
        k = 0
        for i in range(4):
            for j in range(i, 4):
                ij = ji = 0.0
                for q in range(len(points)):
                    ij += value[q, j] * flow[e, q]
                    ji += value[q, i] * flow[e, q]
                ij, ji = ij * (1.0 - 2.0 * (i % 2)), ji * (1.0 - 2.0 * (j % 2))
                slot, one, two = slots[e, k], dofs[e, i], dofs[e, j]
                if i == j:
                    upper[slot] += ij
                elif one == two:
                    upper[slot] += ij + ji
                elif one < two:
                    upper[slot] += ij
                    lower[slot] += ji
                else:
                    upper[slot] += ji
                    lower[slot] += ij
                k += 1
