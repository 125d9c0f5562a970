"""What each gap meets at each shaft angle: states, loads and given positions, from description and kinematics."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gaps.ball_joint import Spins
from gaps.piston import PistonGeometry, PistonLoad, PistonState, eccentric
from gaps.slipper import SlipperGeometry, SlipperLoad, SlipperPosition, SlipperState
from gaps.valve_plate import ValvePlateGeometry, ValvePlatePosition, ValvePlateState
from system import pairs
from system.chamber_kernel import CAVITY_PRESSURE
from system.description import PumpDescription
from system.directions import plate_force, side_force
from system.kinematics import (
    Array,
    SwashDrive,
    ball_acceleration_along_bore,
    drive_at_ratio,
    piston_displacement,
    piston_velocity,
    slipper_acceleration,
    slipper_sliding_velocity,
    stand_out,
)
from system.lumped import block_spring, full_drive, piston_area
from system.operating import OperatingPoint
from system.spins import spins


@dataclass(frozen=True)
class Rotor:
    """A pump at an operating point, its drive set to the displacement ratio."""

    pump: PumpDescription
    point: OperatingPoint
    full: SwashDrive
    drive: SwashDrive

    @cached_property
    def spins(self) -> Spins:
        """Spins of piston and slipper (`system.spins`)."""
        return spins(self.pump, self.point, self.drive)


def rotor(pump: PumpDescription, point: OperatingPoint) -> Rotor:
    """The rotating group of a pump at an operating point."""
    full = full_drive(pump)
    return Rotor(pump, point, full, drive_at_ratio(full, point.displacement_ratio))


def travel(rotor: Rotor, shaft_angle: float) -> float:
    """Way of the piston (m) beyond its innermost place at full displacement."""
    return stand_out(rotor.full, rotor.drive) + float(piston_displacement(rotor.drive, shaft_angle))


def axial_force(rotor: Rotor, shaft_angle: float, chamber_pressure: float) -> float:
    """Fa = Ap (p - p_case) - m a (N) on piston with slipper, towards the swash plate."""
    mass = rotor.pump.piston.mass + rotor.pump.slipper.mass
    acceleration = ball_acceleration_along_bore(rotor.drive, shaft_angle, rotor.point.shaft_speed)
    area = piston_area(rotor.pump)
    return float(
        pairs.axial_force(np.asarray(chamber_pressure), rotor.point.case_pressure, area, mass, acceleration)
    )


def piston_geometry(pump: PumpDescription) -> PistonGeometry:
    """The piston gap's geometry."""
    return PistonGeometry(pump.pump.piston_diameter, pump.piston.radial_clearance)


def piston_instant(
    rotor: Rotor, shaft_angle: float, chamber_pressure: float
) -> tuple[PistonState, PistonLoad, Array]:
    """State, side force and given position of the piston; the plate pushes it away from inner dead centre.

    The plate's exact force across the bore at the ball (`directions.side_force`; the nominal pair losses keep
    REF90's |Fa| tan(gamma)). Left out: centrifugal force of the piston (its centre of mass is not in the
    description) and the ball joint's friction moment.
    """
    pump, point, out = rotor.pump, rotor.point, travel(rotor, shaft_angle)
    state = PistonState(
        engaged_length=pump.piston.engaged_length - out,
        chamber_pressure=chamber_pressure,
        case_pressure=point.case_pressure,
        cavitation_pressure=CAVITY_PRESSURE,
        viscosity=point.viscosity,
        velocity=float(piston_velocity(rotor.drive, shaft_angle, point.shaft_speed)),
        piston_spin=point.shaft_speed + rotor.spins.piston,
        bore_spin=point.shaft_speed,
    )
    x, y = side_force(rotor.drive, shaft_angle, axial_force(rotor, shaft_angle, chamber_pressure))
    load = PistonLoad((float(x), float(y)), pump.piston.overhang + out)
    return state, load, eccentric(piston_geometry(pump), pump.piston.eccentricity_ratio, load.force)


def slipper_geometry(pump: PumpDescription) -> SlipperGeometry:
    """The slipper gap's geometry."""
    part = pump.slipper
    return SlipperGeometry(part.lands, part.orifice_diameter, part.orifice_length)


