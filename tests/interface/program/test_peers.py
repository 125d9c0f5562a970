"""Meshes of the comparison with peers: an error of the load is one of the film, not of the load's integral."""

from __future__ import annotations

import math
from importlib import import_module
from types import SimpleNamespace

import numpy as np
import pytest

from reynolds.fem.space import film_space
from reynolds.problem import Cavitation
from reynolds.solve.loads import point_fields
from reynolds.solve.solver import FilmSolver


@pytest.fixture
def comparison(proof: SimpleNamespace) -> SimpleNamespace:
    """Modules of the comparison by their names; their folder is on the path."""
    assert proof is not None
    return SimpleNamespace(**{name: import_module(name) for name in ("film", "journal_series", "peers")})


@pytest.mark.parametrize(("degree", "order"), [(1, 2), (2, 4)])
def test_the_load_converges_from_mesh_to_mesh(comparison: SimpleNamespace, degree: int, order: int) -> None:
    """To 1e4 unknowns as the square of the step with linear elements, and its fourth power with quadratic ones.

    The coarsest mesh, of two quadratic cells across, nearly so.
    """
    exact, errors, cells = math.hypot(*comparison.journal_series.force()), [], comparison.peers.CELLS[degree][:3]
    for count in cells:
        space = film_space(comparison.film.journal_mesh(count), degree=degree)
        solution = FilmSolver(space).solve(comparison.film.journal(space, Cavitation.NONE))
        carried = 2.0 * np.maximum(point_fields(solution).pressure, 0.0) * space.area
        angle = space.points[0]
        load = math.hypot(float(np.sum(carried * np.cos(angle))), float(np.sum(carried * np.sin(angle))))
        errors.append(abs(load / exact - 1.0))
    found = np.log(np.divide(errors[:-1], errors[1:])) / np.log(np.divide(cells[1:], cells[:-1]))
    assert found[1] == pytest.approx(order, abs=0.1)
    assert found[0] == pytest.approx(order, abs=0.6)
