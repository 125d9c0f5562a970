"""Multigrid on grids: against a direct solve, and that its effort does not grow with mesh, jumps or aspect."""

import numpy as np
import pytest
from scipy.sparse import csc_array, triu
from scipy.sparse.linalg import spsolve

from reynolds import Cell, FilmInputError, FilmSpace, annulus, film_space, isotropic, rectangle, stiffness
from reynolds.fem import kernels
from reynolds.linear.multigrid import solver as multigrid_module
from reynolds.linear.multigrid.grid import Grid, grid_of
from reynolds.linear.multigrid.solver import MAX_STEPS, Multigrid, Precision

ROUND = 2.0 * np.pi
TOLERANCE = 1e-8


def operator(space: FilmSpace, thickness: np.ndarray, fixed: np.ndarray) -> csc_array:
    """Upper triangle of int h^3 grad p . grad f, the identity at fixed unknowns."""
    entries = stiffness(space, isotropic(thickness**3))
    data = np.empty_like(entries)
    pattern = space.pattern
    kernels.hold(pattern.indptr, pattern.indices, entries, 1.0 / entries.max(), fixed, np.zeros(space.size), data)
    return space.matrix(data)


def solver(space: FilmSpace, upper: csc_array, precision: Precision = Precision.SINGLE) -> Multigrid:
    multigrid = Multigrid(grid_of(space), upper, precision)
    assert multigrid.update(upper.data)
    return multigrid


def at_edges(space: FilmSpace, *names: str) -> np.ndarray:
    fixed = np.zeros(space.size, dtype=bool)
    for name in names:
        fixed[space.edge_dofs[name]] = True
    return fixed


def whole(upper: csc_array) -> csc_array:
    return csc_array(upper + triu(upper, 1).T)


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("cells", [(7, 12), (8, 13), (5, 3), (3, 9), (16, 5)])
@pytest.mark.parametrize(("around_x", "around_y"), [(False, False), (False, True), (True, False)])
@pytest.mark.parametrize(("shear", "kept"), [(0.0, "twice"), (0.3, "twice"), (0.0, "once"), (0.3, "double")])
def test_it_agrees_with_a_direct_solve(cell, cells, around_x, around_y, shear, kept, monkeypatch):
    """Any number of rows, open or closed; film rough from cell to cell, a tenth of the nodes in a cavity.

    Sheared cells couple over their corners too. The finest level is kept once in large films.
    """
    if kept == "once":
        monkeypatch.setattr(multigrid_module, "IN_CACHE", 0)
    space = film_space(rectangle((1.0, 1.0), cells, cell=cell, periodic_x=around_x, periodic_y=around_y))
    space = space.moved(space.vertices @ np.array([[1.0, 0.0], [shear, 1.0]]))
    random = np.random.default_rng(7)
    cavity = random.random(space.size) < 0.1
    cavity[0] = True
    upper = operator(space, np.exp(random.standard_normal((len(space.cells), 1))), cavity)
    load = random.standard_normal(space.size)
    precision = Precision.DOUBLE if kept == "double" else Precision.SINGLE
    multigrid = solver(space, upper, precision)
    multigrid.solve(load, 1e-13)  # what it leaves behind does not matter
    answer, effort = multigrid.solve(load, 1e-13)
    assert effort.left <= 1e-12
    assert effort.steps < 25
    np.testing.assert_allclose(answer, spsolve(whole(upper).tocsc(), load), rtol=0.0, atol=1e-9 * np.abs(answer).max())


@pytest.mark.parametrize("mesh", [annulus(1.0, 2.0, (9, 31)), rectangle((1.0, 2.0), (9, 10), periodic_x=True)])
@pytest.mark.parametrize(("precision", "large"), [(one, large) for one in Precision for large in (False, True)])
def test_the_cycle_is_symmetric_and_positive(mesh, precision, large, monkeypatch):
    """The preconditioner is symmetric and positive, and never enlarges an error: M A < 2."""
    space = film_space(mesh)
    fixed = np.zeros(space.size, dtype=bool)
    fixed[:4] = True
    upper = operator(space, np.exp(np.random.default_rng(2).standard_normal((len(space.cells), 1))), fixed)
    if large:
        monkeypatch.setattr(multigrid_module, "IN_CACHE", 0)
    multigrid = solver(space, upper, precision)
    single = large or precision is Precision.SINGLE
    cycle = np.column_stack([multigrid.cycle(unit) for unit in np.eye(space.size)])
    # Round-off of the coarse operators, times what these amplify it by.
    lost = np.finfo(np.float32 if single else np.float64).eps * np.linalg.cond(whole(upper).toarray())
    assert lost < 0.5
    np.testing.assert_allclose(cycle, cycle.T, rtol=0.0, atol=0.01 * lost * np.abs(cycle).max())
    values = np.linalg.eigvals(cycle @ whole(upper).toarray()).real
    assert values.min() > 0.0
    assert values.max() < 1.0 + max(1e-9, lost)  # the smoothing is a product of projections


