"""Sizes of a film's forces, moments and flows, beside which other numbers of it are round-off."""

from __future__ import annotations

import numpy as np

from reynolds.problem import FilmSolution
from reynolds.solve.loads import point_fields


def natural_sizes(solution: FilmSolution) -> dict[str, float]:
    """Return sizes of moments, torques (N m), wall forces (N) and flows (m3/s) without cancellation by symmetry."""
    space = solution.problem.space
    fields = point_fields(solution)
    reach = float(np.abs(space.vertices).max())
    shear = (*fields.shear_moving, *fields.shear_fixed)
    friction = float(sum(np.sum(np.abs(part) * space.area) for part in shear))
    return {
        "moment": reach * float(np.sum(np.abs(fields.pressure) * space.area)),
        "friction": friction,
        "torque": reach * friction,
        "flow": natural_flow(solution),
    }


def natural_flow(solution: FilmSolution) -> float:
    """Return the size of flows within a film, m3/s: U h L of its walls, h^3 dp/(12 mu), and of its squeeze.

    L is the root of the film's area, dp the range of its pressure; U h and h^3/mu are means over the film.
    """
    film, area = solution.film, solution.problem.space.area
    total = float(area.sum())
    sliding = sum(
        float(np.sum(np.hypot(*wall) * film.thickness * area)) for wall in (film.velocity_moving, film.velocity_fixed)
    )
    conductance = float(np.sum(film.thickness**3 / (12.0 * film.viscosity) * area)) / total
    squeezed = float(np.abs(solution.storage_rate).sum())
    return float(sliding / np.sqrt(total)) + conductance * float(np.ptp(solution.pressure)) + squeezed
