"""Levels of scattered set points, and points predicted by fits without them."""

from __future__ import annotations

import numpy as np
import pytest

from system.estimation.folds import levels

RNG = np.random.default_rng(11)


@pytest.mark.parametrize(
    "places", [[1000, 1300, 1700, 2100], [0.28, 0.51, 0.77, 1.0], [10, 20, 50, 100, 200, 350], np.arange(1, 16), [3, 5]]
)
@pytest.mark.parametrize("scatter", [0.0, 0.01])
def test_levels_are_found_again(places, scatter):
    """Scatter of a hundredth of the least distance between two levels."""
    least = np.min(np.diff(places))
    truth = RNG.permutation(np.repeat(np.arange(len(places)), 7))
    values = np.asarray(places, dtype=float)[truth] + scatter * least * RNG.standard_normal(truth.size)
    assert np.array_equal(levels(values), truth)


@pytest.mark.parametrize("unit", [1e-6, 1e7])
def test_levels_are_those_in_any_unit(unit):
    truth = RNG.permutation(np.repeat(np.arange(4), 7))
    values = np.array([0.28, 0.51, 0.77, 1.0])[truth] + 1e-3 * RNG.standard_normal(truth.size)
    assert np.array_equal(levels(unit * values), truth)


def test_values_without_levels_are_one():
    assert set(levels(np.full(12, 3.0))) == {0}
    whole = sum(len(set(levels(RNG.uniform(size=112)))) == 1 for _ in range(100))
    assert whole >= 95
