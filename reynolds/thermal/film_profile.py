"""The profile across the film: levels of zeta = z/h, and the flow profile of a viscosity that varies over them.

Across the film a field is a polynomial through a few levels: the Gauss points of (0, 1), where the equations hold
(orthogonal collocation, Villadsen and Stewart 1967), and the two walls. zeta is 0 on the fixed wall and 1 on
the moving one. With the fluidity 1/mu at the levels the generalised Reynolds equation (Dowson 1962) has

    f0 = int 1/mu,  zbar = int zeta/mu / f0,  f2 = int zeta (zeta - zbar)/mu          (zeta from 0 to 1)
    u  = U_fixed + (U_moving - U_fixed) c  -  (h^2 grad p) g,
    c  = int_0^zeta 1/mu / f0,   g = - int_0^zeta (zeta' - zbar)/mu

so that viscosity = 1/(12 f2), couette_viscosity = 1/f0 and moving_share = int c = 1 - zbar of a `Film`.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array
from reynolds.problem import Film, FilmSolution
from reynolds.solve.loads import evaluate

DEFAULT_LEVELS = 6
MOST_LEVELS = 40
SAMPLES = 16  # of each level, among which the maximum of a profile is sought


@dataclass(frozen=True)
class FilmLevels:
    """Collocation across the film, all over zeta in (0, 1).

    place (m + 2,): fixed wall, m Gauss points, moving wall; weights (m,) of the Gauss points. Of a field at the
    Gauss points: derivative (m, m), running integral from 0 (m, m). Of one at all levels: second derivative at the
    Gauss points (m, m + 2), slope at the two walls (2, m + 2).
    """

    place: Array
    weights: Array
    derivative: Array
    integral: Array
    second: Array
    wall_slope: Array

    @property
    def inner(self) -> Array:
        """The Gauss points (m,)."""
        return self.place[1:-1]

    def at(self, field: Array, zeta: float | Array) -> Array:
        """A field at all levels (..., m + 2) anywhere across the film, (..., places)."""
        weights = _modes(np.atleast_1d(zeta), len(self.place)) @ np.linalg.inv(_modes(self.place, len(self.place)))
        return np.asarray(field @ weights.T)

    def mean(self, field: Array) -> Array:
        """Mean over the film's thickness of a field at all levels, (...,)."""
        return np.asarray(field[..., 1:-1] @ self.weights)

    def highest(self, field: Array) -> Array:
        """Maximum over the film's thickness of fields at all levels (size, m + 2), (size,).

        That of the polynomial through the levels. Beside a jump, as of hot inflow between cold walls, the polynomial
        overshoots: above the chord between two levels it counts up to twice the bend of the flatter one of the two
        parabolas through them and a third level.
        """
        zeta = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, SAMPLES * len(self.place) + 1))
        sampled = self.at(field, zeta)
        at, value = _vertex(zeta, sampled, np.clip(sampled.argmax(axis=1), 1, len(zeta) - 2))
        cell = np.clip(np.searchsorted(self.place, at, side="right") - 1, 0, len(self.place) - 2)
        slopes = np.diff(field, axis=1) / np.diff(self.place)
        bends = np.diff(slopes, axis=1) / (self.place[2:] - self.place[:-2])
        last, rows = bends.shape[1] - 1, np.arange(len(field))
        bend = np.maximum(bends[rows, np.clip(cell - 1, 0, last)], bends[rows, np.clip(cell, 0, last)])
        before, after = at - self.place[cell], self.place[cell + 1] - at
        chord = field[rows, cell] + slopes[rows, cell] * before
        trusted = np.minimum(value, chord + 2.0 * np.maximum(-bend, 0.0) * before * after)
        return np.asarray(np.maximum(field.max(axis=1), trusted))


def _vertex(zeta: Array, sampled: Array, top: NDArray[np.int64]) -> tuple[Array, Array]:
    """Place and value (size,) of the maximum of the parabola through the samples about `top`, between its outer two."""
    about = top[:, None] + np.arange(-1, 2)
    x, y = zeta[about], np.take_along_axis(sampled, about, axis=1)
    before, after = (y[:, 1] - y[:, 0]) / (x[:, 1] - x[:, 0]), (y[:, 2] - y[:, 1]) / (x[:, 2] - x[:, 1])
    bend = (after - before) / (x[:, 2] - x[:, 0])
    slope = np.divide(-before, 2.0 * bend, out=np.full_like(bend, np.inf), where=bend < 0.0)
    at = np.where(bend < 0.0, 0.5 * (x[:, 0] + x[:, 1]) + slope, x[np.arange(len(x)), y.argmax(axis=1)])
    at = np.clip(at, x[:, 0], x[:, 2])
    return at, y[:, 0] + (at - x[:, 0]) * (before + bend * (at - x[:, 1]))


@lru_cache
def levels(count: int = DEFAULT_LEVELS) -> FilmLevels:
    """`count` Gauss points across the film, and the walls. Raises FilmInputError outside 2 .. 40."""
    if not 2 <= count <= MOST_LEVELS:
        raise FilmInputError("levels across the film", f"{count}", f"2 to {MOST_LEVELS}")
    nodes, weights = legendre.leggauss(count)
    inner = 0.5 * (nodes + 1.0)
    place = np.concatenate([[0.0], inner, [1.0]])
    from_inner = np.linalg.inv(_modes(inner, count))
    from_all = np.linalg.inv(_modes(place, count + 2))
    return FilmLevels(
        place=place,
        weights=0.5 * weights,
        derivative=_modes(inner, count, 1) @ from_inner,
        integral=_modes(inner, count, -1) @ from_inner,
        second=_modes(inner, count + 2, 2) @ from_all,
        wall_slope=_modes(np.array([0.0, 1.0]), count + 2, 1) @ from_all,
    )


