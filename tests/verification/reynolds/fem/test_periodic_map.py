"""Periodic motion by linearised turns.

On equations of one or two lines, with the turn taken by the steps in time.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from known_rates import stages

from reynolds import ALEXANDER_2, FilmNotConverged, integrate, nodes_only
from reynolds.numerics.dirk import State, StateTangent
from reynolds.numerics.shooting import approached, one_turn, periodic

DAMPING, LOAD, TURN = 3.0e5, 40.0, 2.0 * np.pi / 220.0  # N s/m, N, s: REF90's slipper at 10 um and 2100 1/min


@dataclass(frozen=True)
class Turn:
    """One turn of an equation of motion."""

    start: np.ndarray
    end: np.ndarray
    slopes: np.ndarray
    path: np.ndarray
    allowed: float = 1e-12
    reach: float = 1.0
    repeats: bool = True


def _turn(rate: Callable, period: float, steps: int, *, reach: float = 1.0, allowed: float = 1e-12):
    """Turns of y' = rate(t, y)[0]."""

    solve = stages(rate)

    def run(start: np.ndarray, before: Turn | None) -> Turn:
        one = np.eye(len(start))
        state = State(0.0, start, start, np.zeros(len(start)), tangent=StateTangent(one, one))
        nodes = period * np.arange(1, steps + 1) / steps
        path = [taken.state for taken in integrate(ALEXANDER_2, solve, state, nodes, nodes_only)]
        return Turn(start, path[-1].q, path[-1].tangent.q, np.array([at.q for at in path]), allowed, reach)

    return run


