"""Checks of values that can be read but that no part has: masses beyond solid steel, friction beyond dry steel."""

import math
from collections.abc import Iterator
from dataclasses import fields

from system.description.pump import FrictionSection, PumpDescription
from system.inputs.faults import Fault
from system.inputs.units import Dimension, format_quantity
from system.pump.lumped import piston_area
from system.pump_file.check import CheckWarning, Finding, needs

_PAIRS = tuple(own.name for own in fields(FrictionSection))
STEEL_DENSITY = 7850.0  # kg/m3
HEAVY = 1.5  # times the solid cylinder: with a margin for a ball and heavier alloys
DRY_FRICTION = 1.0  # of steel on steel without any oil; boundary layers have 0.08 .. 0.15


@needs("oil.pressure_viscosity", "physics.viscosity_pressure.coefficient")
def oil_thickens_by_one_coefficient(pump: PumpDescription) -> Iterator[Finding]:
    """[oil] and [physics.viscosity_pressure] state the same coefficient of Barus."""
    of_oil, thickening = pump.oil.pressure_viscosity, pump.physics.viscosity_pressure
    if of_oil is not None and thickening is not None and not math.isclose(of_oil, thickening.coefficient):
        yield Fault(
            "physics.viscosity_pressure.coefficient",
            format_quantity(thickening.coefficient, Dimension.PRESSURE_COEFFICIENT, digits=4),
            f"oil.pressure_viscosity, {format_quantity(of_oil, Dimension.PRESSURE_COEFFICIENT, digits=4)}",
        )


@needs("piston.mass", "piston.engaged_length", "piston.overhang", "pump.piston_diameter")
def piston_is_no_heavier_than_steel(pump: PumpDescription) -> Iterator[Finding]:
    """A piston weighs no more than solid steel of its diameter, engaged length and overhang."""
    solid = STEEL_DENSITY * piston_area(pump) * (pump.piston.engaged_length + pump.piston.overhang)
    yield from _heavy("piston.mass", pump.piston.mass, solid)


def _heavy(path: str, mass: float, solid: float) -> Iterator[Finding]:
    if mass > HEAVY * solid:
        yield CheckWarning(
            path,
            format_quantity(mass, Dimension.MASS, digits=4),
            f"{format_quantity(HEAVY * solid, Dimension.MASS, digits=3)}, {HEAVY:g} times solid steel of its size",
            "check the unit: g, not kg?",
        )


@needs("slipper.mass", "slipper.land_outer_radius", "slipper.centre_of_mass_to_ball")
def slipper_is_no_heavier_than_steel(pump: PumpDescription) -> Iterator[Finding]:
    """A slipper weighs no more than a solid cylinder about its rim, twice as high as wide."""
    radius = pump.slipper.land_outer_radius
    yield from _heavy("slipper.mass", pump.slipper.mass, 4.0 * math.pi * radius**3 * STEEL_DENSITY)


@needs(*(f"friction.{key}" for key in _PAIRS))
def friction_is_below_that_of_dry_steel(pump: PumpDescription) -> Iterator[Finding]:
    """No Coulomb coefficient exceeds one."""
    for key in _PAIRS:
        value = getattr(pump.friction, key)
        if value > DRY_FRICTION:
            yield CheckWarning(
                f"friction.{key}", f"{value:g}", f"{DRY_FRICTION:g} (dry steel)", "a share, not percent?"
            )
