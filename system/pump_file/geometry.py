"""Checks of the geometry: does the pump described fit together?"""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from system.description.pump import PumpDescription, SlipperSection
from system.inputs.faults import Fault
from system.inputs.units import Dimension, format_quantity
from system.pump.laws.kinematics import SwashDrive, ball_radius, displacement, stroke
from system.pump_file.check import CheckWarning, Finding, angle, length, needs
from system.pump_file.ports import of_sides

DISPLACEMENT_TOLERANCE = 0.01
ROUNDING = 1e-9  # relative; two lengths of a drawing that meet exactly do not overlap

_CONE = ("pump.bore_cone_angle", "pump.swash_angle_max")
_DRIVE = ("pump.pitch_radius", *_CONE)


def _drive(pump: PumpDescription) -> SwashDrive | None:
    """Return the kinematics at full swash angle; None where the plate does not cut every bore axis."""
    if math.tan(pump.pump.bore_cone_angle) * math.tan(_whole_tilt(pump)) >= 1.0:
        return None
    return SwashDrive(pump.pump.pitch_radius, pump.pump.bore_cone_angle, _whole_tilt(pump))


def _whole_tilt(pump: PumpDescription) -> float:
    """Return the plate's tilt at full swash angle, cross angle included."""
    return math.atan(math.hypot(math.tan(pump.pump.swash_angle_max), math.tan(pump.pump.cross_angle or 0.0)))


@needs(*_CONE)
def swash_plate_cuts_every_bore(pump: PumpDescription) -> Iterator[Finding]:
    """tan(cone angle) tan(swash angle) < 1: else Eq. (6) has a pole and the piston leaves the block."""
    cone, swash = pump.pump.bore_cone_angle, _whole_tilt(pump)
    if math.tan(cone) * math.tan(swash) >= 1.0:
        yield Fault(
            "pump.bore_cone_angle",
            f"{angle(cone)} with a swash angle of {angle(swash)}",
            "tan(bore_cone_angle) tan(swash_angle_max) below 1, so that the swash plate cuts every bore axis",
            f"bore_cone_angle below {angle(math.pi / 2 - swash)}",
        )


@needs("pump.pistons", "pump.piston_diameter", *_DRIVE)
def displacement_is_that_of_the_geometry(pump: PumpDescription) -> Iterator[Finding]:
    """A stated displacement is pistons x piston area x stroke of Eq. (6), to 1 %."""
    stated, drive = pump.pump.displacement, _drive(pump)
    if stated is None or drive is None:
        return
    area = math.pi * pump.pump.piston_diameter**2 / 4
    geometric = displacement(pump.pump.pistons, area, stroke(drive))
    if abs(stated / geometric - 1.0) > DISPLACEMENT_TOLERANCE:
        shown = format_quantity(geometric, Dimension.DISPLACEMENT, digits=4)
        fitting = length(pump.pump.pitch_radius * stated / geometric)
        yield Fault(
            "pump.displacement",
            f"{format_quantity(stated, Dimension.DISPLACEMENT, digits=4)}, "
            f"{100 * (stated / geometric - 1.0):+.3g} % from the geometry",
            f"{shown} within 1 % (pistons x piston area x stroke, Eq. (6))",
            f"displacement = '{shown}', or pitch_radius = '{fitting}'",
        )


@needs("pump.pistons", "slipper.land_outer_radius", *_DRIVE)
def slippers_clear_each_other(pump: PumpDescription) -> Iterator[Finding]:
    """Two slippers are narrower than the smallest distance of neighbouring ball centres on the swash plate.

    With a cone the ball centres approach each other at the inner dead centre, r = R/(1 + tan(cone) tan(swash) cos phi).
    """
    drive = _drive(pump)
    if drive is None:
        return
    pitch = min(_ball_pitch(drive, pump.pump.pistons), 2 * drive.pitch_radius * math.sin(math.pi / pump.pump.pistons))
    overlap = 2 * pump.slipper.land_outer_radius - pitch
    if overlap >= 0.0:
        fitting = length(pump.pump.pitch_radius * 2 * pump.slipper.land_outer_radius / pitch)
        yield Fault(
            "slipper.land_outer_radius",
            f"{length(pump.slipper.land_outer_radius)}: neighbouring slippers overlap by {length(overlap)}",
            f"less than {length(pitch / 2)}, half the smallest distance of neighbouring ball centres",
            f"land_outer_radius below '{length(pitch / 2)}', or pitch_radius above '{fitting}'",
        )


