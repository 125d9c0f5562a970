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
from scipy.sparse.linalg import splu

from reynolds import kernels
from reynolds.balance import (
    Operators,
    State,
    by_opening,
    flow_balance,
    full_matrix,
    holds,
    mixing,
    operators,
    positive_share,
    slopes,
    swallowed,
)
from reynolds.cascade import COARSEST, nested_cavity
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.film import Cavitation, FilmProblem, FilmSolution
from reynolds.fluid import CONSTANT
from reynolds.grid import grid_of
from reynolds.linear import Factor, GeneralFactor
from reynolds.mesh import Array
from reynolds.opening import opening, opening_slope
from reynolds.setting import Setting, spread
from reynolds.space import FilmSpace

MAX_ITERATIONS = 100
FULL_STEPS = 15  # then, or as soon as a cavity comes back, each step must bring the balance nearer to zero
TOLERANCE = 1e-9
MOST_HALVINGS = 10
LEAST_GAIN = 1e-4  # of the balance, by a full step
NOTHING = 1e-12  # of the largest flow


@dataclass(frozen=True)
class _Iterate:
    """A state, its cavity and the balance there.

    `signed` (size,) Pa tells the two apart: pressure above cavitation pressure where it is positive, else what
    the cavity lacks of a full film, in pressures (see `_signed`).
    """

    signed: Array
    state: State
    cavity: NDArray[np.bool_]
    parts: Operators
    balance: Array
    size: Array


class FilmSolver:
    """Solves films on one space, its vertices moved or not; keeps the symbolic factorisation between calls."""

    def __init__(self, space: FilmSpace) -> None:
        self._pattern = space.pattern
        grid = grid_of(space)
        self._factor = Factor(grid)
        self._general = GeneralFactor(grid)

    def solve(self, problem: FilmProblem, start: FilmSolution | None = None) -> FilmSolution:
        """The film of `problem`; `start` warms pressures, film fractions and cavity.

        Afterwards every free unknown's flow balance holds to 1e-9 of the flows meeting there. Raises
        FilmInputError as `check_pressures` does, and FilmNotConverged when that is not reached.
        """
        if problem.space.pattern is not self._pattern:
            raise FilmInputError("space", "another mesh", "the space of this solver, moved or not")
        setting = spread(problem)
        if start is None and problem.walls is not None:
            # Newton's method reaches walls that open widely from the film between rigid ones.
            start = self.solve(replace(problem, walls=None))
        at = self._begin(problem, setting, start)
        seen = {at.cavity.tobytes()}
        cycles = near = False
        for iteration in range(1, MAX_ITERATIONS + 1):
            signed = self._step(problem, setting, at)
            new = _advanced(problem, setting, at, signed, downhill=cycles)
            settled, at = bool(np.array_equal(new.cavity, at.cavity)), new
            _check_degree(problem, at.cavity)
            imbalance = _imbalance(problem, setting, at)
            if imbalance < TOLERANCE and (settled or near):
                return _solution(problem, setting, at, imbalance, iteration)
            # Under JFO an unknown next to zero may change sides for ever: after one more step either side does.
            near = imbalance < TOLERANCE and problem.cavitation is Cavitation.JFO
            cycles |= iteration >= FULL_STEPS or (not settled and at.cavity.tobytes() in seen)
            seen.add(at.cavity.tobytes())
        raise _not_settled(problem, at, imbalance)

    def _begin(self, problem: FilmProblem, setting: Setting, start: FilmSolution | None) -> _Iterate:
        space = problem.space
        pressure, fraction = setting.pressure, setting.film_fraction
        cavity = np.zeros(space.size, dtype=bool)
        if start is not None:
            pressure = np.where(setting.held, pressure, start.pressure)
            fraction = np.where(setting.held, fraction, start.film_fraction)
            cavity = start.cavity & ~setting.held & (problem.cavitation is not Cavitation.NONE)
        at = _iterate(problem, _opened(problem, pressure, fraction), cavity)
        if start is None and problem.cavitation is not Cavitation.NONE and space.size > COARSEST:
            # Free unknowns of the spread pressures stand at cavitation pressure: the step from there is p - p_c.
            guess = nested_cavity(*_symmetric_step(problem, setting, at, setting.held)) & ~setting.held
            at = replace(at, cavity=guess)
        return at

    def _step(self, problem: FilmProblem, setting: Setting, at: _Iterate) -> Array:
        """The signed unknowns after one Newton step of the free ones; held ones stay as they are."""
        carried = problem.cavitation is Cavitation.JFO and bool(at.cavity.any())
        if _is_linear(problem) and not carried:
            matrix, load = _symmetric_step(problem, setting, at, _fixed(problem, setting, at))
            self._factor.update(matrix)
            change, scale = self._factor.solve(load), 0.0
        else:
            upper, lower, load, scale = _general_step(problem, setting, at)
            if problem.walls is None:
                self._general.update(problem.space.matrix(upper), lower, at.cavity)
                change = self._general.solve(load)
            else:
                change = _compliant_step(problem, setting, at, upper, lower, load)
        return _signed(problem, at, change, scale)