def test_from_a_start_only_the_rest_is_solved():
    """From the answer itself no step is left to do; from near it fewer than from nothing."""
    space = film_space(rectangle((1.0, 1.0), (20, 24), cell=Cell.QUADRILATERAL))
    x, _ = space.points
    multigrid = solver(space, operator(space, 1.0 + x, at_edges(space, "left")))
    load = np.random.default_rng(3).standard_normal(space.size)
    answer, cold = multigrid.solve(load, TOLERANCE)
    assert multigrid.solve(load, 1.01 * TOLERANCE, answer)[1].steps == 0
    again, warm = multigrid.solve(load, TOLERANCE, 1.001 * answer)
    assert 0 < warm.steps < cold.steps
    assert warm.left <= TOLERANCE
    np.testing.assert_allclose(again, answer, rtol=0.0, atol=1e-5 * np.abs(answer).max())


@pytest.mark.parametrize("size", [1e-100, 1e-60, 1e100])
def test_loads_that_single_precision_does_not_hold_are_solved_alike(size):
    space = film_space(rectangle((1.0, 1.0), (20, 24), cell=Cell.QUADRILATERAL))
    multigrid = solver(space, operator(space, np.ones((1, 1)), at_edges(space, "left")))
    load = np.random.default_rng(3).standard_normal(space.size)
    answer, effort = multigrid.solve(load, 1e-12)
    scaled, again = multigrid.solve(size * load, 1e-12)
    assert again.steps == effort.steps
    np.testing.assert_allclose(scaled / size, answer, rtol=0.0, atol=1e-9 * np.abs(answer).max())


def _pocket(x, y):
    return np.where((np.abs(x - 3.0) < 1.0) & (np.abs(y - 0.5) < 0.2), 50.0, 1.0 + 0.6 * np.cos(x))


def _grooves(x, y):
    return np.where((np.sin(8.0 * x) > 0.6) & (y < 0.8), 20.0, 1.0 + 0.6 * np.cos(x))


FILMS = {
    "journal": (1.0, lambda x, y: 1.0 + 0.6 * np.cos(x)),
    "thin": (1.0, lambda x, y: 1.0 + 0.95 * np.cos(x)),
    "pocket 50 times deeper": (1.0, _pocket),
    "grooves 20 times deeper": (1.0, _grooves),
    "aspect 100": (0.01, lambda x, y: 1.0 + 0.6 * np.cos(x)),
    "aspect 1/100": (100.0, lambda x, y: 1.0 + 0.6 * np.cos(x)),
}


def _steps(width: float, thickness, cells: int, cell: Cell) -> int:
    mesh = rectangle((ROUND, width), (cells, int(0.4 * cells)), cell=cell, periodic_x=True)
    space = film_space(mesh)
    x, y = space.points
    upper = operator(space, thickness(x, y / width), at_edges(space, "bottom", "top"))
    load = np.where(upper.diagonal() == 1.0, 0.0, np.random.default_rng(5).standard_normal(space.size))
    return solver(space, upper).solve(load, TOLERANCE)[1].steps


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("film", list(FILMS))
def test_steps_do_not_grow_with_the_mesh(film, cell):
    steps = [_steps(*FILMS[film], cells, cell) for cells in (40, 80, 160)]
    assert max(steps) <= 20
    assert steps[2] <= steps[0] + 4


