"""Score z of a shift: its length in sigma that remains once all that is uncertain has been fitted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Whitening:
    """weights: 1/sigma (N C,); factor: L of L L^T = 1 + A A^T, A the nuisances in sigma."""

    weights: Array
    factor: Array

    def z(self, moved: Array) -> float:
        """sqrt(d^T (S + A A^T)^-1 d) of a shift d (N, C)."""
        return float(np.linalg.norm(np.linalg.solve(self.factor, self.weights * moved.ravel())))


def whitening(sigma: Array, shared: Array, own: Array | None = None) -> Whitening:
    """Of readings with noise sigma (N, C); shared (k, N, C): one sigma of what all points have in common; own
    (m, N, C): of what each point has by itself.
    """
    weights = 1.0 / sigma.ravel()
    columns = weights[:, None] * shared.reshape(len(shared), -1).T
    covariance = np.eye(weights.size) + columns @ columns.T
    if own is not None:
        count, channels = sigma.shape
        local = own / sigma
        blocks = np.einsum("mnc,mnd->ncd", local, local)
        rows = np.arange(count)
        covariance.reshape(count, channels, count, channels)[rows, :, rows, :] += blocks
    return Whitening(weights, np.linalg.cholesky(covariance))
