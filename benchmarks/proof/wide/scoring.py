"""Score z of a shift: its length in sigma that remains after a fit of all uncertain parameters."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..sizing import NEAR, size_for

Array = NDArray[np.float64]
ROUNDS = 6  # of sizes that several need beside each other
LEAST = 0.2  # of the requested score: a smaller one counts as this in a round


@dataclass(frozen=True)
class Whitening:
    """weights: 1/sigma (N C,); factor: L of L L^T = 1 + A A^T, A the nuisances in sigma."""

    weights: Array
    factor: Array

    def white(self, moved: Array) -> Array:
        """A shift (N, C) in units of the total uncertainty, (N C,)."""
        return np.asarray(np.linalg.solve(self.factor, self.weights * moved.ravel()))

    def z(self, moved: Array) -> float:
        """sqrt(d^T (S + A A^T)^-1 d) of a shift d (N, C)."""
        return float(np.linalg.norm(self.white(moved)))


def whitening(sigma: Array, shared: Array, own: Array | None = None) -> Whitening:
    """Of readings with noise sigma (N, C); shared (k, N, C): one sigma of errors common to all points; own (m, N, C):
    of those of each point.
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
    return Whitening(weights, np.asarray(np.linalg.cholesky(covariance), dtype=float))


def apart(columns: Sequence[Array]) -> list[float]:
    """Length of each white shift that no combination of the others makes."""
    found = []
    for k, one in enumerate(columns):
        others = [each for at, each in enumerate(columns) if at != k]
        if others:
            matrix = np.stack(others, axis=1)
            one = one - matrix @ np.linalg.lstsq(matrix, one, rcond=None)[0]
        found.append(float(np.linalg.norm(one)))
    return found


def sizes(
    asked: float, white: Callable[[int, float], Array], mosts: Sequence[float]
) -> tuple[list[float], list[float]]:
    """Factors at which each of some secrets has a score beside the others, and scores reached; none beyond its most.

    white(k, factor): white shift of secret k alone. asked 0: at factor 1.
    """
    count = range(len(mosts))
    if asked == 0.0:
        return [1.0 for _ in count], apart([white(k, 1.0) for k in count])

    def alone(k: int) -> float:
        return size_for(asked, lambda factor: float(np.linalg.norm(white(k, factor))), 1.0, mosts[k])[0]

    factors = [alone(k) for k in count]
    for _ in range(ROUNDS):
        scores = apart([white(k, factors[k]) for k in count])
        if all(abs(z - asked) <= NEAR * asked or factors[k] >= mosts[k] for k, z in enumerate(scores)):
            break
        factors = [min(f * asked / max(z, LEAST * asked), m) for f, z, m in zip(factors, scores, mosts, strict=True)]
    return factors, apart([white(k, factors[k]) for k in count])
