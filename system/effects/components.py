"""The possible places of a mismatch in a pump's balance: leakage paths, friction pairs, sensors."""

from enum import Enum


class Component(Enum):
    """One contribution to the bench readings, located without a catalogue of effects."""

    PISTON_LEAKAGE = "piston_leakage"
    SLIPPER_LEAKAGE = "slipper_leakage"
    PLATE_LEAKAGE = "plate_leakage"
    CROSS_FLOW = "cross_flow"
    DRAIN_FLOW = "drain_flow"
    DISPLACEMENT = "displacement"
    COMPRESSION = "compression"
    COMMUTATION = "commutation"
    PISTON_FRICTION = "piston_friction"
    SLIPPER_FRICTION = "slipper_friction"
    SOCKET_FRICTION = "socket_friction"
    PLATE_FRICTION = "plate_friction"
    GUIDE_FRICTION = "guide_friction"
    BEARINGS = "bearings"
    CASE_DRAG = "case_drag"
    THERMAL_STATE = "thermal_state"
    Q_OUT_SENSOR = "Q_out_sensor"
    Q_IN_SENSOR = "Q_in_sensor"
    Q_CASE_SENSOR = "Q_case_sensor"
    TORQUE_SENSOR = "torque_sensor"
    T_OUT_SENSOR = "T_out_sensor"
    ELECTRIC_POWER_SENSOR = "electric_power_sensor"
