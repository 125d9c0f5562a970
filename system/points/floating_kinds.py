"""The floating gaps of a pump's kinds of chambers: their drives, their revolutions, and their chambers.

A kind has one piston and one slipper over the turn, driven by the mean pressure of its chambers; each chamber has
its own cycle. Where all are equal, one chamber and a pitch of the block represent all; else the block is solved
over a turn.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gaps.films.physics import Physics
from gaps.revolution.march import GapRevolution
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
from system.points.floating_solved import GapsOfKind
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


def drives_of(asked: RoundDrives, group: Group) -> tuple[Drives, ...]:
    """The drives of each kind's gaps; the block's is one for all."""
    pressure = np.array(asked.pressure)
    each = zip(group.rotors(asked), group.parts, asked.rubbing, strict=True)
    found = [
        drives(at, parts, asked.shaft_angle, pressure[list(group.kinds.chambers(kind))].mean(axis=0), rubbing)
        for kind, (at, parts, rubbing) in enumerate(each)
    ]
    if group.kinds.alike:
        return tuple(found)
    groups = group.kinds.by_chamber([one.group for one in found])
    block = block_drive(asked.rotor, group.parts[0], asked.shaft_angle, asked.pressure, groups)
    return tuple(replace(one, block=block) for one in found)


def options_of(gap: Gap, asked: RoundDrives, group: Group) -> FloatingOptions:
    """The round's options with the physics of a gap's film."""
    physics = group.physics
    own = {Gap.PISTON: physics.piston, Gap.SLIPPER: physics.slipper, Gap.VALVE_PLATE: physics.valve_plate}
    return replace(asked.options, physics=own[gap])


def revolutions(
    gap: Gap,
    asked: RoundDrives,
    group: Group,
    driven: Sequence[Drives],
    before: Sequence[GapRevolution[Any]],
    report: Report,
) -> Iterator[GapRevolution[Any]]:
    """A gap over the revolution, of each kind of chambers or of the block, each as it is found.

    before: those from which they continue, as many or none. Raises as `piston_revolution` and its like.
    """
    options, each = options_of(gap, asked, group), list(zip(group.rotors(asked), group.parts, driven, strict=True))
    last: Sequence[GapRevolution[Any] | None] = [*before] or [None] * len(each)
    match gap:
        case Gap.PISTON:
            for (at, parts, drive), one in zip(each, last, strict=True):
                yield piston_revolution(at, parts, drive.piston, options, one, report)
        case Gap.SLIPPER:
            for (at, parts, drive), one in zip(each, last, strict=True):
                yield slipper_revolution(at, parts, drive.slipper, options, one, report)
        case Gap.VALVE_PLATE:
            yield block_revolution(asked.rotor, group.parts[0], driven[0].block, options, last[0], report)


def kinds_driven(asked: RoundDrives, group: Group, driven: Sequence[Drives]) -> list[GapsOfKind]:
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
