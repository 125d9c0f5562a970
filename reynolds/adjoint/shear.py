"""Slopes of friction: the shear stress on a wall along given directions, integrated.

On a wall, as `point_fields` has it: -m theta h F_p grad p + theta mu/h (s f_c + F_s) slip + s rub, with m the wall's
share of the pressure gradient's stress, s = -1 on the moving and 1 on the fixed wall, f_c, F_s and F_p Patir and
Cheng's factors (between smooth walls 1, 0 and 1), rub the boundary friction of contact.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reynolds.adjoint.solved import OutputSlopes, SolvedFilm, slopes_of
from reynolds.laws.contact import boundary_shear, contact_pressure
from reynolds.laws.roughness import Directional, shear_factors
from reynolds.numerics.arrays import Array
from reynolds.solve.loads import point_fields

Vector = tuple[Array, Array]


@dataclass(frozen=True)
class _Factors:
    """Directions of a wall's friction turned by the factors of roughness: of the pressure gradient's stress and of
    the slip's, with their slopes by the film (1/m)."""

    pulled: Vector
    pulled_slope: Vector
    dragged: Vector
    dragged_slope: Vector


def shear_slopes(film: SolvedFilm, direction: Vector, *, on_moving: bool) -> OutputSlopes:
    """Integral of (shear . direction) on a wall, and its slopes; `direction` (cells | 1, points | 1), maybe m."""
    weighted = film.space.area * film.weight
    x, y = (part * weighted for part in direction)
    oil, share = film.film, film.film.moving_share if on_moving else 1.0 - film.film.moving_share
    by = _factors(film, (x, y), -1.0 if on_moving else 1.0)
    thickness, (_, *gradient) = oil.thickness, film.pressure
    pulled, dragged = -share * _dot(by.pulled, gradient), _dot(by.dragged, film.slip)
    drag = oil.sliding_viscosity / thickness
    by_film = film.filled * (
        pulled
        - share * thickness * _dot(by.pulled_slope, gradient)
        + drag * (_dot(by.dragged_slope, film.slip) - dragged / thickness)
    )
    driven = -share * thickness * film.filled
    by_pressure = film.along_gradients(driven * by.pulled[0], driven * by.pulled[1])
    by_pressure += film.on_unknowns(film.filled * drag * dragged * film.thickening)
    fields = point_fields(film.solution)
    stress = fields.shear_moving if on_moving else fields.shear_fixed
    return slopes_of(
        film,
        float(np.sum(stress[0] * x + stress[1] * y)),
        by_pressure=by_pressure,
        by_fraction=film.on_unknowns(thickness * pulled + drag * dragged),
        by_gap=film.widening * by_film + _rubbing(film, (x, y), -1.0 if on_moving else 1.0),
    )


def _factors(film: SolvedFilm, direction: Vector, sign: float) -> _Factors:
    surface, (x, y) = film.problem.surface, direction
    nothing = np.zeros_like(x)
    if surface is None:
        return _Factors((x, y), (nothing, nothing), (sign * x, sign * y), (nothing, nothing))
    factors = shear_factors(surface, film.film.thickness)
    couette, along = factors.couette, factors.sliding
    turned, steeper = _turned(along, direction)
    return _Factors(
        *_turned(factors.pressure, direction),
        (sign * couette.value * x + turned[0], sign * couette.value * y + turned[1]),
        (sign * couette.slope * x + steeper[0], sign * couette.slope * y + steeper[1]),
    )


def _turned(tensor: Directional, vector: Vector) -> tuple[Vector, Vector]:
    """A tensor times a vector, and its slope."""
    (x, y), (xx, xy, yy) = vector, tensor
    return (
        (xx.value * x + xy.value * y, xy.value * x + yy.value * y),
        (xx.slope * x + xy.slope * y, xy.slope * x + yy.slope * y),
    )


def _rubbing(film: SolvedFilm, direction: Vector, sign: float) -> Array | float:
    """Slope of the contact's boundary friction by the gap at the points."""
    asperities = film.problem.asperities
    if asperities is None:
        return 0.0
    bears = contact_pressure(asperities, film.solution.gap)
    speed = np.hypot(*film.slip)
    along = np.divide(_dot(direction, film.slip), speed, out=np.zeros_like(speed), where=speed > 0.0)
    return sign * boundary_shear(asperities, bears.value).slope * bears.slope * along


def _dot(one: Vector, other: Vector | list[Array]) -> Array:
    return np.asarray(one[0] * other[0] + one[1] * other[1])
