"""Shear of oil and of touching asperities on the walls of a floating film, and the heat of both.

A floating film separates contact from its oil: asperities bear by the gap between mean planes, which may overlap, while
the thickness of the oil stays positive (`reynolds.equation.rough_overlap`). Rubbing follows the same rule.
"""

from dataclasses import dataclass, replace

import numpy as np

from reynolds.laws.contact import Asperities
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.loads import dissipated, point_fields
from reynolds.solve.rubbing import rubbing
from reynolds.thermal.shear_thinning import ShearLaw, newtonian

Vector = tuple[Array, Array]


@dataclass(frozen=True)
class Dissipation:
    """Dissipation of a film, W: flow driven by pressure, shear of the oil, rubbing of asperities."""

    flow: float
    shear: float
    rubbing: float

    @property
    def total(self) -> float:
        """All three."""
        return self.flow + self.shear + self.rubbing


@dataclass(frozen=True)
class WallShear:
    """Shear and contact on the walls of a film, at the quadrature points (cells, points) each.

    on_moving and on_fixed: shear (x, y) Pa on either wall, contact's included; contact: pressure of asperities,
    Pa; driven, sheared, rubbing: heat W of the flow that pressure drives, of sliding oil and of asperities; area
    elements m2; mixing: total heat W at the ends of a cavity.
    """

    on_moving: Vector
    on_fixed: Vector
    contact: Array
    driven: Array
    sheared: Array
    rubbing: Array
    area: Array
    mixing: float

    def heat(self, is_film: Array | float = 1.0) -> Dissipation:
        """Heat of oil and asperities; weighted by `is_film` (cells | 1, points | 1). Mixing counts as flow."""
        flow, shear, rubbing = (float(np.sum(part * is_film)) for part in (self.driven, self.sheared, self.rubbing))
        return Dissipation(flow + self.mixing, shear, rubbing)

    def load(self, is_film: Array | float = 1.0) -> float:
        """int p_contact dA, N."""
        return float(np.sum(self.contact * self.area * is_film))


def wall_shear(
    solution: FilmSolution, asperities: Asperities | None, gap: Array, thinning: ShearLaw = newtonian
) -> WallShear:
    """Shear and contact of a film and its asperities on the walls.

    `solution` is the film without asperities; `gap` (cells, points) m: the distance of the mean planes. Contact
    resists the sliding of the walls with `boundary_shear`; raises as the law of contact does. thinning: of the oil's
    viscosity at the rate of sliding, |U1 - U2|/h (1/s). It thins the stress of sliding alone: flow by pressure shears
    the oil ten times more slowly, and across the sliding.
    """
    solution = _thinned(solution, thinning)
    fields, area = point_fields(solution), solution.problem.space.area
    driven, sheared = dissipated(solution, fields.filled)
    mixing = float(np.sum(solution.pressure * solution.upwind_exchange))
    moving, fixed = fields.shear_moving, fields.shear_fixed
    contact = rubbing(solution.film, asperities, gap, area.shape)
    x, y = contact.resists
    return WallShear(
        (moving[0] - x, moving[1] - y), (fixed[0] + x, fixed[1] + y), contact.pressure, driven, sheared,
        contact.heat * area, area, mixing,
    )  # fmt: skip


def _thinned(solution: FilmSolution, thinning: ShearLaw) -> FilmSolution:
    """The solution whose oil slides with the viscosity at its shear rate."""
    if thinning is newtonian:
        return solution
    film = solution.film
    slip = (a - b for a, b in zip(film.velocity_moving, film.velocity_fixed, strict=True))
    viscosity = thinning(np.hypot(*slip) / film.thickness, film.sliding_viscosity)
    return replace(solution, film=replace(film, couette_viscosity=viscosity))
