"""The three gaps of a pump, by name."""

from enum import Enum


class Gap(Enum):
    """The three gaps of a pump."""

    PISTON = "piston"
    SLIPPER = "slipper"
    VALVE_PLATE = "valve_plate"
