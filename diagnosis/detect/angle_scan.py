"""Shaft angles at which a recorded chamber pressure differs from the simulated one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.signal import lfilter

from diagnosis.study.model import PortEvent, TraceMisfit
from diagnosis.thresholds import LocateLimits
from reynolds.numerics.arrays import Array
from system.inputs.units import TURN

SIGMA_OF_MEDIAN = 1.4826  # of a normal distribution, over its median deviation
SETTLING = 100  # samples of drawn noise discarded
FEWEST_FLIPPED = 12  # cycles: fewer have too few flips for a p of 0.01 among many windows
USUAL = 0.95  # of the draws: the level of a trace's windows


@dataclass(frozen=True)
class AngleWindow:
    """Shaft angles in rad from start to end where a trace deviates significantly, and the events of the ports within.

    end < start where the window holds the inner dead centre.
    """

    start: float
    end: float
    p_value: float
    events: tuple[str, ...]


def scan_angles(
    traces: Sequence[TraceMisfit], events: Sequence[PortEvent], limits: LocateLimits, seed: int
) -> AngleWindow | None:
    """The window of shaft angle of greatest significance among all traces, or None above the threshold of p.

    Traces have equal steps of angle over one turn. p is that of the greatest of all windows and all traces in drawn
    noise (Westfall and Young 1993), each trace's windows over the level that its noise exceeds in one of twenty draws.
    """
    found = [_scan(trace, limits, seed + number) for number, trace in enumerate(traces)]
    if not found:
        return None
    best = max(found, key=lambda one: one.greatest)
    chance = np.max([one.chance for one in found], axis=0)
    p_value = float((1 + np.count_nonzero(chance >= best.greatest)) / (limits.draws + 1))
    if p_value > limits.p_value:
        return None
    margin = limits.windows[0]
    width = (best.end - best.start) % TURN
    within = tuple(event.text for event in events if (event.angle - best.start + margin) % TURN <= width + 2 * margin)
    return AngleWindow(best.start, best.end, p_value, within)


@dataclass(frozen=True)
class _Scanned:
    """The most significant window of a trace, rad, its statistic, and the greatest one of each draw (draws,)."""

    start: float
    end: float
    greatest: float
    chance: Array


def _scan(trace: TraceMisfit, limits: LocateLimits, seed: int) -> _Scanned:
    """The window of one trace with the most significant mean: 2 to 60 degrees, each sqrt 2 wider than the last."""
    steps = len(trace.residual)
    residual = _without_nuisances(trace, trace.residual[:, None] / trace.sigma[:, None])
    widths = _widths(steps, limits)
    noise, cycles = _noise(trace, residual[:, 0], limits, seed)
    spread = np.stack([np.sqrt((_window_sums(cycles, width) ** 2).mean(axis=1, keepdims=True)) for width in widths])
    chance = np.max(
        [np.abs(_window_sums(noise, w) / own).max(axis=0) for w, own in zip(widths, spread, strict=True)], 0
    )
    observed = np.abs(np.stack([_window_sums(residual, width) for width in widths]) / spread)[..., 0]
    which, first = np.unravel_index(int(observed.argmax()), observed.shape)
    level, start = float(np.quantile(chance, USUAL)), float(trace.block.angle[first])
    end = (start + (int(widths[which]) - 1) * TURN / steps) % TURN
    return _Scanned(start, end, float(observed.max()) / level, chance / level)


def _noise(trace: TraceMisfit, residual: Array, limits: LocateLimits, seed: int) -> tuple[Array, Array]:
    """Drawn means (K, draws), whitened, without nuisances, and the columns (K, n) whose windows give their spread.

    Of enough cycles: their sign flips, means included, so that the test is exact for noise of even sign; a window's
    spread about zero is then that of every draw. Else noise like the trace's, and its draws themselves.
    """
    random = np.random.default_rng(seed)
    factor = trace.block.covariance_factor
    if factor is not None and factor.shape[1] >= FEWEST_FLIPPED:
        count = factor.shape[1]
        deviations = _without_nuisances(trace, factor / trace.sigma[:, None]) * np.sqrt(count * (count - 1.0))
        cycles = residual[:, None] + deviations
        return cycles @ random.choice([-1.0, 1.0], size=(count, limits.draws)) / count, cycles
    memory, scale = _memory(residual, limits)
    fresh = random.standard_normal((len(residual) + SETTLING, limits.draws)) * np.sqrt(1.0 - memory**2)
    drawn = _without_nuisances(trace, scale * lfilter([1.0], [1.0, -memory], fresh, axis=0)[SETTLING:])
    return drawn, drawn


def _memory(residual: Array, limits: LocateLimits) -> tuple[float, float]:
    """Lag-1 correlation and scale of a trace's noise (Yule 1927), outside its most striking window.

    The scale is at least one stated sigma, and more if the whole trace scatters by more: then only a window that
    exceeds the scatter of the rest of the turn counts.
    """
    sums = [_window_sums(residual[:, None], width)[:, 0] / np.sqrt(width) for width in _widths(len(residual), limits)]
    which, first = np.unravel_index(int(np.abs(np.stack(sums)).argmax()), (len(sums), len(residual)))
    rest = np.roll(residual, -int(first))[int(_widths(len(residual), limits)[which]) :]
    centred = rest - np.median(rest)
    scale = SIGMA_OF_MEDIAN * float(np.median(np.abs(centred)))
    memory = float(centred[1:] @ centred[:-1] / (centred @ centred)) if scale > 0 else 0.0
    return min(max(memory, 0.0), limits.trace_memory), max(scale, 1.0)


def _without_nuisances(trace: TraceMisfit, whitened: Array) -> Array:
    """Whitened columns (K, m) less the part that parameters, each of prior N(0, 1), explain."""
    columns = trace.nuisances / trace.sigma[:, None]
    factor = cho_factor(columns.T @ columns + np.eye(columns.shape[1]))
    left: Array = whitened - columns @ cho_solve(factor, columns.T @ whitened)
    return left


def _widths(steps: int, limits: LocateLimits) -> NDArray[np.int64]:
    """Widths of the windows, in samples."""
    narrowest, widest = (max(round(width / TURN * steps), 1) for width in limits.windows)
    count = 1 + int(2.0 * np.log2(max(widest / narrowest, 1.0)))
    return np.unique(np.round(narrowest * np.sqrt(2.0) ** np.arange(count)).astype(np.int64))


def _window_sums(columns: Array, width: int) -> Array:
    """Sums (K, m) over the `width` samples from each sample on, around the turn."""
    around = np.concatenate([np.zeros((1, columns.shape[1])), columns, columns[: width - 1]])
    total = np.cumsum(around, axis=0)
    sums: Array = total[width:] - total[:-width]
    return sums
