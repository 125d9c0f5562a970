"""The channels of a test bench by their standard names, with their quantities."""

from __future__ import annotations

from enum import Enum

from system.inputs.units import Dimension


class ChannelName(Enum):
    """A channel: its name in recordings and reports, and its dimension (None: a pure number)."""

    SPEED = ("speed", Dimension.ANGULAR_SPEED)
    DISPLACEMENT_RATIO = ("displacement_ratio", None)
    P_OUT = ("p_out", Dimension.PRESSURE)
    P_IN = ("p_in", Dimension.PRESSURE)
    P_CASE = ("p_case", Dimension.PRESSURE)
    T_IN = ("T_in", Dimension.TEMPERATURE)
    T_OUT = ("T_out", Dimension.TEMPERATURE)
    T_CASE = ("T_case", Dimension.TEMPERATURE)
    Q_OUT = ("Q_out", Dimension.VOLUME_FLOW)
    Q_IN = ("Q_in", Dimension.VOLUME_FLOW)
    Q_CASE = ("Q_case", Dimension.VOLUME_FLOW)
    Q_PISTON = ("Q_piston", Dimension.VOLUME_FLOW)
    Q_SLIPPER = ("Q_slipper", Dimension.VOLUME_FLOW)
    Q_VALVE_PLATE = ("Q_valve_plate", Dimension.VOLUME_FLOW)
    TORQUE = ("torque", Dimension.TORQUE)
    TORQUE_UNCOUPLED = ("torque_uncoupled", Dimension.TORQUE)
    ELECTRIC_POWER = ("electric_power", Dimension.POWER)
    ANGLE = ("angle", Dimension.ANGLE)
    P_CHAMBER = ("p_chamber", Dimension.PRESSURE)

    dimension: Dimension | None

    def __new__(cls, name: str, dimension: Dimension | None) -> ChannelName:
        """A member whose value is its name alone."""
        member = object.__new__(cls)
        member._value_ = name
        member.dimension = dimension
        return member

    @classmethod
    def named(cls, name: str) -> ChannelName:
        """The channel of a standard name. Raises ValueError for another name."""
        found: ChannelName = cls._value2member_map_.get(name)  # type: ignore[assignment]
        if found is None:
            raise ValueError(f"channel {name!r}; expected one of {', '.join(each.value for each in cls)}")
        return found


INPUTS = (
    ChannelName.SPEED,
    ChannelName.DISPLACEMENT_RATIO,
    ChannelName.P_OUT,
    ChannelName.P_IN,
    ChannelName.P_CASE,
    ChannelName.T_IN,
    ChannelName.T_CASE,
)
OUTPUTS = (
    ChannelName.Q_OUT,
    ChannelName.Q_IN,
    ChannelName.Q_CASE,
    ChannelName.Q_PISTON,
    ChannelName.Q_SLIPPER,
    ChannelName.Q_VALVE_PLATE,
    ChannelName.TORQUE,
    ChannelName.T_OUT,
    ChannelName.ELECTRIC_POWER,
)
