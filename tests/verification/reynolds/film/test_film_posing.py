"""Film problems that cannot be posed are refused before any number is computed."""

from __future__ import annotations

import numpy as np
import pytest
import skfem

from reynolds import (
    ZERO,
    Cavitation,
    Cell,
    Film,
    FilmInputError,
    FilmMesh,
    FilmProblem,
    FilmSolver,
    Held,
    film,
    film_space,
    loads,
    rectangle,
)
from reynolds.solve.boundary import check_pressures

SPACE = film_space(rectangle((0.01, 0.01), (6, 6)))
ENDS = {"left": Held(1e5), "right": Held(0.0)}


@pytest.mark.parametrize("cavitation", list(Cavitation))
def test_every_piece_of_a_film_needs_a_pressure(cavitation):
    """Without one the pressure of a piece is whatever round-off makes of it."""
    one = skfem.MeshTri.init_tensor(np.linspace(0, 1e-2, 5), np.linspace(0, 1e-2, 5))
    two = one + one.translated((2e-2, 0.0))
    sides = {"left": lambda x: x[0] < 1e-9, "right": lambda x: x[0] > 3e-2 - 1e-9}
    space = film_space(FilmMesh(two.with_boundaries(sides)))
    oil = film(1e-5, 0.03)
    with pytest.raises(FilmInputError, match="1 of 2 separate pieces"):
        check_pressures(FilmProblem(space, oil, {"left": Held(1e5)}, cavitation))
    solution = FilmSolver(space).solve(FilmProblem(space, oil, ENDS, cavitation))
    assert loads(solution).load == pytest.approx(1e5 * 1e-4)


@pytest.mark.parametrize(
    "shape", [(), (72,), (3, 72), (72, 6), (49, 1)], ids=["number", "cells", "turned", "order 2", "nodes"]
)
def test_fields_are_of_the_space(shape):
    """The compiled loops would read beside an array of another shape."""
    for fields in (
        (np.full(shape, 1e-5), ZERO + 0.03, (ZERO, ZERO), ZERO),
        (ZERO + 1e-5, np.full(shape, 0.03), (ZERO, ZERO), ZERO),
        (ZERO + 1e-5, ZERO + 0.03, (ZERO, np.ones(shape)), ZERO),
        (ZERO + 1e-5, ZERO + 0.03, (ZERO, ZERO), np.ones(shape)),
    ):
        thickness, viscosity, velocity, squeeze = fields
        with pytest.raises(FilmInputError, match="72 cells"):
            FilmProblem(SPACE, Film(thickness, viscosity, velocity, (ZERO, ZERO), squeeze), ENDS)


def test_what_is_no_number_is_refused():
    with pytest.raises(FilmInputError, match="not finite"):
        FilmProblem(SPACE, film(1e-5, 0.03, velocity_moving=(ZERO + np.nan, ZERO)), ENDS)
    with pytest.raises(FilmInputError, match="not finite"):
        check_pressures(FilmProblem(SPACE, film(1e-5, 0.03), {"left": Held(np.nan)}))
    for thickness in (1e-100, 1e120):
        with pytest.raises(FilmInputError, match="h\\^3/"):
            FilmSolver(SPACE).solve(FilmProblem(SPACE, film(thickness, 0.03), ENDS))


def test_the_least_film_of_a_step_within_cells_is_that_of_the_step():
    """Extrapolated to the vertices a step of 1 to 30 um would give a negative film."""
    step = SPACE.sample(lambda x, y: np.where(x < 5.2e-3, 30e-6, 1e-6))
    known = np.where(SPACE.vertices[:, 0] < 5.2e-3, 30e-6, 1e-6)
    oil = Film(step, ZERO + 0.03, (ZERO, ZERO), (ZERO, ZERO), ZERO, known)
    assert loads(FilmSolver(SPACE).solve(FilmProblem(SPACE, oil, ENDS))).film_thickness_min == 1e-6


def test_the_least_film_of_a_single_thin_cell_is_not_averaged_away():
    cells = np.full(len(SPACE.cells), 20e-6)
    cells[7] = 2e-6
    oil = film(SPACE.sample_cells(cells), 0.03)
    assert loads(FilmSolver(SPACE).solve(FilmProblem(SPACE, oil, ENDS))).film_thickness_min == 2e-6


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("degree", [1, 2])
def test_unknowns_stand_where_scikit_fem_has_them(cell, degree):
    """Corners, middles of edges and of cells, through the basis that interpolates x and y."""
    space = film_space(rectangle((1.0, 2.0), (3, 2), cell=cell), degree=degree)
    places = np.array([space.place(unknown) for unknown in range(space.size)])
    at = places[space.dofs]
    found = np.einsum("qi,eid->deq", space.reference.value, at)
    np.testing.assert_allclose(found, space.points, atol=1e-14)