def _ball_pitch(drive: SwashDrive, pistons: int) -> float:
    """Return the smallest distance of neighbouring ball centres over a turn, in m, on the tilted swash plate."""
    phi = np.linspace(0.0, 2 * np.pi, 1441)
    first, second = (_ball_centre(drive, phi + half * np.pi / pistons) for half in (-1, 1))
    return float(np.min(np.hypot(*(first - second))))


def _ball_centre(drive: SwashDrive, phi: np.ndarray) -> np.ndarray:
    """Return ball centres in the plane of the swash plate in m, shape (2, n): bore axes cut by that plane."""
    radius = ball_radius(drive, phi)
    return np.stack([radius * np.cos(phi) / math.cos(drive.swash_angle), radius * np.sin(phi)])


@needs("slipper.land_inner_radius", "slipper.land_outer_radius")
def slipper_land_has_a_width(pump: PumpDescription) -> Iterator[Finding]:
    """The slipper's sealing land runs from a smaller to a larger radius."""
    inner, outer = pump.slipper.land_inner_radius, pump.slipper.land_outer_radius
    if inner >= outer:
        yield Fault("slipper.land_inner_radius", length(inner), f"less than land_outer_radius, {length(outer)}")


@needs("slipper.land_inner_radius", "slipper.land_outer_radius")
def slipper_grooves_lie_in_the_land(pump: PumpDescription) -> Iterator[Finding]:
    """Closed and vented grooves lie between pocket and rim, with land between them."""
    if pump.slipper.land_inner_radius < pump.slipper.land_outer_radius:
        yield from groove_faults(pump.slipper)


def groove_faults(part: SlipperSection) -> Iterator[Fault]:
    """Yield the faults of a slipper's grooves, by the key that gives each."""
    stated = {"grooves": part.grooves or (), "vented_grooves": part.vented_grooves or ()}
    cut = sorted((*groove, key) for key, grooves in stated.items() for groove in grooves)
    last = part.land_inner_radius
    for inner, outer, key in cut:
        found = f"a groove from radius {length(inner)} to {length(outer)}"
        if inner >= outer:
            yield Fault(f"slipper.{key}", found, "an inner radius below the outer one")
        elif inner <= last or outer >= part.land_outer_radius:
            within = f"between {length(last)} and {length(part.land_outer_radius)}, land on both sides"
            yield Fault(f"slipper.{key}", found, within)
        last = max(last, outer)


@needs("slipper.orifice_diameter", "slipper.land_inner_radius")
def orifice_opens_into_the_pocket(pump: PumpDescription) -> Iterator[Finding]:
    """The orifice is narrower than the pocket that it feeds."""
    orifice, pocket = pump.slipper.orifice_diameter, 2 * pump.slipper.land_inner_radius
    if orifice >= pocket:
        yield Fault("slipper.orifice_diameter", length(orifice), f"less than the pocket's diameter, {length(pocket)}")


@needs("pump.piston_diameter", "slipper.land_inner_radius", "slipper.land_outer_radius")
def slipper_is_not_lifted_off(pump: PumpDescription) -> Iterator[Finding]:
    """The hydrostatic force of a parallel slipper at full pocket pressure stays below the piston force."""
    if pump.slipper.land_inner_radius >= pump.slipper.land_outer_radius or any(groove_faults(pump.slipper)):
        return
    balance = pump.slipper.lands.effective_area / (math.pi * pump.pump.piston_diameter**2 / 4)
    if balance > 1.0:
        yield CheckWarning(
            "slipper.land_outer_radius",
            f"hydrostatic balance ratio {balance:.3f} at zero swash angle",
            "1 (above it the pocket lifts the slipper off the swash plate)",
            "reduce the land radii or enlarge the piston",
        )


