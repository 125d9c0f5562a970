"""A part that stands still in its gap at one instant, put somewhere or at rest: what its film tells."""

from __future__ import annotations

from functools import partial

import numpy as np

from gaps.films.block import BlockFilm
from gaps.films.piston import PistonFilm
from gaps.films.slipper import SlipperFilm
from gaps.revolution.reports import active
from gaps.standing.gap_film import GapFilm, ValvePlateFilm
from reynolds.floating.problem import Floating
from reynolds.floating.rest import come_to_rest
from reynolds.floating.start import pressed, started
from reynolds.floating.step import Stage, solve_stage
from reynolds.numerics.arrays import Array
from reynolds.solve.loads import boundary_flows, loads
from reynolds.solve.solver import FilmSolver

FIRST_STEP = 1e-3  # s, in which parts of a pump answer to their load through films of a micrometre
SOFTENING = 1e-2  # of it, in which elastic walls give way to their first load
STILL = 1e-10  # m, by which a part at rest may still move in a step


def rest_from(solver: FilmSolver, floating: Floating, time: float, start: Array) -> Stage:
    """The part at rest under what drives it at `time` (s), nearest to a start (k,) m as `come_to_rest` finds it.

    Raises FilmNotConverged, with its last move, for a part that finds none: pulled off, or pressed on walls that
    do not bear.
    """
    begin = started(floating, time, start)
    if floating.shape_at(time).walls is not None:
        begin = pressed(solver, floating, begin, SOFTENING * FIRST_STEP)
    found = come_to_rest(partial(solve_stage, solver, floating), begin, FIRST_STEP, STILL)
    return found.stage


def piston_told(film: PistonFilm, stage: Stage) -> GapFilm:
    """What the film of a standing piston tells (`standing_piston`)."""
    across = stage.outer.force.reshape(2, 2).sum(axis=0)
    required = float(np.hypot(*across))
    flows, by = boundary_flows(stage.solution), film.rubbed(stage)
    borne = (stage.film_force + stage.contact_force).reshape(2, 2).sum(axis=0)
    return GapFilm(
        solution=stage.solution,
        loads=loads(stage.solution),
        position=stage.q,
        chamber_flow=film.standing_flow(stage, flows),
        leakage_flow=flows["case"],
        friction_power=film.friction(stage, by).power,
        required_load=required,
        carried_load=-float(borne @ across) / max(required, 1e-300),
        contact_load=by.load(),
        active=active(stage, film.asperities),
    )


def slipper_told(film: SlipperFilm, stage: Stage) -> GapFilm:
    """What the film of a standing slipper tells; its load is zero where it is pulled off the plate."""
    flows, by = boundary_flows(stage.solution), film.rubbed(stage)
    return GapFilm(
        solution=stage.solution,
        loads=loads(stage.solution),
        position=stage.q,
        chamber_flow=film.supplied(stage)[1],
        leakage_flow=sum(flows[edge] for edge in film.shape.lands.open),
        friction_power=film.friction(stage, by).power,
        required_load=max(-float(stage.outer.force[0]), 0.0),
        carried_load=float(stage.film_force[0] + stage.contact_force[0]),
        contact_load=by.load(),
        active=active(stage, film.asperities, held=bool(np.any(stage.outer.by_position))),
    )


def block_told(film: BlockFilm, stage: Stage) -> ValvePlateFilm:
    """What the film of a standing block tells (`standing_block`); webs over the ports are no film."""
    solution, drive = stage.solution, film.drive
    space, flows, by = solution.problem.space, boundary_flows(solution), film.rubbed(stage)
    is_film = film.is_film(space)
    required = -float(drive.press(drive.shaft_speed * stage.time)[0])
    chambers, suction, delivery = film.inflows(solution, flows)
    gap = GapFilm(
        solution=solution,
        loads=loads(solution, is_film),
        position=stage.q,
        chamber_flow=float(chambers.sum()),
        leakage_flow=sum(flows[edge] for edge in film.geometry.case_edges),
        friction_power=film.friction_torque(space, by) * drive.shaft_speed,
        required_load=required,
        carried_load=float(stage.film_force[0] + stage.contact_force[0] + stage.outer.force[0]) + required,
        contact_load=by.load(is_film),
        active=active(stage, film.asperities),
    )
    return ValvePlateFilm(gap, chambers, suction, delivery)
