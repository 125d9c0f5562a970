"""Convergence of a film: the same case on meshes, and with time steps, each twice finer; the limits of its numbers."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from reynolds.bodies.foundation import half_space_memory, too_large
from reynolds.bodies.memory import physical_memory
from reynolds.numerics.convergence import convergence
from swashfilm.case.fields.mesh import MOST_CELLS
from swashfilm.case.file import FilmCase
from swashfilm.case.gap.instant import GapCase
from swashfilm.case.tables.time_steps import MOST_STEPS
from swashfilm.output.headline import headline_numbers, sizes
from swashfilm.output.refinement import Refinement
from swashfilm.runs.film.checks.scale import natural_sizes
from swashfilm.runs.film.solve.study import FilmStudy, solve_case
from swashfilm.runs.film.summary import film_summary
from system.inputs.faults import Fault, InputFaults
from system.work.progress import Report, Stage

CHECKS = ("time_steps", "mass_balance_error_of_time", "heat_balance_error", "cylinder_radius_m")
"""Numbers without a limit: a count, round-off, and a size of the mesh."""


def check_refinement(case: FilmCase | GapCase, meshes: int) -> None:
    """Raise InputFaults where the finest mesh has too many cells, or the last transient too many steps."""
    if isinstance(case, GapCase):
        return  # small enough for every number of meshes of the command line
    faults, time = [], case.stated.time
    cells = case.problem.space.area.shape[0] * 4 ** (meshes - 1)
    if cells > MOST_CELLS:
        faults.append(Fault("--refine", f"{meshes} meshes, the finest of {cells} cells", f"at most {MOST_CELLS} cells"))
    if time and (steps := time.steps * 2 ** (meshes - 1)) > MOST_STEPS:
        found = f"{meshes} meshes, the steps halved with each: {steps} steps"
        faults.append(Fault("--refine", found, f"at most {MOST_STEPS} steps"))
    faults += _memory_faults(case, meshes)
    if faults:
        raise InputFaults("command line", faults)


def _memory_faults(case: FilmCase, meshes: int) -> list[Fault]:
    """Return a fault where the finest mesh between half-spaces needs more memory than the machine has."""
    elastic, space, finer = case.stated.elastic, case.problem.space, 4 ** (meshes - 1)
    if elastic is None or not elastic.has_half_space:
        return []
    needed = half_space_memory(finer * len(space.vertices), finer * space.size)
    if needed <= physical_memory():
        return []
    found, expected = too_large(needed, finer * space.size)
    return [Fault("--refine", f"{meshes} meshes, the finest of about {found}", expected)]


def refine_study(case: FilmCase | GapCase, study: FilmStudy, meshes: int, report: Report) -> Refinement:
    """Solve the case on `meshes` meshes, a transient with half the time step on each; `study` is that of the first.

    Raises FilmNotConverged as the solver of any mesh, and InputError as `refined` of the case.
    """
    studies = [study]
    for number in range(1, meshes):
        label = f"mesh {number + 1} of {meshes}"
        report(number, meshes, Stage(f"{label}, its fields and walls"))
        case = case.refined()
        told = _of_mesh(report, number, meshes, label)
        if isinstance(case, FilmCase):
            told(0, 0, Stage(f"{case.problem.space.size} unknowns"))
        studies.append(solve_case(case, told))
    rows = [_converging(case, film_summary(replace(one, sensitivity=None))) for one in studies]
    expected = expected_orders(studies[-1])
    size = sizes(rows[-1], natural_sizes(studies[-1].solution))
    return Refinement(
        tuple(one.solution.problem.space.size for one in studies),
        expected,
        {key: convergence([row[key] for row in rows], expected, size[key]) for key in rows[0]},
        tuple(len(one.history) for one in studies) if study.history else (),
    )


def _of_mesh(report: Report, number: int, meshes: int, label: str) -> Report:
    """Return the progress of a mesh: its words, and the steps of a transient."""

    def told(done: int, steps: int, what: str) -> None:
        words = f"{label}, {what}" + (f" ({done} of {steps})" if steps else "")
        report(number, meshes, Stage(words) if isinstance(what, Stage) else words)

    return told


def _converging(case: FilmCase | GapCase, summary: Mapping[str, Any]) -> dict[str, float]:
    """Return the headline numbers of a summary that have a limit: no counts, no checks, nothing that is given."""
    left_out = {*CHECKS, *_given(case)}
    return {key: value for key, value in headline_numbers(summary).items() if key not in left_out}


def _given(case: FilmCase | GapCase) -> set[str]:
    """Return the keys of the numbers that the case states and the solver balances: their error is its tolerance."""
    if isinstance(case, GapCase):
        return {"required_load_N", "carried_load_N"} if case.position is None else {"required_load_N"}
    load = case.stated.film.rigid_load
    if load is None:
        return set()
    # Of film and contact together: each of the two varies with the mesh.
    alone = {"load_N"} if case.problem.asperities is None else set()
    moments = {"moment_x_Nm": load.moment_x, "moment_y_Nm": load.moment_y}
    return {"carried_load_N", *alone, *(key for key, moment in moments.items() if moment is not None)}


def expected_orders(study: FilmStudy) -> tuple[float, float]:
    """Return the range of expected orders of integrals: twice the degree; less where theory does not determine it.

    Order one: a cavity's front, which moves by whole cells, upwind transport of oil, and of heat where
    temperatures jump, and implicit Euler steps. Order two: quadratic pressures on straight cells of a round film.
    """
    if study.solution.problem.space.degree == 2:
        return (1.0 if study.history else 2.0), 4.0
    return (1.0, 2.0) if study.heat or study.history or np.any(study.solution.cavity) else (2.0, 2.0)
