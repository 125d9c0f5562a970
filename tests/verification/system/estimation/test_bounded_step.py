"""Steps between bounds: the least of a convex model in a box, whichever bounds are active."""

from __future__ import annotations

import numpy as np
import pytest

from system.estimation.bounded_step import Bounds, Quadratic, bounded_step


def _models(count: int):
    """Models of strongly tied parameters, some of them on a bound already, with boxes of all kinds."""
    rng = np.random.default_rng(7)
    for size in rng.integers(2, 30, count):
        slopes = rng.normal(size=(size + 3, size))
        slopes[:, 0] += 3.0 * slopes[:, 1]
        xi = rng.normal(0.0, 0.3, size)
        room = rng.random(size) * (rng.random(size) < 0.5)
        lowest = np.where(rng.random(size) < 0.5, np.minimum(xi, 0.0) - room, -np.inf)
        highest = np.where(rng.random(size) < 0.3, np.maximum(xi, 0.5), np.inf)
        model = Quadratic(xi, 5.0 * rng.normal(size=size), slopes.T @ slopes + np.eye(size))
        yield model, Bounds(lowest, highest, np.ones(size, dtype=bool), np.zeros(size))


def test_a_step_is_the_least_between_the_bounds():
    """Within, and no push left but out of a bound: Karush, Kuhn and Tucker's conditions, to round-off."""
    held = 0
    for model, bounds in _models(300):
        step = bounded_step(model, bounds, 0.0, np.inf)
        reached = model.xi + step
        np.testing.assert_array_less(bounds.lowest - 1e-12, reached)
        np.testing.assert_array_less(reached, bounds.highest + 1e-12)
        left = model.gradient - model.precision @ step
        small = 1e-9 * np.abs(model.gradient).max()
        assert np.all((left < small) | (reached > bounds.highest - 1e-12))
        assert np.all((left > -small) | (reached < bounds.lowest + 1e-12))
        held += int(np.sum(np.abs(left) > small))
    assert held > 300


@pytest.mark.parametrize("damping", [0.0, 0.1, 10.0])
def test_a_step_never_promises_a_rise(damping):
    for model, bounds in _models(100):
        assert model.fall(bounded_step(model, bounds, damping, 0.3)) >= 0.0


def test_a_bound_that_is_passed_first_may_be_free_after():
    """Two tied parameters: alone the second would pass its bound, with the first on its own it does not."""
    model = Quadratic(np.zeros(2), np.array([3.0, -0.5]), np.array([[2.0, 1.5], [1.5, 2.0]]))
    bounds = Bounds(np.array([-1.0, -0.5]), np.array([0.2, 1.0]), np.ones(2, dtype=bool), np.zeros(2))
    step = bounded_step(model, bounds, 0.0, np.inf)
    assert step == pytest.approx([0.2, -0.4])


def test_only_curved_components_shorten_a_step():
    """Of two uncoupled parameters the straight one takes its whole step where it is alone in being long."""
    model = Quadratic(np.zeros(2), np.array([5.0, 0.2]), np.eye(2))
    free = np.full(2, np.inf)
    assert bounded_step(model, Bounds(-free, free, np.array([False, True]), np.zeros(2)), 0.0, 1.0) == pytest.approx(
        [5.0, 0.2]
    )
    assert bounded_step(model, Bounds(-free, free, np.array([True, True]), np.zeros(2)), 0.0, 1.0) == pytest.approx(
        [1.0, 0.04]
    )


def test_a_valley_between_two_films_is_straight_along_the_curves():
    """Leakages that replace each other, 3 spreads of 0.5: one step reaches the peak however far it is."""
    bend = np.full(2, 1.5)
    bounds = Bounds(np.full(2, -4.0), np.full(2, 4.0), np.ones(2, dtype=bool), bend)
    start, peak = np.array([-1.0, 0.8]), np.array([0.7, 0.3])
    step = bounds.step_to(start, peak)
    assert bounds.reached(start, step) == pytest.approx(peak)
    leak = np.exp(bend * start)
    assert leak + leak * bend * step == pytest.approx(np.exp(bend * peak))


def test_bounds_about_a_place_are_those_of_the_curves():
    bounds = Bounds(np.array([-2.0, -np.inf]), np.array([1.0, np.inf]), np.ones(2, dtype=bool), np.array([1.5, 0.0]))
    place = np.array([0.2, 0.1])
    about = bounds.about(place)
    assert bounds.reached(place, about.highest - place)[0] == pytest.approx(1.0)
    assert (about.lowest[1], about.highest[1]) == (-np.inf, np.inf)
