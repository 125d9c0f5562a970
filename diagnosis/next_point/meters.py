"""Meters of an ordinary bench for a pump of any size, with the repeatability of those that are stated.

Repeatability: that of good meters of each kind at steady points. Calibration: class A of ISO 4409 as limits of uniform
likelihood, 0.5 % / sqrt 3 for flows and torque.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import radians, sqrt

from diagnosis.recording.model import RecordedChannel
from diagnosis.recording.units import channel_unit
from system.bench.outputs import DRAINS
from system.description.pump import PumpDescription
from system.inputs.channels import INPUTS, ChannelName
from system.inputs.units import TURN
from system.pump.lumped import full_drive, swept_displacement

CLASS_A = 0.005 / sqrt(3.0)
ALWAYS = tuple(one for one in INPUTS if one is not ChannelName.T_CASE)
"""Inputs that every bench reads: they define a point."""
ORDINARY = (*ALWAYS, ChannelName.Q_OUT, ChannelName.Q_CASE, ChannelName.TORQUE)
"""Channels of an ordinary bench: delivery flow, drain flow and torque beside the inputs; none in the drain's oil."""
WORDS = {
    ChannelName.Q_OUT: "a meter of the delivery flow",
    ChannelName.Q_IN: "a meter of the inlet flow",
    ChannelName.Q_CASE: "a meter of the case drain",
    ChannelName.TORQUE: "a torque meter",
    ChannelName.T_CASE: "a thermometer in the case drain",
    ChannelName.Q_PISTON: "a metered drain of the pistons alone",
    ChannelName.Q_SLIPPER: "a metered drain of the slippers alone",
    ChannelName.Q_VALVE_PLATE: "a metered drain of the valve plate alone",
    ChannelName.TORQUE_UNCOUPLED: "a reading of the torque meter uncoupled from the pump",
    ChannelName.P_CHAMBER: "the chamber pressure over the turn",
}
"""Meters that a bench may add, in words."""


@dataclass(frozen=True)
class Stated:
    """One sigma of a meter as stated: in SI, a share of the reading, or neither: that of an ordinary bench."""

    sigma: float | None = None
    share: float | None = None


def meters(pump: PumpDescription, stated: Mapping[ChannelName, Stated]) -> tuple[RecordedChannel, ...]:
    """Every meter of an ordinary bench, further ones too, with its stated repeatability, if any.

    A stated sigma below that of the calibration's zero leaves the zero unchanged.
    """
    return tuple(_with(one, stated.get(one.name, Stated())) for one in _usual(pump))


def _with(one: RecordedChannel, own: Stated) -> RecordedChannel:
    if own.sigma is None and own.share is None:
        return one
    return replace(one, sigma=own.sigma or 0.0, sigma_relative=own.share or 0.0, assumed=("gain", "zero"))


def _usual(pump: PumpDescription) -> Iterator[RecordedChannel]:
    """One sigma of each: of a reading, as a share of it, of the calibration's gain and zero."""
    rated = pump.pump
    volume = swept_displacement(pump, full_drive(pump))
    flow, torque = volume * rated.rated_speed / TURN, volume * rated.rated_pressure / TURN
    pressure = rated.rated_pressure
    yield _meter(ChannelName.SPEED, 2e-4 * rated.rated_speed, 0.0, 0.0, 0.0)
    yield _meter(ChannelName.DISPLACEMENT_RATIO, 0.0, 0.0, 0.0, 5e-4)
    yield _meter(ChannelName.P_OUT, 5e-4 * pressure, 0.0, 0.0, 5e-4 * pressure)
    yield _meter(ChannelName.P_IN, 2e3, 0.0, 0.0, 2e3)
    yield _meter(ChannelName.P_CASE, 1e3, 0.0, 0.0, 1e3)
    yield _meter(ChannelName.T_IN, 0.15, 0.0, 0.0, 0.3)
    yield _meter(ChannelName.T_CASE, 0.2, 0.0, 0.0, 0.3)
    for name in (ChannelName.Q_OUT, ChannelName.Q_IN):
        yield _meter(name, 5e-4 * flow, 6e-4, CLASS_A, 5e-4 * flow)
    for name in (ChannelName.Q_CASE, *DRAINS.values()):
        yield _meter(name, 1e-4 * flow, 4e-3, CLASS_A, 1e-4 * flow)
    yield _meter(ChannelName.TORQUE, 5e-4 * torque, 6e-4, CLASS_A, 5e-4 * torque)
    yield _meter(ChannelName.TORQUE_UNCOUPLED, 5e-4 * torque, 0.0, 0.0, 0.0)
    yield _meter(ChannelName.P_CHAMBER, 1e-3 * pressure, 0.0, CLASS_A, 1e-3 * pressure)
    yield _meter(ChannelName.ANGLE, 0.0, 0.0, 0.0, radians(0.3))


def _meter(name: ChannelName, sigma: float, share: float, gain: float, zero: float) -> RecordedChannel:
    assumed = ("sigma", "gain", "zero")
    return RecordedChannel(name, name.value, channel_unit(name), sigma, share, 0.0, 0.0, gain, zero, assumed)
