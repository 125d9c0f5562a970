"""The element loops of the film equation, compiled once by numba.

Weak form of the Reynolds equation (Reynolds 1886): for every test function f

    int r h^3/(12 mu) grad p . grad f - int theta r h U . grad f + int d(theta r h)/dt f = - contour int q_n f

with U the mean velocity of the two walls, theta the film fraction, r the density ratio and q_n the flow that leaves
through the edge; theta and r are nodal, and their product is called filling. Fields are given at the quadrature points,
(cells, points). Geometry enters by the tensors of the cells' shapes (`element_tensors`), or is recomputed in the loop.

`basis` and `points` are tuples as long as a cell has unknowns and quadrature points: the compiler knows the length
of a tuple and unrolls the loops over it.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

_FAST = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}


LEAST_MIXING = 1e-3
"""Share of upwinding's exchange kept with an edge without inflow: a ring of oil has no other level."""

ROUNDING = 1e-6
"""Weight of terms that cancel in a nearly uniform pressure: with the solver's 1e-9, some last places."""


@njit(inline="always")
def at_index(index):
    """An index that is not below zero, unsigned, so that numba does not test for counting from the end."""
    return np.uint32(index)


@njit(inline="always")
def _inverse_map(vertices, cell, geometry_gradient, q):
    """Jacobian determinant and inverse transpose of the map reference -> film plane at point q."""
    a = b = c = d = 0.0
    for v in range(cell.shape[0]):
        x, y = vertices[cell[v], 0], vertices[cell[v], 1]
        gx, gy = geometry_gradient[q, v, 0], geometry_gradient[q, v, 1]
        a += x * gx
        b += x * gy
        c += y * gx
        d += y * gy
    det = a * d - b * c
    return det, d / det, -c / det, -b / det, a / det


@njit(**_FAST)
def measure(vertices, cells, geometry_gradient, weights, area):
    """Fill area[cell, q] with weight x |Jacobian| (m2)."""
    for e in range(cells.shape[0]):
        for q in range(weights.shape[0]):
            det, _, _, _, _ = _inverse_map(vertices, cells[e], geometry_gradient, q)
            area[e, q] = weights[q] * abs(det)


@njit(**_FAST)
def _any_couples(pairs, pair):
    """True if any shape couples these two unknowns; the first decides for most meshes."""
    for s in range(pairs.shape[0]):
        for q in range(pairs.shape[2]):
            if pairs[s, pair, q] != 0.0:
                return True
    return False


@njit(**_FAST)
def stiffness(slots, shape, pairs, conductance, basis, points, data):
    """data += int k grad f_i . grad f_j, i < j, in the fixed pattern; pairs[shape, pair, q] as `ElementTensors`.

    The diagonal has no meaning afterwards: see `close_rows`. Pairs that no shape couples, such as opposite
    corners of rectangles, are passed over.
    """
    couples = np.empty(pairs.shape[1], np.bool_)
    for pair in range(pairs.shape[1]):
        couples[pair] = _any_couples(pairs, pair)
    for e in range(slots.shape[0]):
        s = at_index(shape[e])
        k = pair = 0
        for i in range(len(basis)):
            k += 1  # the diagonal's slot
            for _ in range(i + 1, len(basis)):
                if couples[pair]:
                    value = 0.0
                    for q in range(len(points)):
                        value += conductance[e, q] * pairs[s, pair, q]
                    data[at_index(slots[e, k])] += value
                k += 1
                pair += 1


@njit(**_FAST)
def close_rows(indptr, indices, data):
    """Set the diagonal so that rows of the symmetric matrix sum to zero: a uniform field drives no flow.

    Corners tied to one unknown (seam, pocket) have put their coupling on the diagonal; it is overwritten.
    """
    diagonal = np.zeros(indptr.shape[0] - 1)
    for j in range(indptr.shape[0] - 1):
        total = 0.0
        for k in range(at_index(indptr[j]), at_index(indptr[j + 1] - 1)):
            total += data[k]
            diagonal[at_index(indices[k])] -= data[k]
        diagonal[j] -= total
    for j in range(indptr.shape[0] - 1):
        data[at_index(indptr[j + 1] - 1)] = diagonal[j]


@njit(**_FAST)
def wall_outflow(dofs, shape, gradient, flux, basis, points, out, size):
    """out_i += - int flux df_i/dx, the walls' flow out of each unknown of a full film along one axis.

    gradient[shape, q, i] is the area element times df_i/dx of `ElementTensors`. size adds up the magnitudes of
    the cells, which cancel in a uniform film.
    """
    for e in range(dofs.shape[0]):
        s = at_index(shape[e])
        for i in range(len(basis)):
            flow = 0.0
            for q in range(len(points)):
                flow -= flux[e, q] * gradient[s, q, i]
            out[at_index(dofs[e, i])] += flow
            size[at_index(dofs[e, i])] += abs(flow)


