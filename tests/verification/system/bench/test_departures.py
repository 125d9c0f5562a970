"""Departures of another make: what they span, and how large one sigma of it is."""

import numpy as np
import pytest

from system.bench.departures import MOST, departure_parameters, departures
from system.effects.components import Component

POINTS = 40
PRESSURE = np.linspace(20e5, 250e5, POINTS)
SIGMA = np.full((POINTS, 2), 1e-8)
LEAK = np.column_stack([-2e-13 * PRESSURE, 2e-13 * PRESSURE])
PARTS = {Component.PISTON_LEAKAGE: LEAK, Component.SLIPPER_LEAKAGE: 0.5 * LEAK, Component.DISPLACEMENT: 1e2 * LEAK}
SHAPES = np.column_stack([np.linspace(-1.0, 1.0, POINTS), np.log(PRESSURE / 1e7)])
NONE = np.zeros((POINTS, 2, 0))


def _left(wanted, columns, penalty=1e-6):
    """Largest share of a departure that the columns leave."""
    rows = columns.reshape(-1, columns.shape[2]) / SIGMA[0, 0]
    target = wanted.ravel() / SIGMA[0, 0]
    size = np.linalg.solve(rows.T @ rows + penalty * np.eye(rows.shape[1]), rows.T @ target)
    return np.abs(target - rows @ size).max() / np.abs(target).max()


def test_leakage_departs_by_its_shapes_and_nothing_else_does():
    columns = departures(PARTS, SHAPES, SIGMA, 0.03, NONE)
    for shape in SHAPES.T:
        assert _left(LEAK * shape[:, None], columns) < 1e-3
    assert _left(LEAK[:, ::-1] * [1.0, 0.0], columns) > 0.1


def test_one_sigma_is_the_width_of_every_part():
    """The variance of the principal columns is that of all departures together."""
    columns = departures(PARTS, SHAPES, SIGMA, 0.03, NONE)
    expected = sum((0.03 * part * shape[:, None]) ** 2 for part in (LEAK, 0.5 * LEAK) for shape in SHAPES.T)
    assert (columns**2).sum(axis=2) == pytest.approx(expected, rel=1e-3, abs=1e-3 * expected.max())


def test_further_departures_are_spanned_too():
    """A drain that departs by itself, 5 % of it."""
    alone = LEAK * [0.0, 1.0]
    assert _left(alone, departures(PARTS, SHAPES, SIGMA, 0.03, 0.05 * alone[:, :, None])) < 1e-2
    assert _left(alone, departures(PARTS, SHAPES, SIGMA, 0.03, NONE)) > 0.1


def test_no_more_than_the_most_and_readings_that_are_missing_take_no_part():
    sigma = SIGMA.copy()
    sigma[5, 1] = np.nan
    many = np.random.default_rng(0).normal(size=(POINTS, 30))
    columns = departures(PARTS, many, sigma, 0.03, NONE)
    assert columns.shape == (POINTS, 2, MOST)
    assert np.all(columns[5, 1] == 0.0)
    assert len(departure_parameters(MOST)) == MOST
