"""The linear solves of a film: multigrid above its size, and the direct solver where that stalls."""

import numpy as np
import pytest
from scipy.sparse import csc_array, triu

from reynolds import (
    ZERO,
    Cavitation,
    Cell,
    FilmProblem,
    FilmSolver,
    Held,
    film,
    film_space,
    isotropic,
    loads,
    rectangle,
    stiffness,
)
from reynolds.fem import kernels
from reynolds.linear import factor as linear
from reynolds.linear.multigrid.grid import grid_of


def laplacian(n: int) -> csc_array:
    full = np.diag(np.full(n, 2.0)) - np.diag(np.ones(n - 1), 1) - np.diag(np.ones(n - 1), -1)
    return csc_array(triu(csc_array(full)))


@pytest.mark.parametrize("limit", [10, 10_000])
def test_both_solvers_solve(limit, monkeypatch):
    monkeypatch.setattr(linear, "DIRECT_LIMIT", limit)
    factor = linear.Factor()
    for scale in (1.0, 3.0):  # the second time with the pattern kept
        factor.update(scale * laplacian(200))
        # Two point loads on a string: linear between them, by hand.
        load = np.zeros(200)
        load[99] = scale
        expected = np.minimum(np.arange(1, 201) * 101.0, 100.0 * (201.0 - np.arange(1, 201))) / 201.0
        np.testing.assert_allclose(factor.solve(load), expected, rtol=1e-8)


def test_a_stalled_multigrid_hands_over_to_the_direct_solver(monkeypatch):
    monkeypatch.setattr(linear, "DIRECT_LIMIT", 10)
    monkeypatch.setattr(linear, "ITERATIVE_TOLERANCE", 1e-30)  # beyond what conjugate gradients can reach
    factor = linear.Factor()
    factor.update(laplacian(300))
    load = np.random.default_rng(1).standard_normal(300)
    full = (laplacian(300) + triu(laplacian(300), 1).T).toarray()
    np.testing.assert_allclose(full @ factor.solve(load, 1e-30), load, atol=1e-9)


def test_each_rung_of_the_ladder_hands_over_to_the_next(monkeypatch):
    """The same answer from multigrid on the grid, and where that and pyamg stall from QDLDL."""
    space = film_space(rectangle((1.0, 1.0), (30, 20), cell=Cell.QUADRILATERAL))
    entries = stiffness(space, isotropic(np.ones((1, 1))))
    column = np.repeat(np.arange(space.size), np.diff(space.pattern.indptr))
    upper = space.matrix(entries + 0.1 * (space.pattern.indices == column))
    load = np.random.default_rng(1).standard_normal(space.size)
    whole = upper + triu(upper, 1).T
    monkeypatch.setattr(linear, "ROUND_OFF", 0.0)
    for limit, tolerance, rung in ((10_000, 1e-11, "_on_grid"), (10, 1e-11, "_on_grid"), (10, 1e-30, "_direct")):
        monkeypatch.setattr(linear, "DIRECT_LIMIT", limit)
        monkeypatch.setattr(linear, "ITERATIVE_TOLERANCE", tolerance)
        factor = linear.Factor(grid_of(space))
        factor.update(upper)
        np.testing.assert_allclose(whole @ factor.solve(load, tolerance), load, atol=1e-9)
        assert getattr(factor, rung) is not None
    assert factor._on_grid is None


