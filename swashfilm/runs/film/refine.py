"""Mesh convergence of a film: the same case on meshes each twice finer, and the limits of its numbers."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from reynolds.problem import FilmSolution
from reynolds.solve.loads import point_fields
from swashfilm.case.fields.mesh import MOST_CELLS
from swashfilm.case.file import FilmCase
from swashfilm.case.gap.instant import GapCase
from swashfilm.output.convergence import Convergence, convergence
from swashfilm.output.headline import headline_numbers, named, sizes
from swashfilm.output.tables import write_csv
from swashfilm.runs.film.solve.study import FilmStudy, solve_case
from swashfilm.runs.film.summary import film_summary
from system.inputs.faults import Fault, InputFaults
from system.work.progress import Report


@dataclass(frozen=True)
class Refinement:
    """Unknowns of the meshes, coarsest (that of the case) first; expected orders; the numbers by key."""

    dofs: tuple[int, ...]
    expected: tuple[float, float]
    numbers: Mapping[str, Convergence]


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
    rows = [headline_numbers(film_summary(one)) for one in studies]
    expected = expected_orders(studies[-1])
    size = sizes(rows[-1], _natural_sizes(studies[-1].solution))
    return Refinement(
        tuple(one.solution.problem.space.size for one in studies),
        expected,
        {key: convergence([row[key] for row in rows], expected, size[key]) for key in rows[0]},
    )


def expected_orders(study: FilmStudy) -> tuple[float, float]:
    """Return the range of expected orders of integrals: twice the degree; less where theory leaves it open.

    Order one: a cavity's front, which moves by whole cells, upwind transport of oil, and of heat where
    temperatures jump. Order two: quadratic pressures on straight cells of a round film.
    """
    if study.solution.problem.space.degree == 2:
        return 2.0, 4.0
    return (1.0, 2.0) if study.heat or np.any(study.solution.cavity) else (2.0, 2.0)


def _natural_sizes(solution: FilmSolution) -> dict[str, float]:
    """Return sizes of moments, torques (N m) and wall forces (N) without cancellation by symmetry."""
    space = solution.problem.space
    fields = point_fields(solution)
    reach = float(np.abs(space.vertices).max())
    shear = (*fields.shear_moving, *fields.shear_fixed)
    friction = float(sum(np.sum(np.abs(part) * space.area) for part in shear))
    return {
        "moment": reach * float(np.sum(np.abs(fields.pressure) * space.area)),
        "friction": friction,
        "torque": reach * friction,
    }


def refinement_summary(found: Refinement) -> dict[str, Any]:
    """Return the entry of summary.json: SI, units in the keys of the numbers."""
    return {
        "dofs": list(found.dofs),
        "expected_order": list(found.expected),
        "numbers": {
            key: {
                "values": list(number.values),
                "order": number.order,
                "extrapolated": number.extrapolated,
                "error": number.error,
                "verdict": number.verdict.value,
            }
            for key, number in found.numbers.items()
        },
    }


def refinement_rows(found: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Yield (number and unit, value on each mesh, order, limit and error bar, verdict) of a `refinement`."""
    for key, number in found["numbers"].items():
        order = "-" if number["order"] is None else f"{number['order']:.2f}"
        values = [f"{value:.6g}" for value in number["values"]]
        words, unit = named(key)
        limit = _with_bar(number["extrapolated"], number["error"])
        yield (f"{words} {f'({unit})' if unit else ''}".strip(), *values, order, limit, number["verdict"])


def _with_bar(limit: float | None, error: float | None) -> str:
    """Return the limit, rounded to the digit of its error bar."""
    if limit is None or error is None:
        return "-"
    digits = 6
    if error > 0.0 and limit != 0.0:
        digits = int(np.clip(np.ceil(np.log10(abs(limit) / error)) + 1.0, 2, 10))
    return f"{limit:.{digits}g} +- {error:.1g}"


def refinement_head(found: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the titles of the columns of `refinement_rows`."""
    return ("", *(f"{dofs} unknowns" for dofs in found["dofs"]), "order", "limit", "verdict")


def write_refinement(path: Path, found: Refinement) -> None:
    """Write a CSV of the numbers: key, unit, value on each mesh, order, limit, error bar, verdict."""
    rows = []
    for key, number in found.numbers.items():
        limits = ["" if value is None else value for value in (number.order, number.extrapolated, number.error)]
        rows.append([*named(key), *number.values, *limits, number.verdict.value])
    meshes = [f"{dofs} unknowns" for dofs in found.dofs]
    write_csv(path, ["number", "unit", *meshes, "order", "limit", "error", "verdict"], rows)
