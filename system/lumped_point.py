"""One operating point at the lumped fidelity, with the effects that the pump's [physics] switches on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from system.assembly import PumpPoint, assemble
from system.bench import elastic_energy
from system.chamber import TOLERANCE, ChamberCycle
from system.chamber_problem import ChamberProblem, LeakTable
from system.description import PumpDescription
from system.errors import NotConverged
from system.gap_courses import bench_state, gap_courses
from system.kinematics import Array
from system.land_losses import land_losses, with_inertia
from system.lumped import (
    PistonMotion,
    chamber_problem,
    group_masses,
    lumped_leaks,
    lumped_pairs,
    piston_motion,
    port_lines,
    swept_displacement,
)
from system.operating import OperatingPoint
from system.pairs import FrictionPairs, Pair, PairLoss
from system.physics.effects import Effects
from system.physics.outside import Outside, outside
from system.physics.port_laws import eroded, narrowed
from system.physics.rubbing import rubbed
from system.physics.switched import stated_effects, stated_laws
from system.ports import TURN
from system.ports_coupling import PortedCycle, ported_cycle
from system.power import chamber_exchange
from system.unlike import Kinds, kinds, mean_of

ROUND_LIMIT = 20
SETTLED = 1e-7
"""Change of a gap's leakage between two rounds, of itself, that is none."""


def lumped_point(pump: PumpDescription, point: OperatingPoint, tolerance: float = TOLERANCE) -> PumpPoint:
    """One periodic operating point of a pump with films of given thickness: REF90's nominal loss model.

    Chambers that differ have each its own cycle; what rubs about the shaft takes the mean of pumps with chambers
    like each. Effects of [physics] see the gaps as they are without any; then chambers are solved once more.
    Raises NotConverged when the chamber pressure does not become periodic. Valid for films thick against their
    roughness at the viscosity of the case; what it leaves out is in `left_out_physics.md`.
    """
    found = kinds(pump)
    plain = _solved(found, pump, point, [None] * len(found.pumps), tolerance)
    if not pump.physics.on:
        return plain
    cycles = [plain.chambers[found.of_chamber.index(kind)] for kind in range(len(found.pumps))]
    effects = [_effects(own, plain.point, cycle) for own, cycle in zip(found.pumps, cycles, strict=True)]
    inside = _solved(found, pump, point, effects, tolerance)
    return _with_outside(inside, pump, found.by_chamber(effects))


def _column(point: OperatingPoint) -> OperatingPoint[Array]:
    """A point as a map of one."""
    return OperatingPoint(**{field.name: np.array([[getattr(point, field.name)]]) for field in fields(point)})


@dataclass(frozen=True)
class _Row:
    """A cycle's pressure as a map of one point has it, (1, M)."""

    pressure: Array


def _effects(pump: PumpDescription, point: OperatingPoint, cycle: ChamberCycle) -> Effects:
    """What the pump's [physics] changes at one point, of chambers like this one."""
    at, pressed = _column(point), _Row(cycle.pressure[None])
    motion = piston_motion(pump, at)
    courses = gap_courses(pump, at, motion, pressed, lumped_pairs(pump, at, motion, pressed))
    return stated_effects(stated_laws(pump), courses, bench_state(pump, at, np.zeros(1)))


def _solved(
    found: Kinds, pump: PumpDescription, asked: OperatingPoint, effects: Sequence[Effects | None], tolerance: float
) -> PumpPoint:
    """The point with what effects change in chambers and pairs, kind by kind; None changes nothing."""
    ideal = float(np.mean([1.0 if one is None else one.ideal[0] for one in effects]))
    point = replace(asked, displacement_ratio=asked.displacement_ratio * ideal)
    motions = [piston_motion(own, point) for own in found.pumps]
    ported = _ported(found, pump, point, motions, effects, tolerance)
    pistons = pump.pump.pistons
    chambers = list(zip(found.by_chamber(found.pumps), found.by_chamber(motions), ported.cycles, strict=True))
    losses = [
        _rubbed(lumped_pairs(own, point, motion, cycle), one)
        for (own, motion, cycle), one in zip(chambers, found.by_chamber(effects), strict=True)
    ]
    exchange = chamber_exchange(ported.cycle, pistons * point.shaft_speed / TURN)
    derived = float(np.mean([swept_displacement(own, motion.drive) for own, motion, _ in chambers]))
    masses = [group_masses(own) for own, _, _ in chambers]
    return assemble(asked, ported, losses, pistons, derived, exchange, masses)


