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

from reynolds.equation.balance import FilmState, Operators, operators, positive_share
from reynolds.equation.companion import companion_of, film_on_nodes
from reynolds.equation.deformation_sparsity import ElasticPatterns
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.fem.space import FilmSpace
from reynolds.laws.fluid import CONSTANT, check_laws
from reynolds.linear.elastic import NearFactor
from reynolds.linear.factor import ITERATIVE_TOLERANCE, Factor, GeneralFactor, Solve, row_by_row
from reynolds.linear.multigrid.grid import grid_of
from reynolds.numerics.arrays import Array
from reynolds.problem import LEAST_FRACTION, Cavitation, FilmProblem, FilmSolution
from reynolds.solve.boundary import BoundaryValues, pressure_sending, spread
from reynolds.solve.cavity_guess import COARSEST, FINEST, Cascade, Obstacle, active_set
from reynolds.solve.iterate import (
    Iterate,
    advanced,
    deformed,
    fixed_in,
    imbalance_of,
    is_linear,
    iterate_of,
    with_pockets,
)
from reynolds.solve.newton import compliant, general_step, signed_after, symmetric_step

MAX_ITERATIONS = 100
FULL_STEPS = 15  # then, or as soon as a cavity repeats, each step must reduce the imbalance
TOLERANCE = 1e-9
NEAR = 1e-6  # of which one more step leaves round-off
ROUND_OFF = 1e-12
SOFT_STEP = 1e-5  # residual of a first step between elastic walls over its load
KEPT = 1e-3  # imbalance below which a linearisation between elastic walls, which is costly, is kept
KEPT_GAIN = 0.03  # largest reduction factor of a kept linearisation that is used again
QUADRATIC_LEAST = 3000  # unknowns: below, a direct solve of a quadratic film is as fast as conjugate gradients
LOOSEST = 1e-2  # residual of a linear solve over its load
LESS = 0.3  # of a pocket's flow before: from a smaller flow its supply's law converges
LEAST_GAP = 0.1  # of the largest film, to which a first pressure parts overlapping walls


