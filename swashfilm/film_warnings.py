"""What to doubt about a film that was solved: number, limit and remedy of each warning."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reynolds.contact import lambda_ratio
from reynolds.film import Cavitation, FilmProblem, FilmSolution
from reynolds.fluid import isoviscous
from reynolds.roughness import beyond_range
from swashfilm.gap_study import gap_warnings

if TYPE_CHECKING:
    from swashfilm.film_study import FilmStudy

LARGEST_CAVITY_FLOW = 0.01  # of the throughput; Reynolds' condition makes or swallows oil in a cavity
LARGEST_THICKNESS_RATIO = 0.05  # of the film's extent; beyond, flow across the film counts
MOST_BYTES = 200e6  # of the fields of a transient in results.nc
MOST_FIELDS = 11  # at vertices and in cells
LEAST_LAMBDA = 1.0  # h/sigma; below, contacts carry most of the load
LARGEST_ISOVISCOUS_PRESSURE = 50e6  # Pa; a mineral oil is some three times as thick there


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
    return found + _rough_warnings(study.solution) + _pressure_warnings(study) + _size_warnings(study)


def thinned_by(study: FilmStudy) -> int:
    """Every how many of the films of a transient are in results.nc, so that it stays below MOST_BYTES."""
    films = sum(moment.solution is not None for moment in study.history)
    size = films * MOST_FIELDS * 8.0 * len(study.solution.problem.space.vertices)
    return max(1, int(np.ceil(size / MOST_BYTES)))


def _size_warnings(study: FilmStudy) -> list[dict[str, str]]:
    every = thinned_by(study)
    if every == 1:
        return []
    text = (
        f"results.nc holds one of every {every} films written, to stay below {MOST_BYTES * 1e-6:g} MB: all of "
        "them are in film_NNNN.vtu; fewer outputs or a coarser mesh keep them all"
    )
    return [{"name": "results_thinned", "text": text}]


def _rough_warnings(solution: FilmSolution) -> list[dict[str, str]]:
    surface = solution.problem.surface
    if surface is None:
        return []
    found = []
    least = float(lambda_ratio(solution.film.thickness.min(), surface.composite_roughness))
    if least < LEAST_LAMBDA:
        remedy = "" if solution.problem.asperities else "; a table [contact] tells what the asperities bear"
        found.append(
            {
                "name": "boundary_lubrication",
                "text": f"the least lambda ratio h/sigma is {least:.3g} (limit {LEAST_LAMBDA:g}): contacts carry "
                f"most of the load there, and the film equation is at its end{remedy}",
            }
        )
    beyond = beyond_range(solution.film.thickness, surface)
    if beyond.fraction > 0.0:
        found.append(
            {
                "name": "flow_factors_out_of_range",
                "text": f"h/sigma is {beyond.lowest_ratio:.3g} at the least, below the {beyond.limit:g} down to "
                f"which Patir and Cheng's flow factors are published, on {beyond.fraction:.1%} of the film: "
                "they are continued there; a thicker film or smoother walls",
            }
        )
    return found


def _pressure_warnings(study: FilmStudy) -> list[dict[str, str]]:
    """Isoviscous films of high pressure; gaps of pumps have a warning of their own."""
    highest = study.loads.pressure_max
    if study.gap or highest <= LARGEST_ISOVISCOUS_PRESSURE or not _isoviscous(study):
        return []
    return [
        {
            "name": "viscosity_without_pressure",
            "text": f"the film reaches {highest * 1e-6:.3g} MPa (limit {LARGEST_ISOVISCOUS_PRESSURE * 1e-6:g} "
            "MPa for a constant viscosity): oil is several times as thick there; pressure_law in [oil], and walls "
            "that give way, [elastic]",
        }
    ]


def _isoviscous(study: FilmStudy) -> bool:
    problem: FilmProblem = study.solution.problem
    return study.heat is None and problem.fluid.viscosity is isoviscous


def _thickness_ratio(solution: FilmSolution) -> float:
    """Mean film thickness over the root of the film's area."""
    area = solution.problem.space.area
    total = float(area.sum())
    return float(np.sum(solution.film.thickness * area)) / total**1.5
