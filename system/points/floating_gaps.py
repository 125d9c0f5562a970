"""One floating gap of a pump over the revolution: the pump's parts and loads applied to its films."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from gaps.films.block import BlockDrive, floating_block
from gaps.films.physics import Effect, Physics
from gaps.films.piston import PistonDrive, floating_piston
from gaps.films.reports import (
    BlockReport,
    PistonReport,
    Reported,
    SlipperReport,
    block_report,
    piston_report,
    slipper_report,
)
from gaps.films.slipper import SlipperDrive, floating_slipper
from gaps.revolution.film_heat import GapHeat, warm_revolution
from gaps.revolution.march import GapRevolution, TurnReport, run_revolution
from gaps.revolution.schedule import Accuracy, Schedule, evenly
from gaps.revolution.stopped import TurnStopped, replaced
from reynolds.errors import FilmNotConverged
from reynolds.fem.space import FilmSpace
from reynolds.floating.problem import Floating
from reynolds.floating.stage import FloatingStage
from reynolds.numerics.arrays import Array
from reynolds.solve.solver import FilmSolver
from system.films.heat import block_heat, piston_heat, slipper_heat
from system.films.parts import FloatingParts
from system.films.problems import block_film, piston_film, slipper_film
from system.films.rotor import Rotor
from system.points.floating_balance import Shortfall, block_shortfall, piston_shortfall, slipper_shortfall
from system.pump.chamber_kinds import kinds
from system.work.progress import Report, silent

MARCHED = Accuracy(step=1e-2, balance=0.1)
PISTON_CELLS, SLIPPER_CELLS, BLOCK_CELLS = (48, 24), (12, 72), (6, 24)
LEAST_CELLS = 2
LEAST_PISTON_CELLS = 8
"""Along a bore: with fewer cells, the ends of a tilted piston's film with much clearance lie between their points."""
FINER = 0.5
"""Multiple of these cells in films, unless stated otherwise."""
SLIPPER_START = BLOCK_START = 1e-5  # m: initial film of every pump
SOFTLY = "a coarser mesh to find where, or rigid walls"
STIFFLY = "elastic walls, or oil of one viscosity: under an edge that cannot yield, oil that stiffens has no bound"
USUAL = Physics()
"""Physics of films at high pressure: elastic walls, viscosity that rises with pressure, rough walls, cavities."""


@dataclass(frozen=True)
class FloatingOptions:
    """Options of floating gaps: physics, steps per turn, accuracy, meshes `finer` times the usual.

    `finer` below one gives larger cells. Every `keep`th film is kept.
    """

    physics: Physics = field(default=USUAL)
    steps: int = 360
    accuracy: Accuracy = field(default=MARCHED)
    finer: float = FINER
    keep: int = 10

    @property
    def rigid(self) -> FloatingOptions:
        """The same between rigid walls, with oil that neither pressure nor heat changes."""
        return replace(self, physics=self.physics.without(Effect.ELASTIC_WALLS, Effect.PRESSURE_VISCOSITY, Effect.HEAT))

    @property
    def piston_cells(self) -> tuple[int, int]:
        """Cells around and along the piston's film."""
        return self._cells(PISTON_CELLS, LEAST_PISTON_CELLS)

    @property
    def slipper_cells(self) -> tuple[int, int]:
        """Cells across each land of the slipper and around it."""
        return self._cells(SLIPPER_CELLS)

    @property
    def block_cells(self) -> tuple[int, int]:
        """Cells across each land of the valve plate and around a piston pitch."""
        return self._cells(BLOCK_CELLS)

    def _cells(self, cells: tuple[int, int], least: int = LEAST_CELLS) -> tuple[int, int]:
        return max(least, round(self.finer * cells[0])), max(least, round(self.finer * cells[1]))


def usual_options(pistons: int) -> FloatingOptions:
    """Default options of a pump: a number of steps near the usual that its pistons divide."""
    usual = FloatingOptions()
    return replace(usual, steps=round(usual.steps / pistons) * pistons)


def piston_revolution(
    rotor: Rotor,
    parts: FloatingParts,
    drive: PistonDrive,
    options: FloatingOptions,
    before: GapRevolution[PistonReport] | None = None,
    report: Report = silent,
) -> GapRevolution[PistonReport]:
    """The piston over the turn, from the middle of its bore or continued from a revolution `before`.

    Raises as `run_revolution`; a turn that stops with the balance of forces there.
    """
    cells = options.piston_cells
    film = piston_film(rotor, parts, drive, options.physics, cells)
    floating, schedule = floating_piston(film), evenly(drive.shaft_speed, options.steps, keep=options.keep)
    progress = _of_turn(report, options.steps, "piston")
    report_of = partial(piston_report, film)
    heat = piston_heat(rotor, parts) if options.physics.heat else None
    space, start = film.space_at(0.0), np.zeros(4)
    try:
        return _run(space, floating, schedule, start, report_of, options, heat, before, progress)
    except TurnStopped as stopped:
        raise _short_of(stopped, piston_shortfall(rotor, drive, stopped.angle)) from stopped


