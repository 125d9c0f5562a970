"""One operating point at the lumped fidelity, with the effects that the pump's [physics] switches on."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from reynolds.errors import NotConverged
from system.description.effects import PhysicsSection
from system.description.pump import PumpDescription
from system.effects.effect import Effects
from system.effects.friction import rubbed
from system.inputs.units import TURN
from system.points.effects import affected_problem, at_the_ports, mean_outside, point_effects
from system.pump.assembly import PumpPoint, assemble, met_point
from system.pump.chamber.cycle import TOLERANCE, ChamberCycle
from system.pump.chamber.port_coupling import PortedCycle, ported_cycle
from system.pump.chamber.problem import LeakTable
from system.pump.chamber_kinds import Kinds, kinds
from system.pump.film_thickness import expansion
from system.pump.friction_range import with_friction_range
from system.pump.land_losses import land_losses, with_inertia
from system.pump.lumped import (
    PistonMotion,
    group_masses,
    lumped_leaks,
    lumped_pairs,
    piston_motion,
    port_lines,
    swept_displacement,
)
from system.pump.operating import OperatingPoint
from system.pump.power import chamber_exchange

ROUND_LIMIT = 20
SETTLED = 1e-7
"""Relative change of a gap's leakage between two rounds that counts as zero."""


def lumped_point(pump: PumpDescription, point: OperatingPoint, tolerance: float = TOLERANCE) -> PumpPoint:
    """One periodic operating point of a pump with films of given thickness: REF90's nominal loss model.

    Chambers that differ have each its own cycle; friction about the shaft is the mean of pumps with chambers like each.
    The inputs of effects of [physics] are the gaps without effects; then chambers are solved once more. Raises
    NotConverged when the chamber pressure does not become periodic, InputError for a film that thermal expansion
    closes. Valid for films thick against their roughness at the viscosity of the case; docs/theory.md, What is left
    out, lists the rest.
    """
    found = kinds(pump)
    expansion(pump, point.temperature)
    plain = _solved(found, pump, point, (), tolerance)
    affected = _solved(found, pump, point, _effects(found, plain), tolerance) if pump.physics.on else plain
    return with_friction_range(pump, affected)


def point_and_effects(pump: PumpDescription, point: OperatingPoint) -> tuple[PumpPoint, tuple[Effects[float], ...]]:
    """The lumped point without any effect, and the changes by the pump's [physics] there, by kind of chamber.

    Without effects there are no changes: an empty tuple. Raises as `lumped_point`.
    """
    plain = lumped_point(replace(pump, physics=PhysicsSection()), point)
    return plain, _effects(kinds(pump), plain) if pump.physics.on else ()


def _effects(found: Kinds, plain: PumpPoint) -> tuple[Effects[float], ...]:
    """The changes by [physics] of each kind of chamber, at the pressures of a point without effects."""
    cycles = [plain.chambers[found.of_chamber.index(kind)] for kind in range(len(found.pumps))]
    return tuple(point_effects(own, plain.point, cycle) for own, cycle in zip(found.pumps, cycles, strict=True))


def _solved(
    found: Kinds, pump: PumpDescription, asked: OperatingPoint, effects: Sequence[Effects[float]], tolerance: float
) -> PumpPoint:
    """The point with the changes by effects, kind by kind, or without."""
    acting = found.by_chamber(effects) if effects else ()
    point = at_the_ports(asked, acting)
    motions = [piston_motion(own, point) for own in found.pumps]
    ported = _ported(found, pump, point, motions, effects, tolerance)
    pistons = pump.pump.pistons
    chambers = list(zip(found.by_chamber(found.pumps), found.by_chamber(motions), ported.cycles, strict=True))
    losses = [lumped_pairs(own, point, motion, cycle) for own, motion, cycle in chambers]
    if acting:
        losses = [rubbed(*each) for each in zip(losses, acting, strict=True)]
    exchange = chamber_exchange(ported.cycle, pistons * point.shaft_speed / TURN)
    derived = float(np.mean([swept_displacement(own, motion.drive) for own, motion, _ in chambers]))
    masses = [group_masses(own) for own, _, _ in chambers]
    outside = mean_outside(pump, met_point(asked, ported), acting)
    return assemble(asked, ported, losses, pistons, derived, exchange, masses, outside)


def _ported(
    found: Kinds,
    pump: PumpDescription,
    point: OperatingPoint,
    motions: Sequence[PistonMotion],
    effects: Sequence[Effects[float]],
    tolerance: float,
) -> PortedCycle:
    """Chambers and ports; where lands lose by inertia (`land_losses`), at the pressures with these losses.

    Raises NotConverged where flow and pressure do not settle within ROUND_LIMIT rounds.
    """
    pistons, samples, lines = pump.pump.pistons, motions[0].shaft_angle.size, port_lines(pump, point)
    creeping = [lumped_leaks(own, point, motion) for own, motion in zip(found.pumps, motions, strict=True)]
    leaks = creeping
    for _ in range(ROUND_LIMIT):
        problems = [
            affected_problem(own, point, motion, leak, effects[kind : kind + 1])
            for kind, (own, motion, leak) in enumerate(zip(found.pumps, motions, leaks, strict=True))
        ]
        ported = ported_cycle(found.by_chamber(problems), lines, pistons, samples, tolerance)
        before = leaks
        leaks = [
            _slowed(own, point, leak, ported.cycles[found.of_chamber.index(kind)])
            for kind, (own, leak) in enumerate(zip(found.pumps, creeping, strict=True))
        ]
        pairs = zip(leaks, before, strict=True)
        if all(np.allclose(one.conductance, other.conductance, SETTLED, 0.0) for one, other in pairs):
            return ported
    raise NotConverged(
        f"leakage by files of losses: after {ROUND_LIMIT} rounds it still changes by more than {SETTLED:g} of "
        "itself; leave out pocket_file, groove_file, kidney_file and orifice_file"
    )


def _slowed(pump: PumpDescription, point: OperatingPoint, creeping: LeakTable, cycle: ChamberCycle) -> LeakTable:
    """Leaks less the losses by inertia at a cycle's pressures; the same without files of losses."""
    if not land_losses(pump).any:
        return creeping
    return with_inertia(pump, creeping, cycle.pressure - point.case_pressure, point.viscosity, bore=True)
