"""The film of one gap at one instant, its parts where the description puts them: its leakage and shear."""

from __future__ import annotations

from dataclasses import dataclass
from typing import assert_never

import numpy as np

from gaps.films.block import standing_block
from gaps.films.physics import Physics
from gaps.films.piston import standing_piston
from gaps.films.slipper import floating_slipper
from gaps.standing.conductances import (
    kidney_conductances,
    piston_conductance,
    slipper_land_conductance,
)
from reynolds.floating.rest import held_at
from reynolds.numerics.arrays import Array
from reynolds.solve.solver import FilmSolver
from system.description.gap import Gap
from system.films.cycle import PISTON_CELLS, RING_CELLS, SLIPPER_CELLS
from system.films.parts import FloatingParts
from system.films.positions import given_block, given_piston, given_slipper, instant_drives
from system.films.problems import Cells, block_film, piston_film, slipper_film
from system.films.rotor import Rotor


@dataclass(frozen=True)
class FilmNumbers:
    """Flow through the lands per pressure over the case, m3/(s Pa), and heat of sliding, W.

    Of one piston or one slipper, whose orifice is left out; of the ring the mean over kidneys under pressure.
    """

    conductance: float
    shear: float


def film_numbers(
    gap: Gap,
    rotor: Rotor,
    parts: FloatingParts,
    shaft_angle: float,
    pressure: float,
    physics: Physics,
    finer: float,
) -> FilmNumbers:
    """What a gap's film tells with its chamber, or the chambers over the delivery side, at a pressure (Pa).

    The other chambers of the ring are at the inlet's. `shaft_angle` (rad): of that chamber, or of the first.
    Raises as `reynolds.floating.rest.held_at`.
    """
    match gap:
        case Gap.PISTON:
            return _piston(rotor, parts, shaft_angle, pressure, physics, _cells(PISTON_CELLS, finer))
        case Gap.SLIPPER:
            return _slipper(rotor, parts, shaft_angle, pressure, physics, _cells(SLIPPER_CELLS, finer))
        case Gap.VALVE_PLATE:
            return _ring(rotor, parts, shaft_angle, pressure, physics, _cells(RING_CELLS, finer))
        case _:
            assert_never(gap)


def _cells(cells: Cells, finer: float) -> Cells:
    return round(cells[0] * finer), round(cells[1] * finer)


def _piston(
    rotor: Rotor, parts: FloatingParts, angle: float, pressure: float, physics: Physics, cells: Cells
) -> FilmNumbers:
    drive = instant_drives(rotor, parts, angle, np.array([pressure])).piston
    film = piston_film(rotor, parts, drive, physics, cells)
    solver, place = FilmSolver(film.space_at(0.0)), given_piston(rotor.pump, drive.outer(angle))
    stage = held_at(solver, standing_piston(film), angle / drive.shaft_speed, place)
    return FilmNumbers(piston_conductance(solver, stage), film.rubbed(stage).heat().shear)


def _slipper(
    rotor: Rotor, parts: FloatingParts, angle: float, pressure: float, physics: Physics, cells: Cells
) -> FilmNumbers:
    drive = instant_drives(rotor, parts, angle, np.array([pressure])).slipper
    film = slipper_film(rotor, parts, drive, physics, cells)
    solver, place = FilmSolver(film.space), given_slipper(rotor, angle)
    stage = held_at(solver, floating_slipper(film), angle / drive.shaft_speed, place)
    return FilmNumbers(slipper_land_conductance(solver, film, stage), film.rubbed(stage).heat().shear)


def _ring(
    rotor: Rotor, parts: FloatingParts, angle: float, pressure: float, physics: Physics, cells: Cells
) -> FilmNumbers:
    pressed = chambers_at(rotor, angle, pressure)
    drive = instant_drives(rotor, parts, angle, pressed).block
    film = block_film(rotor, parts, drive, physics, cells)
    solver = FilmSolver(film.space)
    stage = held_at(solver, standing_block(film), angle / drive.shaft_speed, given_block(rotor.pump))
    by_kidney = kidney_conductances(solver, film, stage)
    sheared = film.rubbed(stage).heat(film.is_film(stage.solution.problem.space)).shear
    return FilmNumbers(float(by_kidney[pressed == pressure].mean()), sheared)


def chambers_at(rotor: Rotor, shaft_angle: float, pressure: float) -> Array:
    """Pressures (z,) Pa with those in the second half of their turn at `pressure`, the others at the inlet's."""
    pistons = rotor.pump.pump.pistons
    angles = (shaft_angle + 2.0 * np.pi / pistons * np.arange(pistons)) % (2.0 * np.pi)
    return np.where(angles < np.pi, rotor.point.inlet_pressure, pressure)
