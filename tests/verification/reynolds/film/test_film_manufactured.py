"""Film equation: manufactured solutions, order of convergence in L2."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from reynolds import Cell, FilmProblem, FilmSolver, FilmSpace, Held, film, film_space, rectangle
from reynolds.solve.loads import evaluate

WIDTH = 0.7  # of the film across y; its length along x is 1
COMPLEX_STEP = 1e-30
MESHES = (8, 16, 32)

Field = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Manufactured:
    """A film whose pressure is known, everything of order one. Fields take complex x and y."""

    pressure: Field
    slope_x: Field
    slope_y: Field
    thickness: Field
    viscosity: Field
    mean_x: Field
    mean_y: Field
    held: tuple[str, ...]
    periodic: bool = False

    def squeeze(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """The dh/dt that makes the pressure a solution: minus the divergence of the flow, by complex steps."""
        along = self.flow(x + 1j * COMPLEX_STEP, y)[0].imag / COMPLEX_STEP
        across = self.flow(x, y + 1j * COMPLEX_STEP)[1].imag / COMPLEX_STEP
        return -(along + across)

    def flow(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        h = self.thickness(x, y)
        conductance = h**3 / (12.0 * self.viscosity(x, y))
        return (
            h * self.mean_x(x, y) - conductance * self.slope_x(x, y),
            h * self.mean_y(x, y) - conductance * self.slope_y(x, y),
        )


def _held_all_round() -> Manufactured:
    k = np.pi / WIDTH
    return Manufactured(
        pressure=lambda x, y: np.sin(np.pi * x) * np.sin(k * y) * np.exp(x),
        slope_x=lambda x, y: (np.pi * np.cos(np.pi * x) + np.sin(np.pi * x)) * np.sin(k * y) * np.exp(x),
        slope_y=lambda x, y: k * np.sin(np.pi * x) * np.cos(k * y) * np.exp(x),
        thickness=lambda x, y: 1.0 - 0.4 * x + 0.3 * np.sin(3.0 * y + x),
        viscosity=lambda x, y: 1.0 + 0.5 * x * y,
        mean_x=lambda x, y: 0.8 + 0.0 * x,
        mean_y=lambda x, y: -0.5 + 0.0 * x,
        held=("left", "right", "bottom", "top"),
    )


def _across_the_seam() -> Manufactured:
    k, turn = np.pi / WIDTH, 2.0 * np.pi
    return Manufactured(
        pressure=lambda x, y: (2.0 + np.sin(turn * x + 0.7)) * np.sin(k * y),
        slope_x=lambda x, y: turn * np.cos(turn * x + 0.7) * np.sin(k * y),
        slope_y=lambda x, y: k * (2.0 + np.sin(turn * x + 0.7)) * np.cos(k * y),
        thickness=lambda x, y: 1.0 + 0.4 * np.cos(turn * x - 1.0) + 0.2 * y,
        viscosity=lambda x, y: 1.0 + 0.3 * np.sin(turn * x + y),
        mean_x=lambda x, y: 1.0 + 0.3 * y,
        mean_y=lambda x, y: 0.4 + 0.0 * x,
        held=("bottom", "top"),
        periodic=True,
    )


def _closed_with_wall_flow() -> Manufactured:
    """Bottom closed: the wall pushes oil at it, and the pressure turns all of it back (h = mu = 1 there)."""
    k, push = 0.5 * np.pi / WIDTH, 0.2

    def profile(y: np.ndarray) -> np.ndarray:
        return np.cos(k * y) + 12.0 * push * y * (1.0 - y / WIDTH)

    return Manufactured(
        pressure=lambda x, y: np.sin(np.pi * x) * profile(y),
        slope_x=lambda x, y: np.pi * np.cos(np.pi * x) * profile(y),
        slope_y=lambda x, y: np.sin(np.pi * x) * (-k * np.sin(k * y) + 12.0 * push * (1.0 - 2.0 * y / WIDTH)),
        thickness=lambda x, y: 1.0 + 0.5 * y * (1.0 - x),
        viscosity=lambda x, y: 1.0 + 0.5 * x * y,
        mean_x=lambda x, y: 0.6 + 0.0 * x,
        mean_y=lambda x, y: push * np.sin(np.pi * x),
        held=("left", "right", "top"),
    )


PROBLEMS = {
    "held all round": _held_all_round(),
    "periodic seam": _across_the_seam(),
    "one closed boundary": _closed_with_wall_flow(),
}


def _space(case: Manufactured, n: int, cell: Cell, degree: int, distorted: bool) -> FilmSpace:
    mesh = rectangle((1.0, WIDTH), (n, n), cell=cell, periodic_x=case.periodic)
    space = film_space(mesh, degree=degree)
    if not distorted:
        return space
    x, y = space.vertices.T
    inside = (np.minimum(x, 1.0 - x) > 1e-9) & (np.minimum(y, WIDTH - y) > 1e-9)
    shake = np.random.default_rng(n).uniform(-0.2, 0.2, (len(x), 2)) * (1.0 / n, WIDTH / n)
    return space.moved(space.vertices + shake * inside[:, None])


def _error(case: Manufactured, space: FilmSpace) -> float:
    """L2 norm of the pressure's error. The walls share the mean velocity in a skew way: 1.4 and 0.6 of it."""
    mean_x, mean_y = space.sample(case.mean_x), space.sample(case.mean_y)
    posed = film(
        space.sample(case.thickness),
        space.sample(case.viscosity),
        velocity_moving=(1.4 * mean_x, 0.6 * mean_y),
        velocity_fixed=(0.6 * mean_x, 1.4 * mean_y),
        squeeze=space.sample(case.squeeze),
    )
    problem = FilmProblem(space, posed, {name: Held(0.0) for name in case.held})
    solution = FilmSolver(space).solve(problem)
    found, _, _ = evaluate(solution, solution.pressure)
    return float(np.sqrt(np.sum((found - space.sample(case.pressure)) ** 2 * space.area)))


@pytest.mark.parametrize("distorted", [False, True], ids=["regular", "distorted"])
@pytest.mark.parametrize("degree", [1, 2])
@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("name", list(PROBLEMS))
def test_order(name, cell, degree, distorted, validation):
    case = PROBLEMS[name]
    errors = [_error(case, _space(case, n, cell, degree, distorted)) for n in MESHES]
    order = float(np.log2(errors[-2] / errors[-1]))
    element = f"{'P' if cell is Cell.TRIANGLE else 'Q'}{degree}"
    validation(
        case="Manufactured film",
        source="constructed; source term by complex steps",
        quantity=f"order of {element}, {name}, {'distorted' if distorted else 'regular'} mesh",
        unit="1",
        expected=degree + 1.0,
        obtained=order,
        tolerance=0.25,
        note="L2 errors " + ", ".join(f"{e:.1e}" for e in errors),
    )
