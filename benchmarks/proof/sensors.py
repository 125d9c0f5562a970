"""Readings of the bench: quantised, with noise that has memory and tails, within calibration or at fault."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .campaigns import Campaign
from .other.plant.rig import Readout
from .plant.bench import Truth
from .plant.machine import CELSIUS, Array
from .plant.settings import RPM, Settings

LITRES_A_MINUTE = 1e-3 / 60.0
MEMORY = 0.3  # of the noise from one point to the next
TAIL, FREEDOM = 0.03, 3  # share of readings from Student's t, and its degrees of freedom
ENCODER = np.radians(0.3)  # one sigma of the trace's zero
TRACE_NOISE = 0.4e5  # Pa
DRIFT = 0.5  # of a zero over the campaign, in sigma of its calibration


@dataclass(frozen=True)
class Meter:
    """One channel: column and unit of the file, reading = (SI - origin)/scale, noise, calibration, digits."""

    column: str
    unit: str
    scale: float
    sigma: float
    relative: float
    gain: float
    zero: float
    digits: int
    origin: float = 0.0


METERS = {
    "speed": Meter("speed_rpm", "rpm", RPM, 0.5, 0.0, 0.0, 0.0, 1),
    "ratio": Meter("displacement_ratio", "1", 1.0, 0.0, 0.0, 0.0, 0.0005, 4),
    "p_out": Meter("p_out_bar", "bar", 1e5, 0.15, 0.0, 0.0, 0.15, 2),
    "p_in": Meter("p_in_bar", "bar", 1e5, 0.02, 0.0, 0.0, 0.02, 3),
    "p_case": Meter("p_case_bar", "bar", 1e5, 0.01, 0.0, 0.0, 0.01, 3),
    "T_in": Meter("T_in_degC", "degC", 1.0, 0.15, 0.0, 0.0, 0.15, 2, CELSIUS),
    "T_case": Meter("T_case_degC", "degC", 1.0, 0.2, 0.0, 0.0, 0.3, 2, CELSIUS),
    "Q_out": Meter("Q_out_lpm", "L/min", LITRES_A_MINUTE, 0.08, 0.0006, 0.001, 0.08, 3),
    "Q_in": Meter("Q_in_lpm", "L/min", LITRES_A_MINUTE, 0.12, 0.001, 0.001, 0.12, 3),
    "Q_case": Meter("Q_case_lpm", "L/min", LITRES_A_MINUTE, 0.015, 0.004, 0.004, 0.015, 4),
    "torque": Meter("torque_Nm", "N m", 1.0, 0.25, 0.0006, 0.001, 0.25, 3),
    "Q_piston": Meter("Q_piston_lpm", "L/min", LITRES_A_MINUTE, 0.015, 0.004, 0.004, 0.015, 4),
    "Q_slipper": Meter("Q_slipper_lpm", "L/min", LITRES_A_MINUTE, 0.015, 0.004, 0.004, 0.015, 4),
    "Q_valve_plate": Meter("Q_valve_plate_lpm", "L/min", LITRES_A_MINUTE, 0.015, 0.004, 0.004, 0.015, 4),
    "torque_uncoupled": Meter("torque_uncoupled_Nm", "N m", 1.0, 0.25, 0.0, 0.0, 0.0, 3),
}  # fmt: skip


@dataclass(frozen=True)
class Fault:
    """A sensor outside its calibration: gain relative, zero and drift (from the first point to the last) SI."""

    channel: str
    gain: float = 0.0
    zero: float = 0.0
    drift: float = 0.0

    def scaled(self, factor: float) -> Fault:
        """The same fault, so many times larger."""
        return Fault(self.channel, factor * self.gain, factor * self.zero, factor * self.drift)


@dataclass(frozen=True)
class Calibration:
    """Error of one meter: gain relative, zero and drift over the campaign in the unit of its column."""

    gain: float
    zero: float
    drift: float


@dataclass(frozen=True)
class Readings:
    """Columns in the units of METERS; traces by point: shaft angle in deg and chamber pressure in bar."""

    columns: dict[str, Array]
    traces: dict[int, tuple[Array, Array]]
    calibrations: dict[str, Calibration]


def read(
    campaign: Campaign, at: Settings, truth: Truth | Readout, faults: tuple[Fault, ...], rng: np.random.Generator
) -> Readings:
    """Readings of the truth by the campaign's sensors."""
    along = np.linspace(0.0, 1.0, at.speed.size)
    columns, calibrations = {}, {}
    for name, value in _actual(campaign, at, truth).items():
        calibrations[name] = calibrated(METERS[name], rng)
        columns[name] = _channel(METERS[name], value, _of(faults, name), calibrations[name], along, rng)
    columns["ratio"] = np.round(campaign.points.ratio, METERS["ratio"].digits)
    if campaign.uncoupled:
        own = calibrations["torque"]
        zero = _channel(METERS["torque"], np.zeros(along.size), _of(faults, "torque"), own, along, rng)
        read_there = np.isin(np.arange(along.size), campaign.uncoupled)
        columns["torque_uncoupled"] = np.where(read_there, zero, np.nan)
    shift, order = ENCODER * rng.normal(), np.argsort(truth.angle % (2.0 * np.pi))
    traces = {point: _trace(truth, point, order, shift, rng) for point in campaign.traces}
    return Readings(columns, traces, calibrations)


