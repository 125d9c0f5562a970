"""Place of each film in the pump, for VTU files and pictures.

Pump frame: z along the shaft from valve plate to swash plate with z = 0 on the valve plate, x to the inner dead centre.
The description gives no axial position of the block; it follows from the dead volume, modelled as a straight
prolongation of the bore between valve plate and piston.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import assert_never

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.films.parts import FloatingParts
from system.films.rotor import Rotor, travel
from system.pump.laws.directions import bore_axis, bore_sides, plate_axes
from system.pump.laws.kinematics import ball_radius
from system.pump.lumped import piston_area


def place_of(gap: Gap, rotor: Rotor, parts: FloatingParts, shaft_angle: float) -> Callable[[Array], Array]:
    """Map of a gap's film plane (n, 2) m to its place in the pump (n, 3) m at a shaft angle (rad)."""
    match gap:
        case Gap.PISTON:
            frame = guide_frame(rotor, parts.piston.guide_length, shaft_angle)
            return partial(frame.cylinder, radius=0.5 * rotor.pump.pump.piston_diameter)
        case Gap.SLIPPER:
            return face_frame(rotor, parts.slipper.ball_height, shaft_angle).plane
        case Gap.VALVE_PLATE:
            return rotor.pump.valve_plate.sphere.in_space
    assert_never(gap)


def guide_frame(rotor: Rotor, guide_length: float, shaft_angle: float) -> Frame:
    """Frame of a piston's film: origin on the bore axis at the guide's inner end, fixed in the block.

    guide_length m, from the bore's case edge inwards.
    """
    axis = bore_axis(rotor.drive, shaft_angle)
    depth = rotor.pump.piston.overhang + travel(rotor, shaft_angle) + guide_length
    x, y = bore_sides(rotor.drive, shaft_angle)
    return Frame(ball_centre(rotor, shaft_angle) - depth * axis, x, y, axis)


def face_frame(rotor: Rotor, ball_height: float, shaft_angle: float) -> Frame:
    """Frame of a slipper's film: under the ball, `ball_height` (m) beyond it, along the plate's axes."""
    steepest, across, normal = plate_axes(rotor.drive)
    return Frame(ball_centre(rotor, shaft_angle) + ball_height * normal, steepest, across, normal)


def ball_centre(rotor: Rotor, shaft_angle: Array | float) -> Array:
    """Centre (..., 3) m of a ball joint in the pump frame at shaft angles (...) rad."""
    radius, height = ball_radius(rotor.drive, shaft_angle), _ball_height(rotor, shaft_angle)
    return np.stack([radius * np.cos(shaft_angle), radius * np.sin(shaft_angle), height], axis=-1)


def _ball_height(rotor: Rotor, shaft_angle: Array | float) -> Array:
    """Height of the ball centre over the valve plate (...) m: dead space, guide and overhang along the bore."""
    pump = rotor.pump
    dead = pump.pump.dead_volume / piston_area(pump)
    reach = dead + pump.piston.engaged_length + pump.piston.overhang + travel(rotor, shaft_angle)
    return np.asarray(reach * np.cos(pump.pump.bore_cone_angle))


@dataclass(frozen=True)
class Frame:
    """Origin (m) and three orthonormal directions of a gap in the pump's frame, (3,) each.

    Pump frame: z is the shaft axis from valve plate to swash plate, the valve plate's face lies at z = 0 and x
    points to the inner dead centre.
    """

    origin: Array
    x: Array
    y: Array
    z: Array

    def plane(self, points: Array) -> Array:
        """Points (n, 2) m of a plane film -> (n, 3) m in the pump."""
        return self.origin + points[:, :1] * self.x + points[:, 1:] * self.y

    def cylinder(self, points: Array, radius: float) -> Array:
        """Points (n, 2) m of an unwrapped film (arc, axial) -> (n, 3) m on the cylinder about z in the pump."""
        angle = points[:, :1] / radius
        return self.origin + radius * (np.cos(angle) * self.x + np.sin(angle) * self.y) + points[:, 1:] * self.z

    def space(self, points: Array) -> Array:
        """Points (n, 3) m of a body in these axes -> (n, 3) m in the pump."""
        return self.origin + points @ np.stack([self.x, self.y, self.z])
