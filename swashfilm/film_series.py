"""A study run: every point a film of its own, kept as it is done, told of where it fails."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Any

from reynolds.errors import FilmInputError, FilmNotConverged
from swashfilm.film_case import Case
from swashfilm.film_study import film_summary, solve_case
from swashfilm.gap_case import GapCase
from swashfilm.progress import Report
from swashfilm.revolution_case import RevolutionCase
from swashfilm.revolution_study import revolution_course, revolution_summary, solve_revolution
from swashfilm.study_case import Point, StudyCase
from system.errors import NotConverged
from system.faults import Fault, InputFaults, nearest_path
from system.side_by_side import side_by_side

POINTS = "points"
COURSE = "course"
"""Of a revolution, beside its summary: what a study compares over the shaft angle."""


class Status(Enum):
    """What has become of a point."""

    SOLVED = "solved"
    FAULTY = "faulty"
    NOT_CONVERGED = "not converged"


@dataclass(frozen=True)
class Outcome:
    """A point of a study: its film's summary, or why there is none."""

    point: Point
    status: Status
    reason: str
    summary: Mapping[str, Any]


def run_points(
    study: StudyCase, folder: Path, report: Report, *, resumed: Path | None = None, workers: int = 1
) -> list[Outcome]:
    """All points, in their order; each is kept in `folder`/points as soon as it is done.

    Points that `resumed`/points holds already, of the very same resolved case, are taken from there. Raises
    InputFaults where `resumed` holds no points.
    """
    kept = _kept(study, folder, resumed) if resumed else {}
    todo = [point for point in study.points if point not in kept]
    report(0, len(todo), f"{len(kept)} points kept" if kept else "solving")
    for done, outcome in enumerate(side_by_side(partial(solve_point, study, folder), todo, workers), start=1):
        kept[outcome.point] = outcome
        values = ", ".join(f"{key} = {value}" for key, value in study.values(outcome.point).items())
        report(done, len(todo), f"{values}: {outcome.status.value}")
    return [kept[point] for point in study.points]


def solve_point(study: StudyCase, folder: Path, point: Point) -> Outcome:
    """One point solved and kept in `folder`; a fault or a solve that does not converge is its reason."""
    try:
        case = study.case(point)
        summary = solved_summary(case)
    except (InputFaults, FilmInputError) as reason:
        return Outcome(point, Status.FAULTY, _line(reason), {})
    except (FilmNotConverged, NotConverged) as reason:
        outcome = Outcome(point, Status.NOT_CONVERGED, str(reason), {})
    else:
        outcome = Outcome(point, Status.SOLVED, "", summary)
    _keep(folder, digest(case), outcome)
    return outcome


def solved_summary(case: Case) -> dict[str, Any]:
    """The summary of a case solved here, that of a revolution with its course; raises as its solver."""
    if isinstance(case, RevolutionCase):
        study = solve_revolution(case)
        return revolution_summary(study) | {COURSE: revolution_course(study)}
    return film_summary(solve_case(case))


def digest(case: Case) -> str:
    """A name for the content of a case: its resolved text, and what that takes from other files."""
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


def _keep(folder: Path, name: str, outcome: Outcome) -> None:
    (folder / POINTS).mkdir(exist_ok=True)
    record = asdict(outcome) | {"status": outcome.status.value}
    unfinished = folder / POINTS / f"{name}.tmp"
    unfinished.write_text(json.dumps(record, allow_nan=False), encoding="utf-8")
    unfinished.replace(folder / POINTS / f"{name}.json")


def _kept(study: StudyCase, folder: Path, resumed: Path) -> dict[Point, Outcome]:
    """Outcomes that lie in another run folder, copied to this one."""
    if not (resumed / POINTS).is_dir():
        found, near = f"{resumed}, which holds no {POINTS}", nearest_path(resumed)
        fault = Fault("--resume", found, "the folder of a study that was begun", near)
        raise InputFaults("command line", [fault])
    taken = {}
    for point in study.points:
        try:
            name = digest(study.case(point))
        except InputFaults:
            continue  # told when the point is tried
        record = resumed / POINTS / f"{name}.json"
        if record.is_file():
            values = json.loads(record.read_text("utf-8"))
            outcome = Outcome(point, Status(values["status"]), values["reason"], values["summary"])
            _keep(folder, name, outcome)
            taken[point] = outcome
    return taken


def _line(reason: InputFaults | FilmInputError) -> str:
    if isinstance(reason, InputFaults):
        return "; ".join(f"{fault.path}: {fault.found}, expected {fault.expected}" for fault in reason.faults)
    return str(reason)
