"""Steady stretches of a time series: the rule of steady windows, with correlated noise."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from diagnosis.recording.series.stretches import Mask, bridged
from reynolds.numerics.arrays import Array

LONGEST_MEMORY = 0.99  # lag-one correlation beyond which a window counts as one sample
PARTS = 10
LEAST_PARTS = 4  # one more than the shapes that are fitted to their means
ROUNDING = 1e-12
MOST_MEMORY = 0.9  # resolution of a tenth of a window
BLOCK = 1_000_000
"""Samples of the windows that are judged at once."""
LOST = 0.05
"""Of a window, the largest share of samples without a reading; one sample in any case."""


@dataclass(frozen=True)
class SteadyRule:
    """A window of `samples` is steady if neither slope nor bow nor any tenth of it is significant.

    Each is insignificant within noise: below `limit` standard errors (a tenth, one of ten, below one more), with
    the correlation of the noise. Or harmless: its change over the window is below one sigma of repeatability.
    """

    samples: int
    limit: float


@dataclass(frozen=True)
class Repeatability:
    """One sigma of M inputs, sigma + relative |reading|: (M,) each, 0 where unknown."""

    sigma: Array
    relative: Array


def steady_stretches(inputs: Array, noise: Repeatability, rule: SteadyRule) -> tuple[slice, ...]:
    """Return the stretches of a series (T, M) that are steady in every input, longest possible, in order.

    Windows of rule.samples slide by a tenth; a stretch is the union of overlapping steady windows. One that drifts as a
    whole is halved until its parts are steady, down to single windows. Within a window an input may lack a reading at
    a share `LOST` of the samples, or at one.
    """
    length = rule.samples
    if length < 8 or len(inputs) < length:
        return ()
    inputs = np.stack([bridged(column, _few_are_lost(column, length)) for column in inputs.T], axis=1)
    step = max(1, length // 10)
    windows = sliding_window_view(inputs, length, axis=0)[::step]
    block = max(1, BLOCK // length)
    steady = np.concatenate([are_steady(windows[k : k + block], noise, rule) for k in range(0, len(windows), block)])
    runs = _joined(_runs((step * np.flatnonzero(steady)).tolist(), step, length), inputs, noise, rule)
    return tuple(part for run in runs for part in _pieces(run, inputs, noise, rule))


def _few_are_lost(column: Array, length: int) -> Mask:
    """True (T,) for each reading of (T,) about which few of `length` samples lack one (`LOST`)."""
    lost = np.concatenate([[0], np.cumsum(~np.isfinite(column))])
    first = np.clip(np.arange(len(column)) - length // 2, 0, len(column) - length)
    return np.asarray(lost[first + length] - lost[first] <= max(LOST * length, 1.0))


def is_steady(window: Array, noise: Repeatability, rule: SteadyRule) -> bool:
    """True where no column of one window (T, M) moves significantly (`are_steady`)."""
    return bool(are_steady(window.T[None], noise, rule)[0])


def are_steady(windows: Array, noise: Repeatability, rule: SteadyRule) -> NDArray[np.bool_]:
    """True (W,) for each window of (W, M, T) without gaps in which no input moves significantly (`SteadyRule`).

    From the means of ten parts: slope and bow are the coefficients of the Legendre polynomials P1 and P2, by least
    squares; the noise is that within the parts, without movement between them.
    """
    steady = np.all(np.isfinite(windows), axis=(1, 2))
    samples = windows.shape[-1]
    borders = np.linspace(0, samples, min(PARTS, max(LEAST_PARTS, samples // 4)) + 1).astype(np.int64)
    middle = (borders[1:] + borders[:-1]) / samples - 1.0
    shapes = np.stack([np.ones_like(middle), middle, 1.5 * middle**2 - 0.5], axis=1)
    by_means, widths = np.linalg.pinv(shapes), np.sqrt(np.diag(np.linalg.inv(shapes.T @ shapes)))
    for at, (sigma, relative) in enumerate(zip(noise.sigma, noise.relative, strict=True)):
        left = np.flatnonzero(steady)
        columns = windows[left, at]
        harmless = sigma + relative * np.abs(columns.mean(axis=1))
        steady[left] = ~_moves(columns, borders, (by_means, widths), harmless, rule.limit)
    return steady


def _moves(
    columns: Array, borders: NDArray[np.int64], line: tuple[Array, Array], sigma: Array, limit: float
) -> NDArray[np.bool_]:
    """True (W,) for each window of (W, T) in which one input moves significantly.

    line: slope and bow by the means of the parts (3, P), and their standard errors by that of a mean (3,); sigma: (W,),
    changes below it are harmless.
    """
    means, error = _parts(columns, borders)
    rounded = ROUNDING * np.max(np.abs(columns), axis=1, initial=0.0)  # a commanded value has no noise at all
    harmless = np.maximum(sigma, rounded)
    size = np.abs(means @ line[0].T)
    moves = np.zeros(len(columns), dtype=bool)
    for at, change in ((1, 2.0), (2, 1.5)):
        moves |= (change * size[:, at] > harmless) & (size[:, at] > limit * error * line[1][at])
    farthest = np.max(np.abs(means - np.median(means, axis=1, keepdims=True)), axis=1, initial=0.0)
    return np.asarray(moves | (farthest > np.maximum(harmless, (limit + 1.0) * error)))


def _parts(columns: Array, borders: NDArray[np.int64]) -> tuple[Array, Array]:
    """Means (W, P) of the parts of windows (W, T); their standard errors (W,) by the scatter within, noise AR(1)."""
    counts = np.diff(borders)
    means = np.add.reduceat(columns, borders[:-1], axis=1) / counts
    inner = columns - np.repeat(means, counts, axis=1)
    powers = np.add.reduceat(inner**2, borders[:-1], axis=1)
    follows = np.zeros_like(inner)
    follows[:, :-1] = inner[:, 1:] * inner[:, :-1]
    follows[:, borders[1:] - 1] = 0.0
    size = float(np.mean(counts))
    shares = np.divide(
        np.add.reduceat(follows, borders[:-1], axis=1), powers, out=np.full_like(powers, np.nan), where=powers > 0.0
    )
    scatters = np.any(powers > 0.0, axis=1)
    measured = np.zeros(len(columns))
    measured[scatters] = np.nanmedian(shares[scatters], axis=1)
    memory = np.clip((measured * size + 1.0) / (size - 3.0), 0.0, MOST_MEMORY) if size > 4.0 else measured.clip(0.0)
    spread = (1.0 + memory) / (1.0 - memory) / size  # variance of a part's mean over that of a sample
    variance = np.median(powers, axis=1) / (size - 1.0) / np.maximum(1.0 - spread, 0.3)
    return means, np.where(scatters, np.sqrt(variance * spread), 0.0)


def effective_number(noise: Array) -> float:
    """Return the number of independent samples of a stretch of noise: T (1 - r)/(1 + r), from 1 to T.

    r is the lag-one correlation (noise of first order, AR(1)), not below zero; constant noise counts in full.
    """
    deviation = noise - np.mean(noise)
    power = float(deviation @ deviation)
    if power <= (ROUNDING * float(np.max(np.abs(noise)))) ** 2 * len(noise):
        return float(len(noise))
    memory = float(deviation[1:] @ deviation[:-1]) / power
    if memory >= LONGEST_MEMORY:
        return 1.0
    return max(1.0, len(noise) * (1.0 - max(memory, 0.0)) / (1.0 + max(memory, 0.0)))


def _runs(starts: Sequence[int], step: int, length: int) -> Iterator[slice]:
    """Stretches covered by windows that follow each other without a missing one."""
    first = last = None
    for start in starts:
        if first is None or last is None:
            first = start
        elif start - last > step:
            yield slice(first, last + length)
            first = start
        last = start
    if first is not None and last is not None:
        yield slice(first, last + length)


def _joined(runs: Iterator[slice], inputs: Array, noise: Repeatability, rule: SteadyRule) -> Iterator[slice]:
    """Runs that overlap as one where that is steady as a whole (a window failed by chance), else cut."""
    last: slice | None = None
    for run in runs:
        if last is not None and run.start < last.stop:
            whole = slice(last.start, run.stop)
            if is_steady(inputs[whole], noise, rule):
                last = whole
                continue
            run = slice(last.stop, run.stop)
            if run.stop - run.start < rule.samples:
                continue
        if last is not None:
            yield last
        last = run
    if last is not None:
        yield last


def _pieces(run: slice, inputs: Array, noise: Repeatability, rule: SteadyRule) -> Iterator[slice]:
    """A run, or its halves where it is not steady as a whole; of a short one its first steady window."""
    length = run.stop - run.start
    if is_steady(inputs[run], noise, rule):
        yield run
        return
    if length < 2 * rule.samples:
        windows = (slice(run.start + k, run.start + k + rule.samples) for k in range(length - rule.samples + 1))
        yield from islice((one for one in windows if is_steady(inputs[one], noise, rule)), 1)
        return
    middle = run.start + length // 2
    yield from _pieces(slice(run.start, middle), inputs, noise, rule)
    yield from _pieces(slice(middle, run.stop), inputs, noise, rule)