def _not_settled(problem: FilmProblem, at: _Iterate, imbalance: float) -> FilmNotConverged:
    what = (
        f"film pressure not settled after {MAX_ITERATIONS} iterations (imbalance {imbalance:.2g}, "
        f"{int(at.cavity.sum())} of {problem.space.size} unknowns cavitated)"
    )
    if share := positive_share(problem.space, at.parts.stiffness):
        return FilmNotConverged(
            f"{what}; {share:.1%} of the mesh's couplings are positive, from cells with obtuse angles",
            "Delaunay triangles or rectangular cells, on which no pressure overshoots",
        )
    return FilmNotConverged(what, "a finer mesh, or a film that changes less from cell to cell")


def _is_linear(problem: FilmProblem) -> bool:
    return problem.fluid is CONSTANT and problem.walls is None


def _check_degree(problem: FilmProblem, cavity: NDArray[np.bool_]) -> None:
    if problem.space.degree > 1 and cavity.any():
        raise FilmInputError(
            "film_space", "quadratic pressure in a film that cavitates", "degree 1, or a film without cavitation"
        )


def _opened(problem: FilmProblem, pressure: Array, fraction: Array, near: Array | None = None) -> State:
    return State(pressure, fraction, opening(problem, pressure, near))


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
    fixed = _fixed(problem, setting, at)
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
        (p_gain + gain) / unit, f_gain / unit, fixed, at.cavity, scale, upper, lower,
    )  # fmt: skip
    return upper, lower, np.where(fixed, 0.0, -rest / unit), scale


def _fixed(problem: FilmProblem, setting: Setting, at: _Iterate) -> NDArray[np.bool_]:
    """Unknowns that a step leaves alone: held ones, and those that Reynolds' condition holds."""
    return setting.held | at.cavity if problem.cavitation is Cavitation.REYNOLDS else setting.held


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
    wider = opening_slope(problem, at.state.opening)
    rigid = full_matrix(problem.space, upper, lower)
    free = (~_fixed(problem, setting, at)).astype(float)
    pressures = free * ~at.cavity
    slope = by_opening(problem, at.parts, at.state) * (free / np.abs(at.parts.stiffness).max())[:, None]
    matrix = rigid + slope @ (wider * pressures[None, :])
    if issparse(matrix):
        return np.asarray(splu(csc_array(matrix)).solve(load))
    return np.asarray(np.linalg.solve(matrix, load))


def _signed(problem: FilmProblem, at: _Iterate, change: Array, scale: float) -> Array:
    """The signed unknowns (size,) Pa after a step.

    In the cavity the lack of oil 1 - theta, or the oil that Reynolds' condition makes, over the pressure that
    would move as much: slopes of the balance by a signed unknown are then alike on both sides of zero.
    """
    level = problem.cavitation_pressure
    pressure = at.state.pressure + np.where(at.cavity, 0.0, change)
    if problem.cavitation is Cavitation.JFO:
        lack = at.state.film_fraction + scale * change - 1.0
        return np.where(at.cavity, lack * _stiffness_of_lack(problem, at), pressure - level)
    if problem.cavitation is Cavitation.REYNOLDS and at.cavity.any():
        balance, size = flow_balance(problem, at.parts, replace(at.state, pressure=pressure))
        # A node that nothing drives (balance zero but for round-off) would otherwise enter and leave for ever.
        made = (balance + TOLERANCE * size) / _diagonal(problem, at.parts.stiffness)
        return np.where(at.cavity, -made, pressure - level)
    return pressure - level


