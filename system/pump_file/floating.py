"""Checks of a pump with floating gaps: can its parts have a film in equilibrium? Warnings: a run decides."""

import math
from collections.abc import Iterator

from gaps.loads.block_tipping import BlockBalance
from system.description.pump import PumpDescription
from system.films.parts import ball_plane_height
from system.pump.lumped import block_spring, piston_area
from system.pump_file.check import CheckReport, CheckWarning, Finding, length, needs, pressure, run_checks


@needs("pump.rated_pressure", "valve_plate.land_radius_1", "valve_plate.land_radius_4")
def block_tips(pump: PumpDescription) -> Iterator[Finding]:
    """The pistons' force that a parallel film does not balance acts within the valve plate's outermost face.

    At rated pressure and full swash angle, spring included (`gaps.loads.block_tipping`).
    """
    plate, case = pump.valve_plate, pump.operating.case_pressure
    radii = (plate.land_radius_1, plate.land_radius_2, plate.land_radius_3, plate.land_radius_4)
    stated = pump.block.spline_position
    block = BlockBalance(
        radii, pump.pump.pistons, piston_area(pump), pump.pump.pitch_radius, plate.sphere,
        ball_plane_height(pump) if stated is None else stated,
    )  # fmt: skip
    delivery, suction = pump.pump.rated_pressure - case, pump.operating.inlet_pressure - case
    place = block.pressed_at(delivery, suction, block_spring(pump))
    if place <= plate.outer_radius:
        return
    at_rated = f"at {pressure(pump.pump.rated_pressure)} the film's lift is {block.force_ratio:.3f} of the pistons'"
    if math.isinf(place):
        yield CheckWarning(
            "valve_plate.land_radius_4", f"block lifts off: {at_rated} force", "1", "narrower lands or a spring"
        )
        return
    yield CheckWarning(
        "valve_plate.land_radius_4",
        f"block tips: {at_rated} force, {length(block.lift_radius)} from the shaft, so that the rest presses at "
        f"{length(place)}",
        f"{length(plate.outer_radius)} (the outermost land or pad: beyond it no film bears)",
        f"lands about the pitch radius, {length(pump.pump.pitch_radius)}, or outer bearing pads",
    )


@needs("slipper.land_outer_radius")
def slipper_has_a_wedge(pump: PumpDescription) -> Iterator[Finding]:
    """A flat slipper held at its middle draws no oil under it: without hydrostatic lift it sinks."""
    part = pump.slipper
    relieved = part.rim_relief is not None and part.rim_relief.depth > 0.0
    if part.profile is None and part.crown is None and not relieved:
        yield CheckWarning(
            "slipper.profile",
            "a flat face",
            "a face with a shape (a flat one has no wedge: it sinks until it touches)",
            "profile, crown or rim_relief, such as { width = '3 mm', depth = '2 um' }",
        )


FLOATING_CHECKS = (block_tips, slipper_has_a_wedge)


def check_floating(pump: PumpDescription) -> CheckReport:
    """Return the doubtful values of a pump with floating gaps, besides the findings of `check_pump`."""
    return run_checks(FLOATING_CHECKS, pump)
