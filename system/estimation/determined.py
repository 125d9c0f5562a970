"""Combinations of parameters that the readings do not determine."""

from dataclasses import dataclass

import numpy as np

from reynolds.numerics.arrays import Array
from system.estimation.posterior import Posterior

SHOWN = 0.1  # weight below which a parameter is left out of a combination
TURNS = 50  # of the rotation at most; each is a small singular value decomposition
STILL = 1e-6  # relative gain of a turn below which the rotation rests


@dataclass(frozen=True)
class Combination:
    """A direction in xi that the readings hardly determine: sum of weights^2 is 1, without weights too small to
    show.

    shrinkage: posterior over prior variance along it, 1 where the readings contain no information.
    """

    names: tuple[str, ...]
    weights: tuple[float, ...]
    shrinkage: float


def undetermined(posterior: Posterior, limit: float = 0.9) -> tuple[Combination, ...]:
    """The combinations whose variance is more than `limit` of the prior's, the least determined first.

    They span the eigenvectors of the posterior's covariance in xi with eigenvalues above `limit`, rotated so that
    each combines few parameters (varimax; Kaiser 1958). Any other basis of that space is equivalent.
    """
    variance, axes = np.linalg.eigh(posterior.covariance)
    rotated = _varimax(axes[:, variance > limit])
    found = [_combination(posterior, direction) for direction in rotated.T]
    return tuple(sorted(found, key=lambda combination: -combination.shrinkage))


def _combination(posterior: Posterior, direction: Array) -> Combination:
    order = [at for at in np.argsort(-np.abs(direction)) if abs(direction[at]) >= SHOWN]
    sign = np.sign(direction[order[0]])
    return Combination(
        tuple(posterior.parameters[at].name for at in order),
        tuple(float(sign * direction[at]) for at in order),
        float(direction @ posterior.covariance @ direction),
    )


def _varimax(axes: Array) -> Array:
    """An orthonormal basis (k, m) of the same space whose squared weights vary the most."""
    count = axes.shape[1]
    if count < 2:
        return axes
    turn, reached = np.eye(count), 0.0
    for _ in range(TURNS):
        turned = axes @ turn
        left, size, right = np.linalg.svd(axes.T @ (turned**3 - turned * (turned**2).mean(axis=0)))
        turn = left @ right
        if size.sum() < reached * (1.0 + STILL):
            break
        reached = size.sum()
    return axes @ turn
