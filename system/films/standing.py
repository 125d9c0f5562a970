"""Gaps with parts held across their films: mesh, solver, given position and report of each."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic, TypeVar, assert_never

from gaps.films.block import BlockDrive, BlockFilm, standing_block
from gaps.films.physics import Physics
from gaps.films.piston import PistonDrive, PistonFilm, standing_piston
from gaps.films.reports import BlockReport, PistonReport, Reported, SlipperReport
from gaps.films.slipper import SlipperDrive, SlipperFilm, floating_slipper
from gaps.standing.gap_film import GapFilm, standing_block_film, standing_piston_film, standing_slipper_film
from reynolds.floating.problem import Floating
from reynolds.floating.rest import held_at
from reynolds.floating.stage import FloatingStage
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.solver import FilmSolver
from system.description.gap import Gap
from system.films.drives import Drives
from system.films.parts import FloatingParts
from system.films.positions import given_block, given_piston, given_slipper
from system.films.problems import Cells, block_film, piston_film, slipper_film
from system.films.rotor import Rotor

CELLS: Mapping[Gap, Cells] = {Gap.PISTON: (48, 16), Gap.SLIPPER: (12, 48), Gap.VALVE_PLATE: (8, 32)}
"""Usual cells; of the ring so many around that mesh lines meet REF90's port edges at the film angles."""
FilmOf = TypeVar("FilmOf", PistonFilm, SlipperFilm, BlockFilm)


@dataclass(frozen=True)
class StandingGap(Generic[FilmOf, Reported]):
    """A gap whose part stands still: its film, and the solver for it.

    given: position (k,) m by the pump file at a shaft angle (rad); report: the gap's film of a stage.
    """

    film: FilmOf
    floating: Floating
    solver: FilmSolver
    given: Callable[[float], Array]
    report: Callable[[FloatingStage], GapFilm[Reported]]

    def time(self, shaft_angle: float) -> float:
        """Time (s) of a shaft angle (rad)."""
        return shaft_angle / self.film.drive.shaft_speed

    def held_at(
        self, shaft_angle: float, position: Array | None = None, start: FilmSolution | None = None
    ) -> FloatingStage:
        """The film at a shaft angle (rad) and a position (k,) m, by default the given one; raises as `held_at`."""
        place = self.given(shaft_angle) if position is None else position
        return held_at(self.solver, self.floating, self.time(shaft_angle), place, start)


def finer_cells(gap: Gap, times: float) -> Cells:
    """The usual cells of a gap, `times` as many each way."""
    first, second = CELLS[gap]
    return round(first * times), round(second * times)


def standing_piston_gap(
    rotor: Rotor, parts: FloatingParts, drive: PistonDrive, physics: Physics, finer: float = 1.0
) -> StandingGap[PistonFilm, PistonReport]:
    """The piston gap, on meshes `finer` times the usual."""
    film = piston_film(rotor, parts, drive, physics, finer_cells(Gap.PISTON, finer))
    solver, report = FilmSolver(film.space_at(0.0)), partial(standing_piston_film, film)
    return StandingGap(
        film, standing_piston(film), solver, lambda angle: given_piston(rotor.pump, drive.outer(angle)), report
    )


def standing_slipper_gap(
    rotor: Rotor, parts: FloatingParts, drive: SlipperDrive, physics: Physics, finer: float = 1.0
) -> StandingGap[SlipperFilm, SlipperReport]:
    """The slipper gap, on meshes `finer` times the usual."""
    film = slipper_film(rotor, parts, drive, physics, finer_cells(Gap.SLIPPER, finer))
    solver, report = FilmSolver(film.space), partial(standing_slipper_film, film)
    return StandingGap(film, floating_slipper(film), solver, partial(given_slipper, rotor), report)


def standing_block_gap(
    rotor: Rotor, parts: FloatingParts, drive: BlockDrive, physics: Physics, finer: float = 1.0
) -> StandingGap[BlockFilm, BlockReport]:
    """The valve-plate gap, on meshes `finer` times the usual."""
    film = block_film(rotor, parts, drive, physics, finer_cells(Gap.VALVE_PLATE, finer))
    solver, report = FilmSolver(film.space), partial(standing_block_film, film)
    return StandingGap(film, standing_block(film), solver, lambda angle: given_block(rotor.pump), report)


def standing_gap(
    gap: Gap, rotor: Rotor, parts: FloatingParts, drives: Drives, physics: Physics, finer: float = 1.0
) -> StandingGap[Any, Any]:
    """One of the three gaps, on meshes `finer` times the usual."""
    match gap:
        case Gap.PISTON:
            return standing_piston_gap(rotor, parts, drives.piston, physics, finer)
        case Gap.SLIPPER:
            return standing_slipper_gap(rotor, parts, drives.slipper, physics, finer)
        case Gap.VALVE_PLATE:
            return standing_block_gap(rotor, parts, drives.block, physics, finer)
    assert_never(gap)