def _modes(zeta: Array, count: int, order: int = 0) -> Array:
    """Legendre modes on (0, 1) or a derivative of them (order -1: the integral from 0), (places, count)."""
    x = 2.0 * zeta - 1.0
    modes: Array = np.eye(count)
    if order < 0:
        modes = np.asarray(legendre.legint(modes, lbnd=-1.0, scl=0.5), dtype=float)
    elif order > 0:
        modes = np.asarray(legendre.legder(modes, order, scl=2.0), dtype=float)
    return np.asarray(legendre.legval(x, modes), dtype=float).T


@dataclass(frozen=True)
class FlowProfile:
    """Distribution of the flow over the film at each unknown; shapes (size, m) at the Gauss points, of mean one.

    viscosity, couette_viscosity (Pa s) and moving_share (size,) as in `Film`; `sliding` the velocity from
    the moving wall's motion over its mean, `fixed` that from the fixed wall's, `driven` that from the pressure
    gradient. Dissipation is spread likewise: `sliding_heat`, `driven_heat`, and `mixed_heat` of their product,
    which has the mean zero: the mixed part per area is 2 h (U_moving - U_fixed) . grad p mixed_heat.
    """

    levels: FilmLevels
    viscosity: Array
    couette_viscosity: Array
    moving_share: Array
    sliding: Array
    fixed: Array
    driven: Array
    sliding_heat: Array
    driven_heat: Array
    mixed_heat: Array


def dowson(across: FilmLevels, viscosity: Array) -> FlowProfile:
    """The profile of a viscosity (size, m) Pa s at the Gauss points (Dowson 1962).

    Integrals by Gauss quadrature: exact for a fluidity of degree m. Raises FilmInputError for a viscosity that is
    not positive.
    """
    if not (np.isfinite(viscosity).all() and viscosity.min() > 0.0):
        raise FilmInputError("viscosity across the film", f"minimum {viscosity.min():.4g} Pa s", "positive")
    fluidity, weights, zeta = 1.0 / viscosity, across.weights, across.inner
    f0 = fluidity @ weights
    from_centre = zeta - ((fluidity * zeta) @ weights / f0)[:, None]
    bending = fluidity * from_centre
    f2 = bending * zeta @ weights
    couette = fluidity @ across.integral.T / f0[:, None]
    share = couette @ weights
    driven = -bending @ across.integral.T
    return FlowProfile(
        levels=across,
        viscosity=1.0 / (12.0 * f2),
        couette_viscosity=1.0 / f0,
        moving_share=share,
        sliding=couette / share[:, None],
        fixed=(1.0 - couette) / (1.0 - share)[:, None],
        driven=driven / (driven @ weights)[:, None],
        sliding_heat=fluidity / f0[:, None],
        driven_heat=bending * from_centre / f2[:, None],
        mixed_heat=bending / f0[:, None],
    )


def film_with(film: Film, space: FilmSpace, profile: FlowProfile) -> Film:
    """The same film with the viscosities and the moving wall's share of a profile, between unknowns linear."""
    viscosity, couette, share = (
        space.sample_vertices(nodal[space.vertex_dofs])
        for nodal in (profile.viscosity, profile.couette_viscosity, profile.moving_share)
    )
    return replace(film, viscosity=viscosity, couette_viscosity=couette, moving_share=share)


def scaled(profile: FlowProfile, viscosity: Array) -> FlowProfile:
    """The profile of shares of a viscosity (size,) Pa s that does not vary across the film, in Pa s."""
    return replace(
        profile, viscosity=viscosity * profile.viscosity, couette_viscosity=viscosity * profile.couette_viscosity
    )


def shear_rate(solution: FilmSolution, profile: FlowProfile) -> Array:
    """Magnitude of du/dz at each unknown and Gauss point across the film, (size, m) 1/s.

    `profile` is that of the solution's film, in Pa s. The slopes of film and pressure are averaged over the cells
    at an unknown (second order where the film is smooth, first order at a step).
    """
    film, space = solution.film, solution.problem.space
    _, *gradient = evaluate(solution, solution.pressure)
    by_pressure = profile.mixed_heat / profile.couette_viscosity[:, None]  # (zeta - zbar)/mu
    square = np.zeros_like(by_pressure)
    for moving, fixed, slope in zip(film.velocity_moving, film.velocity_fixed, gradient, strict=True):
        slid = space.to_unknowns((moving - fixed) / film.thickness)
        driven = space.to_unknowns(film.thickness * slope)
        square += (profile.sliding_heat * slid[:, None] + by_pressure * driven[:, None]) ** 2
    return np.sqrt(square)


def velocity(profile: FlowProfile, thickness: Array, moving: Array, fixed: Array, gradient: Array) -> Array:
    """Velocity along one direction at the Gauss points, (size, m) m/s.

    From the film thickness (size,) m, the walls' velocities (size,) m/s and the pressure gradient (size,) Pa/m.
    """
    share = profile.moving_share
    driven = -(thickness**2) / (12.0 * profile.viscosity) * gradient
    return np.asarray(
        profile.driven * driven[:, None]
        + profile.sliding * (share * moving)[:, None]
        + profile.fixed * ((1.0 - share) * fixed)[:, None]
    )
