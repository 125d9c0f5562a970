"""The loops of the film's energy equation, compiled once by numba: flows along edges, blocks of nodes, sweeps.

Nodes are the unknowns of the film; each has `levels` temperatures across the film: fixed wall, Gauss points,
moving wall. Neighbours exchange heat at the Gauss points alone, so that the matrix is one dense block for each
node and a diagonal for each pair of neighbours.
"""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

from reynolds.fem.kernels import _inverse_map

_FAST = {"cache": True, "fastmath": False, "error_model": "numpy"}


@njit(**_FAST)
def wall_flows(
    vertices, cells, dofs, slots, value, gradient, geometry_gradient, weights, split,
    moving_x, moving_y, fixed_x, fixed_y, filling, out,
):  # fmt: skip
    """out[part, slot]: flow (m3/s) from the lower to the higher unknown of each pair of a cell's corners.

    Parts: dragged by the moving wall, by the fixed one. `split[pair, corner]` turns the outflow of a cell's
    corners into flows between them, so that the flows of a node sum to its Galerkin balance.
    """
    nb = dofs.shape[1]
    me, mq = int(moving_x.shape[0] > 1), int(moving_x.shape[1] > 1)
    ne, nq = int(moving_y.shape[0] > 1), int(moving_y.shape[1] > 1)
    fe, fq = int(fixed_x.shape[0] > 1), int(fixed_x.shape[1] > 1)
    ge, gq = int(fixed_y.shape[0] > 1), int(fixed_y.shape[1] > 1)
    off = np.empty((2, nb))
    out[:] = 0.0
    for e in range(cells.shape[0]):
        off[:] = 0.0
        for q in range(weights.shape[0]):
            det, ixx, ixy, iyx, iyy = _inverse_map(vertices, cells[e], geometry_gradient, q)
            full = 0.0
            for i in range(nb):
                full += filling[dofs[e, i]] * value[q, i]
            full *= weights[q] * abs(det)
            for i in range(nb):
                rx, ry = gradient[q, i, 0], gradient[q, i, 1]
                gx, gy = ixx * rx + ixy * ry, iyx * rx + iyy * ry
                off[0, i] -= full * (moving_x[e * me, q * mq] * gx + moving_y[e * ne, q * nq] * gy)
                off[1, i] -= full * (fixed_x[e * fe, q * fq] * gx + fixed_y[e * ge, q * gq] * gy)
        k = 0
        for i in range(nb):
            for j in range(i, nb):
                one, two = dofs[e, i], dofs[e, j]
                if one != two:
                    sign = 1.0 if one < two else -1.0
                    for part in range(2):
                        for corner in range(nb):
                            out[part, slots[e, k]] += sign * split[k, corner] * off[part, corner]
                k += 1


@njit(**_FAST)
def gather(start, neighbour, edge, sign, flow, pressure, out, along):
    """out[i, q] = flow off node i at each level; along[i, q] = flow . grad p of its control volume (W)."""
    out[:] = 0.0
    along[:] = 0.0
    for i in range(start.shape[0] - 1):
        for k in range(start[i], start[i + 1]):
            rise = 0.5 * (pressure[neighbour[k]] - pressure[i])
            for q in range(flow.shape[1]):
                f = sign[k] * flow[edge[k], q]
                out[i, q] += f
                along[i, q] += f * rise


@njit(**_FAST)
def blocks(start, edge, sign, flow, across, gain, conduction, derivative, second, wall_rows, out):
    """Fill out[i] with node i's own equations, (size, levels, levels); m3/s at the Gauss points.

    across: flow through the levels (size, m); gain: rest of the diagonal (size, m); conduction
    (size,); wall_rows (size, 2, levels): the equations of the two wall temperatures.
    """
    m = flow.shape[1]
    out[:] = 0.0
    for i in range(out.shape[0]):
        for level in range(m + 2):
            out[i, 0, level] = wall_rows[i, 0, level]
            out[i, m + 1, level] = wall_rows[i, 1, level]
        for q in range(m):
            for r in range(m):
                out[i, q + 1, r + 1] = across[i, q] * derivative[q, r]
            for level in range(m + 2):
                out[i, q + 1, level] -= conduction[i] * second[q, level]
            out[i, q + 1, q + 1] += gain[i, q]
            for k in range(start[i], start[i + 1]):
                out[i, q + 1, q + 1] += max(-sign[k] * flow[edge[k], q], 0.0)