class FilmSolver:
    """Solves films on one space, its vertices moved or not; keeps the symbolic factorisation between calls."""

    def __init__(self, space: FilmSpace) -> None:
        # For balances of this space that are linearised elsewhere (`floating.joint`).
        self.slopes_factor, self.near_factor, self.patterns = (
            GeneralFactor(grid_of(space)),
            NearFactor(),
            ElasticPatterns(space),
        )
        self._pattern, self._placed = space.pattern, space.vertices
        self._grid = grid_of(space)
        self._companion = companion_of(space) if space.size >= QUADRATIC_LEAST else None
        self._factor = Factor(self._grid, None if self._companion is None else film_on_nodes(self._companion))
        self._general = GeneralFactor(self._grid)
        self._near = NearFactor()
        self._cascade: Cascade | None = None
        self._answers: _Answers | None = None
        self._answered: FilmSolution | None = None  # the film that came of them
        self._tried = CONSTANT  # the fluid whose laws are checked

    def solve(self, problem: FilmProblem, start: FilmSolution | None = None) -> FilmSolution:
        """The film of `problem`; `start` gives the first pressures, film fractions and cavity.

        Afterwards every free unknown's flow balance holds to 1e-9 of the flows that meet there. Raises
        FilmInputError as `check_pressures` and `check_laws` do and for a `start` or a problem of another mesh, and
        FilmNotConverged when that is not reached or a cavity has a negative film fraction.
        """
        if problem.space.pattern is not self._pattern:
            raise FilmInputError("space", "another mesh", "the space of this solver, moved or not")
        if problem.fluid is not CONSTANT and problem.fluid is not self._tried:
            check_laws(problem.fluid, problem.film.viscosity, problem.space.area.shape)
            self._tried = problem.fluid
        if start is not None and len(start.pressure) != problem.space.size:
            raise FilmInputError("start", "a film of another mesh", "one of the space of this solver")
        if start is None and (simpler := _simpler(problem)) is not None:
            try:
                return self._solved(problem, self.solve(simpler))
            except FilmNotConverged:
                pass  # the simpler film does not help, or has no solution itself: a cold start
        return self._solved(problem, start)

    def _solved(self, problem: FilmProblem, start: FilmSolution | None) -> FilmSolution:
        setting = spread(problem)
        at = self._begin(problem, setting, start)
        seen = {at.cavity.tobytes()}
        cycles = near = False
        path: list[float] = []
        soft_series = keeps = start is not None and start.problem.walls is not None and problem.walls is not None
        imbalance = imbalance_of(problem, setting, at) if soft_series else 1.0
        for iteration in range(1, MAX_ITERATIONS + 1):
            tolerance = max(ITERATIVE_TOLERANCE, min(LOOSEST, 0.1 * ROUND_OFF / max(imbalance, ROUND_OFF)))
            if problem.walls is not None:  # no step between them is exact: the gain of Newton's method is enough
                tolerance = max(tolerance, min(SOFT_STEP, 0.1 * imbalance))
            keeps = keeps and imbalance < KEPT and self._serves(fixed_in(problem, setting, at), at)
            signed = (
                self._step_kept(problem, setting, at, tolerance, imbalance)
                if keeps
                else self._step(problem, setting, at, tolerance, imbalance)
            )
            if iteration == 1 and (guessed := self._ruptured(problem, setting, at, signed)) is not at:
                at, signed = guessed, self._step(problem, setting, guessed, tolerance, imbalance)
            new = advanced(problem, setting, at, signed, downhill=cycles)
            settled, at = bool(np.array_equal(new.cavity, at.cavity)), new
            _check_degree(problem, at.cavity)
            before, imbalance = imbalance, imbalance_of(problem, setting, at)
            enough = ROUND_OFF if keeps else TOLERANCE  # a kept one's step gains less than Newton's
            keeps = soft_series and (not keeps or imbalance < KEPT_GAIN * before)
            path.append(imbalance)
            if (settled and imbalance < ROUND_OFF) or (imbalance < enough and near):
                _check_filled(at)
                self._answered = _solution(problem, setting, at, path)
                return self._answered
            # Under JFO an unknown near zero may change sides indefinitely: either side is the solution.
            near = imbalance < (NEAR if settled else TOLERANCE if problem.cavitation is Cavitation.JFO else 0.0)
            cycles |= iteration >= FULL_STEPS or (not settled and at.cavity.tobytes() in seen)
            seen.add(at.cavity.tobytes())
        raise _not_settled(problem, at, imbalance)

    def _begin(self, problem: FilmProblem, setting: BoundaryValues, start: FilmSolution | None) -> Iterate:
        space, cavitates = problem.space, problem.cavitation is not Cavitation.NONE
        pressure, fraction = setting.pressure.copy(), setting.film_fraction
        cavity, near = np.zeros(space.size, dtype=bool), None
        if start is None and problem.walls is not None:
            pressure = _lifting(problem, setting)
        if start is not None:
            pressure = np.where(setting.held, pressure, start.pressure)
            near = start.deformation
            fraction = np.where(setting.held, fraction, start.film_fraction)
            cavity = start.cavity & ~setting.held & cavitates
        for node, pocket in setting.pockets:
            sent = 0.0 if start is None else -LESS * float(start.outflow[node])
            level = pressure_sending(pocket.feed, sent, float(pressure[node]))
            pressure[node] = max(level, problem.cavitation_pressure) if cavitates else level
        return iterate_of(problem, deformed(problem, pressure, fraction, near), cavity)

    def _ruptured(self, problem: FilmProblem, setting: BoundaryValues, at: Iterate, signed: Array) -> Iterate:
        """The iterate with a first guess of its cavity, if pressures without one fall below (`signed` < 0)."""
        pulled = problem.cavitation is not Cavitation.NONE and bool((signed[~setting.held] < 0.0).any())
        if at.cavity.any() or not pulled or not is_linear(problem) or problem.space.size <= COARSEST:
            return at
        # Free unknowns of the spread pressures are at cavitation pressure: the step from there is p - p_c.
        spread_out = deformed(problem, setting.pressure, setting.film_fraction)
        cavity = self._cavity(problem, setting, iterate_of(problem, spread_out, at.cavity))
        return replace(at, cavity=cavity)

    def _cavity(self, problem: FilmProblem, setting: BoundaryValues, at: Iterate) -> NDArray[np.bool_]:
        """A first guess, from coarser problems under Reynolds' condition.

        Exact for that condition under JFO, whose steps cost more, and on meshes that the coarser ones do not resolve.
        """
        matrix, load = symmetric_step(problem, setting, at, setting.held)
        obstacle = Obstacle(matrix.data, load, setting.held)
        if self._cascade is None:
            self._cascade = Cascade(matrix, self._grid)
        guess, costly = self._cascade.cavity(obstacle), problem.cavitation is Cavitation.JFO
        return active_set(matrix, self._factor, obstacle, guess) if costly or guess.size > FINEST else guess

    def _answer(self, solution: FilmSolution) -> _Answers | None:
        """The last linearised balance, if it is of that film, with the same cavity except full unknowns."""
        kept = self._answers
        if kept is None or self._answered is not solution:
            return None
        return kept if np.array_equal(kept.at.cavity, solution.cavity) else None

    def operators(self, solution: FilmSolution) -> Operators:
        """The operators of a solution's balance; those of the last film are known."""
        kept = self._answer(solution)
        if kept is not None and is_linear(solution.problem):
            return kept.at.parts
        return operators(solution.problem, FilmState(solution.pressure, solution.film_fraction, solution.deformation))

    def response(
        self, solution: FilmSolution, inflow: Array, tolerance: float = ITERATIVE_TOLERANCE
    ) -> tuple[Array, Array]:
        """Changes of pressures (Pa) and film fractions of a solution by inflows (size, m) m3/s, (size, m) each.

        By its linearised balance at constant held unknowns and cavity: a free unknown changes pressure, one of
        the cavity its film fraction. Where the last film solved is this one its last factor is used again, which
        for a balance that is not linear was made some 1e-6 before the solution, or `tolerance` before it.
        """
        kept = self._answer(solution)
        if kept is None or kept.aged > tolerance:
            problem, state = (
                solution.problem,
                FilmState(solution.pressure, solution.film_fraction, solution.deformation),
            )
            kept, _ = self._linear(problem, spread(problem), iterate_of(problem, state, solution.cavity))
            self._answered = solution
        return kept.to(inflow, tolerance)

    def _serves(self, fixed: NDArray[np.bool_], at: Iterate) -> bool:
        """True if the last linearisation has the same unknowns: held ones, pressures and cavity."""
        kept = self._answers
        return kept is not None and bool(
            np.array_equal(kept.at.cavity, at.cavity) and np.array_equal(kept.fixed, fixed)
        )

    def _step(
        self, problem: FilmProblem, setting: BoundaryValues, at: Iterate, tolerance: float, imbalance: float
    ) -> Array:
        """The signed unknowns after one Newton step of the free ones; held ones stay."""
        made, load = self._linear(problem, setting, at, imbalance)
        return signed_after(problem, at, made.solve(load, tolerance), made.scale)

    def _step_kept(
        self, problem: FilmProblem, setting: BoundaryValues, at: Iterate, tolerance: float, imbalance: float
    ) -> Array:
        """The same by the last linearisation, of the same unknowns: the simplified Newton method."""
        assert self._answers is not None
        self._answers = kept = self._answers.again_from(imbalance)
        self._answered = None
        load = np.where(kept.fixed, 0.0, -with_pockets(setting, at)[0] / kept.unit)
        return signed_after(problem, at, kept.solve(load, tolerance), kept.scale)

    def _linear(
        self, problem: FilmProblem, setting: BoundaryValues, at: Iterate, imbalance: float = 0.0
    ) -> tuple[_Answers, Array]:
        """The balance linearised at an iterate of such an imbalance, and the load of a Newton step.

        Both are scaled alike. Afterwards this is the solver's last linearised balance, of no film yet.
        """
        conserving = problem.cavitation is Cavitation.JFO and bool(at.cavity.any())
        fixed, scale = fixed_in(problem, setting, at), 0.0
        if is_linear(problem) and not conserving:
            matrix, load = symmetric_step(problem, setting, at, fixed)
            self._factor.update(matrix, self._of_companion(problem, at, fixed))
            solve = row_by_row(self._factor.solve)
        else:
            upper, lower, load, scale = general_step(problem, setting, at)
            if problem.walls is None:
                self._general.update(problem.space.matrix(upper), lower, at.cavity)
                solve = self._general.solve
            else:
                solve = row_by_row(compliant(problem, setting, at, upper, lower, self.patterns, self._near))
        made = _Answers(solve, at, fixed, scale, imbalance)
        self._answers, self._answered = made, None
        return made, load

    def _of_companion(self, problem: FilmProblem, at: Iterate, fixed: NDArray[np.bool_]) -> Array | None:
        """Entries of a quadratic film's companion, None without one."""
        if self._companion is None:
            return None
        if problem.space.vertices is not self._placed:
            self._companion, self._placed = self._companion.moved(problem.space.vertices), problem.space.vertices
        return self._companion.entries(at.parts.transport.conductance, fixed)


