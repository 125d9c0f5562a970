"""Film equation: quadrilaterals has_hourglass_mode of their resistance to twisting.

Accuracy, signs of the couplings, and that every slope of the balance knows of the relief.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import skfem
from skfem.models.poisson import laplace

from reynolds import (
    Cavitation,
    Cell,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    Fluid,
    Held,
    Surface,
    annulus,
    film,
    film_space,
    isotropic,
    loads,
    rectangle,
    stiffness,
    winkler,
)
from reynolds.equation.balance import FilmState, by_deformation, flow_balance, operators, slopes
from reynolds.equation.deformation_sparsity import deformation_pattern
from reynolds.floating.sensitivity import thickness_load

JUMPS = 5.0  # decades of the conductance within a cell
ASPECTS = (0.02, 0.4, 1.0, 2.0, 7.0, 300.0)
SKEWED = np.array([[1.0, 0.3], [0.5, 1.2]])
ROUND_OFF = 1e-13  # of the largest entry: some ten products and sums


def _cells(aspect: float, counts: tuple[int, int] = (4, 3)) -> FilmSpace:
    """Cells `aspect` times as long along x as along y."""
    return film_space(rectangle((counts[0] * aspect, counts[1]), counts, cell=Cell.QUADRILATERAL))


def _rough(space: FilmSpace, seed: int) -> np.ndarray:
    """A conductance that jumps from point to point."""
    return 10.0 ** np.random.default_rng(seed).uniform(-JUMPS, 0.0, space.area.shape)


def _matrix(space: FilmSpace, data: np.ndarray) -> np.ndarray:
    full = np.zeros((space.size, space.size))
    full[space.pattern.indices, space.pattern.columns] = data
    return full + np.triu(full, 1).T


def _unrelieved(space: FilmSpace) -> FilmSpace:
    """The same with gradients at the corners alone."""
    stiff = replace(space)
    vars(stiff)["tensors"] = replace(space.tensors, parallel=np.zeros_like(space.tensors.parallel))
    return stiff


@pytest.mark.parametrize("aspect", [0.75, 1.0, 1.4])
def test_uniform_rectangles_are_integrated_exactly(aspect):
    """Up to sides of 1 to sqrt 2 the least side couples more than a sixth of the sum of all."""
    space = _cells(aspect)
    exact = laplace.assemble(skfem.Basis(space.film_mesh.mesh, skfem.ElementQuad1(), intorder=4)).toarray()
    at = np.argsort(space.vertex_dofs)
    found = _matrix(space, stiffness(space, isotropic(np.ones((1, 1)))))
    assert np.abs(found - exact[np.ix_(at, at)]).max() <= ROUND_OFF * exact.max()


@pytest.mark.parametrize("aspect", ASPECTS)
@pytest.mark.parametrize("seed", range(3))
def test_no_coupling_turns_positive(aspect, seed):
    """Not by round-off either: a side's coupling is at most all taken, in the cell where it is least."""
    space = _cells(aspect, (12, 9))
    off = space.pattern.indices != space.pattern.columns
    assert stiffness(space, isotropic(_rough(space, seed)))[off].max() <= 0.0


@pytest.mark.parametrize("seed", range(3))
def test_every_flow_costs_power(seed):
    """p . K p >= 0 in parallelograms however skewed, where couplings between far corners may be positive."""
    rng = np.random.default_rng(seed)
    for _ in range(100):
        space = _cells(1.0, (1, 1))
        space = space.moved(space.vertices @ rng.normal(size=(2, 2)))
        matrix = _matrix(space, stiffness(space, isotropic(_rough(space, rng.integers(1000)))))
        assert np.linalg.eigvalsh(matrix).min() >= -ROUND_OFF * np.abs(matrix).max()


SHAPES = {
    "rectangles": _cells(1.7),
    "parallelograms": _cells(1.0).moved(_cells(1.0).vertices @ SKEWED),
    "sectors": film_space(annulus(1.0, 2.0, (3, 14), cell=Cell.QUADRILATERAL)),
}


@pytest.mark.parametrize("kind", sorted(SHAPES))
def test_a_linear_pressure_drives_a_uniform_flow(kind):
    """Nothing gathers inside."""
    space = SHAPES[kind]
    matrix = _matrix(space, stiffness(space, isotropic(np.ones((1, 1)))))
    pressure = np.empty(space.size)
    pressure[space.vertex_dofs] = space.vertices @ np.array([1.0, -2.0])
    inside = np.ones(space.size, dtype=bool)
    inside[np.concatenate(list(space.edge_dofs.values()))] = False
    assert np.abs(matrix @ pressure)[inside].max() <= ROUND_OFF * matrix.max() * np.abs(pressure).max()


