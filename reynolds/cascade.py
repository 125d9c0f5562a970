"""Where a film cavitates, found first on coarser problems: the start of the active set.

The front of a cavity moves by about one cell per step of the active set, so that a cold start costs steps in
proportion to the mesh. Coarse problems are algebraic (Ruge-Stueben 1987, pyamg), so any mesh has them; each
starts from the answer of the next coarser one (cascade: Bornemann and Deuflhard 1996).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array, triu

from reynolds.linear import Factor, multigrid
from reynolds.mesh import Array

COARSEST = 200  # unknowns: below this a cold start takes no more than a few steps
FINEST = 20_000  # unknowns: above this a coarse problem costs more than the steps that it saves
MAX_STEPS = 20  # per level: a guess that has not settled is still a guess


def nested_cavity(upper: csc_array, load: Array) -> NDArray[np.bool_]:
    """Where u = 0 in u >= 0, A u - load >= 0, u (A u - load) = 0, to within a few cells.

    `upper` is the upper triangle of A (n, n), symmetric positive definite; load, cavity (n,). A guess, best
    where A has the signs of a film operator (no positive couplings); the caller's active set makes it exact.
    """
    _, hierarchy = multigrid(upper, max_coarse=COARSEST)
    levels = hierarchy.levels
    loads = [load]
    for level in levels[:-1]:
        loads.append(level.P.T @ loads[-1])
    answer = np.ones(len(loads[-1]))
    for k in range(len(levels) - 1, 0, -1):
        if len(answer) <= FINEST:
            answer = _active_set(csr_array(levels[k].A), loads[k], answer <= 0.0)
        answer = levels[k - 1].P @ answer
    return answer <= 0.0


def _active_set(matrix: csr_array, load: Array, cavity: NDArray[np.bool_]) -> Array:
    upper = csc_array(triu(matrix, format="csc"))
    upper.sort_indices()
    column = np.repeat(np.arange(upper.shape[1]), np.diff(upper.indptr))
    diagonal = upper.indices == column
    factor = Factor()
    for _ in range(MAX_STEPS):
        entries = np.where(cavity[upper.indices] | cavity[column], diagonal.astype(float), upper.data)
        factor.update(csc_array((entries, upper.indices, upper.indptr), shape=upper.shape))
        answer = factor.solve(np.where(cavity, 0.0, load))
        now = np.where(cavity, matrix @ answer > load, answer < 0.0)
        answer[now] = 0.0
        if np.array_equal(now, cavity):
            break
        cavity = now
    return answer
