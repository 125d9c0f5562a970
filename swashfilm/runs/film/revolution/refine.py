"""Mesh convergence of a gap over the revolution: the same turn on meshes each twice finer."""

from __future__ import annotations

from swashfilm.case.gap.revolution import RevolutionCase
from swashfilm.output.convergence import convergence
from swashfilm.runs.film.refine import Refinement
from swashfilm.runs.film.revolution.solve import RevolutionStudy, revolution_summary, solve_revolution
from system.work.progress import Report

EXPECTED = (1.0, 2.0)
"""Orders to expect: second of the film, first of a cavity's front; a least value is no smooth one."""
NUMBERS = (
    "film_thickness_min_m", "film_thickness_mean_m", "leakage_flow_m3_per_s", "friction_power_W",
    "contact_load_mean_N", "tilt_max_rad",
)  # fmt: skip


def refine_revolution(case: RevolutionCase, study: RevolutionStudy, meshes: int, report: Report) -> Refinement:
    """The case on `meshes` meshes, the first of which `study` is of; steps in time stay as they are.

    Raises FilmNotConverged where one of the meshes does.
    """
    rows = [revolution_summary(study)]
    for number in range(2, meshes + 1):
        case = case.refined()
        label = f"mesh {number} of {meshes}"

        def told(done: int, steps: int, what: str, label: str = label) -> None:
            report(done, steps, f"{label}: {what}")

        rows.append(revolution_summary(solve_revolution(case, told)))
    return Refinement(
        tuple(row["dofs"] for row in rows),
        EXPECTED,
        {
            key: convergence([row[key] for row in rows], EXPECTED, max(abs(row[key]) for row in rows))
            for key in NUMBERS
        },
    )
