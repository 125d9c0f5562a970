"""Laws of the swash plate and the ports: a plate that deflects, grooves that wear, a line that resonates."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import BenchState, Effects, GapCourse
from system.effects.extension import Values
from system.effects.state import pressure_difference, swash_tangent, unchanged

RESONANCE_WIDTH = 0.05
"""Half width of a line's resonance, of its speed: a quality of 10 (5 to 15 are usual)."""

Courses = Mapping[Gap, GapCourse]


def swash_droop(values: Values, courses: Courses, state: BenchState) -> Effects:
    """A plate that deflects under load by an angle, independent of its own: `rate` rad/Pa, and `play` rad at any
    load.

    The moment of the pistons under pressure deforms stop, actuator and trunnions. Ideal flow and torque fall by the
    same share, larger at small tilt; the plate deflects at most to upright.
    """
    angle = np.arctan(swash_tangent(state))
    left = np.maximum(angle - values["rate"] * pressure_difference(state) - values["play"], 0.0)
    ideal = np.divide(np.tan(left), np.tan(angle), out=np.ones_like(angle), where=angle > 0.0)
    return replace(unchanged(courses), ideal=ideal)


def notch_erosion(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Worn relief grooves: they begin `advance` rad sooner, their throats wider by the share `widening`."""
    ones = np.ones_like(state.speed)
    return replace(
        unchanged(courses), groove_advance=values["advance"] * ones, groove_area=(1.0 + values["widening"]) * ones
    )


def lorentz(speed: Array, at: float) -> Array:
    """1/(1 + ((n - n0)/(b n0))^2) (N,): a resonance at the shaft speed n0 = `at` rad/s, b RESONANCE_WIDTH."""
    return np.asarray(1.0 / (1.0 + ((speed - at) / (RESONANCE_WIDTH * at)) ** 2))


def line_resonance(values: Values, courses: Courses, state: BenchState) -> Effects:
    """A delivery meter that reads `height` (share) too much where the ripple is at the line's resonance.

    Mean bias of turbine meters in pulsing flow; the pump itself is unaffected. `speed`: of the shaft, rad/s.
    """
    return replace(unchanged(courses), delivery_reading=1.0 + values["height"] * lorentz(state.speed, values["speed"]))
