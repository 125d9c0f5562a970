"""The three gaps over one revolution at given positions: films at every shaft angle, flows and their slopes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gaps.films.block import BlockFilm, standing_block
from gaps.films.physics import Effect, Physics
from gaps.films.piston import PistonFilm, standing_piston
from gaps.films.slipper import SlipperFilm, floating_slipper
from gaps.revolution.film_heat import GapHeat
from gaps.standing.conductances import (
    carried_power,
    kidney_conductances,
    piston_conductance,
    slipper_conductance,
)
from gaps.standing.gap_film import GapFilm, ValvePlateFilm
from gaps.standing.heat import warm_turn
from gaps.standing.reports import block_told, piston_told, slipper_told
from reynolds.floating.problem import Floating
from reynolds.floating.rest import held_at
from reynolds.floating.step import Stage
from reynolds.laws.fluid import isoviscous
from reynolds.numerics.arrays import Array
from reynolds.solve.solver import FilmSolver
from system.films.drives import drives, no_rubbing
from system.films.heat import block_heat, piston_heat, slipper_heat
from system.films.parts import FloatingParts
from system.films.positions import given_block, given_piston, given_slipper
from system.films.problems import RIGID, Cells, block_film, piston_film, slipper_film
from system.films.rotor import Rotor
from system.work.progress import Report, silent

PISTON_CELLS, SLIPPER_CELLS, RING_CELLS = (48, 16), (12, 48), (8, 32)
"""Of the ring so many around that mesh lines meet REF90's port edges at the film angles."""
SMOOTH = RIGID.without(Effect.ROUGHNESS)
"""At a given position nothing touches: what asperities would bear and rub stands in the pairs' coefficients."""


@dataclass(frozen=True)
class GapPhysics:
    """The physics of each gap's film."""

    piston: Physics = SMOOTH
    slipper: Physics = SMOOTH
    valve_plate: Physics = SMOOTH

    @classmethod
    def alike(cls, physics: Physics) -> GapPhysics:
        """The same in all three."""
        return cls(physics, physics, physics)


PLAIN = GapPhysics()


@dataclass(frozen=True)
class GapCycle:
    """Films of one piston and one slipper at N shaft angles and of the ring at N/z block angles, SI.

    shaft_angle (N,) rad from inner dead centre; the ring's films stand at the first N/z of them, in which every
    chamber passes through all N. flow (3, N) m3/s out of one chamber at that angle into piston, slipper and
    valve-plate gap; conductance (3, N) m3/(s Pa) are its slopes with the chamber's pressure; carried_power (N/z,)
    W: what the flow that the block drags along takes from kidneys and ports.
    """

    shaft_angle: Array
    chamber_pressure: Array
    piston: tuple[GapFilm, ...]
    slipper: tuple[GapFilm, ...]
    valve_plate: tuple[ValvePlateFilm, ...]
    flow: Array
    conductance: Array
    carried_power: Array


def gap_cycle(
    rotor: Rotor,
    parts: FloatingParts,
    shaft_angle: Array,
    chamber_pressure: Array,
    report: Report = silent,
    *,
    physics: GapPhysics = PLAIN,
    rubbing: tuple[float, float, float] = (0.0, 0.0, 0.0),
    finer: float = 1.0,
) -> GapCycle:
    """All films at equidistant `shaft_angle` (N,), N a multiple of the pistons, and pressures (N,) Pa.

    Meshes have `finer` times the usual cells each way. Parts stand where the description gives them. With heat in
    a gap's physics its walls are as warm as films and `rubbing` make them, the mean loss of contact of one piston,
    one slipper and the ring (W). Raises FilmInputError where parts touch where they stand, FilmNotConverged.
    """
    count = len(shaft_angle)
    driven = drives(rotor, parts, shaft_angle, chamber_pressure, no_rubbing(count))
    positions = count // rotor.pump.pump.pistons
    steps = 2 * count + positions

    def told(done: int, what: str) -> None:
        report(done, steps, f"{what} films")

    piston = piston_film(rotor, parts, driven.piston, physics.piston, _finer(PISTON_CELLS, finer))
    slipper = slipper_film(rotor, parts, driven.slipper, physics.slipper, _finer(SLIPPER_CELLS, finer))
    block = block_film(rotor, parts, driven.block, physics.valve_plate, _finer(RING_CELLS, finer))
    warm = [
        _Warm(heat(rotor, parts), rubs) if of.heat else None
        for of, heat, rubs in zip(
            (physics.piston, physics.slipper, physics.valve_plate),
            (piston_heat, slipper_heat, block_heat),
            rubbing,
            strict=True,
        )
    ]
    pistons, of_piston = _pistons(rotor, piston, shaft_angle, warm[0], lambda k: told(k, "piston"))
    slippers, of_slipper = _slippers(rotor, slipper, shaft_angle, warm[1], lambda k: told(count + k, "slipper"))
    ring, slopes, carried = _ring(
        rotor, block, shaft_angle[:positions], warm[2], lambda k: told(2 * count + k, "valve-plate")
    )
    # (position, chamber) -> the chamber's own angle.
    drawn, of_ring = (by_chamber.T.ravel() for by_chamber in (np.array([f.chamber_flows for f in ring]), slopes))
    return GapCycle(
        shaft_angle=shaft_angle,
        chamber_pressure=np.array([float(driven.piston.chamber_pressure(angle)) for angle in shaft_angle]),
        piston=pistons,
        slipper=slippers,
        valve_plate=ring,
        flow=np.array([[f.chamber_flow for f in pistons], [f.chamber_flow for f in slippers], drawn]),
        conductance=np.array([of_piston, of_slipper, of_ring]),
        carried_power=carried,
    )


