"""Noise made white: readings, slopes and columns in units in which every residual has a sigma of one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular, toeplitz

from reynolds.numerics.arrays import Array
from system.estimation.observations import Observations


@dataclass(frozen=True)
class Whitening:
    """Whitening of arrays over N points and C channels, of which n readings count.

    factors: (N, C, C), L^-1 of each point's noise covariance L L^T; measured: (N, C), the readings that count. serial:
    one Cholesky factor per channel of the noise's correlation along the rows, or none. log_determinant: ln det of (L^-1
    times the repeatability), the contribution of the noise to the evidence.
    """

    factors: Array
    measured: NDArray[np.bool_]
    serial: tuple[Array, ...]
    log_determinant: float

    @property
    def rows(self) -> NDArray[np.int64]:
        """(n, 2), point and channel of the reading that each whitened row belongs to."""
        return np.argwhere(self.measured)

    def change(self, other: Whitening) -> float:
        """Largest difference of noise that the other whitens from white by this one: 0 for the same."""
        both = self.factors @ np.linalg.inv(other.factors)
        return float(np.abs(both - np.eye(both.shape[-1])).max())

    def whiten(self, array: Array) -> Array:
        """(N, C, ...) in SI to (n, ...) in sigma; readings that were not measured drop out."""
        shape = self.measured.shape + (1,) * (array.ndim - 2)
        known = np.where(self.measured.reshape(shape), array, 0.0)
        white: Array = np.einsum("nij,nj...->ni...", self.factors, known)[self.measured]
        channel = self.rows[:, 1]
        for index, factor in enumerate(self.serial):
            own = channel == index
            white[own] = solve_triangular(factor, white[own], lower=True)
        return white

    def unwhiten(self, white: Array) -> Array:
        """(n, ...) in sigma back to (N, C, ...) in SI, the inverse of `whiten`; 0 where nothing was measured."""
        white = white.copy()
        for index, factor in enumerate(self.serial):
            own = self.rows[:, 1] == index
            white[own] = factor @ white[own]
        known = np.zeros(self.measured.shape + white.shape[1:])
        known[self.measured] = white
        return np.einsum("nij,nj...->ni...", np.linalg.inv(self.factors), known)

    @property
    def sigma(self) -> Array:
        """(N, C) in SI: one sigma of each reading, with the noise of its inputs."""
        return np.sqrt((np.linalg.inv(self.factors) ** 2).sum(axis=2))


def whitener(observations: Observations, input_slopes: Array) -> Whitening:
    """The whitening of observations whose inputs are known to their own sigma only.

    Covariance of a point: diag(sigma^2 + quantum^2/12) + G diag(input_sigma^2) G^T, G = input_slopes (N, C, M): the
    noise of an input is common to all channels of its point. Valid while readings are near linear in their inputs over
    an input's sigma (errors in variables to first order; Fuller 1987, sections 1.2 and 3.1).
    """
    measured = observations.measured
    own = np.where(measured, observations.sigma, 1.0)
    by_inputs = np.where(measured[..., None], input_slopes, 0.0) * observations.input_sigma[:, None, :]
    covariance = by_inputs @ by_inputs.transpose(0, 2, 1)
    diagonal = own**2 + np.where(measured, observations.quantum**2 / 12.0, 0.0)
    covariance += diagonal[:, :, None] * np.eye(measured.shape[1])
    factors = np.linalg.inv(np.linalg.cholesky(covariance))
    log_determinant = np.log(own * np.einsum("nii->ni", factors)).sum()
    serial = _serial_factors(observations, own / np.sqrt(np.einsum("nii->ni", covariance)))
    log_determinant -= sum(np.log(np.diag(factor)).sum() for factor in serial)
    return Whitening(factors, measured, serial, float(log_determinant))


def autocorrelation(memory: tuple[float, ...], lags: int) -> Array:
    """Correlation at lags 0 .. lags - 1 of an autoregressive noise (Yule 1927, Walker 1931)."""
    order = len(memory)
    system = np.eye(order + 1)
    for lag in range(1, order + 1):
        for back, coefficient in enumerate(memory, start=1):
            system[lag, abs(lag - back)] -= coefficient
    first = np.linalg.solve(system, np.eye(order + 1)[0])
    correlation = np.zeros(max(lags, order + 1))
    correlation[: order + 1] = first
    for lag in range(order + 1, lags):
        correlation[lag] = np.dot(memory, correlation[lag - order : lag][::-1])
    return correlation[:lags]


def _serial_factors(observations: Observations, share: Array) -> tuple[Array, ...]:
    """Cholesky factors of each channel's correlation between its readings: as known, or at their distance in rows.

    share: (N, C), of a reading's sigma that is its own: the noise of its inputs is independent of known correlation.
    """
    if observations.correlation:
        pairs = zip(observations.correlation, share.T, strict=True)
        known = [np.asarray(own * np.outer(part, part) + np.diag(1.0 - part**2)) for own, part in pairs]
    elif observations.memory:
        known = [toeplitz(autocorrelation(observations.memory, len(share)))] * len(observations.channels)
    else:
        return ()
    return tuple(
        np.asarray(np.linalg.cholesky(correlation[np.ix_(there, there)]))
        for correlation, there in zip(known, observations.measured.T, strict=True)
    )
