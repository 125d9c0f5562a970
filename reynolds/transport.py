"""What carries the oil at each point of a film: conductance to pressure, flow with the walls, and oil held.

Values and, for Newton's method, their slopes by pressure and by film thickness, at the quadrature points.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from reynolds import kernels
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.film import Film, FilmProblem
from reynolds.fluid import CONSTANT
from reynolds.laws import Tangent
from reynolds.mesh import Array
from reynolds.roughness import flow_factors
from reynolds.space import FilmSpace

WIDEST = 1e6  # times the given film: walls that open further were meant to be stiffer
SMALLEST_CONDUCTANCE = 1e-250  # m3/(Pa s): products of less are no longer numbers of full precision


Tensor = tuple[Array, Array, Array]
"""xx, yy and xy part of a symmetric tensor in the film plane."""


def isotropic(conductance: Array) -> Tensor:
    """The tensor of a conductance that is the same in every direction."""
    return conductance, conductance, np.zeros((1, 1))


@dataclass(frozen=True)
class Transport:
    """Flow terms, each (cells | 1, points | 1); *_slope by thickness, by_pressure the relative one by pressure.

    film: as it is under pressure; conductance r h^3/(12 mu) times pressure flow factors, m3/(Pa s); flux h U along
    x and y by which the walls carry a full film, m2/s; content: oil per area, m; squeeze: its rate, m/s.
    """

    film: Film
    conductance: Tensor
    conductance_slope: Tensor
    by_pressure: Array
    flux: tuple[Array, Array]
    flux_slope: tuple[Array, Array]
    content: Array
    content_slope: Array
    squeeze: Array


def transport(problem: FilmProblem, pressure: Array, opening: Array) -> Transport:
    """Flow terms of a film at nodal pressures (size,) Pa and with its walls opened at the vertices (vertices,) m.

    Raises FilmInputError where the conductance is no number of full precision and where a law of the oil or of the
    walls does not hold, FilmNotConverged where no film is left between walls that give way.
    """
    film, space = problem.film, problem.space
    h = film.thickness
    if problem.walls is not None:
        h = h + space.sample_vertices(opening)
        if not (h.min() > 0.0 and h.max() < WIDEST * np.abs(film.thickness).max()):
            raise FilmNotConverged(
                f"walls that give way leave {h.min():.3g} to {h.max():.3g} m of film",
                "a thicker film, stiffer walls, or contact",
            )
    mu, mu_slope = film.viscosity, np.zeros((1, 1))
    ratio, ratio_slope = np.ones((1, 1)), np.zeros((1, 1))
    if problem.fluid is not CONSTANT:
        at = at_points(space, pressure)
        mu, mu_slope = problem.fluid.viscosity(at, film.viscosity)
        ratio, ratio_slope = problem.fluid.density(at)
    with np.errstate(over="ignore"):  # told of in words
        smooth = ratio * (h * h * h) / (12.0 * mu)
    _check_conductance(smooth)
    sliding = None if film.couette_viscosity is None else film.couette_viscosity * mu / film.viscosity
    conductance, conductance_slope, flux, flux_slope, content = _between_walls(problem, h, smooth)
    return Transport(
        film=replace(film, thickness=h, viscosity=mu, couette_viscosity=sliding),
        conductance=conductance,
        conductance_slope=conductance_slope,
        by_pressure=ratio_slope / ratio - mu_slope / mu,
        flux=flux,
        flux_slope=flux_slope,
        content=content.value,
        content_slope=content.slope,
        squeeze=content.slope * film.squeeze,
    )


def _between_walls(
    problem: FilmProblem, h: Array, smooth: Array
) -> tuple[Tensor, Tensor, tuple[Array, Array], tuple[Array, Array], Tangent]:
    """Conductance, flux, their slopes, and content of a film between smooth walls or rough ones."""
    mean, one = problem.film.mean_velocity, np.ones((1, 1))
    if problem.surface is None:
        return isotropic(smooth), isotropic(3.0 * smooth / h), _times(h, mean), mean, Tangent(h, one)
    factors = flow_factors(problem.surface, h)
    parts = (factors.pressure.x, factors.pressure.y, factors.pressure.xy)
    values = tuple(smooth * part.value for part in parts)
    slopes = tuple(smooth * (part.slope + 3.0 * part.value / h) for part in parts)
    flux, flux_slope = [], []
    half = 0.5 * problem.surface.composite_roughness
    u, v = (a - b for a, b in zip(problem.film.velocity_moving, problem.film.velocity_fixed, strict=True))
    shear = factors.shear
    for velocity, along, across in ((mean[0], shear.x, shear.xy), (mean[1], shear.xy, shear.y)):
        flux.append(factors.content.value * velocity + half * (along.value * u + across.value * v))
        flux_slope.append(factors.content.slope * velocity + half * (along.slope * u + across.slope * v))
    return (
        (values[0], values[1], values[2]), (slopes[0], slopes[1], slopes[2]), (flux[0], flux[1]),
        (flux_slope[0], flux_slope[1]), factors.content,
    )  # fmt: skip


def _times(h: Array, velocity: tuple[Array, Array]) -> tuple[Array, Array]:
    return h * velocity[0], h * velocity[1]


def along(tensor: Tensor, gradient: tuple[Array, Array]) -> tuple[Array, Array]:
    """A tensor times a gradient, both at the quadrature points."""
    xx, yy, xy = tensor
    return xx * gradient[0] + xy * gradient[1], xy * gradient[0] + yy * gradient[1]


def at_points(space: FilmSpace, nodal: Array) -> Array:
    """A nodal field (size,) at the quadrature points, (cells, points)."""
    return np.ascontiguousarray(nodal[space.dofs] @ space.reference.value.T)


def lumped(space: FilmSpace, field: Array) -> Array:
    """Integral of a field times the basis of each unknown, (size,): the field's unit times m2."""
    out = np.empty(space.size)
    kernels.lump(space.dofs, space.reference.value, space.area, field, out)
    return out


def _check_conductance(conductance: Array) -> None:
    if not (conductance.min() >= SMALLEST_CONDUCTANCE and np.isfinite(conductance).all()):
        found = f"h^3/(12 mu) from {conductance.min():.3g} to {conductance.max():.3g} m3/(Pa s)"
        raise FilmInputError("film", found, f"finite and at least {SMALLEST_CONDUCTANCE:g}")
