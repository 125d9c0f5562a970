"""Run of one film: solved, and written to a run folder as fields, summary and page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from reynolds.numerics.arrays import Array
from reynolds.solve.export import write_pvd, write_vtu
from swashfilm.case.file import FilmCase
from swashfilm.case.gap.instant import GapCase
from swashfilm.output.data.files import Column, write_columns, write_netcdf
from swashfilm.output.refinement import Refinement, refinement_summary, write_refinement
from swashfilm.output.run_folder import write_json
from swashfilm.runs.film.fields.history import at_moment, fields_over_time, last_of, written
from swashfilm.runs.film.fields.sections import sections, write_sections
from swashfilm.runs.film.page import write_film_page
from swashfilm.runs.film.physics import temperatures, write_history
from swashfilm.runs.film.refine import check_refinement, refine_study
from swashfilm.runs.film.result import FilmRun
from swashfilm.runs.film.sensitivity import sensitivity_fields
from swashfilm.runs.film.solve.gap import true_place
from swashfilm.runs.film.solve.sensitivity import check_sensitivity, sensitivities
from swashfilm.runs.film.solve.study import FilmStudy, solve_case
from swashfilm.runs.film.summary import film_summary
from system.work.progress import Report, Stage, silent

if TYPE_CHECKING:
    import xarray

_STAGES = 3


def solve_film(
    case: FilmCase | GapCase,
    report: Report = silent,
    *,
    meshes: int = 1,
    as_table: bool = False,
    outputs: Sequence[str] = (),
) -> FilmRun:
    """Solve a case; its run folder holds fields for ParaView, results.nc, summary.json and report.html.

    With more than one of `meshes` the case is solved on finer meshes too, and refinement.csv holds order and
    error; fields and numbers are those of the case's mesh. `as_table`: write fields.csv, fields at the vertices.
    `outputs`: names of those whose derivatives by the film thickness are wanted. Raises FilmNotConverged, and
    InputFaults for outputs that the film does not have.
    """
    if meshes > 1:
        check_refinement(case, meshes)
    if outputs:
        check_sensitivity(case, outputs)
    stages = _STAGES + meshes - 1
    unknowns = f", {case.problem.space.size} unknowns" if isinstance(case, FilmCase) else ""
    report(0, stages, Stage(f"solving{unknowns}"))
    study = solve_case(case, lambda done, steps, what: report(0, stages, f"solving, {what} ({done} of {steps})"))
    if outputs:
        report(0, stages, "solving the adjoint")
        study = replace(study, sensitivity=sensitivities(case, study.solution, study.gap, outputs))
    summary = film_summary(study)
    refined: Refinement | None = None
    if meshes > 1:
        refined = refine_study(case, study, meshes, lambda done, _, what: report(done, stages, what))
        summary["refinement"] = refinement_summary(refined)

    def write(folder: Path) -> tuple[str, ...]:
        (folder / "input.toml").write_text(case.text, encoding="utf-8")
        (folder / "resolved.toml").write_text(case.resolved, encoding="utf-8")
        if refined is not None:
            write_refinement(folder / "refinement.csv", refined)
        report(stages - 2, stages, "writing fields")
        _write_films(folder, study, true_place(case) if isinstance(case, GapCase) else None)
        fields = fields_over_time(study)
        write_netcdf(fields, folder / "results.nc", "film")
        write_sections(folder / "sections.csv", sections(last_of(fields)))
        if as_table:
            _write_table(folder / "fields.csv", last_of(fields))
        write_json(folder / "summary.json", summary)
        report(stages - 1, stages, "drawing")
        write_film_page(folder)
        report(stages, stages, "done")
        return ()

    return FilmRun(summary, write, lambda: fields_over_time(study))


def _write_table(path: Path, fields: xarray.Dataset) -> None:
    """Write the fields at the vertices as a table, the unit in each head."""
    table = fields.drop_dims(["cell", "corner"]).variables
    write_columns(path, [Column(str(name), one.values, one.attrs.get("units", "1")) for name, one in table.items()])


def _write_films(folder: Path, study: FilmStudy, place: Callable[[Array], Array] | None) -> None:
    """Write film.vtu; for a transient film_NNNN.vtu over time, film.pvd and history.csv of its steps."""
    write_vtu(folder / "film.vtu", study.solution, place, temperatures(study) | sensitivity_fields(study))
    entries = [(0.0, 0, "film.vtu")]
    if study.history:
        write_history(folder / "history.csv", study.history)
        kept = written(study.history)
        entries = [(moment.time, 0, f"film_{number:04d}.vtu") for number, moment in enumerate(kept, start=1)]
        for (_, _, name), moment in zip(entries, kept, strict=True):
            now = at_moment(study, moment)
            write_vtu(folder / name, now.solution, None, temperatures(now))
    write_pvd(folder / "film.pvd", entries)
