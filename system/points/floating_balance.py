"""Balance of forces on a gap without equilibrium: pressing force, lift of its lands, a dimension that restores it.

The lands of a film lift by the chamber's pressure on them; wedge and squeeze bear the rest of the pressing force. A
part whose lands lift far less than the pressing force sinks, one whose lands lift more flies off.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from gaps.films.block import BlockDrive
from gaps.films.piston import PistonDrive
from gaps.films.slipper import SlipperDrive
from gaps.loads.block_tipping import BlockBalance
from system.description.pump import PumpDescription
from system.films.rotor import Rotor, valve_plate_geometry
from system.inputs.units import Dimension, format_quantity
from system.pump.lumped import piston_area

WIDEST = 1.5  # times: largest change of a radius that is proposed
ANGLES = 360  # of a turn, over which a pull is sought
TRIED = 500  # radii up to that


@dataclass(frozen=True)
class Shortfall:
    """Force that a film lacks, and the remedy, each as a clause of a sentence."""

    what: str
    remedy: str


def slipper_shortfall(rotor: Rotor, drive: SlipperDrive, angle: float) -> Shortfall:
    """Force on a slipper at a shaft angle (rad), less the lift of its lands at the chamber's pressure.

    Where a force above its retainer's pulls it off its plate before, that alone is named. The remedy is the outer
    radius at which the lands of a parallel film lift all of it (`SlipperLands.effective_area`).
    """
    if (pulled := _pulled_off(drive)) is not None:
        return pulled
    slipper = rotor.pump.slipper
    above = float(drive.chamber_pressure(angle)) - drive.case_pressure
    force, tilting_x, tilting_y = np.asarray(drive.outer(angle))
    pressed, now = -float(force), slipper.land_outer_radius
    if pressed <= 0.0:
        return Shortfall(
            f"at {_degrees(angle)} nothing presses the slipper on: {_force(-pressed)} pull it off its plate, which its "
            "retainer takes",
            "a smaller retainer.clearance, or a stiffer spring (ball_guide.spring_preload)",
        )
    place = math.hypot(tilting_x, tilting_y) / pressed * now
    what = f"at {_degrees(angle)} {_of_force(pressed, above * slipper.lands.effective_area)}"

    def missing(radius: float) -> float:
        return above * replace(slipper, land_outer_radius=radius).lands.effective_area - pressed

    least, most = 1.01 * slipper.land_inner_radius, WIDEST * now
    if missing(least) * missing(most) >= 0.0:
        mended = f"another slipper.land_outer_radius than {_length(now)}"
    else:
        mended = (
            f"slipper.land_outer_radius near {_length(float(brentq(missing, least, most)))} instead of "
            f"{_length(now)}: there its lands lift all of it"
        )
    return Shortfall(f"{what} {_length(place)} from its middle", mended)


def _pulled_off(drive: SlipperDrive) -> Shortfall | None:
    """The largest pull of a slipper off its plate over the turn, if no retainer holds it."""
    angles = np.linspace(0.0, 2.0 * np.pi, ANGLES, endpoint=False)
    lift = np.array([-float(np.asarray(drive.outer(angle))[0]) for angle in angles])
    worst = int(np.argmin(lift))
    holds = 0.0 if drive.retainer is None else drive.retainer.limit
    if -lift[worst] <= holds:
        return None
    pulled = f"at {_degrees(float(angles[worst]))} the slipper is pulled off its plate with {_force(-lift[worst])}"
    if drive.retainer is None:
        return Shortfall(f"{pulled}, and no retainer holds it", "a retainer")
    return Shortfall(
        f"{pulled} beyond the spring's share, and the retainer lifts off from {_force(holds)} on",
        "a stiffer spring (ball_guide.spring_preload), or retainer.kind = 'clearance'",
    )


def block_shortfall(rotor: Rotor, drive: BlockDrive, angle: float) -> Shortfall:
    """Force and its place on the block at a shaft angle (rad), less the lift of its lands at the chambers' pressures.

    The remedies are the spring's force with which the remaining force acts within the outermost land, and the outer
    radius of the lands with which it does (`gaps.loads.block_tipping`).
    """
    pump, plate = rotor.pump, rotor.pump.valve_plate
    chambers = valve_plate_geometry(pump).kidney_places(angle)
    above = np.array([_chamber(drive, k, float(at)) for k, at in enumerate(chambers)]) - drive.case_pressure
    pressing = np.asarray(drive.press(angle))

    def left(outer: float) -> tuple[BlockBalance, float, float]:
        balance = _balance(pump, outer, drive.spline_height)
        force, about_x, about_y = pressing + balance.lift(chambers, above)
        return balance, -float(force), math.hypot(about_x, about_y)

    now = plate.land_radius_4
    balance, force, moment = left(now)
    pressed = -float(pressing[0])
    what = f"at {_degrees(angle)} {_of_force(pressed, pressed - force)}"
    place, rim = balance.pressed_by(force, moment), plate.outer_radius
    if force <= 0.0:
        return Shortfall(f"{what}: it lifts off", f"a spring stronger by {_force(-force)}, or narrower lands")
    if place <= rim:
        return Shortfall(
            f"{what} {_length(place)} from the shaft", f"a larger valve_plate.land_radius_4 than {_length(now)}"
        )
    spring = balance.force_within(rim, moment) - force
    remedies = [f"ball_guide.spring_preload larger by {_force(spring)}"]
    for radius in np.linspace(now, WIDEST * now, TRIED)[1:]:
        wider, rest, tipping = left(float(radius))
        if rest > 0.0 and wider.pressed_by(rest, tipping) <= rim + radius - now:
            remedies.append(f"valve_plate.land_radius_4 of {_length(float(radius))} instead of {_length(now)}")
            break
    outside = f"{what} {_length(place)} from the shaft, outside its face of {_length(rim)}: it tips"
    return Shortfall(outside, ", or ".join(remedies))


def piston_shortfall(rotor: Rotor, drive: PistonDrive, angle: float) -> Shortfall:
    """Forces across the bore at both ends of the guide at a shaft angle (rad), which the film has to bear."""
    part, outer = rotor.pump.piston, np.asarray(drive.outer(angle))
    inner, case = float(np.hypot(*outer[:2])), float(np.hypot(*outer[2:]))
    guide = part.guide_length or part.engaged_length
    mean = float(np.hypot(*(outer[:2] + outer[2:]))) / (guide * rotor.pump.pump.piston_diameter)
    over = format_quantity(mean, Dimension.PRESSURE, digits=3)
    what = (
        f"at {_degrees(angle)} the film has to raise {_force(inner)} at the inner end of its guide and {_force(case)} "
        f"at the case edge (in the mean {over} over its length and width)"
    )
    remedy = (
        f"piston.engaged_length above {_length(part.engaged_length)}, piston.overhang below "
        f"{_length(part.overhang)}, or edge reliefs"
    )
    return Shortfall(what, remedy)


def _chamber(drive: BlockDrive, number: int, angle: float) -> float:
    """Pressure (Pa) of a chamber at its own angle."""
    return float(np.broadcast_to(drive.chamber_pressure(angle), (number + 1,))[number])


def _balance(pump: PumpDescription, outer: float, spline_height: float) -> BlockBalance:
    plate = pump.valve_plate
    radii = (plate.land_radius_1, plate.land_radius_2, plate.land_radius_3, outer)
    return BlockBalance(
        radii, pump.pump.pistons, piston_area(pump), pump.pump.pitch_radius, plate.sphere, spline_height
    )


def _of_force(pressed: float, lifted: float) -> str:
    if pressed <= 0.0:
        return f"{_force(-pressed)} pull it off its plate, its lands lift {_force(lifted)}"
    return (
        f"{_force(pressed)} press on, its lands lift {_force(lifted)} ({100.0 * lifted / pressed:.3g} %), and the film "
        f"has to raise {_force(pressed - lifted)}"
    )


def _force(value: float) -> str:
    return format_quantity(value, Dimension.FORCE, digits=4)


def _length(value: float) -> str:
    return format_quantity(value, Dimension.LENGTH, digits=4)


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.4g} deg"
