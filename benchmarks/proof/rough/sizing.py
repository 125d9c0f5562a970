"""Score of the concealed causes in a rough recording: the plant's own model fitted to its own quasi-steady means.

Samples of similar pressure, speed and time are one mean; its noise has the memory of its meter. Uncertain are all
unknowns of a pump with a type plate, and the errors of meters of such a bench.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..wide.case import Secret, What, WideCase
from ..wide.scoring import Whitening, sizes, whitening
from .plant.course import Course
from .plant.hidden import NOTHING, Hidden
from .plant.meters import WANDER, Meters
from .plant.model import State, flows
from .plant.pump import MAKE, UNCERTAIN, Array, Pump

PARTS = 10  # of the pressure's range, and of the time
GAIN, ZERO = 0.003, 0.003  # one sigma of a meter: relative, and over its median
P_OUT, T_CASE = 1e4, 0.5  # Pa, K: the same of the zeros of inputs
WARMTH, BETWEEN = 3.0, 0.5  # K at 20 MPa by which films are warmer, share of the inlet in their oil: one sigma
OF_PORTS = 0.05  # of the drain: leakage while ports change that delivery does not lack
UNREAD = 1e3  # times its noise: sigma of a mean within a dead band
NAMES = ("Q_out", "Q_case", "torque")


@dataclass(frozen=True)
class Bench:
    """A pump on its bench with a course and meters; outputs: those that are measured."""

    pump: Pump
    course: Course
    meters: Meters

    @property
    def outputs(self) -> tuple[str, ...]:
        """Measured outputs in the order of NAMES."""
        return tuple(name for name in NAMES if name in self.meters)

    def means(self, pump: Pump, state: State, hidden: Hidden = NOTHING) -> Array:
        """Quasi-steady means (N, C), SI, of a pump at samples of the bench's course."""
        found = flows(pump, state, hidden)
        place, count = self.places
        return np.stack([np.bincount(place, getattr(found, name)) / count for name in self.outputs], axis=1)

    @property
    def places(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Number (T,) of the mean to which a sample belongs, and samples (N,) of each."""
        state, time = self.course.state, np.arange(self.course.rate.size)
        low, high = state.pressure.min(), state.pressure.max()
        keys = np.minimum((state.pressure - low) / (high - low) * PARTS, PARTS - 1).astype(int)
        keys = keys + PARTS * (time * PARTS // time.size)
        keys = keys + PARTS**2 * np.round(10.0 * state.speed / state.speed.max()).astype(int)
        _, place = np.unique(keys, return_inverse=True)
        return place, np.bincount(place)


def concealed(bench: Bench, secrets: Sequence[Secret], factors: Sequence[float]) -> tuple[Hidden, Meters]:
    """Effects hidden in the pump, and meters with their faults."""
    hidden, meters = NOTHING, dict(bench.meters)
    nominal = flows(bench.pump, bench.course.state)
    for one, factor in zip(secrets, factors, strict=True):
        size = factor * one.size
        if one.what is What.EFFECT:
            hidden = replace(hidden, **{one.label: size})
            continue
        channel, error = one.label.split(".")
        relative = channel in NAMES and error != "gain"
        scale = float(np.median(getattr(nominal, channel))) if relative else 1.0
        meter = meters[channel]
        meters[channel] = replace(meter, **{error: getattr(meter, error) + size * scale})
    return hidden, meters


def sized(case: WideCase, bench: Bench) -> tuple[list[float], list[float], dict[str, float]]:
    """Factors of the requested score beside the others, scores reached, each channel's square of the shift in sigma."""
    sigma = noise(bench)
    white = whitening_of(bench, sigma)

    def shifted(k: int, factor: float) -> Array:
        return white_shift(bench, white, case.secrets[k], factor)

    factors, scores = sizes(case.score, shifted, [one.most for one in case.secrets])
    moved = _shift(bench, case.secrets, factors) / sigma
    strength = dict(zip(bench.outputs, (moved**2).sum(axis=0), strict=True))
    return factors, scores, {name: float(one) for name, one in strength.items()}


def white_shift(bench: Bench, white: Whitening, one: Secret, factor: float) -> Array:
    """Shift of the means by one secret, in units of the total uncertainty, (N C,)."""
    return white.white(_shift(bench, (one,), (factor,)))


def _shift(bench: Bench, secrets: Sequence[Secret], factors: Sequence[float]) -> Array:
    """Shift (N, C) of the means."""
    hidden, meters = concealed(bench, secrets, factors)
    state = bench.course.state
    off = {name: meters[name].zero - bench.meters[name].zero for name in ("p_out", "T_case")}
    there = replace(state, pressure=state.pressure - off["p_out"], case=state.case - off["T_case"])
    place, count = bench.places
    found, nominal = bench.means(bench.pump, there, hidden), bench.means(bench.pump, state)
    along = np.bincount(place, np.linspace(0.0, 1.0, place.size)) / count
    for k, name in enumerate(bench.outputs):
        own, sound = meters[name], bench.meters[name]
        found[:, k] += (own.gain - sound.gain) * nominal[:, k]
        found[:, k] += own.zero - sound.zero + (own.drift - sound.drift) * along
    return np.asarray(found - nominal)


def noise(bench: Bench) -> Array:
    """Noise (N, C) of the means; that of readings in a dead band is infinite."""
    _, count = bench.places
    nominal = bench.means(bench.pump, bench.course.state)
    columns = []
    for k, name in enumerate(bench.outputs):
        meter = bench.meters[name]
        left = np.exp(-1.0 / meter.memory)
        worth = np.maximum(count * (1.0 - left) / (1.0 + left), 1.0)
        slow = max(bench.course.rate.size / PARTS / (2.0 * max(meter.slow, 1.0)), 1.0)
        own = meter.noise * np.sqrt(1.0 / worth + WANDER**2 / slow)
        unread = nominal[:, k] < meter.band + 2.0 * meter.noise
        columns.append(own * np.where(unread, UNREAD, 1.0))
    return np.stack(columns, axis=1)


def whitening_of(bench: Bench, sigma: Array) -> Whitening:
    """Of means with noise sigma (N, C), beside the uncertainty of pump and meters."""
    pump, state = bench.pump, bench.course.state
    base = bench.means(pump, state)
    near = [replace(pump, **{name: getattr(pump, name) * (1.0 + 0.01 * s)}) for name, s in UNCERTAIN.items()]
    shared = [100.0 * (bench.means(one, state) - base) for one in near]
    makes = [replace(pump, **{name: getattr(pump, name) + sigma}) for name, sigma in MAKE.items()]
    shared += [bench.means(one, state) - base for one in makes]
    shared.append(bench.means(pump, replace(state, pressure=state.pressure + P_OUT)) - base)
    shared.append(bench.means(pump, replace(state, case=state.case + T_CASE)) - base)
    shared.append(bench.means(pump, state, replace(NOTHING, heating=WARMTH)) - base)
    shared.append(bench.means(pump, replace(state, case=state.case + BETWEEN * (state.inlet - state.case))) - base)
    shared.append(base * [OF_PORTS * (name == "Q_case") for name in bench.outputs])
    place, count = bench.places
    along = np.bincount(place, np.linspace(-0.5, 0.5, place.size)) / count
    for k in range(len(bench.outputs)):
        zero = ZERO * float(np.median(base[:, k]))
        for pattern in (GAIN * base[:, k], np.full(len(base), zero), zero * along):
            column = np.zeros_like(base)
            column[:, k] = pattern
            shared.append(column)
    return whitening(sigma, np.stack(shared))
