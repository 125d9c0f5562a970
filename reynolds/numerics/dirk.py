"""Steps in time for stiff motion: diagonally implicit Runge-Kutta methods with error control.

The state of a motion is a vector y (size,): of a film the oil of each unknown, whose rate is its flow balance. A stage
at time t is one step of implicit Euler, y = y_before + step rate(t, y), solved by the caller (a film with the force
balance of its floating wall, or an equation of one line). A method combines its stages to a step of higher order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import isfinite, sqrt
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.numerics.arrays import Array

MOST_REFUSALS = 25  # of one step, each at least halving it
LEAST_CHANGE, MOST_CHANGE = 0.2, 5.0  # of the step from one to the next
CAUTION = 0.9  # of the step that would just keep the tolerance
PROPORTIONAL, INTEGRAL = 0.4, 0.7  # of the step control (Gustafsson 1991), over the order of the error


class Stage(Protocol):
    """One implicit Euler step, solved."""

    @property
    def q(self) -> Array:
        """Position (k,), m, in which the error is measured."""

    @property
    def holds(self) -> Array:
        """State y at its end, (size,)."""

    def propagated(self, before: Array) -> tuple[Array, Array]:
        """Change of q (k, m) and of `holds` (size, m) for changes (size, m) of the state before.

        Called, if at all, before the next stage is solved.
        """


S = TypeVar("S", bound=Stage)

StageSolver = Callable[[float, Array, float, Array, S | None], S]
"""(time s, held before, step s, guess of q, last stage or None) -> stage; FilmNotConverged if it has none."""


@dataclass(frozen=True)
class Tableau:
    """Coefficients of a method whose last stage is the end of the step (stiffly accurate).

    Stage i is at start + places[i] step and takes matrix[i][j] step of stage j's rate; the diagonal is
    positive. `error` (stages + 1,) weighs the rates at the start and of the stages; times the step it estimates
    the local error, of order step**error_order. `order` is that of the solution at a given time.
    """

    places: tuple[float, ...]
    matrix: tuple[tuple[float, ...], ...]
    error: tuple[float, ...]
    order: int
    error_order: int


BACKWARD_EULER = Tableau(places=(1.0,), matrix=((1.0,),), error=(0.5, -0.5), order=1, error_order=2)
"""Implicit Euler; its error is the difference from the trapezium rule. Keeps every film fraction above zero."""

_GAMMA = 1.0 - sqrt(0.5)

ALEXANDER_2 = Tableau(
    places=(_GAMMA, 1.0),
    matrix=((_GAMMA, 0.0), (1.0 - _GAMMA, _GAMMA)),
    error=(-sqrt(2.0) / 3.0, 2.0 / 3.0, (sqrt(2.0) - 2.0) / 3.0),
    order=2,
    error_order=3,
)
"""Two stages, second order, L-stable (Alexander 1977).

