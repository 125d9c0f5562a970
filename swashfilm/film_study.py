"""One film study: a case solved, its summary, its warnings and its fields."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gaps.result import GapFilm
from reynolds.energy import FilmTemperature
from reynolds.film import Cavitation, FilmSolution, vertex_thickness
from reynolds.loads import Loads, loads, point_fields
from reynolds.solve import FilmSolver
from swashfilm.film_case import FilmCase
from swashfilm.film_physics import physics_summary, vertex_fields
from swashfilm.film_thermal import solve_with_temperature
from swashfilm.film_transient import Instant, transient
from swashfilm.gap_case import GapCase
from swashfilm.gap_study import gap_summary, gap_warnings, solve_gap
from swashfilm.progress import Report

if TYPE_CHECKING:
    import xarray

LARGEST_CAVITY_FLOW = 0.01  # of the throughput; Reynolds' condition makes or swallows oil in a cavity
LARGEST_THICKNESS_RATIO = 0.05  # of the film's extent; beyond, flow across the film counts


@dataclass(frozen=True)
class FilmStudy:
    """A solved case: its solution and integrals, and the seconds it took; None what the case has not.

    gap: the pump's gap that it is of; heat: its temperature; history: the steps of a transient, whose end
    `solution` is.
    """

    name: str
    solution: FilmSolution
    loads: Loads
    gap: GapFilm | None
    solve_seconds: float
    heat: FilmTemperature | None = None
    history: tuple[Instant, ...] = ()


def silent(done: int, steps: int, what: str) -> None:
    """A report that tells nobody."""


def solve_case(case: FilmCase | GapCase, report: Report = silent) -> FilmStudy:
    """Solve a case; raises FilmNotConverged rather than give a number that is none.

    `report` hears of the steps of a transient.
    """
    began = time.perf_counter()
    if isinstance(case, GapCase):
        film = solve_gap(case)
        return FilmStudy(case.name, film.solution, film.loads, film, time.perf_counter() - began)
    heat: FilmTemperature | None = None
    history: tuple[Instant, ...] = ()
    if case.stated.time:
        history = tuple(transient(case.stated, report))
        last = history[-1].solution
        assert last is not None
        solution = last
    elif case.stated.thermal:
        found = solve_with_temperature(case.stated, case.problem)
        solution, heat = found.film, found.heat
    else:
        solution = FilmSolver(case.problem.space).solve(case.problem)
    seconds = time.perf_counter() - began
    return FilmStudy(case.name, solution, loads(solution), None, seconds, heat, history)


def film_summary(study: FilmStudy) -> dict[str, Any]:
    """Every headline number of a film in SI, the unit in the key, and the solver's own checks.

    Forces and moments as `reynolds.loads.Loads` has them; leakage_flow is all that leaves the film.
    """
    solution, integrals = study.solution, study.loads
    return {
        "format": 1,
        "kind": "film",
        "name": study.name,
        "load_N": integrals.load,
        "moment_x_Nm": integrals.moment_x,
        "moment_y_Nm": integrals.moment_y,
        "pressure_max_Pa": integrals.pressure_max,
        "pressure_max_at_m": list(integrals.pressure_max_at),
        "film_thickness_min_m": integrals.film_thickness_min,
        "flow_m3_per_s": dict(integrals.flow),
        "leakage_flow_m3_per_s": sum(max(flow, 0.0) for flow in integrals.flow.values()),
        "friction_force_moving_N": list(integrals.friction_moving),
        "friction_force_fixed_N": list(integrals.friction_fixed),
        "friction_torque_moving_Nm": integrals.friction_torque_moving,
        "dissipation_W": integrals.dissipation,
        **_stribeck(solution, integrals),
        "cavitated_area_fraction": integrals.cavitated_area_fraction,
        "film_fraction_min": float(solution.film_fraction.min()),
        "cavity_flow_m3_per_s": integrals.cavity_flow + 0.0,  # no negative zero
        "mass_balance_error": integrals.mass_balance_error,
        "energy_balance_error": integrals.energy_balance_error,
        "imbalance": solution.imbalance,
        "dofs": solution.problem.space.size,
        "iterations": solution.iterations,
        "solve_seconds": study.solve_seconds,
        **physics_summary(study),
        **(gap_summary(study.gap) if study.gap else {}),
        "warnings": film_warnings(study),
    }


def _stribeck(solution: FilmSolution, integrals: Loads) -> dict[str, float | None]:
    """Friction coefficient and Hersey number mu U/p_mean (m); none where nothing slides or no load is carried.

    The friction is the walls' power over their mean sliding speed, so that it is one of turning films too; mu and
    U are means over the film, p_mean is the load over its area.
    """
    film, area = solution.film, solution.problem.space.area
    fields = point_fields(solution)
    (u1, v1), (u2, v2) = film.velocity_moving, film.velocity_fixed
    total = float(area.sum())
    speed = float(np.sum(np.hypot(u1 - u2, v1 - v2) * area)) / total
    if speed == 0.0 or not integrals.load > 0.0:
        return {"friction_coefficient": None, "hersey_number_m": None}
    power = sum(
        float(np.sum(shear * velocity * area))
        for shear, velocity in zip((*fields.shear_moving, *fields.shear_fixed), (u1, v1, u2, v2), strict=True)
    )
    viscosity = float(np.sum(film.viscosity * area)) / total
    return {
        "friction_coefficient": abs(power) / (speed * integrals.load),
        "hersey_number_m": viscosity * speed * total / integrals.load,
    }


def film_warnings(study: FilmStudy) -> list[dict[str, str]]:
    """What to doubt about a film that was solved: name and text of each warning."""
    problem, integrals = study.solution.problem, study.loads
    found = [] if study.gap is None else gap_warnings(study.gap)
    through = integrals.throughput
    share = abs(integrals.cavity_flow) / through if through > 0.0 else np.inf * abs(integrals.cavity_flow)
    if integrals.cavity_flow != 0.0 and share > LARGEST_CAVITY_FLOW:
        verb = "makes" if integrals.cavity_flow > 0.0 else "swallows"
        found.append(
            {
                "name": "cavity_does_not_conserve_mass",
                "text": f"Reynolds' condition {verb} oil in the cavity, {share:.2%} of the throughput "
                f"(limit {LARGEST_CAVITY_FLOW:.0%}): what enters is not what leaves",
            }
        )
    thick = _thickness_ratio(study.solution)
    if thick > LARGEST_THICKNESS_RATIO:
        found.append(
            {
                "name": "film_not_thin",
                "text": f"the mean film is {thick:.2g} of the film's extent (limit {LARGEST_THICKNESS_RATIO:.2g} "
                "for Reynolds' equation): millimetres for micrometres, or a mesh not in metres?",
            }
        )
    lowest = float(study.solution.pressure.min())
    if problem.cavitation is Cavitation.NONE and lowest < problem.cavitation_pressure:
        found.append(
            {
                "name": "pressure_below_cavitation",
                "text": f"the film is pulled down to {lowest:.4g} Pa, below its cavitation pressure "
                f"{problem.cavitation_pressure:.4g} Pa: oil would cavitate; choose cavitation = 'reynolds'",
            }
        )
    return found


def _thickness_ratio(solution: FilmSolution) -> float:
    """Mean film thickness over the root of the film's area."""
    area = solution.problem.space.area
    total = float(area.sum())
    return float(np.sum(solution.film.thickness * area)) / total**1.5


def film_dataset(study: FilmStudy) -> xarray.Dataset:
    """Fields over vertices and cells with their units; `cells` (cell, corner) are numbers of vertices from 0."""
    import xarray

    space = study.solution.problem.space
    thickness = np.broadcast_to(study.solution.film.thickness, space.area.shape)
    cell_area = space.area.sum(axis=1)
    shear = point_fields(study.solution).shear_moving

    def mean(field: np.ndarray) -> np.ndarray:
        return (np.broadcast_to(field, space.area.shape) * space.area).sum(axis=1) / cell_area

    pressure = study.solution.pressure[space.vertex_dofs]
    return xarray.Dataset(
        {
            "film_pressure": ("vertex", pressure, {"units": "Pa"}),
            "film_thickness": ("vertex", vertex_thickness(study.solution), {"units": "m"}),
            **{name: ("vertex", values, {"units": unit}) for name, (values, unit) in vertex_fields(study).items()},
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
