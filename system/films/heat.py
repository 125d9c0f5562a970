"""Heat of the gaps of a pump: its oil, and the heat paths through the parts.

Each part passes heat to its far side, which has the case's temperature: plates through their thickness, a bushing
out to the middle of the web, a piston along its axis to both ends.
"""

import math

import numpy as np

from gaps.films.physics import FilmLaws, Physics
from gaps.revolution.film_heat import GapHeat, Sink
from gaps.walls.pair import BoreWalls, PlateWalls
from gaps.walls.parts import PistonPart
from reynolds.laws.oil import walther
from reynolds.numerics.arrays import Array
from system.description.assumptions import Assumption, Taken
from system.description.pump import PumpDescription
from system.films.parts import FloatingParts
from system.films.rotor import Rotor
from system.inputs.units import Dimension


def slab(thickness: float, conductivity: float) -> float:
    """R = t/k (m2 K/W) of a plate of thickness t (m), heated on one side and cooled on the other."""
    return thickness / conductivity


def tube(radius: float, wall: float, conductivity: float) -> float:
    """R = r/k ln(1 + w/r) (m2 K/W of the inner face) of a tube, inner radius r and wall w (m), cooled outside."""
    return radius / conductivity * math.log1p(wall / radius)


def rod(part: PistonPart, conductivity: float) -> float:
    """R = L^2 U/(12 k A) (m2 K/W) of a piston heated evenly around, its mean over ends that are cooled.

    U its circumference, A its section: T'' = -q U/(k A), of which the mean over L is q U L^2/(12 k A).
    """
    section = 0.25 * math.pi * (part.diameter**2 - part.inner_diameter**2)
    return part.length**2 * math.pi * part.diameter / (12.0 * conductivity * section)


def piston_heat(rotor: Rotor, parts: FloatingParts) -> GapHeat:
    """Oil, bushing (fixed) and piston (moving)."""
    walls = parts.piston.laws.walls
    assert isinstance(walls, BoreWalls)
    bushing, piston = walls.bushing, walls.piston
    return _gap_heat(
        rotor,
        tube(0.5 * bushing.diameter, bushing.wall, _conductivity(parts, "bushing")),
        rod(piston, _conductivity(parts, "piston")),
    )


def slipper_heat(rotor: Rotor, parts: FloatingParts) -> GapHeat:
    """Oil, swash plate (fixed) and slipper (moving)."""
    return _gap_heat(rotor, *_plates(parts, parts.slipper.laws, "swash_plate", "slipper"))


def block_heat(rotor: Rotor, parts: FloatingParts) -> GapHeat:
    """Oil, valve plate (fixed) and block (moving)."""
    return _gap_heat(rotor, *_plates(parts, parts.block.laws, "valve_plate", "block"))


def all_taken(rotor: Rotor, parts: FloatingParts, physics: Physics) -> tuple[Assumption, ...]:
    """Assumptions of floating gaps where the pump file has no value, those of heat only with heated films."""
    taken = Taken()
    if physics.heat:
        _oil_conductivity(rotor.pump, taken)
        shown = f"{rotor.point.temperature - 273.15:.4g} degC"
        taken.note("far sides of the parts", shown, "the case's temperature, whatever heat they pass")
    return (*parts.taken, *taken.assumptions)


def _gap_heat(rotor: Rotor, fixed: float, moving: float) -> GapHeat:
    """Heat between walls of such resistances (m2 K/W); oil thins by Walther's law."""
    oil, point = rotor.pump.oil, rotor.point
    fluid = oil.fluid

    def thins(temperature: Array) -> Array:
        return np.asarray(walther(temperature, fluid) * oil.density / point.viscosity)

    return GapHeat(
        density=oil.density,
        specific_heat=oil.specific_heat,
        conductivity=_oil_conductivity(rotor.pump, Taken()),
        temperature=point.temperature,
        thins=thins,
        fixed=Sink(point.temperature, fixed),
        moving=Sink(point.temperature, moving),
    )


def _plates(parts: FloatingParts, laws: FilmLaws, fixed: str, moving: str) -> tuple[float, float]:
    walls = laws.walls
    assert isinstance(walls, PlateWalls)
    upper, lower = walls.parts
    return slab(lower.thickness, _conductivity(parts, fixed)), slab(upper.thickness, _conductivity(parts, moving))


def _conductivity(parts: FloatingParts, name: str) -> float:
    return parts.materials[name].thermal_conductivity


def _oil_conductivity(pump: PumpDescription, taken: Taken) -> float:
    return taken.value(
        "oil.thermal_conductivity", pump.oil.thermal_conductivity, 0.13, "a mineral oil, 0.12 .. 0.15",
        Dimension.CONDUCTIVITY,
    )  # fmt: skip
