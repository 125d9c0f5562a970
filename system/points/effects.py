"""Effects of [physics] at one operating point, with chambers and losses of any fidelity."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from reynolds.errors import NotConverged
from system.description.pump import PumpDescription
from system.effects.applied import affected_leaks, affected_wear, effects_at, left_over
from system.effects.effect import Effects
from system.effects.gap_states import bench_state
from system.effects.outside import outside
from system.effects.switched import stated_laws
from system.inputs.shown import pressure_text
from system.pump.bench import NOTHING_OUTSIDE, Outside
from system.pump.chamber.cycle import ChamberCycle
from system.pump.chamber.problem import ChamberProblem, LeakTable
from system.pump.lumped import PistonMotion, Pressures, chamber_problem, piston_motion
from system.pump.operating import OperatingPoint, columns
from system.pump.ports.wear import AS_DRAWN
from system.work.means import mean_of


def point_effects(pump: PumpDescription, point: OperatingPoint, cycle: ChamberCycle) -> Effects[float]:
    """Changes by [physics] at one point, over the angles of a cycle without any effect."""
    at, pressures = columns(point), Pressures(cycle.pressure[None])
    found = effects_at(pump, at, piston_motion(pump, at), lambda: pressures, stated_laws(pump), np.zeros(1))
    return found.effects.at(0)


def affected_problem(
    pump: PumpDescription,
    point: OperatingPoint,
    motion: PistonMotion,
    leaks: LeakTable,
    effects: Sequence[Effects[float]],
) -> ChamberProblem:
    """One chamber of the pump at the point, with the changes of its leaks, its ports and its oil by effects."""
    wear = AS_DRAWN
    for one in effects:
        leaks, wear = affected_leaks(leaks, one), affected_wear(wear, one)
    problem = chamber_problem(pump, point, motion, leaks, wear)
    for one in effects:
        problem = replace(problem, free_air=one.free_air, air_exponent=one.air_exponent)
    return problem


def at_the_ports(point: OperatingPoint, effects: Sequence[Effects[float]]) -> OperatingPoint:
    """The point with stroke and inlet pressure after effects, mean of the chambers' effects.

    Raises NotConverged where no stroke is left: the chambers of an upright plate have no periodic turn.
    """
    if not effects:
        return point
    ideal, loss = (float(np.mean([getattr(one, name) for one in effects])) for name in ("ideal", "suction_loss"))
    if ideal <= 0.0:
        raise NotConverged(
            f"physics.swash_droop: at {pressure_text(point.delivery_pressure)} and a displacement ratio of "
            f"{point.displacement_ratio:.3g} the swash plate gives way to upright and moves no piston; a larger "
            "displacement, a lower pressure, or a smaller rate or play"
        )
    return left_over(point, ideal, loss)


def mean_outside(pump: PumpDescription, point: OperatingPoint, effects: Sequence[Effects[float]]) -> Outside[float]:
    """Contributions outside the chambers at a point, mean of the chambers' effects."""
    state = bench_state(pump, point, 0.0)
    return mean_of([outside(one, state) for one in effects]) if effects else NOTHING_OUTSIDE
