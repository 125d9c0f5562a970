"""Laws of oil on other paths: past the chambers, into the case, or not into the chamber."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import BenchState, Effects, GapCourse
from system.effects.extension import Values
from system.effects.state import orifice_flow, pressure_difference, throttled, unchanged
from system.inputs.units import TURN

REFERENCE_VISCOSITY = 0.025
"""Pa s at which a laminar control flow has the size that its area states."""

Courses = Mapping[Gap, GapCourse]


def squeeze_pumping(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Slippers that rise and fall by `stroke` m each turn pump oil from the inlet's side into the case."""
    area = np.pi * state.geometry.slipper.land_outer_radius**2
    flow = state.geometry.pump.pistons * area * values["stroke"] * state.speed / TURN
    lost = throttled(state, flow, state.inlet_pressure - state.case_pressure)
    return replace(unchanged(courses), drain_from_inlet=flow, carried_off=lost)


def port_short_circuit(values: Values, courses: Courses, state: BenchState) -> Effects:
    """A turbulent path of `area` m2 from delivery to inlet, in the mean: sqrt(dp), at any speed and with any oil."""
    return _across(courses, state, orifice_flow(state, values["area"], pressure_difference(state)))


def laminar_cross_leak(values: Values, courses: Courses, state: BenchState) -> Effects:
    """A laminar path from delivery to inlet: flow `conductance` (m3) dp/mu."""
    return _across(courses, state, values["conductance"] * pressure_difference(state) / state.viscosity)


def control_flow(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Flow of the control from delivery into the case, at any speed and displacement.

    A clearance and an orifice in series, dp/p0 = l (mu/mu0) Q/Q0 + (1 - l) (Q/Q0)^2: `area` m2 of an orifice with
    the flow Q0 at rated pressure p0, where `laminar` l is the clearance's share of the pressure at mu0 = 25 mPa
    s; 0: an orifice alone, 1: a clearance alone.
    """
    drop = state.delivery_pressure - state.case_pressure
    rated = state.geometry.pump.rated_pressure
    full = orifice_flow(state, values["area"], np.full_like(drop, rated))
    slit = values["laminar"] * state.viscosity / REFERENCE_VISCOSITY
    orifice = 4.0 * (1.0 - values["laminar"]) * np.abs(drop) / rated
    flow = full * 2.0 * drop / rated / np.maximum(slit + np.sqrt(slit**2 + orifice), 1e-12)
    return replace(unchanged(courses), drain_flow=flow, carried_off=throttled(state, flow, drop))


def _across(courses: Courses, state: BenchState, flow: Array) -> Effects:
    lost = throttled(state, flow, pressure_difference(state))
    return replace(unchanged(courses), cross_flow=flow, carried_off=lost)
