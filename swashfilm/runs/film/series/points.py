"""Points of a study: each a separate film, stored when it is solved, with the reason of a failure."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from swashfilm.case.file import Case
from swashfilm.case.gap.instant import GapCase
from swashfilm.case.gap.revolution import RevolutionCase
from swashfilm.case.study import Point, StudyCase
from swashfilm.runs.film.revolution.solve import revolution_course, revolution_summary, solve_revolution
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_summary
from system.work.kept_results import POINTS, KeptPoints, points_of_run, run_kept
from system.work.processes import process_pool
from system.work.progress import Report
from system.work.tasks import PartOutcome, PartStatus

COURSE = "course"
"""Key of the series over the shaft angle beside the summary of a turn."""


@dataclass(frozen=True)
class StudyOutcome:
    """A point of a study: the summary of its film, or the reason of its failure."""

    point: Point
    status: PartStatus
    reason: str
    summary: Mapping[str, Any]


@dataclass(frozen=True)
class StudyWork:
    """The points of a study as work in parts."""

    study: StudyCase

    def key(self, point: Point) -> str:
        """Return the digest of the point's case; raise InputFaults for an invalid case."""
        return digest(self.study.case(point))

    def solve(self, point: Point) -> dict[str, Any]:
        """Return the summary of the point's film; raise as its solver."""
        return solved_summary(self.study.case(point))

    def text(self, point: Point, outcome: PartOutcome) -> str:
        """Return the point and its state in words."""
        values = ", ".join(f"{key} = {value}" for key, value in self.study.values(point).items())
        return f"{values}: {outcome.status.value}"


def run_points(
    study: StudyCase, folder: Path, report: Report, *, resumed: Path | None = None, workers: int = 1
) -> list[StudyOutcome]:
    """Return all points, in their order; each is stored in `folder`/points as soon as it is solved.

    Points of the same resolved case in `resumed`/points are read from there. Raises InputFaults where `resumed`
    holds no points.
    """
    work, store = StudyWork(study), KeptPoints(folder / POINTS)
    earlier = points_of_run(resumed) if resumed else None
    with process_pool(workers) as executor:
        kept = run_kept(work, study.points, store, executor, earlier=earlier, described=work.text, report=report)
    return [
        StudyOutcome(point, found.status, found.reason, found.record)
        for point, found in zip(study.points, kept.outcomes, strict=True)
    ]


def solved_summary(case: Case) -> dict[str, Any]:
    """Solve a case and return its summary, for a turn with its series; raise as its solver."""
    if isinstance(case, RevolutionCase):
        study = solve_revolution(case)
        return revolution_summary(study) | {COURSE: revolution_course(study)}
    return film_summary(solve_case(case))


def digest(case: Case) -> str:
    """Return a name for the content of a case: its resolved text, and the data of other files."""
    content = hashlib.sha256(case.resolved.encode())
    if isinstance(case, GapCase):
        content.update(repr((case.rotor.pump, case.position, case.load)).encode())
    elif isinstance(case, RevolutionCase):
        content.update(repr((case.rotor.pump, case.chamber_pressure)).encode())
    else:
        film = case.problem.film
        for part in (case.problem.space.vertices, film.thickness, film.viscosity):
            content.update(part.tobytes())
    return content.hexdigest()[:24]