@needs(
    "valve_plate.land_radius_1", "valve_plate.land_radius_2", "valve_plate.land_radius_3", "valve_plate.land_radius_4"
)
def valve_plate_lands_are_in_order(pump: PumpDescription) -> Iterator[Finding]:
    """The four land radii grow from the shaft outwards."""
    plate = pump.valve_plate
    radii = (plate.land_radius_1, plate.land_radius_2, plate.land_radius_3, plate.land_radius_4)
    for number, (inner, outer) in enumerate(pairwise(radii), start=1):
        if inner >= outer:
            yield Fault(
                f"valve_plate.land_radius_{number + 1}",
                length(outer),
                f"more than land_radius_{number}, {length(inner)} (the radii grow from 1 to 4)",
            )


@needs("valve_plate.land_radius_4", "valve_plate.pads")
def pads_lie_beyond_the_lands(pump: PumpDescription) -> Iterator[Finding]:
    """Bearing pads lie outside the outer land, ring after ring, with gaps between the pads of a ring."""
    last = pump.valve_plate.land_radius_4
    for number, pad in enumerate(pump.valve_plate.pads, start=1):
        path = f"valve_plate.pads.{number}"
        if pad.inner <= last:
            yield Fault(f"{path}.inner", length(pad.inner), f"more than {length(last)}, a gap that case oil fills")
        if pad.outer <= pad.inner:
            yield Fault(f"{path}.outer", length(pad.outer), f"more than inner, {length(pad.inner)}")
        if pad.number * pad.arc >= 2.0 * math.pi * (1.0 - ROUNDING) and pad.number > 1:
            expected = f"less than {angle(2.0 * math.pi / pad.number)}, or one pad of a whole turn"
            yield Fault(f"{path}.arc", f"{pad.number} pads of {angle(pad.arc)}", expected)
        last = max(last, pad.outer)


@needs(
    "valve_plate.land_radius_2",
    "valve_plate.land_radius_3",
    "valve_plate.kidney_pitch_radius",
    "valve_plate.kidney_width",
)
def kidneys_lie_between_the_lands(pump: PumpDescription) -> Iterator[Finding]:
    """The block's kidneys lie between the inner and the outer sealing land, which they may touch."""
    plate = pump.valve_plate
    inner = plate.kidney_pitch_radius - plate.kidney_width / 2
    outer = plate.kidney_pitch_radius + plate.kidney_width / 2
    slack = ROUNDING * plate.kidney_pitch_radius
    if inner < plate.land_radius_2 - slack or outer > plate.land_radius_3 + slack:
        fitting = 2 * min(
            plate.kidney_pitch_radius - plate.land_radius_2, plate.land_radius_3 - plate.kidney_pitch_radius
        )
        yield Fault(
            "valve_plate.kidney_width",
            f"{length(plate.kidney_width)}: kidneys from radius {length(inner)} to {length(outer)}",
            f"kidneys between land_radius_2, {length(plate.land_radius_2)}, and land_radius_3, "
            f"{length(plate.land_radius_3)}",
            f"kidney_width = '{length(fitting)}'" if fitting > 0 else "a kidney_pitch_radius between the two",
        )


@needs("pump.pistons", "valve_plate.kidney_arc")
def kidneys_leave_webs(pump: PumpDescription) -> Iterator[Finding]:
    """A kidney is shorter than its share of the turn, so that a web separates it from the next."""
    share = 2 * math.pi / pump.pump.pistons
    if pump.valve_plate.kidney_arc >= share:
        yield Fault(
            "valve_plate.kidney_arc",
            f"{angle(pump.valve_plate.kidney_arc)}: neighbouring kidneys run into each other",
            f"less than {angle(share)}, a turn divided by {pump.pump.pistons} pistons",
        )


