"""Laws of rough walls by the distance of their mean planes, as one table that compiled loops read.

Film thickness, flow factors, mean thickness and contact pressure are functions of the gap alone. Their published forms
(`laws`) are evaluated once, at knots that lie dense where walls touch; between knots cubic Hermite polynomials of
values and slopes follow them to some 1e-9, and their slopes are those of the polynomials: Newton's method has one
consistent function.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from reynolds.equation.rough_overlap import film_at
from reynolds.laws.contact import LOWEST_RATIO, Asperities, contact_pressure
from reynolds.laws.law import Tangent
from reynolds.laws.roughness import Surface, flow_factors
from reynolds.numerics.arrays import Array

KNOTS = 4096
THINNEST = 1e-4  # standard deviations: the first knot where nothing touches, since laws of rough walls end above zero
WITHIN = 1.0 - 1e-12  # of the deepest contact: round-off of the first knot does not lead beyond its law
MIDDLE = 12.0  # standard deviations above the first knot: half of the knots lie below
FILM, CONDUCTION, CONTENT, SHEAR, CONTACT = range(5)
"""Columns: film less gap, m; pressure flow factor; mean thickness less film, m; sigma phi_s/2, m; contact, Pa."""


class GapTable(NamedTuple):
    """A table over u = x/(x + middle), x = gap - start, at u = k/knots; without knots walls are smooth.

    values (knots, 5) and rises (knots, 5), the slopes by u times the distance of the knots; start, middle m.
    """

    start: float
    middle: float
    values: Array
    rises: Array


SMOOTH = GapTable(0.0, 1.0, np.zeros((0, 5)), np.zeros((0, 5)))
"""Smooth walls: the film is the gap, every factor one, no contact."""


def is_isotropic(surface: Surface | None) -> bool:
    """True if the roughness has no direction: its flow factors are then numbers."""
    return surface is None or surface.peklenik == (1.0, 1.0)


@lru_cache(maxsize=16)
def gap_table(surface: Surface | None, asperities: Asperities | None, *, elastic: bool) -> GapTable:
    """The table of walls without direction of their roughness (`is_isotropic`); `elastic` walls keep a film open.

    Range: from the lowest gap of contact (six standard deviations of the summits below their mean plane), or from zero
    without contact, to any gap. Sources: Patir and Cheng 1978, 1979; Greenwood and Tripp 1970-71.
    """
    if surface is None and asperities is None:
        return SMOOTH
    sigma = 0.0 if surface is None else surface.composite_roughness
    start = THINNEST * sigma
    if asperities is not None:
        start = asperities.summit_height + WITHIN * LOWEST_RATIO * asperities.height
        sigma = max(sigma, asperities.height)
    share = np.arange(KNOTS) / KNOTS
    middle = MIDDLE * sigma
    if surface is not None:  # where the published range ends curvatures jump: a knot
        below = surface.lowest_ratio * surface.composite_roughness - start
        middle = below * (KNOTS / round(KNOTS * below / (below + middle)) - 1.0)
    gap = start + middle * share / (1.0 - share)
    columns = _columns(surface, asperities, elastic, gap)
    per_knot = (middle / (1.0 - share) ** 2 / KNOTS)[:, None]
    values = np.column_stack([column.value for column in columns])
    rises = np.column_stack([column.slope for column in columns]) * per_knot
    return GapTable(start, middle, np.ascontiguousarray(values), np.ascontiguousarray(rises))


def _columns(surface: Surface | None, asperities: Asperities | None, elastic: bool, gap: Array) -> tuple[Tangent, ...]:
    """The columns with their slopes by the gap."""
    nothing = Tangent(np.zeros_like(gap), np.zeros_like(gap))
    film = film_at(surface, asperities, elastic, gap)
    widening = np.broadcast_to(film.slope, gap.shape)
    conduction, content, shear = Tangent(np.ones_like(gap), np.zeros_like(gap)), nothing, nothing
    if surface is not None:
        factors, half = flow_factors(surface, film.value), 0.5 * surface.composite_roughness
        conduction = Tangent(factors.pressure.x.value, factors.pressure.x.slope * widening)
        content = Tangent(factors.content.value - film.value, (factors.content.slope - 1.0) * widening)
        shear = Tangent(half * factors.shear.x.value, half * factors.shear.x.slope * widening)
    contact = nothing if asperities is None else contact_pressure(asperities, gap)
    return Tangent(film.value - gap, widening - 1.0), conduction, content, shear, contact
