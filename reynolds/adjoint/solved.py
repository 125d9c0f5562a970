"""A solved film with the operators for derivatives of its outputs, and the form of such derivatives."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from reynolds.equation.balance import FilmState, Operators
from reynolds.equation.coefficients import at_points
from reynolds.equation.thickness import ThicknessSlopes
from reynolds.fem import kernels
from reynolds.fem.space import FilmSpace
from reynolds.laws.fluid import CONSTANT
from reynolds.numerics.arrays import Array
from reynolds.problem import ZERO, Film, FilmProblem, FilmSolution
from reynolds.solve.loads import evaluate


@dataclass(frozen=True)
class SolvedFilm:
    """A film in balance with its operators; `weight` (cells | 1, 1) leaves cells out of friction and heat."""

    solution: FilmSolution
    parts: Operators
    weight: Array = field(default_factory=lambda: np.ones((1, 1)))

    @property
    def problem(self) -> FilmProblem:
        """Its problem."""
        return self.solution.problem

    @property
    def space(self) -> FilmSpace:
        """Its space."""
        return self.solution.problem.space

    @property
    def film(self) -> Film:
        """Film under pressure."""
        return self.solution.film

    @cached_property
    def balance(self) -> ThicknessSlopes:
        """Slopes of its flow balance by the thickness."""
        solution = self.solution
        state = FilmState(solution.pressure, solution.film_fraction, solution.deformation)
        return ThicknessSlopes(self.problem, self.parts, state)

    @cached_property
    def pressure(self) -> tuple[Array, Array, Array]:
        """Pressure (Pa) and its gradient (Pa/m) at the points, (cells, points) each."""
        return evaluate(self.solution, self.solution.pressure)

    @cached_property
    def filled(self) -> Array:
        """Film fraction at the points, (cells, points)."""
        return at_points(self.space, self.solution.film_fraction)

    @cached_property
    def slip(self) -> tuple[Array, Array]:
        """Velocity of the moving wall over the fixed one at the points (cells, points), m/s."""
        moving, fixed = self.film.velocity_moving, self.film.velocity_fixed
        x, y = (self.space.everywhere(one - two) for one, two in zip(moving, fixed, strict=True))
        return x, y

    @cached_property
    def thickening(self) -> Array:
        """Relative slope of the viscosity by pressure, (cells | 1, points | 1) 1/Pa."""
        if self.problem.fluid is CONSTANT:
            return ZERO
        value, slope = self.problem.fluid.viscosity(self.pressure[0], self.problem.film.viscosity)
        return np.asarray(slope / value)

    @property
    def widening(self) -> Array | float:
        """Growth of the film with the gap: below one only where rough elastic walls overlap."""
        found = self.parts.transport.widening
        return 1.0 if found is None else found

    def on_unknowns(self, at: Array) -> Array:
        """Sum over the points (cells, points) times the basis there, (size,)."""
        space = self.space
        local = np.broadcast_to(at, space.area.shape) @ space.reference.value
        return _summed(local, space.dofs, space.size)

    def along_gradients(self, x: Array, y: Array) -> Array:
        """Sum over the points (cells, points) times the gradient of the basis there along x and y, (size,)."""
        space, tensors = self.space, self.space.tensors
        less, size = np.zeros(space.size), np.zeros(space.size)
        for axis, part in enumerate((x, y)):
            flux = np.ascontiguousarray(np.broadcast_to(part, space.area.shape) / space.area)
            kernels.wall_outflow(
                space.dofs, tensors.shape, tensors.gradient[..., axis], flux, *space.reference.loops, less, size
            )
        return -less

    def on_vertices(self, at: Array) -> Array:
        """Sum over the points (cells, points) times the share of each vertex there, (vertices,)."""
        return summed_at_vertices(self.space, at)


def summed_at_vertices(space: FilmSpace, at: Array) -> Array:
    """Sum over the points (cells | 1, points | 1) times the linear share of each vertex there, (vertices,)."""
    local = np.broadcast_to(at, space.area.shape) @ space.reference.geometry_value
    return _summed(local, space.cells, len(space.vertices))


def _summed(local: Array, numbers: NDArray[np.int32], size: int) -> Array:
    return np.asarray(np.bincount(numbers.ravel(), weights=local.ravel(), minlength=size), dtype=float)


@dataclass(frozen=True)
class OutputSlopes:
    """An output and its slopes at constant other variables, SI.

    by_pressure and by_fraction (size,): by the unknowns; by_gap (cells, points): by the film at each point, the gap
    between elastic walls; through (size,): share of each unknown's outflow in the output, beside the others.
    """

    value: float
    by_pressure: Array
    by_fraction: Array
    by_gap: Array
    through: Array


def slopes_of(
    film: SolvedFilm,
    value: float,
    *,
    by_pressure: Array | None = None,
    by_fraction: Array | None = None,
    by_gap: Array | None = None,
    through: Array | None = None,
) -> OutputSlopes:
    """The slopes of an output; those left out are zero."""
    nodal, points = np.zeros(film.space.size), np.zeros(film.space.area.shape)
    return OutputSlopes(
        float(value),
        nodal if by_pressure is None else by_pressure,
        nodal if by_fraction is None else by_fraction,
        points if by_gap is None else points + by_gap,
        nodal if through is None else through,
    )
