"""The floating gaps of a pump's kinds of chambers: their drives, their revolutions, and their chambers.

A kind has one piston and one slipper over the turn, driven by the mean pressure of its chambers; each chamber has
its own cycle. Where all are equal, one chamber and a pitch of the block represent all; else the block is solved
over a turn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gaps.films.physics import Physics
from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.effects.effect import Effects
from system.films.cycle import GapPhysics
from system.films.drives import Drives, Rubbing, block_drive, drives
from system.films.parts import FloatingParts, floating_parts
from system.films.rotor import Rotor
from system.films.spins import SpinTorques
from system.points.effects import affected_problem
from system.points.film_effects import floating_effects
from system.points.floating_exchange import FloatingGaps, growth, leak_table
from system.points.floating_gaps import FloatingOptions, block_revolution, piston_revolution, slipper_revolution
from system.points.floating_solved import GapsOfKind, Solved
from system.points.gap_process import Driven, GapsBeside
from system.pump.chamber.problem import ChamberProblem
from system.pump.chamber_kinds import Kinds, kinds
from system.pump.lumped import PistonMotion
from system.pump.operating import OperatingPoint
from system.work.progress import Report

BLOCK_SHARE = 0.1
"""Share of the block over a pitch in the work of a round of equal chambers (REF90, 72 steps)."""


@dataclass(frozen=True)
class Group:
    """A pump's kinds of chambers: the parts of each, the physics of their films, and the changes by other effects.

    effects: by kind, none where [physics] has no effect that acts by its law.
    """

    kinds: Kinds
    parts: tuple[FloatingParts, ...]
    physics: GapPhysics
    effects: tuple[Effects[float], ...] = ()

    @property
    def by_chamber(self) -> tuple[Effects[float], ...]:
        """The effects of each chamber, of one where all are equal; none where no law acts."""
        return self.kinds.by_chamber(self.effects) if self.effects else ()

    def rotors(self, asked: RoundDrives) -> tuple[Rotor, ...]:
        """The rotating group at the operating point, with the parts of each kind."""
        each = zip(self.kinds.pumps, asked.spin_torques, strict=True)
        return tuple(replace(asked.rotor, pump=pump, spin_torques=torques) for pump, torques in each)


def work_of(pump: PumpDescription) -> float:
    """Estimated work of a pump's floating gaps over that of a pump with equal chambers."""
    found = kinds(pump)
    if found.alike:
        return 1.0
    return (1.0 - BLOCK_SHARE) * len(found.pumps) + BLOCK_SHARE * pump.pump.pistons


def group_of(rotor: Rotor, physics: Physics, effects: tuple[Effects[float], ...] = ()) -> Group:
    """The kinds of a pump's chambers, their films with those effects of [physics] that films solve."""
    found = kinds(rotor.pump)
    films = [floating_effects(replace(rotor, pump=pump), floating_parts(pump), pump, physics) for pump in found.pumps]
    return Group(found, tuple(one.parts for one in films), films[0].physics, effects)


@dataclass(frozen=True)
class RoundDrives:
    """Drives of a round: pressures (N,) Pa of the chambers over their own angles (N,) rad, friction by kind.

    spin_torques by kind, None before films are solved.
    """

    rotor: Rotor
    shaft_angle: Array
    pressure: tuple[Array, ...]
    rubbing: tuple[Rubbing, ...]
    spin_torques: tuple[SpinTorques | None, ...]
    options: FloatingOptions


def started(beside: GapsBeside, asked: RoundDrives, group: Group) -> None:
    """Begin a round of the gaps that have a process."""
    beside.pistons.start(_driven_by(asked, group, group.physics.piston))
    if beside.slippers is not None:
        beside.slippers.start(_driven_by(asked, group, group.physics.slipper))


def _driven_by(asked: RoundDrives, group: Group, physics: Physics) -> tuple[Driven, ...]:
    """Drives of piston and slipper of each kind."""
    pressure, options = np.array(asked.pressure), replace(asked.options, physics=physics)
    return tuple(
        Driven(rotor, asked.shaft_angle, pressure[list(group.kinds.chambers(kind))].mean(axis=0), rubbing, options)
        for kind, (rotor, rubbing) in enumerate(zip(group.rotors(asked), asked.rubbing, strict=True))
    )


