"""Size of a concealed effect: its score z beside noise, tolerances and calibrations, by the plant alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np

from .campaigns import Campaign, campaigns
from .plant.bench import run
from .plant.hidden import NOTHING, Hidden
from .plant.machine import ABSOLUTE, NUISANCES, TOLERANCE, Array, Machine, ref90
from .plant.settings import Settings
from .sensors import METERS, Fault, stated_sigma

STEPS = 240  # of a turn: sizes need no more
SHARE = 0.5  # of the sealing length, and its spread
ROUNDS = 12
NEAR = 0.02  # of the requested z


def typical() -> Machine:
    """The machine as drawn, about which sizes are measured."""
    return replace(ref90(), stand_out_share=SHARE)


def shift(name: str, hidden: Hidden, faults: tuple[Fault, ...], machine: Machine) -> Array:
    """Shift of the readings of a campaign, (N, C) SI."""
    campaign = campaigns()[name]
    at = campaign.points
    for fault in faults:
        if fault.channel in campaign.inputs:
            at = at.moved(fault.channel, -fault.zero)
    found = run(machine, at, hidden, STEPS)
    columns = []
    for at_channel, channel in enumerate(campaign.outputs):
        value = getattr(found, channel)
        fault = next((one for one in faults if one.channel == channel), Fault(channel))
        along = np.linspace(0.0, 1.0, value.size)
        columns.append(value * (1.0 + fault.gain) + fault.zero + fault.drift * along - nominal(name)[:, at_channel])
    return np.stack(columns, axis=1)


def z_of(name: str, moved: Array) -> float:
    """sqrt(d^T (S + A A^T)^-1 d) of a shift d: its length in sigma beyond the part of the uncertain parameters."""
    return float(np.linalg.norm(white(name, moved)))


def white(name: str, moved: Array) -> Array:
    """A shift (N, C) in units of the total uncertainty, (N C,)."""
    weights, whitened = _whitening(name)
    return np.asarray(np.linalg.solve(whitened, weights * moved.ravel()))


def size_for(z: float, score: Callable[[float], float], start: float, most: float) -> tuple[float, float]:
    """A factor up to `most` at which `score(factor)` is z within NEAR, and its score; else the nearest."""
    low, high, factor = 0.0, np.inf, min(start, most)
    best = (factor, 0.0)
    for _ in range(ROUNDS):
        got = score(factor)
        if abs(got - z) < abs(best[1] - z):
            best = (factor, got)
        if abs(got - z) < NEAR * z:
            break
        low, high = (factor, high) if got < z else (low, factor)
        if low >= most:
            break
        guess = min(factor * z / max(got, 0.1 * z), most)
        factor = guess if low < guess < high else 0.5 * (low + high)
    return best


@cache
def nominal(name: str) -> Array:
    """Outputs (N, C) of a campaign with nothing concealed."""
    return _outputs(campaigns()[name], run(typical(), campaigns()[name].points, NOTHING, STEPS))


def repeatability(name: str) -> Array:
    """One sigma (N, C) of a campaign's outputs, SI."""
    outputs = campaigns()[name].outputs
    return np.stack([stated_sigma(METERS[one], nominal(name)[:, k]) for k, one in enumerate(outputs)], axis=1)


@cache
def _whitening(name: str) -> tuple[Array, Array]:
    """1/sigma (N C,), and the lower triangle L with L L^T = 1 + A A^T of the whitened nuisances A."""
    campaign = campaigns()[name]
    sigma = repeatability(name)
    shared, own = _nuisances(campaign), _inputs(campaign)
    weights = 1.0 / sigma.ravel()
    columns = weights[:, None] * shared
    covariance = np.eye(weights.size) + columns @ columns.T
    count, channels = sigma.shape
    for k in range(count):
        rows = slice(k * channels, (k + 1) * channels)
        local = weights[rows, None] * own[k]
        covariance[rows, rows] += local @ local.T
    return weights, np.asarray(np.linalg.cholesky(covariance), dtype=float)


def _nuisances(campaign: Campaign) -> Array:
    """One sigma of all that points share, (N C, k): the machine's parts and the sensors' calibrations."""
    machine, base = typical(), nominal(campaign.name)
    found = [(_moved(machine, part, campaign) - base).ravel() for part in NUISANCES]
    along = np.linspace(-0.5, 0.5, len(base))
    for k, channel in enumerate(campaign.outputs):
        meter = METERS[channel]
        for pattern in (meter.gain * base[:, k], np.full(len(base), meter.zero * meter.scale),
                        0.5 * meter.zero * meter.scale * along):  # fmt: skip
            column = np.zeros_like(base)
            column[:, k] = pattern
            found.append(column.ravel())
    for channel in ("p_out", "T_case", "ratio"):
        change = METERS[channel].zero * METERS[channel].scale
        found.append((_outputs_at(campaign, campaign.points.moved(channel, change)) - base).ravel())
    return np.stack(found, axis=1)


def _inputs(campaign: Campaign) -> Array:
    """One sigma of each input's own noise, (N, C, 6)."""
    base = nominal(campaign.name)
    moved = []
    for channel in ("speed", "p_out", "p_in", "p_case", "T_case"):
        change = METERS[channel].sigma * METERS[channel].scale
        moved.append(_outputs_at(campaign, campaign.points.moved(channel, change)) - base)
    return np.stack(moved, axis=2)


def _moved(machine: Machine, part: str, campaign: Campaign) -> Array:
    value = getattr(machine, part)
    change = value * TOLERANCE[part] if part in TOLERANCE else ABSOLUTE.get(part, SHARE)
    changed = value + change
    return _outputs(campaign, run(replace(machine, **{part: changed}), campaign.points, NOTHING, STEPS))


def _outputs_at(campaign: Campaign, at: Settings) -> Array:
    return _outputs(campaign, run(typical(), at, NOTHING, STEPS))


def _outputs(campaign: Campaign, truth: object) -> Array:
    return np.stack([getattr(truth, channel) for channel in campaign.outputs], axis=1)