def _squeezed(space: FilmSpace) -> float:
    """Load of a plate, length, viscosity and speed one, that comes down on a film of 12^(1/3)."""
    edges = dict.fromkeys(("left", "right", "bottom", "top"), Held(0.0))
    posed = film(12.0 ** (1.0 / 3.0), 1.0, squeeze=np.full((1, 1), -1.0))
    return loads(FilmSolver(space).solve(FilmProblem(space, posed, edges, Cavitation.NONE))).load


def _squeezed_exactly(length: float) -> float:
    """The series of Saint-Venant's torsion of a bar `length` x 1, for 12 mu V/h^3 = 1 (Timoshenko and Goodier)."""
    odd = np.arange(1.0, 60.0, 2.0)
    series = np.sum(np.tanh(0.5 * np.pi * odd * length) / odd**5)
    return length / 12.0 * (1.0 - 192.0 / np.pi**5 * series / length)


@pytest.mark.parametrize(("length", "rows"), [(1.0, 1), (1.0, 2), (4.0, 1), (3.0, 4)])
def test_squeezed_rectangles(length, rows, refine):
    """Cells of sides 1, 2, 4 and 12 to 1: order 2, between the exact load and that of gradients at the corners.

    Of a symmetric K the load f . K^-1 f falls with every stiffening: corners bear less than the exact integral of
    bilinear pressures, that less than all pressures, and the relief stops between the two.
    """

    def plate(n: int) -> FilmSpace:
        return film_space(rectangle((length, 1.0), (n, rows * n), cell=Cell.QUADRILATERAL))

    exact = _squeezed_exactly(length)
    found = refine(lambda n: _squeezed(plate(n)), (12, 24, 48))
    stiff = _squeezed(_unrelieved(plate(48)))
    assert stiff < found.finest < exact
    assert exact - found.finest <= found.tolerance()


def _thickened(pressure, viscosity):
    """Barus 1893, with a strong coefficient."""
    mu = viscosity * np.exp(0.4 * pressure)
    return mu, 0.4 * mu


def _compressed(pressure):
    return 1.0 + 0.1 * pressure, np.full(np.shape(pressure), 0.1)


STIFF = 1e3
ROUGH = Surface(0.2, 0.1, 3.0, 1.0, 0.7)


def _posed(space: FilmSpace, thickness: np.ndarray, surface: Surface | None) -> FilmProblem:
    one = np.ones((1, 1))
    posed = film(thickness, 0.5, velocity_moving=(0.1 * one, 0.04 * one))
    return FilmProblem(
        space, posed, {"left": Held(0.0)}, Cavitation.NONE, fluid=Fluid(_thickened, _compressed), surface=surface,
        walls=winkler(space, STIFF),
    )  # fmt: skip


@pytest.mark.parametrize("surface", [None, ROUGH], ids=["smooth", "ridges"])
@pytest.mark.parametrize("skewed", [False, True], ids=["rectangles", "parallelograms"])
def test_slopes_of_a_twisted_film(surface, skewed):
    """By pressure, deformation and thickness against central differences: error step^2 + round-off/step."""
    space = _cells(1.5)
    if skewed:
        space = space.moved(space.vertices @ SKEWED)
    rng, step = np.random.default_rng(5), 1e-5
    thickness = rng.uniform(0.8, 2.0, space.area.shape)
    pressure, opened = rng.uniform(0.0, 1.0, space.size), rng.uniform(0.0, 0.1, len(space.vertices))
    thicker, more, push = (rng.normal(size=like.shape) for like in (thickness, opened, pressure))

    def net(s: float, a: float = 0.0, b: float = 0.0, c: float = 0.0) -> np.ndarray:
        problem = _posed(space, thickness + s * a * thicker, surface)
        state = FilmState(pressure + s * b * push, np.ones(space.size), opened + s * c * more)
        return flow_balance(problem, operators(problem, state), state).net

    def differences(**along: float) -> np.ndarray:
        return (net(step, **along) - net(-step, **along)) / (2.0 * step)

    problem = _posed(space, thickness, surface)
    state = FilmState(pressure, np.ones(space.size), opened)
    parts = operators(problem, state)
    upper, lower, gain = slopes(problem, parts, state).by_pressure
    by_pressure = np.zeros((space.size, space.size))
    by_pressure[space.pattern.columns, space.pattern.indices] = lower
    by_pressure[space.pattern.indices, space.pattern.columns] = upper
    by_pressure += np.diag(gain)
    solution = replace(FilmSolver(space).solve(problem), pressure=pressure, deformation=opened)
    for found, expected in (
        (by_pressure @ push, differences(b=1.0)),
        (
            by_deformation(problem, parts, state, np.ones(space.size), deformation_pattern(space)) @ more,
            differences(c=1.0),
        ),
        (thickness_load(solution, thicker[:, :, None], parts)[:, 0], differences(a=1.0)),
    ):
        assert np.abs(found - expected).max() <= 1e-7 * np.abs(expected).max()