def test_a_pocket_five_hundred_times_deeper_stays_on_the_grid():
    """Round-off of pressures across the pocket exceeds the tolerance of the load: no other solver does better."""
    space = film_space(rectangle((1.0, 1.0), (60, 60), cell=Cell.QUADRILATERAL))
    x, y = space.points
    conductance = np.where((np.abs(x - 0.5) < 0.2) & (np.abs(y - 0.5) < 0.2), 1.0, 500.0**-3)
    entries = stiffness(space, isotropic(conductance))
    held, data = np.zeros(space.size, dtype=bool), np.empty_like(entries)
    held[space.edge_dofs["left"]] = True
    pattern = space.pattern
    kernels.hold(pattern.indptr, pattern.indices, entries, 1.0, held, np.zeros(space.size), data)
    load = np.where(held, 0.0, np.random.default_rng(1).standard_normal(space.size))
    answers = []
    for grid in (grid_of(space), None):
        factor = linear.Factor(grid)
        factor.update(space.matrix(data))
        answers.append(factor.solve(load))
        assert (factor._on_grid is None) == (grid is None)
    np.testing.assert_allclose(answers[0], answers[1], rtol=0.0, atol=1e-5 * np.abs(answers[1]).max())


def test_a_matrix_that_is_not_positive_leaves_the_grid():
    space = film_space(rectangle((1.0, 1.0), (30, 20), cell=Cell.QUADRILATERAL))
    upper = space.matrix(-stiffness(space, isotropic(np.ones((1, 1)))))
    upper = upper - 0.1 * csc_array(np.eye(space.size))
    upper.sort_indices()
    factor = linear.Factor(grid_of(space))
    factor.update(upper)
    load = np.random.default_rng(1).standard_normal(space.size)
    np.testing.assert_allclose((upper + triu(upper, 1).T) @ factor.solve(load), load, atol=1e-9)


@pytest.mark.slow
def test_a_deep_pocket_on_a_large_mesh_is_solved():
    space = film_space(rectangle((1e-2, 1e-2), (260, 260), cell=Cell.QUADRILATERAL))
    assert space.size > linear.DIRECT_LIMIT
    x, y = space.points
    inside = (np.abs(x - 5e-3) < 2e-3) & (np.abs(y - 5e-3) < 2e-3)
    oil = film(np.where(inside, 5e-3, 1e-5), 0.03, velocity_moving=(np.ones((1, 1)), ZERO))
    edges = {"left": Held(1e6), "right": Held(0.0)}
    solution = FilmSolver(space).solve(FilmProblem(space, oil, edges, Cavitation.NONE))
    assert loads(solution).mass_balance_error < 1e-9
    assert loads(solution).energy_balance_error < 1e-9


def upwind(n: int, seed: int = 3) -> tuple[csc_array, np.ndarray, np.ndarray]:
    """A film of n x n cells with a cavity: symmetric columns in the film, upwind transport in the cavity.

    Upper triangle, mirrored entries, and the dense matrix.
    """
    space = film_space(rectangle((1.0, 1.0), (n, n), cell=Cell.QUADRILATERAL))
    full = np.zeros((space.size, space.size))
    for cell in space.dofs:
        full[np.ix_(cell, cell)] += np.array([[4, -1, -2, -1], [-1, 4, -1, -2], [-2, -1, 4, -1], [-1, -2, -1, 4]]) / 6
    cavity = np.random.default_rng(seed).random(space.size) < 0.4
    flow = np.where(full < 0.0, np.triu(np.ones_like(full), 1), 0.0)  # to higher numbers only, an M-matrix
    transport = np.diag(flow.sum(axis=0) + 1e-3) - flow.T
    matrix = np.where(cavity, 1e4 * transport, full + 1e-3 * np.eye(space.size))
    pattern = space.pattern
    column = np.repeat(np.arange(space.size), np.diff(pattern.indptr))
    lower = matrix[column, pattern.indices]
    return space.matrix(matrix[pattern.indices, column]), lower, matrix


def test_a_general_matrix_is_solved():
    factor = linear.GeneralFactor()
    for seed in (3, 4):  # the second time with the pattern kept
        upper, lower, matrix = upwind(12, seed)
        load = np.random.default_rng(1).standard_normal(upper.shape[0])
        factor.update(upper, lower)
        np.testing.assert_allclose(matrix @ factor.solve(load), load, atol=1e-10)
