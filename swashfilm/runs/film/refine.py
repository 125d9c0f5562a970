"""Mesh convergence of a film: the same case on meshes each twice finer, and the limits of its numbers."""

from dataclasses import replace

import numpy as np

from reynolds.numerics.convergence import convergence
from swashfilm.case.fields.mesh import MOST_CELLS
from swashfilm.case.file import FilmCase
from swashfilm.case.gap.instant import GapCase
from swashfilm.output.headline import headline_numbers, sizes
from swashfilm.output.refinement import Refinement
from swashfilm.runs.film.solve.study import FilmStudy, solve_case
from swashfilm.runs.film.summary import film_summary, natural_sizes
from system.inputs.faults import Fault, InputFaults
from system.work.progress import Report


def check_refinement(case: FilmCase | GapCase, meshes: int) -> None:
    """Raise InputFaults where the finest mesh has too many cells."""
    if isinstance(case, GapCase):
        return  # small enough for every number of meshes of the command line
    cells = case.problem.space.area.shape[0] * 4 ** (meshes - 1)
    if cells > MOST_CELLS:
        fault = Fault("--refine", f"{meshes} meshes, the finest of {cells} cells", f"at most {MOST_CELLS} cells")
        raise InputFaults("command line", [fault])


def refine_study(case: FilmCase | GapCase, study: FilmStudy, meshes: int, report: Report) -> Refinement:
    """Solve the case on `meshes` meshes; `study` is the solution on the first.

    Raises FilmNotConverged as the solver of any mesh, and InputError as `refined` of the case.
    """
    studies = [study]
    for number in range(1, meshes):
        report(number, meshes, f"mesh {number + 1} of {meshes}")
        case = case.refined()
        studies.append(solve_case(case))
    rows = [headline_numbers(film_summary(replace(one, sensitivity=None))) for one in studies]
    expected = expected_orders(studies[-1])
    size = sizes(rows[-1], natural_sizes(studies[-1].solution))
    return Refinement(
        tuple(one.solution.problem.space.size for one in studies),
        expected,
        {key: convergence([row[key] for row in rows], expected, size[key]) for key in rows[0]},
    )


def expected_orders(study: FilmStudy) -> tuple[float, float]:
    """Return the range of expected orders of integrals: twice the degree; less where theory does not determine it.

    Order one: a cavity's front, which moves by whole cells, upwind transport of oil, and of heat where
    temperatures jump. Order two: quadratic pressures on straight cells of a round film.
    """
    if study.solution.problem.space.degree == 2:
        return 2.0, 4.0
    return (1.0, 2.0) if study.heat or np.any(study.solution.cavity) else (2.0, 2.0)