@njit(**_FAST)
def convection(dofs, slots, shape, value, gradient, flux_x, flux_y, basis, points, upper, lower):
    """C_ij = - int f_j (flux_x, flux_y) . grad f_i: upper[slot] takes C_ij for i <= j, lower[slot] its mirror.

    gradient as for `wall_outflow`.
    """
    along = np.empty((len(points), len(basis)))
    upper[:] = 0.0
    lower[:] = 0.0
    for e in range(dofs.shape[0]):
        s = at_index(shape[e])
        for q in range(len(points)):
            fx, fy = flux_x[e, q], flux_y[e, q]
            for i in range(len(basis)):
                along[q, i] = fx * gradient[s, q, i, 0] + fy * gradient[s, q, i, 1]
        k = 0
        for i in range(len(basis)):
            for j in range(i, len(basis)):
                c_ij = c_ji = 0.0
                for q in range(len(points)):
                    c_ij -= value[q, j] * along[q, i]
                    c_ji -= value[q, i] * along[q, j]
                slot = at_index(slots[e, k])
                one, two = dofs[e, i], dofs[e, j]
                if i == j:
                    upper[slot] += c_ij
                elif one == two:
                    upper[slot] += c_ij + c_ji
                elif one < two:
                    upper[slot] += c_ij
                    lower[slot] += c_ji
                else:
                    upper[slot] += c_ji
                    lower[slot] += c_ij
                k += 1


@njit(**_FAST)
def upwinding(indptr, indices, upper, lower, leaves, diffusion):
    """The least diffusion D, symmetric with rows of sum zero, for which C + D couples nothing positively.

    Beside an edge without inflow (`leaves`) D uses the level of the unknown there for the edge's, as far as the edge's
    unknowns then have no net inflow.
    """
    size = indptr.shape[0] - 1
    taken, brought = np.zeros(size), np.zeros(size)
    diffusion[:] = 0.0
    for j in range(size):
        for k in range(at_index(indptr[j]), at_index(indptr[j + 1] - 1)):
            i = at_index(indices[k])
            if leaves[i] != leaves[j]:
                beside, c = (i, upper[k]) if leaves[j] else (j, lower[k])
                taken[beside] += max(0.0, c)
                brought[beside] += max(0.0, -c)
    for j in range(size):
        diagonal_j = at_index(indptr[j + 1] - 1)
        for k in range(at_index(indptr[j]), diagonal_j):
            i = at_index(indices[k])
            if leaves[i] != leaves[j]:
                beside, d = (i, upper[k]) if leaves[j] else (j, lower[k])
                if d < 0.0:
                    d *= min(1.0, taken[beside] / brought[beside])
                d += LEAST_MIXING * (max(0.0, upper[k], lower[k]) - d)
            else:
                d = 0.0 if leaves[i] else max(0.0, upper[k], lower[k])
            diffusion[k] = -d
            diffusion[diagonal_j] += d
            diffusion[at_index(indptr[i + 1] - 1)] += d


@njit(**_FAST)
def exchange(indptr, indices, coupling, level, out, size):
    """out_i += sum_j A_ij (level_j - level_i): A's rows sum to zero: nothing flows at one level everywhere.

    coupling is the upper triangle of the symmetric A. size adds up the magnitudes, and ROUNDING of terms that
    cancel in them: the scale against which out is round-off.
    """
    for j in range(indptr.shape[0] - 1):
        there = level[j]
        gone = met = 0.0
        for k in range(at_index(indptr[j]), at_index(indptr[j + 1] - 1)):
            i = at_index(indices[k])
            flow = coupling[k] * (there - level[i])
            lost = abs(flow) + ROUNDING * abs(coupling[k]) * (abs(level[i]) + abs(there))
            out[i] += flow
            gone += flow
            size[i] += lost
            met += lost
        out[j] -= gone
        size[j] += met


@njit(**_FAST)
def convect(indptr, indices, upper, lower, filling, out, size):
    """out += A filling, A's upper triangle by columns and the mirror of each entry in lower; size as above."""
    for j in range(indptr.shape[0] - 1):
        last = at_index(indptr[j + 1] - 1)
        full = filling[j]
        come = upper[last] * full
        met = abs(come)
        for k in range(at_index(indptr[j]), last):
            i = at_index(indices[k])
            there, here = upper[k] * full, lower[k] * filling[i]
            out[i] += there
            size[i] += abs(there)
            come += here
            met += abs(here)
        out[j] += come
        size[j] += met