@njit(**_FAST)
def apply(start, neighbour, edge, sign, flow, block, field, out):
    """out = the equations' left side of a field, both (size, levels), with upwind faces."""
    m = flow.shape[1]
    for i in range(block.shape[0]):
        for row in range(m + 2):
            total = 0.0
            for level in range(m + 2):
                total += block[i, row, level] * field[i, level]
            out[i, row] = total
        for k in range(start[i], start[i + 1]):
            for q in range(m):
                out[i, q + 1] -= max(-sign[k] * flow[edge[k], q], 0.0) * field[neighbour[k], q + 1]


@njit(**_FAST)
def sharpen(start, neighbour, edge, sign, flow, entering, inflow, field, least, out):
    """out[i, q]: correction of upwind faces to second order, in heat over rho c (m3/s K).

    The upstream node's part in the jump to its neighbour is limited by the jumps into that node (Kuzmin and Turek
    2004, with van Leer's smooth limiter), so that no new extremum arises; jumps below `least` (K) go upwind. The
    correction conserves heat.
    """
    size, m = out.shape
    out[:] = 0.0
    for i in range(size):
        for q in range(m):
            here = field[i, q + 1]
            raised = entering[i, q] * max(inflow[i] - here, 0.0)
            lowered = entering[i, q] * max(here - inflow[i], 0.0)
            falls = rises = leaves = 0.0
            for k in range(start[i], start[i + 1]):
                f = sign[k] * flow[edge[k], q]
                jump = field[neighbour[k], q + 1] - here
                if f < 0.0:
                    raised -= f * max(jump, 0.0)
                    lowered += f * min(jump, 0.0)
                else:
                    leaves += f * least
                    falls -= f * min(jump, 0.0)
                    rises += f * max(jump, 0.0)
            for k in range(start[i], start[i + 1]):
                f = sign[k] * flow[edge[k], q]
                jump = field[neighbour[k], q + 1] - here
                arrives, goes = (raised, falls) if jump < 0.0 else (lowered, rises)
                if f > 0.0 and arrives > 0.0:
                    added = -f * jump * arrives / (arrives + goes + leaves)
                    out[i, q] += added
                    out[neighbour[k], q] -= added


@njit(**_FAST)
def sweep(start, neighbour, edge, sign, flow, inverse, order, right, field):
    """Block Gauss-Seidel from a field of zeros: down the order of the flow and back up."""
    m = flow.shape[1]
    n = order.shape[0]
    rest = np.empty(m + 2)
    field[:] = 0.0
    for step in range(2 * n - 1):
        i = order[step] if step < n else order[2 * n - 2 - step]
        for row in range(m + 2):
            rest[row] = right[i, row]
        for k in range(start[i], start[i + 1]):
            for q in range(m):
                rest[q + 1] += max(-sign[k] * flow[edge[k], q], 0.0) * field[neighbour[k], q + 1]
        for row in range(m + 2):
            total = 0.0
            for level in range(m + 2):
                total += inverse[i, row, level] * rest[level]
            field[i, row] = total


@njit(**_FAST)
def downstream(start, neighbour, out_flow, first, order):
    """Nodes in the order of the flow, as far as it has no cycles: depth first, the last left first.

    out_flow[k] > 0 where the flow of entry k leaves its node; `first` are the nodes to begin at, in turn.
    """
    n = start.shape[0] - 1
    seen = np.zeros(n, dtype=np.bool_)
    place = start[:-1].copy()
    stack = np.empty(n, dtype=np.int64)
    left = n
    for origin in first:
        if seen[origin]:
            continue
        seen[origin] = True
        stack[0] = origin
        depth = 1
        while depth > 0:
            node = stack[depth - 1]
            k = place[node]
            if k == start[node + 1]:
                depth -= 1
                left -= 1
                order[left] = node
                continue
            place[node] += 1
            if out_flow[k] > 0.0 and not seen[neighbour[k]]:
                seen[neighbour[k]] = True
                stack[depth] = neighbour[k]
                depth += 1