@needs("ports.kidney_area", "valve_plate.kidney_pitch_radius", "valve_plate.kidney_width", "valve_plate.kidney_arc")
@of_sides
def port_opening_fits_the_kidney(pump: PumpDescription) -> Iterator[Finding]:
    """A port opens at most the whole kidney: pitch radius x arc x width, square ends."""
    plate = pump.valve_plate
    largest = plate.kidney_pitch_radius * plate.kidney_arc * plate.kidney_width
    if pump.ports.kidney_area > largest * (1 + ROUNDING):
        limit = format_quantity(largest, Dimension.AREA, digits=4)
        yield Fault(
            "ports.kidney_area",
            format_quantity(pump.ports.kidney_area, Dimension.AREA, digits=4),
            f"at most {limit}, the block kidney with square ends (pitch radius x arc x width)",
            f"kidney_area below '{limit}', or a larger kidney in [valve_plate]",
        )


@needs("pump.pistons", "pump.piston_diameter", "piston.engaged_length", "piston.overhang", *_DRIVE)
def bores_clear_each_other(pump: PumpDescription) -> Iterator[Finding]:
    """Pistons do not meet at their inner ends, where a cone brings their axes together (inner dead centre)."""
    drive = _drive(pump)
    if drive is None:
        return
    travel = drive.stroke_scale / (1.0 + drive.cone_swash_product)
    depth = travel + pump.piston.overhang + pump.piston.engaged_length
    radius = drive.pitch_radius - depth * math.sin(drive.bore_cone_angle)
    pitch = 2 * radius * math.sin(math.pi / pump.pump.pistons)
    if pitch <= pump.pump.piston_diameter:
        yield Fault(
            "pump.piston_diameter",
            f"{length(pump.pump.piston_diameter)}: at their inner ends the piston axes are {length(pitch)} apart",
            f"less than {length(pitch)}, so that the block has a wall between its bores",
            "fewer or smaller pistons, a larger pitch_radius, or a smaller bore_cone_angle",
        )


@needs("piston.engaged_length", "piston.radial_clearance", "pump.piston_diameter", *_DRIVE)
def piston_stays_in_its_bore(pump: PumpDescription) -> Iterator[Finding]:
    """The engaged length left at the outer dead centre is positive; below one diameter the piston tilts freely."""
    drive = _drive(pump)
    if drive is None:
        return
    left = pump.piston.engaged_length - stroke(drive)
    if left < pump.piston.radial_clearance:
        yield Fault(
            "piston.engaged_length",
            f"{length(pump.piston.engaged_length)}: the stroke of {length(stroke(drive))} draws the piston out",
            "more than the stroke at full swash angle",
            f"engaged_length = '{length(stroke(drive) + pump.pump.piston_diameter)}', stroke + one diameter",
        )
    elif left < pump.pump.piston_diameter:
        yield CheckWarning(
            "piston.engaged_length",
            f"{length(left)} left in the bore at the outer dead centre",
            f"one piston diameter, {length(pump.pump.piston_diameter)} (side forces grow with the lever)",
            "lengthen the bore, or read the piston's friction near the outer dead centre with care",
        )


@needs("bearings.front_share", "bearings.rear_share")
def bearings_share_the_side_force(pump: PumpDescription) -> Iterator[Finding]:
    """The two bearings bear the whole side force."""
    total = pump.bearings.front_share + pump.bearings.rear_share
    if abs(total - 1.0) > 1e-6:
        yield Fault(
            "bearings.rear_share",
            f"{pump.bearings.rear_share:g}: front_share + rear_share = {total:g}",
            "shares that sum to 1",
            f"rear_share = {1.0 - pump.bearings.front_share:g}",
        )


@needs("bearings.front_position", "bearings.rear_position")
def front_bearing_is_before_the_rear(pump: PumpDescription) -> Iterator[Finding]:
    """Heights over the valve plate grow towards the swash plate, where the front bearing is."""
    front, rear = pump.bearings.front_position, pump.bearings.rear_position
    if front is not None and rear is not None and front <= rear:
        found = f"{length(front)} with a rear bearing at {length(rear)}"
        yield Fault("bearings.front_position", found, "above rear_position: heights over the valve plate")
