"""Where a time series stands still: the rule of steady windows, and noise that remembers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from system.kinematics import Array

Flags = NDArray[np.bool_]
LONGEST_MEMORY = 0.99  # lag-one correlation beyond which a window counts as one sample


@dataclass(frozen=True)
class SteadyRule:
    """Steady is a window of `samples` whose slope and bow are each within noise or within what is harmless.

    Within noise: below `limit` standard errors, counted with the noise's own memory. Harmless: what they change
    over the window stays below one sigma of repeatability of the channel.
    """

    samples: int
    limit: float


def steady_stretches(inputs: Array, sigma: Array, rule: SteadyRule) -> tuple[slice, ...]:
    """Return the stretches of a series (T, M) that are steady in every input, longest possible, in order.

    Windows of rule.samples slide by a tenth; a stretch is what overlapping steady windows cover. One that drifts
    as a whole is halved until its parts are steady, down to single windows. sigma: (M,), 0 where none is known.
    """
    length = rule.samples
    if length < 8 or len(inputs) < length:
        return ()
    step = max(1, length // 10)
    starts = range(0, len(inputs) - length + 1, step)
    steady = [start for start in starts if is_steady(inputs[start : start + length], sigma, rule)]
    return tuple(part for run in _runs(steady, step, length) for part in _pieces(run, inputs, sigma, rule))


def is_steady(window: Array, sigma: Array, rule: SteadyRule) -> bool:
    """True where no column (T, M) of a window without gaps has a slope or a bow that counts (`SteadyRule`).

    Slope and bow are the coefficients of the Legendre polynomials P1 and P2 over the window, fitted by least
    squares; their standard errors carry the factor (1 + r)/(1 - r) of noise with lag-one correlation r.
    """
    if not np.all(np.isfinite(window)):
        return False
    place = np.linspace(-1.0, 1.0, len(window))
    shapes = np.stack([np.ones_like(place), place, 1.5 * place**2 - 0.5], axis=1)
    size, *_ = np.linalg.lstsq(shapes, window, rcond=None)
    noise = window - shapes @ size
    for column, (slope, bow) in enumerate(size[1:].T):
        variance = (
            np.sum(noise[:, column] ** 2) / (len(window) - 3) * len(window) / effective_number(noise[:, column])
        )
        for change, amplitude, norm in ((2.0 * slope, slope, shapes[:, 1]), (1.5 * bow, bow, shapes[:, 2])):
            error = np.sqrt(variance / np.sum(norm**2))
            if abs(change) > sigma[column] and abs(amplitude) > rule.limit * error:
                return False
    return True


def effective_number(noise: Array) -> float:
    """Return how many independent samples a stretch of noise is worth: T (1 - r)/(1 + r), from 1 to T.

    r is the lag-one correlation (noise of first order, AR(1)), not below zero; constant noise counts in full.
    """
    deviation = noise - np.mean(noise)
    power = float(deviation @ deviation)
    if power == 0.0:
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


def _pieces(run: slice, inputs: Array, sigma: Array, rule: SteadyRule) -> Iterator[slice]:
    """A run, or its halves where it is not steady as a whole."""
    length = run.stop - run.start
    if length < 2 * rule.samples or is_steady(inputs[run], sigma, rule):
        yield run
        return
    middle = run.start + length // 2
    yield from _pieces(slice(run.start, middle), inputs, sigma, rule)
    yield from _pieces(slice(middle, run.stop), inputs, sigma, rule)
