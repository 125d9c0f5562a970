"""Where each film stands in the pump, for VTU files and pictures.

Pump frame: z along the shaft from valve plate to swash plate with z = 0 on the valve plate, x to the inner dead
centre. The description gives no axial position of the block; it follows from the dead volume, taken as a
straight prolongation of the bore between valve plate and piston.
"""

from __future__ import annotations

import numpy as np

from gaps.frames import Frame
from system.directions import bore_axis, bore_sides, plate_axes
from system.instants import Rotor, travel
from system.kinematics import Array, ball_radius, slipper_sliding_velocity
from system.lumped import piston_area


def bore_frame(rotor: Rotor, shaft_angle: float) -> Frame:
    """Frame of the piston film: origin on the bore axis at the chamber's end of the engaged length."""
    axis = bore_axis(rotor.drive, shaft_angle)
    reach = rotor.pump.piston.engaged_length + rotor.pump.piston.overhang
    x, y = bore_sides(rotor.drive, shaft_angle)
    return Frame(ball_centre(rotor, shaft_angle) - reach * axis, x, y, axis)


def slipper_frame(rotor: Rotor, shaft_angle: float) -> Frame:
    """Frame of the slipper film: origin under the ball centre on the swash plate, x along the sliding velocity."""
    steepest, across, normal = plate_axes(rotor.drive)
    velocity = slipper_sliding_velocity(rotor.drive, shaft_angle, rotor.point.shaft_speed)
    forward = (velocity[0] * steepest + velocity[1] * across) / np.hypot(*velocity)
    # The sliding face lies beyond the ball by about the distance of the slipper's centre of mass.
    face = ball_centre(rotor, shaft_angle) + rotor.pump.slipper.centre_of_mass_to_ball * normal
    return Frame(face, forward, np.cross(normal, forward), normal)


def guide_frame(rotor: Rotor, guide_length: float, shaft_angle: float) -> Frame:
    """Frame of a floating piston's film: origin on the bore axis at the guide's inner end, fixed in the block.

    guide_length m, from the bore's case edge inwards.
    """
    axis = bore_axis(rotor.drive, shaft_angle)
    depth = rotor.pump.piston.overhang + travel(rotor, shaft_angle) + guide_length
    x, y = bore_sides(rotor.drive, shaft_angle)
    return Frame(ball_centre(rotor, shaft_angle) - depth * axis, x, y, axis)


def face_frame(rotor: Rotor, ball_height: float, shaft_angle: float) -> Frame:
    """Frame of a floating slipper's film: under the ball, `ball_height` (m) beyond it, along the plate's axes."""
    steepest, across, normal = plate_axes(rotor.drive)
    return Frame(ball_centre(rotor, shaft_angle) + ball_height * normal, steepest, across, normal)


def ball_centre(rotor: Rotor, shaft_angle: float) -> Array:
    """Centre (3,) m of a ball joint in the pump frame."""
    radius = float(ball_radius(rotor.drive, shaft_angle))
    height = _ball_height(rotor, shaft_angle)
    return np.array([radius * np.cos(shaft_angle), radius * np.sin(shaft_angle), height])


def _ball_height(rotor: Rotor, shaft_angle: float) -> float:
    """Height of the ball centre over the valve plate (m): dead space, guide and overhang along the bore."""
    pump = rotor.pump
    dead = pump.pump.dead_volume / piston_area(pump)
    reach = dead + pump.piston.engaged_length + pump.piston.overhang + travel(rotor, shaft_angle)
    return float(reach * np.cos(pump.pump.bore_cone_angle))
