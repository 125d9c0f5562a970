"""One film, and studies of films."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swashfilm.api.calls import door, words_of
from swashfilm.api.given import Case, case_path
from system.inputs.faults import Fault, InputFaults
from system.work.progress import Report, silent

if TYPE_CHECKING:
    from swashfilm.runs.film.result import FilmRun
    from swashfilm.runs.film.revolution.result import RevolutionRun
    from swashfilm.runs.film.series.result import StudyRun


def film(
    case: Case,
    *,
    refine: int | None = None,
    sensitivity: str | Sequence[str] | None = None,
    report: Report = silent,
    **options: object,
) -> FilmRun | RevolutionRun:
    """Solve one film, free or a gap of a pump, at an instant or over the turn, as `swashfilm film`.

    refine: number of meshes, for order and error. sensitivity: outputs whose derivatives by the film thickness are
    wanted, such as "load" or ["load", "flow.left"]. options: rigid, isoviscous, isothermal, smooth, no_cavitation.
    Raises InputFaults and FilmNotConverged.
    """
    with door("film"), case_path(case) as path:
        from swashfilm.case.gap.revolution import RevolutionCase
        from swashfilm.case.study import StudyCase
        from swashfilm.runs.film.command import film_case, outputs_of
        from swashfilm.runs.film.revolution.result import RevolutionRun
        from swashfilm.runs.film.revolution.run import run_revolution_case
        from swashfilm.runs.film.run import solve_film

        wanted = sensitivity if sensitivity is None or isinstance(sensitivity, str) else ",".join(sensitivity)
        words = words_of("film", [path], {"refine": refine, "sensitivity": wanted} | options)
        found, meshes, _ = film_case(words)
        if isinstance(found, StudyCase):
            raise InputFaults(str(path), [Fault("study", "a study", "one film", "swashfilm.study()")])
        if isinstance(found, RevolutionCase):
            return RevolutionRun.ran(lambda folder: run_revolution_case(found, folder, report, meshes=meshes))
        return solve_film(found, report, meshes=meshes, outputs=outputs_of(words))


def study(
    case: Case, *, workers: int = 1, resume: str | Path | None = None, report: Report = silent, **options: object
) -> StudyRun:
    """Solve a study, a film case whose [study] table varies keys, as `swashfilm film`; raise InputFaults.

    workers: number of processes; resume: run folder with finished points. A point without a result has its reason.
    """
    with door("study"), case_path(case) as path:
        from swashfilm.case.study import StudyCase
        from swashfilm.runs.film.command import film_case
        from swashfilm.runs.film.series.page import run_study
        from swashfilm.runs.film.series.result import StudyRun

        words = words_of("film", [path], {"workers": workers if workers > 1 else None, "resume": resume} | options)
        found, _, count = film_case(words)
        if not isinstance(found, StudyCase):
            raise InputFaults(str(path), [Fault("study", "missing", "a case with [study]", "swashfilm.film()")])
        return StudyRun.ran(lambda folder: run_study(found, folder, report, resumed=words.resume, workers=count))
