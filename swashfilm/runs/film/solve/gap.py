"""A pump gap's film at one instant solved: at its position or at rest, and its true place in the pump."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from typing import Any, assert_never

import numpy as np

from gaps.films.block import BlockDrive, standing_block
from gaps.films.over_turn import constant
from gaps.films.piston import PistonDrive, standing_piston
from gaps.films.slipper import SlipperDrive, face_force, floating_slipper
from gaps.loads.ball_joint import lateral_force
from gaps.standing.gap_film import GapFilm
from gaps.standing.reports import block_told, piston_told, rest_from, slipper_told
from reynolds.fem.space import FilmSpace
from reynolds.floating.problem import Floating
from reynolds.floating.rest import held_at
from reynolds.floating.step import Stage
from reynolds.numerics.arrays import Array
from reynolds.solve.solver import FilmSolver
from swashfilm.case.gap.instant import GapCase
from swashfilm.case.gap.position import FaceLoad, PistonLoad, rim
from system.description.gap import Gap
from system.films.cycle import PISTON_CELLS, RING_CELLS, SLIPPER_CELLS
from system.films.places import place_of
from system.films.positions import NO_RUBBING, instant_drives
from system.films.problems import Cells, block_film, piston_film, slipper_film
from system.points.floating_gaps import BLOCK_START, SLIPPER_START

START = {
    Gap.PISTON: np.zeros(4),
    Gap.SLIPPER: np.array([SLIPPER_START, 0.0, 0.0]),
    Gap.VALVE_PLATE: np.array([BLOCK_START, 0.0, 0.0]),
}
CELLS = {Gap.PISTON: PISTON_CELLS, Gap.SLIPPER: SLIPPER_CELLS, Gap.VALVE_PLATE: RING_CELLS}


class PositionSource(Enum):
    """Where a part stands: where the case puts it, or where it comes to rest."""

    GIVEN = "given"
    REST = "rest"


@dataclass(frozen=True)
class GapStudy:
    """A gap's film and where its position comes from; assumptions: what the forces leave out, and values taken."""

    film: GapFilm
    source: PositionSource
    assumptions: tuple[str, ...]


def solve_gap(case: GapCase) -> GapStudy:
    """The gap's film at its position, or at rest.

    Raises FilmNotConverged where the film does not settle, and where the part finds no rest: pulled off, or
    pressed on walls that do not bear.
    """
    driven = instant_drives(case.rotor, case.parts, case.shaft_angle, case.chamber_pressure)
    match case.gap:
        case Gap.PISTON:
            found = _piston(case, driven.piston)
        case Gap.SLIPPER:
            found = _slipper(case, driven.slipper)
        case Gap.VALVE_PLATE:
            found = _block(case, driven.block)
        case _:
            assert_never(case.gap)
    source = PositionSource.REST if case.position is None else PositionSource.GIVEN
    return GapStudy(found, source, (NO_RUBBING, *(str(taken) for taken in case.parts.taken)))


def _piston(case: GapCase, drive: PistonDrive) -> GapFilm:
    if isinstance(case.load, PistonLoad):
        force = lateral_force(case.parts.piston.guide_length, -case.load.arm, np.array(case.load.force))
        drive = replace(drive, outer=constant(*force))
    film = piston_film(case.rotor, case.parts, drive, case.physics, gap_cells(case))
    time = case.shaft_angle / drive.shaft_speed
    return piston_told(film, _stage(case, standing_piston(film), film.space_at(time), time))


def _slipper(case: GapCase, drive: SlipperDrive) -> GapFilm:
    if isinstance(case.load, FaceLoad):
        pressed = np.array([-case.load.moment_y, case.load.moment_x])
        drive = replace(drive, outer=constant(*face_force(rim(case.gap, case.rotor), case.load.force, pressed)))
    film = slipper_film(case.rotor, case.parts, drive, case.physics, gap_cells(case))
    time = case.shaft_angle / drive.shaft_speed
    return slipper_told(film, _stage(case, floating_slipper(film), film.space, time))


def _block(case: GapCase, drive: BlockDrive) -> GapFilm:
    if isinstance(case.load, FaceLoad):
        drive = replace(drive, press=constant(-case.load.force, -case.load.moment_x, -case.load.moment_y))
    film = block_film(case.rotor, case.parts, drive, case.physics, gap_cells(case))
    time = case.shaft_angle / drive.shaft_speed
    return block_told(film, _stage(case, standing_block(film), film.space, time)).gap


def _stage(case: GapCase, floating: Floating, space: FilmSpace, time: float) -> Stage:
    """The film where the case puts the part, or where it comes to rest."""
    solver = FilmSolver(space)
    if case.position is None:
        return rest_from(solver, floating, time, START[case.gap])
    return held_at(solver, floating, time, case.position)


def gap_cells(case: GapCase) -> Cells:
    """The counts of cells that the gap's mesh is made of: the usual ones, times `case.finer`."""
    first, second = CELLS[case.gap]
    return first * case.finer, second * case.finer


def true_place(case: GapCase) -> Callable[[Array], Array]:
    """Map of the gap's film plane (n, 2) m to its place in the pump (n, 3) m."""
    return place_of(case.gap, case.rotor, case.parts, case.shaft_angle)


def gap_summary(study: GapStudy) -> dict[str, Any]:
    """What a gap adds to a film's summary, SI with the unit in the key; position as the gap's film counts it."""
    film = study.film
    return {
        "position_source": study.source.value,
        "position_m": [float(value) + 0.0 for value in film.position],
        "held_by": ", ".join(kind.value for kind in film.active),
        "required_load_N": film.required_load,
        "carried_load_N": film.carried_load,
        "contact_load_N": film.contact_load,
        "film_thickness_mean_m": film.film_thickness_mean,
        "chamber_flow_m3_per_s": film.chamber_flow,
        "leakage_flow_m3_per_s": film.leakage_flow,
        "friction_power_W": film.friction_power,
        "assumptions": list(study.assumptions),
    }


def gap_warnings(study: GapStudy) -> list[dict[str, str]]:
    """A load that the film at the given position does not carry: name and text."""
    film = study.film
    if study.source is PositionSource.REST or film.holds_its_load:
        return []
    text = f"the film carries {film.carried_load:.0f} N of {film.required_load:.0f} N at the position given"
    return [{"name": "load_not_carried", "text": text}]
