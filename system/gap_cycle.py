"""The three gaps over one revolution at given positions: films at every shaft angle, flows and their slopes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gaps.block_motion import BlockFilm, standing_block
from gaps.physics import Effect
from gaps.piston_motion import PistonFilm, standing_piston
from gaps.pressure_flow import carried_power, kidney_conductances, piston_conductance, slipper_conductance
from gaps.result import GapFilm, ValvePlateFilm
from gaps.slipper_motion import SlipperFilm, floating_slipper
from gaps.standing import block_told, piston_told, slipper_told
from reynolds.floating_stage import Stage
from reynolds.rest import held_at
from reynolds.solve import FilmSolver
from system.floating_drives import drives, no_rubbing
from system.floating_parts import FloatingParts
from system.gap_films import RIGID, Cells, block_film, piston_film, slipper_film
from system.given_positions import given_block, given_piston, given_slipper
from system.instants import Rotor
from system.kinematics import Array

PISTON_CELLS, SLIPPER_CELLS, RING_CELLS = (48, 16), (12, 48), (8, 32)
"""Of the ring so many around that mesh lines meet REF90's port edges at the film angles."""
SMOOTH = RIGID.without(Effect.ROUGHNESS)
"""At a given position nothing touches: what asperities would bear and rub stands in the pairs' coefficients."""
Report = Callable[[int, int, str], None]


def silent(done: int, total: int, what: str) -> None:
    """Report progress to nobody."""


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
    finer: int = 1,
) -> GapCycle:
    """All films at equidistant `shaft_angle` (N,), N a multiple of the pistons, and pressures (N,) Pa.

    Meshes have `finer` times the usual cells each way. Parts stand where the description gives them; raises
    FilmInputError where they touch there.
    """
    count = len(shaft_angle)
    driven = drives(rotor, parts, shaft_angle, chamber_pressure, no_rubbing(count))
    positions = count // rotor.pump.pump.pistons
    steps = 2 * count + positions

    def told(done: int, what: str) -> None:
        report(done, steps, f"{what} films")

    piston = piston_film(rotor, parts, driven.piston, SMOOTH, _finer(PISTON_CELLS, finer))
    slipper = slipper_film(rotor, parts, driven.slipper, SMOOTH, _finer(SLIPPER_CELLS, finer))
    block = block_film(rotor, parts, driven.block, SMOOTH, _finer(RING_CELLS, finer))
    pistons, of_piston = _pistons(rotor, piston, shaft_angle, lambda k: told(k, "piston"))
    slippers, of_slipper = _slippers(rotor, slipper, shaft_angle, lambda k: told(count + k, "slipper"))
    ring, slopes, carried = _ring(
        rotor, block, shaft_angle[:positions], lambda k: told(2 * count + k, "valve-plate")
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


def _finer(cells: Cells, times: int) -> Cells:
    return cells[0] * times, cells[1] * times


def _pistons(
    rotor: Rotor, film: PistonFilm, angles: Array, told: Callable[[int], None]
) -> tuple[tuple[GapFilm, ...], list[float]]:
    """Films and conductances."""
    solver, floating = FilmSolver(film.space_at(0.0)), standing_piston(film)
    found, slopes = [], []
    last: Stage | None = None
    for k, angle in enumerate(angles):
        place = given_piston(rotor.pump, film.drive.outer(angle))
        last = held_at(solver, floating, angle / film.drive.shaft_speed, place, last.solution if last else None)
        found.append(piston_told(film, last))
        slopes.append(piston_conductance(solver, last))
        told(k + 1)
    return tuple(found), slopes


def _slippers(
    rotor: Rotor, film: SlipperFilm, angles: Array, told: Callable[[int], None]
) -> tuple[tuple[GapFilm, ...], list[float]]:
    """Films and conductances."""
    solver, floating = FilmSolver(film.space), floating_slipper(film)
    found, slopes = [], []
    last: Stage | None = None
    for k, angle in enumerate(angles):
        place = given_slipper(rotor, angle)
        last = held_at(solver, floating, angle / film.drive.shaft_speed, place, last.solution if last else None)
        found.append(slipper_told(film, last))
        slopes.append(slipper_conductance(solver, film, last))
        told(k + 1)
    return tuple(found), slopes


def _ring(
    rotor: Rotor, film: BlockFilm, angles: Array, told: Callable[[int], None]
) -> tuple[tuple[ValvePlateFilm, ...], Array, Array]:
    """Films, conductances (N/z, z) and carried power."""
    solver, floating = FilmSolver(film.space), standing_block(film)
    found, slopes, carried = [], [], []
    last: Stage | None = None
    for k, angle in enumerate(angles):
        place = given_block(rotor.pump)
        last = held_at(solver, floating, angle / film.drive.shaft_speed, place, last.solution if last else None)
        found.append(block_told(film, last))
        slopes.append(kidney_conductances(solver, film, last))
        carried.append(carried_power(solver, film, last))
        told(k + 1)
    return tuple(found), np.array(slopes), np.array(carried)