def test_a_full_pass_is_of_the_order_of_the_mesh():
    """-div grad u = 2 pi^2 sin sin: a pass adds a tenth to the mesh's own error, which falls as h^2.

    Then comes what rounding the stencil to single precision leaves, which grows as 1/h^2: 3e-5 at 96 x 96 cells.
    """
    errors = []
    for cells in (12, 24, 48):
        space = film_space(rectangle((1.0, 1.0), (cells, cells), cell=Cell.QUADRILATERAL))
        fixed = at_edges(space, "left", "right", "bottom", "top")
        entries = stiffness(space, isotropic(np.ones((1, 1))))
        pattern, data = space.pattern, np.empty_like(entries)
        kernels.hold(pattern.indptr, pattern.indices, entries, 1.0, fixed, np.zeros(space.size), data)
        x, y = space.vertices.T
        exact = np.sin(np.pi * x) * np.sin(np.pi * y)
        load = np.where(fixed, 0.0, 2.0 * np.pi**2 * exact / cells**2)
        multigrid = solver(space, space.matrix(data))
        answer = multigrid.full_pass(load)
        solved, _ = multigrid.solve(load, 1e-12)
        errors.append(np.abs(answer - exact).max())
        assert np.abs(answer - solved).max() < np.abs(solved - exact).max() / 10.0
    assert np.all(np.log2(np.divide(errors[:-1], errors[1:])) > 1.9)


@pytest.mark.parametrize("depth", [200.0, 300.0, 400.0])
def test_a_wide_deep_pocket_keeps_its_level(depth):
    """Lands hold its pressure by less than single precision rounds off: seen by the steps it costs, and mended."""
    space = film_space(rectangle((ROUND, 1.0), (160, 64), cell=Cell.QUADRILATERAL, periodic_x=True))
    x, y = space.points
    inside = (np.abs(x - 3.0) < 1.0) & (np.abs(y - 0.5) < 0.2)
    upper = operator(space, np.where(inside, depth, 1.0) * (1.0 + 0.6 * np.cos(x)), at_edges(space, "bottom", "top"))
    where = np.empty(space.size)
    where[space.vertex_dofs] = space.vertices[:, 0]
    load = np.where(at_edges(space, "bottom", "top"), 0.0, np.sin(where))
    multigrid = solver(space, upper)
    exact, first = multigrid.solve(load, TOLERANCE)
    assert first.steps > 10
    assert multigrid.solve(load, TOLERANCE)[1].steps <= 7
    assert np.abs(multigrid.full_pass(load) - exact).max() < 1e-2 * np.abs(exact).max()


def test_couplings_over_corners_come_and_go():
    """A matrix of rectangles after one of sheared cells, and back: each as for a solver that saw no other."""
    plain = film_space(rectangle((1.0, 1.0), (9, 6), cell=Cell.QUADRILATERAL))
    sheared = plain.moved(plain.vertices @ np.array([[1.0, 0.0], [0.4, 1.0]]))
    fixed, load = at_edges(plain, "left", "right"), np.linspace(1.0, 2.0, plain.size)
    uppers = [operator(space, np.ones((1, 1)), fixed) for space in (plain, sheared)]
    kept = solver(plain, uppers[0])
    for upper in (uppers[1], uppers[0], uppers[1]):
        assert kept.update(upper.data)
        alone = solver(plain, upper)
        np.testing.assert_array_equal(kept.solve(load, TOLERANCE)[0], alone.solve(load, TOLERANCE)[0])


def test_nothing_loaded_is_nothing():
    space = film_space(rectangle((1.0, 1.0), (6, 6)))
    upper = operator(space, np.ones((1, 1)), at_edges(space, "left"))
    answer, effort = solver(space, upper).solve(np.zeros(space.size), TOLERANCE)
    assert effort.steps == 0
    assert not answer.any()


def test_what_is_not_positive_is_said():
    space = film_space(rectangle((1.0, 1.0), (6, 6)))
    upper = operator(space, np.ones((1, 1)), at_edges(space, "left"))
    multigrid = Multigrid(grid_of(space), upper)
    assert not multigrid.update(-upper.data)
    assert not multigrid.update(np.full_like(upper.data, np.nan))
    # No pressure given anywhere: singular, which rows alone do not show.
    singular = operator(space, np.ones((1, 1)), np.zeros(space.size, dtype=bool))
    if multigrid.update(singular.data):
        _, effort = multigrid.solve(np.ones(space.size), TOLERANCE)
        assert effort.left > TOLERANCE
        assert effort.steps <= MAX_STEPS


def test_a_matrix_of_another_mesh_is_refused():
    space = film_space(rectangle((1.0, 1.0), (6, 6)))
    upper = operator(space, np.ones((1, 1)), at_edges(space, "left"))
    other = Grid(np.arange(49, dtype=np.int32).reshape(7, 7)[:, ::-1][:, [0, 3, 1, 2, 4, 5, 6]].copy(), False)
    with pytest.raises(FilmInputError, match="grid"):
        Multigrid(other, upper)