@njit(**_FAST)
def lump(dofs, value, area, field, basis, points, out):
    """out[i] = int field f_i, with area[cell, q] the weights of the quadrature."""
    out[:] = 0.0
    for e in range(dofs.shape[0]):
        for i in range(len(basis)):
            total = 0.0
            for q in range(len(points)):
                total += area[e, q] * field[e, q] * value[q, i]
            out[at_index(dofs[e, i])] += total


@njit(**_FAST)
def gather(indptr, indices):
    """Number of the aggregate of each unknown, (n,) (Vanek, Mandel and Brezina 1996).

    The graph is symmetric. An unknown without aggregated neighbours forms an aggregate with them; the others join a
    neighbouring aggregate.
    """
    size = indptr.shape[0] - 1
    aggregate = np.full(size, -1, np.int32)
    count = 0
    for i in range(size):
        alone = aggregate[i] < 0
        for k in range(indptr[i], indptr[i + 1]):
            alone = alone and aggregate[indices[k]] < 0
        if alone:
            aggregate[i] = count
            for k in range(indptr[i], indptr[i + 1]):
                aggregate[indices[k]] = count
            count += 1
    gathered = aggregate.copy()
    for i in range(size):
        for k in range(indptr[i], indptr[i + 1]):
            if gathered[i] < 0:
                gathered[i] = aggregate[indices[k]]
    return gathered


@njit(**_FAST)
def find_slots(indptr, indices, row, column, slots):
    """Fill slots[cell, entry] with the index of (row, column) in sorted CSC indices, by bisection."""
    for e in range(row.shape[0]):
        for k in range(row.shape[1]):
            low, high = indptr[column[e, k]], indptr[column[e, k] + 1]
            while low < high:
                middle = (low + high) // 2
                if indices[middle] < row[e, k]:
                    low = middle + 1
                else:
                    high = middle
            slots[e, k] = low


@njit(**_FAST)
def evaluate(vertices, cells, dofs, value, gradient, geometry_gradient, weights, nodal, at, at_x, at_y):
    """Nodal field -> value and gradient at the quadrature points, (cells, points) each."""
    nb = dofs.shape[1]
    for e in range(cells.shape[0]):
        for q in range(weights.shape[0]):
            _, ixx, ixy, iyx, iyy = _inverse_map(vertices, cells[e], geometry_gradient, q)
            p = rx = ry = 0.0
            for i in range(nb):
                node = nodal[at_index(dofs[e, i])]
                p += node * value[q, i]
                rx += node * gradient[q, i, 0]
                ry += node * gradient[q, i, 1]
            at[e, q] = p
            at_x[e, q] = ixx * rx + ixy * ry
            at_y[e, q] = iyx * rx + iyy * ry


@njit(**_FAST)
def hold(indptr, indices, data, unit, held, gain, data_out):
    """unit times a matrix with gain on its diagonal, the identity in rows and columns of held unknowns.

    Upper triangle by columns (CSC), diagonal last in its column. The pattern stays, so that the symbolic
    part of a factorisation is kept while nodes enter and leave the cavity.
    """
    for k in range(data.shape[0]):
        data_out[k] = 0.0 if held[at_index(indices[k])] else unit * data[k]
    for j in range(indptr.shape[0] - 1):
        last = at_index(indptr[j + 1] - 1)
        if held[j]:
            data_out[indptr[j] : last] = 0.0
            data_out[last] = 1.0
        else:
            data_out[last] += unit * gain[j]


@njit(**_FAST)
def choose_columns(
    indptr, indices, p_upper, p_lower, f_upper, f_lower, p_gain, f_gain, held, cavity, p_scale, f_scale,
    upper, lower,
):  # fmt: skip
    """Newton's matrix: each unknown is a pressure (in the film) or a film fraction (in the cavity).

    p_* and f_* are the balance's slopes by nodal pressure and by nodal film fraction, p_gain and f_gain
    additions to their diagonals; p_scale and f_scale multiply them. Held unknowns get identity rows and columns.
    """
    for j in range(indptr.shape[0] - 1):
        last = at_index(indptr[j + 1] - 1)
        for k in range(at_index(indptr[j]), last):
            i = at_index(indices[k])
            if held[i] or held[j]:
                upper[k] = 0.0
                lower[k] = 0.0
            else:
                upper[k] = f_scale * f_upper[k] if cavity[j] else p_scale * p_upper[k]
                lower[k] = f_scale * f_lower[k] if cavity[i] else p_scale * p_lower[k]
        if held[j]:
            upper[last] = 1.0
        elif cavity[j]:
            upper[last] = f_scale * (f_upper[last] + f_gain[j])
        else:
            upper[last] = p_scale * (p_upper[last] + p_gain[j])
        lower[last] = upper[last]
