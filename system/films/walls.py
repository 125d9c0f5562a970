"""The bodies of the parts that float, by their sizes: stated in the pump file, else usual."""

import math
from collections.abc import Mapping
from dataclasses import replace

from gaps.walls.pair import BoreWalls, PlateWalls
from gaps.walls.parts import BushingPart, PistonPart, PlatePart, SlipperPart
from gaps.walls.user_mesh import CHAMBER, FILM, HELD, POCKET, SLIDING, OwnMesh
from reynolds.bodies.elasticity import Elastic
from reynolds.bodies.mesh import scaled
from system.description.assumptions import Taken
from system.description.parts import BodySection
from system.description.pump import PumpDescription
from system.inputs.units import Dimension

FLANGE = 0.35  # of the slipper's outer radius: its flange's thickness
PLATE_REACH, PLATE_DEPTH = 1.5, 1.5  # of it: radius and thickness of the swash plate's part that a slipper bends
RING_DEPTH = 0.15  # of the valve plate's outer radius: its thickness
BEYOND = 0.1  # of a radius, by which plates are wider than the film on them
Materials = Mapping[str, Elastic]


def bore_walls(pump: PumpDescription, guide_length: float, elastic: Materials, taken: Taken) -> BoreWalls:
    """Piston and bushing of a pump whose bores guide over a length (m)."""
    part, diameter = pump.piston, pump.pump.piston_diameter
    inner = taken.value(
        "piston.bore_diameter", part.bore_diameter, 0.0, "a solid piston: no bore is stated", Dimension.LENGTH
    )
    chord = 2.0 * pump.pump.pitch_radius * math.sin(math.pi / pump.pump.pistons)
    wall = taken.value(
        "bore.wall", pump.bore.wall, 0.5 * (chord - diameter),
        "half of the web between two bores on the pitch circle, all of the bushing's material", Dimension.LENGTH,
    )  # fmt: skip
    length = part.engaged_length + part.overhang
    return BoreWalls(
        PistonPart(diameter, inner, length, elastic["piston"], own_mesh("piston", part.body, taken)),
        BushingPart(diameter, wall, guide_length, elastic["bushing"], own_mesh("bore", pump.bore.body, taken)),
    )


def slipper_walls(pump: PumpDescription, elastic: Materials, taken: Taken) -> PlateWalls:
    """Slipper and the part of the swash plate under it."""
    part, rim, length = pump.slipper, pump.slipper.land_outer_radius, Dimension.LENGTH
    thickness = taken.value(
        "slipper.flange_thickness", part.flange_thickness, FLANGE * rim, "0.35 of the outer radius", length
    )
    socket = taken.value(
        "slipper.socket_radius", part.socket_radius, part.ball_joint_radius,
        "the ball's radius: no deformation over the ball", length,
    )  # fmt: skip
    depth = taken.value(
        "swash_plate.thickness", pump.swash_plate.thickness, PLATE_DEPTH * rim,
        "1.5 times the slipper's outer radius, its back held", length,
    )  # fmt: skip
    pocket = part.lands.inner_radius
    return PlateWalls(
        (
            SlipperPart(
                0.5 * part.orifice_diameter,
                pocket,
                socket,
                rim,
                thickness,
                elastic["slipper"],
                own_mesh("slipper", part.body, taken),
                part.lands.closed_grooves,
            ),
            PlatePart(
                0.0,
                PLATE_REACH * rim,
                depth,
                elastic["swash_plate"],
                pocket,
                True,
                own_mesh("swash_plate", pump.swash_plate.body, taken),
                part.lands.closed_grooves,
            ),
        )
    )


def block_walls(pump: PumpDescription, elastic: Materials, taken: Taken) -> PlateWalls:
    """The block's end and the valve plate, solid rings held at their backs, a little wider than lands and pads."""
    plate, length = pump.valve_plate, Dimension.LENGTH
    inner, rim = (1.0 - BEYOND) * plate.land_radius_1, plate.outer_radius
    outer = min((1.0 + BEYOND) * rim, 0.5 * (rim + plate.sphere.radius))
    thickness = taken.value(
        "valve_plate.thickness", plate.thickness, RING_DEPTH * plate.land_radius_4,
        "0.15 of its outer radius; a solid ring, its back held", length,
    )  # fmt: skip
    end = taken.value(
        "block.end_thickness", pump.block.end_thickness, 0.5 * pump.pump.piston_diameter,
        "half a bore's diameter between bores and face; a solid ring, its back held", length,
    )  # fmt: skip
    upper = PlatePart(inner, outer, end, elastic["block"], over_film=True, sphere=plate.sphere)
    lower = PlatePart(inner, outer, thickness, elastic["valve_plate"], sphere=plate.sphere)
    return PlateWalls(
        (
            replace(upper, own=own_mesh("block", pump.block.body, taken)),
            replace(lower, own=own_mesh("valve_plate", plate.body, taken)),
        )
    )


def own_mesh(part: str, body: BodySection | None, taken: Taken) -> OwnMesh | None:
    """The user's mesh of a part; a name that its table leaves out is the mesh's face of that name, if any.

    None where no mesh is stated.
    """
    if body is None:
        return None
    found = by_names(body)
    if not found.held and not found.sliding:
        taken.note(f"{part}.body.held", "a free body", "the mesh names no face 'held' or 'sliding'")
    return found


def by_names(body: BodySection) -> OwnMesh:
    """The mesh of a table with the faces that it names or that have the keys' own names."""
    read = body.mesh
    bare = OwnMesh(read.path, scaled(read.body, body.unit.metres), f"{read.content} {body.unit.value}")
    faces = bare.body.face_names

    def usual(name: str) -> tuple[str, ...]:
        return (name,) if name in faces else ()

    stated = {CHAMBER: body.chamber, POCKET: body.pocket}
    return replace(
        bare,
        film=body.film or FILM,
        held=body.held or usual(HELD),
        sliding=body.sliding or usual(SLIDING),
        pressed=tuple((name, face) for name, own in stated.items() for face in ((own,) if own else usual(name))),
    )
