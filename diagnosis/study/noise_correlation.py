"""Noise beyond the stated one: errors that persist in the order of recording, scatter about a smooth mismatch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular
from scipy.stats import norm

from diagnosis.study.map_axes import smooth_shapes
from diagnosis.study.model import Study
from diagnosis.thresholds import MismatchLimits
from reynolds.numerics.arrays import Array

LEAST_FREE = 0.1
"""Of a reading's noise, the part that a fit leaves at least where its residual counts."""
ENOUGH_FREE = 10.0
"""Readings beyond the fit from which a channel's scatter is estimated."""
MEDIAN = float(norm.isf(0.25))
"""Median of |r| in sigma."""


def noise_correlation(study: Study, limits: MismatchLimits) -> tuple[float, ...]:
    """Lag-1 correlation of the residual along the order, (rho,); () if it is not `memory` sigma above 0.

    Score test of an autoregressive noise (Rao 1948): with r ~ N(0, P) where noise is white and M half on every pair of
    consecutive readings of a channel, s^2 = 2 tr M P M P, z = (r.M r - tr M P)/s and rho = z/s, r in units of its own
    scatter where that exceeds the noise. A smooth mismatch over the map is removed, and only pairs apart on the map
    count: in sweeps, which have none, correlation cannot be separated from mismatch.
    """
    pairs = _pairs(study, limits.memory_apart)
    if len(pairs) < limits.memory_pairs:
        return ()
    residual, left = _without_smooth_mismatch(study, limits)
    residual = _clipped(residual, limits)
    expected, spread = left.of_pairs(pairs)
    scatter = max(1.0, float(residual @ residual) / float(left.diagonal.sum()))
    one, other = pairs.T
    excess = float(residual[one] @ residual[other]) / scatter - expected
    if excess < limits.memory * spread:
        return ()
    return (min(excess / spread**2, limits.memory_most),)


def noise_excess(study: Study, limits: MismatchLimits) -> Array:
    """Scatter (C,) of each channel's readings in units of their noise, 1 at least; 1 where it is more than `excess`.

    A smooth mismatch of every channel over the map is removed: the remainder is noise for any physics, unless it is so
    large that the mismatch is not smooth. Of the residual r = P y with P of trace n - m the mean square is r.r/tr P.
    """
    residual, left = _without_smooth_mismatch(study, limits)
    channel, count = study.base.whitening.rows[:, 1], study.observations.values.shape[1]
    squares, free = (np.bincount(channel, each, count) for each in (_clipped(residual, limits) ** 2, left.diagonal))
    scatter = np.sqrt(np.maximum(squares / np.maximum(free, 1.0), 1.0))
    return np.where(scatter > limits.excess, 1.0, scatter)


def stated_scatter(study: Study, limits: MismatchLimits) -> Array:
    """Scatter (C,) of half of each channel's readings about a smooth mismatch over the map, in units of their noise.

    By the median, which a part of the map where the mismatch is not smooth does not move; 0 for a channel with too few
    readings to tell.
    """
    residual, left = _without_smooth_mismatch(study, limits)
    free, channel = left.diagonal, study.base.whitening.rows[:, 1]
    sizes = np.abs(residual) / np.sqrt(np.maximum(free, LEAST_FREE))
    count = study.observations.values.shape[1]
    parts = [channel == at for at in range(count)]
    return np.array([np.median(sizes[own]) / MEDIAN if free[own].sum() >= ENOUGH_FREE else 0.0 for own in parts])


@dataclass(frozen=True)
class FitRemainder:
    """Residual projection of a fit to n readings, P = 1 - W W^T with W (n, m), without a matrix (n, n)."""

    columns: Array

    @property
    def diagonal(self) -> Array:
        """Diagonal (n,) of P."""
        return np.asarray(1.0 - np.sum(self.columns**2, axis=1))

    def of_pairs(self, pairs: NDArray[np.int64]) -> tuple[float, float]:
        """tr M P, and s of s^2 = 2 tr M P M P, with M half on every one of the pairs (p, 2).

        tr M P = -tr W^T M W, tr M P M P = tr M^2 - 2 tr W^T M M W + tr (W^T M W)^2.
        """
        one, other = pairs.T
        moved = np.zeros_like(self.columns)
        np.add.at(moved, one, 0.5 * self.columns[other])
        np.add.at(moved, other, 0.5 * self.columns[one])
        within = self.columns.T @ moved
        square = 0.5 * len(pairs) - 2.0 * np.sum(moved**2) + np.sum(within**2)
        return -float(np.trace(within)), float(np.sqrt(2.0 * square))


def _without_smooth_mismatch(study: Study, limits: MismatchLimits) -> tuple[Array, FitRemainder]:
    """Residual (n,) without a smooth mismatch over the map, and what is left so of any readings."""
    base = study.base
    slopes = np.hstack([base.slopes, _smooth_columns(study, limits.smooth)])
    root = np.linalg.cholesky(slopes.T @ slopes + np.eye(slopes.shape[1]))
    columns = solve_triangular(root, slopes.T, lower=True).T
    offset = base.residual + base.slopes @ base.xi
    residual = offset - columns @ (columns.T @ offset)
    return residual, FitRemainder(columns)


def _clipped(residual: Array, limits: MismatchLimits) -> Array:
    return np.clip(residual, -limits.memory_clip, limits.memory_clip)


def _pairs(study: Study, least: float) -> NDArray[np.int64]:
    """(m, 2), whitened rows of one channel at consecutive points that lie apart on the map."""
    point, channel = study.base.whitening.rows.T
    row = np.full((len(study.axes), channel.max() + 1), -1)
    row[point, channel] = np.arange(len(point))
    apart = np.linalg.norm(np.diff(study.axes, axis=0), axis=1) > least
    both = (row[:-1] >= 0) & (row[1:] >= 0) & apart[:, None]
    return np.stack([row[:-1][both], row[1:][both]], axis=1)


def _smooth_columns(study: Study, width: float) -> Array:
    """Whitened columns of a smooth mismatch of every channel by itself."""
    whitening, shapes = study.base.whitening, smooth_shapes(study.axes)
    count = whitening.measured.shape[1]
    columns = np.zeros((*whitening.measured.shape, count, shapes.shape[1]))
    for channel in range(count):
        columns[:, channel, channel] = width * whitening.sigma[:, channel, None] * shapes
    return whitening.whiten(columns.reshape(*whitening.measured.shape, -1))
