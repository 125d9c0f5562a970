"""Mesh convergence of a gap over the turn: the same turn on meshes each twice finer."""

from swashfilm.case.gap.revolution import RevolutionCase
from swashfilm.output.convergence import convergence
from swashfilm.runs.film.refine import Refinement
from swashfilm.runs.film.revolution.solve import RevolutionStudy, revolution_summary, solve_revolution
from system.work.progress import Report

EXPECTED = (1.0, 2.0)
"""Expected orders: two for the film, one for a cavity's front; a least value is not smooth."""
NUMBERS = (
    "film_thickness_min_m", "film_thickness_mean_m", "leakage_flow_m3_per_s", "friction_power_W",
    "contact_load_mean_N", "tilt_max_rad",
)  # fmt: skip


def refine_revolution(case: RevolutionCase, study: RevolutionStudy, meshes: int, report: Report) -> Refinement:
    """Solve the case on `meshes` meshes with the same time steps; `study` is the solution on the first.

    Raises FilmNotConverged as the solver of any mesh.
    """
    rows = [revolution_summary(study)]
    for number in range(2, meshes + 1):
        case = case.refined()
        label = f"mesh {number} of {meshes}"

        def report_mesh(done: int, steps: int, what: str, label: str = label) -> None:
            report(done, steps, f"{label}: {what}")

        rows.append(revolution_summary(solve_revolution(case, report_mesh)))
    return Refinement(
        tuple(row["dofs"] for row in rows),
        EXPECTED,
        {key: convergence([row[key] for row in rows], EXPECTED, max(abs(row[key]) for row in rows)) for key in NUMBERS},
    )
