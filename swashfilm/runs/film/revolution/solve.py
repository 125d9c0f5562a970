"""Solution of one gap over the turn: its films and headline numbers."""

import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from gaps.films.reports import Active, BlockReport, GapReport, PistonReport, SlipperReport
from gaps.revolution.march import GapRevolution, mass_balance_error
from gaps.revolution.warmth import GapTemperatures
from reynolds.numerics.arrays import Array
from swashfilm.case.gap.revolution import GapOverTurn, RevolutionCase
from swashfilm.formats.versions import headed
from swashfilm.runs.film.revolution.validity import revolution_warnings
from system.description.gap import Gap
from system.films.drives import Drives, drives, no_rubbing, slipper_shape
from system.films.heat import all_taken
from system.films.parts import FloatingParts, floating_parts
from system.films.rotor import valve_plate_geometry
from system.points.film_effects import floating_effects
from system.points.floating_gaps import block_revolution, piston_revolution, slipper_revolution
from system.work.progress import Report, silent

NO_RUBBING = "forces between the parts neglect the friction of the films on them (one gap alone)"


@dataclass(frozen=True)
class RevolutionStudy:
    """Periodic motion of a gap, the parts with their assumed values, chamber pressure, and computing time (s).

    assumed: neglected forces between the parts, and values that the pump file leaves out, in words; chamber_pressure
    (n,) Pa at the reported angles; for the block that of the chamber at shaft angle 0.
    """

    case: GapOverTurn
    parts: FloatingParts
    revolution: GapRevolution[Any] = field(repr=False)
    chamber_pressure: Array
    solve_seconds: float
    assumed: tuple[str, ...] = ()

    @property
    def span(self) -> float:
        """Period in shaft angle (rad): a turn, or a piston pitch."""
        return float(self.revolution.angles[-1])


def solve_revolution(case: RevolutionCase, report: Report = silent) -> RevolutionStudy:
    """Solve the gap over the turn under its chamber pressure, from equilibrium until the turn is periodic.

    Raises FilmNotConverged with the angle and a remedy, and NotConverged for the pump's own cycle.
    """
    began = time.perf_counter()
    rotor = case.rotor
    parts = floating_effects(rotor, floating_parts(rotor.pump), rotor.pump, case.options.physics).parts
    angles, pressure = case.chamber_pressure.over_turn(rotor)
    driven = drives(rotor, parts, angles, pressure, no_rubbing(len(angles)))
    found = _revolved(case, parts, driven, report)
    chamber = driven.piston.chamber_pressure
    at_angles = np.array([float(chamber(angle)) for angle in found.angles])
    assumed = (NO_RUBBING, *map(str, case.assumptions))
    return RevolutionStudy(case, parts, found, at_angles, time.perf_counter() - began, assumed)


def _revolved(case: RevolutionCase, parts: FloatingParts, driven: Drives, report: Report) -> GapRevolution[Any]:
    """Return the turn of the case's gap."""
    rotor, options = case.rotor, case.options
    match case.gap:
        case Gap.PISTON:
            return piston_revolution(rotor, parts, driven.piston, options, report=report)
        case Gap.SLIPPER:
            return slipper_revolution(rotor, parts, driven.slipper, options, report=report)
        case Gap.VALVE_PLATE:
            return block_revolution(rotor, parts, driven.block, options, report=report)


def tilt(study: RevolutionStudy) -> Array:
    """Return the angle (n,) rad between the axes of piston and bore, or between the two faces."""
    q = study.revolution.positions
    if study.case.gap is Gap.PISTON:
        return np.asarray(np.hypot(*(q[:, 2:] - q[:, :2]).T) / study.parts.piston.guide_length)
    return np.asarray(np.hypot(q[:, 1], q[:, 2]) / _radius(study))


def revolution_course(study: RevolutionStudy) -> dict[str, list[float]]:
    """Return the series over the shaft angle that a study compares, the unit in each key."""
    instants = study.revolution.turn.instants
    return {
        "shaft_angle_deg": [float(np.degrees(instant.angle)) for instant in instants],
        "film_thickness_min_m": [instant.film_thickness_min for instant in instants],
        "film_thickness_mean_m": [instant.mean_film for instant in instants],
        "tilt_rad": tilt(study).tolist(),
        "leakage_flow_m3_per_s": [instant.report.leakage for instant in instants],
        "friction_power_W": [friction_power(study, instant.report) for instant in instants],
        "contact_load_N": [instant.report.contact_load for instant in instants],
    }


