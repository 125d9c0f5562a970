"""Contrasts of patterns over the map with the residual of a fit, the fitted parameters projected out.

Never plain means of residuals: fitted parameters spread a mismatch over the whole map.
A contrast w = g.r / sqrt(g.P g), P = 1 - A H^-1 A^T, is N(0, 1) where the model holds.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from reynolds.numerics.arrays import Array
from system.estimation.evidence import NOTHING_LEFT
from system.estimation.posterior import Posterior


@dataclass(frozen=True)
class Misfit:
    """Residuals of single readings, (N, C): `pull` in their own sigma, and its variance where the model holds.

    Both are 0 where nothing was measured. Unlike whitened residuals they do not depend on the order of channels.
    """

    pull: Array
    variance: Array


@dataclass(frozen=True)
class Contrasts:
    """One channel, ready for any pattern: agreement (N,) and content (N, N) of a change by one sigma per point."""

    agreement: Array
    content: Array

    @property
    def scatter(self) -> float:
        """Scatter of the channel over its noise: root of chi-square per degree of freedom, 1 at least."""
        level, axes = np.linalg.eigh(self.content)
        kept = level > NOTHING_LEFT * level.max(initial=1.0)
        along = (axes.T @ self.agreement)[kept] ** 2 / level[kept]
        return max(1.0, float(np.sqrt(along.mean()))) if kept.any() else 1.0

    def z(self, patterns: Array) -> Array:
        """Contrasts (m,) of patterns (N, m), in sigma; 0 for a pattern that the parameters can follow."""
        content = np.einsum("nm,nm->m", patterns, self.content @ patterns)
        left = content > NOTHING_LEFT * (patterns**2).sum(axis=0)
        return np.where(left, self.agreement @ patterns / np.sqrt(np.where(left, content, 1.0)), 0.0)


def misfit(posterior: Posterior) -> Misfit:
    """Residual of each reading in its own sigma; cov(r) = P since parameters and noise both enter it."""
    whitening = posterior.whitening
    sigma = np.where(whitening.measured, whitening.sigma, 1.0)
    taken = whitening.unwhiten(posterior.slopes)
    variance = 1.0 - np.einsum("ncj,jk,nck->nc", taken, posterior.covariance, taken) / sigma**2
    pull = whitening.unwhiten(posterior.residual) / sigma
    return Misfit(pull, np.where(whitening.measured, variance, 0.0))


def contrasts(posterior: Posterior, channel: int, beside: Array | None = None) -> Contrasts:
    """One channel's contrasts; `beside`, whitened columns (n, m), is fitted too, each of prior N(0, 1).

    The residual of a linear model with more columns follows from the old one's offset, r + A xi.
    """
    whitening = posterior.whitening
    single = np.zeros((*whitening.measured.shape, len(whitening.measured)))
    points = np.arange(len(whitening.measured))
    single[points, channel, points] = np.where(whitening.measured, whitening.sigma, 0.0)[:, channel]
    columns = whitening.whiten(single)
    slopes = posterior.slopes if beside is None else np.hstack([posterior.slopes, beside])
    factor = cho_factor(slopes.T @ slopes + np.eye(slopes.shape[1]))
    offset = posterior.residual + posterior.slopes @ posterior.xi
    residual = offset - slopes @ cho_solve(factor, slopes.T @ offset)
    overlap = slopes.T @ columns
    return Contrasts(columns.T @ residual, columns.T @ columns - overlap.T @ cho_solve(factor, overlap))
