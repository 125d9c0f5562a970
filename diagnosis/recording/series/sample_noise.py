"""Noise of a meter's samples: white noise and noise with short and long memories.

    S(f) = w + sum_k a_k (1 - r_k^2)/(1 - 2 r_k cos(2 pi f) + r_k^2)

fitted to the periodogram of the residuals of a law by Whittle's (1953) likelihood. The law has absorbed a share h(f) of
the noise at each frequency, most where it varies slowly itself: S (1 - h) remains.
"""

from __future__ import annotations

from dataclasses import dataclass
from operator import itemgetter

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import matmul_toeplitz
from scipy.optimize import minimize

from reynolds.numerics.arrays import Array

MEMORIES = (3.0, 100.0, 20.0)  # samples, at the beginning of the fit
SHORTEST = 0.3  # samples
LONGEST = 0.05  # of the series: slower noise is part of the law
MOST_TAKEN = 0.9  # absorbed share of a frequency above which the remainder has no information
FORGOTTEN = 1e-3  # correlation that counts as zero


@dataclass(frozen=True)
class SampleNoise:
    """Noise of single samples. sigma: SI; correlation: (L,), of samples that are 0 to L - 1 apart, 0 beyond."""

    sigma: float
    correlation: Array

    def of_means(self, shares: Array) -> Array:
        """Covariance (N, N) of means with shares (N, T) of the samples of a raster."""
        column = np.zeros(shares.shape[1])
        known = min(column.size, self.correlation.size)
        column[:known] = self.correlation[:known]
        return np.asarray(self.sigma**2 * (shares @ matmul_toeplitz(column, shares.T)))


def sample_noise(residual: Array, columns: Array, place: NDArray[np.int64], count: int) -> SampleNoise:
    """Noise of residuals (n,) of a law with columns (n, m), at places (n,) of a raster of `count` samples."""
    variance = float(residual @ residual) / max(len(residual) - columns.shape[1], 1)
    if variance == 0.0 or len(residual) < 2 * columns.shape[1]:
        return SampleNoise(float(np.sqrt(variance)), np.ones(1))
    power = _power(residual[:, None] / np.sqrt(variance), place, count)
    taken = _power(np.linalg.qr(columns / np.maximum(np.abs(columns).max(axis=0), 1e-300))[0], place, count)
    frequency = np.fft.rfftfreq(count)
    shown = (frequency > 0.0) & (frequency < 0.5) & (taken < MOST_TAKEN)
    periodogram = _Periodogram(np.cos(2.0 * np.pi * frequency[shown]), power[shown], 1.0 - taken[shown])
    fits = (_fitted(periodogram, terms, LONGEST * count) for terms in range(len(MEMORIES) + 1))
    white, shares, memories = min(fits, key=itemgetter(0))[1]
    whole = white + shares.sum()
    apart = np.arange(int(np.ceil(memories.max(initial=0.0) * np.log(1.0 / FORGOTTEN))) + 1)
    correlation = (np.exp(-apart[:, None] / memories) @ shares + white * (apart == 0)) / whole
    return SampleNoise(float(np.sqrt(variance * whole)), correlation)


@dataclass(frozen=True)
class _Periodogram:
    """Power by the cosine of the angle a sample, and the remaining share of the noise in it; (F,) each."""

    waves: Array
    power: Array
    left: Array


def _power(values: Array, place: NDArray[np.int64], count: int) -> Array:
    """Power (F,) of columns (n, m) together at places of a raster, a sample."""
    placed = np.zeros((count, values.shape[1]))
    placed[place] = values
    return np.asarray((np.abs(np.fft.rfft(placed, axis=0)) ** 2).sum(axis=1) / len(place))


def _fitted(of: _Periodogram, terms: int, longest: float) -> tuple[float, tuple[float, Array, Array]]:
    """Half of Akaike's (1974) criterion, the white variance, variances and memories of some terms beside it."""

    def lost(logs: Array) -> float:
        spectrum = of.left * _spectrum(*_parts(logs), of.waves)
        return float(np.sum(np.log(spectrum) + of.power / spectrum))

    longest = max(longest, 2.0 * SHORTEST)
    start = np.log(np.concatenate((np.full(1 + terms, 1.0 / (1 + terms)), np.minimum(MEMORIES[:terms], longest))))
    bounds = [(-14.0, 3.0)] * (1 + terms) + [(float(np.log(SHORTEST)), float(np.log(longest)))] * terms
    found = minimize(lost, start, method="L-BFGS-B", bounds=bounds)
    return float(found.fun) + len(start), _parts(found.x)


def _parts(logs: Array) -> tuple[float, Array, Array]:
    """White variance, variances and memories of the other terms."""
    white, *rest = np.exp(logs)
    half = len(rest) // 2
    return float(white), np.array(rest[:half]), np.array(rest[half:])


def _spectrum(white: float, shares: Array, memories: Array, waves: Array) -> Array:
    """Power by the cosine of the angle a sample, of noise whose variance is white + sum(shares)."""
    left = np.exp(-1.0 / memories)
    return white + (shares * (1.0 - left**2) / (1.0 - 2.0 * left * waves[:, None] + left**2)).sum(axis=1)