The error is the difference from the weights that make a linear equation's step third order; that of a quadrature,
y' = f(t), is seven times less than it says.
"""


@dataclass(frozen=True)
class StateTangent:
    """Changes of position (k, m) and state (size, m) with m parameters."""

    q: Array
    held: Array


@dataclass(frozen=True)
class State(Generic[S]):
    """Between two steps: time s, position q (k,) m, state y (size,), rate dq/dt (k,) m/s, the last stage.

    The rate enters the error of the next step and, with the acceleration (k,) m/s2, its first guess, not its result.
    Both are zero where they are not known. The tangent, if any, is propagated.
    """

    time: float
    q: Array
    held: Array
    rate: Array
    acceleration: Array | float = 0.0
    stage: S | None = None
    tangent: StateTangent | None = None


@dataclass(frozen=True)
class AcceptedStep(Generic[S]):
    """One step: the state at its end, its length s, the estimate of its local error in q (k,) m."""

    state: State[S]
    step: float
    error: Array

    @property
    def largest_error(self) -> float:
        """Largest component of the error, m."""
        return float(np.abs(self.error).max())

    @property
    def stage(self) -> S:
        """The last stage, at the end of the step."""
        assert self.state.stage is not None
        return self.state.stage


def advance(
    tableau: Tableau, solve: StageSolver[S], state: State[S], step: float, end: float | None = None
) -> AcceptedStep[S]:
    """One step (s) of a method from a state, to its `end` (s): without one, a step after the state.

    Stage i solves y_i = y + step sum_j matrix[i][j] rate_j, and the last one is the end. q is integrated as if by its
    own rate, which is exact where y is linear in q (a full film); this enters the error and the guesses alone. Raises
    as `solve`.
    """
    tangent = state.tangent
    held = _beside(state.held, None if tangent is None else tangent.held)  # column 0, its tangents after it
    held_rates: list[Array] = []
    q_rates, acceleration, at = [state.rate], state.acceleration, 0.0
    stage = state.stage
    # A node may differ by round-off from the sum of a time and the way to it: the last stage is at the node itself.
    until = state.time + step if end is None else end
    times = [*(state.time + place * step for place in tableau.places[:-1]), until]
    for number, (row, place) in enumerate(zip(tableau.matrix, tableau.places, strict=True)):
        own = row[number] * step
        before = held + _sum(row[:number], held_rates, step)
        q_before = state.q + _sum(row[:number], q_rates[1:], step)
        held_before = np.ascontiguousarray(before[:, 0])
        passed, at = (place - at) * step, place
        guess = q_before + own * (q_rates[-1] + passed * acceleration)
        stage = solve(times[number], held_before, own, guess, stage)
        after = stage.holds[:, None]
        if tangent is not None:
            tangent = StateTangent(*stage.propagated(before[:, 1:]))
            after = _beside(stage.holds, tangent.held)
        held_rates.append((after - before) / own)
        q_rates.append((stage.q - q_before) / own)
        acceleration = (q_rates[-1] - q_rates[-2]) / passed
    assert stage is not None
    reached = State(until, stage.q, stage.holds, q_rates[-1], acceleration, stage, tangent)
    return AcceptedStep(reached, step, np.asarray(_sum(tableau.error, q_rates, step)))


def _beside(column: Array, others: Array | None) -> Array:
    return column[:, None] if others is None else np.column_stack([column, others])


def _sum(weights: Sequence[float], rates: Sequence[Array], step: float) -> Array | float:
    return step * sum((weight * rate for weight, rate in zip(weights, rates, strict=True)), 0.0)


def nodes_only(_: AcceptedStep[Any]) -> float:
    """Excess of a march whose steps are given: from node to node, halved only where a stage has no solution."""
    return 0.0


def within(tolerance: float) -> Callable[[AcceptedStep[Any]], float]:
    """Excess over a tolerance (m) of every coordinate at every step."""
    return lambda taken: taken.largest_error / tolerance


def integrate(
    tableau: Tableau,
    solve: StageSolver[S],
    start: State[S],
    nodes: Sequence[float] | Array,
    excess: Callable[[AcceptedStep[S]], float],
    shortest: float = 0.0,
) -> Iterator[AcceptedStep[S]]:
    """Step by step from a state to the last of `nodes` (s), each of which ends a step.

    Each step's error estimate over its tolerance, `excess(step)`, is at most one, except for steps up to `shortest`
    (s): a motion without mass may jump, and no step resolves that. The first step aims at the first node. A step on
    which a stage has no solution is halved. Raises FilmInputError for nodes that do not rise from the state's time on,
    FilmNotConverged where no step is short enough.
    """
    times = np.array([start.time, *nodes])
    if len(times) < 2 or not np.all(np.diff(times) > 0.0) or not np.all(np.isfinite(times)):
        raise FilmInputError("nodes of the march", f"{list(nodes)[:5]} s", f"times that rise from {start.time:g} s on")
    state, pace = start, Pace(times[1] - times[0])
    for node in times[1:]:
        while node - state.time > 0.0:
            taken, pace = _kept(tableau, solve, state, node, excess, shortest, pace)
            state = taken.state
            yield taken


@dataclass(frozen=True)
class Pace:
    """Step control: the step wanted (s), and the last error over its tolerance."""

    step: float
    error: float = 1.0

    def refused(self, step: float, change: float) -> Pace:
        """Pace after a rejected step."""
        return Pace(step * min(0.5, max(LEAST_CHANGE, change)), self.error)

    def kept(self, step: float, error: float, order: int) -> Pace:
        """Pace after a step of `error` <= 1 over its tolerance; one cut short by a node does not slow later ones.

        For such a step the error before is ignored.
        """
        error = max(error, 1e-6)
        if step < self.step:
            change = CAUTION * error ** (-1.0 / order)
        else:
            change = CAUTION * error ** (-INTEGRAL / order) * self.error ** (PROPORTIONAL / order)
        wanted = step * min(MOST_CHANGE, max(LEAST_CHANGE, change))
        return Pace(max(wanted, self.step) if change >= 1.0 else wanted, error)


def _kept(
    tableau: Tableau,
    solve: StageSolver[S],
    state: State[S],
    node: float,
    excess: Callable[[AcceptedStep[S]], float],
    shortest: float,
    pace: Pace,
) -> tuple[AcceptedStep[S], Pace]:
    """A step towards the node that keeps the tolerance or is no longer than the shortest, and the pace after it."""
    order, reason = tableau.error_order, FilmNotConverged("no step tried", "a later node")
    for _ in range(MOST_REFUSALS):
        step = _towards(node - state.time, pace.step)
        try:
            taken = advance(tableau, solve, state, step, node if step == node - state.time else None)
        except FilmNotConverged as failure:
            reason, pace = failure, pace.refused(step, 0.5)
            continue
        error = excess(taken)
        if error <= 1.0 or (step <= shortest and isfinite(error)):
            return taken, pace.kept(step, min(error, 1.0), order)
        reason = FilmNotConverged(
            f"error {error:.3g} times its tolerance", "a wider tolerance, or nodes where the motion bends"
        )
        pace = pace.refused(step, CAUTION * error ** (-1.0 / order))
    raise FilmNotConverged(f"at {state.time:.6g} s, step {pace.step:.2g} s: {reason.what}", reason.remedy)


def _towards(way: float, step: float) -> float:
    """The step wanted, or the whole way, or half of it where a whole step would leave a short rest.

    The whole way also where it is within the caution with which the step is wanted.
    """
    if step >= CAUTION * way:
        return way
    return min(step, 0.5 * way)
