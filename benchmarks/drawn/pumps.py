"""Pumps drawn at random: size, number of pistons, films, ports, oil, effects of [physics], and the operating point."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import deepcopy
from typing import Any

from .draw import Draw
from .films import GRADES

Tables = dict[str, Any]

SCALED = {
    "piston.radial_clearance": (0.5, 2.5),
    "piston.mass": (0.5, 2.0),
    "pump.dead_volume": (0.8, 3.0),
    "slipper.film_thickness": (0.4, 3.0),
    "slipper.orifice_diameter": (0.5, 2.0),
    "slipper.orifice_length": (0.5, 3.0),
    "valve_plate.film_thickness": (0.4, 3.0),
    "ports.groove_area": (0.2, 3.0),
    "ports.kidney_area": (0.4, 1.0),
    "ball_guide.spring_preload": (0.3, 3.0),
    "oil.bulk_modulus": (0.4, 1.4),
    "block.mass": (0.5, 2.0),
}
"""Keys whose value is multiplied by a number between these bounds, each in half of the pumps."""
EFFECTS: Mapping[str, Callable[[Draw], Tables]] = {
    "film_heating": lambda draw: {"slipper": f"{draw.wide(1e-5, 2e-3)} m2 K/W"},
    "viscosity_pressure": lambda draw: {"coefficient": f"{draw.even(1, 25)} 1/GPa"},
    "shear_thinning": lambda draw: {"drop": draw.even(0.0, 0.4), "rate": f"{draw.wide(1e5, 1e7)} 1/s"},
    "elastic_opening": lambda draw: {"valve_plate": {"opening": f"{draw.even(0, 30)} 1/GPa"}},
    "mixed_friction": lambda draw: {"piston": draw.even(0.0, 0.12), "hersey_scale": draw.wide(1e-8, 1e-6)},
    "slipper_lift": lambda draw: {
        "ride_height": f"{draw.wide(1, 100)} um",
        "retainer_force": f"{draw.wide(10, 500)} N",
    },
    "entrained_air": lambda draw: {"void": draw.even(0.0, 0.05)},
    "incomplete_filling": lambda draw: {"inlet_loss": draw.even(0.0, 10.0)},
    "churning": lambda draw: {"factor": draw.even(0.0, 3.0)},
    "seal_drag": lambda draw: {"torque": f"{draw.even(0, 5)} N m"},
    "port_throttling": lambda draw: {"factor": draw.even(0.0, 5.0)},
    "compression_loss": lambda draw: {"share": draw.even(0.0, 5.0)},
    "port_short_circuit": lambda draw: {"area": f"{draw.even(0, 3)} mm2"},
    "notch_erosion": lambda draw: {"advance": f"{draw.even(0, 8)} deg", "widening": draw.even(0.0, 3.0)},
    "swash_droop": lambda draw: {"rate": f"{draw.even(0, 17)} deg/GPa"},
}
"""Tables of [physics], each in a tenth of the pumps."""


def pump_case(number: int) -> Tables:
    """Return the tables of a complete pump file."""
    draw = Draw("pump", number)
    tables = _usual(f"{draw.wide(5, 300)} cm3/rev", draw.whole(5, 13), draw.one_of(GRADES))
    for key, (least, most) in SCALED.items():
        if draw.chance(0.5):
            _scale(tables, key, draw.wide(least, most))
    tables["piston"]["eccentricity_ratio"] = draw.even(0.0, 0.9)
    if tilted := draw.chance(0.2):
        tables["pump"]["cross_angle"] = f"{draw.even(-3, 3)} deg"
        del tables["pump"]["displacement"]  # the geometry's own
    tables["slipper"]["tilt_radial"] = f"{draw.even(-0.01, 0.01) if draw.chance(0.2) else 0.0} deg"
    tables["valve_plate"]["tilt_x"] = f"{draw.even(-0.002, 0.002) if draw.chance(0.2) else 0.0} deg"
    tables["physics"] = {name: make(draw) for name, make in EFFECTS.items() if draw.chance(0.1)}
    if draw.chance(0.2):
        tables["delivery_line"] = {"kind": "orifice", "volume": f"{draw.wide(0.05, 5)} L"}
    inlet = draw.even(-0.5, 30)
    tables["operating"] = {
        "speed": f"{draw.wide(30, 4000)} rpm",
        "pressure": f"{inlet + draw.wide(2, 420):.4g} bar",
        "displacement_ratio": draw.wide(0.3 if tilted else 0.02, 1.0),
        "temperature": f"{draw.even(-5, 110)} degC",
        "inlet_pressure": f"{inlet} bar",
        "case_pressure": f"{draw.even(0, 3)} bar",
    }
    return tables


def _usual(displacement: str, pistons: int, grade: str) -> Tables:
    """The tables of a pump with few known values."""
    from system.pump_file.scaled.completed import completed

    stated = {"pump": {"displacement": displacement, "pistons": pistons}, "oil": {"grade": grade}}
    return deepcopy(dict(completed("drawn", stated, "drawn").tables))


def _scale(tables: Tables, key: str, factor: float) -> None:
    """Multiply a quantity of the tables, in its own unit."""
    table, _, name = key.partition(".")
    number, _, unit = tables[table][name].partition(" ")
    tables[table][name] = f"{factor * float(number):.4g} {unit}"
