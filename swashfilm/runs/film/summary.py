"""Summary and fields of a solved film study."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from reynolds.problem import FilmSolution
from reynolds.solve.bearing import bearing_load, radius_around
from reynolds.solve.export import vertex_fields
from reynolds.solve.loads import Loads, point_fields
from swashfilm.case.tables.film import Geometry
from swashfilm.formats.versions import headed
from swashfilm.runs.film.checks.scale import natural_sizes
from swashfilm.runs.film.checks.validity import film_warnings
from swashfilm.runs.film.physics import physics_summary, temperatures
from swashfilm.runs.film.sensitivity import sensitivity_fields, sensitivity_summary
from swashfilm.runs.film.solve.gap import gap_summary
from swashfilm.runs.film.solve.loaded import load_summary
from swashfilm.runs.film.solve.study import FilmStudy
from swashfilm.runs.film.solve.torque import friction_torque

if TYPE_CHECKING:
    import xarray

_SCALE_UNITS = {"moment": "Nm", "friction": "N", "torque": "Nm", "flow": "m3_per_s"}
LARGEST_COEFFICIENT = 1e6  # of friction; beyond, the load is round-off of the solver, as for a parallel film


def film_summary(study: FilmStudy) -> dict[str, Any]:
    """Return headline numbers of a film in SI, the unit in the key, and checks of the solver.

    Forces and moments as in `reynolds.solve.loads.Loads`, around a cylinder load and torque of its axis;
    leakage_flow is the total flow out of the film.
    """
    solution, integrals = study.solution, study.loads
    around = study.geometry is Geometry.CYLINDER
    bearing = _bearing(solution) if around else {}
    return {
        **headed("film"),
        "name": study.name,
        **({} if around else _plane_loads(integrals)),
        "pressure_max_Pa": integrals.pressure_max,
        "pressure_max_at_m": list(integrals.pressure_max_at),
        "film_thickness_min_m": integrals.film_thickness_min,
        "flow_m3_per_s": dict(integrals.flow),
        "leakage_flow_m3_per_s": sum(max(flow, 0.0) for flow in integrals.flow.values()),
        "friction_force_moving_N": list(integrals.friction_moving),
        "friction_force_fixed_N": list(integrals.friction_fixed),
        "friction_torque_moving_Nm": friction_torque(solution, integrals, study.geometry),
        "dissipation_W": integrals.dissipation,
        **bearing,
        **_stribeck(study, bearing),
        "cavitated_area_fraction": integrals.cavitated_area_fraction,
        "film_fraction_min": float(solution.film_fraction.min()),
        "cavity_flow_m3_per_s": integrals.cavity_flow + 0.0,  # no negative zero
        "mass_balance_error": integrals.mass_balance_error,
        "energy_balance_error": integrals.energy_balance_error,
        "imbalance": solution.imbalance,
        "dofs": solution.problem.space.size,
        "iterations": solution.iterations,
        "solve_seconds": study.solve_seconds,
        **(load_summary(study.loaded) if study.loaded else {}),
        **physics_summary(study),
        **(gap_summary(study.gap) if study.gap else {}),
        "scale": {f"{name}_{_SCALE_UNITS[name]}": size for name, size in natural_sizes(solution).items()},
        **sensitivity_summary(study),
        "warnings": film_warnings(study),
    }


def _plane_loads(integrals: Loads) -> dict[str, float]:
    """Return the load of a plane film, which of one unrolled from a cylinder is no force."""
    return {
        "load_N": integrals.load,
        "moment_x_Nm": integrals.moment_x,
        "moment_y_Nm": integrals.moment_y + 0.0,  # no negative zero
    }


def _bearing(solution: FilmSolution) -> dict[str, float]:
    load = bearing_load(solution)
    return {
        "bearing_load_N": load.size,
        "attitude_angle_deg": float(np.degrees(load.attitude)),
        "cylinder_radius_m": radius_around(solution.problem.space),
    }


def _stribeck(study: FilmStudy, bearing: Mapping[str, float]) -> dict[str, float | None]:
    """Return friction coefficient and Hersey number mu U/p_mean (m); none without sliding or load.

    The friction force is the power of the walls over their mean sliding speed, also for rotating films; mu and U
    are means over the part of the film whose walls slide (no port under a web), p_mean is the supported load over its
    area.
    """
    solution, supported = study.solution, _supported(study, bearing)
    film = solution.film
    (u1, v1), (u2, v2) = film.velocity_moving, film.velocity_fixed
    sliding = np.hypot(u1 - u2, v1 - v2)
    area = solution.problem.space.area * (sliding > 0.0)
    total = float(area.sum())
    if total == 0.0 or not supported > 0.0:
        return {"friction_coefficient": None, "hersey_number_m": None}
    speed = float(np.sum(sliding * area)) / total
    power = abs(_wall_power(solution) if study.gap is None else study.gap.film.friction_power)
    if power > LARGEST_COEFFICIENT * speed * supported:
        return {"friction_coefficient": None, "hersey_number_m": None}
    viscosity = float(np.sum(film.viscosity * area)) / total
    return {
        "friction_coefficient": power / (speed * supported),
        "hersey_number_m": viscosity * speed * total / supported,
    }


def _supported(study: FilmStudy, bearing: Mapping[str, float]) -> float:
    """Return the load (N) on film and contact: of a gap with its pockets, of a cylinder the vector."""
    if study.gap is not None:
        return study.gap.film.carried_load
    return bearing.get("bearing_load_N", study.loads.load + study.loads.contact_load)


def _wall_power(solution: FilmSolution) -> float:
    """Return the power (W) of the film on its walls, negative where they drive it."""
    film, fields = solution.film, point_fields(solution)
    return sum(
        float(np.sum(shear * velocity * solution.problem.space.area))
        for shear, velocity in zip(
            (*fields.shear_moving, *fields.shear_fixed), (*film.velocity_moving, *film.velocity_fixed), strict=True
        )
    )


def film_dataset(study: FilmStudy) -> xarray.Dataset:
    """Return fields over vertices and cells with their units; `cells` (cell, corner): vertex numbers from 0."""
    import xarray

    space = study.solution.problem.space
    thickness = np.broadcast_to(study.solution.film.thickness, space.area.shape)
    cell_area = space.area.sum(axis=1)
    shear = point_fields(study.solution).shear_moving

    def mean(field: np.ndarray) -> np.ndarray:
        return (np.broadcast_to(field, space.area.shape) * space.area).sum(axis=1) / cell_area

    at_vertices = vertex_fields(study.solution) | temperatures(study) | sensitivity_fields(study)
    return xarray.Dataset(
        {
            **{name: ("vertex", values, {"units": unit}) for name, (values, unit) in at_vertices.items()},
            "film_thickness_cell": ("cell", mean(thickness), {"units": "m"}),
            "wall_shear_x": ("cell", mean(shear[0]), {"units": "Pa", "wall": "moving"}),
            "wall_shear_y": ("cell", mean(shear[1]), {"units": "Pa", "wall": "moving"}),
            "cells": (("cell", "corner"), space.cells),
        },
        coords={
            "x": ("vertex", space.vertices[:, 0], {"units": "m"}),
            "y": ("vertex", space.vertices[:, 1], {"units": "m"}),
        },
        attrs={"name": study.name, "kind": "film"},
    )