def as_given(problem: FilmProblem, given: FilmSolution) -> FilmSolution:
    """The film of `problem` at the pressures, film fractions and deformation of another one.

    Its flows are theirs, with their imbalance. Raises as the laws do.
    """
    setting = spread(problem)
    at = iterate_of(problem, FilmState(given.pressure, given.film_fraction, given.deformation), given.cavity)
    return _solution(problem, setting, at, [imbalance_of(problem, setting, at)])


@dataclass(frozen=True)
class _Answers:
    """The linearised balance of a film at an iterate, ready to be solved.

    `solve(load or rows of them, tolerance)`, both sides scaled; `scale` turns an unknown of the cavity into a film
    fraction; `made`: imbalance of the iterate; `aged`: imbalance of the iterate that uses them.
    """

    solve: Solve
    at: Iterate
    fixed: NDArray[np.bool_]
    scale: float
    made: float = 0.0
    aged: float = 0.0

    def again_from(self, imbalance: float) -> _Answers:
        """The same for an iterate of another imbalance, maybe of another problem."""
        return replace(self, aged=max(self.made, self.aged, imbalance))

    @property
    def unit(self) -> float:
        """Scale of the balance in `newton`, m3/(s Pa)."""
        return float(self.at.parts.stiffness.max())

    def to(self, inflow: Array, tolerance: float) -> tuple[Array, Array]:
        """Changes of pressures and film fractions by inflows (size, m) m3/s, (size, m) each."""
        if self.unit == 0.0:
            raise FilmInputError("response", "a film that is all pocket", "one in which pressure drives a flow")
        load = np.where(self.fixed[:, None], 0.0, inflow / self.unit)
        change = self.solve(np.ascontiguousarray(load.T), tolerance).T
        cavity = self.at.cavity[:, None]
        return np.where(cavity, 0.0, change), np.where(cavity, self.scale * change, 0.0)


