"""Values of a scaled pump that draws from a tank: inlet and case, spring, and ports that let a chamber fill."""

import math
from collections.abc import Mapping

from system.description.pump import PumpDescription
from system.inputs.units import Dimension, format_quantity
from system.pump.laws.kinematics import piston_velocity
from system.pump.lumped import full_drive, piston_area

OPEN_OPERATING = {"inlet_pressure": "0 MPa", "case_pressure": "0.03 MPa"}
STIFFER = 2.0
"""Springs of an open circuit over those of a closed one, whose inlet presses slippers on the plate by itself."""
SUCTION_BEGINS = math.radians(0.0)
SUCTION_GROOVE_ENDS = math.radians(4.0)  # then the kidney opens: a groove alone starves a chamber that fills
SUCTION_SHUTS = math.radians(182.0)  # past the dead centre: the last of the stroke still draws
DELIVERY_BEGINS = math.radians(2.5)  # half a degree after the suction port shuts
DELIVERY_GROOVE_ENDS = math.radians(8.0)
DELIVERY_SHUTS = math.radians(179.5)  # half a degree before the suction port opens
"""Angles of a port from its own dead centre.

Grooves let a chamber change over, not trapped oil: so it neither cavitates nor is pressed too high at any pressure
or displacement.
"""
SUCTION_DROP = 25e3
"""Pressure (Pa) that filling takes at the end of the suction groove: a quarter of the atmosphere that fills."""
DELIVERY_SHARE = 0.01
"""Share of the rated pressure that the piston takes to press its oil out at the end of the delivery groove."""


def open_circuit_values(pump: PumpDescription) -> dict[str, str]:
    """Values by path for a pump that draws from a tank, as text.

    Each groove passes what the piston moves at its end, at rated speed and full displacement, by the orifice law.
    """
    arc, rated = pump.valve_plate.kidney_arc, pump.pump.rated_pressure
    suction = _throat(pump, SUCTION_GROOVE_ENDS, SUCTION_DROP)
    delivery = _throat(pump, DELIVERY_GROOVE_ENDS, DELIVERY_SHARE * rated)
    spring = format_quantity(STIFFER * pump.ball_guide.spring_preload, Dimension.FORCE, digits=4)
    return {
        **{f"operating.{key}": value for key, value in OPEN_OPERATING.items()},
        "ball_guide.spring_preload": spring,
        **_port("ports", (SUCTION_BEGINS, SUCTION_GROOVE_ENDS, SUCTION_SHUTS), arc, suction),
        **_port("ports.delivery", (DELIVERY_BEGINS, DELIVERY_GROOVE_ENDS, DELIVERY_SHUTS), arc, delivery),
    }


def _throat(pump: PumpDescription, end: float, drop: float) -> float:
    """Area (m2) of a groove that passes the piston's flow at its end (rad from the dead centre) with a drop (Pa)."""
    flow = piston_area(pump) * abs(float(piston_velocity(full_drive(pump), end, pump.pump.rated_speed)))
    return flow / (pump.ports.flow_coefficient * math.sqrt(2.0 * drop / pump.oil.density))


def _port(table: str, angles: tuple[float, float, float], arc: float, throat: float) -> Mapping[str, str]:
    """Values of a port: groove from and to, shut (rad from its dead centre), arc (rad) of a block kidney, throat m2."""
    begins, ends, shuts = angles
    found = {
        "groove_start": begins,
        "groove_end": ends,
        "kidney_full_start": ends + arc,
        "kidney_full_end": shuts - arc,
        "kidney_end": shuts,
    }
    shown = {f"{table}.{key}": format_quantity(value, Dimension.ANGLE, digits=5) for key, value in found.items()}
    return shown | {f"{table}.groove_area": format_quantity(throat, Dimension.AREA, digits=3)}
