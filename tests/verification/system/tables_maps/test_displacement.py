"""Derived displacement by ISO 8426 on readings whose displacement is known."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from bench_pump import BENCH

from reynolds import InputError
from system import load_pump, lumped_point, operating_point
from system.maps.displacement import toet_displacement

V = 89.86e-6
SPEEDS = np.array([1000.0, 1300.0, 1700.0, 2100.0, 2500.0]) * np.pi / 30
DIFFERENCES = np.array([5.0, 10.0, 20.0, 27.5, 32.5]) * 1e6
MAP = np.array(list(product(SPEEDS, DIFFERENCES)))


def _flow(speed, difference, lost_displacement=0.0):
    """n (V - share of dp) less a leakage of any form of dp, the same at every speed."""
    return speed / (2 * np.pi) * (V - lost_displacement * difference) - 1e-12 * difference - 1e-20 * difference**2


def test_toet_is_exact_where_leakage_does_not_hang_on_speed():
    found = toet_displacement(*MAP.T, _flow(*MAP.T))
    assert found.value == pytest.approx(V, rel=1e-12)
    assert found.sigma == pytest.approx(0.0, abs=1e-12 * V)
    assert (found.speeds, found.differences, found.notes) == (5, 5, ())


def test_toet_takes_each_pressure_for_itself():
    """Other speeds at each pressure: slopes over several pressures would hold what leakage gains with them."""
    chosen = [(0, 0), (2, 0), (1, 1), (3, 1), (2, 2), (4, 2), (0, 3), (4, 3), (1, 4), (4, 4)]
    speed, difference = np.array([(SPEEDS[i], DIFFERENCES[j]) for i, j in chosen]).T
    assert toet_displacement(speed, difference, _flow(speed, difference, 3e-14)).value == pytest.approx(V, rel=1e-12)


def test_toet_leaves_compression_in_proportion_to_speed_out():
    """V(dp) falls along a line, and is read at no pressure."""
    assert toet_displacement(*MAP.T, _flow(*MAP.T, 3e-14)).value == pytest.approx(V, rel=1e-12)


def test_set_points_may_scatter():
    rng = np.random.default_rng(6)
    speed, difference = (MAP * (1 + 1e-3 * rng.standard_normal(MAP.shape))).T
    flow = _flow(speed, difference, 3e-14) * (1 + 1e-3 * rng.standard_normal(len(MAP)))
    found = toet_displacement(speed, difference, flow)
    assert found.differences == 5
    assert 0 < found.sigma < 5e-3 * V
    assert abs(found.value - V) < 4 * found.sigma


def test_sigma_of_three_points_is_that_of_their_line():
    """Displacements V + d (1, -2, 1) at 1, 2, 3 x 10 MPa: a level line, 6 d^2/(3 - 2) about it."""
    speed, step = np.tile(SPEEDS[:2], 3), 1e-9
    difference = np.repeat([1.0, 2.0, 3.0], 2) * 1e7
    flow = speed / (2 * np.pi) * (V + step * np.repeat([1.0, -2.0, 1.0], 2))
    found = toet_displacement(speed, difference, flow)
    assert found.value == pytest.approx(V, rel=1e-12)
    assert found.sigma == pytest.approx(step * np.sqrt(6.0 * (1.0 / 3.0 + 2.0**2 / 2.0)), rel=1e-6)
    assert found.residual == pytest.approx(step * np.sqrt(2.0), rel=1e-6)


def test_too_few_levels_are_refused_or_told():
    few = MAP[MAP[:, 0] <= SPEEDS[1]]
    assert any("2 speeds" in note for note in toet_displacement(*few.T, _flow(*few.T)).notes)
    one_pressure = MAP[MAP[:, 1] == DIFFERENCES[0]].T
    with pytest.raises(InputError, match="two pressure differences"):
        toet_displacement(*one_pressure, _flow(*one_pressure))


def test_ref90_displaces_less_by_toet_than_it_sweeps():
    """Flow taken by compression and commutation in proportion to speed: .4 % on the reference pump."""
    pump = load_pump(BENCH)
    grid = list(product(SPEEDS, (5e6, 12e6, 20e6, 27.5e6, 35e6)))
    found = [
        lumped_point(pump, operating_point(pump, shaft_speed=speed, delivery_pressure=pressure))
        for speed, pressure in grid
        if speed <= pump.pump.rated_speed
    ]
    bench = [point.bench for point in found]
    toet = toet_displacement(
        np.array([one.shaft_speed for one in bench]),
        np.array([one.delivery_pressure - one.inlet_pressure for one in bench]),
        np.array([one.delivery_flow for one in bench]),
    )
    assert toet.value / found[0].derived_displacement == pytest.approx(0.996, abs=0.001)
    assert toet.residual < 1e-3 * toet.value
    assert any("4 speeds" in note for note in toet.notes)