@dataclass(frozen=True)
class _Warm:
    """Heat of a gap, and the mean loss of contact in it, W."""

    heat: GapHeat
    rubbing: float


def _finer(cells: Cells, times: float) -> Cells:
    return round(cells[0] * times), round(cells[1] * times)


def _held(
    solver: FilmSolver,
    floating: Floating,
    speed: float,
    places: Sequence[tuple[float, Array]],
    warm: _Warm | None,
    told: Callable[[int], None],
) -> list[Stage]:
    """Films at shaft angles (rad) and positions, each from that before; stiffening oil from a film of its own."""
    stages: list[Stage] = []
    for k, (angle, place) in enumerate(places):
        stiffens = floating.shape_at(angle / speed).fluid.viscosity is not isoviscous
        last = stages[-1].solution if stages and not stiffens else None
        stages.append(held_at(solver, floating, angle / speed, place, last))
        told(k + 1)
    return stages if warm is None else warm_turn(solver, floating, stages, warm.heat, warm.rubbing)


def _pistons(
    rotor: Rotor, film: PistonFilm, angles: Array, warm: _Warm | None, told: Callable[[int], None]
) -> tuple[tuple[GapFilm, ...], list[float]]:
    """Films and conductances."""
    solver, floating = FilmSolver(film.space_at(0.0)), standing_piston(film)
    places = [(angle, given_piston(rotor.pump, film.drive.outer(angle))) for angle in angles]
    stages = _held(solver, floating, film.drive.shaft_speed, places, warm, told)
    slopes = [piston_conductance(solver, stage) for stage in stages]
    return tuple(piston_told(film, stage) for stage in stages), slopes


def _slippers(
    rotor: Rotor, film: SlipperFilm, angles: Array, warm: _Warm | None, told: Callable[[int], None]
) -> tuple[tuple[GapFilm, ...], list[float]]:
    """Films and conductances."""
    solver, floating = FilmSolver(film.space), floating_slipper(film)
    places = [(angle, given_slipper(rotor, angle)) for angle in angles]
    stages = _held(solver, floating, film.drive.shaft_speed, places, warm, told)
    slopes = [slipper_conductance(solver, film, stage) for stage in stages]
    return tuple(slipper_told(film, stage) for stage in stages), slopes


def _ring(
    rotor: Rotor, film: BlockFilm, angles: Array, warm: _Warm | None, told: Callable[[int], None]
) -> tuple[tuple[ValvePlateFilm, ...], Array, Array]:
    """Films, conductances (N/z, z) and carried power."""
    solver, floating = FilmSolver(film.space), standing_block(film)
    places = [(angle, given_block(rotor.pump)) for angle in angles]
    stages = _held(solver, floating, film.drive.shaft_speed, places, warm, told)
    slopes = np.array([kidney_conductances(solver, film, stage) for stage in stages])
    carried = np.array([carried_power(solver, film, stage) for stage in stages])
    return tuple(block_told(film, stage) for stage in stages), slopes, carried
