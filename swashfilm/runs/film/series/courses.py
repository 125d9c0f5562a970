"""Series over the shaft angle in a study of gaps over the turn: one curve per point, data and pictures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from swashfilm.case.study import Study
from swashfilm.output.headline import about, named, shown_of
from swashfilm.runs.film.series.plots import COURSES, MOST_LINES, figure_axes, name_lines, where
from swashfilm.runs.film.series.points import StudyOutcome
from system.inputs.shown import titled

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

ANGLE = "shaft_angle_deg"
COURSE = "course"
"""Key of the series over the shaft angle beside the summary of a turn."""


def course_variables(
    study: Study[Any], outcomes: Sequence[StudyOutcome], dims: Sequence[str]
) -> dict[str, tuple[Any, ...]]:
    """Return variables `course_KEY` over the study's dimensions and the shaft angle (deg); none for other films.

    The angles are those of the first point with a series; other points are interpolated to them, linearly and
    periodically. NaN where a point has no series.
    """
    courses: list[Mapping[str, Any]] = [outcome.summary.get(COURSE, {}) for outcome in outcomes]
    first = next((course for course in courses if course), None)
    if first is None:
        return {}
    angles = np.array(first[ANGLE])
    found: dict[str, tuple[Any, ...]] = {ANGLE: (ANGLE, angles, {"units": "deg"})}
    for key in first:
        if key == ANGLE:
            continue
        curves = [_at(angles, course, key) for course in courses]
        values = np.array(curves).reshape(*study.shape, len(angles))
        found[COURSES + key] = ((*dims, ANGLE), values, about(key))
    return found


def _at(angles: np.ndarray, course: Mapping[str, Any], key: str) -> np.ndarray:
    if not course:
        return np.full(len(angles), np.nan)
    return np.interp(angles, course[ANGLE], course[key], period=course[ANGLE][-1])


def course_plots(data: xarray.Dataset) -> dict[str, Figure]:
    """Return a figure of each series by its key: a line over the shaft angle per point, at most MOST_LINES."""
    names = [str(name) for name in data.data_vars if str(name).startswith(COURSES)]
    return {name: _picture(data, name) for name in names}


def _picture(data: xarray.Dataset, name: str) -> Figure:
    figure, axes = figure_axes()
    field = data[name]
    how = shown_of(name.removeprefix(COURSES))
    dims = [str(dim) for dim in field.dims if dim != ANGLE]
    points = list(product(*(range(data.sizes[dim]) for dim in dims)))
    for index in points[:MOST_LINES]:
        at = dict(zip(dims, index, strict=True))
        axes.plot(data[ANGLE].values, how.of(field.isel(at).values), linewidth=1.2, label=where(data, at))
    words, _ = named(name.removeprefix(COURSES))
    axes.set(xlabel="shaft angle [deg]", ylabel=titled(words, how.unit), title=f"{words} over the revolution")
    axes.grid(visible=True, alpha=0.3)
    lines = min(len(points), MOST_LINES)
    name_lines(axes, None if lines == len(points) else f"{lines} of {len(points)} points")
    return figure
