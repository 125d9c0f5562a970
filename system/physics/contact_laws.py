"""Laws of faces that touch: friction of boundary layers where films no longer part them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from system.kinematics import Array
from system.physics.effects import BenchState, Effects, GapCourse
from system.physics.extension import Values
from system.physics.state import GAPS, unchanged
from system.pump_gap import Gap

LENGTH = 0.02
"""Of a film along its sliding, m: makes the Hersey number of a pressure dimensionless."""
LEAST_PRESSURE = 1e5
"""Pa over case pressure that a film is taken to bear at least: parts weigh and springs press without pressure."""


def hersey(viscosity: Array, course: GapCourse) -> Array:
    """Hersey number mu v/(L p) (N, M) of a film that bears the chamber's pressure."""
    pressure = np.maximum(course.pressure, LEAST_PRESSURE)
    return np.asarray(viscosity[:, None] * course.sliding_speed / (LENGTH * pressure))


def stribeck_share(number: Array, scale: float) -> Array:
    """Share of the load that boundary layers bear at a Hersey number: exp(-H/H0), after Stribeck 1902."""
    return np.asarray(np.exp(-number / scale))


def mixed_friction(values: Values, courses: Mapping[Gap, GapCourse], state: BenchState) -> Effects:
    """Friction f_b exp(-H/H0) N v beside the Coulomb loss, in each pair at every angle.

    `piston`, `slipper`, `valve_plate`: f_b of the pair's boundary layer; `hersey_scale`: H0. Most where parts
    slide slowly under pressure, and in hot oil.
    """
    effects = unchanged(courses)
    extra = effects.extra_coulomb.copy()
    for row, gap in enumerate(GAPS):
        own = courses[gap]
        share = stribeck_share(hersey(state.viscosity, own), values["hersey_scale"])
        extra[row] = values[gap.value] * share * own.normal_force * own.sliding_speed
    return replace(effects, extra_coulomb=extra)
