"""Laws of parts that lift or tip: slippers off the swash plate, a block on its valve plate."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import BenchState, Effects, GapCourse
from system.effects.extension import Values
from system.effects.laws.film import through_orifice
from system.effects.laws.flow import REFERENCE_VISCOSITY
from system.effects.state import GAPS, pressure_difference, swash_tangent, throttled, unchanged
from system.pump.lumped import piston_area

ONSET = 0.2
"""Share of the holding moment over which a part tips smoothly, from that moment on."""

Courses = Mapping[Gap, GapCourse]


def unseated_share(ratio: Array) -> Array:
    """Degree of tipping of a part, 0 to 1, at a ratio of the tipping moment to the holding moment."""
    way = np.clip((ratio - 1.0) / ONSET, 0.0, 1.0)
    return np.asarray(way * way * (3.0 - 2.0 * way))


def slipper_ratio(state: BenchState, pressure: Array, retainer_force: float) -> Array:
    """Tipping over holding moment (N, M) of a slipper: m w^2 R l against (Ap p + F) r1, p over case pressure.

    The mass of a slipper outside its ball turns it outwards; chamber pressure and retainer press it on its land.
    """
    slipper, part = state.geometry.slipper, state.geometry.pump
    tips = slipper.mass * state.speed**2 * part.pitch_radius * slipper.centre_of_mass_to_ball
    holds = (piston_area(state.geometry) * np.maximum(pressure, 0.0) + retainer_force) * slipper.land_inner_radius
    return np.asarray(tips[:, None] / np.maximum(holds, 1e-3))


def slipper_lift(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Slippers that tip off by `ride_height` m where chamber and `retainer_force` (N each) do not hold them."""
    ratio = slipper_ratio(state, courses[Gap.SLIPPER].pressure, values["retainer_force"])
    return _ridden(values["ride_height"] * unseated_share(ratio), courses, state)


def slippers_tilt_by_degrees(values: Values, courses: Courses, state: BenchState) -> Effects:
    """The same with slippers that tilt by degrees, r^m/(1 + r^m) of `ride_height` at the ratio r of the moments.

    m: `sharpness`. The film's own moment, and differences between parts, spread the onset (tilts of Harris, Edge and
    Tilley 1996).
    """
    ratio = slipper_ratio(state, courses[Gap.SLIPPER].pressure, values["retainer_force"])
    tilted = ratio ** values["sharpness"]
    return _ridden(values["ride_height"] * tilted / (1.0 + tilted), courses, state)


def slippers_ride_on_a_wedge(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Slippers that ride higher by a hydrodynamic wedge: film + s x/(1 + x), x = (H/H0)^e, s `ride_height`.

    H: viscosity times sliding speed over the holding force, chamber pressure and `retainer_force`; H0: at 25 mPa s and
    rated speed under the retainer's force alone. e: `wedge_exponent`, 1/2 of pads free to tilt, 1 of a fixed wedge
    (Hooke and Li 1988). On both halves of the turn, largest at suction.
    """
    course, part = courses[Gap.SLIPPER], state.geometry.pump
    force = values["retainer_force"]
    holds = piston_area(state.geometry) * np.maximum(course.pressure, 0.0) + force
    sliding = (
        state.viscosity[:, None] * course.sliding_speed / (REFERENCE_VISCOSITY * part.rated_speed * part.pitch_radius)
    )
    number = (sliding * force / np.maximum(holds, 1e-3)) ** values["wedge_exponent"]
    return _ridden(values["ride_height"] * number / (1.0 + number), courses, state)


def _ridden(higher: Array, courses: Courses, state: BenchState) -> Effects:
    """Effects of slippers that ride higher by (N, M) m."""
    effects, film = unchanged(courses), 1.0 + higher / courses[Gap.SLIPPER].film
    row = GAPS.index(Gap.SLIPPER)
    conductance, viscous = effects.conductance.copy(), effects.viscous.copy()
    conductance[row], viscous[row] = through_orifice(film**3, state), 1.0 / film
    return replace(effects, conductance=conductance, viscous=viscous)


def block_ratio(state: BenchState, course: GapCourse) -> Array:
    """Tipping over holding moment (N,) of the block.

    The pistons' accelerations tip it, z/2 m w^2 R^2 tan(swash). Spring and residual clamping hold it at the outer
    land, the clamping with the lever of the loaded half's thrust, 2/pi of the pitch radius.
    """
    pump = state.geometry
    guide, plate, part = pump.ball_guide, pump.valve_plate, pump.pump
    spring = guide.spring_preload + guide.spring_stiffness * guide.spring_compression
    mass = pump.piston.mass + pump.slipper.mass
    tips = 0.5 * part.pistons * mass * (state.speed * part.pitch_radius) ** 2 * swash_tangent(state)
    thrust = part.pistons * piston_area(state.geometry) * np.maximum(course.pressure, 0.0).mean(axis=1)
    arm = plate.outer_radius - 2.0 / np.pi * part.pitch_radius
    return np.asarray(tips / (spring * plate.outer_radius + plate.residual_clamping * thrust * arm))


def block_tipping(values: Values, courses: Courses, state: BenchState) -> Effects:
    """A block that tips open by `wedge` m on one side: more flow over the lands, and between the kidneys.

    `wedge` is the tilt by the balance of forces times the plate's diameter. The tilts of 1.65e-4 to 4.3e-4 rad that
    Zhang et al. (2020) measure are larger: they are due to an error of coaxiality, which opens the film at any speed. A
    wedge 0 .. w over a film h has the mean conductance (h + w/2)^3 + 3/2 (h + w/2)(w/2)^2 round the plate. Of the plate
    between the kidneys, two webs as long as a chamber's pitch, the same additional flow goes from delivery to inlet.
    """
    course, effects = courses[Gap.VALVE_PLATE], unchanged(courses)
    pump, half = state.geometry, 0.5 * values["wedge"] * unseated_share(block_ratio(state, course))[:, None]
    film = course.film + half
    cubed = film**3 + 1.5 * film * half**2
    row = GAPS.index(Gap.VALVE_PLATE)
    conductance, viscous = effects.conductance.copy(), effects.viscous.copy()
    conductance[row], viscous[row] = cubed / course.film**3, course.film / film
    web = 2.0 * np.pi / pump.pump.pistons * pump.valve_plate.kidney_pitch_radius
    more = (cubed - course.film**3).mean(axis=1) * 2.0 * pump.valve_plate.kidney_width / (12.0 * web)
    flow = more * pressure_difference(state) / state.viscosity
    return replace(
        effects,
        conductance=conductance,
        viscous=viscous,
        cross_flow=flow,
        carried_off=throttled(state, flow, pressure_difference(state)),
    )
