"""What carries the oil at each point of a film: conductance to pressure, flow with the walls, and oil held.

Values and, for Newton's method, their slopes by pressure and by film thickness, at the quadrature points.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from reynolds import kernels
from reynolds.errors import FilmInputError
from reynolds.film import Film, FilmProblem
from reynolds.fluid import CONSTANT
from reynolds.mesh import Array
from reynolds.space import FilmSpace

SMALLEST_CONDUCTANCE = 1e-250  # m3/(Pa s): products of less are no longer numbers of full precision


@dataclass(frozen=True)
class Transport:
    """Flow terms, each (cells | 1, points | 1).

    film: as it is under pressure; conductance r h^3/(12 mu) along x and y, m3/(Pa s); flux h U along x, y, m2/s,
    by which the walls carry a full film; content: oil per area, m; squeeze: its rate, m/s. by_pressure and
    by_thickness: relative slopes of the conductance, 1/Pa and 1/m.
    """

    film: Film
    conductance: tuple[Array, Array]
    flux: tuple[Array, Array]
    content: Array
    squeeze: Array
    by_pressure: Array
    by_thickness: Array
    flux_by_thickness: tuple[Array, Array]
    content_by_thickness: Array


def transport(problem: FilmProblem, pressure: Array, opening: Array) -> Transport:
    """Flow terms of a film at nodal pressures (size,) Pa and with its walls opened at the vertices (vertices,) m.

    Raises FilmInputError where the conductance is no number of full precision and where no film is left.
    """
    film, space = problem.film, problem.space
    h = film.thickness
    if problem.walls is not None:
        h = h + space.sample_vertices(opening)
        if h.min() <= 0.0:
            raise FilmInputError("film thickness", f"{h.min():.3g} m between walls that give way", "a film left")
    mu, mu_slope = film.viscosity, np.zeros((1, 1))
    ratio, ratio_slope = np.ones((1, 1)), np.zeros((1, 1))
    if problem.fluid is not CONSTANT:
        at = at_points(space, pressure)
        mu, mu_slope = problem.fluid.viscosity(at, film.viscosity)
        ratio, ratio_slope = problem.fluid.density(at)
    with np.errstate(over="ignore"):  # told of in words
        conductance = ratio * h**3 / (12.0 * mu)
    _check_conductance(conductance)
    sliding = None if film.couette_viscosity is None else film.couette_viscosity * mu / film.viscosity
    u, v = film.mean_velocity
    return Transport(
        film=replace(film, thickness=h, viscosity=mu, couette_viscosity=sliding),
        conductance=(conductance, conductance),
        flux=(h * u, h * v),
        content=h,
        squeeze=film.squeeze,
        by_pressure=ratio_slope / ratio - mu_slope / mu,
        by_thickness=3.0 / h,
        flux_by_thickness=(u, v),
        content_by_thickness=np.ones((1, 1)),
    )


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
