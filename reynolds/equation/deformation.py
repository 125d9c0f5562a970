"""Deformation of elastic walls under a film's pressure and, where they touch, under their contact.

g = C (p + p_c(h + g)): contact presses on the walls as the film does, p_c the mean of the vertices that share an
unknown. Where a pocket or a port is, at a pocket's unknown and at held nodes inside, one wall is missing: there is no
contact.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array, eye_array, issparse

from reynolds.bodies.compliance import LowRank, WallMatrix, WallOperator, columns_of, full, transposed_product
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.laws.contact import LOWEST_RATIO, Asperities, contact_pressure
from reynolds.laws.law import Tangent
from reynolds.linear.elastic import Answer, dense_answer, sparse_answer
from reynolds.numerics.array_kernels import norm
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmProblem, Pocket

MAX_STEPS = 15
TOLERANCE = 1e-12  # of film thickness and asperities' height
DEEPEST = 5.0  # standard deviations of the summits by which they may be in each other at first
ROOM = 0.9  # of the way to where the law of contact ends
MOST_HALVINGS, LEAST_GAIN = 8, 1e-4  # of a step; of the residual, by a full step
FELT = 1e-6  # of the stiffness K E'/sigma where mean planes meet: less resists nothing


def deformation(problem: FilmProblem, pressure: Array, start: Array | None = None) -> Array:
    """Deformation of the film at the vertices (vertices,) m under nodal pressures (size,) Pa.

    Solves g = C (p + p_c(h + g)) by Newton's method from `start`: contact closes as the film opens. Raises
    FilmNotConverged where that does not converge, and FilmInputError as the contact's law does.
    """
    if problem.walls is None:
        return np.zeros(len(problem.space.vertices))
    compliance = problem.walls.matrix
    alone = np.asarray(compliance @ pressure)
    if not np.isfinite(alone).all():
        raise FilmInputError("walls", "a compliance that is not finite", "numbers, m/Pa")
    if problem.asperities is None:
        return alone
    return settled_deformation(meeting_of(problem), given_gap(problem), alone, alone if start is None else start)


def settled_deformation(meeting: Meeting, given: Array, alone: Array, start: Array) -> Array:
    """The deformation in balance with contact, of walls that deform by `alone` (vertices,) m under the oil.

    `given` (vertices,) m: the gap without deformation. Each step reduces the imbalance, and goes at most nine tenths
    of the way to the end of the law of contact. Raises as `deformation`.
    """
    summits, height = meeting.asperities.summit_height, meeting.asperities.height
    enough = TOLERANCE * (np.max(np.abs(given)) + height)

    def left(found: Array) -> tuple[Touch, Array]:
        touch = meeting.at(given + found)
        return touch, found - alone - meeting.compliance @ touch.on_unknowns

    found = np.maximum(start, summits - DEEPEST * height - given)
    touch, rest = left(found)
    for _ in range(MAX_STEPS):
        if np.max(np.abs(rest)) < enough:
            return found
        change = touch.settled(rest)
        beyond = found + given - (summits + LOWEST_RATIO * height)
        closing = change > ROOM * beyond
        share = float(np.min(ROOM * beyond[closing] / change[closing], initial=1.0))
        for _ in range(MOST_HALVINGS):
            tried = found - share * change
            new, after = left(tried)
            if norm(after) < (1.0 - LEAST_GAIN * share) * norm(rest):
                break
            share *= 0.5
        found, touch, rest = tried, new, after
    raise FilmNotConverged(
        f"the deformation of walls in contact not converged after {MAX_STEPS} steps", "a thicker film, or stiffer walls"
    )


def deformation_slope(problem: FilmProblem, found: Array) -> WallOperator:
    """dg/dp at a deformation (vertices,) m: (vertices, size) m/Pa, the compliance without contact."""
    assert problem.walls is not None
    compliance = problem.walls.matrix
    if problem.asperities is None:
        return compliance
    return resisted(touch_at(problem, found))


def resisted(touch: Touch) -> WallOperator:
    """The compliance of walls against their contact, (vertices, size) m/Pa."""
    compliance = touch.compliance
    if not touch.felt.size:
        return compliance
    if isinstance(compliance, csr_array):
        return csr_array(touch.settled(compliance.toarray()))
    return Resisted(touch)


@dataclass(frozen=True)
class Touch:
    """Contact of elastic walls at one deformation.

    bears: pressure (vertices,) Pa and its slope by the gap, Pa/m; felt: vertices at which it resists.
    """

    meeting: Meeting
    bears: Tangent
    felt: NDArray[np.intp]

    @property
    def compliance(self) -> WallMatrix:
        """C."""
        return self.meeting.compliance

    @property
    def on_unknowns(self) -> Array:
        """Its pressure on the unknowns, (size,) Pa."""
        return self.meeting.on_unknowns(self.bears.value)

    def settled(self, displaced: Array) -> Array:
        """x with x - C dp_c/dh x = displaced, (vertices, ...) m: a displacement against contact."""
        if not self.felt.size:
            return displaced
        here = self._within(np.ascontiguousarray(displaced[self.felt]), 0.0)
        return np.asarray(displaced + self._columns @ here)

    def settled_transposed(self, force: Array) -> Array:
        """The transpose of `settled`: (I - C dp_c/dh)^-T force, (vertices,)."""
        if not self.felt.size:
            return force
        seats = self.meeting.seats[self.felt]
        pushed = self.weights * transposed_product(self.compliance, force)[seats]
        found = force.copy()
        found[self.felt] += self._within_transposed(pushed, 0.0)
        return found

    @property
    def weights(self) -> Array:
        """Pressure of contact on its unknown by the gap of each vertex of `felt`, (felt,) Pa/m."""
        return np.asarray(self.meeting.shares[self.felt] * self.bears.slope[self.felt])

    @cached_property
    def _columns(self) -> WallMatrix:
        """C dp_c/dh of the vertices of `felt`, (vertices, felt)."""
        unknown, weight = self.meeting.seats[self.felt], self.weights
        if isinstance(self.compliance, LowRank):
            return LowRank(self.compliance.left, self.compliance.right[:, unknown] * weight[None, :])
        columns = self.compliance[:, unknown]
        return csr_array(columns * weight[None, :]) if issparse(columns) else columns * weight

    @cached_property
    def _within(self) -> Answer:
        """The same at the vertices of `felt`, which determine the others."""
        here = _rows(self._columns, self.felt)
        return _less(here if isinstance(here, csr_array) else full(here))

    @cached_property
    def _within_transposed(self) -> Answer:
        """Its transpose."""
        here = _rows(self._columns, self.felt)
        return _less(csr_array(here.T) if isinstance(here, csr_array) else np.ascontiguousarray(full(here).T))


@dataclass(frozen=True)
class Resisted:
    """(I - C dp_c/dh)^-1 C, (vertices, size) m/Pa: the compliance with contact, never multiplied out."""

    touch: Touch

    def __matmul__(self, pressure: Array) -> Array:
        """Deformation (vertices, ...) m by pressures (size, ...) Pa."""
        return self.touch.settled(np.asarray(self.touch.compliance @ pressure))

    @property
    def compliance(self) -> WallMatrix:
        """C."""
        return self.touch.compliance

    @property
    def contact(self) -> csr_array:
        """dp_c/dh on the unknowns, (size, vertices) Pa/m."""
        felt, shape = self.touch.felt, self.touch.compliance.shape
        entries = self.touch.weights, (self.touch.meeting.seats[felt], felt)
        return csr_array(entries, shape=(shape[1], shape[0]))

    def columns(self, unknowns: NDArray[np.intp]) -> Array:
        """Columns of the matrix for some unknowns."""
        return self.touch.settled(columns_of(self.touch.compliance, unknowns))


@dataclass(frozen=True)
class Meeting:
    """Places at which rough elastic walls can touch.

    oil (vertices,): vertices without contact; seats (vertices,): unknown of each vertex; shares (vertices,): of its
    pressure in that of the unknown.
    """

    compliance: WallMatrix
    asperities: Asperities
    oil: NDArray[np.bool_]
    seats: NDArray[np.signedinteger]
    shares: Array

    def on_unknowns(self, bears: Array) -> Array:
        """Pressure on the unknowns (size,) Pa by that of the vertices."""
        return np.bincount(self.seats, self.shares * bears, self.compliance.shape[1]).astype(float)

    def at(self, gap: Array) -> Touch:
        """Contact at a gap between the mean planes (vertices,) m; raises as the law of contact does."""
        found = contact_pressure(self.asperities, gap[~self.oil])
        value, slope = np.zeros(len(gap)), np.zeros(len(gap))
        value[~self.oil], slope[~self.oil] = found
        law = self.asperities
        stiff = FELT * law.elastic_factor * law.modulus / law.height
        return Touch(self, Tangent(value, slope), np.flatnonzero(-slope > stiff))


def meeting_of(problem: FilmProblem) -> Meeting:
    """The possible contact of a problem with elastic walls and asperities."""
    assert problem.walls is not None
    assert problem.asperities is not None
    space, compliance = problem.space, problem.walls.matrix
    closed = np.zeros(space.size, dtype=bool) if problem.held_nodes is None else ~np.isnan(problem.held_nodes)
    for name, condition in problem.boundary.items():
        if isinstance(condition, Pocket):
            closed[space.edge_dofs[name]] = True
    seats, oil = space.vertex_dofs, closed[space.vertex_dofs]
    shares = np.where(oil, 0.0, 1.0 / np.bincount(seats)[seats])
    return Meeting(compliance, problem.asperities, oil, seats, shares)


def touch_at(problem: FilmProblem, found: Array) -> Touch:
    """Contact of rough elastic walls at a deformation (vertices,) m; raises as the law of contact does."""
    return meeting_of(problem).at(given_gap(problem) + found)


def given_gap(problem: FilmProblem) -> Array:
    """Distance of the mean planes without deformation at the vertices, (vertices,) m."""
    if problem.space.degree != 1:
        raise FilmInputError("film_space", "quadratic pressure between walls that touch", "degree 1")
    known = problem.film.thickness_at_vertices
    return problem.space.to_vertices(problem.film.thickness) if known is None else known


def _rows(matrix: WallMatrix, rows: NDArray[np.intp]) -> WallMatrix:
    """Some rows of a compliance."""
    return LowRank(matrix.left[rows], matrix.right) if isinstance(matrix, LowRank) else matrix[rows]


def _less(matrix: Array | csr_array) -> Answer:
    """Solver of the identity less a matrix."""
    if not isinstance(matrix, csr_array):
        return dense_answer(np.eye(len(matrix)) - matrix)
    return sparse_answer(csc_array(eye_array(matrix.shape[0]) - matrix))
