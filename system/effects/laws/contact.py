"""Laws of faces that touch: friction of boundary layers where films no longer separate them."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import BenchState, Effects, GapCourse
from system.effects.extension import Values
from system.effects.state import GAPS, unchanged

UNLOADED = 1e-9
"""N, least load assumed on a film: without load the Hersey number is infinite."""


def hersey(viscosity: Array, course: GapCourse) -> Array:
    """Hersey number mu v w/N (N, M): viscosity, sliding speed and width of a film over the load that it bears."""
    load = np.maximum(course.normal_force, UNLOADED)
    return np.asarray(viscosity[:, None] * course.sliding_speed * course.width[:, None] / load)


def stribeck_share(number: Array, scale: float, exponent: float) -> Array:
    """Share of the load that boundary layers bear at a Hersey number: exp(-(H/H0)^d), after Stribeck 1902.

    Of a rough pad that hydrodynamics and Greenwood and Tripp's summits bear together, its film with the root of H (a
    pivoting pad) or with H itself (a fixed wedge): d is .5 to 1.4, larger for stiffer summits, to .02 of the load.
    """
    return np.asarray(np.exp(-((number / scale) ** exponent)))


def mixed_friction(values: Values, courses: Mapping[Gap, GapCourse], state: BenchState) -> Effects:
    """Friction f_b exp(-(H/H0)^d) N v in addition to the Coulomb loss, in each pair at every angle.

    `piston`, `slipper`, `valve_plate`: f_b of the pair's boundary layer; `hersey_scale`: H0; `exponent`: d.
    Largest where parts slide slowly under load, and in hot oil.
    """
    effects = unchanged(courses)
    extra = effects.extra_coulomb.copy()
    for row, gap in enumerate(GAPS):
        own = courses[gap]
        share = stribeck_share(hersey(state.viscosity, own), values["hersey_scale"], values["exponent"])
        extra[row] = values[gap.value] * share * own.normal_force * own.sliding_speed
    return replace(effects, extra_coulomb=extra)
