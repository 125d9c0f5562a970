"""Coefficients of the film equation at each point: conductance, flow with the walls, and oil content.

Values and, for Newton's method, their slopes by pressure and by film thickness, at the quadrature points.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from reynolds.equation.rough_overlap import film_between
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.fem.space import FilmSpace
from reynolds.laws.fluid import CONSTANT
from reynolds.laws.law import Tangent
from reynolds.laws.roughness import FlowFactors, Surface, flow_factors, mean_thickness_curvature
from reynolds.numerics.array_kernels import cubes
from reynolds.numerics.arrays import Array
from reynolds.problem import ZERO, Film, FilmProblem

WIDEST = 1e6  # times the given film: greatest deformation that counts as one
ONE = np.ones((1, 1))
SMALLEST_CONDUCTANCE = 1e-250  # m3/(Pa s): products of less are no longer numbers of full precision


Tensor = tuple[Array, Array, Array]
"""xx, yy and xy part of a symmetric tensor in the film plane."""


def isotropic(conductance: Array) -> Tensor:
    """The tensor of a conductance that is the same in every direction."""
    return conductance, conductance, ZERO


@dataclass(frozen=True)
class Transport:
    """Flow terms, each (cells | 1, points | 1); *_slope by thickness, by_pressure the relative one by pressure.

    film: under pressure; smooth: r h^3/(12 mu), m3/(Pa s), the conductance between smooth walls; factors: flow
    factors of roughness; widening: slope of the film by the gap between elastic walls that overlap, a factor of
    every *_slope (None: one).
    """

    film: Film
    smooth: Array
    by_pressure: Array
    surface: Surface | None
    factors: FlowFactors | None
    widening: Array | None = None

    @cached_property
    def conductance(self) -> Tensor:
        """r h^3/(12 mu) times the pressure flow factors, m3/(Pa s)."""
        if self.factors is None:
            return isotropic(self.smooth)
        factor = self.factors.pressure
        if factor.x is factor.y:
            return isotropic(self.smooth * factor.x.value)
        x, xy, y = (self.smooth * part.value for part in factor)
        return x, y, xy

    @cached_property
    def conductance_slope(self) -> Tensor:
        """Its slope, m2/(Pa s)."""
        steeper = 3.0 / self.film.thickness
        if self.factors is None:
            return isotropic(self._by_gap(steeper * self.smooth))
        smooth, factor = self._by_gap(self.smooth), self.factors.pressure
        if factor.x is factor.y:
            return isotropic(smooth * (factor.x.slope + steeper * factor.x.value))
        x, xy, y = (smooth * (part.slope + steeper * part.value) for part in factor)
        return x, y, xy

    @cached_property
    def flux(self) -> tuple[Array, Array]:
        """Couette flow h U of a full film along x and y, m2/s; between rough walls see `roughness`."""
        return self._with_walls(self._content.value, lambda part: part.value)

    @cached_property
    def flux_slope(self) -> tuple[Array, Array]:
        """Its slope, m/s."""
        x, y = self._with_walls(self._content.slope, lambda part: part.slope)
        return self._by_gap(x), self._by_gap(y)

    @property
    def content(self) -> Array:
        """Oil per area, m."""
        return self._content.value

    @property
    def content_slope(self) -> Array:
        """Its slope."""
        return self._by_gap(self._content.slope)

    @property
    def squeeze(self) -> Array:
        """Its rate, m/s."""
        still = self.film.squeeze.size == 1 and self.film.squeeze.item() == 0.0
        return self.film.squeeze if still else self.content_slope * self.film.squeeze

    @property
    def squeeze_slope(self) -> Array:
        """Its slope, 1/s: zero between smooth walls, whose film grows as the gap does."""
        if self.surface is None or not self.film.squeeze.any():
            return ZERO
        thickness, least = self.film.thickness, self.surface.lowest_ratio * self.surface.composite_roughness
        curved = mean_thickness_curvature(self.surface.composite_roughness, thickness)
        if self.widening is not None:  # the film is an exponential of the gap where walls overlap (`film_between`)
            overlap = np.where(thickness < least, self.widening / least, 0.0)
            curved = curved * self.widening**2 + self._content.slope * overlap
        return np.asarray(curved * self.film.squeeze)

    def _by_gap(self, slope: Array) -> Array:
        return slope if self.widening is None else slope * self.widening

    @cached_property
    def _content(self) -> Tangent:
        return Tangent(self.film.thickness, ONE) if self.factors is None else self.factors.content

    def _with_walls(self, content: Array, of: Callable[[Tangent], Array]) -> tuple[Array, Array]:
        u, v = self.film.mean_velocity
        if self.surface is None or self.factors is None:
            return _times(content, u), _times(content, v)
        half, shear = 0.5 * self.surface.composite_roughness, self.factors.shear
        slip_x, slip_y = (a - b for a, b in zip(self.film.velocity_moving, self.film.velocity_fixed, strict=True))
        return (
            content * u + half * (of(shear.x) * slip_x + of(shear.xy) * slip_y),
            content * v + half * (of(shear.xy) * slip_x + of(shear.y) * slip_y),
        )


def _times(content: Array, velocity: Array) -> Array:
    """Their product, (1, 1) where nothing moves."""
    return velocity if velocity.size == 1 and velocity.item() == 0.0 else content * velocity


def transport(problem: FilmProblem, pressure: Array, deformation: Array) -> Transport:
    """Flow terms of a film at nodal pressures (size,) Pa and a deformation (vertices,) m.

    Raises FilmInputError where the conductance underflows and where a law of the oil or of the walls does not
    hold, FilmNotConverged where no film is left between elastic walls.
    """
    film, widening = problem.film, None
    if problem.walls is not None:
        parted = _parted(problem, deformation)
        film, widening = replace(film, thickness=parted.value), parted.slope
    ratio, by_pressure = ONE, ZERO
    if problem.fluid is not CONSTANT:
        at = at_points(problem.space, pressure)
        mu, mu_slope = problem.fluid.viscosity(at, film.viscosity)
        ratio, ratio_slope = problem.fluid.density(at)
        by_pressure = ratio_slope / ratio - mu_slope / mu
        sliding = None if film.couette_viscosity is None else film.couette_viscosity * mu / film.viscosity
        film = replace(film, viscosity=mu, couette_viscosity=sliding)
    smooth = _conductance(film.thickness, ratio / (12.0 * film.viscosity))
    factors = None if problem.surface is None else flow_factors(problem.surface, film.thickness)
    return Transport(film, smooth, by_pressure, problem.surface, factors, widening)


def _parted(problem: FilmProblem, deformation: Array) -> Tangent:
    """Thickness (m) of a film whose walls deform by (vertices,) m, and its slope by the deformation."""
    given = problem.film.thickness
    film = film_between(problem, np.asarray(given + problem.space.sample_vertices(deformation)))
    least, most = float(film.value.min()), float(film.value.max())
    if not (least > 0.0 and most < WIDEST * np.abs(given).max()):
        raise FilmNotConverged(
            f"elastic walls leave {least:.3g} to {most:.3g} m of film", "a thicker film, stiffer walls, or contact"
        )
    return film


def along(tensor: Tensor, gradient: tuple[Array, Array]) -> tuple[Array, Array]:
    """A tensor times a gradient, both at the quadrature points."""
    xx, yy, xy = tensor
    return xx * gradient[0] + xy * gradient[1], xy * gradient[0] + yy * gradient[1]


def times(tensor: Tensor, field: Array) -> Tensor:
    """A tensor times a field."""
    xx, yy, xy = tensor
    if xx is yy:
        return isotropic(xx * field)
    return xx * field, yy * field, xy * field


def at_points(space: FilmSpace, nodal: Array) -> Array:
    """A nodal field (size,) at the quadrature points, (cells, points)."""
    return np.ascontiguousarray(nodal[space.dofs] @ space.reference.value.T)


def _conductance(thickness: Array, factor: Array) -> Array:
    """h^3 times a factor, (cells | 1, points | 1) m3/(Pa s)."""
    if factor.size == 1:
        found = np.empty(thickness.shape)
        least, most = cubes(thickness.ravel(), factor.item(), found.reshape(-1))
    else:
        with np.errstate(over="ignore"):  # an error below
            found = np.asarray(thickness * thickness * thickness * factor)
        least, most = found.min(), found.max()
    if not (least >= SMALLEST_CONDUCTANCE and most < np.inf):
        raise FilmInputError(
            "film",
            f"h^3/(12 mu) from {least:.3g} to {most:.3g} m3/(Pa s)",
            f"finite and at least {SMALLEST_CONDUCTANCE:g}",
        )
    return found
