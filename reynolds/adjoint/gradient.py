"""Derivatives of a steady film's outputs by its thickness at every place, by the adjoint.

For a film in balance, F(u; h) = 0, and an output J(u, h): dJ/dh = J_h - lambda^T F_h with F_u^T lambda = J_u. One
transposed solve gives the derivative by the thickness everywhere (Giles and Pierce 2000). The set of cavitated unknowns
is held: the derivative is one-sided where it changes (`weakly_active`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from reynolds.adjoint.outputs import Output
from reynolds.adjoint.solved import SolvedFilm, summed_at_vertices
from reynolds.adjoint.transposed import TransposedFilm
from reynolds.equation.balance import FilmState, operators
from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array
from reynolds.problem import ZERO, Cavitation, FilmSolution
from reynolds.solve.solver import FilmSolver

WEAK = 1e-6  # of the largest pressure above that of the cavity
HELD_FOR = 1e6  # s: of a storage step; shorter ones are of a film in time


@dataclass(frozen=True)
class FilmGradient:
    """Derivative of one output by the film thickness; `unit` is that of the output, SI.

    value: the output; at_points (cells, points): derivative per area by the thickness there, unit/m3; at_vertices
    (vertices,): derivative by the gap at a vertex where elastic walls touch, unit/m, else zero; by_squeeze (cells,
    points): derivative per area by the squeeze velocity there, unit s/m3. The derivative along a change dh of the film
    at constant squeeze is sum(at_points dh dA) + sum(at_vertices dh).
    """

    space: FilmSpace = field(repr=False)
    unit: str
    value: float
    at_points: Array
    at_vertices: Array
    by_squeeze: Array

    def along(self, growth: Array, at_vertices: Array | None = None, squeeze: Array = ZERO) -> float:
        """Derivative by a parameter by which the film grows as `growth` (cells | 1, points | 1), m per its unit.

        `at_vertices` (vertices,): the growth there; None: extrapolated, exact for a linear one. `squeeze` (cells | 1,
        points | 1), m/s per its unit: growth of the squeeze velocity, as of a profile that moves along the film.
        """
        total = float(np.sum((self.at_points * growth + self.by_squeeze * squeeze) * self.space.area))
        if self.at_vertices.any():
            at_vertices = self.space.to_vertices(growth) if at_vertices is None else at_vertices
            total += float(self.at_vertices @ at_vertices)
        return total

    @property
    def uniform(self) -> float:
        """Derivative by a film that is thicker by the same everywhere, unit/m: the integral of the density."""
        return self.along(np.ones((1, 1)), np.ones(len(self.at_vertices)))

    @property
    def nodal(self) -> Array:
        """Derivative by the thickness at each vertex, linear between them, (vertices,) unit/m."""
        return summed_at_vertices(self.space, self.at_points * self.space.area) + self.at_vertices

    @property
    def density(self) -> Array:
        """The same per area, (vertices,) unit/m3: independent of the mesh; dJ is the integral of density times dh."""
        return self.nodal / summed_at_vertices(self.space, self.space.area)


def film_gradients(
    solver: FilmSolver, solution: FilmSolution, outputs: Sequence[Output], weight: Array | None = None
) -> list[FilmGradient]:
    """The derivatives of outputs of a film in balance by its thickness, in their order; one linear solve for each.

    Exact at a constant set of cavitated unknowns, for each cavitation, oil whose viscosity and density depend on
    pressure, rough walls and elastic walls (h is then the gap before deformation). Wall velocities, squeeze velocity,
    viscosity at zero pressure and boundary values stay as they are. `weight` (cells | 1, 1) as in `loads`. Raises
    FilmInputError for a film in time and as the outputs, FilmNotConverged where the balance is singular. Source: Giles
    and Pierce 2000, An introduction to the adjoint approach to design.
    """
    _check(solution)
    weight = np.ones((1, 1)) if weight is None else weight
    state = solver.operators(solution)
    film = SolvedFilm(solution, state, weight)
    transposed = TransposedFilm(solver, film)
    return [_gradient(film, transposed, output) for output in outputs]


def _gradient(film: SolvedFilm, transposed: TransposedFilm, output: Output) -> FilmGradient:
    own = output.slopes(film)
    by_gap = own.by_gap
    by_pressure, by_fraction = own.by_pressure, own.by_fraction
    if own.through.any():  # an outflow is -R
        pressed, filled = transposed.exchanged(own.through)
        by_pressure, by_fraction = by_pressure - pressed, by_fraction - filled
        by_gap = by_gap - film.balance.lever(own.through)
    if film.problem.walls is not None:
        by_pressure = by_pressure + transposed.by_wall_pressure(film.on_vertices(by_gap))
    multipliers = transposed.multipliers(by_pressure, by_fraction)
    by_gap = by_gap - film.balance.lever(multipliers)
    swayed = film.on_vertices(by_gap)
    return FilmGradient(
        film.space,
        output.unit,
        own.value,
        by_gap / film.space.area,
        transposed.by_given_gap(swayed) - swayed,
        -film.balance.squeeze_lever(multipliers + own.through) / film.space.area,
    )


def held_gradient(gradient: FilmGradient, supported: Sequence[FilmGradient], growth: Sequence[Array]) -> FilmGradient:
    """The derivative of an output while the film moves so that it keeps other outputs: a loss at held load.

    `supported` (k): gradients of the outputs that are kept; `growth` (k) of (cells | 1, points | 1): growth of the film
    with each of as many free coordinates. Raises FilmInputError where these do not change the outputs that are kept.
    """
    slopes = np.array([[one.along(mode) for mode in growth] for one in supported])
    own = np.array([gradient.along(mode) for mode in growth])
    try:
        share = np.linalg.solve(slopes.T, own)
    except np.linalg.LinAlgError:
        found = "outputs that do not change with the coordinates"
        raise FilmInputError("held gradient", found, "as many coordinates as outputs that they change") from None
    pairs = list(zip(share, supported, strict=True))
    return replace(
        gradient,
        at_points=gradient.at_points - sum(part * one.at_points for part, one in pairs),
        at_vertices=gradient.at_vertices - sum(part * one.at_vertices for part, one in pairs),
        by_squeeze=gradient.by_squeeze - sum(part * one.by_squeeze for part, one in pairs),
    )


def weakly_active(solution: FilmSolution) -> NDArray[np.bool_]:
    """Unknowns (size,) at which the film neither bears pressure nor lacks oil, to 1e-6 of the largest pressure.

    The slightest change of the film may open or close the cavity there: derivatives are one-sided. Under JFO the lack
    of oil counts as the pressure that moves as much oil; under Reynolds' condition the oil that the cavity creates
    counts likewise.
    """
    problem = solution.problem
    if problem.cavitation is Cavitation.NONE:
        return np.zeros(problem.space.size, dtype=bool)
    parts = operators(problem, FilmState(solution.pressure, solution.film_fraction, solution.deformation))
    above = solution.pressure - problem.cavitation_pressure
    if problem.cavitation is Cavitation.JFO:
        lack = (1.0 - solution.film_fraction) * parts.lack
    else:
        stiff = parts.stiffness[problem.space.pattern.diagonal]
        lack = np.abs(solution.outflow) / np.where(stiff > 0.0, stiff, 1.0)
    larger = np.where(solution.cavity, lack, above)
    largest = max(float(np.abs(larger).max()), 1e-300)
    return np.asarray(~solution.held & (larger <= WEAK * largest))


def _check(solution: FilmSolution) -> None:
    problem = solution.problem
    if problem.storage is not None and problem.storage.step < HELD_FOR:
        found = f"one step of {problem.storage.step:.4g} s of a film in time"
        raise FilmInputError("film", found, "a steady film: the derivative of a step depends on the one before")