def _stiffness_of_lack(problem: FilmProblem, at: _Iterate) -> Array:
    """Pressure that moves as much oil out of an unknown as its film fraction does, (size,) Pa."""
    carried = _diagonal(problem, at.parts.convection[0] + at.parts.diffusion) + np.maximum(at.parts.rate, 0.0)
    stiff = _diagonal(problem, at.parts.stiffness)
    return np.maximum(carried, NOTHING * carried.max() + 1e-300) / stiff


def _diagonal(problem: FilmProblem, upper: Array) -> Array:
    return np.asarray(upper[problem.space.pattern.indptr[1:] - 1])


def _at(problem: FilmProblem, setting: Setting, before: _Iterate, signed: Array) -> _Iterate:
    """The iterate that signed unknowns mean: each a pressure where positive, else a cavity."""
    level = problem.cavitation_pressure
    pressure, fraction = signed + level, np.ones_like(signed)
    cavity = np.zeros(len(signed), dtype=bool)
    if problem.cavitation is not Cavitation.NONE:
        cavity = (signed < 0.0) & ~setting.held
        pressure = np.maximum(pressure, level)
    if problem.cavitation is Cavitation.JFO:
        fraction = np.where(cavity, 1.0 + signed / _stiffness_of_lack(problem, before), 1.0)
    pressure = np.where(setting.held, setting.pressure, pressure)
    fraction = np.where(setting.held, setting.film_fraction, fraction)
    state = _opened(problem, pressure, fraction, before.state.opening)
    if _is_linear(problem):
        return _Iterate(signed, state, cavity, before.parts, *flow_balance(problem, before.parts, state))
    return _iterate(problem, state, cavity, signed)


def _iterate(
    problem: FilmProblem, state: State, cavity: NDArray[np.bool_], signed: Array | None = None
) -> _Iterate:
    parts = operators(problem, state)
    if signed is None:
        signed = state.pressure - problem.cavitation_pressure
        at = _Iterate(signed, state, cavity, parts, signed, signed)
        if problem.cavitation is Cavitation.JFO:
            signed = np.where(cavity, (state.film_fraction - 1.0) * _stiffness_of_lack(problem, at), signed)
    return _Iterate(signed, state, cavity, parts, *flow_balance(problem, parts, state))


def _advanced(problem: FilmProblem, setting: Setting, at: _Iterate, signed: Array, *, downhill: bool) -> _Iterate:
    """The iterate after a step, cut back where no film would be left or a law would not hold.

    `downhill` cuts it back further until it brings the balance nearer to zero; where no share does, the best of
    those tried. Raises what the laws raise where even the shortest step leads out of them.
    """

    def rest(there: _Iterate) -> float:
        return float(np.abs(_with_pockets(setting, there)[0][~setting.held]).sum())

    before, best, fault = rest(at), None, None
    for halvings in range(MOST_HALVINGS):
        share = 0.5**halvings
        try:
            new = _at(problem, setting, at, at.signed + share * (signed - at.signed))
        except (FilmInputError, FilmNotConverged) as reason:
            fault = reason
            continue
        left = rest(new)
        if not downhill or left < (1.0 - LEAST_GAIN * share) * before:
            return new
        if best is None or left < best[0]:
            best = left, new
    if best is None:
        assert fault is not None
        raise fault
    return best[1]


def _imbalance(problem: FilmProblem, setting: Setting, at: _Iterate) -> float:
    """Largest residual of a free unknown over the flows that meet there."""
    free = ~setting.held
    if problem.cavitation is Cavitation.REYNOLDS:
        free &= ~at.cavity
    rest, slope = _with_pockets(setting, at)
    size = at.size + np.abs(at.balance - rest) + kernels.ROUNDING * np.abs(slope * at.state.pressure)
    # Round-off of a solve is that of its largest flows: where next to nothing flows it is all there is.
    scale = np.maximum(size + kernels.ROUNDING * size.max(initial=0.0), 1e-300)
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
        mixing=mixing(problem, at.parts, at.state),
        meeting=at.size,
        held=setting.held,
        cavity=at.cavity,
        imbalance=imbalance,
        iterations=iterations,
    )
