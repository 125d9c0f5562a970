"""The parts for floating gaps: stated values of the pump file, and assumed values for the others.

Every assumed value is an `Assumption`, which a result lists.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from gaps.films.physics import FilmLaws
from gaps.shapes.profiles import Barrel, Crown, EdgeRelief, Profile, ProfileShape, Waviness, measured, ring_grooves
from reynolds.bodies.elasticity import Elastic
from reynolds.laws.contact import Asperities, composite_modulus
from reynolds.laws.fluid import CONSTANT, Fluid
from reynolds.laws.roughness import Surface
from reynolds.laws.viscosity import Roelands
from system.description.assumptions import Assumption, Taken
from system.description.lines import LineKind
from system.description.parts import MaterialSection, RetainerKind, SurfaceSection
from system.description.pump import PumpDescription
from system.films.walls import block_walls, bore_walls, slipper_walls
from system.inputs.units import Dimension, format_quantity
from system.pump.laws.kinematics import piston_displacement
from system.pump.lumped import full_drive, piston_area

SUMMIT_PRODUCT = 0.04  # eta beta sigma of finished surfaces, 0.03 .. 0.05 (Greenwood and Tripp 1970-71)
SUMMIT_SLOPE = 0.01  # sigma/beta, 1e-4 .. 1e-2


@dataclass(frozen=True)
class Material:
    """Of a part, SI: elasticity Pa and 1, density kg/m3, conductivity W/(m K), expansion 1/K."""

    youngs_modulus: float
    poissons_ratio: float
    density: float
    thermal_conductivity: float
    thermal_expansion: float


STEEL = Material(210e9, 0.3, 7850.0, 46.0, 11.5e-6)
BRASS = Material(110e9, 0.34, 8400.0, 80.0, 19e-6)
_USUAL = {
    "piston": (STEEL, "steel"),
    "bushing": (BRASS, "special brass"),
    "slipper": (BRASS, "special brass"),
    "swash_plate": (STEEL, "steel"),
    "block": (STEEL, "steel"),
    "valve_plate": (BRASS, "special brass"),
}
_THERMAL = {
    "density": Dimension.DENSITY,
    "thermal_conductivity": Dimension.CONDUCTIVITY,
    "thermal_expansion": Dimension.TEMPERATURE_COEFFICIENT,
}
_FACES = {
    "piston_cylinder": ("piston", "bushing"),
    "slipper_swash_plate": ("slipper", "swash_plate"),
    "valve_plate_cylinder": ("block", "valve_plate"),
}


@dataclass(frozen=True)
class PistonParts:
    """guide_length m; centre_of_mass m, from the ball into the bore; shapes of the piston, from its chamber's end,
    and of the bore, from the case edge inwards; laws of oil and walls."""

    guide_length: float
    centre_of_mass: float
    piston: Profile
    bore: Profile
    laws: FilmLaws


@dataclass(frozen=True)
class RetainerParts:
    """Retention of slippers: beyond a clearance (m) by a stiffness (N/m each), with a spring at all times."""

    kind: RetainerKind
    clearance: float
    stiffness: float


@dataclass(frozen=True)
class SlipperParts:
    """ball_height m over the face; flow coefficient of the orifice's ends (None: by file); face by radius."""

    ball_height: float
    orifice_flow_coefficient: float | None
    face: Profile
    retainer: RetainerParts
    laws: FilmLaws


@dataclass(frozen=True)
class BlockParts:
    """spline_height m over the valve plate; shape of plate and block by radius and angle; laws of oil and walls."""

    spline_height: float
    faces: Profile
    laws: FilmLaws


@dataclass(frozen=True)
class FloatingParts:
    """Complete data of floating gaps, SI; `materials` of [materials]; `taken`: the assumptions."""

    piston: PistonParts
    slipper: SlipperParts
    block: BlockParts
    materials: Mapping[str, Material]
    taken: tuple[Assumption, ...]


def floating_parts(pump: PumpDescription) -> FloatingParts:
    """The parts of a pump, every value stated or assumed. Of a single part: `pump.of_chamber(number)`."""
    taken = Taken()
    materials = {name: _material(pump, name, taken) for name in _USUAL}
    oil = _fluid(pump, taken)
    _tell_lines(pump, taken)
    _tell_spins(pump, taken)
    elastic = {name: Elastic(part.youngs_modulus, part.poissons_ratio) for name, part in materials.items()}
    piston = _piston(pump, _laws(pump, "piston_cylinder", oil, materials, taken), taken)
    slipper = _slipper(pump, _laws(pump, "slipper_swash_plate", oil, materials, taken), taken)
    block = _block(pump, _laws(pump, "valve_plate_cylinder", oil, materials, taken), taken)
    bore = bore_walls(pump, piston.guide_length, elastic, taken)
    return FloatingParts(
        piston=replace(piston, laws=replace(piston.laws, walls=bore)),
        slipper=replace(slipper, laws=replace(slipper.laws, walls=slipper_walls(pump, elastic, taken))),
        block=replace(block, laws=replace(block.laws, walls=block_walls(pump, elastic, taken))),
        materials=materials,
        taken=tuple(taken.assumptions),
    )


