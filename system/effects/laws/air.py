"""Laws of free air in the oil: bubbles that enter behind the inlet's meter, or that come with the oil of the tank."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import BenchState, Effects, GapCourse
from system.effects.extension import Values
from system.effects.state import absolute, dead_volume, displaced, unchanged
from system.inputs.units import STANDARD_ATMOSPHERE

POLYTROPIC = 1.2
"""Exponent of air bubbles in oil, between slow (1) and fast (1.4) changes."""

Courses = Mapping[Gap, GapCourse]


def free_air(share: float, pressure: Array) -> Array:
    """Volume share (N,) of bubbles at an absolute pressure (Pa) with `share` at one atmosphere."""
    return np.asarray(share * (STANDARD_ATMOSPHERE / pressure) ** (1.0 / POLYTROPIC))


def entrained_air(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Bubbles fill part of the displacement and of the dead volume as they expand; at delivery they have vanished.

    `void`: volume share at one atmosphere. The missing oil is x(p_in) - x(p_out) of displaced and dead volume, at most
    all that is displaced.
    """
    lost = free_air(values["void"], absolute(state.inlet_pressure))
    lost = lost - free_air(values["void"], absolute(state.delivery_pressure))
    filled = 1.0 - lost * (1.0 + dead_volume(state) / displaced(state))
    return replace(unchanged(courses), intake=np.maximum(filled, 0.0))


def air_in_chambers(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Bubbles that pass the inlet's meter with the oil and are compressed in the chambers: x0 (p0/p)^(1/n).

    `void`: x0, of the oil's volume at one atmosphere; `polytropic`: n, 1 (slow, isothermal) to 1.4 (fast, adiabatic;
    Nykaenen, Esque and Ellman 2000). They soften the oil at low pressure, delay the rise of the chamber's pressure and
    replace oil. Assumption: they dissolve no faster than they are compressed.
    """
    share = np.full_like(state.speed, values["void"])
    exponent = np.where(share > 0.0, 1.0 / values["polytropic"], 0.0)
    return replace(unchanged(courses), free_air=share, air_exponent=exponent)
