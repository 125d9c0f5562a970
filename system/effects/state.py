"""Common inputs of several laws at a bench point: displaced and dead volume, orifices, warmer oil."""

from collections.abc import Callable, Iterator, Mapping
from functools import cache

import numpy as np

from reynolds.laws.oil import WALTHER_SHIFT, walther_coefficients
from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import BenchState, Effects, GapCourse, Value, neutral
from system.inputs.units import STANDARD_ATMOSPHERE, TURN
from system.pump.laws.kinematics import displacement, stroke
from system.pump.lumped import full_drive, piston_area

GAPS = tuple(Gap)
"""The gaps in the order of the first axis of `Effects.conductance`."""


class AwaitedCourses(Mapping[Gap, GapCourse]):
    """The courses of the gaps at N points and M angles, computed when a law first needs one."""

    def __init__(self, shape: tuple[int, int], found: Callable[[], Mapping[Gap, GapCourse]]) -> None:
        self.shape, self._found = shape, cache(found)

    def __getitem__(self, gap: Gap) -> GapCourse:
        """The course of one gap."""
        return self._found()[gap]

    def __iter__(self) -> Iterator[Gap]:
        """The gaps in their order."""
        return iter(Gap)

    def __len__(self) -> int:
        """The number of gaps."""
        return len(Gap)


def unchanged(courses: Mapping[Gap, GapCourse]) -> Effects:
    """`neutral` in the shape of the courses."""
    shape = courses.shape if isinstance(courses, AwaitedCourses) else courses[Gap.PISTON].pressure.shape
    return neutral(*shape)


def full_stroke(state: BenchState[Value]) -> float:
    """Stroke in m at the largest swash angle."""
    return stroke(full_drive(state.geometry))


def swash_tangent(state: BenchState) -> Array:
    """tan(swash angle) (N,), proportional to the displacement ratio: exact except for t^2 of the bores' cone."""
    return np.asarray(state.displacement_ratio * np.tan(state.geometry.pump.swash_angle_max))


def displaced(state: BenchState[Value]) -> Value:
    """Volume (N,) m3 that all pistons displace in a turn."""
    pump = state.geometry
    return displacement(pump.pump.pistons, piston_area(pump), full_stroke(state)) * state.displacement_ratio


def ideal_flow(state: BenchState[Value]) -> Value:
    """Displaced volume over time (N,), m3/s."""
    return displaced(state) * state.speed / TURN


def dead_volume(state: BenchState) -> Array:
    """Volume (N,) m3 of all chambers together at inner dead centre: it grows as the stroke is reduced."""
    part = state.geometry.pump
    back = piston_area(state.geometry) * full_stroke(state) * (1.0 - state.displacement_ratio) / 2.0
    return np.asarray(part.pistons * (part.dead_volume + back))


def pressure_difference(state: BenchState) -> Array:
    """Delivery over inlet pressure (N,), Pa."""
    return np.asarray(state.delivery_pressure - state.inlet_pressure)


def absolute(pressure: Array) -> Array:
    """A gauge pressure (Pa) as an absolute one."""
    return np.asarray(pressure + STANDARD_ATMOSPHERE)


def orifice_flow(state: BenchState, area: float, drop: Array) -> Array:
    """Flow (N,) m3/s through a sharp-edged orifice, Cd A sqrt(2 dp/rho), Cd the ports'; odd in dp."""
    speed = np.sqrt(2.0 * np.abs(drop) / state.geometry.oil.density)
    return np.asarray(np.sign(drop) * state.geometry.ports.flow_coefficient * area * speed)


def throttled(state: BenchState, flow: Array, drop: Array) -> Array:
    """Power (N,) W that a `flow` (m3/s at the higher pressure) loses over a `drop` (Pa): Q K (exp(dp/K) - 1).

    It is the mass flow times the difference of h = K (1 - exp(-p/K)), since the oil expands on its path: Q dp (1 +
    dp/2K) to second order.
    """
    modulus = state.geometry.oil.bulk_modulus
    return np.asarray(flow * modulus * np.expm1(drop / modulus))


def warmed(state: BenchState, rise: Array) -> Array:
    """Viscosity of the oil warmer by `rise` K over its viscosity at the state's temperature, (N, ...) as `rise`.

    Walther's law (1931, ASTM D341) through the oil's two viscosities, also beyond 150 degC: there it continues
    smoothly, positive and falling, for intermediate steps of a fit.
    """
    intercept, slope = walther_coefficients(state.geometry.oil.fluid)
    cold = state.temperature.reshape((-1,) + (1,) * (rise.ndim - 1))

    def viscosity(kelvin: Array) -> Array:
        return np.asarray(10.0**10.0 ** (intercept - slope * np.log10(kelvin)) - WALTHER_SHIFT)

    return np.asarray(viscosity(cold + rise) / viscosity(cold))
