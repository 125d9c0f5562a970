"""Laws of oil that goes another way: past the chambers, into the case, or not into the chamber at all."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from system.kinematics import Array
from system.physics.effects import BenchState, Effects, GapCourse
from system.physics.extension import Values
from system.physics.state import (
    TURN,
    absolute,
    dead_volume,
    displaced,
    orifice_flow,
    piston_area,
    pressure_difference,
    swash_tangent,
    unchanged,
)
from system.pump_gap import Gap
from system.units import STANDARD_ATMOSPHERE

POLYTROPIC = 1.2
"""Exponent of air bubbles in oil, between slow (1) and fast (1.4) changes."""
REFERENCE_VISCOSITY = 0.025
"""Pa s at which a laminar control flow has the size that its area states."""

Courses = Mapping[Gap, GapCourse]


def free_air(share: float, pressure: Array) -> Array:
    """Volume share (N,) of bubbles at an absolute pressure (Pa) with `share` at one atmosphere."""
    return np.asarray(share * (STANDARD_ATMOSPHERE / pressure) ** (1.0 / POLYTROPIC))


def entrained_air(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Bubbles fill part of the displacement and of the dead volume as they grow again; they are gone at delivery.

    `void`: volume share at one atmosphere. The missing oil is x(p_in) - x(p_out) of displaced and dead volume.
    """
    lost = free_air(values["void"], absolute(state.inlet_pressure))
    lost = lost - free_air(values["void"], absolute(state.delivery_pressure))
    return replace(unchanged(courses), intake=1.0 - lost * (1.0 + dead_volume(state) / displaced(state)))


def suction_loss(state: BenchState) -> Array:
    """Pressure (N,) Pa that a chamber lacks at its fastest suction: rho/2 (Ap v/(Cd A_k))^2."""
    ports, part = state.geometry.ports, state.geometry.pump
    fastest = state.speed * part.pitch_radius * swash_tangent(state) / np.cos(part.bore_cone_angle)
    through = piston_area(state) * fastest / (ports.flow_coefficient * ports.kidney_area)
    return np.asarray(0.5 * state.geometry.oil.density * through**2)


def incomplete_filling(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Above the speed at which suction falls to `gas_pressure` (Pa gauge) the flow grows no more.

    `inlet_loss` 1 is the kidney's own loss, which goes with speed squared: the share that fills is n_c/n, n_c/n =
    sqrt((p_in - p_gas)/loss), and 1 below.
    """
    loss = values["inlet_loss"] * suction_loss(state)
    left = np.maximum(state.inlet_pressure - values["gas_pressure"], 0.0)
    filled = np.sqrt(left / np.maximum(np.maximum(loss, left), 1e-9))
    return replace(unchanged(courses), intake=filled)


def squeeze_pumping(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Slippers that rise and fall by `stroke` m each turn pump oil from the inlet's side into the case."""
    area = np.pi * state.geometry.slipper.land_outer_radius**2
    flow = state.geometry.pump.pistons * area * values["stroke"] * state.speed / TURN
    lost = flow * (state.inlet_pressure - state.case_pressure)
    return replace(unchanged(courses), drain_from_inlet=flow, carried_off=lost)


def port_short_circuit(values: Values, courses: Courses, state: BenchState) -> Effects:
    """A turbulent path of `area` m2 from delivery to inlet, in the mean: sqrt(dp), whatever speed and oil."""
    return _across(courses, state, orifice_flow(state, values["area"], pressure_difference(state)))


def laminar_cross_leak(values: Values, courses: Courses, state: BenchState) -> Effects:
    """A laminar path from delivery to inlet: flow `conductance` (m3) dp/mu."""
    return _across(courses, state, values["conductance"] * pressure_difference(state) / state.viscosity)


def control_flow(values: Values, courses: Courses, state: BenchState) -> Effects:
    """What the control draws from delivery into the case, at any speed and displacement.

    A clearance and an orifice one behind the other, dp/p0 = l (mu/mu0) Q/Q0 + (1 - l) (Q/Q0)^2: `area` m2 of an
    orifice with the flow Q0 at rated pressure p0, where `laminar` l is the clearance's share of the pressure at
    mu0 = 25 mPa s; 0: an orifice alone, 1: a clearance alone.
    """
    drop = state.delivery_pressure - state.case_pressure
    rated = state.geometry.pump.rated_pressure
    full = orifice_flow(state, values["area"], np.full_like(drop, rated))
    slit = values["laminar"] * state.viscosity / REFERENCE_VISCOSITY
    orifice = 4.0 * (1.0 - values["laminar"]) * np.abs(drop) / rated
    flow = full * 2.0 * drop / rated / np.maximum(slit + np.sqrt(slit**2 + orifice), 1e-12)
    return replace(unchanged(courses), drain_flow=flow, carried_off=flow * drop)


def _across(courses: Courses, state: BenchState, flow: Array) -> Effects:
    return replace(unchanged(courses), cross_flow=flow, carried_off=flow * pressure_difference(state))
