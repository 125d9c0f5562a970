"""Shaft angles at which a chamber pressure stands out."""

from __future__ import annotations

from math import degrees, radians

import numpy as np
import pytest
from scipy.signal import lfilter

from diagnosis import TraceBlock, load_thresholds
from diagnosis.detect.angle_scan import AngleWindow, scan_angles
from diagnosis.study.model import PortEvent, TraceMisfit

STEPS = 360
ANGLE = np.arange(STEPS) * 2 * np.pi / STEPS
SIGMA = 4e4  # Pa
LIMITS = load_thresholds().locate
EVENTS = (PortEvent(radians(181.0), "delivery groove begins"), PortEvent(radians(220.0), "delivery kidney is open"))


def _trace(bump: float, seed: int, cycles: int = 0, memory: float = 0.6, scale: float = 1.0) -> TraceMisfit:
    """A turn of noise with memory, a bump of `bump` sigma from 180 to 190 degrees, an encoder offset taken out."""
    random = np.random.default_rng([53, seed])
    count = max(cycles, 1)
    fresh = random.standard_normal((STEPS + 50, count)) * np.sqrt(1 - memory**2)
    noise = scale * SIGMA * lfilter([1.0], [1.0, -memory], fresh, axis=0)[50:] * np.sqrt(count)
    factor = (noise - noise.mean(axis=1, keepdims=True)) / np.sqrt(count * (count - 1)) if cycles else None
    slope = np.gradient(1.5e7 * np.tanh((ANGLE - radians(200)) / radians(5)), ANGLE)[:, None] * radians(0.3)
    within = (radians(180) <= ANGLE) & (radians(190) > ANGLE)
    residual = noise.mean(axis=1) + bump * SIGMA * within + 1.5 * slope[:, 0]
    block = TraceBlock(0, ANGLE, residual, factor, count)
    return TraceMisfit(block, residual, slope, np.full(STEPS, SIGMA))


def _scan(*traces: TraceMisfit) -> AngleWindow | None:
    return scan_angles(traces, EVENTS, LIMITS, 1)


@pytest.mark.parametrize("cycles", [0, 40])
def test_a_bump_is_found_to_four_degrees(cycles: int) -> None:
    found = _scan(_trace(4.0, 1, cycles), _trace(0.0, 2, cycles))
    assert found is not None
    assert abs(degrees(found.start) - 180.0) <= 4.0
    assert abs(degrees(found.end) - 189.0) <= 4.0
    assert found.events == ("delivery groove begins",)
    assert found.p_value <= LIMITS.p_value


def test_noise_with_memory_stands_out_nowhere() -> None:
    """30 turns without a bump, an encoder off by 1.5 sigma: 1 % falsely, so no more than 3 of them."""
    assert sum(_scan(_trace(0.0, seed)) is not None for seed in range(30)) <= 3


@pytest.mark.parametrize("cycles", [3, 8, 20, 100])
def test_noise_of_few_or_many_cycles_stands_out_nowhere(cycles: int) -> None:
    assert sum(_scan(_trace(0.0, seed, cycles, memory)) is not None for seed in range(10) for memory in (0.0, 0.6)) <= 2


def test_a_bump_is_found_among_many_traces() -> None:
    """As many traces as a map has points do not exhaust the draws."""
    found = _scan(*(_trace(6.0 if number == 9 else 0.0, number, 40) for number in range(16)))
    assert found is not None
    assert abs(degrees(found.start) - 180.0) <= 4.0


def test_a_trace_that_scatters_all_over_stands_out_nowhere() -> None:
    """Noise three times as strong as stated is no window: only what stands out of the rest of the turn is."""
    assert sum(_scan(_trace(0.0, seed, scale=3.0)) is not None for seed in range(10)) <= 2


def test_a_window_may_hold_the_dead_centre() -> None:
    trace = _trace(0.0, 3)
    turned = trace.residual + 5 * SIGMA * ((radians(355) <= ANGLE) | (radians(6) > ANGLE))
    found = _scan(TraceMisfit(trace.block, turned, trace.nuisances, trace.sigma))
    assert found is not None
    assert found.end < found.start
    assert degrees(found.start) == pytest.approx(355.0, abs=4.0)


def test_nothing_recorded_nothing_found() -> None:
    assert _scan() is None
