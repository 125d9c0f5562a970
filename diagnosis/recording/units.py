"""Readings in the units that a bench reads them in."""

from __future__ import annotations

from collections.abc import Mapping

from system.inputs.channels import ChannelName
from system.inputs.shown import PressureUnit, pressure_unit
from system.inputs.units import Dimension, in_unit

BENCH_UNITS = {Dimension.TEMPERATURE: "degC", Dimension.VOLUME_FLOW: "L/min"}
"""Reading units of a bench where they are not the usual ones."""
OTHER_UNITS: Mapping[Dimension, tuple[str, ...]] = {
    Dimension.PRESSURE: ("bar", "MPa", "kPa", "psi", "Pa"),
    Dimension.ANGULAR_SPEED: ("rpm", "rad/s", "rev/s"),
    Dimension.VOLUME_FLOW: ("L/min", "m3/h", "mL/min", "gallon/min", "L/s", "m3/s"),
    Dimension.TORQUE: ("N m", "kN m", "lbf ft", "lbf inch"),
    Dimension.TEMPERATURE: ("degC", "degF", "K"),
}
"""Units in which a bench may have written a channel."""


def channel_unit(channel: ChannelName) -> str:
    """The unit a bench reads a channel in; "1" for a pure number."""
    dimension = channel.dimension
    if dimension is None:
        return "1"
    if dimension is Dimension.PRESSURE:
        return pressure_unit(PressureUnit.BAR).value
    return BENCH_UNITS.get(dimension, dimension.reading_units[0])


def channel_head(channel: ChannelName) -> str:
    """The head of a column of readings, such as "p_out [bar]"."""
    return f"{channel.value} [{channel_unit(channel)}]"


def difference_unit(channel: ChannelName) -> str:
    """The unit of a difference of two readings: of two temperatures K."""
    return "K" if channel.dimension is Dimension.TEMPERATURE else channel_unit(channel)


def reading(channel: ChannelName, value: float) -> float:
    """A reading in SI in the unit that the bench reads it in."""
    dimension = channel.dimension
    return value if dimension is None else in_unit(value, channel_unit(channel), dimension)


def difference(channel: ChannelName, value: float) -> float:
    """A difference of two readings in SI in its unit."""
    return reading(channel, value) - reading(channel, 0.0)
