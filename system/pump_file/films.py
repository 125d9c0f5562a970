"""Checks of the films at their given positions: are they films, thin against their lands and open everywhere?"""

import math
from collections.abc import Iterator

from system.description.pump import PumpDescription
from system.inputs.faults import Fault
from system.pump_file.check import CheckWarning, Finding, angle, length, needs

THIN_FILM = 0.01  # film thickness / land width; above it Reynolds' equation loses percents
WIDE_CLEARANCE = 0.003  # radial clearance / diameter; built pumps have 0.0006 to 0.0012, leakage is with its cube


@needs("piston.radial_clearance", "pump.piston_diameter")
def piston_clearance_seals(pump: PumpDescription) -> Iterator[Finding]:
    """The piston's radial clearance is a few thousandths of its diameter at the most, so that its film seals."""
    clearance, diameter = pump.piston.radial_clearance, pump.pump.piston_diameter
    if clearance > WIDE_CLEARANCE * diameter:
        yield CheckWarning(
            "piston.radial_clearance",
            f"{length(clearance)} on a piston of {length(diameter)}, {clearance / diameter:.2%} of its diameter",
            f"{length(WIDE_CLEARANCE * diameter)} ({WIDE_CLEARANCE:.1%} of the diameter: pumps have about 0.1 %, and "
            "leakage grows with the cube of the clearance)",
            "check the unit, um, and that the clearance is radial, not diametral",
        )


@needs("slipper.film_thickness", "slipper.land_inner_radius", "slipper.land_outer_radius")
def slipper_film_is_thin(pump: PumpDescription) -> Iterator[Finding]:
    """The slipper's film is small against its land width (Reynolds' thin-film assumption)."""
    width = pump.slipper.land_outer_radius - pump.slipper.land_inner_radius
    yield from _thin("slipper.film_thickness", pump.slipper.film_thickness, width)


@needs("valve_plate.film_thickness", "valve_plate.land_radius_1", "valve_plate.land_radius_2")
def valve_plate_film_is_thin(pump: PumpDescription) -> Iterator[Finding]:
    """The valve plate's film is small against its inner land width (Reynolds' thin-film assumption)."""
    width = pump.valve_plate.land_radius_2 - pump.valve_plate.land_radius_1
    yield from _thin("valve_plate.film_thickness", pump.valve_plate.film_thickness, width)


def _thin(path: str, film: float, width: float) -> Iterator[Finding]:
    if width > 0.0 and film > THIN_FILM * width:
        yield CheckWarning(
            path,
            f"{length(film)} on a land of {length(width)}",
            f"{length(THIN_FILM * width)} (1 % of the land: above it the film is no thin film)",
            "check the unit: um, not mm?",
        )


@needs("slipper.film_thickness", "slipper.land_outer_radius", "slipper.tilt_radial", "slipper.tilt_tangential")
def slipper_film_is_open(pump: PumpDescription) -> Iterator[Finding]:
    """The slipper at its given film thickness and tilts does not touch the swash plate."""
    part = pump.slipper
    tilts = {"tilt_radial": part.tilt_radial, "tilt_tangential": part.tilt_tangential}
    yield from _open("slipper", part.film_thickness, part.land_outer_radius, tilts)


@needs("valve_plate.film_thickness", "valve_plate.land_radius_4", "valve_plate.tilt_x", "valve_plate.tilt_y")
def valve_plate_film_is_open(pump: PumpDescription) -> Iterator[Finding]:
    """The block at its given film thickness and tilts does not touch the valve plate."""
    part = pump.valve_plate
    tilts = {"tilt_x": part.tilt_x, "tilt_y": part.tilt_y}
    yield from _open("valve_plate", part.film_thickness, part.land_radius_4, tilts)


def _open(table: str, film: float, radius: float, tilts: dict[str, float]) -> Iterator[Finding]:
    fall = radius * math.hypot(*(math.tan(tilt) for tilt in tilts.values()))
    if fall >= film:
        worst = max(tilts, key=lambda key: abs(tilts[key]))
        yield Fault(
            f"{table}.{worst}",
            f"{angle(tilts[worst])}: over a radius of {length(radius)} the tilts take {length(fall)} of the film",
            f"less than film_thickness, {length(film)}",
            f"tilts below {angle(math.atan(film / radius))} together, or a larger film_thickness",
        )