def _hydrostatic(stiffness: float):
    """c h' = -k h + W cos wt: what is left of a hydrostatic film that a small load sways."""
    speed = 2.0 * np.pi / TURN

    def rate(t: float, h: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return (LOAD * np.cos(speed * t) - stiffness * h) / DAMPING, np.array([[-stiffness / DAMPING]])

    return rate


@pytest.mark.parametrize("stiffness", [1e5, 1e7, 1e9])
def test_film_that_sways(stiffness, validation):
    """Amplitude W/(k^2 + (c w)^2)^1/2, a disturbance down to exp(-2 pi k/(c w)) a turn; found in one step.

    Soft (a disturbance lives for many turns), as stiff as it is damped, and stiff (the film follows its load).
    """
    speed = 2.0 * np.pi / TURN
    found = periodic(_turn(_hydrostatic(stiffness), TURN, 360, allowed=1e-15), np.array([1e-5]))
    assert found.turns == 2, "a linear map is solved by one step"
    h, time = found.turn.path[:, 0], TURN * np.arange(1, 361) / 360
    wave = 2.0 * np.mean(h * np.exp(-1j * speed * time))
    exact = LOAD / (stiffness + 1j * speed * DAMPING)
    source = "closed form: c h' + k h = W cos wt"
    what = f"k/(c w) = {stiffness / (DAMPING * speed):.3g}"
    tolerance = 1e-3  # of two stages and 360 steps: (2 pi/360)^2 = 3e-4
    validation(
        case="Hydrostatic film under an oscillating load, periodic",
        source=source,
        quantity=f"amplitude, {what}",
        unit="m",
        expected=abs(exact),
        obtained=abs(wave),
        relative_tolerance=tolerance,
    )
    validation(
        case="Hydrostatic film under an oscillating load, periodic",
        source=source,
        quantity=f"phase, {what}",
        unit="rad",
        expected=np.angle(exact),
        obtained=np.angle(wave),
        tolerance=tolerance,
    )
    validation(
        case="Hydrostatic film under an oscillating load, periodic",
        source=source,
        quantity=f"what a turn leaves of a disturbance, {what}",
        unit="1",
        expected=np.exp(-stiffness * TURN / DAMPING),
        obtained=found.multipliers[0].real,
        tolerance=tolerance,
    )


def _sinking(t: float, h: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """h' = h^3 (1/h - 1 + 0.8 cos t)/20: a film that is hard to press out and holds its load at h = 1."""
    load = 1.0 - 0.8 * np.cos(t)
    return (h**2 - load * h**3) / 20.0, np.diag((2.0 * h - 3.0 * load * h**2) / 20.0)


@pytest.mark.parametrize("start", [0.05, 0.3, 3.0])
def test_film_that_is_hard_to_press_out(start):
    """From far away, where marching takes hundreds of turns: a start in reach each time, and few turns."""
    turn = _turn(_sinking, 2.0 * np.pi, 60, reach=0.5, allowed=1e-10)
    found = periodic(turn, np.array([start]))
    assert found.turns <= 12
    assert found.changes[-1] <= 1e-10
    again = turn(found.turn.end, None)
    assert again.end[0] == pytest.approx(found.start[0], abs=1e-9)
    nudged = [turn(found.start + d, None).end[0] for d in (1e-5, -1e-5)]
    assert found.multipliers[0].real == pytest.approx((nudged[0] - nudged[1]) / 2e-5, rel=1e-6)


def test_two_coordinates_that_turn():
    """A damped oscillator: its multipliers are a pair, exp((-d +- i w) T)."""
    damping, speed, period = 0.02, 0.9, 2.0 * np.pi
    matrix = np.array([[-damping, -speed], [speed, -damping]])

    def rate(t: float, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return matrix @ y + np.array([np.cos(t), 0.0]), matrix

    found = periodic(_turn(rate, period, 400, reach=100.0, allowed=1e-10), np.array([30.0, -20.0]))
    assert found.turns == 2
    expected = np.exp((-damping + 1j * speed) * period)
    assert np.min(np.abs(found.multipliers - expected)) < 1e-3
    assert found.largest_multiplier == pytest.approx(abs(expected), rel=1e-3)


def test_unstable_motion_is_left():
    """y' = y - y^3 + cos(t)/10 swings unstably about 0 and stably about 1: the way leads there."""
    rate = lambda t, y: (y - y**3 + 0.1 * np.cos(t), np.diag(1.0 - 3.0 * y**2))  # noqa: E731
    found = periodic(_turn(rate, 2.0 * np.pi, 100, reach=0.2), np.array([0.05]))
    assert found.start[0] == pytest.approx(1.0, abs=0.1)
    assert found.largest_multiplier < 1e-4


@dataclass(frozen=True)
class Mapped:
    end: np.ndarray
    slopes: np.ndarray
    allowed: float = 1e-10
    reach: float = 10.0
    repeats: bool = True


@pytest.mark.parametrize("growth", [1.06, 1.4])
def test_motion_that_turns_circle_about_is_found(growth):
    """Turns lead round and away from the periodic motion, as a light piston whirls in its bore: Newton's step there."""
    around, middle = 0.8, np.array([3.0, -2.0])
    slopes = growth * np.array([[np.cos(around), -np.sin(around)], [np.sin(around), np.cos(around)]])

    def turn(start, before):
        return Turn(start, middle + slopes @ (start - middle), slopes, np.zeros((0, 2)), reach=0.5)

    found = periodic(turn, np.zeros(2))
    assert found.start == pytest.approx(middle, abs=1e-11)
    assert found.largest_multiplier == pytest.approx(growth)


def test_step_that_overshoots_is_taken_back():
    """end = start - arctan(3 start)/3: Newton's method alone runs away from |start| > 0.46."""

    def turn(start: np.ndarray, before: Mapped | None) -> Mapped:
        slope = 1.0 - 1.0 / (1.0 + 9.0 * start**2)
        return Mapped(start - np.arctan(3.0 * start) / 3.0, np.diag(slope))

    found = periodic(turn, np.array([4.0]))
    assert abs(found.start[0]) < 1e-9
    assert found.turns < 25


def test_a_turn_that_does_not_repeat_goes_on():
    """Anything else that a turn leaves behind (here: the count of turns) returns too."""
    count = []

    def turn(start: np.ndarray, before: Mapped | None) -> Mapped:
        count.append(before)
        return Mapped(start, np.zeros((1, 1)), repeats=len(count) == 4)

    assert periodic(turn, np.array([1.0])).turns == 4
    assert count[0] is None
    assert count[1] is not None


def test_motion_that_never_closes():
    def turn(start: np.ndarray, before: Mapped | None) -> Mapped:
        return Mapped(start - 1e-6, np.eye(1))

    with pytest.raises(FilmNotConverged, match=r"30 turns.*1e-06 m"):
        periodic(turn, np.array([1e-5]))


def test_one_turn_leads_on():
    """One turn, however far from closed, tells where all linearised ones after it lead: here to the fixed point."""
    slopes, middle = np.array([[0.9, 0.1], [0.0, 0.5]]), np.array([3.0, -2.0])

    def turn(start: np.ndarray, before: Turn | None) -> Turn:
        return Turn(start, middle + slopes @ (start - middle), slopes, np.zeros((0, 2)), reach=10.0)

    found = one_turn(turn, np.zeros(2))
    assert found.turns == 1
    assert np.array_equal(found.start, np.zeros(2))
    assert found.onward == pytest.approx(middle, rel=1e-9)


def test_next_to_the_periodic_motion():
    """A turn that forgets its start is next to the periodic motion by its end, though its start was far away."""
    forgets = _turn(_hydrostatic(10.0 * DAMPING / TURN), TURN, 40, allowed=1e-8)
    far = np.array([1e-4])
    assert np.array_equal(approached(forgets, far).start, far)
    closed = periodic(forgets, far)
    assert closed.turns == 2
    assert approached(forgets, far).turn.end == pytest.approx(closed.turn.end, abs=1e-8)
    slow = _turn(_hydrostatic(0.1 * DAMPING / TURN), TURN, 40, allowed=1e-8)
    assert approached(slow, far).turn.end == pytest.approx(periodic(slow, far).turn.end, abs=1e-8)
    pushed = _turn(lambda t, h: (np.array([-1e-3]), np.zeros((1, 1))), TURN, 4, reach=1e-6)
    with pytest.raises(FilmNotConverged, match="not periodic after 30 turns"):
        approached(pushed, far)


def test_centre_of_a_wide_circle_is_found():
    """Turns on a circle that is wide beside the reach, as a piston whirls along its bore: not round it, but inwards."""
    around, middle, circle = 0.8, np.array([3.0, -2.0]), 10.0
    rotation = np.array([[np.cos(around), -np.sin(around)], [np.sin(around), np.cos(around)]])

    def turn(start, before):
        off = start - middle
        growth = 1.3 - 0.3 * (off @ off) / circle**2
        slopes = rotation @ (growth * np.eye(2) - 0.6 * np.outer(off, off) / circle**2)
        return Turn(start, middle + growth * rotation @ off, slopes, np.zeros((0, 2)), reach=0.38)

    found = periodic(turn, middle + np.array([circle, 0.0]))
    assert found.start == pytest.approx(middle, abs=1e-9)
    assert found.turns <= 20
