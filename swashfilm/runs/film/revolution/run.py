"""Run of one gap over the turn, also on finer meshes and steps: solved, and written as tables, fields and a page."""

from pathlib import Path
from typing import Any

from reynolds.numerics.convergence import convergence
from swashfilm.case.gap.revolution import RevolutionCase
from swashfilm.output.data.files import write_netcdf
from swashfilm.output.refinement import Refinement, refinement_summary, write_refinement
from swashfilm.output.run_folder import write_json
from swashfilm.runs.film.revolution.data import (
    revolution_dataset,
    write_convergence,
    write_revolution_fields,
    write_series,
)
from swashfilm.runs.film.revolution.solve import RevolutionStudy, revolution_summary, solve_revolution
from system.work.progress import Report

EXPECTED = (1.0, 2.0)
"""Expected orders: two for the film, one for a cavity's front; a least value is not smooth."""
NUMBERS = (
    "film_thickness_min_m", "film_thickness_mean_m", "leakage_flow_m3_per_s", "friction_power_W",
    "contact_load_mean_N", "tilt_max_rad",
)  # fmt: skip


def refine_revolution(case: RevolutionCase, study: RevolutionStudy, meshes: int, report: Report) -> Refinement:
    """Solve the case on `meshes` meshes, angles and steps each twice finer; `study` is the solution on the first.

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


def run_revolution_case(
    case: RevolutionCase, folder: Path, report: Report, *, meshes: int = 1, animated: bool = False
) -> dict[str, Any]:
    """Solve a case and write its tables (<gap>.csv, convergence.csv), results.nc, fields/, <gap>.pvd and its page.

    With more than one of `meshes` the case is solved on finer meshes too, and refinement.csv holds the limits of
    its numbers; fields and numbers are those of the case's mesh. `animated`: write animation.gif of the kept
    films, and animation.mp4 where ffmpeg exists. Returns the summary. Raises FilmNotConverged; the folder then
    holds only input.toml and resolved.toml.
    """
    (folder / "input.toml").write_text(case.text, encoding="utf-8")
    (folder / "resolved.toml").write_text(case.resolved, encoding="utf-8")
    study = solve_revolution(case, report)
    summary = revolution_summary(study)
    if meshes > 1:
        found = refine_revolution(case, study, meshes, report)
        summary["refinement"] = refinement_summary(found)
        write_refinement(folder / "refinement.csv", found)
    report(0, 1, "writing fields")
    data = revolution_dataset(study)
    write_netcdf(data, folder / "results.nc", "film_revolution")
    write_series(folder / f"{case.gap.value}.csv", data)
    write_convergence(folder / "convergence.csv", study)
    write_revolution_fields(folder, study)
    write_json(folder / "summary.json", summary)
    if animated:
        from swashfilm.runs.film.revolution.animation import write_animation

        write_animation(folder, data, report)
    report(0, 1, "drawing")
    from swashfilm.runs.film.revolution.page import write_revolution_page

    write_revolution_page(folder)
    report(1, 1, "done")
    return summary
