"""The film equation solved: Newton's method on every unknown's flow balance, an active set for the cavity.

Each unknown is a pressure where the film is full and, under JFO, a film fraction where it is not. Each step solves
the linearised balance; for a full film of constant viscosity between rigid walls the first step is exact. The set
of cavitated unknowns follows the primal-dual active set method (Hintermueller, Ito and Kunisch 2002): Reynolds'
condition is p >= p_c, R >= 0, (p - p_c) R = 0; JFO is p >= p_c, theta <= 1, (p - p_c)(1 - theta) = 0, R = 0.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, issparse

from reynolds import kernels
from reynolds.balance import (
    Operators,
    State,
    by_opening,
    flow_balance,
    full_matrix,
    holds,
    operators,
    slopes,
    swallowed,
)
from reynolds.cascade import COARSEST, nested_cavity
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.film import Cavitation, FilmProblem, FilmSolution
from reynolds.fluid import CONSTANT
from reynolds.linear import Factor, GeneralFactor
from reynolds.mesh import Array
from reynolds.setting import Setting, spread
from reynolds.space import FilmSpace

MAX_ITERATIONS = 100
TOLERANCE = 1e-9
LEAST_LEFT = 0.2  # of the film that a step between compliant walls may leave


@dataclass(frozen=True)
class _Iterate:
    """A state, its cavity, and the balance there."""

    state: State
    cavity: NDArray[np.bool_]
    parts: Operators
    balance: Array
    size: Array


class FilmSolver:
    """Solves films on one space, its vertices moved or not; keeps the symbolic factorisation between calls."""

    def __init__(self, space: FilmSpace) -> None:
        self._pattern = space.pattern
        self._factor = Factor()
        self._general = GeneralFactor()

    def solve(self, problem: FilmProblem, start: FilmSolution | None = None) -> FilmSolution:
        """The film of `problem`; `start` warms pressures, film fractions and cavity.

        Afterwards every free unknown's flow balance holds to 1e-9 of the flows meeting there. Raises
        FilmInputError as `check_pressures` does, and FilmNotConverged when the active set does not settle.
        """
        if problem.space.pattern is not self._pattern:
            raise FilmInputError("space", "another mesh", "the space of this solver, moved or not")
        setting = spread(problem)
        at = self._begin(problem, setting, start)
        for iteration in range(1, MAX_ITERATIONS + 1):
            state = self._step(problem, setting, at)
            parts = at.parts if _is_linear(problem) else operators(problem, state)
            balance, size = flow_balance(problem, parts, state)
            cavity = _cavity(problem, setting, replace(at, state=state, parts=parts, balance=balance, size=size))
            settled = bool(np.array_equal(cavity, at.cavity))
            _check_degree(problem, cavity)
            state = _projected(problem, setting, state, cavity)
            at = _Iterate(state, cavity, parts, *flow_balance(problem, parts, state))
            imbalance = _imbalance(problem, setting, at)
            if settled and imbalance < TOLERANCE:
                return _solution(problem, setting, at, imbalance, iteration)
        raise FilmNotConverged(
            f"film pressure not settled after {MAX_ITERATIONS} iterations (imbalance {imbalance:.2g}, "
            f"{int(at.cavity.sum())} of {problem.space.size} unknowns cavitated)",
            "a finer or more regular (Delaunay) mesh, or triangles instead of stretched quadrilaterals",
        )

    def _begin(self, problem: FilmProblem, setting: Setting, start: FilmSolution | None) -> _Iterate:
        space = problem.space
        pressure, fraction = setting.pressure, setting.film_fraction
        cavity = np.zeros(space.size, dtype=bool)
        if start is not None:
            pressure = np.where(setting.held, pressure, start.pressure)
            fraction = np.where(setting.held, fraction, start.film_fraction)
            cavity = start.cavity & ~setting.held & (problem.cavitation is not Cavitation.NONE)
        state = _opened(problem, pressure, fraction)
        parts = operators(problem, state)
        balance, size = flow_balance(problem, parts, state)
        if start is None and problem.cavitation is not Cavitation.NONE and space.size > COARSEST:
            at = _Iterate(state, cavity, parts, balance, size)
            # Free unknowns of the spread pressures stand at cavitation pressure: the step from there is p - p_c.
            cavity = nested_cavity(*_symmetric_step(problem, setting, at, setting.held)) & ~setting.held
        state = _projected(problem, setting, state, cavity)
        return _Iterate(state, cavity, parts, *flow_balance(problem, parts, state))

    def _step(self, problem: FilmProblem, setting: Setting, at: _Iterate) -> State:
        """The state after one Newton step of the free unknowns; held ones stay as they are."""
        carried = problem.cavitation is Cavitation.JFO and bool(at.cavity.any())
        if _is_linear(problem) and not carried:
            matrix, load = _symmetric_step(problem, setting, at, setting.held | at.cavity)
            self._factor.update(matrix)
            return replace(at.state, pressure=at.state.pressure + self._factor.solve(load))
        upper, lower, load, scale = _general_step(problem, setting, at)
        if problem.walls is None:
            self._general.update(problem.space.matrix(upper), lower)
            change = self._general.solve(load)
        else:
            change = _compliant_step(problem, setting, at, upper, lower, load)
        return _taken(problem, at, change, scale)


def _is_linear(problem: FilmProblem) -> bool:
    return problem.fluid is CONSTANT and problem.walls is None


def _check_degree(problem: FilmProblem, cavity: NDArray[np.bool_]) -> None:
    if problem.space.degree > 1 and cavity.any():
        raise FilmInputError(
            "film_space", "quadratic pressure in a film that cavitates", "degree 1, or a film without cavitation"
        )


def _opened(problem: FilmProblem, pressure: Array, fraction: Array) -> State:
    opening = np.zeros(len(problem.space.vertices)) if problem.walls is None else problem.walls.matrix @ pressure
    return State(pressure, fraction, opening)


def _symmetric_step(
    problem: FilmProblem, setting: Setting, at: _Iterate, fixed: NDArray[np.bool_]
) -> tuple[csc_array, Array]:
    """Upper triangle and right-hand side for the change of pressure, identity where fixed."""
    rest, gain = _with_pockets(setting, at)
    # Conductances are 1e-15 to 1e-9: scaled to order one they stay clear of any pivot threshold.
    scale = at.parts.stiffness.max()
    data = np.empty_like(at.parts.stiffness)
    pattern = problem.space.pattern
    kernels.hold(pattern.indptr, pattern.indices, at.parts.stiffness / scale, fixed, gain / scale, data)
    return problem.space.matrix(data), np.where(fixed, 0.0, -rest / scale)


def _general_step(problem: FilmProblem, setting: Setting, at: _Iterate) -> tuple[Array, Array, Array, float]:
    """Upper triangle, mirror and right-hand side for the change of pressure or, in the cavity, film fraction.

    Scaled to order one; the last value turns an unknown of the cavity into a film fraction.
    """
    rest, gain = _with_pockets(setting, at)
    by = slopes(problem, at.parts, at.state)
    f_upper, f_lower, f_gain = by.by_fraction
    p_upper, p_lower, p_gain = by.by_pressure
    unit = float(np.abs(at.parts.stiffness).max())
    largest = max(float(np.abs(f_upper).max()), float(np.abs(f_gain).max()))
    scale = unit / largest if largest > 0.0 else 1.0
    # Where nothing carries a cavity along, its film fraction stays as it is.
    f_gain = f_gain + NOTHING * (largest if largest > 0.0 else unit)
    upper, lower = np.empty_like(p_upper), np.empty_like(p_upper)
    pattern = problem.space.pattern
    kernels.choose_columns(
        pattern.indptr, pattern.indices, p_upper / unit, p_lower / unit, f_upper / unit, f_lower / unit,
        (p_gain + gain) / unit, f_gain / unit, setting.held, at.cavity, scale, upper, lower,
    )  # fmt: skip
    return upper, lower, np.where(setting.held, 0.0, -rest / unit), scale


NOTHING = 1e-12  # of the largest flow


def _with_pockets(setting: Setting, at: _Iterate) -> tuple[Array, Array]:
    """The balance less what pockets are fed, and what their feeds add to the diagonal."""
    rest, gain = at.balance.copy(), np.zeros(len(at.balance))
    for node, pocket in setting.pockets:
        inflow, slope = pocket.feed(at.state.pressure[node])
        rest[node] -= inflow
        gain[node] = -slope
    return rest, gain


def _compliant_step(
    problem: FilmProblem, setting: Setting, at: _Iterate, upper: Array, lower: Array, load: Array
) -> Array:
    """The same step where each pressure opens the film everywhere: dR/dp + dR/dh dh/dp."""
    assert problem.walls is not None
    compliance = problem.walls.matrix
    rigid = full_matrix(problem.space, upper, lower)
    free = (~setting.held).astype(float)
    pressures = free * ~at.cavity
    slope = by_opening(problem, at.parts, at.state) * (free / np.abs(at.parts.stiffness).max())[:, None]
    if issparse(compliance):
        from scipy.sparse.linalg import spsolve

        return np.asarray(spsolve(csc_array(rigid + slope @ (compliance * pressures[None, :])), load))
    return np.asarray(np.linalg.solve(rigid.toarray() + slope @ (compliance * pressures[None, :]), load))


def _taken(problem: FilmProblem, at: _Iterate, change: Array, scale: float) -> State:
    """The state after a step, shortened where it would press compliant walls together."""
    share = 1.0
    while True:
        pressure = at.state.pressure + share * np.where(at.cavity, 0.0, change)
        fraction = at.state.film_fraction + share * np.where(at.cavity, scale * change, 0.0)
        state = _opened(problem, pressure, fraction)
        if problem.walls is None:
            return state
        given = problem.space.sample_vertices(state.opening) + problem.film.thickness
        if (given > LEAST_LEFT * at.parts.transport.film.thickness).all():
            return state
        share *= 0.5


def _cavity(problem: FilmProblem, setting: Setting, at: _Iterate) -> NDArray[np.bool_]:
    """The unknowns that belong to the cavity by the state that a step led to."""
    level = problem.cavitation_pressure
    if problem.cavitation is Cavitation.NONE:
        return at.cavity
    enters = ~at.cavity & (at.state.pressure < level)
    if problem.cavitation is Cavitation.REYNOLDS:
        # A node that nothing drives (balance zero but for round-off) would otherwise enter and leave for ever.
        stays = at.cavity & (at.balance > -TOLERANCE * at.size)
    else:
        # A node that nothing drives has no pressure of its own but for round-off.
        diagonal = at.parts.stiffness[problem.space.pattern.indptr[1:] - 1]
        enters = ~at.cavity & ((at.state.pressure - level) * diagonal < -TOLERANCE * at.size)
        stays = at.cavity & (at.state.film_fraction < 1.0 + TOLERANCE) & (at.state.film_fraction > -TOLERANCE)
    return (enters | stays) & ~setting.held


def _projected(problem: FilmProblem, setting: Setting, state: State, cavity: NDArray[np.bool_]) -> State:
    """The state with cavitation pressure in the cavity and a full film elsewhere."""
    level = problem.cavitation_pressure
    pressure = np.where(cavity, level, state.pressure)
    if problem.cavitation is not Cavitation.NONE:
        pressure = np.maximum(pressure, level)
    fraction = np.where(cavity | setting.held, np.clip(state.film_fraction, 0.0, 1.0), 1.0)
    if problem.cavitation is not Cavitation.JFO:
        fraction = np.ones_like(fraction)
    return _opened(problem, pressure, fraction)


def _imbalance(problem: FilmProblem, setting: Setting, at: _Iterate) -> float:
    """Largest residual of a free unknown over the flows that meet there."""
    free = ~setting.held
    if problem.cavitation is Cavitation.REYNOLDS:
        free &= ~at.cavity
    rest, slope = _with_pockets(setting, at)
    size = at.size + np.abs(at.balance - rest) + kernels.ROUNDING * np.abs(slope * at.state.pressure)
    scale = np.where(size > 0.0, size, 1.0)
    return float(np.max(np.abs(rest[free]) / scale[free], initial=0.0))


def _solution(
    problem: FilmProblem, setting: Setting, at: _Iterate, imbalance: float, iterations: int
) -> FilmSolution:
    return FilmSolution(
        problem=problem,
        pressure=at.state.pressure,
        film_fraction=at.state.film_fraction,
        film=at.parts.transport.film,
        opening=at.state.opening,
        flux=at.parts.transport.flux,
        outflow=-at.balance,
        holds=holds(problem, at.parts, at.state),
        swallowed=swallowed(problem, at.parts, at.state),
        meeting=at.size,
        held=setting.held,
        cavity=at.cavity,
        imbalance=imbalance,
        iterations=iterations,
    )
