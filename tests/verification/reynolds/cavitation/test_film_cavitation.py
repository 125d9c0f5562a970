"""Film equation: Reynolds' condition as a complementarity, and where it starts from."""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import (
    ZERO,
    Cavitation,
    Cell,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    Held,
    Pocket,
    film,
    film_space,
    loads,
    no_feed,
    rectangle,
)
from reynolds.solve.cavity_guess import COARSEST, Cascade, Obstacle

LEVEL = 1e4  # cavitation pressure, Pa


def _journal(cell: Cell, n: int, level: float = LEVEL) -> tuple[FilmSpace, dict[str, Held]]:
    space = film_space(rectangle((2.0 * np.pi, 1.0), (n, n // 4), cell=cell, periodic_x=True))
    return space, {"bottom": Held(level), "top": Held(level + 0.5)}


def _problem(space: FilmSpace, boundary, eccentricity: float, attitude: float = 0.0) -> FilmProblem:
    posed = film(
        space.sample(lambda x, y: 1.0 + eccentricity * np.cos(x - attitude)),
        1.0,
        velocity_moving=(np.ones((1, 1)), ZERO),
    )
    return FilmProblem(space, posed, boundary, Cavitation.REYNOLDS, LEVEL)


def _assert_complementary(solution: FilmSolution) -> None:
    """p >= p_c; r >= 0 is what the balance lacks; never both apart from zero."""
    lacking = -solution.outflow  # residual of the flow balance, m3/s
    free = ~solution.held
    scale = np.abs(lacking).max()
    assert solution.pressure.min() >= LEVEL
    assert lacking[free].min() >= -1e-9 * scale
    gap = (solution.pressure - LEVEL)[free] * lacking[free]
    assert np.abs(gap).max() <= 1e-9 * scale * (solution.pressure.max() - LEVEL)
    assert np.all(solution.pressure[solution.cavity] == LEVEL)


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("eccentricity", [0.2, 0.6, 0.95])
def test_complementarity(cell, eccentricity):
    space, boundary = _journal(cell, 96)
    solution = FilmSolver(space).solve(_problem(space, boundary, eccentricity))
    _assert_complementary(solution)
    assert solution.cavity.any()
    assert loads(solution).cavity_flow > 0.0  # the condition supplies the oil that the rupture lacks


@pytest.mark.parametrize("cell", list(Cell))
def test_any_start_gives_the_same_film(cell):
    """From another film's cavity, from none and from coarser problems: there is one solution."""
    space, boundary = _journal(cell, 64)
    solver = FilmSolver(space)
    problem = _problem(space, boundary, 0.7)
    cold = solver.solve(problem)
    other = solver.solve(_problem(space, boundary, 0.4, attitude=2.5))
    warm = solver.solve(problem, start=other)
    np.testing.assert_array_equal(warm.cavity, cold.cavity)
    np.testing.assert_allclose(warm.pressure, cold.pressure, rtol=1e-9)
    again = solver.solve(problem, start=cold)
    assert again.iterations <= 2  # an iterative linear solve takes a second step to round-off


@pytest.mark.parametrize("cell", list(Cell))
def test_steps_do_not_grow_with_the_mesh(cell):
    """Started from coarser problems, the active set settles in as many steps on a mesh eight times finer."""
    steps = []
    for n in (64, 128, 256):
        space, boundary = _journal(cell, n)
        assert space.size > COARSEST
        steps.append(FilmSolver(space).solve(_problem(space, boundary, 0.6)).iterations)
    assert max(steps) <= 8


def test_steps_do_not_grow_without_rows_and_columns():
    """The same where a pocket leaves no grid: coarse problems gathered from neighbours."""
    steps = []
    for n in (48, 96, 192):
        mesh = rectangle((2.0 * np.pi, 1.0), (n, n // 4), cell=Cell.QUADRILATERAL, periodic_x=True)
        space = film_space(mesh, pockets=["bottom"])
        boundary = {"bottom": Pocket(no_feed), "top": Held(LEVEL + 0.5)}
        steps.append(FilmSolver(space).solve(_problem(space, boundary, 0.6)).iterations)
    assert max(steps) <= 8


def test_coarse_problems_find_a_known_contact():
    """A string over a table: -u'' = f, u >= 0; contact ends where slope and value vanish.

    With f = 1 on the outer quarters and -1 within [1/4, 3/4], u(0) = u(1) = 0, the contact begins at
    1/4 + a: u = u' = 0 there and u(0) = a^2/2 + a/4 - 1/32 = 0 give a = (sqrt(2) - 1)/4.
    """
    from scipy.sparse import csc_array, diags_array

    n = 2000
    x = np.arange(1, n) / n
    upper = csc_array(diags_array([2.0 * np.ones(n - 1), -np.ones(n - 2)], offsets=[0, 1]))
    load = np.where((x > 0.25) & (x < 0.75), -1.0, 1.0) / n**2
    cavity = Cascade(upper).cavity(Obstacle(upper.data, load, np.zeros(n - 1, dtype=bool)))
    edge = x[cavity].min()
    assert edge == pytest.approx(0.25 + 0.25 * (np.sqrt(2.0) - 1.0), abs=8.0 / n)


def test_groove_in_a_ruptured_film():
    """A pocket that nothing feeds keeps one pressure, never below cavitation pressure, and balances."""
    mesh = rectangle((0.02, 0.01), (20, 10), cell=Cell.QUADRILATERAL)
    space = film_space(mesh, pockets=["bottom"])
    posed = film(
        space.sample(lambda x, y: 1e-5 * (1.0 + 0.5 * np.cos(400.0 * x))),
        0.03,
        velocity_moving=(np.full((1, 1), 5.0), ZERO),
    )
    solution = FilmSolver(space).solve(
        FilmProblem(space, posed, {"top": Held(5e5), "bottom": Pocket(no_feed)}, Cavitation.REYNOLDS, LEVEL)
    )
    found = loads(solution)
    assert solution.pressure.min() >= LEVEL
    assert found.mass_balance_error < 1e-12


def test_steps_to_reynolds_condition_do_not_grow_with_the_mesh():
    """A journal of 544 and 8,320 unknowns: the cavity of coarser ones is the first guess; without it 8 and 24 steps."""

    def steps(n: int) -> int:
        space = film_space(rectangle((0.1, 0.05), (2 * n, n), cell=Cell.QUADRILATERAL, periodic_x=True))
        gap = space.sample(lambda x, y: 20e-6 * (1.0 + 0.8 * np.cos(2.0 * np.pi * x / 0.1)))
        sides = {"bottom": Held(0.0), "top": Held(0.0)}
        posed = film(gap, 0.03, velocity_moving=(ZERO + 5.0, ZERO))
        found = FilmSolver(space).solve(FilmProblem(space, posed, sides, Cavitation.REYNOLDS))
        assert found.cavity.any()
        return found.iterations

    assert steps(16) <= 4
    assert steps(64) <= 6
