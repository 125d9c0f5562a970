"""Numbers and fields of a film due to temperature, elastic walls, roughness and time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from reynolds.laws.contact import contact_area, lambda_ratio
from reynolds.laws.roughness import beyond_range
from reynolds.solve.rubbing import rubbing
from swashfilm.case.tables.film import Geometry
from swashfilm.output.data.files import column_of, write_columns
from swashfilm.runs.film.solve.transient import Moment

if TYPE_CHECKING:
    from swashfilm.runs.film.solve.study import FilmStudy


def physics_summary(study: FilmStudy) -> dict[str, Any]:
    """Return the numbers of a summary for the physics of the case, SI, the unit in the key."""
    found: dict[str, Any] = {}
    if study.heat:
        found |= _heat_summary(study)
    if study.solution.problem.walls is not None:
        found["deformation_max_m"] = float(study.solution.deformation.max())
    if study.solution.problem.surface is not None:
        found |= _rough_summary(study)
    if study.history:
        steps = study.history
        found |= {
            "time_s": steps[-1].time,
            "time_steps": len(steps),
            "load_of_time_max_N": max(step.supported for step in steps),
            "load_of_time_min_N": min(step.supported for step in steps),
            "pressure_of_time_max_Pa": max(step.loads.pressure_max for step in steps),
            "film_thickness_of_time_min_m": min(step.loads.film_thickness_min for step in steps),
            "mass_balance_error_of_time": max(step.loads.mass_balance_error for step in steps),
        }
        if study.heat:
            found["temperature_of_time_max_K"] = max(_hottest(steps))
    return found


def _hottest(history: Sequence[Moment]) -> list[float]:
    """Return the highest temperature (K) of a warm film at each step."""
    found = []
    for step in history:
        assert step.temperature_max is not None
        found.append(step.temperature_max)
    return found


def _heat_summary(study: FilmStudy) -> dict[str, Any]:
    heat, space = study.heat, study.solution.problem.space
    assert heat is not None
    highest = heat.highest
    hottest = int(np.argmax(highest[space.vertex_dofs]))
    return {
        "temperature_max_K": float(highest.max()),
        "temperature_max_at_m": [float(part) for part in space.vertices[hottest]],
        "temperature_mean_K": float(np.average(heat.mean, weights=space.lumped(np.ones(space.area.shape)))),
        "wall_heat_W": {"fixed": heat.to_fixed, "moving": heat.to_moving},
        "oil_heat_W": heat.convected_out,
        "heat_balance_error": heat.energy_balance_error,
    }


def _rough_summary(study: FilmStudy) -> dict[str, Any]:
    """Return least lambda ratio, contact load (N) and friction (N) of the asperities."""
    problem, film = study.solution.problem, study.solution.film
    assert problem.surface is not None
    ratio = lambda_ratio(study.loads.film_thickness_min, problem.surface.composite_roughness)
    found: dict[str, Any] = {
        "lambda_ratio_min": float(ratio),
        "beyond_flow_factors_area_fraction": beyond_range(film.thickness, problem.surface).fraction,
    }
    if problem.asperities is not None:
        area, gap = problem.space.area, study.solution.gap
        contact = rubbing(film, problem.asperities, gap, area.shape)
        found["contact_load_N"] = study.loads.contact_load
        both = study.loads.contact_load + study.loads.load
        if study.geometry is not Geometry.CYLINDER:
            found["carried_load_N"] = both
        found["contact_load_fraction"] = study.loads.contact_load / both if both > 0.0 else None
        found["contact_pressure_max_Pa"] = float(np.max(contact.pressure))
        found["contact_friction_N"] = float(np.sum(contact.friction * area))
        found["contact_area_fraction"] = float(np.sum(contact_area(problem.asperities, gap).value * area) / area.sum())
    return found


def history_columns(history: Sequence[Moment]) -> dict[str, list[float]]:
    """Return headline numbers of every step of a transient, by key; `time_s` first."""
    columns = {"time_s": [step.time for step in history]}
    if not history[0].bearing:  # of a film unrolled from a cylinder the integral is no force
        columns["load_N"] = [step.loads.load for step in history]
    for key, of in (
        ("pressure_max_Pa", lambda loads: loads.pressure_max),
        ("film_thickness_min_m", lambda loads: loads.film_thickness_min),
        ("cavitated_area_fraction", lambda loads: loads.cavitated_area_fraction),
        ("friction_force_moving_N.x", lambda loads: loads.friction_moving[0]),
        ("friction_force_moving_N.y", lambda loads: loads.friction_moving[1]),
        ("dissipation_W", lambda loads: loads.dissipation),
        ("mass_balance_error", lambda loads: loads.mass_balance_error),
    ):
        columns[key] = [of(step.loads) for step in history]
    columns["friction_torque_moving_Nm"] = [step.friction_torque for step in history]
    bearings = [step.bearing for step in history if step.bearing]
    if bearings:
        columns["bearing_load_N"] = [one.size for one in bearings]
        columns["attitude_angle_deg"] = [math.degrees(one.attitude) for one in bearings]
    if history[0].temperature_max is not None:
        columns["temperature_max_K"] = _hottest(history)
    for name in history[0].loads.flow:
        columns[f"flow_m3_per_s.{name}"] = [step.loads.flow[name] for step in history]
    return columns


def write_history(path: Path, history: Sequence[Moment]) -> None:
    """Write a CSV with one line per step: time and headline numbers, units in the heads."""
    write_columns(path, [column_of(key, values) for key, values in history_columns(history).items()])


def temperatures(study: FilmStudy) -> dict[str, tuple[np.ndarray, str]]:
    """Return the temperatures at the vertices with their units, none for a film without heat."""
    if not study.heat:
        return {}
    at, heat = study.solution.problem.space.vertex_dofs, study.heat
    return {
        "temperature": (heat.mean[at], "K"),
        "temperature_fixed_wall": (heat.fixed_wall[at], "K"),
        "temperature_moving_wall": (heat.moving_wall[at], "K"),
    }
