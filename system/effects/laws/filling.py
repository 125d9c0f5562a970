"""Laws of chambers that no longer fill at suction: by the loss of each piston's flow, of the line's, by an onset."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import BenchState, Effects, GapCourse
from system.effects.extension import Values
from system.effects.laws.flow import REFERENCE_VISCOSITY
from system.effects.state import full_stroke, ideal_flow, piston_area, unchanged
from system.pump.chamber.layout import CAVITY_PRESSURE

Courses = Mapping[Gap, GapCourse]


def kidney_loss(state: BenchState, speed: Array, displacement_ratio: Array) -> Array:
    """Pa (N,) that the suction kidney takes of one piston's largest flow: rho/2 (q/(Cd A))^2."""
    suction, _ = state.geometry.ports.sides
    flow = piston_area(state) * speed * 0.5 * full_stroke(state) * displacement_ratio
    drop = 0.5 * state.geometry.oil.density * (flow / (suction.flow_coefficient * suction.kidney_area)) ** 2
    return np.asarray(drop)


def open_share(state: BenchState) -> float:
    """Flow that all suction kidneys let through at the loss of a piston's largest flow, over the displaced flow.

    Half the arc over which one kidney is open, slopes counted by half.
    """
    suction, _ = state.geometry.ports.sides
    whole = suction.kidney_full_end - suction.kidney_full_start
    slopes = suction.kidney_full_start - suction.groove_end + suction.kidney_end - suction.kidney_full_end
    return 0.5 * (whole + 0.5 * slopes)


def starved_kidneys(values: Values, courses: Courses, state: BenchState) -> Effects:
    """An inlet that loses `inlet_loss` times the pressure loss of the kidney, each piston's flow for itself.

    Inlet and kidney act as a kidney (1 + inlet_loss)^(-1/2) as wide, dp = rho/2 (Q/(Cd A))^2. Where that loss
    equals the inlet's pressure a cavity opens. Above a speed n_c, which is proportional to the root of that
    pressure, chambers no longer fill: the share n_c/n. True of passages between the plenum and one kidney.
    """
    narrowed = (1.0 + values["inlet_loss"]) ** -0.5
    return replace(unchanged(courses), suction_area=np.full_like(state.speed, narrowed))


def starved_line(values: Values, courses: Courses, state: BenchState) -> Effects:
    """An inlet line that loses pressure by the sum of all pistons' flow that comes, dp = x L ((1 - l) q^2 + l m q).

    q: flow over the displaced flow at rated speed and full stroke; L: the kidney's loss there; x: `inlet_loss`; l:
    `laminar` share at 25 mPa s, m: viscosity over that. Chambers fill while the kidneys let q through at what the
    line leaves, q <= a (p/L)^(1/2), a by `open_share`; beyond, both are equal. After Ivantysyn and Ivantysynova 2001;
    Hagen and Poiseuille for a line of cold oil.
    """
    part, ones = state.geometry.pump, np.ones_like(state.speed)
    rated = replace(state, speed=part.rated_speed * ones, displacement_ratio=ones)
    loss = kidney_loss(state, rated.speed, ones)
    thick = values["laminar"] * state.viscosity / REFERENCE_VISCOSITY
    square, open_to = 1.0 - values["laminar"], open_share(state) ** -2
    above = np.maximum(state.inlet_pressure - CAVITY_PRESSURE, 0.0) / loss
    size = values["inlet_loss"]
    bend, slope = open_to + size * square, size * thick
    starved = 2.0 * above / (slope + np.sqrt(slope**2 + 4.0 * bend * above) + 1e-12)
    flow = np.minimum(ideal_flow(state) / ideal_flow(rated), starved)
    lost = np.asarray(size * loss * (square * flow**2 + thick * flow))
    return replace(unchanged(courses), suction_loss=lost)


def starved_beyond_onset(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Cavities that grow smoothly from a critical speed on: filled share 1/(1 + g (n/n_c - 1)^2) above n_c.

    n_c: at which the loss of line and kidney, 1 + `inlet_loss` times the kidney's, equals the inlet's pressure; it
    goes with the root of that. g: `growth`. A form of test reports, not derived. Relative to the kidney alone, whose
    filling the chamber's own balance has.
    """
    above = np.maximum(state.inlet_pressure - CAVITY_PRESSURE, 1.0)
    plain = np.sqrt(kidney_loss(state, state.speed, state.displacement_ratio) / above)

    def filled(over: Array) -> Array:
        return np.asarray(1.0 / (1.0 + values["growth"] * np.maximum(over - 1.0, 0.0) ** 2))

    share = filled(np.sqrt(1.0 + values["inlet_loss"]) * plain) / filled(plain)
    return replace(unchanged(courses), intake=share)