def ball_plane_height(pump: PumpDescription) -> float:
    """Height (m) over the valve plate at which the plane of the ball centres cuts the shaft at full swash angle.

    Dead space (modelled as a straight prolongation of the bore), engaged length, overhang and way along a bore at right
    angles to the swash plate's steepest line.
    """
    way = float(piston_displacement(full_drive(pump), 0.5 * math.pi))
    reach = pump.pump.dead_volume / piston_area(pump) + pump.piston.engaged_length + pump.piston.overhang + way
    return reach * math.cos(pump.pump.bore_cone_angle)


def _piston(pump: PumpDescription, laws: FilmLaws, taken: Taken) -> PistonParts:
    part, length = pump.piston, Dimension.LENGTH
    guide = taken.value(
        "piston.guide_length", part.guide_length, part.engaged_length,
        "the bore guides all that it holds of the piston at inner dead centre", length,
    )  # fmt: skip
    centre = taken.value(
        "piston.centre_of_mass", part.centre_of_mass, 0.5 * (part.overhang + part.engaged_length),
        "the middle from ball centre to inner end, as of a plain rod", length,
    )  # fmt: skip
    shapes: list[ProfileShape] = [] if part.profile is None else [measured(part.profile)]
    if part.barrel is not None:
        shapes.append(Barrel(part.engaged_length, part.barrel))
    if part.edge_relief is not None:
        shapes.append(EdgeRelief(0.0, part.edge_relief.width, part.edge_relief.depth))
    if part.grooves is not None:
        shapes += ring_grooves(part.grooves).shapes
    if not shapes:
        taken.note("piston.profile", "a cylinder with sharp edges", "no shape is stated")
    bore: list[ProfileShape] = [] if pump.bore.profile is None else [measured(pump.bore.profile)]
    if pump.bore.edge_relief is not None:
        bore.append(EdgeRelief(0.0, pump.bore.edge_relief.width, pump.bore.edge_relief.depth))
    if not bore:
        taken.note("bore.profile", "a cylinder with sharp edges", "no shape is stated")
    return PistonParts(guide, centre, Profile(tuple(shapes)), Profile(tuple(bore)), laws)


def _slipper(pump: PumpDescription, laws: FilmLaws, taken: Taken) -> SlipperParts:
    part, rim = pump.slipper, pump.slipper.land_outer_radius
    height = taken.value(
        "slipper.ball_height", part.ball_height, 1.3 * part.centre_of_mass_to_ball,
        "1.3 times the distance of its centre of mass from the ball", Dimension.LENGTH,
    )  # fmt: skip
    flow = None if part.orifice_file is not None else taken.value(
        "slipper.orifice_flow_coefficient", part.orifice_flow_coefficient, 1.5**-0.5,
        "a sharp entry and a free exit take 1.5 velocity heads, Idelchik 1960",
    )  # fmt: skip
    shapes: list[ProfileShape] = [] if part.profile is None else [measured(part.profile)]
    if part.crown is not None:
        shapes.append(Crown(rim, part.crown))
    if part.rim_relief is not None:
        shapes.append(EdgeRelief(rim, rim - part.rim_relief.width, part.rim_relief.depth))
    if not shapes:
        taken.note("slipper.profile", "a flat face", "no shape is stated; it has no wedge to ride on")
    return SlipperParts(height, flow, Profile(tuple(shapes)), _retainer(pump, taken), laws)


def retainer_kind(pump: PumpDescription, taken: Taken) -> RetainerKind:
    """Retention of the slippers on the plate, stated or assumed."""
    part = pump.retainer
    if part.kind is not None:
        return part.kind
    spring = pump.ball_guide.spring_preload > 0.0 and part.clearance is None and part.stiffness is None
    kind = RetainerKind.SPRING if spring else RetainerKind.CLEARANCE
    reason = "the ball guide has a spring" if spring else "no spring presses, or a clearance is stated"
    taken.note("retainer.kind", kind.value, reason)
    return kind


def _retainer(pump: PumpDescription, taken: Taken) -> RetainerParts:
    part, kind = pump.retainer, retainer_kind(pump, taken)
    rises = {
        RetainerKind.CLEARANCE: "usual play of a retainer",
        RetainerKind.SPRING: "some films more than the other slippers have, which hold the plate",
    }
    clearance = taken.value("retainer.clearance", part.clearance, 30e-6, rises[kind], Dimension.LENGTH)
    stiffness = taken.value(
        "retainer.stiffness", part.stiffness, 1e8, "order of a steel plate between two slippers", Dimension.STIFFNESS
    )
    return RetainerParts(kind, clearance, stiffness)


