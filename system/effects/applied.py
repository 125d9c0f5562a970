"""Effects applied to a pump, at N points of a bench map or at one: its stroke, its leakage, its ports."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.description.pump import PumpDescription
from system.effects.effect import BenchState, Effects, GapCourse, Value
from system.effects.extension import Law, Values
from system.effects.gap_states import bench_state, gap_courses
from system.effects.state import AwaitedCourses
from system.effects.switched import stated_effects
from system.pump.chamber.problem import LeakTable
from system.pump.laws.kinematics import Number
from system.pump.lumped import PistonMotion, Pressed, lumped_pairs
from system.pump.operating import OperatingPoint
from system.pump.ports.wear import PortWear


@dataclass(frozen=True)
class Affected:
    """Changes by laws at N points, and the state that is their input."""

    effects: Effects
    state: BenchState


def effects_at(
    pump: PumpDescription,
    point: OperatingPoint[Array],
    motion: PistonMotion[Array],
    cycle: Callable[[], Pressed],
    laws: Sequence[tuple[Law, Values]],
    hours: Array,
) -> Affected:
    """Changes by laws with their values at N points, columns (N, 1), at chamber pressures without any effect.

    `cycle()` gives these pressures. It is called only if a law needs the course of a gap.
    """

    def found() -> dict[Gap, GapCourse]:
        plain = cycle()
        return gap_courses(pump, point, motion, plain, lumped_pairs(pump, point, motion, plain))

    courses = AwaitedCourses((point.shaft_speed.size, motion.shaft_angle.size), found)
    state = bench_state(pump, point, hours)
    return Affected(stated_effects(laws, courses, state), state)


def left_over(point: OperatingPoint[Number], ideal: Number, suction_loss: Number) -> OperatingPoint[Number]:
    """The point after effects: `ideal` of the stroke, the inlet's pressure less `suction_loss` Pa."""
    return replace(
        point, displacement_ratio=point.displacement_ratio * ideal, inlet_pressure=point.inlet_pressure - suction_loss
    )


def affected_leaks(leaks: LeakTable, effects: Effects[Value]) -> LeakTable:
    """Leaks with the effects' factors and flows at the effects' angles; of fewer angles, by a periodic spline."""
    factor, dragged = (np.moveaxis(each, 0, -2) for each in (effects.conductance, effects.gap_flow))
    conductance, drag_flow = (_at_angles(own, factor.shape[-1]) for own in (leaks.conductance, leaks.drag_flow))
    if conductance is not leaks.conductance:  # a spline may pass below nothing
        conductance = np.maximum(conductance, 0.0)
    return LeakTable(conductance * factor, drag_flow + dragged)


def affected_wear(wear: PortWear[Value], effects: Effects[Value]) -> PortWear[Value]:
    """The ports' wear with that of the effects."""
    return PortWear(
        wear.groove_advance + effects.groove_advance,
        wear.groove_area * effects.groove_area,
        wear.suction_area * effects.suction_area,
    )


def _at_angles(table: Array, count: int) -> Array:
    """A table over the turn (..., N) at so many angles, itself where it has them."""
    if table.shape[-1] == count:
        return table
    closed = np.concatenate([table, table[..., :1]], axis=-1)
    spline = CubicSpline(np.linspace(0.0, 1.0, closed.shape[-1]), closed, axis=-1, bc_type="periodic")
    return np.asarray(spline(np.arange(count) / count))
