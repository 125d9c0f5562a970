"""Films of a study: the solution of a case of any kind, and a name for its content."""

from __future__ import annotations

import hashlib
from importlib.metadata import version
from typing import Any

from reynolds.numerics.cache import content_key
from swashfilm.case.file import Case, FilmCase
from swashfilm.case.gap.instant import GapCase
from swashfilm.case.gap.revolution import RevolutionCase
from swashfilm.runs.film.revolution.solve import revolution_course, revolution_summary, solve_revolution
from swashfilm.runs.film.series.courses import COURSE
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_summary

KEY_LENGTH = 24


def solved_summary(case: Case) -> dict[str, Any]:
    """Solve a case and return its summary, for a turn with its series; raise as its solver."""
    if isinstance(case, RevolutionCase):
        study = solve_revolution(case)
        return revolution_summary(study) | {COURSE: revolution_course(study)}
    return film_summary(solve_case(case))


def study_digest(case: Case) -> str:
    """Return a name of all inputs of a point of a study: the content of its case, and the program's version."""
    return content_key("film study", version("swashfilm"), digest(case))[:KEY_LENGTH]


def digest(case: Case) -> str:
    """Return a name for the content of a case: its resolved text, and that of the files it names."""
    return content_key(case.resolved, *_beside_text(case))[:KEY_LENGTH]


def _beside_text(case: Case) -> tuple[object, ...]:
    """Return the inputs of a case that its resolved text rounds or only names."""
    match case:
        case GapCase():
            return case.rotor.pump, case.position, case.load
        case RevolutionCase():
            return case.rotor.pump, case.chamber_pressure
        case FilmCase():
            return tuple(hashlib.sha256(path.read_bytes()).hexdigest() for path in case.stated.files)
