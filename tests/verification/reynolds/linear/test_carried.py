"""The iterative solve of a film whose cavities carry oil, against an elimination of the same matrix."""

import numpy as np
import pytest
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import spsolve

from reynolds import Cell, FilmSpace, film_space, isotropic, rectangle, stiffness
from reynolds.linear.cavitated import CavitatedFilm
from reynolds.linear.factor import GeneralFactor
from reynolds.linear.multigrid.grid import grid_of
from reynolds.linear.triangles import both_triangles


def carried(space: FilmSpace, cavity: np.ndarray, flow: tuple[float, float]) -> tuple[csc_array, np.ndarray, csc_array]:
    """Upper triangle, its mirror and the matrix: Poiseuille columns in the film, upwind ones in the cavity.

    An unknown of the cavity gives to each neighbour downstream in proportion to the flow along the way there.
    """
    film = space.matrix(stiffness(space, isotropic(np.ones((1, 1)))))
    column = np.repeat(np.arange(space.size), np.diff(space.pattern.indptr))
    row = space.pattern.indices
    where = np.empty((space.size, 2))
    where[space.dofs] = space.vertices[space.cells]
    way = where[row] - where[column]  # from column to row, the short way round
    way -= np.round(way / 1.0) * (np.abs(way) > 0.5)
    along = way @ np.array(flow)
    held = np.zeros(space.size, dtype=bool)
    held[space.edge_dofs["bottom"]] = True
    off = row != column
    upper = np.where(cavity[column], -np.maximum(along, 0.0), film.data) * off
    lower = np.where(cavity[row], -np.maximum(-along, 0.0), film.data) * off
    upper[held[column] | held[row]] = 0.0
    lower[held[column] | held[row]] = 0.0
    given = np.bincount(column, upper, space.size) + np.bincount(row, lower, space.size)
    own = np.where(held, 1.0, np.where(cavity, 1e-6 - given, film.diagonal()))
    upper[~off] = own[column[~off]]
    matrix = space.matrix(upper)
    both = both_triangles(matrix)
    return matrix, lower, both.matrix(both.entries(upper, lower))


def _band(space: FilmSpace) -> np.ndarray:
    """Cavity across the middle half of the length, ragged at its ends, no edge held in it."""
    found = np.zeros(space.size, dtype=bool)
    x, y = space.vertices.T
    inside = (np.abs(x - 0.5 + 0.05 * np.sin(9.0 * y)) < 0.25) & (y > 0.0)
    found[space.vertex_dofs[inside]] = True
    return found


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("flow", [(1.0, 0.0), (-1.0, 0.3)])
@pytest.mark.parametrize("around", [False, True])
def test_it_agrees_with_an_elimination(cell, flow, around):
    space = film_space(rectangle((1.0, 1.0), (31, 24), cell=cell, periodic_x=around))
    cavity = _band(space)
    upper, lower, matrix = carried(space, cavity, flow)
    load = np.random.default_rng(3).standard_normal(space.size)
    solver = CavitatedFilm(grid_of(space), upper)
    assert solver.update(upper.data, lower, cavity)
    answer, effort = solver.solve(load, 1e-12)
    expected = spsolve(matrix, load)
    assert effort.left < 1e-11
    np.testing.assert_allclose(answer, expected, rtol=0.0, atol=1e-8 * np.abs(expected).max())


def test_steps_grow_but_slowly_with_the_mesh():
    """Four times finer costs less than twice the steps: oil returned in more than one hop has no place in them."""
    steps = []
    for cells in (20, 40, 80):
        space = film_space(rectangle((1.0, 1.0), (cells, cells), cell=Cell.QUADRILATERAL, periodic_x=True))
        cavity = _band(space)
        upper, lower, _ = carried(space, cavity, (1.0, 0.2))
        solver = CavitatedFilm(grid_of(space), upper)
        assert solver.update(upper.data, lower, cavity)
        steps.append(solver.solve(np.ones(space.size), 1e-10)[1].steps)
    assert steps[0] <= 20
    assert steps[2] < 2 * steps[0]


def test_a_cavity_all_round_is_entered_somewhere():
    """Oil that flows in a ring has no first unknown."""
    space = film_space(rectangle((1.0, 1.0), (30, 20), cell=Cell.QUADRILATERAL, periodic_x=True))
    cavity = np.ones(space.size, dtype=bool)
    cavity[space.edge_dofs["bottom"]] = False
    upper, lower, matrix = carried(space, cavity, (1.0, 0.1))
    lifted = upper.copy()
    lifted.data[upper.indptr[1:] - 1] += 0.1 * cavity  # the diagonal stands last in its column
    matrix = matrix + 0.1 * diags_array(cavity.astype(float), format="csc")
    solver = CavitatedFilm(grid_of(space), upper)
    assert solver.update(lifted.data, lower, cavity)
    load = np.random.default_rng(3).standard_normal(space.size)
    answer, effort = solver.solve(load, 1e-11)
    assert effort.left < 1e-10
    np.testing.assert_allclose(matrix @ answer, load, atol=1e-8)


@pytest.mark.parametrize("tolerance", [1e-11, 1e-30])
def test_the_general_factor_takes_it_and_leaves_it_where_it_stalls(tolerance, monkeypatch):
    monkeypatch.setattr("reynolds.linear.factor.ITERATIVE_TOLERANCE", tolerance)
    monkeypatch.setattr(
        "reynolds.linear.factor.GENERAL_TOLERANCE", max(tolerance, 1e-10) if tolerance > 1e-20 else 1e-13
    )
    monkeypatch.setattr("reynolds.linear.band.MOST_WORK", 0.0)  # else a film as small as this one is eliminated
    monkeypatch.setattr("reynolds.linear.cavitated.ROUNDS", 3 if tolerance > 1e-20 else 0)
    space = film_space(rectangle((1.0, 1.0), (31, 24), cell=Cell.QUADRILATERAL))
    cavity = _band(space)
    upper, lower, matrix = carried(space, cavity, (1.0, 0.2))
    factor = GeneralFactor(grid_of(space))
    load = np.random.default_rng(3).standard_normal(space.size)
    for _ in range(2):
        factor.update(upper, lower, cavity)
        np.testing.assert_allclose(matrix @ factor.solve(load), load, atol=1e-8)
    assert (factor._on_grid is not None) == (tolerance > 1e-20)
    factor.update(upper, lower)  # no word of the cavity: by elimination
    np.testing.assert_allclose(matrix @ factor.solve(load), load, atol=1e-10)