def _not_settled(problem: FilmProblem, at: Iterate, imbalance: float) -> FilmNotConverged:
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


def _check_filled(at: Iterate) -> None:
    """Raise for a cavity of negative film fraction: upwinding leaves none below zero, obtuse angles little."""
    if (least := float(at.state.film_fraction.min())) < LEAST_FRACTION:
        raise FilmNotConverged(
            f"more oil drawn from a cavity than flows into it (film fraction {least:.3g})",
            "pockets that draw less, or a mesh without obtuse angles",
        )


def _check_degree(problem: FilmProblem, cavity: NDArray[np.bool_]) -> None:
    if problem.space.degree > 1 and cavity.any():
        raise FilmInputError(
            "film_space", "quadratic pressure in a film that cavitates", "degree 1, or a film without cavitation"
        )


def _simpler(problem: FilmProblem) -> FilmProblem | None:
    """The film from which Newton's method reaches this one: of constant oil, then between rigid walls."""
    if problem.fluid is not CONSTANT:
        return replace(problem, fluid=CONSTANT)
    if problem.walls is not None and problem.film.thickness.min() > 0.0:
        return replace(problem, walls=None)
    return None


def _lifting(problem: FilmProblem, setting: BoundaryValues) -> Array:
    """Pressures (size,) Pa to start from between walls that overlap until a pressure parts them."""
    assert problem.walls is not None
    one = np.where(setting.held, 0.0, 1.0)
    wider = problem.space.sample_vertices(problem.walls.matrix @ one)
    lack = LEAST_GAP * np.abs(problem.film.thickness).max() - problem.film.thickness
    lack = lack - problem.space.sample_vertices(problem.walls.matrix @ np.where(setting.held, setting.pressure, 0.0))
    needed = float(np.max(np.divide(lack, wider, out=np.zeros_like(wider), where=wider > 0.0)))
    return np.where(setting.held, setting.pressure, np.maximum(setting.pressure, needed))


def _solution(problem: FilmProblem, setting: BoundaryValues, at: Iterate, path: list[float]) -> FilmSolution:
    conserving = problem.cavitation is Cavitation.JFO and bool(at.cavity.any())
    return FilmSolution(
        problem=problem,
        pressure=at.state.pressure,
        film_fraction=at.state.film_fraction,
        film=at.parts.transport.film,
        deformation=at.state.deformation,
        flux=at.parts.transport.flux,
        content=at.parts.transport.content,
        outflow=-at.balance.net,
        storage_rate=at.balance.storage_rate,
        upwind_exchange=at.balance.upwind_exchange,
        flow_scale=at.balance.flow_scale,
        held=setting.held,
        cavity=without_full(at.cavity, at.state.film_fraction) if conserving else at.cavity,
        path=tuple(path),
    )


def without_full(cavity: NDArray[np.bool_], fraction: Array) -> NDArray[np.bool_]:
    """A cavity without the unknowns that are full of oil: there is a film at the cavitation pressure."""
    return np.asarray(cavity & (fraction <= 1.0 - TOLERANCE))
