"""Conjugate gradients of one symmetric matrix, preconditioned by multigrid of another one, compiled once by numba."""

# mypy: allow-untyped-defs, allow-incomplete-defs, no-check-untyped-defs

import numpy as np
from numba import njit

from reynolds.fem.kernels import at_index
from reynolds.linear.multigrid.cycle_kernels import cycle

_FAST = {"cache": True, "error_model": "numpy", "fastmath": {"contract", "reassoc"}}


@njit(**_FAST)
def apply(indptr, indices, data, x, out):
    """out = A x by A's upper triangle (CSC); returns x . A x."""
    total = 0.0
    for j in range(indptr.shape[0] - 1):
        last = at_index(indptr[j + 1] - 1)
        here, image = x[j], data[last] * x[j]
        for k in range(at_index(indptr[j]), last):
            i = at_index(indices[k])
            out[i] += data[k] * here
            image += data[k] * x[i]
        out[j] = image
    for j in range(x.shape[0]):
        total += x[j] * out[j]
    return total


@njit(**_FAST)
def conjugate_gradients(indptr, indices, data, levels, slots, residual, x, work, goal, most):
    """Add to x the solution of A x = residual to |residual| <= goal; returns steps.

    Unknown k is at slots[k] of the finest of `levels`, whose cycle preconditions. Hestenes and Stiefel 1952.
    """
    top, coarse, coarsest = levels
    direction, image = work[0], work[1]
    left, steps, before = residual @ residual, 0, 1.0
    while goal * goal < left < np.inf and steps < most:
        unit = np.sqrt(left)  # of the residual, whose numbers may be too small for single precision
        for k in range(slots.shape[0]):
            top.load[slots[k]] = residual[k] / unit
        cycle(top, coarse, coarsest)
        now = 0.0
        for k in range(slots.shape[0]):
            now += residual[k] * top.answer[slots[k]]
        now *= unit
        if not now > 0.0:
            break
        beta = now / before if steps else 0.0
        for k in range(slots.shape[0]):
            direction[k] = unit * top.answer[slots[k]] + beta * direction[k]
        curvature = apply(indptr, indices, data, direction, image)
        if not curvature > 0.0:
            break
        length, left = now / curvature, 0.0
        for k in range(slots.shape[0]):
            x[k] += length * direction[k]
            residual[k] -= length * image[k]
            left += residual[k] * residual[k]
        before = now
        steps += 1
    return steps
