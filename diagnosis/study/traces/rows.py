"""A recorded trace as some tens of numbers with white noise: rows of the fit beside the steady readings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.recording.model import RecordedChannel, TraceBlock, reading_sigma
from reynolds.numerics.arrays import Array

WINDOWS = 24  # of a turn: the numbers that are kept of a trace


@dataclass(frozen=True)
class TraceRows:
    """Weights (F, K), 1/Pa: F numbers, each of a noise of one, of a trace (K,) at the angles of `block`."""

    block: TraceBlock
    weights: Array

    @property
    def values(self) -> Array:
        """(F,), of the recorded mean."""
        found: Array = self.weights @ self.block.mean
        return found


def trace_rows(block: TraceBlock, channel: RecordedChannel, simulated: Array) -> TraceRows:
    """The means of a trace over windows of the turn, whitened by their noise.

    Windows are of equal length along the simulated trace (K,), half of it angle and half of it pressure: wide
    at constant pressure, narrow on flanks; one without a sample drops out. The noise is that of single readings,
    or the common scatter of the cycles (`shrunk_covariance`), and h/sqrt(12) times the steepness, constant over a
    window, for an angle known to its step h.
    """
    marks = windows(simulated)
    means = np.stack([marks == mark for mark in np.unique(marks)]).astype(float)
    means /= means.sum(axis=1, keepdims=True)
    single = np.hypot(reading_sigma(channel, block.mean), channel.quantum / np.sqrt(12.0))
    covariance = (means * single**2 / block.cycles) @ means.T
    if block.covariance_factor is not None:
        covariance = shrunk_covariance(means @ block.covariance_factor, np.sqrt(np.diag(covariance)))
    rise = 0.5 * (np.roll(simulated, -1) - np.roll(simulated, 1)) / np.sqrt(12.0)
    covariance += np.diag((means @ np.abs(rise)) ** 2)
    return TraceRows(block, np.linalg.solve(np.linalg.cholesky(covariance), means))


def windows(simulated: Array) -> NDArray[np.int64]:
    """The window (K,), 0 to WINDOWS - 1, of each sample of a turn taken at even angles."""
    rise = np.abs(np.roll(simulated, -1) - simulated)
    length = 1.0 / len(simulated) + rise / max(float(rise.sum()), np.finfo(float).tiny)
    along = np.cumsum(length) - 0.5 * length
    return np.minimum((0.5 * WINDOWS * along).astype(np.int64), WINDOWS - 1)


def shrunk_covariance(factor: Array, least: Array) -> Array:
    """Covariance (F, F) of a mean by its factor (F, c), c deviations of single cycles over sqrt(c (c - 1)).

    Correlations of few cycles are shrunk towards zero by their own share of noise (Ledoit and Wolf 2004); a number on
    which the cycles agree to less than `least` (F,) has this scatter.
    """
    cycles = factor.shape[1]
    scatter = np.maximum(np.sqrt((factor**2).sum(axis=1)), least)
    each = factor * np.sqrt(cycles) / scatter[:, None]
    found = each @ each.T / cycles
    target = np.diag(np.diag(found))
    spread = ((each**2 @ (each**2).T) / cycles - found**2) / cycles
    np.fill_diagonal(spread, 0.0)
    apart = ((found - target) ** 2).sum()
    share = min(1.0, float(spread.sum() / apart)) if apart > 0.0 else 1.0
    shrunk = share * target + (1.0 - share) * found
    np.fill_diagonal(shrunk, 1.0)
    return np.asarray(scatter[:, None] * shrunk * scatter)
