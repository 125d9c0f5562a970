"""Balance of a floating part: the search for a position, apart from any film."""

from __future__ import annotations

import numpy as np
import pytest

from gaps.balance import START_WITHIN, TOLERANCE, find_equilibrium, into_disc, out_of_disc, start_towards
from reynolds.errors import FilmNotConverged


def test_finds_the_root_of_a_stiff_system():
    """Two unknowns of very different stiffness, as film thickness and tilt are."""
    wanted = np.array([0.3, -1.2])

    def imbalance(u):
        off = u - wanted
        return np.array([np.expm1(3.0 * off[0]) + off[1], 0.05 * off[1] + 0.02 * off[0] ** 2])

    answer = find_equilibrium(imbalance, [np.zeros(2)])
    assert answer.found
    assert answer.rest < TOLERANCE
    assert answer.unknowns == pytest.approx(wanted, abs=1e-3)


def test_goes_on_to_the_next_start():
    """From the first start there is only a valley without a root, from the second a root."""
    calls = []

    def imbalance(u):
        calls.append(float(u[0]))
        return np.array([u[0] ** 3 - 3.0 * u[0] + 3.0])  # one root, at -2.1038, and a valley at +1

    answer = find_equilibrium(imbalance, [np.array([1.5]), np.array([-3.0])])
    assert answer.found
    assert answer.unknowns[0] == pytest.approx(-2.1038, abs=1e-4)
    assert calls[0] == 1.5
    assert answer.evaluations <= len(calls)


def test_reports_the_nearest_miss():
    """exp(-u) - 2 has a root and exp(-u) + 0.25 none: what remains is 0.25, from the better start."""
    answer = find_equilibrium(lambda u: np.exp(-u) + 0.25, [np.array([0.0]), np.array([2.0])])
    assert not answer.found
    assert 0.25 < answer.rest < 0.6


def test_start_without_a_film_counts_as_a_miss():
    def imbalance(u):
        if u[0] > 5.0:
            raise FilmNotConverged("no film", "none")
        return u - 1.0

    answer = find_equilibrium(imbalance, [np.array([9.0]), np.array([0.0])])
    assert answer.found
    assert answer.unknowns[0] == pytest.approx(1.0)
    with pytest.raises(FilmNotConverged, match="no start of the force balance"):
        find_equilibrium(imbalance, [np.array([9.0])])


@pytest.mark.parametrize("free", [(0.0, 0.0), (0.3, -0.4), (-50.0, 20.0), (1e3, 1e3)])
def test_disc_holds_the_plane(free):
    """Any free pair is a valid position: inside the unit disc, in the same direction, and back again."""
    inside = into_disc(np.array(free))
    assert inside @ inside < 1.0
    assert inside[0] * free[1] == pytest.approx(inside[1] * free[0])
    assert out_of_disc(inside) == pytest.approx(np.array(free), rel=1e-6)


@pytest.mark.parametrize(
    ("wanted", "reached"), [(0.0, 0.0), (0.6, 0.6), (1.0, START_WITHIN), (30.0, START_WITHIN)]
)
def test_start_is_drawn_into_the_disc(wanted, reached):
    """A start is the wanted place where that is possible, else a finite one in its direction near the wall."""
    direction = np.array([0.8, -0.6])
    assert into_disc(start_towards(wanted * direction)) == pytest.approx(reached * direction)
