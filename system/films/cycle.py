"""The three gaps over one revolution at given positions: films at every shaft angle, flows and their slopes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from gaps.films.block import BlockDrive
from gaps.films.physics import Effect, Physics
from gaps.films.piston import PistonDrive
from gaps.films.reports import BlockReport
from gaps.films.slipper import SlipperDrive
from gaps.revolution.film_heat import GapHeat
from gaps.standing.conductances import drag_power, kidney_conductances, piston_conductance, slipper_conductance
from gaps.standing.gap_film import GapFilm
from gaps.standing.heat import warm_turn
from reynolds.floating.stage import FloatingStage
from reynolds.laws.fluid import isoviscous
from reynolds.numerics.arrays import Array
from system.films.drives import Drives, block_drive, drives, no_rubbing
from system.films.heat import block_heat, piston_heat, slipper_heat
from system.films.parts import FloatingParts
from system.films.problems import RIGID
from system.films.rotor import Rotor
from system.films.standing import StandingGap, standing_block_gap, standing_piston_gap, standing_slipper_gap
from system.work.progress import Report, silent

SMOOTH = RIGID.without(Effect.ROUGHNESS)
"""At a given position walls do not touch: load and friction of asperities are in the pairs' coefficients."""


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
Progress = Callable[[int], None]


@dataclass(frozen=True)
class GapKind:
    """Equal chambers: the rotor with their pump, their parts; chambers from 0, of a pump of one kind the first."""

    rotor: Rotor
    parts: FloatingParts
    chambers: tuple[int, ...] = (0,)


@dataclass(frozen=True)
class GapCycle:
    """Films of one piston and one slipper of a kind at N shaft angles and of the ring at its block angles, SI.

    shaft_angle (N,) rad from inner dead centre. The ring's films are at the first N/z of them where all chambers are of
    one kind, in which every chamber passes through all N; else at all. flow (3, N) m3/s out of one chamber (the mean of
    its kind) at that angle into piston, slipper and valve-plate gap; conductance (3, N) m3/(s Pa) are its slopes with
    the chamber's pressure; drag_power (N/z,) or (N,) W: power of the block's drag flow from kidneys and ports.
    """

    shaft_angle: Array
    chamber_pressure: Array
    piston: tuple[GapFilm, ...]
    slipper: tuple[GapFilm, ...]
    valve_plate: tuple[GapFilm[BlockReport], ...]
    flow: Array
    conductance: Array
    drag_power: Array


@dataclass(frozen=True)
class _Films:
    """Films of a part over its angles, the flow into them (N,) m3/s, and its slopes (N,) m3/(s Pa)."""

    films: tuple[GapFilm, ...]
    flow: Array
    conductance: Array


@dataclass(frozen=True)
class _Ring:
    """Films of the ring at P block angles: flow and slopes (P, z) of each chamber, drag power (P,) W."""

    films: tuple[GapFilm[BlockReport], ...]
    flow: Array
    conductance: Array
    drag_power: Array


@dataclass(frozen=True)
class _Asked:
    """A gap of a kind at shaft angles (N,) rad, warmed by the mean loss of contact `rubbing` (W) too."""

    kind: GapKind
    angles: Array
    physics: Physics
    rubbing: float
    finer: float
    progress: Progress


def gap_cycles(
    kinds: Sequence[GapKind],
    shaft_angle: Array,
    chamber_pressure: Sequence[Array],
    report: Report = silent,
    *,
    physics: GapPhysics = PLAIN,
    rubbing: Sequence[tuple[float, float, float]] | None = None,
    finer: float = 1.0,
) -> tuple[GapCycle, ...]:
    """All films at equidistant `shaft_angle` (N,), N a multiple of the pistons, and pressures (N,) Pa of each kind.

    Meshes have `finer` times the usual cells each way. Parts have the positions of the pump file. With heat in a gap's
    physics its walls are warmed by films and `rubbing`, the mean loss of contact of one piston, one slipper and the
    ring (W) of each kind, zero if left out; the ring's is the first's. Raises InputError where parts touch,
    FilmNotConverged.
    """
    count = len(shaft_angle)
    driven = [
        drives(kind.rotor, kind.parts, shaft_angle, pressure, no_rubbing(count))
        for kind, pressure in zip(kinds, chamber_pressure, strict=True)
    ]
    block, positions = _block_drive(kinds, driven, shaft_angle, chamber_pressure)
    rubs, steps, films = rubbing or [(0.0, 0.0, 0.0)] * len(kinds), 2 * count * len(kinds) + len(positions), []

    def told(turns: int, what: str) -> Progress:
        return lambda k: report(turns * count + k, steps, f"{what} films")

    for k, (kind, own, loss) in enumerate(zip(kinds, driven, rubs, strict=True)):
        of_piston = _Asked(kind, shaft_angle, physics.piston, loss[0], finer, told(2 * k, "piston"))
        of_slipper = _Asked(kind, shaft_angle, physics.slipper, loss[1], finer, told(2 * k + 1, "slipper"))
        films.append((_pistons(of_piston, own.piston), _slippers(of_slipper, own.slipper)))
    last = told(2 * len(kinds), "valve-plate")
    ring = _ring(_Asked(kinds[0], positions, physics.valve_plate, rubs[0][2], finer, last), block)
    return tuple(
        _cycle(kind, shaft_angle, own.piston, parts, ring)
        for kind, own, parts in zip(kinds, driven, films, strict=True)
    )


