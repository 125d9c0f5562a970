"""Errors of sensors: gain, zero, drift and lag of outputs, zeros of inputs, lag of the case's thermometer."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from math import inf
from typing import Protocol

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.points import BenchPoints
from system.estimation.parameters import Parameter, Role, Scale
from system.inputs.channels import INPUTS, OUTPUTS, ChannelName
from system.inputs.units import TURN, Dimension

BIASED_INPUTS = (ChannelName.P_OUT, ChannelName.T_CASE, ChannelName.DISPLACEMENT_RATIO)
"""Inputs whose bias by calibration is a parameter of its own."""
METER_OF = {ChannelName.TORQUE_UNCOUPLED: ChannelName.TORQUE}
"""Channels that the meter of another one reads, with its gain, zero and drift."""
CALIBRATION, TAKEN = "calibration of the channel", "not measured, taken"
FARTHEST = 4.0  # sigma: largest error of an assumed value
FARTHEST_GAIN = 0.3  # relative error of a meter: one that is farther off is another meter or has another unit
ENCODER_OFFSET = "encoder_offset"
CHAMBER_GAIN, CHAMBER_ZERO, CHAMBER_LAG = (f"{ChannelName.P_CHAMBER.value}.{what}" for what in ("gain", "zero", "lag"))
TRACE_NAMES = frozenset({ENCODER_OFFSET, CHAMBER_GAIN, CHAMBER_ZERO, CHAMBER_LAG})
"""Names of the parameters that change readings of traces, and no steady reading."""
READING_NAMES = frozenset(f"{channel.value}.{what}" for channel in OUTPUTS for what in ("gain", "zero", "drift", "lag"))
"""Names of the parameters that change the readings, not the truth."""
LAG_NAMES = frozenset(f"{channel.value}.lag" for channel in OUTPUTS)
"""Names of the lags of meters, which no reading feels far below the time between two points."""
THERMOMETER_LAG = f"{ChannelName.T_CASE.value}.lag"
SENSOR_NAMES = frozenset(
    {*TRACE_NAMES, *READING_NAMES, THERMOMETER_LAG, *(f"{channel.value}.zero" for channel in INPUTS)}
)
"""Names of all parameters of sensors."""


class Sensor(Protocol):
    """A channel with one sigma of its calibration: gain relative, zero in SI."""

    @property
    def name(self) -> ChannelName: ...
    @property
    def gain_sigma(self) -> float: ...
    @property
    def zero_sigma(self) -> float: ...


def sensor_parameters(sensors: Iterable[Sensor]) -> tuple[Parameter, ...]:
    """CHANNEL.gain and CHANNEL.zero of every output, CHANNEL.zero of the inputs in BIASED_INPUTS.

    A reading is the truth (1 + gain) + zero. A quantity with sigma 0 has no parameter.
    """
    found = []
    for sensor in sensors:
        if sensor.name in OUTPUTS and sensor.gain_sigma > 0.0:
            found.append(_bias(sensor.name, "gain", sensor.gain_sigma, None, FARTHEST_GAIN))
        if sensor.name in (*OUTPUTS, *BIASED_INPUTS) and sensor.zero_sigma > 0.0:
            found.append(_bias(sensor.name, "zero", sensor.zero_sigma, sensor.name.dimension, inf))
    return tuple(found)


def taken_parameter(channel: ChannelName, sigma: float) -> Parameter:
    """CHANNEL.zero of an input that was not measured: excess of its assumed value (SI)."""
    return replace(_bias(channel, "zero", sigma, channel.dimension, FARTHEST * sigma), source=TAKEN)


def drift_parameter(channel: ChannelName, sigma: float) -> Parameter:
    """CHANNEL.drift: excess (SI) of an output's reading at the last point, or at a known course's peak."""
    return _bias(channel, "drift", sigma, channel.dimension, inf)


def lag_parameter(channel: ChannelName, sigma: float) -> Parameter:
    """CHANNEL.lag in s: time constant with which an output follows from the reading at the point before."""
    return Parameter(f"{channel.value}.lag", Role.SENSOR, Scale.HALF, 0.0, sigma, 0.0, inf, Dimension.TIME, CALIBRATION)


def thermometer_parameter(lag: float, sigma: float) -> Parameter:
    """T_case.lag in s: time constant with which the thermometer of the case follows the oil."""
    return Parameter(THERMOMETER_LAG, Role.SENSOR, Scale.NORMAL, lag, sigma, 0.0, inf, Dimension.TIME, CALIBRATION)


def encoder_parameter(sigma: float) -> Parameter:
    """encoder_offset in rad: excess of the encoder's reading in traces."""
    return Parameter(ENCODER_OFFSET, Role.SENSOR, Scale.NORMAL, 0.0, sigma, -0.2, 0.2, Dimension.ANGLE, CALIBRATION)


