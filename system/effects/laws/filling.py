"""Laws of chambers that fill in part at suction: by the loss of each piston's flow, of the line's, by an onset."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from scipy.integrate import cumulative_trapezoid

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import BenchState, Effects, GapCourse
from system.effects.extension import Values
from system.effects.laws.flow import REFERENCE_VISCOSITY
from system.effects.state import full_stroke, ideal_flow, unchanged
from system.pump.chamber.layout import CAVITY_PRESSURE
from system.pump.lumped import piston_area, port_openings
from system.pump.ports.areas import opening_area

Courses = Mapping[Gap, GapCourse]
LEAST_LOSS = 1e-3
"""Pa, least loss assumed of a kidney: an upright plate has none."""
HALVINGS = 50
"""Of the bracket of the pressure behind the line: to round-off."""
STROKE_ANGLES = 361
ROOTS = np.linspace(0.0, 4.0, 401)
"""Ratios at which the filled share is computed; above them every chamber fills."""


def kidney_loss(state: BenchState, speed: Array, displacement_ratio: Array) -> Array:
    """Pa (N,), loss of the suction kidney at one piston's largest flow: rho/2 (q/(Cd A))^2."""
    suction, _ = state.geometry.ports.sides
    flow = piston_area(state.geometry) * speed * 0.5 * full_stroke(state) * displacement_ratio
    drop = 0.5 * state.geometry.oil.density * (flow / (suction.flow_coefficient * suction.kidney_area)) ** 2
    return np.asarray(drop)


def suction_opening(state: BenchState) -> tuple[Array, Array]:
    """Angles (M,) rad of a suction stroke and the area of its port there over that of the kidney."""
    suction, _ = port_openings(state.geometry)
    angle = np.linspace(0.0, np.pi, STROKE_ANGLES)
    return angle, opening_area(suction, angle) / suction.kidney_area


def filled_share(root: Array, angle: Array, opened: Array) -> Array:
    """Share of a chamber that fills at a root of the port's pressure over the kidney's largest loss.

    A piston's speed goes with the sine of the angle; the port passes `root` times its opened area during cavitation. So
    the cavity is the largest excess, over all earlier angles, of the volume swept since over the oil passed (a
    reflected walk). root (N,); angle, opened (M,): of the suction stroke.
    """
    swept = 0.5 * (1.0 - np.cos(angle))
    passed = 0.5 * cumulative_trapezoid(opened, angle, initial=0.0)
    lack = swept - root[:, None] * passed
    return np.asarray(1.0 - (lack[:, -1] - lack.min(axis=1)))


def starved_kidneys(values: Values, courses: Courses, state: BenchState) -> Effects:
    """An inlet that loses `inlet_loss` times the pressure loss of the kidney, for each piston's own flow.

    Inlet and kidney act as a kidney (1 + inlet_loss)^(-1/2) as wide, dp = rho/2 (Q/(Cd A))^2. Where that loss equals
    the inlet's pressure a cavity opens. Above a speed n_c, which is proportional to the root of that pressure, chambers
    no longer fill: the share n_c/n. Valid for passages between the plenum and one kidney.
    """
    narrowed = (1.0 + values["inlet_loss"]) ** -0.5
    return replace(unchanged(courses), suction_area=np.full_like(state.speed, narrowed))


def starved_line(values: Values, courses: Courses, state: BenchState) -> Effects:
    """An inlet line that loses pressure by the sum of all pistons' inflow, dp = x L ((1 - l) q^2 + l m q).

    q: flow over the displaced flow at rated speed and full stroke, by `filled_share` where chambers starve; L: the
    kidney's loss there; x: `inlet_loss`; l: `laminar` share at 25 mPa s, m: viscosity over that. After Ivantysyn and
    Ivantysynova 2001; Hagen and Poiseuille for a line of cold oil.
    """
    part, ones = state.geometry.pump, np.ones_like(state.speed)
    rated = replace(state, speed=part.rated_speed * ones, displacement_ratio=ones)
    size, thick = values["inlet_loss"], values["laminar"] * state.viscosity / REFERENCE_VISCOSITY
    full, whole = ideal_flow(state) / ideal_flow(rated), kidney_loss(state, rated.speed, ones)
    own = kidney_loss(state, state.speed, state.displacement_ratio)
    above = np.maximum(state.inlet_pressure - CAVITY_PRESSURE, 0.0)
    shares = filled_share(ROOTS, *suction_opening(state))

    def lost(root: Array) -> Array:
        flow = full * np.interp(root, ROOTS, shares)
        return np.asarray(size * whole * ((1.0 - values["laminar"]) * flow**2 + thick * flow))

    low, high = np.zeros_like(own), np.sqrt(above / np.maximum(own, LEAST_LOSS))
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        beyond = own * middle**2 + lost(middle) > above
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return replace(unchanged(courses), suction_loss=lost(high))


def starved_beyond_onset(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Cavities that grow smoothly from a critical speed on: filled share 1/(1 + g (n/n_c - 1)^2) above n_c.

    n_c: at which the loss of line and kidney, 1 + `inlet_loss` times the kidney's, equals the inlet's pressure; it goes
    with the root of that. g: `growth`. A form of test reports, not derived. Relative to the kidney alone, whose filling
    the chamber's own balance includes.
    """
    above = np.maximum(state.inlet_pressure - CAVITY_PRESSURE, 1.0)
    plain = np.sqrt(kidney_loss(state, state.speed, state.displacement_ratio) / above)

    def filled(over: Array) -> Array:
        return np.asarray(1.0 / (1.0 + values["growth"] * np.maximum(over - 1.0, 0.0) ** 2))

    share = filled(np.sqrt(1.0 + values["inlet_loss"]) * plain) / filled(plain)
    return replace(unchanged(courses), intake=share)
