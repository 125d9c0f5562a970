"""Arguments of another kind are told as FilmInputError, and a solution shows itself in a line."""

import numpy as np
import pytest

from reynolds import Cell, FilmInputError, FilmProblem, FilmSolver, Fluid, Held, annulus, film, film_space, rectangle

SIZE, ALPHA = (0.01, 0.001), 2e-8
SPACE = film_space(rectangle(SIZE, (16, 2)))
FILM = film(
    SPACE.sample(lambda x, y: 1e-5 * (2.0 - x / 0.01)), 0.03, velocity_moving=(np.full((1, 1), 1.0), np.zeros((1, 1)))
)
EDGES = {"left": Held(0.0), "right": Held(0.0)}


def barus(pressure, viscosity):
    found = viscosity * np.exp(ALPHA * pressure)
    return found, ALPHA * found


def pressed(pressure):
    return 1.0 + pressure / 1.5e9, np.full_like(pressure, 1.0 / 1.5e9)


def solved(**fluid):
    return FilmSolver(SPACE).solve(FilmProblem(SPACE, FILM, EDGES, fluid=Fluid(**fluid)))


@pytest.mark.parametrize(
    ("call", "where", "expected"),
    [
        (lambda: rectangle(0.01, (8, 2)), "rectangle, size", "two lengths"),
        (lambda: rectangle(("10 mm", "1 mm"), (8, 2)), "rectangle, size", "two lengths"),
        (lambda: rectangle(SIZE, (8.5, 2)), "rectangle, cells", "two whole numbers"),
        (lambda: rectangle(SIZE, 8), "rectangle, cells", "two whole numbers"),
        (lambda: rectangle(SIZE, (8, 2), cell="quadrilateral"), "rectangle, cell", "Cell.QUADRILATERAL"),
        (lambda: annulus(0.01, 0.02, (8.0, 24)), "ring, cells", "two whole numbers"),
        (lambda: annulus("10 mm", 0.02, (8, 24)), "ring, radii", "two lengths"),
        (lambda: annulus(0.01, 0.02, (8, 24), cell="triangle"), "ring, cell", "Cell.TRIANGLE"),
        (lambda: film("10 um", 0.03), "film thickness", "a number or an array, m"),
        (lambda: film(1e-5, "30 mPa s"), "viscosity", "a number or an array, Pa s"),
        (lambda: FilmProblem(SPACE, FILM, {"left": 0.0}), "boundary left", "Held or Pocket"),
        (lambda: solved(viscosity=lambda p, mu: mu * np.exp(ALPHA * p)), "fluid, viscosity", "its slope by pressure"),
        (lambda: solved(density=lambda p: 1.0 + p / 1.5e9), "fluid, density", "law(pressure) -> (density"),
        (lambda: solved(viscosity=lambda p, mu: (barus(p, mu)[0], 1e-8 * mu)), "fluid, viscosity", "the derivative"),
        (lambda: solved(viscosity=lambda p, mu: (barus(p, mu)[0], 1e-30 * mu)), "fluid, viscosity", "the derivative"),
        (lambda: solved(density=lambda p: (pressed(p)[0], 0.0 * p)), "fluid, density", "the derivative"),
    ],
)
def test_arguments_of_another_kind_are_told(call, where, expected):
    with pytest.raises(FilmInputError) as raised:
        call()
    assert raised.value.where == where
    assert expected in raised.value.expected


def test_laws_of_ones_own_solve():
    plain = solved(
        viscosity=lambda p, mu: (mu, np.zeros_like(p)), density=lambda p: (np.ones_like(p), np.zeros_like(p))
    )
    own = solved(viscosity=barus, density=pressed)
    assert own.imbalance < 1e-9
    assert own.pressure.max() > plain.pressure.max()


def test_whole_numbers_and_lengths_of_numpy_are_numbers():
    mesh = rectangle(np.array(SIZE), np.array([4, 2]), cell=Cell.QUADRILATERAL)
    assert mesh.mesh.nelements == 8


def test_a_solution_shows_itself_in_a_line():
    shown = repr(solved())
    assert shown.startswith("FilmSolution(51 unknowns, ")
    assert " of them in a cavity: pressure 0 to " in shown
    assert "film 1" in shown
    assert "\n" not in shown
    assert len(shown) < 200
