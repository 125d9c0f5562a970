"""The three gaps over one revolution at given positions: films at every shaft angle, flows and their slopes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from gaps.films.physics import Effect, Physics
from gaps.films.reports import BlockReport
from gaps.revolution.film_heat import GapHeat
from gaps.standing.conductances import drag_power, kidney_conductances, piston_conductance, slipper_conductance
from gaps.standing.gap_film import GapFilm
from gaps.standing.heat import warm_turn
from reynolds.floating.stage import FloatingStage
from reynolds.laws.fluid import isoviscous
from reynolds.numerics.arrays import Array
from system.films.drives import drives, no_rubbing
from system.films.heat import block_heat, piston_heat, slipper_heat
from system.films.parts import FloatingParts
from system.films.problems import RIGID
from system.films.rotor import Rotor
from system.films.standing import StandingGap, standing_block_gap, standing_piston_gap, standing_slipper_gap
from system.work.progress import Report, silent

SMOOTH = RIGID.without(Effect.ROUGHNESS)
"""At a given position nothing touches: load and friction of asperities are in the pairs' coefficients."""


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

    shaft_angle (N,) rad from inner dead centre; the ring's films are at the first N/z of them, in which every
    chamber passes through all N. flow (3, N) m3/s out of one chamber at that angle into piston, slipper and
    valve-plate gap; conductance (3, N) m3/(s Pa) are its slopes with the chamber's pressure; drag_power (N/z,)
    W: power of the block's drag flow from kidneys and ports.
    """

    shaft_angle: Array
    chamber_pressure: Array
    piston: tuple[GapFilm, ...]
    slipper: tuple[GapFilm, ...]
    valve_plate: tuple[GapFilm[BlockReport], ...]
    flow: Array
    conductance: Array
    drag_power: Array


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

    Meshes have `finer` times the usual cells each way. Parts have the positions of the pump file. With heat in
    a gap's physics its walls are warmed by films and `rubbing`, the mean loss of contact of one piston,
    one slipper and the ring (W). Raises InputError where parts touch, FilmNotConverged.
    """
    count = len(shaft_angle)
    driven = drives(rotor, parts, shaft_angle, chamber_pressure, no_rubbing(count))
    positions = count // rotor.pump.pump.pistons
    steps = 2 * count + positions

    def progress(done: int, what: str) -> None:
        report(done, steps, f"{what} films")

    piston = standing_piston_gap(rotor, parts, driven.piston, physics.piston, finer)
    slipper = standing_slipper_gap(rotor, parts, driven.slipper, physics.slipper, finer)
    block = standing_block_gap(rotor, parts, driven.block, physics.valve_plate, finer)
    warm = _warming(rotor, parts, physics, rubbing)
    of_piston = _held(piston, shaft_angle, warm[0], lambda k: progress(k, "piston"))
    of_slipper = _held(slipper, shaft_angle, warm[1], lambda k: progress(count + k, "slipper"))
    of_ring = _held(block, shaft_angle[:positions], warm[2], lambda k: progress(2 * count + k, "valve-plate"))
    pistons, slippers = tuple(map(piston.report, of_piston)), tuple(map(slipper.report, of_slipper))
    ring = tuple(map(block.report, of_ring))
    # (position, chamber) -> the chamber's own angle.
    drawn = np.array([film.report.flow for film in ring]).T.ravel()
    kidneys = np.array([kidney_conductances(block.solver, block.film, stage) for stage in of_ring]).T.ravel()
    return GapCycle(
        shaft_angle=shaft_angle,
        chamber_pressure=np.array([float(driven.piston.chamber_pressure(angle)) for angle in shaft_angle]),
        piston=pistons,
        slipper=slippers,
        valve_plate=ring,
        flow=np.array([[f.chamber_flow for f in pistons], [f.chamber_flow for f in slippers], drawn]),
        conductance=np.array(
            [
                [piston_conductance(piston.solver, stage) for stage in of_piston],
                [slipper_conductance(slipper.solver, slipper.film, stage) for stage in of_slipper],
                kidneys,
            ]
        ),
        drag_power=np.array([drag_power(block.solver, block.film, stage) for stage in of_ring]),
    )


@dataclass(frozen=True)
class _Warm:
    """Heat of a gap, and the mean loss of contact in it, W."""

    heat: GapHeat
    rubbing: float


def _warming(
    rotor: Rotor, parts: FloatingParts, physics: GapPhysics, rubbing: tuple[float, float, float]
) -> list[_Warm | None]:
    """Heat of each gap, None where its physics has none."""
    return [
        _Warm(heat(rotor, parts), rubs) if of.heat else None
        for of, heat, rubs in zip(
            (physics.piston, physics.slipper, physics.valve_plate),
            (piston_heat, slipper_heat, block_heat),
            rubbing,
            strict=True,
        )
    ]


def _held(
    gap: StandingGap[Any, Any], angles: Array, warm: _Warm | None, progress: Callable[[int], None]
) -> list[FloatingStage]:
    """Films at shaft angles (rad), each started from that before; stiffening oil from a film of its own."""
    stages: list[FloatingStage] = []
    for k, angle in enumerate(angles):
        stiffens = gap.floating.shape_at(gap.time(angle)).fluid.viscosity is not isoviscous
        last = stages[-1].solution if stages and not stiffens else None
        stages.append(gap.held_at(angle, start=last))
        progress(k + 1)
    return stages if warm is None else warm_turn(gap.solver, gap.floating, stages, warm.heat, warm.rubbing)
