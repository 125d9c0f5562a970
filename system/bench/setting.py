"""A pump at the points of a bench map with given values of its parameters: what all readings come from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from reynolds.laws.oil import walther
from reynolds.numerics.arrays import Array
from system.bench.chamber_map import MapProblem, map_problem
from system.bench.parameters import GROOVE_ADVANCE, GROOVE_AREA, pump_with
from system.bench.points import BenchPoints
from system.bench.sensors import actual
from system.description.pump import PumpDescription
from system.effects.effect import Effects
from system.pump.chamber.problem import LeakTable
from system.pump.lumped import PistonMotion, lumped_leaks, piston_motion
from system.pump.operating import OperatingPoint


@dataclass(frozen=True)
class Setting:
    """A pump at N points, columns (N, 1): its motion over M shaft angles, and its chambers."""

    pump: PumpDescription
    point: OperatingPoint[Array]
    motion: PistonMotion[Array]
    problem: MapProblem


def setting(
    pump: PumpDescription, points: BenchPoints, values: Mapping[str, float], samples_per_pitch: int
) -> Setting:
    """The pump with values of `base_parameters` at the points less the zeros of their sensors."""
    own = pump_with(pump, values)
    at = actual(points, values)
    temperature = _column(at.T_case)
    point = OperatingPoint(
        shaft_speed=_column(at.speed),
        delivery_pressure=_column(at.p_out),
        inlet_pressure=_column(at.p_in),
        case_pressure=_column(at.p_case),
        displacement_ratio=_column(at.displacement_ratio),
        temperature=temperature,
        viscosity=walther(temperature, own.oil.fluid) * own.oil.density,
    )
    motion = piston_motion(own, point, samples_per_pitch)
    problem = map_problem(own, point, motion, lumped_leaks(own, point, motion))
    problem.ports[:, 1] += values.get(GROOVE_ADVANCE, 0.0)
    problem.ports[:, 2] *= values.get(GROOVE_AREA, 1.0)
    return Setting(own, point, motion, problem)


def affected(given: Setting, effects: Effects) -> Setting:
    """The same with what effects change of displacement, gaps and ports, at their points and angles."""
    point, motion = given.point, given.motion
    if np.any(effects.ideal != 1.0):
        ratio = point.displacement_ratio * _column(effects.ideal)
        point = replace(point, displacement_ratio=ratio)
        motion = piston_motion(given.pump, point, motion.shaft_angle.size // given.pump.pump.pistons)
    leaks = lumped_leaks(given.pump, point, motion)
    leaks = LeakTable(leaks.conductance * np.swapaxes(effects.conductance, 0, 1), leaks.carried_flow)
    problem = map_problem(given.pump, point, motion, leaks)
    ports = problem.ports.copy()
    ports[:, 1] = given.problem.ports[:, 1] + effects.groove_advance
    ports[:, 2] = given.problem.ports[:, 2] * effects.groove_area
    ports[:, 3] = given.problem.ports[:, 3] * effects.suction_area
    return Setting(given.pump, point, motion, replace(problem, ports=ports))


def _column(values: Array) -> Array:
    return np.asarray(values, dtype=float)[:, None]
