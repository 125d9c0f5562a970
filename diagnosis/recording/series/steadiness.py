"""Steady stretches of a time series: the rule of steady windows, with correlated noise."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array

LONGEST_MEMORY = 0.99  # lag-one correlation beyond which a window counts as one sample
PARTS = 10
LEAST_PARTS = 4  # one more than the shapes that are fitted to their means
ROUNDING = 1e-12
MOST_MEMORY = 0.9  # that a tenth of a window can show


@dataclass(frozen=True)
class SteadyRule:
    """A window of `samples` is steady if neither slope nor bow nor any tenth of it is significant.

    Each is insignificant within noise: below `limit` standard errors (a tenth, one of ten, below one more), with
    the correlation of the noise. Or harmless: its change over the window is below one sigma of repeatability.
    """

    samples: int
    limit: float


def steady_stretches(inputs: Array, sigma: Array, rule: SteadyRule) -> tuple[slice, ...]:
    """Return the stretches of a series (T, M) that are steady in every input, longest possible, in order.

    Windows of rule.samples slide by a tenth; a stretch is the union of overlapping steady windows. One that drifts
    as a whole is halved until its parts are steady, down to single windows. sigma: (M,), 0 where none is known.
    """
    length = rule.samples
    if length < 8 or len(inputs) < length:
        return ()
    step = max(1, length // 10)
    starts = range(0, len(inputs) - length + 1, step)
    steady = [start for start in starts if is_steady(inputs[start : start + length], sigma, rule)]
    runs = _joined(_runs(steady, step, length), inputs, sigma, rule)
    return tuple(part for run in runs for part in _pieces(run, inputs, sigma, rule))


def is_steady(window: Array, sigma: Array, rule: SteadyRule) -> bool:
    """True where no column (T, M) of a window without gaps moves significantly (`SteadyRule`).

    From the means of ten parts: slope and bow are the coefficients of the Legendre polynomials P1 and P2, by least
    squares; the noise is that within the parts, without movement between them.
    """
    if not np.all(np.isfinite(window)):
        return False
    borders = np.linspace(0, len(window), min(PARTS, max(LEAST_PARTS, len(window) // 4)) + 1).astype(np.int64)
    middle = (borders[1:] + borders[:-1]) / len(window) - 1.0
    shapes = np.stack([np.ones_like(middle), middle, 1.5 * middle**2 - 0.5], axis=1)
    rounded = np.maximum(sigma, ROUNDING * np.max(np.abs(window), axis=0))  # a commanded value has no noise at all
    for column, harmless in zip(window.T, rounded, strict=True):
        means, error = _parts(column, borders)
        size, *_ = np.linalg.lstsq(shapes, means, rcond=None)
        errors = error * np.sqrt(np.diag(np.linalg.inv(shapes.T @ shapes)))
        for change, amplitude, one in zip((2.0, 1.5), size[1:], errors[1:], strict=True):
            if abs(change * amplitude) > harmless and abs(amplitude) > rule.limit * one:
                return False
        if np.max(np.abs(means - np.median(means))) > max(harmless, (rule.limit + 1.0) * error):
            return False
    return True


def _parts(column: Array, borders: NDArray[np.int64]) -> tuple[Array, float]:
    """Means of the parts between borders, and their standard error from the scatter within, noise being AR(1)."""
    counts = np.diff(borders)
    means = np.add.reduceat(column, borders[:-1]) / counts
    inner = column - np.repeat(means, counts)
    powers = np.add.reduceat(inner**2, borders[:-1])
    follows = np.append(inner[1:] * inner[:-1], 0.0)
    follows[borders[1:] - 1] = 0.0
    size = float(np.mean(counts))
    known = powers > 0.0
    if not known.any():
        return means, 0.0
    measured = float(np.median(np.add.reduceat(follows, borders[:-1])[known] / powers[known]))
    memory = min(max((measured * size + 1.0) / (size - 3.0), 0.0), MOST_MEMORY) if size > 4.0 else max(measured, 0.0)
    spread = (1.0 + memory) / (1.0 - memory) / size  # variance of a part's mean over that of a sample
    variance = float(np.median(powers)) / (size - 1.0) / max(1.0 - spread, 0.3)
    return means, float(np.sqrt(variance * spread))


def effective_number(noise: Array) -> float:
    """Return how many independent samples a stretch of noise is worth: T (1 - r)/(1 + r), from 1 to T.

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


def _joined(runs: Iterator[slice], inputs: Array, sigma: Array, rule: SteadyRule) -> Iterator[slice]:
    """Runs that overlap as one where that is steady as a whole (a window failed by chance), else cut."""
    last: slice | None = None
    for run in runs:
        if last is not None and run.start < last.stop:
            whole = slice(last.start, run.stop)
            if is_steady(inputs[whole], sigma, rule):
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


def _pieces(run: slice, inputs: Array, sigma: Array, rule: SteadyRule) -> Iterator[slice]:
    """A run, or its halves where it is not steady as a whole; of a short one its first steady window."""
    length = run.stop - run.start
    if is_steady(inputs[run], sigma, rule):
        yield run
        return
    if length < 2 * rule.samples:
        windows = (slice(run.start + k, run.start + k + rule.samples) for k in range(length - rule.samples + 1))
        yield from islice((one for one in windows if is_steady(inputs[one], sigma, rule)), 1)
        return
    middle = run.start + length // 2
    yield from _pieces(slice(run.start, middle), inputs, sigma, rule)
    yield from _pieces(slice(middle, run.stop), inputs, sigma, rule)
