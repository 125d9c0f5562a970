"""Noise of a meter's samples: white noise, noise with a short and noise with a long memory.

    S(f) = w + sum_k a_k (1 - r_k^2)/(1 - 2 r_k cos(2 pi f) + r_k^2)

fitted to the periodogram by Whittle's (1953) likelihood. Slow frequencies are left out: a law that has been fitted to
the readings has taken their noise up, and the correlation of what it leaves is too short.
"""

from __future__ import annotations

from dataclasses import dataclass
from operator import itemgetter

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import matmul_toeplitz
from scipy.optimize import minimize

from reynolds.numerics.arrays import Array

ABSORBED = 8.0  # periods over a series: slower noise is taken up by a law with slow cosines
MEMORIES = (3.0, 60.0)  # samples, at the beginning of the fit
SHORTEST = 0.3  # samples
FORGOTTEN = 1e-3  # correlation that counts as none


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


def sample_noise(residual: Array, place: NDArray[np.int64], count: int) -> SampleNoise:
    """Noise of residuals (n,) about a fitted law, at places (n,) of a raster of `count` samples."""
    variance = float(np.var(residual))
    if variance == 0.0 or len(residual) < 8:
        return SampleNoise(float(np.sqrt(variance)), np.ones(1))
    placed = np.zeros(count)
    placed[place] = (residual - residual.mean()) / np.sqrt(variance)
    power = np.abs(np.fft.rfft(placed)) ** 2 / len(residual)
    frequency = np.fft.rfftfreq(count)
    shown = (frequency > ABSORBED / count) & (frequency < 0.5)
    waves, power = np.cos(2.0 * np.pi * frequency[shown]), power[shown]

    longest = max(count / (2.0 * np.pi * ABSORBED), 2.0 * SHORTEST)
    white, shares, memories = min((_fitted(waves, power, terms, longest) for terms in (0, 1, 2)), key=itemgetter(0))[1]
    whole = white + shares.sum()
    apart = np.arange(int(np.ceil(memories.max(initial=0.0) * np.log(1.0 / FORGOTTEN))) + 1)
    correlation = (np.exp(-apart[:, None] / memories) @ shares + white * (apart == 0)) / whole
    return SampleNoise(float(np.sqrt(variance * whole)), correlation)


def _fitted(waves: Array, power: Array, terms: int, longest: float) -> tuple[float, tuple[float, Array, Array]]:
    """Akaike's (1974) criterion of white noise and some terms with memory; white variance, their variances, memories.

    A memory beyond the slowest wave that is shown is not told from this.
    """

    def lost(logs: Array) -> float:
        spectrum = _spectrum(*_parts(logs), waves)
        return float(np.sum(np.log(spectrum) + power / spectrum))

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