def slipper_instant(
    rotor: Rotor, shaft_angle: float, chamber_pressure: float
) -> tuple[SlipperState, SlipperLoad, SlipperPosition]:
    """State, load and given position of the slipper, x along its sliding velocity.

    The plate's normal force plus a share of the spring; the film holds the moment of the slipper's centrifugal
    force about the ball joint. Left out: friction on the land (the ball's height above it is not in the
    description) and the ball joint's friction moment.
    """
    pump, point, drive = rotor.pump, rotor.point, rotor.drive
    velocity = slipper_sliding_velocity(drive, shaft_angle, point.shaft_speed)
    forward = velocity / np.hypot(*velocity)
    left = np.array([-forward[1], forward[0]])
    outward_force = -pump.slipper.mass * slipper_acceleration(drive, shaft_angle, point.shaft_speed)
    held = -pump.slipper.centre_of_mass_to_ball * outward_force  # integral of p (x, y) dA
    state = SlipperState(
        chamber_pressure=chamber_pressure,
        case_pressure=point.case_pressure,
        cavitation_pressure=CAVITY_PRESSURE,
        viscosity=point.viscosity,
        sliding_speed=float(np.hypot(*velocity)),
        spin=rotor.spins.slipper,
    )
    spring = block_spring(pump) / (pump.pump.pistons * np.cos(drive.swash_angle))
    press = plate_force(drive, shaft_angle, axial_force(rotor, shaft_angle, chamber_pressure)) + spring
    load = SlipperLoad(float(press), float(held @ left), -float(held @ forward))
    # Outward is to the right of the motion.
    given = SlipperPosition(
        pump.slipper.film_thickness, np.tan(pump.slipper.tilt_tangential), -np.tan(pump.slipper.tilt_radial)
    )
    return state, load, given


def valve_plate_geometry(pump: PumpDescription, turned: float = 0.0) -> ValvePlateGeometry:
    """The valve plate's ring; its ports' arcs follow from the opening angles and the block kidney's arc.

    A port opens when the kidney's leading edge reaches it (end of the groove) and shuts when the trailing edge
    leaves it. `turned` (rad): the drive's `dead_centre_shift`, of no matter where radii alone are asked for.
    """
    part, ports = pump.valve_plate, pump.ports
    half = 0.5 * part.kidney_arc
    arc = (ports.groove_end + half, ports.kidney_end - half)
    return ValvePlateGeometry(
        land_radii=(part.land_radius_1, part.land_radius_2, part.land_radius_3, part.land_radius_4),
        pistons=pump.pump.pistons,
        kidney_arc=part.kidney_arc,
        suction_arc=arc,
        delivery_arc=(arc[0] + np.pi, arc[1] + np.pi),
        webs=tuple((start + dead, end + dead) for dead in (0.0, np.pi) for start, end in ports.web_spans),
        turned=turned,
        pads=part.bearing_pads,
        sphere=part.sphere,
    )


def valve_plate_instant(
    rotor: Rotor, shaft_angle: float, chamber_pressure: Array
) -> tuple[ValvePlateState, ValvePlatePosition, float]:
    """State, given position and pressing force (N: pistons and spring) of the block; pressures (z,) by chamber."""
    pump, point = rotor.pump, rotor.point
    state = ValvePlateState(
        shaft_angle=shaft_angle,
        chamber_pressure=chamber_pressure,
        suction_pressure=point.inlet_pressure,
        delivery_pressure=point.delivery_pressure,
        case_pressure=point.case_pressure,
        cavitation_pressure=CAVITY_PRESSURE,
        viscosity=point.viscosity,
        shaft_speed=point.shaft_speed,
    )
    part = pump.valve_plate
    given = ValvePlatePosition(part.film_thickness, np.tan(part.tilt_x), np.tan(part.tilt_y))
    above = np.sum(np.asarray(chamber_pressure) - point.case_pressure)
    press = piston_area(pump) * float(above) * np.cos(pump.pump.bore_cone_angle) + block_spring(pump)
    return state, given, press
