"""Film of a gap whose part stands still at one instant, at a given position or at rest: supported load, and report."""

from dataclasses import dataclass
from functools import partial
from typing import Generic

import numpy as np

from gaps.films.block import BlockFilm
from gaps.films.piston import PistonFilm
from gaps.films.reports import (
    Active,
    BlockReport,
    PistonReport,
    Reported,
    SlipperReport,
    block_report,
    piston_report,
    slipper_report,
)
from gaps.films.slipper import SlipperFilm
from reynolds.errors import FilmNotConverged
from reynolds.floating.problem import Floating
from reynolds.floating.rest import come_to_rest
from reynolds.floating.stage import FloatingStage
from reynolds.floating.start import pressed, started
from reynolds.floating.step import solve_stage
from reynolds.laws.oil import CONTINUUM
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.loads import Loads, loads
from reynolds.solve.solver import FilmSolver

LOAD_TOLERANCE = 1e-3
"""Share of the required load by which a film's supported load may differ from it and still balance it."""
FIRST_STEP = 1e-3  # s, in which parts of a pump answer to their load through films of a micrometre
SOFTENING = 1e-2  # of it, in which elastic walls deform under their first load
STILL = 1e-10  # m, by which a part at rest may still move in a step


@dataclass(frozen=True)
class GapFilm(Generic[Reported]):
    """Film of a gap at one instant, SI; the part neither approaches nor tilts.

    position (k,) m, as the gap's film counts it; friction_power W of the moving parts; required_load N and carried_load
    N: the force that presses the parts together and the supported load of film, pockets and contact, both in the load's
    direction.
    """

    solution: FilmSolution
    loads: Loads
    position: Array
    report: Reported
    friction_power: float
    required_load: float
    carried_load: float

    @property
    def chamber_flow(self) -> float:
        """Flow (m3/s) out of the chambers into the gap."""
        return float(self.report.flow.sum())

    @property
    def leakage_flow(self) -> float:
        """Flow (m3/s) out of the gap into the case."""
        return self.report.leakage

    @property
    def contact_load(self) -> float:
        """Integral of the asperities' pressure, N."""
        return self.report.contact_load

    @property
    def active(self) -> tuple[Active, ...]:
        """Limiting states of the part."""
        return self.report.active

    @property
    def carried_fraction(self) -> float:
        """Share of the required load that the film supports; 1 where it is zero."""
        return self.carried_load / self.required_load if self.required_load > 0.0 else 1.0

    @property
    def holds_its_load(self) -> bool:
        """True where film and load balance to LOAD_TOLERANCE."""
        return abs(self.carried_fraction - 1.0) < LOAD_TOLERANCE

    @property
    def film_thickness_mean(self) -> float:
        """Area mean of the film thickness (m)."""
        area = self.solution.problem.space.area
        return float(np.sum(self.solution.film.thickness * area) / np.sum(area))


def rest_from(solver: FilmSolver, floating: Floating, time: float, start: Array) -> FloatingStage:
    """The part at rest under its drive at `time` (s), nearest to a start (k,) m as `come_to_rest` finds it.

    Raises FilmNotConverged, with its last move, for a part without rest: pulled off, pressed on walls that do not bear,
    or on a film below CONTINUUM.
    """
    begin = started(floating, time, start)
    if floating.shape_at(time).walls is not None:
        begin = pressed(solver, floating, begin, SOFTENING * FIRST_STEP)
    found = come_to_rest(partial(solve_stage, solver, floating), begin, FIRST_STEP, STILL).stage
    least = float(found.solution.film.thickness.min())
    if least < CONTINUUM and not np.any(found.contact_force):
        raise FilmNotConverged(
            f"{floating.name} finds no rest: its least film is {1e9 * least:.2g} nm, expected {1e9 * CONTINUUM:g} nm "
            "at least: thinner oil is no continuum",
            "less load",
        )
    return found


def standing_piston_film(film: PistonFilm, stage: FloatingStage) -> GapFilm[PistonReport]:
    """Film of a piston that does not move across its bore (`gaps.films.piston.standing_piston`)."""
    across = stage.outer.force.reshape(2, 2).sum(axis=0)
    required = float(np.hypot(*across))
    supported = (stage.film_force + stage.contact_force).reshape(2, 2).sum(axis=0)
    report = piston_report(film, stage, standing=True)
    return GapFilm(
        solution=stage.solution,
        loads=loads(stage.solution),
        position=stage.q,
        report=report,
        friction_power=report.friction.power,
        required_load=required,
        carried_load=-float(supported @ across) / max(required, 1e-300),
    )


def standing_slipper_film(film: SlipperFilm, stage: FloatingStage) -> GapFilm[SlipperReport]:
    """Film of a slipper that keeps its position; the required load is zero where it is pulled off the plate."""
    report = slipper_report(film, stage)
    return GapFilm(
        solution=stage.solution,
        loads=loads(stage.solution),
        position=stage.q,
        report=report,
        friction_power=report.friction.power,
        required_load=max(-float(stage.outer.force[0]), 0.0),
        carried_load=float(stage.film_force[0] + stage.contact_force[0]),
    )


def standing_block_film(film: BlockFilm, stage: FloatingStage) -> GapFilm[BlockReport]:
    """Film of a block that turns but keeps its position (`gaps.films.block.standing_block`), webs left out."""
    solution, drive = stage.solution, film.drive
    required = -float(drive.press(drive.shaft_speed * stage.time)[0])
    report = block_report(film, stage)
    return GapFilm(
        solution=solution,
        loads=loads(solution, film.is_film(solution.problem.space)),
        position=stage.q,
        report=report,
        friction_power=report.torque * drive.shaft_speed,
        required_load=required,
        carried_load=float(stage.film_force[0] + stage.contact_force[0] + stage.outer.force[0]) + required,
    )
