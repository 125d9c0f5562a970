"""A pump at the points of a bench map with given values of its parameters: the origin of all readings."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from reynolds.laws.oil import walther
from reynolds.numerics.arrays import Array
from system.bench.chamber_map import MapProblem
from system.bench.parameters import GROOVE_ADVANCE, GROOVE_AREA, INLET_SHARE, THROTTLE_SHARE, pump_with
from system.bench.points import BenchPoints
from system.bench.sensors import actual
from system.description.pump import PumpDescription
from system.effects.applied import affected_leaks, affected_wear, left_over
from system.effects.effect import Effects
from system.pump.chamber.problem import LeakTable
from system.pump.lumped import PistonMotion, chamber, lumped_leaks, piston_motion
from system.pump.operating import OperatingPoint, flat
from system.pump.ports.wear import PortWear


@dataclass(frozen=True)
class Setting:
    """A pump at N points, columns (N, 1): its motion over M shaft angles, its gaps' leakage, its ports' wear.

    free_air, air_exponent: of the bubbles in its chambers, (N,), or None.
    """

    pump: PumpDescription
    point: OperatingPoint[Array]
    motion: PistonMotion[Array]
    leaks: LeakTable
    wear: PortWear[Array]
    free_air: Array | float = 0.0
    air_exponent: Array | float = 1.0

    @cached_property
    def problem(self) -> MapProblem:
        """The chambers."""
        one = chamber(self.pump, flat(self.point), flat(self.motion.drive))
        bubbly = replace(one, free_air=self.free_air, air_exponent=self.air_exponent)
        return MapProblem(bubbly, self.leaks, self.wear)


def setting(pump: PumpDescription, points: BenchPoints, values: Mapping[str, float], samples_per_pitch: int) -> Setting:
    """The pump with values of `base_parameters` at the points less the zeros of their sensors."""
    own = pump_with(pump, values)
    at = actual(points, values)
    temperature = _column(_film_temperature(own, at, values))
    point = OperatingPoint(
        shaft_speed=_column(at.speed),
        delivery_pressure=_column(at.p_out),
        inlet_pressure=_column(at.p_in),
        case_pressure=_column(at.p_case),
        displacement_ratio=_column(at.displacement_ratio),
        temperature=temperature,
        viscosity=walther(temperature, own.oil.fluid) * own.oil.density,
    )
    motion, ones = piston_motion(own, point, samples_per_pitch), np.ones(len(at.speed))
    cut = values.get(GROOVE_ADVANCE, 0.0), values.get(GROOVE_AREA, 1.0)
    wear = PortWear(cut[0] * ones, cut[1] * ones, ones)
    return Setting(own, point, motion, lumped_leaks(own, point, motion), wear)


def affected(given: Setting, effects: Effects) -> Setting:
    """The same with the changes by effects of displacement, inlet, gaps and ports, at their points and angles."""
    pump, point, motion = given.pump, given.point, given.motion
    point = left_over(point, _column(effects.ideal), _column(effects.suction_loss))
    if np.any(effects.ideal != 1.0):
        motion = piston_motion(pump, point, motion.shaft_angle.size // pump.pump.pistons)
    leaks = affected_leaks(lumped_leaks(pump, point, motion), effects)
    wear = affected_wear(given.wear, effects)
    return Setting(pump, point, motion, leaks, wear, effects.free_air, effects.air_exponent)


def _film_temperature(pump: PumpDescription, at: BenchPoints, values: Mapping[str, float]) -> Array:
    """Temperature (N,) of the films in K: T_case + s (T_in + x dp/(rho c) - T_case), s: share of the inlet's oil."""
    warmed = at.T_in + values.get(THROTTLE_SHARE, 0.0) * (at.p_out - at.p_case) / (
        pump.oil.density * pump.oil.specific_heat
    )
    return at.T_case + values.get(INLET_SHARE, 0.0) * (warmed - at.T_case)


def _column(values: Array) -> Array:
    return np.asarray(values, dtype=float)[:, None]
