"""Laws of drag on the shaft outside the seven pairs: oil in the case, seal, charge pump, ports."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from reynolds.numerics.arrays import Array
from system.description.gap import Gap
from system.effects.effect import BenchState, Effects, GapCourse
from system.effects.extension import Values
from system.effects.state import dead_volume, displaced, full_stroke, ideal_flow, pressure_difference, unchanged
from system.inputs.units import TURN

BARREL_WALL = 0.2
"""Wall outside the bores, of the piston diameter (usual; not stated in any available drawing)."""
BARREL_LENGTH = 1.4
"""Length of the barrel, of the pistons' engaged length (usual)."""
HOUSING_GAP = 1.0 / 6.0
"""Between barrel and housing, of the barrel's radius (usual)."""
TURBULENT_REYNOLDS = 1e4
CYLINDER_DRAG = 1.2
"""Drag coefficient of a cylinder across a stream, Re 1e3 to 1e5 (Schlichting)."""
SHELTER = 0.25
"""Of a piston behind its neighbour."""
CO_ROTATION = 0.4
"""Left of a piston's dynamic pressure when the oil turns with the group."""
CHARGE_EFFICIENCY = 0.88
"""Hydromechanical, of a small gear pump (usual)."""

Courses = Mapping[Gap, GapCourse]


def wendt_coefficient(reynolds: Array, gap_ratio: float) -> Array:
    """Moment coefficient of a cylinder that turns in a housing: 1.03 (s/r)^.3 Re^-.5.

    From Re 1e4 on .065 (s/r)^.3 Re^-.2. Wendt 1933; Re = w r s/nu. Torque .5 pi c rho w^2 r^4 L.
    """
    laminar, turbulent = 1.03 * reynolds**-0.5, 0.065 * reynolds**-0.2
    return np.asarray(gap_ratio**0.3 * np.where(reynolds < TURBULENT_REYNOLDS, laminar, turbulent))


def barrel_torque(state: BenchState) -> Array:
    """Torque (N,) N m of the barrel in a case full of oil: Taylor-Couette flow with Wendt's coefficient."""
    part, density = state.geometry.pump, state.geometry.oil.density
    radius = part.pitch_radius + (0.5 + BARREL_WALL) * part.piston_diameter
    length = BARREL_LENGTH * state.geometry.piston.engaged_length
    reynolds = state.speed * radius**2 * HOUSING_GAP * density / state.viscosity
    coefficient = wendt_coefficient(reynolds, HOUSING_GAP)
    return np.asarray(0.5 * np.pi * coefficient * density * state.speed**2 * radius**4 * length)


def pistons_torque(state: BenchState) -> Array:
    """Torque (N,) N m of the pistons that protrude from the barrel: cylinders across a stream."""
    part, density = state.geometry.pump, state.geometry.oil.density
    out = state.geometry.piston.overhang - state.geometry.slipper.ball_joint_radius + 0.5 * full_stroke(state)
    pressure = 0.5 * density * (state.speed * part.pitch_radius) ** 2 * SHELTER * CO_ROTATION
    return np.asarray(part.pistons * CYLINDER_DRAG * pressure * part.piston_diameter * out * part.pitch_radius)


def churning(values: Values, courses: Courses, state: BenchState) -> Effects:
    """`factor` times the drag of barrel and pistons in the case's oil; good to a half by itself."""
    return _drag(courses, state, values["factor"] * (barrel_torque(state) + pistons_torque(state)))


def seal_drag(values: Values, courses: Courses, state: BenchState) -> Effects:
    """A shaft seal's `torque` (N m), and `per_case_pressure` (1/Pa) of it more with the case's pressure on its lip."""
    pressed = 1.0 + values["per_case_pressure"] * np.maximum(state.case_pressure, 0.0)
    return _drag(courses, state, values["torque"] * pressed)


def charge_pump_drag(values: Values, courses: Courses, state: BenchState) -> Effects:
    """A charge pump of `volume` m3 a turn on the same shaft that fills the inlet from the case's tank."""
    rise = np.maximum(state.inlet_pressure - state.case_pressure, 0.0)
    return _drag(courses, state, values["volume"] * rise / (TURN * CHARGE_EFFICIENCY))


def port_throttling(values: Values, courses: Courses, state: BenchState) -> Effects:
    """Passages behind both ports, `factor` times the loss of two open kidneys: rho/2 (Q/(2 Cd A))^2 each way.

    Torque of that pressure on the displacement: n^2 eps^3, independent of the pressure and the oil's temperature.
    """
    ports = state.geometry.ports
    speed = ideal_flow(state) / (2.0 * ports.flow_coefficient * ports.kidney_area)
    loss = 0.5 * state.geometry.oil.density * speed**2
    return _drag(courses, state, values["factor"] * 2.0 * loss * displaced(state) / TURN)


def compression_loss(values: Values, courses: Courses, state: BenchState) -> Effects:
    """`share` of the energy z V_d dp^2/(2 K) that oil in the dead volumes holds is lost at each turn."""
    stored = dead_volume(state) * pressure_difference(state) ** 2 / (2.0 * state.geometry.oil.bulk_modulus)
    return _drag(courses, state, values["share"] * stored / TURN)


def _drag(courses: Courses, state: BenchState, torque: Array) -> Effects:
    return replace(unchanged(courses), torque=torque, carried_off=torque * state.speed)
