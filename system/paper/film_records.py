"""Films of a floating point, kept for the paper's figures."""

from math import pi
from typing import Any

import numpy as np

from gaps.revolution.march import GapRevolution
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from system.films.rotor import engaged_share
from system.paper.figure import FigureAxis, FigureField, Unit
from system.points.floating import FloatingPoint
from system.work.tasks import Record

FILM = FigureAxis("film", Unit.FILM)
SHOWN_ANGLE = 1.5 * pi
"""Shaft angle (rad) of the film that is drawn: the middle of the delivery half."""


def films_record(found: FloatingPoint) -> Record:
    """Films of the gaps of the most common chambers: `_film_record` of each, `_piston_record` of the piston's."""
    kind = found.kinds[0]
    gaps, parts = kind.gaps, kind.parts
    engaged = engaged_share(kind.rotor, parts.piston.guide_length, gaps.piston.angles)
    return {
        "slipper": _film_record(gaps.slipper),
        "piston": {**_film_record(gaps.piston), **_piston_record(gaps.piston, engaged)},
        "valve_plate": _film_record(gaps.block),
    }


def _film_record(found: GapRevolution[Any]) -> Record:
    """Means over the turn: film over the area (m), contact load (N); least film anywhere (m), hottest oil (K)."""
    instants = found.turn.instants
    return {
        "mean": found.mean_film,
        "least": min(one.least_gap for one in instants),
        "hottest": None if found.warmth is None else float(found.warmth.hottest.max()),
        "contact": float(np.mean([one.report.contact_load for one in instants])),
    }


def _piston_record(found: GapRevolution[Any], engaged: Array) -> Record:
    """Eccentricity (m) of the axis at both ends of the film over the shaft angle (rad), and the film shown."""
    inner, case = found.positions.T[:2], found.positions.T[2:]
    own_end = case + (inner - case) * engaged
    angles = np.array(list(found.turn.films))
    at = float(angles[np.argmin(np.abs(angles - SHOWN_ANGLE))])
    field = film_field(found.turn.films[at])
    return {
        "angle": found.angles.tolist(),
        "eccentricity": [np.hypot(*end).tolist() for end in (own_end, case)],
        "shown": at,
        "field": [one.tolist() for one in (field.x, field.y, field.values)],
    }


def film_field(solution: FilmSolution) -> FigureField:
    """Thickness at a film's quadrature points over angle (rad) and share of the length."""
    space = solution.problem.space
    x, y = (one.ravel() for one in space.points)
    thickness = np.broadcast_to(solution.film.thickness, space.points[0].shape).ravel()
    columns, column = np.unique(np.round(x / np.ptp(x), 9), return_inverse=True)
    rows, row = np.unique(np.round(y / np.ptp(y), 9), return_inverse=True)
    values = np.full((rows.size, columns.size), np.nan)
    values[row, column] = thickness
    angle = 2.0 * pi * (columns - columns[0]) / (columns[-1] - columns[0] + columns[1] - columns[0])
    length = (rows - rows[0]) / (rows[-1] - rows[0])
    return FigureField(FILM, angle, length, values)