def transducer_parameters(transducer: Sensor, lag: float) -> tuple[Parameter, ...]:
    """p_chamber.gain, p_chamber.zero (Pa) and p_chamber.lag (s, one sigma `lag`) of the transducer of traces.

    The lag is that of the bore and line before it, a first-order one. A quantity with sigma 0 has no parameter.
    """
    found = [lag_parameter(transducer.name, lag)]
    if transducer.gain_sigma > 0.0:
        found.append(_bias(transducer.name, "gain", transducer.gain_sigma, None, FARTHEST_GAIN))
    if transducer.zero_sigma > 0.0:
        found.append(_bias(transducer.name, "zero", transducer.zero_sigma, transducer.name.dimension, inf))
    return tuple(found)


def read_turns(pressure: Array, speed: Array, angles: Array, values: Mapping[str, float]) -> Array:
    """Chamber pressure (N, K) in Pa gauge as read at shaft angles (K,) rad, of turns (N, M) at even angles from 0.

    speed (N,), rad/s. By the values of TRACE_NAMES: the encoder reads its offset too much; the transducer with its lag
    tau reads the turn's k-th harmonic over 1 + i k omega tau.
    """
    samples = pressure.shape[1]
    lag = values.get(CHAMBER_LAG, 0.0)
    if lag > 0.0:
        order = np.arange(samples // 2 + 1)
        late = np.fft.rfft(pressure, axis=1) / (1.0 + 1j * order * np.reshape(speed, (-1, 1)) * lag)
        pressure = np.fft.irfft(late, samples, axis=1)
    place = (angles - values.get(ENCODER_OFFSET, 0.0)) % TURN
    grid = TURN * np.arange(samples) / samples
    there = np.stack([np.interp(place, grid, one, period=TURN) for one in pressure])
    return np.asarray(there * (1.0 + values.get(CHAMBER_GAIN, 0.0)) + values.get(CHAMBER_ZERO, 0.0))


def actual(points: BenchPoints, values: Mapping[str, float]) -> BenchPoints:
    """The points as they were: readings less the inputs' zeros, and T + tau dT/dt of a thermometer with a lag tau."""
    changed = {}
    for channel in INPUTS:
        zero = values.get(f"{channel.value}.zero", 0.0)
        if zero != 0.0:
            changed[channel.value] = getattr(points, channel.value) - zero
    lag = values.get(THERMOMETER_LAG, 0.0)
    if lag != 0.0:
        warm = ChannelName.T_CASE.value
        changed[warm] = changed.get(warm, points.T_case) + lag * points.warming
    return replace(points, **changed)


def read(
    truth: Array,
    channels: Sequence[ChannelName],
    points: BenchPoints,
    values: Mapping[str, float],
    drifts: Mapping[ChannelName, Array],
) -> Array:
    """Readings (N, C) of the truth (N, C), both in SI, with the sensors' values by name.

    drifts: course (N,) of a meter's drift over its value; even in time for a meter without one.
    """
    found = truth.copy()
    progress = _progress(points)
    for column, channel in enumerate(channels):
        meter = METER_OF.get(channel, channel)
        gain, zero, drift = (values.get(f"{meter.value}.{what}", 0.0) for what in ("gain", "zero", "drift"))
        found[:, column] = found[:, column] * (1.0 + gain) + zero + drift * drifts.get(meter, progress)
        lag = values.get(f"{meter.value}.lag", 0.0)
        if lag > 0.0:
            found[:, column] = _lagging(found[:, column], points, lag)
    return found


def _bias(channel: ChannelName, what: str, sigma: float, dimension: Dimension | None, bound: float) -> Parameter:
    name, linear = f"{channel.value}.{what}", channel in OUTPUTS
    return Parameter(name, Role.SENSOR, Scale.NORMAL, 0.0, sigma, -bound, bound, dimension, CALIBRATION, linear)


def _progress(points: BenchPoints) -> Array:
    """From 0 at the first measured point to 1 at the last: by the hours where they are known, else by the order."""
    time = points.hours if np.all(np.isfinite(points.hours)) and np.ptp(points.hours) > 0.0 else points.order
    span = np.ptp(time)
    return np.asarray((time - np.min(time)) / span) if span > 0.0 else np.zeros(len(time))


def _lagging(reading: Array, points: BenchPoints, lag: float) -> Array:
    """Readings with a lag: the share exp(-t/lag) of the change from the point before in time is missing.

    None is missing of a point whose time is that of the one before, as of points to come, or is not known.
    """
    sequence = np.lexsort((points.order, points.hours))
    ordered, past = reading[sequence], 3600.0 * np.diff(points.hours[sequence])
    left = np.where(past > 0.0, np.exp(-past / lag), 0.0)
    late = ordered.copy()
    late[1:] -= np.diff(ordered) * left
    found = np.empty_like(reading)
    found[sequence] = late
    return found
