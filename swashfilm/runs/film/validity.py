"""What to doubt about a film that was solved: number, limit and remedy of each warning."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reynolds.laws.contact import boundary_shear, contact_pressure, lambda_ratio
from reynolds.laws.fluid import isoviscous
from reynolds.laws.roughness import beyond_range
from reynolds.problem import Cavitation, FilmProblem, FilmSolution
from reynolds.solve.loads import dissipated
from swashfilm.runs.film.solve.gap import gap_warnings

if TYPE_CHECKING:
    from swashfilm.runs.film.solve.study import FilmStudy

LARGEST_CAVITY_FLOW = 0.01  # of the throughput; Reynolds' condition makes or swallows oil in a cavity
LARGEST_THICKNESS_RATIO = 0.05  # of the film's extent; beyond, flow across the film counts
FEW_UNKNOWNS = 8
LARGEST_FALL = 2.0  # times, of the film within a cell
MOST_BYTES = 200e6  # of the fields of a transient in results.nc
MOST_FIELDS = 11  # at vertices and in cells
LARGEST_RISE = 10.0  # K; an oil is a quarter to a third thinner there
HOTTEST = 393.15  # K (120 degC), from which mineral oils age within hours
HEAT_CAPACITY = 1.7e6  # J/(m3 K), of mineral oils
CONDUCTIVITY = 0.13  # W/(m K), of mineral oils
LEAST_FILM_FRACTION = 1e-3
VACUUM = -101325.0  # Pa, gauge
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
                f"{problem.cavitation_pressure:.4g} Pa: oil would cavitate; choose cavitation = 'jfo'",
            }
        )
    return (
        found
        + _mesh_warnings(study.solution)
        + _rough_warnings(study)
        + _pressure_warnings(study)
        + _supply_warnings(study)
        + _heat_warnings(study)
        + _size_warnings(study)
    )


def _mesh_warnings(solution: FilmSolution) -> list[dict[str, str]]:
    """A mesh on which hardly any pressure is solved for, or that does not see how the film runs."""
    few, thickness = int(np.count_nonzero(~solution.held)), solution.film.thickness
    fall = float(np.max(thickness.max(axis=1) / thickness.min(axis=1)))
    told = []
    if few < FEW_UNKNOWNS:
        told.append(f"pressure is solved for at {few} points alone (fewer than {FEW_UNKNOWNS})")
    if fall > LARGEST_FALL:
        told.append(f"the film changes {fall:.3g} times within a cell (limit {LARGEST_FALL:g})")
    if not told:
        return []
    return [{"name": "coarse_mesh", "text": f"{', '.join(told)}: --refine 3 tells how far off that is"}]


def _heat_warnings(study: FilmStudy) -> list[dict[str, str]]:
    """A film at one temperature that its own heat would warm, and one too hot for oil."""
    if study.heat is not None:
        hottest = float(study.heat.temperature.max())
        text = (
            f"the film reaches {hottest - 273.15:.0f} degC (limit {HOTTEST - 273.15:.0f} degC for mineral oils, "
            "which age quickly beyond): more oil through the film, a thicker film, or walls that take more heat"
        )
        return [{"name": "film_hot", "text": text}] if hottest > HOTTEST else []
    if study.gap or study.history or (rise := _least_rise(study)) <= LARGEST_RISE:
        return []
    text = (
        f"the film's heat warms it by some {rise:.3g} K even between walls that stay cold (limit "
        f"{LARGEST_RISE:g} K for one temperature): the oil is much thinner there; a table [thermal]"
    )
    return [{"name": "temperature_not_solved", "text": text}]


def _least_rise(study: FilmStudy) -> float:
    """Mean rise (K) of the film's oil by its heat, where both the flow and walls that stay cold carry it away.

    The flow alone: heat/(rho c Q); the walls alone: heat per area x h/(12 k), that of a parabola across the film.
    """
    solution = study.solution
    area, film = solution.problem.space.area, solution.film
    driven, sliding = dissipated(solution)
    heat = float(np.sum(driven + sliding)) - _rubbing(solution)
    mean = float(np.sum(film.thickness * area)) / float(area.sum())
    by_flow = HEAT_CAPACITY * study.loads.throughput
    by_walls = 12.0 * CONDUCTIVITY * float(area.sum()) / mean
    return heat / (by_flow + by_walls)


def _rubbing(solution: FilmSolution) -> float:
    """Heat of the contacts, W, which goes into the walls."""
    asperities, film = solution.problem.asperities, solution.film
    if asperities is None:
        return 0.0
    (u1, v1), (u2, v2) = film.velocity_moving, film.velocity_fixed
    sheared = boundary_shear(asperities, contact_pressure(asperities, film.thickness).value).value
    return float(np.sum(sheared * np.hypot(u1 - u2, v1 - v2) * solution.problem.space.area))


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


def _rough_warnings(study: FilmStudy) -> list[dict[str, str]]:
    solution, surface = study.solution, study.solution.problem.surface
    if surface is None:
        return []
    found = []
    least = float(lambda_ratio(solution.film.thickness.min(), surface.composite_roughness))
    if least < LEAST_LAMBDA:
        found.append(
            {
                "name": "boundary_lubrication",
                "text": f"the least lambda ratio h/sigma is {least:.3g} (limit {LEAST_LAMBDA:g}): contacts carry "
                f"most of the load there, and the film equation is at its end{_boundary_remedy(study)}",
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


def _boundary_remedy(study: FilmStudy) -> str:
    """What to do about contacts that carry: a free film may know none, those of a pump's gap bear already."""
    if study.gap:
        return (
            f"; the asperities bear {study.gap.film.contact_load:.4g} N in all: a thicker oil, less load, or "
            "smoother walls (composite_roughness in [pump.surfaces.PAIR])"
        )
    return "" if study.solution.problem.asperities else "; a table [contact] tells what the asperities bear"


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


def _supply_warnings(study: FilmStudy) -> list[dict[str, str]]:
    """A film that no oil reaches, and a cavity emptier than vacuum."""
    found = []
    problem, fraction = study.solution.problem, study.solution.film_fraction
    if study.gap is None and not study.history and float(fraction.min()) < LEAST_FILM_FRACTION:
        found.append(
            {
                "name": "film_runs_dry",
                "text": f"the film fraction falls to {float(fraction.min()):.2g} (limit {LEAST_FILM_FRACTION:g}): "
                "no oil comes to a part of the film; is the edge closed through which it enters? A boundary that "
                "is not named is",
            }
        )
    if problem.cavitation is not Cavitation.NONE and problem.cavitation_pressure < VACUUM:
        found.append(
            {
                "name": "cavitation_below_vacuum",
                "text": f"the cavitation pressure is {problem.cavitation_pressure * 1e-5:.4g} bar gauge (vacuum: "
                f"{VACUUM * 1e-5:.4g} bar): oil that is pulled so hard cavitates before; absolute for gauge?",
            }
        )
    return found


def _isoviscous(study: FilmStudy) -> bool:
    problem: FilmProblem = study.solution.problem
    return study.heat is None and problem.fluid.viscosity is isoviscous


def _thickness_ratio(solution: FilmSolution) -> float:
    """Mean film thickness over the root of the film's area."""
    area = solution.problem.space.area
    total = float(area.sum())
    return float(np.sum(solution.film.thickness * area)) / total**1.5
