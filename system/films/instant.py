"""Leakage and shear of one gap's film at one instant, its parts at the positions of the pump file."""

from dataclasses import dataclass
from typing import assert_never

import numpy as np

from gaps.films.physics import Physics
from gaps.standing.conductances import kidney_conductances, piston_conductance, slipper_land_conductance
from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.films.parts import FloatingParts
from system.films.positions import instant_drives
from system.films.rotor import Rotor
from system.films.standing import standing_gap


@dataclass(frozen=True)
class FilmNumbers:
    """Flow through the lands per pressure over the case, m3/(s Pa), and heat of sliding, W.

    Of one piston or one slipper, whose orifice is left out; of the ring the mean over kidneys under pressure.
    """

    conductance: float
    shear: float


def film_numbers(
    gap: Gap, rotor: Rotor, parts: FloatingParts, shaft_angle: float, pressure: float, physics: Physics, finer: float
) -> FilmNumbers:
    """Numbers of a gap's film with its chamber, or the chambers on the delivery side, at a pressure (Pa).

    The other chambers of the ring are at the inlet's. `shaft_angle` (rad): of that chamber, or of the first.
    Raises as `reynolds.floating.rest.held_at`.
    """
    pressures = chambers_at(rotor, shaft_angle, pressure) if gap is Gap.VALVE_PLATE else np.array([pressure])
    drives = instant_drives(rotor, parts, shaft_angle, pressures)
    standing = standing_gap(gap, rotor, parts, drives, physics, finer)
    stage, solver, film = standing.held_at(shaft_angle), standing.solver, standing.film
    match gap:
        case Gap.PISTON:
            conductance, is_film = piston_conductance(solver, stage), 1.0
        case Gap.SLIPPER:
            conductance, is_film = slipper_land_conductance(solver, film, stage), 1.0
        case Gap.VALVE_PLATE:
            under_pressure = pressures == pressure
            conductance = float(kidney_conductances(solver, film, stage)[under_pressure].mean())
            is_film = film.is_film(stage.solution.problem.space)
        case _:
            assert_never(gap)
    return FilmNumbers(conductance, film.wall_shear(stage).heat(is_film).shear)


def chambers_at(rotor: Rotor, shaft_angle: float, pressure: float) -> Array:
    """Pressures (z,) Pa with those in the second half of their turn at `pressure`, the others at the inlet's."""
    pistons = rotor.pump.pump.pistons
    angles = (shaft_angle + 2.0 * np.pi / pistons * np.arange(pistons)) % (2.0 * np.pi)
    return np.where(angles < np.pi, rotor.point.inlet_pressure, pressure)
