"""Contact of the walls of a film: what their asperities bear, and the friction with which they resist sliding."""

from dataclasses import dataclass

import numpy as np

from reynolds.laws.contact import Asperities, boundary_shear, contact_pressure
from reynolds.numerics.arrays import Array
from reynolds.problem import Film


@dataclass(frozen=True)
class Rubbing:
    """Contact at the quadrature points, (cells, points) each.

    pressure and friction (its size), Pa; resists: friction (x, y) Pa along the sliding U1 - U2, that of the moving wall
    on the fixed one; heat W/m2.
    """

    pressure: Array
    friction: Array
    resists: tuple[Array, Array]
    heat: Array


def rubbing(film: Film, asperities: Asperities | None, gap: Array, shape: tuple[int, ...]) -> Rubbing:
    """Contact of walls that slide as those of `film`, at a `gap` of their mean planes (m), by `boundary_shear`.

    shape: (cells, points). Without asperities nothing touches. Raises as the law of contact does.
    """
    if asperities is None:
        nothing = np.zeros(shape)
        return Rubbing(nothing, nothing, (nothing, nothing), nothing)
    bears = np.broadcast_to(contact_pressure(asperities, gap).value, shape)
    rubs = boundary_shear(asperities, bears).value
    slip = [np.broadcast_to(a - b, shape) for a, b in zip(film.velocity_moving, film.velocity_fixed, strict=True)]
    speed = np.hypot(*slip)
    x, y = (rubs * np.divide(part, speed, out=np.zeros(shape), where=speed > 0.0) for part in slip)
    return Rubbing(bears, rubs, (x, y), rubs * speed)
