"""What [physics] changes at one operating point, chambers and losses of which are those of any fidelity."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
from scipy.interpolate import CubicSpline

from reynolds.numerics.arrays import Array
from system.description.pump import PumpDescription
from system.effects.effect import Effects
from system.effects.friction import rubbed
from system.effects.gap_states import bench_state, gap_courses
from system.effects.laws.port import eroded, narrowed
from system.effects.outside import Outside, outside
from system.effects.switched import stated_effects, stated_laws
from system.pump.assembly import PumpPoint
from system.pump.bench import elastic_energy
from system.pump.chamber.cycle import ChamberCycle
from system.pump.chamber.problem import ChamberProblem, LeakTable
from system.pump.laws.friction_pairs import FrictionPairs, Pair, PairLoss
from system.pump.lumped import lumped_pairs, piston_motion
from system.pump.operating import OperatingPoint
from system.work.means import mean_of


def point_effects(pump: PumpDescription, point: OperatingPoint, cycle: ChamberCycle) -> Effects:
    """What [physics] changes at one point: arrays of one point and the angles of a cycle without any effect."""
    at, pressed = _column(point), _Row(cycle.pressure[None])
    motion = piston_motion(pump, at)
    courses = gap_courses(pump, at, motion, pressed, lumped_pairs(pump, at, motion, pressed))
    return stated_effects(stated_laws(pump), courses, bench_state(pump, at, np.zeros(1)))


def displaced(point: OperatingPoint, effects: Sequence[Effects]) -> OperatingPoint:
    """The point with the stroke that effects leave, mean of the chambers' effects; as it is without any."""
    ideal = float(np.mean([one.ideal[0] for one in effects])) if effects else 1.0
    return replace(point, displacement_ratio=point.displacement_ratio * ideal)


def affected(problem: ChamberProblem, effects: Effects) -> ChamberProblem:
    """A chamber whose gaps and ports effects have changed."""
    worn = float(effects.groove_advance[0]), float(effects.groove_area[0])
    return replace(
        problem,
        leaks=affected_leaks(problem.leaks, effects),
        delivery_port=eroded(problem.delivery_port, *worn),
        suction_port=narrowed(eroded(problem.suction_port, *worn), float(effects.suction_area[0])),
    )


def affected_leaks(leaks: LeakTable, effects: Effects) -> LeakTable:
    """Leaks at the effects' angles; of fewer ones, put between them as the chamber does, by a periodic spline."""
    count = effects.conductance.shape[-1]
    conductance, carried = (_at_angles(table, count) for table in (leaks.conductance, leaks.carried_flow))
    return LeakTable(np.maximum(conductance, 0.0) * effects.conductance[:, 0], carried)


def rubbed_pairs(losses: FrictionPairs, effects: Effects) -> FrictionPairs:
    """The losses of one point with what effects change."""
    found = rubbed(losses, effects)
    return FrictionPairs(
        **{
            pair.value: PairLoss(own.count, own.coulomb.reshape(-1), own.viscous.reshape(-1))
            for pair, own in ((pair, found.loss(pair)) for pair in Pair)
        }
    )


def with_outside(found: PumpPoint, pump: PumpDescription, effects: Sequence[Effects]) -> PumpPoint:
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


def _at_angles(table: Array, count: int) -> Array:
    """A table over the turn (3, N) at so many angles."""
    if table.shape[-1] == count:
        return table
    closed = np.column_stack([table, table[:, :1]])
    spline = CubicSpline(np.linspace(0.0, 1.0, table.shape[-1] + 1), closed, axis=1, bc_type="periodic")
    return np.asarray(spline(np.arange(count) / count))


def _column(point: OperatingPoint) -> OperatingPoint[Array]:
    """A point as a map of one."""
    return OperatingPoint(**{field.name: np.array([[getattr(point, field.name)]]) for field in fields(point)})


@dataclass(frozen=True)
class _Row:
    """A cycle's pressure as a map of one point has it, (1, M)."""

    pressure: Array
