"""The films of a pump's three gaps: its parts and their drives on meshes."""

from gaps.films.block import BlockDrive, BlockFilm
from gaps.films.physics import Effect, Physics
from gaps.films.piston import PistonDrive, PistonFilm
from gaps.films.slipper import SlipperDrive, SlipperFilm
from system.films.drives import piston_shape, slipper_shape
from system.films.parts import FloatingParts
from system.films.rotor import Rotor, valve_plate_geometry

RIGID = Physics().without(Effect.ELASTIC_WALLS, Effect.PRESSURE_VISCOSITY, Effect.HEAT)
"""Rigid walls and oil of constant viscosity: physics without elastic bodies."""
Cells = tuple[int, int]


def piston_film(rotor: Rotor, parts: FloatingParts, drive: PistonDrive, physics: Physics, cells: Cells) -> PistonFilm:
    """The piston's film; cells = (around, along)."""
    return PistonFilm(piston_shape(rotor, parts), drive, parts.piston.laws, physics, cells)


def slipper_film(
    rotor: Rotor, parts: FloatingParts, drive: SlipperDrive, physics: Physics, cells: Cells
) -> SlipperFilm:
    """The slipper's film; cells = (across each land, around)."""
    return SlipperFilm(slipper_shape(rotor, parts), drive, parts.slipper.laws, physics, cells)


def block_film(rotor: Rotor, parts: FloatingParts, drive: BlockDrive, physics: Physics, cells: Cells) -> BlockFilm:
    """The block's film; cells = (across a land, a kidney pitch)."""
    geometry = valve_plate_geometry(rotor.pump, rotor.drive.dead_centre_shift)
    return BlockFilm(geometry, drive, parts.block.faces, parts.block.laws, physics, cells)