def read_after(
    campaign: Campaign,
    at: Settings,
    truth: Truth | Readout,
    faults: tuple[Fault, ...],
    known: dict[str, Calibration],
    rng: np.random.Generator,
) -> dict[str, Array]:
    """Columns of points recorded after a campaign, by the same sensors as they were at its end."""
    ended = np.ones(at.speed.size)
    columns = {
        name: _channel(METERS[name], value, _of(faults, name), known[name], ended, rng)
        for name, value in _actual(campaign, at, truth).items()
    }
    return columns | {"ratio": np.round(campaign.points.ratio, METERS["ratio"].digits)}


def uncoupled(count: int, faults: tuple[Fault, ...], known: Calibration, rng: np.random.Generator) -> Array:
    """Readings of the torque meter without the pump, at the end of a campaign."""
    ended = np.ones(count)
    return _channel(METERS["torque"], np.zeros(count), _of(faults, "torque"), known, ended, rng)


def stated_sigma(meter: Meter, value: Array) -> Array:
    """Repeatability in SI at values in SI, the step of the reading in it."""
    step = 10.0**-meter.digits / np.sqrt(12.0)
    return np.hypot(meter.sigma + meter.relative * np.abs((value - meter.origin) / meter.scale), step) * meter.scale


def set_in_truth(at: Settings, rng: np.random.Generator) -> Settings:
    """The true strokes of the swash plate at their settings: with the error of its stop's calibration."""
    return at.moved("ratio", METERS["ratio"].zero * rng.normal())


def _of(faults: tuple[Fault, ...], channel: str) -> Fault:
    return next((one for one in faults if one.channel == channel), Fault(channel))


def _actual(campaign: Campaign, at: Settings, truth: Truth | Readout) -> dict[str, Array]:
    """True values, SI, of all that has a sensor."""
    inputs = {name: getattr(at, name) for name in campaign.inputs}
    return inputs | {name: getattr(truth, name) for name in campaign.outputs}


def calibrated(meter: Meter, rng: np.random.Generator) -> Calibration:
    """Error of a meter of a kind."""
    return Calibration(meter.gain * rng.normal(), meter.zero * rng.normal(), DRIFT * meter.zero * rng.normal())


def _channel(
    meter: Meter, value: Array, fault: Fault, own: Calibration, along: Array, rng: np.random.Generator
) -> Array:
    """One channel's column, `along` the campaign from 0 to 1: calibration, fault, noise, rounding."""
    true = (value * (1.0 + fault.gain) + fault.zero + fault.drift * along - meter.origin) / meter.scale
    sigma = meter.sigma + meter.relative * np.abs(true)
    off = own.zero + own.drift * (along - 0.5)
    return np.round(true * (1.0 + own.gain) + off + sigma * _noise(value.size, rng), meter.digits)


def _noise(count: int, rng: np.random.Generator) -> Array:
    """Of unit variance except for the tails: first-order memory, and some readings from Student's t."""
    fresh = rng.normal(size=count)
    found = np.empty(count)
    found[0] = fresh[0]
    for k in range(1, count):
        found[k] = MEMORY * found[k - 1] + np.sqrt(1.0 - MEMORY**2) * fresh[k]
    return np.where(rng.uniform(size=count) < TAIL, rng.standard_t(FREEDOM, size=count), found)


def _trace(
    truth: Truth | Readout, point: int, order: NDArray[np.int64], shift: float, rng: np.random.Generator
) -> tuple[Array, Array]:
    angle = np.arange(0.0, 360.0, 0.5)
    true = np.interp(np.radians(angle) - shift, truth.angle[order] % (2.0 * np.pi), truth.pressure[point][order],
                     period=2.0 * np.pi)  # fmt: skip
    return angle, np.round((true + TRACE_NOISE * rng.normal(size=angle.size)) / 1e5, 3)
