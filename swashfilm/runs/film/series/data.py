"""Results of a study: NetCDF over the varied keys, CSV by point, and a summary."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.case.study import Combine, Study
from swashfilm.formats.versions import headed
from swashfilm.output.data.files import Column, column_of, write_columns
from swashfilm.output.headline import about, headline_numbers
from swashfilm.runs.film.series.courses import course_variables
from swashfilm.runs.film.series.points import StudyOutcome
from system.work.tasks import PartStatus

if TYPE_CHECKING:
    import xarray


FILM_STUDY = "film_study"
"""Kind of a study of films, in its files."""


def study_dataset(study: Study[Any], outcomes: Sequence[StudyOutcome], kind: str = FILM_STUDY) -> xarray.Dataset:
    """Return headline numbers over the varied keys (over `point` where they vary together); NaN where missing.

    Coordinates are SI numbers with their unit, or texts; `status` and `reason` describe each point.
    """
    import xarray

    rows = [headline_numbers(outcome.summary) for outcome in outcomes]
    keys = list(dict.fromkeys(key for row in rows for key in row))
    together = study.combine is Combine.TOGETHER
    dims = ["point"] if together else [axis.key for axis in study.axes]
    variables: dict[str, Any] = {
        key: (dims, np.array([row.get(key, np.nan) for row in rows]).reshape(study.shape), about(key)) for key in keys
    }
    for name, texts in (("status", [o.status.value for o in outcomes]), ("reason", [o.reason for o in outcomes])):
        variables[name] = (dims, np.array(texts, dtype=object).reshape(study.shape))
    variables |= course_variables(study, outcomes, dims)
    coordinates = {
        axis.key: (
            "point" if together else axis.key,
            np.array(axis.labels, dtype=object) if axis.numbers is None else np.array(axis.numbers),
            {"units": axis.unit} if axis.unit else {},
        )
        for axis in study.axes
    }
    attributes = {"name": study.name, "kind": kind, "combine": study.combine.value}
    return xarray.Dataset(variables, coords=coordinates, attrs=attributes)


def study_summary(study: Study[Any], outcomes: Sequence[StudyOutcome], kind: str = FILM_STUDY) -> dict[str, Any]:
    """Return varied keys, solved points, span of every number, points without a result, and warnings."""
    solved = [outcome for outcome in outcomes if outcome.status is PartStatus.SOLVED]
    rows = [headline_numbers(outcome.summary) for outcome in solved]
    keys = list(dict.fromkeys(key for row in rows for key in row))
    return {
        **headed(kind),
        "name": study.name,
        "combine": study.combine.value,
        "axes": [
            {"key": a.key, "values": list(a.labels), "numbers": a.numbers and list(a.numbers), "unit": a.unit}
            for a in study.axes
        ],
        "points": len(outcomes),
        "solved": len(solved),
        "numbers": {
            key: _span([(row[key], k) for k, row in enumerate(rows) if key in row], study, solved) for key in keys
        },
        "failed": [
            {"values": study.values(o.point), "status": o.status.value, "reason": o.reason}
            for o in outcomes
            if o.status is not PartStatus.SOLVED
        ],
        "mass_balance_error_max": max((o.summary["mass_balance_error"] for o in solved), default=None),
        "solve_seconds": sum(o.summary["solve_seconds"] for o in solved),
        "assumptions": list(dict.fromkeys(one for o in solved for one in o.summary.get("assumptions", []))),
        "warnings": _warnings(solved),
    }


def _span(found: list[tuple[float, int]], study: Study[Any], solved: Sequence[StudyOutcome]) -> dict[str, Any]:
    (least, at_least), (most, at_most) = min(found), max(found)
    return {
        "min": least,
        "max": most,
        "min_at": study.values(solved[at_least].point),
        "max_at": study.values(solved[at_most].point),
    }


def _warnings(solved: Sequence[StudyOutcome]) -> list[dict[str, str]]:
    """Return each warning once, with the text of its first point."""
    texts: dict[str, str] = {}
    count = Counter(warning["name"] for outcome in solved for warning in outcome.summary["warnings"])
    for outcome in solved:
        for warning in outcome.summary["warnings"]:
            texts.setdefault(warning["name"], warning["text"])
    return [{"name": name, "text": f"at {count[name]} points; at the first: {text}"} for name, text in texts.items()]


def write_study_table(path: Path, study: Study[Any], outcomes: Sequence[StudyOutcome]) -> None:
    """Write a CSV with one line per point: varied keys, headline numbers, status and reason."""
    rows: list[Mapping[str, float]] = [headline_numbers(outcome.summary) for outcome in outcomes]
    keys = list(dict.fromkeys(key for row in rows for key in row))
    axes = []
    for place, axis in enumerate(study.axes):
        values, unit = (axis.labels, None) if axis.numbers is None else (axis.numbers, axis.unit or "1")
        axes.append(Column(axis.key, [values[outcome.point[place]] for outcome in outcomes], unit))
    numbers = [column_of(key, [row.get(key, np.nan) for row in rows]) for key in keys]
    status = Column("status", [outcome.status.value for outcome in outcomes])
    write_columns(path, [*axes, *numbers, status, Column("reason", [outcome.reason for outcome in outcomes])])
