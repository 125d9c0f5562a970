"""Steps in time: diagonally implicit Runge-Kutta methods.

On equations of one line, stiff and not, whose solutions are known.
"""

from __future__ import annotations

import numpy as np
import pytest
from known_rates import Rate, Stage, stages

from reynolds import (
    ALEXANDER_2,
    BACKWARD_EULER,
    FilmInputError,
    FilmNotConverged,
    Tableau,
    advance,
    integrate,
    nodes_only,
)
from reynolds.numerics.dirk import State, StateTangent, within

METHODS = pytest.mark.parametrize("tableau", [BACKWARD_EULER, ALEXANDER_2], ids=["euler", "alexander"])


def _start(*y: float, rate: float = 0.0) -> State[Stage]:
    at = np.array(y)
    return State(0.0, at, at, np.full(len(at), rate))


def _last(tableau: Tableau, rate: Rate, start: State[Stage], end: float, steps: int) -> np.ndarray:
    nodes = end * np.arange(1, steps + 1) / steps
    *_, taken = integrate(tableau, stages(rate), start, nodes, nodes_only)
    return taken.state.q


def _swinging(t: float, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """y' = y cos(t) - y^2 + sin(t)^2 ...: neither linear nor autonomous; y = 2 + sin t."""
    exact, slope = 2.0 + np.sin(t), np.cos(t)
    return slope - y**2 + exact**2, np.diag(-2.0 * y)


@METHODS
def test_order_of_the_solution(tableau, validation):
    errors = [abs(_last(tableau, _swinging, _start(2.0), 2.0, n)[0] - 2.0 - np.sin(2.0)) for n in (40, 80, 160)]
    order = np.log2(errors[1] / errors[2])
    validation(
        case="Order of the steps in time",
        source="Alexander 1977",
        quantity=f"y' = (2 + sin t)' + (2 + sin t)^2 - y^2, {len(tableau.places)} stage(s): order",
        unit="1",
        expected=tableau.order,
        obtained=order,
        tolerance=0.1,
    )


@METHODS
def test_order_of_the_error_estimate(tableau):
    """One step on y' = y: the estimate is the true local error but for one order more."""
    gaps = []
    for step in (0.02, 0.01):
        taken = advance(tableau, stages(lambda t, y: (y, np.eye(1))), _start(1.0, rate=1.0), step)
        true = np.exp(step) - taken.state.q[0]
        assert taken.error[0] == pytest.approx(true, rel=5.0 * step)
        gaps.append(abs(taken.error[0] - true))
    assert np.log2(gaps[0] / gaps[1]) == pytest.approx(tableau.error_order + 1, abs=0.1)


def test_error_estimate_of_a_quadrature():
    """y' = t^2: seven times the true local error, as the method says of itself."""
    step = 0.1
    taken = advance(ALEXANDER_2, stages(lambda t, y: (np.array([t**2]), np.zeros((1, 1)))), _start(0.0), step)
    true = step**3 / 3.0 - taken.state.q[0]
    assert taken.error[0] / true == pytest.approx(4.0 + 2.0 * np.sqrt(2.0), rel=1e-9)


@METHODS
def test_stable_and_forgetful(tableau):
    """y' = a y: |y| falls for every a on the left, and to nothing in one step for a stiff one (L-stable)."""
    for angle in np.linspace(0.5 * np.pi, np.pi, 19):
        for size in (1e-2, 1.0, 1e2, 1e4):
            re, im = size * np.cos(angle), size * np.sin(angle)
            turning = np.array([[re, -im], [im, re]])
            after = advance(tableau, stages(lambda t, y, m=turning: (m @ y, m)), _start(1.0, 0.0), 1.0).state.q
            assert np.hypot(*after) <= 1.0 + 1e-12
    stiff = advance(tableau, stages(lambda t, y: (-1e9 * y, np.array([[-1e9]]))), _start(1.0), 1.0).state.q
    assert abs(stiff[0]) < 1e-8


@METHODS
def test_prothero_robinson(tableau, validation):
    """y' = -k (y - sin t) + cos t with k = 1e6: stiff, and y = sin t all the same."""
    stiffness = 1e6

    def rate(t: float, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return -stiffness * (y - np.sin(t)) + np.cos(t), np.array([[-stiffness]])

    coarse, fine = (_last(tableau, rate, _start(0.0, rate=1.0), 1.0, n)[0] for n in (20, 40))
    validation(
        case="Stiff equation of Prothero and Robinson",
        source="Prothero and Robinson 1974: y = sin t",
        quantity=f"y(1), {len(tableau.places)} stage(s), step times stiffness 25 000",
        unit="1",
        expected=np.sin(1.0),
        obtained=fine,
        tolerance=1.0 / (40.0 * stiffness),
        note="tolerance: what y'' <= 1 changes in a step over the stiffness",
    )
    assert abs(fine - np.sin(1.0)) < abs(coarse - np.sin(1.0))


def _van_der_pol(t: float, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    eps = 1e-3
    pull = ((1.0 - y[0] ** 2) * y[1] - y[0]) / eps
    slope = np.array([[0.0, 1.0], [(-2.0 * y[0] * y[1] - 1.0) / eps, (1.0 - y[0] ** 2) / eps]])
    return np.array([y[1], pull]), slope


@pytest.fixture(scope="module")
def relaxed() -> np.ndarray:
    """Van der Pol at t = 0.5, before its first jump, by Radau's method to 1e-11."""
    from scipy.integrate import solve_ivp

    found = solve_ivp(
        lambda t, y: _van_der_pol(t, y)[0], (0.0, 0.5), [2.0, -0.66], method="Radau", rtol=1e-11, atol=1e-12
    )
    return found.y[:, -1]


@METHODS
def test_error_control(tableau, relaxed):
    """Van der Pol, eps = 1e-3: each step keeps its tolerance, and the end that of all of them."""
    errors, steps = [], []
    for tolerance in (1e-4, 1e-5):
        taken = list(integrate(tableau, stages(_van_der_pol), _start(2.0, -0.66), [0.5], within(tolerance)))
        errors.append(np.abs(taken[-1].state.q - relaxed).max())
        steps.append(len(taken))
        assert all(step.largest_error <= tolerance for step in taken)
        assert errors[-1] < len(taken) * tolerance
    assert errors[1] < 0.5 * errors[0]
    assert steps[1] / steps[0] < 2.0 * 10.0 ** (1.0 / tableau.error_order)


def test_steps_grow_and_shrink():
    """A pulse: short steps in it, long ones beside it."""

    def rate(t: float, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return np.array([np.exp(-(((t - 5.0) / 0.05) ** 2))]), np.zeros((1, 1))

    nodes = np.arange(1.0, 10.5)
    taken = list(integrate(ALEXANDER_2, stages(rate), _start(0.0), nodes, within(1e-6)))
    short = [step.step for step in taken if abs(step.state.time - 5.0) < 0.1]
    beside = [step.step for step in taken if step.state.time < 4.0]
    assert max(short) < 0.02
    assert max(beside) == 1.0
    assert taken[-1].state.q[0] == pytest.approx(0.05 * np.sqrt(np.pi), abs=1e-5)


def test_a_jump_is_taken_by_the_shortest_step():
    """A state without mass that jumps by 1 at t = 0.3: no step resolves it, the shortest one takes it."""

    def solve(time, before, step, guess, last):
        return Stage(np.array([1.0 if time > 0.3 else 0.0]), np.zeros((1, 1)))

    shortest = 1e-4
    taken = list(integrate(BACKWARD_EULER, solve, _start(0.0), [1.0], within(1e-3), shortest))
    assert taken[-1].state.q[0] == 1.0
    jumps = [step for step in taken if step.largest_error > 1e-3]
    assert 1 <= len(jumps) <= 3  # the error of the next step still knows of it
    assert all(jump.step <= shortest for jump in jumps)
    assert 0.3 < jumps[0].state.time < 0.3 + shortest


def test_an_error_that_is_no_number_is_no_jump():
    """The shortest step takes a jump, but no state whose error is not a number."""
    swinging = stages(_swinging)

    with pytest.raises(FilmNotConverged, match="error nan times its tolerance"):
        next(integrate(BACKWARD_EULER, swinging, _start(2.0), [1.0], lambda taken: np.nan, shortest=1e-3))


@METHODS
def test_nodes_are_met(tableau):
    nodes = [0.1, 0.1001, 0.7, 1.3]
    taken = integrate(tableau, stages(_swinging), _start(2.0), nodes, within(1e-4))
    assert set(nodes) <= {step.state.time for step in taken}


@METHODS
def test_the_last_stage_is_at_the_node(tableau):
    """The sum of a time and the way to a node may differ from it by round-off: a stage knows its node as itself."""
    nodes = [0.6, 1.7]
    assert nodes[0] + (nodes[1] - nodes[0]) != nodes[1]
    swinging, solved = stages(_swinging), []

    def solve(time, before, step, guess, last):
        solved.append(time)
        return swinging(time, before, step, guess, last)

    list(integrate(tableau, solve, _start(2.0), nodes, nodes_only))
    assert set(nodes) <= set(solved)


@METHODS
def test_tangent(tableau):
    """d y(end)/d y(0) of a linear equation: as often the stage's own slopes; else as differences tell it."""
    start = _start(2.0, -0.66)
    nodes = np.linspace(0.0, 0.3, 31)[1:]

    def end(first: np.ndarray) -> np.ndarray:
        *_, taken = integrate(tableau, stages(_van_der_pol), State(0.0, first, first, start.rate), nodes, nodes_only)
        return taken.state.q

    tangent = StateTangent(np.eye(2), np.eye(2))
    begin = State(0.0, start.q, start.q, start.rate, tangent=tangent)
    *_, taken = integrate(tableau, stages(_van_der_pol), begin, nodes, nodes_only)
    differences = np.column_stack([(end(start.q + d) - end(start.q - d)) / 2e-5 for d in 1e-5 * np.eye(2)])
    assert taken.state.tangent is not None
    np.testing.assert_allclose(taken.state.tangent.q, differences, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(taken.state.tangent.held, taken.state.tangent.q)


def test_a_stage_without_solution_halves_the_step():
    swinging = stages(_swinging)

    def solve(time, before, step, guess, last):
        if step > 0.01:
            raise FilmNotConverged("walls overlap", "a smaller step")
        return swinging(time, before, step, guess, last)

    taken = list(integrate(BACKWARD_EULER, solve, _start(2.0), [0.1], nodes_only))
    assert max(step.step for step in taken) <= 0.01
    assert taken[-1].state.time == 0.1


def test_no_step_short_enough():
    def solve(time, before, step, guess, last):
        raise FilmNotConverged("walls overlap", "another shape")

    with pytest.raises(FilmNotConverged, match=r"at 0 s, step .*walls overlap.*another shape"):
        next(integrate(BACKWARD_EULER, solve, _start(2.0), [0.1], nodes_only))


@pytest.mark.parametrize("nodes", [[], [0.0], [0.2, 0.1], [np.nan]])
def test_nodes_that_do_not_rise(nodes):
    with pytest.raises(FilmInputError, match="times that rise from 0 s on"):
        next(integrate(BACKWARD_EULER, stages(_swinging), _start(2.0), nodes, nodes_only))
