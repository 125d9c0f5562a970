"""Points of a study: each stored when it is solved, with the reason of a failure."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

from swashfilm.case.study import Point, Study
from system.work.kept_results import POINTS, KeptPoints, points_of_run, run_kept
from system.work.processes import process_pool
from system.work.progress import Report
from system.work.tasks import PartOutcome, PartStatus

CaseT = TypeVar("CaseT")


@dataclass(frozen=True)
class StudyOutcome:
    """A point of a study: its summary, or the reason of its failure."""

    point: Point
    status: PartStatus
    reason: str
    summary: Mapping[str, Any]


@dataclass(frozen=True)
class StudyWork(Generic[CaseT]):
    """The points of a study as work in parts.

    digest: returns a name of all inputs of a case's numbers. summary: solves a case and returns its numbers.
    """

    study: Study[CaseT]
    digest: Callable[[CaseT], str]
    summary: Callable[[CaseT], dict[str, Any]]

    def key(self, point: Point) -> str:
        """Return the digest of the point's case; raise InputFaults for an invalid case."""
        return self.digest(self.study.case(point))

    def solve(self, point: Point) -> dict[str, Any]:
        """Return the summary of the point's case; raise as its solver."""
        return self.summary(self.study.case(point))

    def text(self, point: Point, outcome: PartOutcome) -> str:
        """Return the point and its state in words."""
        return f"{self.study.words(point)}: {outcome.status.value}"


def run_points(
    work: StudyWork[CaseT], folder: Path, report: Report, *, resumed: Path | None = None, workers: int = 1
) -> list[StudyOutcome]:
    """Return all points, in their order; each is stored in `folder`/points as soon as it is solved.

    Points of the same digest in `resumed`/points are read from there. Raises InputFaults where `resumed` holds no
    points.
    """
    points, store = work.study.points, KeptPoints(folder / POINTS)
    earlier = points_of_run(resumed) if resumed else None
    with process_pool(workers) as executor:
        kept = run_kept(work, points, store, executor, earlier=earlier, described=work.text, report=report)
    return [
        StudyOutcome(point, found.status, found.reason, found.record)
        for point, found in zip(points, kept.outcomes, strict=True)
    ]
