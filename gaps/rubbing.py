"""Shear of oil and of touching asperities on the walls of a floating film.

A floating film keeps contact apart from its oil: asperities bear by the gap between mean planes, which may
overlap, while the thickness of the oil stays positive (`reynolds.overlap`). Rubbing follows the same two.
"""

from __future__ import annotations

import numpy as np

from reynolds.contact import Asperities, boundary_shear, contact_pressure
from reynolds.film import FilmSolution
from reynolds.loads import point_fields
from reynolds.mesh import Array

Vector = tuple[Array, Array]


def wall_shear(solution: FilmSolution, asperities: Asperities | None, gap: Array) -> tuple[Vector, Vector]:
    """Shear stress (x, y) Pa on the moving and on the fixed wall at the quadrature points, contact's included.

    `solution` is the film without asperities, `gap` (cells, points) m the distance of the mean planes. Contact
    resists the sliding of the walls with `boundary_shear`; raises as the law of contact does.
    """
    fields, film = point_fields(solution), solution.film
    if asperities is None:
        return fields.shear_moving, fields.shear_fixed
    rubs = boundary_shear(asperities, contact_pressure(asperities, gap).value).value
    shape = gap.shape
    slip = [np.broadcast_to(a - b, shape) for a, b in zip(film.velocity_moving, film.velocity_fixed, strict=True)]
    speed = np.hypot(*slip)
    x, y = (rubs * np.divide(part, speed, out=np.zeros(shape), where=speed > 0.0) for part in slip)
    moving, fixed = fields.shear_moving, fields.shear_fixed
    return (moving[0] - x, moving[1] - y), (fixed[0] + x, fixed[1] + y)
