"""Courses: stairs, ramps, triangles and sweeps of pressure at one speed or some, while the oil warms."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from .model import State
from .pump import Array, Pump

KINDS = ("stairs", "ramps", "triangles", "sweep", "speeds")
LOWEST = 2.0e6  # Pa
HOUSING, BODY = 120.0, 400.0  # s by which case and body follow
SPEEDS = (1.0, 0.75, 0.5)  # of the plate's, block by block


@dataclass(frozen=True)
class Course:
    """State at samples of one second and the rate of the delivery pressure (Pa/s), (T,)."""

    state: State
    rate: Array


def course(pump: Pump, kind: str, rng: np.random.Generator) -> Course:
    """4,000 to 8,000 s; the oil warms from 15..25 by 20..35 K, ever more slowly."""
    count = int(rng.integers(4000, 8001))
    time = np.arange(count, dtype=float)
    top = float(rng.uniform(20.0e6, 32.0e6))
    shape = _stairs(time, rng) if kind == "stairs" else _moving(time, kind, rng)
    pressure = LOWEST + (top - LOWEST) * shape + _slow(count, 2e4, 30.0, rng)
    speed = pump.speed * (_blocks(count) if kind == "speeds" else np.ones(count))
    speed = speed * (1.0 + _slow(count, 5e-4, 20.0, rng))
    warm = rng.uniform(20.0, 35.0) * -np.expm1(-time / rng.uniform(0.3, 0.8) / count)
    inlet = rng.uniform(15.0, 25.0) + warm + _slow(count, 0.15, 60.0, rng)
    losses = 2.0 + rng.uniform(2.0, 6.0) * pressure / 30.0e6 * speed / pump.speed
    case = _follow(inlet + losses, HOUSING)
    body = _follow(0.5 * (inlet + case), BODY)
    p_case = rng.uniform(0.1e5, 0.5e5) + _slow(count, 300.0, 60.0, rng)
    return Course(State(speed, pressure, p_case, inlet, case, body), np.gradient(pressure))


def _stairs(time: Array, rng: np.random.Generator) -> Array:
    """Up and down in 6 to 10 steps of 40 to 120 s, a few seconds from one to the next."""
    steps, hold = int(rng.integers(6, 11)), float(rng.uniform(40.0, 120.0))
    at = (time // hold).astype(int) % (2 * steps - 2)
    return np.asarray(_follow(np.where(at < steps, at, 2 * steps - 2 - at) / (steps - 1.0), 3.0))


def _moving(time: Array, kind: str, rng: np.random.Generator) -> Array:
    """Saw teeth, triangles, or a sine that grows faster, of 150 to 600 s; 0 to 1."""
    period = float(rng.uniform(150.0, 600.0))
    past = time / period
    if kind == "ramps":
        share = float(rng.uniform(0.8, 0.95))
        within = past % 1.0
        return np.asarray(np.where(within < share, within / share, (1.0 - within) / (1.0 - share)))
    if kind == "sweep":
        return np.asarray(0.5 - 0.5 * np.cos(2.0 * np.pi * past * (1.0 + time / time[-1])))
    return np.asarray(1.0 - np.abs(2.0 * (past % 1.0) - 1.0))


def _blocks(count: int) -> Array:
    """Speeds in nine blocks, a motor that runs up in some 5 s."""
    block = np.minimum(np.arange(count) * 9 // count, 8)
    return _follow(np.asarray(SPEEDS)[block % len(SPEEDS)], 5.0)


def _follow(values: Array, lag: float) -> Array:
    """Behind a first-order lag of some samples, at rest before the first."""
    left = float(np.exp(-1.0 / lag))
    return np.asarray(lfilter([1.0 - left], [1.0, -left], values, zi=[left * values[0]])[0])


def _slow(count: int, sigma: float, memory: float, rng: np.random.Generator) -> Array:
    """Drifting noise of a bench: first order, in samples."""
    left = float(np.exp(-1.0 / memory))
    fresh = sigma * np.sqrt(1.0 - left**2) * rng.normal(size=count)
    return np.asarray(lfilter([1.0], [1.0, -left], fresh))
