"""Film problems that cannot be posed say where, what was found and what was expected."""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import (
    ZERO,
    Cavitation,
    Cell,
    Film,
    FilmInputError,
    FilmNotConverged,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    Held,
    Pocket,
    film,
    film_space,
    no_feed,
    rectangle,
)
from reynolds.solve import solver as solve


@pytest.fixture(scope="module")
def space() -> FilmSpace:
    return film_space(rectangle((0.01, 0.01), (6, 6), cell=Cell.QUADRILATERAL))


@pytest.fixture(scope="module")
def wedge(space) -> Film:
    return film(space.sample(lambda x, y: 1e-5 * (1.0 + 50.0 * x)), 0.03, velocity_moving=(np.ones((1, 1)), ZERO))


def _refusal(space: FilmSpace, posed: Film, boundary, *more) -> FilmInputError:
    with pytest.raises(FilmInputError) as caught:
        FilmSolver(space).solve(FilmProblem(space, posed, boundary, *more))
    return caught.value


def test_unknown_boundary_names_the_known_ones(space, wedge):
    refusal = _refusal(space, wedge, {"left": Held(0.0), "rigth": Held(0.0)})
    assert "rigth" in refusal.where
    assert "bottom, left, right, top" in refusal.expected


def test_no_pressure_level(space, wedge):
    assert "no pressure" in _refusal(space, wedge, {}).found
    pocketed = film_space(space.film_mesh, pockets=["left"])
    assert "no pressure" in _refusal(pocketed, wedge, {"left": Pocket(no_feed)}).found


def test_pocket_on_separate_nodes(space, wedge):
    refusal = _refusal(space, wedge, {"left": Pocket(no_feed), "right": Held(0.0)})
    assert "left" in refusal.where
    assert "pockets" in refusal.expected


def test_boundary_below_cavitation_pressure(space, wedge):
    refusal = _refusal(space, wedge, {"left": Held(-2e5), "right": Held(0.0)}, Cavitation.REYNOLDS, -1e5)
    assert "-2e+05 Pa" in refusal.found
    assert "-1e+05 Pa" in refusal.expected


@pytest.mark.parametrize("bad", [0.0, -1e-6, np.nan, np.inf])
def test_film_that_is_no_film(space, bad):
    thickness = np.full(space.area.shape, 1e-5)
    thickness[3, 1] = bad
    with pytest.raises(FilmInputError, match=r"film thickness.* m; expected positive everywhere"):
        film(thickness, 0.03)
    with pytest.raises(FilmInputError, match=r"viscosity.* Pa s; expected positive everywhere"):
        film(space.sample(1e-5), bad)


def test_solver_of_another_mesh(space, wedge):
    other = film_space(rectangle((0.01, 0.01), (5, 5)))
    with pytest.raises(FilmInputError, match="another mesh"):
        FilmSolver(other).solve(FilmProblem(space, wedge, {"left": Held(0.0)}))


def test_steps_that_run_out_are_not_an_answer(space, monkeypatch):
    """One step is too few for a film that ruptures: the solver raises instead of handing out what it has."""
    monkeypatch.setattr(solve, "MAX_ITERATIONS", 1)
    opening = film(
        space.sample(lambda x, y: 1e-5 * (1.0 + 0.9 * np.sin(600.0 * x))), 0.03, velocity_moving=(np.ones((1, 1)), ZERO)
    )
    problem = FilmProblem(space, opening, {"left": Held(0.0), "right": Held(0.0)}, Cavitation.REYNOLDS)
    with pytest.raises(FilmNotConverged, match=r"not settled after 1 iterations.*Try: "):
        FilmSolver(space).solve(problem)