def spline_height(pump: PumpDescription, taken: Taken) -> float:
    """Height (m) over the valve plate at which the shaft holds the block sideways, stated or assumed."""
    return taken.value(
        "block.spline_position", pump.block.spline_position, ball_plane_height(pump),
        "where the plane of the ball centres cuts the shaft", Dimension.LENGTH,
    )  # fmt: skip


def _block(pump: PumpDescription, laws: FilmLaws, taken: Taken) -> BlockParts:
    height = spline_height(pump, taken)
    waves, faces = pump.valve_plate.waviness, (pump.valve_plate.profile, pump.block.profile)
    shapes: list[ProfileShape] = [measured(rows) for rows in faces if rows is not None]
    if waves is not None:
        shapes.append(Waviness(waves.waves, waves.amplitude))
    if not shapes:
        taken.note("valve_plate.waviness", "none", "no shape is stated; a flat ring sinks until contact bears")
    return BlockParts(height, Profile(tuple(shapes)), laws)


def _laws(pump: PumpDescription, pair: str, oil: Fluid, materials: Mapping[str, Material], taken: Taken) -> FilmLaws:
    """Oil and rough walls of a gap, without a lay; half of the variance on either wall."""
    stated = getattr(pump.surfaces, pair) or SurfaceSection()
    path, (one, two) = f"surfaces.{pair}", (materials[name] for name in _FACES[pair])
    length = Dimension.LENGTH
    height = taken.value(
        f"{path}.composite_roughness", stated.composite_roughness, 0.5e-6, "a ground face on a lapped one", length
    )
    radius = taken.value(
        f"{path}.asperity_radius", stated.asperity_radius, height / SUMMIT_SLOPE,
        "composite_roughness/0.01, Greenwood and Tripp 1970-71", length,
    )  # fmt: skip
    density = taken.value(
        f"{path}.asperity_density", stated.asperity_density, SUMMIT_PRODUCT / (radius * height),
        "0.04/(radius x composite_roughness), Greenwood and Tripp 1970-71", Dimension.AREAL_DENSITY,
    )  # fmt: skip
    friction = taken.value(
        f"{path}.friction_coefficient", stated.friction_coefficient, 0.1, "boundary friction of metals in mineral oil"
    )
    modulus = composite_modulus(one.youngs_modulus, one.poissons_ratio, two.youngs_modulus, two.poissons_ratio)
    wall = height / math.sqrt(2.0)
    surface = Surface(wall, wall)
    return FilmLaws(oil, surface, Asperities(density, radius, height, modulus, friction))


def _fluid(pump: PumpDescription, taken: Taken) -> Fluid:
    coefficient = taken.value(
        "oil.pressure_viscosity", pump.oil.pressure_viscosity, 20e-9,
        "a mineral oil, 15 .. 25 1/GPa; by Roelands' law", Dimension.PRESSURE_COEFFICIENT,
    )  # fmt: skip
    return Fluid(viscosity=Roelands(coefficient)) if coefficient > 0.0 else CONSTANT


def _material(pump: PumpDescription, name: str, taken: Taken) -> Material:
    """The material of a part; values that it does not state are the usual ones."""
    stated: MaterialSection | None = getattr(pump.materials, name)
    usual, called = _USUAL[name]
    if stated is None:
        modulus = format_quantity(usual.youngs_modulus, Dimension.ELASTICITY, digits=4)
        taken.note(f"materials.{name}", f"{called}, {modulus}", "usual for this part")
        return usual
    given = {key: value for key, value in vars(stated).items() if value is not None}
    for key in ("density", "thermal_conductivity", "thermal_expansion"):
        if key not in given:
            shown = format_quantity(getattr(usual, key), _THERMAL[key], digits=4)
            taken.note(f"materials.{name}.{key}", shown, f"of {called}")
    return replace(usual, **given)


def _tell_spins(pump: PumpDescription, taken: Taken) -> None:
    for name in ("piston", "slipper"):
        if getattr(pump, name).spin_ratio is None:
            reason = "the ball joint's friction over the turn balances the films' drag, system.films.spins"
            taken.note(f"{name}.spin_ratio", "free to turn", reason)


def _tell_lines(pump: PumpDescription, taken: Taken) -> None:
    for name in ("delivery", "suction"):
        if getattr(pump, f"{name}_line").kind is None:
            reason = f"the {name} port's pressure does not ripple"
            taken.note(f"{name}_line.kind", LineKind.HELD.value, reason)