def slipper_revolution(
    rotor: Rotor,
    parts: FloatingParts,
    drive: SlipperDrive,
    options: FloatingOptions,
    before: GapRevolution[SlipperReport] | None = None,
    report: Report = silent,
) -> GapRevolution[SlipperReport]:
    """The slipper over the turn, from a film of SLIPPER_START without tilt or continued from a revolution `before`.

    Raises as `run_revolution`; a turn that stops with the balance of forces there.
    """
    cells = options.slipper_cells
    film = slipper_film(rotor, parts, drive, options.physics, cells)
    floating, schedule = floating_slipper(film), evenly(drive.shaft_speed, options.steps, keep=options.keep)
    start, progress = np.array([SLIPPER_START, 0.0, 0.0]), _of_turn(report, options.steps, "slipper")
    report_of = partial(slipper_report, film)
    heat = slipper_heat(rotor, parts) if options.physics.heat else None
    try:
        return _run(film.space, floating, schedule, start, report_of, options, heat, before, progress)
    except TurnStopped as stopped:
        raise _short_of(stopped, slipper_shortfall(rotor, drive, stopped.angle)) from stopped


def block_revolution(
    rotor: Rotor,
    parts: FloatingParts,
    drive: BlockDrive,
    options: FloatingOptions,
    before: GapRevolution[BlockReport] | None = None,
    report: Report = silent,
) -> GapRevolution[BlockReport]:
    """The block over the turn, or over a piston pitch where chambers are equal, after which the motion repeats.

    From a film of BLOCK_START without tilt or continued from a revolution `before`; between elastic walls from the
    result between rigid ones. Raises ValueError where the pitches do not divide the steps, else as `run_revolution`; a
    turn that stops with the balance of forces there.
    """
    pistons, pump = rotor.pump.pump.pistons, rotor.pump
    if options.steps % pistons:
        raise ValueError(f"steps: found {options.steps}, expected a multiple of the {pistons} pistons")
    if before is None and (first := _between_rigid(rotor, parts, drive, options, report)):
        then = block_revolution(rotor, parts, drive, options, first.bare, report)
        films = first.films_solved + then.films_solved
        return replace(then, films_solved=films, spent={**first.spent, **then.spent})
    alike = kinds(pump).alike
    steps, span = (options.steps // pistons, 2.0 * np.pi / pistons) if alike else (options.steps, 2.0 * np.pi)
    film = block_film(rotor, parts, drive, options.physics, options.block_cells)
    schedule = evenly(drive.shaft_speed, steps, span, options.keep)
    start, progress = np.array([BLOCK_START, 0.0, 0.0]), _of_turn(report, steps, "block")
    report_of = partial(block_report, film)
    heat = block_heat(rotor, parts) if options.physics.heat else None
    try:
        return _run(film.space, floating_block(film), schedule, start, report_of, options, heat, before, progress)
    except TurnStopped as stopped:
        raise _short_of(stopped, block_shortfall(rotor, drive, stopped.angle)) from stopped


def _short_of(stopped: TurnStopped, shortfall: Shortfall) -> FilmNotConverged:
    """The same end of a turn, with the balance of forces there."""
    return replaced(stopped, f"{stopped.what}; {shortfall.what}", f"{shortfall.remedy}; {stopped.remedy}")


def _between_rigid(
    rotor: Rotor, parts: FloatingParts, drive: BlockDrive, options: FloatingOptions, report: Report
) -> GapRevolution[BlockReport] | None:
    """Start of a block between elastic walls: its turn between rigid ones, at a tenth of the cost.

    A block approaches its periodic motion only over several pitches. None where walls are rigid, and where no
    turn converges between rigid ones: elastic ones may still converge.
    """
    if not options.physics.elastic_walls:
        return None
    try:
        return block_revolution(rotor, parts, drive, options.rigid, None, report)
    except FilmNotConverged:
        return None


def _run(
    space: FilmSpace,
    floating: Floating,
    schedule: Schedule,
    start: Array,
    report_of: Callable[[FloatingStage], Reported],
    options: FloatingOptions,
    heat: GapHeat | None,
    before: GapRevolution[Reported] | None,
    report: TurnReport,
) -> GapRevolution[Reported]:
    solver, accuracy = FilmSolver(space), options.accuracy
    try:
        march = run_revolution if heat is None else partial(warm_revolution, heat=heat)
        return march(solver, floating, schedule, start, report_of, accuracy=accuracy, before=before, report=report)
    except FilmNotConverged as reason:
        if options.physics.elastic_walls:
            raise replaced(reason, f"between elastic walls, {reason.what}", f"{reason.remedy}; {SOFTLY}") from None
        if options.physics.pressure_viscosity:
            raise replaced(reason, reason.what, f"{STIFFLY}; {reason.remedy}") from None
        raise


def _of_turn(report: Report, steps: int, gap: str) -> TurnReport:
    """Progress of a gap's turn by its share, in the turn's angles."""
    return lambda turn, share: report(int(share * steps), steps, f"{gap}, {turn}")
