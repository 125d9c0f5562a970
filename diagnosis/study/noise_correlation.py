"""Noise beyond the stated one: errors that persist in the order of recording, scatter about a smooth mismatch."""

from __future__ import annotations

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from diagnosis.study.map_axes import smooth_shapes
from diagnosis.study.model import Study
from diagnosis.thresholds import MismatchLimits
from reynolds.numerics.arrays import Array


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
    one, other = pairs.T
    half = np.zeros_like(left)
    half[one, other] = half[other, one] = 0.5
    paired = half @ left
    spread = float(np.sqrt(2.0 * np.einsum("ij,ji->", paired, paired)))
    scatter = max(1.0, float(residual @ residual) / float(np.trace(left)))
    excess = float(residual @ half @ residual) / scatter - float(np.trace(paired))
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
    squares, free = (np.bincount(channel, each, count) for each in (residual**2, np.diag(left)))
    scatter = np.sqrt(np.maximum(squares / np.maximum(free, 1.0), 1.0))
    return np.where(scatter > limits.excess, 1.0, scatter)


def _without_smooth_mismatch(study: Study, limits: MismatchLimits) -> tuple[Array, Array]:
    """Residual (n,) without a smooth mismatch over the map, clipped, and the matrix (n, n) that leaves it."""
    base = study.base
    slopes = np.hstack([base.slopes, _smooth_columns(study, limits.smooth)])
    factor = cho_factor(slopes.T @ slopes + np.eye(slopes.shape[1]))
    offset = base.residual + base.slopes @ base.xi
    residual = offset - slopes @ cho_solve(factor, slopes.T @ offset)
    left = np.eye(len(offset)) - slopes @ cho_solve(factor, slopes.T)
    return np.clip(residual, -limits.memory_clip, limits.memory_clip), left


def _pairs(study: Study, least: float) -> Array:
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
