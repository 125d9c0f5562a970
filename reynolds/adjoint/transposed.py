"""Transposed solves of a film's linearised balance: lambda with F_u^T lambda = J_u.

The matrix is that of the last Newton step. Between rigid walls, of constant oil without a cavity that conserves oil, it
is symmetric, and its factor exists. Else the transposed matrix is factorised once for all outputs; on a large grid the
transposed iteration of `CavitatedFilm` solves it. Between elastic walls F_u = A + B C: GMRES (Saad and Schultz 1986) on
the transpose, with the dense factor of the Newton matrix up to DENSE_LIMIT free pressures and the factor of A beyond. B
is exact there: with the change of a cavity's upwinding.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from reynolds.adjoint.solved import SolvedFilm
from reynolds.bodies.compliance import columns_of, transposed_product
from reynolds.equation.balance import by_deformation, slopes
from reynolds.equation.deformation import Touch, deformation_slope, touch_at
from reynolds.equation.deformation_sparsity import ElasticPatterns
from reynolds.errors import FilmNotConverged
from reynolds.fem import kernels
from reynolds.linear.cavitated import CavitatedFilm
from reynolds.linear.elastic import DENSE_LIMIT, dense_answer
from reynolds.linear.factor import GeneralFactor
from reynolds.linear.multigrid.grid import grid_of
from reynolds.numerics.arrays import Array
from reynolds.numerics.gmres import gmres
from reynolds.problem import Cavitation
from reynolds.solve.boundary import spread
from reynolds.solve.iterate import is_linear, iterate_of
from reynolds.solve.newton import general_step
from reynolds.solve.solver import FilmSolver

TOLERANCE = 1e-11  # of the load
GOOD_ENOUGH = 1e-9  # where round-off allows no less
MOST_STEPS = 150  # of GMRES with the factor of rigid walls; with one that needs more the dense factor is cheaper
FELT = 1e-10  # of the steepest contact: less counts as none
LARGE = 3000  # unknowns of a grid: below, the elimination of the transposed matrix is as fast as iterations
Solve = Callable[[Array], Array]


class TransposedFilm:
    """The transposed linearised balance of a solved film; factors are made once, on first use."""

    def __init__(self, solver: FilmSolver, film: SolvedFilm) -> None:
        """`solver` is that of the film: its last factor is used where it serves."""
        solution, problem = film.solution, film.problem
        self._solver, self._film = solver, film
        self._touch = _touch_of(film)
        self._fixed: NDArray[np.bool_] = solution.held.copy()
        if problem.cavitation is Cavitation.REYNOLDS:
            self._fixed |= solution.cavity

    def exchanged(self, weight: Array) -> tuple[Array, Array]:
        """sum_i weight_i dR_i by each unknown's pressure and film fraction between rigid walls, (size,) each.

        R is without the feeds of pockets.
        """
        film, pattern = self._film, self._film.space.pattern
        by = slopes(film.problem, film.parts, film.balance.state)

        def product(upper: Array, lower: Array, gain: Array) -> Array:
            out, size = np.zeros(len(weight)), np.zeros(len(weight))
            kernels.convect(pattern.indptr, pattern.indices, lower, upper, weight, out, size)
            return np.asarray(out + gain * weight)

        return product(*by.by_pressure), product(*by.by_fraction)

    def by_given_gap(self, force: Array) -> Array:
        """Slopes of an output by the gap of undeformed walls, from `force`, those by the gap in balance; (vertices,).

        The pressures are held; contact that closes as the gap opens deforms elastic walls.
        """
        return force if self._touch is None else self._touch.settled_transposed(force)

    def by_wall_pressure(self, force: Array) -> Array:
        """Slopes of an output by pressure, (size,), from `force` (vertices,), those by the gap of elastic walls."""
        walls = self._film.problem.walls
        if walls is None:
            return np.zeros(self._film.space.size)
        return transposed_product(walls.matrix, self.by_given_gap(force))

    def multipliers(self, by_pressure: Array, by_fraction: Array) -> Array:
        """lambda (size,) with F_u^T lambda = J_u, slopes by pressure and film fraction; zero where an unknown is held.

        Raises FilmNotConverged where the balance is singular.
        """
        solution = self._film.solution
        conserves = self._film.problem.cavitation is Cavitation.JFO and bool(solution.cavity.any())
        if is_linear(self._film.problem) and not conserves:
            load = np.where(self._fixed, 0.0, by_pressure)
            return self._solver.response(solution, load[:, None])[0][:, 0]
        _, _, scale, unit = self._step
        load = np.where(solution.cavity, scale * by_fraction, by_pressure)
        return self._solve(np.where(self._fixed, 0.0, load)) / unit

    @cached_property
    def _step(self) -> tuple[Array, Array, float, float]:
        """Upper triangle and mirror of the Newton matrix, scale of the film fractions, unit of the balance."""
        film = self._film
        at = iterate_of(film.problem, film.balance.state, film.solution.cavity)
        upper, lower, _, scale = general_step(film.problem, spread(film.problem), at)
        return upper, lower, scale, float(np.abs(at.parts.stiffness).max()) or 1.0

    def _solve(self, load: Array) -> Array:
        if self._film.problem.walls is not None:
            return self._compliant(load)
        if self._on_grid is not None:
            found, effort = self._on_grid.solve(load, TOLERANCE, transposed=True)
            if effort.left <= GOOD_ENOUGH:
                return found
        return self._eliminated.solve(load, TOLERANCE)

    @cached_property
    def _on_grid(self) -> CavitatedFilm | None:
        """The Newton matrix of a large film on a grid; None without a grid or where it cannot be preconditioned."""
        grid = grid_of(self._film.space)
        if grid is None or self._film.space.size < LARGE:
            return None
        upper, lower, _, _ = self._step
        film = CavitatedFilm(grid, self._film.space.matrix(upper))
        return film if film.update(upper, lower, self._film.solution.cavity) else None

    @cached_property
    def _eliminated(self) -> GeneralFactor:
        """A factor of the transposed Newton matrix."""
        upper, lower, _, _ = self._step
        factor = GeneralFactor()
        factor.update(self._film.space.matrix(lower), upper)
        return factor

    @cached_property
    def _rigid(self) -> csc_array:
        """The transposed Newton matrix between rigid walls."""
        upper, lower, _, _ = self._step
        return ElasticPatterns(self._film.space).full_matrix(lower, upper)

    @cached_property
    def _free(self) -> Array:
        """One where an unknown is a pressure to be solved for, (size,)."""
        return np.where(self._fixed | self._film.solution.cavity, 0.0, 1.0)

    def _compliant(self, load: Array) -> Array:
        """The same between elastic walls."""
        rows = np.abs(self._rigid.diagonal())  # in a thin film next to nothing flows
        rows = np.where(rows > 0.0, rows, 1.0)
        for before in self._factors():
            image = partial(self._image, before, rows)
            part, left = gmres(image, load / rows, TOLERANCE, MOST_STEPS)
            if left <= GOOD_ENOUGH:
                return before(rows * part)
        raise FilmNotConverged("the transposed balance between elastic walls not solved", "stiffer walls")

    def _image(self, before: Solve, rows: Array, part: Array) -> Array:
        """The transposed matrix after a similar inverse, both scaled by rows."""
        unit, film, multiplier = self._step[3], self._film, before(rows * part)
        swayed = film.on_vertices(film.balance.lever(np.where(self._fixed, 0.0, multiplier)))
        return np.asarray(self._rigid @ multiplier + self._free * self.by_wall_pressure(swayed) / unit) / rows

    def _factors(self) -> Iterator[Solve]:
        """Inverses of similar matrices, the cheaper first."""
        if np.count_nonzero(self._free) > DENSE_LIMIT and self._rigid_factor is not None:
            yield self._rigid_factor
        yield self._dense_factor

    @cached_property
    def _rigid_factor(self) -> Solve | None:
        try:
            return splu(self._rigid).solve
        except RuntimeError:  # SuperLU: "Factor is exactly singular"
            return None

    @cached_property
    def _dense_factor(self) -> Solve:
        film, unit = self._film, self._step[3]
        rows = np.where(self._fixed, 0.0, 1.0 / unit)
        pattern = ElasticPatterns(film.space).deformation
        slope = by_deformation(film.problem, film.parts, film.balance.state, rows, pattern)
        wider, free = deformation_slope(film.problem, film.solution.deformation), np.flatnonzero(self._free)
        matrix = self._rigid.toarray(order="C")
        matrix[free] += np.asarray(slope @ columns_of(wider, free)).T
        answer = dense_answer(matrix)
        return lambda load: answer(load, TOLERANCE)


def _touch_of(film: SolvedFilm) -> Touch | None:
    """Contact of elastic walls, with the weak one that Newton's method leaves out; None where walls cannot touch."""
    if film.problem.walls is None or film.problem.asperities is None:
        return None
    touch = touch_at(film.problem, film.solution.deformation)
    steep = -touch.bears.slope
    return replace(touch, felt=np.flatnonzero(steep > FELT * steep.max(initial=0.0)))
