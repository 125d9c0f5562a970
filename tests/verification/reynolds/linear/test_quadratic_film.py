"""Quadratic films on a grid: against a direct solve, and that the steps do not grow with the mesh."""

import numpy as np
import pytest
from scipy.sparse import csc_array, triu
from scipy.sparse.linalg import spsolve

from reynolds import Cell, FilmSpace, annulus, film_space, isotropic, rectangle, stiffness
from reynolds.equation.companion import Companion, companion_of, film_on_nodes
from reynolds.fem import kernels
from reynolds.linear.factor import Factor
from reynolds.linear.quadratic import QuadraticFilm
from reynolds.problem import Cavitation, FilmProblem, Held, film
from reynolds.solve.solver import FilmSolver


def operator(space: FilmSpace, conductance: np.ndarray, fixed: np.ndarray) -> csc_array:
    """Upper triangle of int k grad p . grad f over its largest entry, the identity at fixed unknowns."""
    entries = stiffness(space, isotropic(conductance))
    data, pattern = np.empty_like(entries), space.pattern
    kernels.hold(pattern.indptr, pattern.indices, entries, 1.0 / entries.max(), fixed, np.zeros(space.size), data)
    return space.matrix(data)


def made(space: FilmSpace, conductance: np.ndarray, fixed: np.ndarray) -> tuple[csc_array, Companion, QuadraticFilm]:
    upper, companion = operator(space, conductance, fixed), companion_of(space)
    solver = film_on_nodes(companion)
    assert solver.update(upper, companion.entries(isotropic(conductance), fixed))
    return upper, companion, solver


def left(upper: csc_array, answer: np.ndarray, load: np.ndarray) -> float:
    whole = csc_array(upper + triu(upper, 1).T)
    return float(np.linalg.norm(whole @ answer - load) / np.linalg.norm(load))


@pytest.mark.parametrize("cells", [(7, 12), (8, 13), (5, 3), (16, 5)])
@pytest.mark.parametrize(("around_x", "around_y"), [(False, False), (False, True), (True, False)])
@pytest.mark.parametrize("shear", [0.0, 0.3])
def test_it_agrees_with_a_direct_solve(cells, around_x, around_y, shear):
    """Any number of rows, open or closed; a film that is rough from point to point, a tenth of the nodes held."""
    mesh = rectangle((1.0, 1.0), cells, cell=Cell.QUADRILATERAL, periodic_x=around_x, periodic_y=around_y)
    space, random = film_space(mesh, degree=2), np.random.default_rng(7)
    fixed = random.random(space.size) < 0.1
    fixed[0] = True
    conductance = np.exp(random.standard_normal(space.area.shape))
    sheared = space.moved(space.vertices @ np.array([[1.0, 0.0], [shear, 1.0]]))
    upper, companion = operator(sheared, conductance, fixed), companion_of(space).moved(sheared.vertices)
    solver = film_on_nodes(companion)
    assert solver.update(upper, companion.entries(isotropic(conductance), fixed))
    load = random.standard_normal(space.size)
    answer, record = solver.solve(load, 1e-11)
    assert record.left <= 1e-11
    direct = spsolve(csc_array(upper + triu(upper, 1).T), load)
    assert answer == pytest.approx(direct, rel=1e-8, abs=1e-8 * np.abs(direct).max())


@pytest.mark.parametrize("mesh", [
    lambda n: rectangle((6.0, 1.0), (6 * n, n), cell=Cell.QUADRILATERAL, periodic_x=True),
    lambda n: rectangle((1.0, 100.0), (4 * n, 4 * n), cell=Cell.QUADRILATERAL),
    lambda n: annulus(0.5, 1.0, (n, 8 * n)),
])  # fmt: skip
def test_steps_do_not_grow_with_the_mesh(mesh):
    steps = []
    for n in (4, 16, 48):
        space = film_space(mesh(n), degree=2)
        fixed = np.zeros(space.size, dtype=bool)
        fixed[np.concatenate(list(space.edge_dofs.values()))] = True
        x, y = space.points
        upper, _, solver = made(space, (1.0 + 0.9 * np.cos(3.0 * x / x.max()) * np.cos(3.0 * y / y.max())) ** 3, fixed)
        load = np.where(fixed, 0.0, 1.0)
        answer, record = solver.solve(load, 1e-10)
        assert left(upper, answer, load) < 1e-9
        steps.append(record.steps)
    assert max(steps) <= 28
    assert steps[-1] <= steps[0] + 5


