"""Solids of a pump's parts, by its sizes, in the pump's frame (`system.films.places`), m.

Sizes are those of the pump file, or those assumed for elastic walls. For all others the picture has usual proportions:
neck of the piston, collar and pocket's depth of the slipper, diameter of the shaft. Bores and kidneys are straight, so
that no oil passage connects them; ports are sectors. Own meshes of parts are not shown.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gaps.walls.pair import BoreWalls, PlateWalls
from gaps.walls.parts import PlatePart, SlipperPart
from reynolds.fem.sphere import Sphere
from swashfilm.runs.pump.scene.surfaces import (
    TURN,
    Bores,
    Height,
    Surface,
    joined,
    revolved,
    ring_with_bores,
    ring_with_openings,
    round_angles,
)
from system.films.parts import FloatingParts
from system.films.places import Frame, ball_centre, face_frame
from system.films.rotor import Rotor, travel, valve_plate_geometry
from system.pump.laws.directions import bore_axis, bore_sides
from system.pump.lumped import piston_area

NECK = 0.7  # of the ball's radius: the neck's
COLLAR, COLLAR_END = 1.25, 0.3  # of the ball's radius: the slipper's collar, and its end behind the ball's centre
POCKET = 0.05  # of the flange's thickness: the pocket's depth
SHAFT = 0.4  # of the rear bearing's mean diameter: the shaft's radius
DEAD_END = 0.9  # of the dead space's length along the bore: the largest thickness of the block's end
RIM = 1.1  # of a slipper's radius, from the slippers' middles to the edges of the swash plate
ARC = 9  # points on the outline of a ball


@dataclass(frozen=True)
class Solids:
    """The solids of a pump whose chambers have the pistons and slippers of one kind."""

    rotor: Rotor
    parts: FloatingParts

    def piston(self, shaft_angle: float) -> Surface:
        """A piston with its ball, its chamber at a shaft angle (rad)."""
        return self._piston.in_space(self._at_ball(shaft_angle).space)

    def oil(self, shaft_angle: float) -> Surface:
        """The oil between a piston and the block's end, its chamber at a shaft angle (rad)."""
        pump = self.rotor.pump
        length = self._dead_length + travel(self.rotor, shaft_angle) - self._end / np.cos(pump.pump.bore_cone_angle)
        end = -(pump.piston.engaged_length + pump.piston.overhang)
        radius = 0.5 * pump.pump.piston_diameter
        outline = np.array([[0.0, end - length], [radius, end - length], [radius, end], [0.0, end]])
        return revolved(outline, 24).in_space(self._at_ball(shaft_angle).space)

    def slipper(self, shaft_angle: float) -> Surface:
        """A slipper with its face on the swash plate, its chamber at a shaft angle (rad)."""
        frame = face_frame(self.rotor, self.parts.slipper.ball_height, shaft_angle)
        return self._slipper.in_space(frame.space)

    def block(self, shaft_angle: float) -> Surface:
        """The cylinder block with bores and kidneys, the bore of chamber 1 at a shaft angle (rad)."""
        c, s = np.cos(shaft_angle), np.sin(shaft_angle)
        turned = Frame(np.zeros(3), np.array([c, s, 0.0]), np.array([-s, c, 0.0]), np.array([0.0, 0.0, 1.0]))
        return self._block.in_space(turned.space)

    def swash_plate(self) -> Surface:
        """The swash plate: a ring as wide as the slippers' way, square to the plate's normal."""
        frame, rim = self._plate_frame, self.rotor.pump.slipper.land_outer_radius
        faces = [
            face_frame(self.rotor, self.parts.slipper.ball_height, angle).origin
            for angle in np.linspace(0.0, TURN, 72, endpoint=False)
        ]
        ways = np.linalg.norm(np.array(faces) - frame.origin, axis=1)
        inner, outer = max(ways.min() - RIM * rim, self.shaft_radius), ways.max() + RIM * rim
        depth = self._plate_part.thickness
        outline = np.array([[inner, 0.0], [outer, 0.0], [outer, depth], [inner, depth]])
        return revolved(outline, 72).in_space(frame.space)

    def valve_plate(self) -> Surface:
        """The valve plate with its ports."""
        geometry = valve_plate_geometry(self.rotor.pump, float(self.rotor.drive.dead_centre_shift))
        ports, part = (*geometry.suction, *geometry.delivery), self._valve_plate
        _, r2, r3, _ = geometry.land_radii
        angles = round_angles([edge for port in ports for edge in port])
        middle = angles + 0.5 * np.diff(np.append(angles, angles[0] + TURN))
        solid = np.ones((3, len(angles)), dtype=bool)
        solid[1] = [all((at - start) % TURN > end - start for start, end in ports) for at in middle]
        radii, face = np.array([part.inner_radius, r2, r3, part.outer_radius]), _face(geometry.sphere)
        return ring_with_openings(radii, angles, solid, lambda r: face(r) - part.thickness, face)

    def shaft(self) -> Surface:
        """The shaft, a plain cylinder from a radius outside the valve plate to a radius behind the swash plate."""
        frame, radius = self._plate_frame, self.shaft_radius
        low = -self._valve_plate.thickness - radius
        high = float(frame.origin[2]) + self._plate_part.thickness / float(frame.z[2]) + radius
        return revolved(np.array([[0.0, low], [radius, low], [radius, high], [0.0, high]]))

    @cached_property
    def shaft_radius(self) -> float:
        """Radius (m) of the shaft, and of the hole in the block."""
        inside = self._bores.pitch_radius + self._end * np.tan(self._bores.cone) - self._bores.radius
        return float(min(SHAFT * self.rotor.pump.bearings.rear_diameter, max(0.9 * inside, 0.2 * self._bores.radius)))

    @cached_property
    def block_heights(self) -> tuple[float, float]:
        """Heights (m) over the valve plate of the bores' ends and of the block's case edge."""
        length = self._dead_length + self.rotor.pump.piston.engaged_length
        return self._end, float(length * np.cos(self.rotor.pump.pump.bore_cone_angle))

    @cached_property
    def block_radii(self) -> tuple[float, float]:
        """Inner and outer radius (m) of the block."""
        bores, wall = self._bores, self._bore_walls.bushing.wall
        at_edge = bores.pitch_radius + self.block_heights[1] * np.tan(bores.cone) + bores.radius / np.cos(bores.cone)
        return self.shaft_radius, float(max(at_edge + wall, self._block_end.outer_radius))

    @cached_property
    def _piston(self) -> Surface:
        """The piston about its ball's centre, z out of the block."""
        part, ball = self.rotor.pump.piston, self.rotor.pump.slipper.ball_joint_radius
        sizes = self._bore_walls.piston
        radius, inner, end = 0.5 * sizes.diameter, 0.5 * sizes.inner_diameter, -(part.engaged_length + part.overhang)
        neck = NECK * ball
        meets = -min(np.sqrt(ball**2 - neck**2), part.overhang)
        polar = np.linspace(np.arcsin(meets / ball), 0.5 * np.pi, ARC)
        arc = np.column_stack([ball * np.cos(polar), ball * np.sin(polar)])
        arc[-1, 0] = 0.0
        outline = [[inner, end], [radius, end], [radius, -part.overhang], [arc[0, 0], -part.overhang], *arc]
        if inner > 0.0:
            floor = end + max(part.engaged_length - (radius - inner), 0.0)
            outline += [[0.0, floor], [inner, floor]]
        return revolved(np.array(outline))

    @cached_property
    def _slipper(self) -> Surface:
        """The slipper about the middle of its face, z towards the swash plate."""
        part = self._slipper_part
        ball, height = self.rotor.pump.slipper.ball_joint_radius, self.parts.slipper.ball_height
        end = height + COLLAR_END * ball
        flange = min(part.thickness, 0.95 * end)
        depth, collar = POCKET * flange, min(COLLAR * ball, part.outer_radius)
        polar = np.linspace(0.5 * np.pi, -np.arcsin(COLLAR_END), 2 * ARC)
        over = np.minimum(ball * np.sin(polar) - height, -2.0 * depth)
        socket = np.column_stack([ball * np.cos(polar), over])
        socket[0, 0] = 0.0
        outline = [
            [collar, -end], [collar, -flange], [part.outer_radius, -flange], [part.outer_radius, 0.0],
            [part.pocket_radius, 0.0], [part.pocket_radius, -depth], [0.0, -depth], *socket,
        ]  # fmt: skip
        return revolved(np.array(outline))

    @cached_property
    def _block(self) -> Surface:
        """The block with the bore of chamber 1 towards x: the end with its kidneys, and the barrel with its bores."""
        geometry, (inner, outer) = valve_plate_geometry(self.rotor.pump), self.block_radii
        _, r2, r3, _ = geometry.land_radii
        half = 0.5 * geometry.kidney_arc
        middles = geometry.kidney_places(0.0)
        angles = round_angles([edge for at in middles for edge in (at - half, at + half)])
        middle = angles + 0.5 * np.diff(np.append(angles, angles[0] + TURN))
        away = np.abs((middle[:, None] - middles + np.pi) % TURN - np.pi).min(axis=1)
        solid = np.ones((3, len(angles)), dtype=bool)
        solid[1] = away > half
        level: Height = lambda r: np.full_like(r, self._end)  # noqa: E731
        end = ring_with_openings(np.array([inner, r2, r3, outer]), angles, solid, _face(geometry.sphere), level)
        return joined([end, ring_with_bores((inner, outer), self.block_heights, self._bores)])

    @cached_property
    def _bores(self) -> Bores:
        pump, centre = self.rotor.pump.pump, ball_centre(self.rotor, 0.0)
        cone = pump.bore_cone_angle
        return Bores(pump.pistons, 0.5 * pump.piston_diameter, cone, float(centre[0] - centre[2] * np.tan(cone)))

    @cached_property
    def _dead_length(self) -> float:
        """Length (m) of the dead space along the bore."""
        return self.rotor.pump.pump.dead_volume / piston_area(self.rotor.pump)

    @cached_property
    def _end(self) -> float:
        """Thickness (m) of the block between bores and valve plate."""
        along = self._dead_length * np.cos(self.rotor.pump.pump.bore_cone_angle)
        return float(min(self._block_end.thickness, DEAD_END * along))

    def _at_ball(self, shaft_angle: float) -> Frame:
        """Frame about a ball's centre, z along the bore out of the block."""
        x, y = bore_sides(self.rotor.drive, shaft_angle)
        return Frame(ball_centre(self.rotor, shaft_angle), x, y, bore_axis(self.rotor.drive, shaft_angle))

    @cached_property
    def _plate_frame(self) -> Frame:
        """Frame of the swash plate's face about its cut with the shaft's axis."""
        one = face_frame(self.rotor, self.parts.slipper.ball_height, 0.0)
        return Frame(np.array([0.0, 0.0, one.origin @ one.z / one.z[2]]), one.x, one.y, one.z)

    @property
    def _bore_walls(self) -> BoreWalls:
        walls = self.parts.piston.laws.walls
        assert isinstance(walls, BoreWalls)
        return walls

    @property
    def _slipper_part(self) -> SlipperPart:
        part = _plates(self.parts.slipper.laws.walls)[0]
        assert isinstance(part, SlipperPart)
        return part

    @property
    def _plate_part(self) -> PlatePart:
        return _plate(self.parts.slipper.laws.walls, 1)

    @property
    def _block_end(self) -> PlatePart:
        return _plate(self.parts.block.laws.walls, 0)

    @property
    def _valve_plate(self) -> PlatePart:
        return _plate(self.parts.block.laws.walls, 1)


def _plates(walls: object) -> tuple[SlipperPart | PlatePart, SlipperPart | PlatePart]:
    assert isinstance(walls, PlateWalls)
    return walls.parts


def _plate(walls: object, which: int) -> PlatePart:
    part = _plates(walls)[which]
    assert isinstance(part, PlatePart)
    return part


def _face(sphere: Sphere) -> Height:
    """Height (m) of the valve plate's face over its middle, by the distance from the axis."""
    if sphere.is_plane:
        return np.zeros_like
    return lambda r: -sphere.radius * (1.0 - np.sqrt(1.0 - (r / sphere.radius) ** 2))