def drives_of(asked: RoundDrives, group: Group) -> tuple[Drives, ...]:
    """The drives of each kind's gaps; the block's is one for all."""
    found = [
        drives(one.rotor, parts, one.shaft_angle, one.pressure, one.rubbing)
        for one, parts in zip(_driven_by(asked, group, group.physics.piston), group.parts, strict=True)
    ]
    if group.kinds.alike:
        return tuple(found)
    groups = group.kinds.by_chamber([one.group for one in found])
    block = block_drive(asked.rotor, group.parts[0], asked.shaft_angle, asked.pressure, groups)
    return tuple(replace(one, block=block) for one in found)


def gap_revolutions(
    asked: RoundDrives,
    group: Group,
    driven: Sequence[Drives],
    before: Sequence[FloatingGaps] | None,
    beside: GapsBeside | None,
    report: Report,
    solved: Solved,
) -> tuple[FloatingGaps, ...]:
    """The gaps of each kind over the revolution, continued from those before.

    Pistons and slippers are those of their processes, where they have one, `started` before. Each gap is kept in
    `solved` as soon as it is found.
    """
    options = [
        replace(asked.options, physics=own)
        for own in (group.physics.piston, group.physics.slipper, group.physics.valve_plate)
    ]
    last_of: Sequence[FloatingGaps | None] = [None] * len(driven) if before is None else before
    kinds = _kinds_driven(asked, group, driven)
    each = list(zip(kinds, last_of, strict=True))
    if beside is None:
        turning = (
            piston_revolution(of.rotor, of.parts, of.drives.piston, options[0], last.piston if last else None, report)
            for of, last in each
        )
        pistons = solved.keep(Gap.PISTON, kinds, options[0], turning)
    apart = None if beside is None else beside.slippers
    if apart is None:
        sliding = (
            slipper_revolution(
                of.rotor, of.parts, of.drives.slipper, options[1], last.slipper if last else None, report
            )
            for of, last in each
        )
        slippers = solved.keep(Gap.SLIPPER, kinds, options[1], sliding)
    block_before = None if before is None else before[0].block
    block = block_revolution(asked.rotor, group.parts[0], driven[0].block, options[2], block_before, report)
    solved.keep(Gap.VALVE_PLATE, kinds, options[2], [block])
    if apart is not None:
        slippers = solved.keep(Gap.SLIPPER, kinds, options[1], apart.fetch(report))
    if beside is not None:
        pistons = solved.keep(Gap.PISTON, kinds, options[0], beside.pistons.fetch(report))
    return tuple(
        FloatingGaps(piston, slipper, block, of.chambers[0])
        for piston, slipper, of in zip(pistons, slippers, kinds, strict=True)
    )


def _kinds_driven(asked: RoundDrives, group: Group, driven: Sequence[Drives]) -> list[GapsOfKind]:
    """The kinds of chambers with the drives of a round."""
    return [
        GapsOfKind(group.kinds.chambers(kind), *own)
        for kind, own in enumerate(zip(group.rotors(asked), group.parts, driven, strict=True))
    ]


def by_chamber(group: Group, gaps: Sequence[FloatingGaps]) -> tuple[FloatingGaps, ...]:
    """The gaps of each chamber, of one where all are equal."""
    return tuple(replace(own, chamber=k) for k, own in enumerate(group.kinds.by_chamber(gaps)))


def chamber_problems(
    asked: RoundDrives, group: Group, point: OperatingPoint, motion: PistonMotion, gaps: Sequence[FloatingGaps]
) -> tuple[ChamberProblem, ...]:
    """Each chamber between its gaps: their leakage, the parts' small motion in its volume, and effects."""
    rotors, parts = group.kinds.by_chamber(group.rotors(asked)), group.kinds.by_chamber(group.parts)
    effects: list[tuple[Effects[float], ...]] = [(one,) for one in group.by_chamber] or [()] * len(rotors)
    return tuple(
        replace(_problem(at.pump, point, motion, own, acting), growth=growth(own, at, of))
        for at, of, own, acting in zip(rotors, parts, by_chamber(group, gaps), effects, strict=True)
    )


def _problem(
    pump: PumpDescription,
    point: OperatingPoint,
    motion: PistonMotion,
    gaps: FloatingGaps,
    effects: Sequence[Effects[float]],
) -> ChamberProblem:
    """A chamber with the leaks of its films; effects change its ports and its oil, but not these leaks."""
    leaks = leak_table(gaps)
    ones, zeros = np.ones_like(leaks.conductance), np.zeros_like(leaks.conductance)
    own = [replace(one, conductance=ones, gap_flow=zeros) for one in effects]
    return affected_problem(pump, point, motion, leaks, own)
