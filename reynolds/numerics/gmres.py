"""GMRES (Saad and Schultz 1986) for operators given by their action on a vector."""

from collections.abc import Callable

import numpy as np

from reynolds.numerics.array_kernels import norm
from reynolds.numerics.arrays import Array

NOTHING = 1e-14  # of an image: remainder of one that lies in the basis


def gmres(image: Callable[[Array], Array], load: Array, tolerance: float, most: int) -> tuple[Array, float]:
    """x (n,) of least |A x - load| after as few steps as reach tolerance |load|, `most` of them; the residual.

    image(v) = A v, not zero for v not zero. The residual over |load| is that of the recursion, equal to the
    true one in exact arithmetic.
    """
    size = norm(load)
    if size == 0.0:
        return np.zeros(len(load)), 0.0
    basis, columns = np.empty((most + 1, len(load))), np.zeros((most + 1, most))
    basis[0] = load / size
    # The residual of the projected problem lies along the one vector that is normal to all of its columns.
    normal = np.zeros(most + 1)
    normal[0], left = 1.0, 1.0
    steps = 0
    while steps < most and left > tolerance:
        new, known = image(basis[steps]), basis[: steps + 1]
        before = norm(new)
        along = known @ new
        new = new - along @ known
        again = known @ new  # twice is enough (Parlett 1980)
        new -= again @ known
        columns[: steps + 1, steps], beyond = along + again, norm(new)
        steps += 1
        if beyond <= NOTHING * before:
            left = 0.0
            break
        columns[steps, steps - 1] = beyond
        basis[steps] = new / beyond
        normal[steps] = -(normal[:steps] @ columns[:steps, steps - 1]) / beyond
        left = 1.0 / norm(normal[: steps + 1])
    q, r = np.linalg.qr(columns[: steps + 1, :steps])
    return np.asarray(np.linalg.solve(r, size * q[0]) @ basis[:steps]), left