def test_a_deep_pocket():
    """A conductance that jumps a thousand times inside the film."""
    space = film_space(rectangle((1.0, 1.0), (24, 24), cell=Cell.QUADRILATERAL), degree=2)
    fixed = np.zeros(space.size, dtype=bool)
    fixed[np.concatenate(list(space.edge_dofs.values()))] = True
    x, y = space.points
    conductance = np.where(np.maximum(abs(x - 0.5), abs(y - 0.5)) < 0.25, 1000.0, 1.0)
    upper, _, solver = made(space, conductance, fixed)
    load = np.where(fixed, 0.0, 1.0)
    answer, record = solver.solve(load, 1e-10)
    assert record.steps <= 30
    assert left(upper, answer, load) < 1e-9


def test_the_residual_is_that_of_the_answer():
    """Not that of the recurrence, which falls on where round-off of a large answer holds its residual."""
    space = film_space(rectangle((1.0, 1.0), (24, 24), cell=Cell.QUADRILATERAL), degree=2)
    fixed = np.zeros(space.size, dtype=bool)
    fixed[space.edge_dofs["left"]] = True
    x, y = space.points
    upper, _, solver = made(space, np.where(np.maximum(abs(x - 0.5), abs(y - 0.5)) < 0.25, 1e6, 1.0), fixed)
    load = np.where(fixed, 0.0, 1.0)
    answer, record = solver.solve(load, 1e-12)
    assert record.left == pytest.approx(left(upper, answer, load), rel=0.2)


def test_spaces_without_a_companion():
    linear = film_space(rectangle((1.0, 1.0), (4, 4), cell=Cell.QUADRILATERAL))
    triangles = film_space(rectangle((1.0, 1.0), (4, 4)), degree=2)
    pocket = film_space(rectangle((1.0, 1.0), (4, 4), cell=Cell.QUADRILATERAL), degree=2, pockets=["left"])
    assert [companion_of(space) for space in (linear, triangles, pocket)] == [None, None, None]


def test_a_stalled_iteration_is_solved_directly():
    """With the companion of another film conjugate gradients stall, and the elimination takes over."""
    space = film_space(rectangle((1.0, 1.0), (12, 12), cell=Cell.QUADRILATERAL), degree=2)
    fixed = np.zeros(space.size, dtype=bool)
    fixed[space.edge_dofs["left"]] = True
    random = np.random.default_rng(3)
    upper, companion = operator(space, np.ones((1, 1)), fixed), companion_of(space)
    other = companion.entries(isotropic(np.exp(9.0 * random.standard_normal(space.area.shape))), fixed)
    solver, load = film_on_nodes(companion), np.where(fixed, 0.0, 1.0)
    assert solver.update(upper, other)
    assert solver.solve(load, 1e-11)[1].left > 1e-6
    factor = Factor(quadratic=solver)
    factor.update(upper, other)
    assert left(upper, factor.solve(load), load) < 1e-10


def test_large_films_agree_with_small_ones():
    """The load of a journal bearing between a direct solve and conjugate gradients: fourth order of Q2."""
    loads = []
    for n in (20, 40, 80):  # 640, 2520 and 10000 unknowns
        mesh = rectangle((2.0 * np.pi, 1.0), (n, n // 4), cell=Cell.QUADRILATERAL, periodic_x=True)
        space = film_space(mesh, degree=2)
        thickness = space.sample(lambda x, y: 1.0 + 0.5 * np.cos(x))
        posed = film(thickness, 1.0, velocity_moving=(np.ones((1, 1)), np.zeros((1, 1))))
        solution = FilmSolver(space).solve(
            FilmProblem(space, posed, {name: Held(0.0) for name in ("bottom", "top")}, Cavitation.NONE)
        )
        loads.append(float(space.share @ (solution.pressure * 1.0) ** 2))
    assert (loads[1] - loads[0]) / (loads[2] - loads[1]) == pytest.approx(16.0, rel=0.25)
