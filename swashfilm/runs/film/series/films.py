"""Films of a study: the solution of a case of any kind, and a name for its content."""

from __future__ import annotations

import hashlib
from typing import Any

from swashfilm.case.file import Case
from swashfilm.case.gap.instant import GapCase
from swashfilm.case.gap.revolution import RevolutionCase
from swashfilm.runs.film.revolution.solve import revolution_course, revolution_summary, solve_revolution
from swashfilm.runs.film.series.courses import COURSE
from swashfilm.runs.film.solve.study import solve_case
from swashfilm.runs.film.summary import film_summary


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