def _block_drive(
    kinds: Sequence[GapKind], driven: Sequence[Drives], shaft_angle: Array, pressure: Sequence[Array]
) -> tuple[BlockDrive, Array]:
    """Drive of the block, and its angles (P,): of a pitch where all chambers are of one kind, else of the turn."""
    first, pistons = kinds[0], kinds[0].rotor.pump.pump.pistons
    if len(kinds) == 1:
        return driven[0].block, shaft_angle[: len(shaft_angle) // pistons]
    of = {chamber: k for k, kind in enumerate(kinds) for chamber in kind.chambers}
    pressures, groups = [pressure[of[k]] for k in range(pistons)], [driven[of[k]].group for k in range(pistons)]
    return block_drive(first.rotor, first.parts, shaft_angle, pressures, groups), shaft_angle


def _cycle(
    kind: GapKind, shaft_angle: Array, drive: PistonDrive, films: tuple[_Films, _Films], ring: _Ring
) -> GapCycle:
    """The gaps of a kind: its piston, its slipper, and its share of the ring."""
    count, (piston, slipper) = len(shaft_angle), films
    drawn, slopes = (_over_turn(of, kind.chambers, count) for of in (ring.flow, ring.conductance))
    return GapCycle(
        shaft_angle=shaft_angle,
        chamber_pressure=np.array([float(drive.chamber_pressure(angle)) for angle in shaft_angle]),
        piston=piston.films,
        slipper=slipper.films,
        valve_plate=ring.films,
        flow=np.array([piston.flow, slipper.flow, drawn]),
        conductance=np.array([piston.conductance, slipper.conductance, slopes]),
        drag_power=ring.drag_power,
    )


def _over_turn(values: Array, chambers: tuple[int, ...], count: int) -> Array:
    """Values (P, z) of chambers at block angles, over a chamber's own angle (N,): the mean of some of them.

    Of P = N/z block angles all chambers together, each N/z angles further on.
    """
    known, pistons = values.shape
    if known < count:
        return values.T.ravel()
    return np.asarray(np.mean([np.roll(values[:, k], k * count // pistons) for k in chambers], axis=0))


def _pistons(asked: _Asked, drive: PistonDrive) -> _Films:
    kind = asked.kind
    gap = standing_piston_gap(kind.rotor, kind.parts, drive, asked.physics, asked.finer)
    stages = _held(gap, asked, lambda: piston_heat(kind.rotor, kind.parts))
    films = tuple(map(gap.report, stages))
    slopes = np.array([piston_conductance(gap.solver, stage) for stage in stages])
    return _Films(films, np.array([film.chamber_flow for film in films]), slopes)


def _slippers(asked: _Asked, drive: SlipperDrive) -> _Films:
    kind = asked.kind
    gap = standing_slipper_gap(kind.rotor, kind.parts, drive, asked.physics, asked.finer)
    stages = _held(gap, asked, lambda: slipper_heat(kind.rotor, kind.parts))
    films = tuple(map(gap.report, stages))
    slopes = np.array([slipper_conductance(gap.solver, gap.film, stage) for stage in stages])
    return _Films(films, np.array([film.chamber_flow for film in films]), slopes)


def _ring(asked: _Asked, drive: BlockDrive) -> _Ring:
    kind = asked.kind
    gap = standing_block_gap(kind.rotor, kind.parts, drive, asked.physics, asked.finer)
    stages = _held(gap, asked, lambda: block_heat(kind.rotor, kind.parts))
    films = tuple(map(gap.report, stages))
    return _Ring(
        films,
        np.array([film.report.flow for film in films]),
        np.array([kidney_conductances(gap.solver, gap.film, stage) for stage in stages]),
        np.array([drag_power(gap.solver, gap.film, stage) for stage in stages]),
    )


def _held(gap: StandingGap[Any, Any], asked: _Asked, heat: Callable[[], GapHeat]) -> list[FloatingStage]:
    """Films at the angles, each started from that before; oil that stiffens under pressure from its own first guess."""
    stages: list[FloatingStage] = []
    for k, angle in enumerate(asked.angles):
        stiffens = gap.floating.shape_at(gap.time(angle)).fluid.viscosity is not isoviscous
        last = stages[-1].solution if stages and not stiffens else None
        stages.append(gap.held_at(angle, start=last))
        asked.progress(k + 1)
    return warm_turn(gap.solver, gap.floating, stages, heat(), asked.rubbing) if asked.physics.heat else stages
