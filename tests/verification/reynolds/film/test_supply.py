"""Pockets behind an orifice: where their pressure starts from, and what that saves Newton's method."""

from dataclasses import replace

import numpy as np
import pytest

from reynolds import FilmProblem, FilmSolver, Held, Pocket, film, film_space, ring
from reynolds.solve.boundary import Feed, pressure_sending

FLOW = 1e-9  # m3/s by the root of a Pa


def orifice(supply: float, laminar: float = 1.0) -> Feed:
    """q = FLOW sqrt(drop), with a straight middle `laminar` Pa wide."""

    def feed(pressure: float) -> tuple[float, float]:
        drop = supply - pressure
        root = np.sqrt(abs(drop) + laminar)
        return FLOW * drop / root, -FLOW * (root - 0.5 * abs(drop) / root) / root**2

    return feed


@pytest.mark.parametrize("flow", [0.0, 1e-7, 2e-6, -2e-6])
@pytest.mark.parametrize("start", [0.0, 3e7, 9e7])
def test_the_pressure_sends_the_flow(flow, start):
    feed = orifice(3.5e7)
    assert feed(pressure_sending(feed, flow, start))[0] == pytest.approx(flow, rel=1e-3, abs=1e-9)


def test_straight_laws_and_closed_pockets_keep_their_pressure():
    assert pressure_sending(lambda p: (1e-12 * (3e7 - p), -1e-12), 0.0, 5e6) == 5e6
    assert pressure_sending(lambda p: (0.0, 0.0), 1e-6, 5e6) == 5e6
    assert pressure_sending(lambda p: (1.0 + np.exp(-p), -np.exp(-p)), 0.5, 1.0) == 1.0  # never as little


def test_a_supply_that_jumps_costs_few_steps():
    """From 5 to 35 MPa and back: mirrored steps over the supply's pressure took 40 to 60."""
    space = film_space(ring(np.linspace(5e-3, 1.5e-2, 9), 24), pockets=("inner",))
    problem = FilmProblem(space, film(1e-5, 0.03), {"outer": Held(0.0), "inner": Pocket(orifice(5e6))})
    solver = FilmSolver(space)
    at = solver.solve(problem)
    for supply in (3.5e7, 5e6, 3.5e7):
        at = solver.solve(replace(problem, boundary={**problem.boundary, "inner": Pocket(orifice(supply))}), at)
        assert at.iterations <= 6
        assert at.pressure.max() == pytest.approx(supply, rel=1e-2)