def _radius(study: RevolutionStudy) -> float:
    """Return the radius (m) at which the rises of slipper or block are measured."""
    if study.case.gap is Gap.SLIPPER:
        return slipper_shape(study.case.rotor, study.parts).outer_radius
    return valve_plate_geometry(study.case.rotor.pump).land_radii[3]


def friction_power(study: RevolutionStudy, gap: GapReport) -> float:
    """Return the power (W) of viscous friction and contact friction."""
    match gap:
        case PistonReport() | SlipperReport():
            return gap.friction.power
        case BlockReport():
            return gap.torque * study.case.rotor.point.shaft_speed
    raise AssertionError(gap)


def revolution_summary(study: RevolutionStudy) -> dict[str, Any]:
    """Return headline numbers in SI, the unit in the key, checks of the solver, and assumptions.

    Means of flows, power and contact are over all steps of the turn, other numbers over the reported angles.
    """
    turn, closing = study.revolution.turn, study.revolution.closing
    reports, passed = zip(*((instant.report, instant.passed) for instant in turn.instants), strict=True)
    least = study.revolution.least_film
    contact = np.array([one.contact_load for one in reports])
    balance = mass_balance_error(study.revolution)
    physics = study.case.options.physics
    tilts, friction = tilt(study), np.array([friction_power(study, one) for one in reports])
    power = float(np.mean([friction_power(study, one) for one in passed]))
    return {
        **headed("film_revolution"),
        "name": study.case.name,
        "gap": study.case.gap.value,
        "film_thickness_min_m": least.film_thickness_min,
        "film_thickness_min_at_deg": float(np.degrees(least.angle)),
        "film_thickness_mean_m": float(np.mean([instant.mean_film for instant in turn.instants])),
        "film_thickness_mean_min_m": min(instant.mean_film for instant in turn.instants),
        "least_gap_m": min(instant.least_gap for instant in turn.instants),
        "tilt_max_rad": float(tilts.max()),
        "leakage_flow_m3_per_s": float(np.mean([one.leakage for one in passed])),
        "leakage_flow_max_m3_per_s": max(one.leakage for one in reports),
        "friction_power_W": power,
        "friction_power_max_W": float(friction.max()),
        "rubbing_power_W": float(np.mean([one.heat.rubbing for one in passed])),
        "contact_load_max_N": float(contact.max()),
        "contact_load_mean_N": float(np.mean([one.contact_load for one in passed])),
        "share_of_turn": {kind.value: float(np.mean([kind in one.active for one in reports])) for kind in Active},
        "cavitated_area_fraction_max": max(instant.cavitated_area_fraction for instant in turn.instants),
        "pressure_max_Pa": max(instant.pressure_max for instant in turn.instants),
        "span_deg": float(np.degrees(study.span)),
        "turns": closing.turns,
        "turn_change_m": closing.changes[-1],
        "largest_multiplier": closing.largest_multiplier,
        "step_error": turn.step_error,
        "steps": len(turn.times),
        "films_solved": study.revolution.films_solved,
        "dofs": next(iter(turn.films.values())).problem.space.size,
        "mass_balance_error": balance,
        "solve_seconds": study.solve_seconds,
        "physics_left_out": [effect.value for effect in physics.left_out],
        "physics_seconds": {leg.value: time for leg, time in study.revolution.spent.items()},
        **_warmth(study.revolution.warmth),
        "assumptions": [*study.assumed, *map(str, all_taken(study.case.rotor, study.parts, physics))],
        "warnings": revolution_warnings(study.case, study.parts, study.revolution, balance, power),
    }


def _warmth(warmth: GapTemperatures | None) -> dict[str, Any]:
    """Return temperatures and heat of a gap with solved temperature, means over the turn."""
    if warmth is None:
        return {}
    flows = warmth.flows
    return {
        "film_temperature_mean_K": float(warmth.mean.mean()),
        "film_temperature_max_K": float(warmth.hottest.max()),
        "fixed_wall_temperature_K": float(warmth.walls[0]),
        "moving_wall_temperature_K": float(warmth.walls[1]),
        "heat_dissipation_W": flows.dissipation,
        "heat_to_fixed_wall_W": flows.to_fixed,
        "heat_to_moving_wall_W": flows.to_moving,
        "heat_carried_out_W": flows.convected_out,
        "heat_stored_W": flows.stored,
        "heat_balance_error": flows.balance_error,
        "warming_rounds": warmth.rounds,
        "warming_change": warmth.change,
    }
