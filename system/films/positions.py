"""Positions of the parts by the pump file: eccentricity, film thicknesses, tilts; and the drives at one angle."""

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.films.drives import Drives, drives, no_rubbing
from system.films.parts import FloatingParts
from system.films.rotor import Rotor
from system.pump.laws.kinematics import slipper_sliding_velocity

NO_RUBBING = "friction of the films on the parts: left out of the forces between them (one gap alone)"


def eccentric(clearance: float, ratio: float, outer: Array) -> Array:
    """A piston parallel to its bore, displaced by `ratio` of its clearance (m) along forces (4,) N: (4,) m."""
    across = np.asarray(outer).reshape(2, 2).sum(axis=0)
    return np.tile(ratio * clearance * across / max(float(np.hypot(*across)), 1e-300), 2)


def given_piston(pump: PumpDescription, outer: Array) -> Array:
    """Eccentricities (4,) m of `piston.eccentricity_ratio`, in the direction of the forces (4,) N."""
    return eccentric(pump.piston.radial_clearance, pump.piston.eccentricity_ratio, outer)


def given_slipper(rotor: Rotor, shaft_angle: float) -> Array:
    """Film under the ball and rises (3,) m along the plate's axes; tilts open it outwards and forwards."""
    part = rotor.pump.slipper
    velocity = slipper_sliding_velocity(rotor.drive, shaft_angle, rotor.point.shaft_speed)
    forward = velocity / np.hypot(*velocity)
    outward = np.array([forward[1], -forward[0]])  # to the right of the motion
    slope = np.tan(part.tilt_tangential) * forward + np.tan(part.tilt_radial) * outward
    return np.array([part.film_thickness, *(part.lands.outer_radius * slope)])


def given_block(pump: PumpDescription) -> Array:
    """Film on the shaft's axis and rises (3,) m along the pump's x and y; on a sphere, tilts about the spline."""
    part = pump.valve_plate
    rim = part.land_radius_4
    return np.array([part.film_thickness, rim * np.tan(part.tilt_x), rim * np.tan(part.tilt_y)])


def instant_drives(rotor: Rotor, parts: FloatingParts, shaft_angle: float, pressure: Array) -> Drives:
    """Drives valid at one shaft angle (rad) of chamber 1, without friction of the films.

    pressure (z,) Pa of the chambers, chamber k at shaft angle + (k - 1) pitch; or (1,), of them all.
    """
    pistons = rotor.pump.pump.pistons
    # Twice as many angles as chambers: a course over a turn has four at least.
    angles = np.asarray(shaft_angle + np.pi / pistons * np.arange(2 * pistons), dtype=float)
    chambers = np.broadcast_to(pressure, pistons)[np.arange(2 * pistons) // 2]
    return drives(rotor, parts, angles, chambers, no_rubbing(2 * pistons))
