"""Meters of a rough bench: lag, storage of the line, gain, zero, drift, dead band, noise with memory, last digit."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.signal import lfilter

from .course import Course
from .model import Flows
from .pump import RPM, Array, Pump

LITRES = 1e-3 / 60.0
WANDER = 0.4  # of a flow or torque meter's noise, the slow part
MEMORIES = (0.5, 3.0, 10.0)  # samples
SLOW = 60.0, 200.0
MISSTATED = (0.3, 0.5, 2.0, 3.0)
TAIL, FREEDOM = 0.01, 3  # share of samples from Student's t


@dataclass(frozen=True)
class Meter:
    """One channel, SI except for the digits.

    column, unit: of the file, scale: SI of one unit; noise: one sigma of a sample, memory: its own in samples, slow:
    that of WANDER of it, 0 without; digits written; lag in s; gain, zero, drift over the course; band: least reading;
    storage: m3/Pa of the line before it; stated: its noise in recording.toml, "" if not stated.
    """

    column: str
    unit: str
    scale: float
    noise: float
    memory: float
    digits: int
    slow: float = 0.0
    lag: float = 0.0
    gain: float = 0.0
    zero: float = 0.0
    drift: float = 0.0
    band: float = 0.0
    storage: float = 0.0
    stated: str = ""


Meters = dict[str, Meter]


def drawn_meters(pump: Pump, course: Course, truth: Flows, with_torque: bool, rng: np.random.Generator) -> Meters:
    """The meters of one bench, in the order of its columns."""
    own = {
        "p_out": Meter("p_out_bar", "bar", 1e5, 1.5e4, 1.0, 2, zero=5e3 * rng.normal()),
        "p_case": Meter("p_case_bar", "bar", 1e5, 500.0, 1.0, 3),
        "T_in": Meter("T_in_C", "degC", 1.0, 0.06, 1.0, 2, lag=rng.uniform(5.0, 20.0), zero=0.15 * rng.normal()),
        "T_case": Meter("T_case_C", "degC", 1.0, 0.08, 1.0, 2, lag=rng.uniform(10.0, 50.0), zero=0.25 * rng.normal()),
        "Q_out": _delivery(float(np.median(truth.Q_out)), rng),
        "Q_case": _drain(truth.Q_case, rng),
    }
    if with_torque:
        own["torque"] = _torque(float(np.median(truth.torque)), rng)
    if np.ptp(course.state.speed) > 0.1 * pump.speed:
        own["speed"] = Meter("speed_rpm", "rpm", RPM, 0.5 * RPM, 1.0, 1)
    return {name: replace(meter, stated=_statement(name, meter, rng)) for name, meter in own.items()}


def _delivery(flow: float, rng: np.random.Generator) -> Meter:
    noise, memory = rng.uniform(4e-4, 1.2e-3) * flow, rng.choice(MEMORIES)
    return Meter(
        "Q_out_lpm", "L/min", LITRES, noise, memory, _digits(noise / LITRES), slow=rng.uniform(*SLOW),
        lag=rng.uniform(0.3, 3.0), gain=0.002 * rng.normal(), storage=rng.uniform(2e-13, 2e-12),
    )  # fmt: skip


def _drain(flows: Array, rng: np.random.Generator) -> Meter:
    flow = float(np.median(flows))
    noise, memory = rng.uniform(0.006, 0.02) * flow, rng.choice(MEMORIES)
    return Meter(
        "Q_case_lpm", "L/min", LITRES, noise, memory, _digits(noise / LITRES), slow=rng.uniform(*SLOW),
        lag=rng.uniform(1.0, 8.0), gain=0.005 * rng.normal(), zero=0.003 * flow * rng.normal(),
        band=float(np.quantile(flows, rng.uniform(0.0, 0.12))),
    )  # fmt: skip


def _torque(torque: float, rng: np.random.Generator) -> Meter:
    noise = rng.uniform(0.003, 0.008) * torque
    return Meter(
        "torque_Nm", "N m", 1.0, noise, 1.0, _digits(noise), slow=rng.uniform(*SLOW),
        gain=0.002 * rng.normal(), zero=0.002 * torque * rng.normal(),
    )  # fmt: skip


def read(meters: Meters, course: Course, truth: Flows, rng: np.random.Generator) -> dict[str, Array]:
    """Columns of the file, in its units."""
    state = course.state
    true = {
        "p_out": state.pressure, "p_case": state.around, "T_in": state.inlet, "T_case": state.case,
        "Q_out": truth.Q_out, "Q_case": truth.Q_case, "torque": truth.torque, "speed": state.speed,
    }  # fmt: skip
    return {name: _reading(meter, true[name], course.rate, rng) for name, meter in meters.items()}


def _reading(meter: Meter, true: Array, rate: Array, rng: np.random.Generator) -> Array:
    along = np.linspace(0.0, 1.0, true.size)
    found = _behind(true - meter.storage * rate, meter.lag)
    found = found * (1.0 + meter.gain) + meter.zero + meter.drift * along + meter.noise * _noise(true.size, meter, rng)
    found = np.where(found < meter.band, meter.band, found)
    return np.asarray(np.round(found / meter.scale, meter.digits))


def _behind(values: Array, lag: float) -> Array:
    if lag == 0.0:
        return values
    left = float(np.exp(-1.0 / lag))
    return np.asarray(lfilter([1.0 - left], [1.0, -left], values, zi=[left * values[0]])[0])


def _noise(count: int, meter: Meter, rng: np.random.Generator) -> Array:
    """Of unit variance except for the slow part and the tails."""
    found = _first_order(count, meter.memory, rng)
    tails = np.where(rng.uniform(size=count) < TAIL, rng.standard_t(FREEDOM, size=count), found)
    return tails + (WANDER * _first_order(count, meter.slow, rng) if meter.slow else 0.0)


def _first_order(count: int, memory: float, rng: np.random.Generator) -> Array:
    left = float(np.exp(-1.0 / memory))
    start = rng.normal()
    return np.asarray(lfilter([np.sqrt(1.0 - left**2)], [1.0, -left], rng.normal(size=count), zi=[left * start])[0])


def _digits(noise: float) -> int:
    """Decimals of which the last is finer than the noise, in the unit of the file."""
    return int(np.clip(np.ceil(-np.log10(noise)), 1, 4))


def _statement(name: str, meter: Meter, rng: np.random.Generator) -> str:
    """Nothing, a class, or a repeatability that is right or wrong: of flows and torque only."""
    kind = rng.choice(("", "class", "right", "wrong"), p=(0.5, 0.2, 0.15, 0.15))
    if name not in ("Q_out", "Q_case", "torque") or kind == "":
        return ""
    if kind == "class":
        return 'accuracy_class = "B"'
    factor = 1.0 if kind == "right" else float(rng.choice(MISSTATED))
    return f"sigma = {factor * meter.noise / meter.scale:.2g}"