def _ported(
    found: Kinds,
    pump: PumpDescription,
    point: OperatingPoint,
    motions: Sequence[PistonMotion],
    effects: Sequence[Effects | None],
    tolerance: float,
) -> PortedCycle:
    """Chambers and ports; where lands lose by inertia (`land_losses`), at pressures that these losses leave.

    Raises NotConverged where flow and pressure do not settle within ROUND_LIMIT rounds.
    """
    pistons, samples, lines = pump.pump.pistons, motions[0].shaft_angle.size, port_lines(pump, point)
    creeping = [lumped_leaks(own, point, motion) for own, motion in zip(found.pumps, motions, strict=True)]
    leaks = creeping
    for _ in range(ROUND_LIMIT):
        problems = [
            _affected(chamber_problem(own, point, motion, leak), one)
            for own, motion, leak, one in zip(found.pumps, motions, leaks, effects, strict=True)
        ]
        ported = ported_cycle(found.by_chamber(problems), lines, pistons, samples, tolerance)
        before, leaks = (
            leaks,
            [
                _slowed(own, point, leak, ported.cycles[found.of_chamber.index(kind)])
                for kind, (own, leak) in enumerate(zip(found.pumps, creeping, strict=True))
            ],
        )
        pairs = zip(leaks, before, strict=True)
        if all(np.allclose(one.conductance, other.conductance, SETTLED, 0.0) for one, other in pairs):
            return ported
    raise NotConverged(
        f"leakage by files of losses: after {ROUND_LIMIT} rounds it still changes by more than {SETTLED:g} of "
        "itself; leave out pocket_file, groove_file, kidney_file and orifice_file"
    )


def _slowed(pump: PumpDescription, point: OperatingPoint, creeping: LeakTable, cycle: ChamberCycle) -> LeakTable:
    """Leaks less what inertia takes at a cycle's pressures; the same where no file says anything."""
    if not land_losses(pump).any:
        return creeping
    return with_inertia(pump, creeping, cycle.pressure - point.case_pressure, point.viscosity, bore=True)


def _affected(problem: ChamberProblem, effects: Effects | None) -> ChamberProblem:
    """A chamber whose gaps and ports effects have changed."""
    if effects is None:
        return problem
    conductance = problem.leaks.conductance * effects.conductance[:, 0]
    worn = float(effects.groove_advance[0]), float(effects.groove_area[0])
    return replace(
        problem,
        leaks=LeakTable(conductance, problem.leaks.carried_flow),
        delivery_port=eroded(problem.delivery_port, *worn),
        suction_port=narrowed(eroded(problem.suction_port, *worn), float(effects.suction_area[0])),
    )


def _rubbed(losses: FrictionPairs, effects: Effects | None) -> FrictionPairs:
    """The losses of one point with what effects change."""
    if effects is None:
        return losses
    found = rubbed(losses, effects)
    return FrictionPairs(
        **{
            pair.value: PairLoss(own.count, own.coulomb.reshape(-1), own.viscous.reshape(-1))
            for pair, own in ((pair, found.loss(pair)) for pair in Pair)
        }
    )


def _with_outside(found: PumpPoint, pump: PumpDescription, effects: Sequence[Effects]) -> PumpPoint:
    """The point with flows past the chambers and drag on the shaft, mean of the chambers' effects.

    They do not load the lines on the ports.
    """
    at = bench_state(pump, _column(found.point), np.zeros(1))
    added: Outside = mean_of([outside(one, at) for one in effects])
    mean: Effects = mean_of(effects)
    delivery, inlet, drain, torque = (float(value[0]) for value in vars(added).values())
    bench = replace(
        found.bench,
        delivery_flow=found.bench.delivery_flow + delivery,
        inlet_flow=found.bench.inlet_flow + inlet,
        drain_flow=found.bench.drain_flow + drain,
        shaft_torque=found.bench.shaft_torque + torque,
    )
    ports = (
        (delivery, bench.delivery_pressure),
        (-inlet, bench.inlet_pressure),
        (drain, bench.drain_pressure),
    )
    modulus = pump.oil.bulk_modulus
    power = replace(
        found.power,
        shaft=bench.shaft_power,
        hydraulic=found.power.hydraulic + sum(flow * pressure for flow, pressure in ports),
        elastic=found.power.elastic + sum(flow * elastic_energy(pressure, modulus) for flow, pressure in ports),
        extended=float(mean.carried_off[0]),
    )
    shaft = found.shaft_torque + torque
    forces = found.point.shaft_speed * float(np.mean(shaft))
    checks = replace(
        found.checks,
        energy_balance_error=abs(forces - power.accounted) / abs(power.shaft),
        work_balance_error=abs(power.shaft - power.accounted) / abs(power.shaft),
    )
    read = replace(bench, delivery_flow=bench.delivery_flow * float(mean.delivery_reading[0]))
    return replace(found, bench=read, power=power, shaft_torque=shaft, checks=checks)
