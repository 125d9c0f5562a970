"""Shear of oil and of touching asperities on the walls of a floating film, and the heat of both.

A floating film keeps contact apart from its oil: asperities bear by the gap between mean planes, which may
overlap, while the thickness of the oil stays positive (`reynolds.overlap`). Rubbing follows the same two.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reynolds.contact import Asperities, boundary_shear, contact_pressure
from reynolds.film import FilmSolution
from reynolds.loads import dissipated, point_fields
from reynolds.mesh import Array

Vector = tuple[Array, Array]


@dataclass(frozen=True)
class Heat:
    """What a film turns into heat, W: the flow that pressure drives, shear of the oil, rubbing of asperities."""

    flow: float
    shear: float
    rubbing: float

    @property
    def total(self) -> float:
        """All three."""
        return self.flow + self.shear + self.rubbing


def contact_stress(solution: FilmSolution, asperities: Asperities, gap: Array) -> tuple[Array, Vector]:
    """Contact pressure (Pa) at the quadrature points and the shear (Pa) by which it resists the moving wall.

    Contact resists the sliding of the walls with `boundary_shear`; raises as the law of contact does.
    """
    film, bears = solution.film, contact_pressure(asperities, gap).value
    rubs, shape = boundary_shear(asperities, bears).value, gap.shape
    slip = [np.broadcast_to(a - b, shape) for a, b in zip(film.velocity_moving, film.velocity_fixed, strict=True)]
    speed = np.hypot(*slip)
    x, y = (rubs * np.divide(part, speed, out=np.zeros(shape), where=speed > 0.0) for part in slip)
    return bears, (x, y)


def wall_shear(solution: FilmSolution, asperities: Asperities | None, gap: Array) -> tuple[Vector, Vector]:
    """Shear stress (x, y) Pa on the moving and on the fixed wall at the quadrature points, contact's included.

    `solution` is the film without asperities; `gap` (cells, points) m: the distance of the mean planes. Raises as
    `contact_stress`.
    """
    fields = point_fields(solution)
    if asperities is None:
        return fields.shear_moving, fields.shear_fixed
    _, (x, y) = contact_stress(solution, asperities, gap)
    moving, fixed = fields.shear_moving, fields.shear_fixed
    return (moving[0] - x, moving[1] - y), (fixed[0] + x, fixed[1] + y)


def heat(solution: FilmSolution, asperities: Asperities | None, gap: Array, is_film: Array | float = 1.0) -> Heat:
    """Heat of a film's oil and of its asperities; `is_film` (cells | 1, points | 1) weighs.

    Mixing at the ends of a cavity counts as flow.
    """
    driven, sliding = dissipated(solution)
    flow = float(np.sum(driven * is_film)) + float(np.sum(solution.pressure * solution.mixing))
    shear = float(np.sum(sliding * is_film))
    if asperities is None:
        return Heat(flow, shear, 0.0)
    film = solution.film
    _, (x, y) = contact_stress(solution, asperities, gap)
    slip = [a - b for a, b in zip(film.velocity_moving, film.velocity_fixed, strict=True)]
    rubbing = (x * slip[0] + y * slip[1]) * solution.problem.space.area * is_film
    return Heat(flow, shear, float(np.sum(rubbing)))


def contact_load(area: Array, asperities: Asperities | None, gap: Array) -> float:
    """int p_contact dA, N, by area elements (cells, points) m2."""
    return 0.0 if asperities is None else float(np.sum(contact_pressure(asperities, gap).value * area))
