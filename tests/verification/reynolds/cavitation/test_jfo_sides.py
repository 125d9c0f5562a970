"""Film equation: cavities that run along the side of a bearing.

Where the walls carry no oil in over an edge, what stands there must not matter to the cavity beside it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reynolds import ZERO, Cavitation, Cell, FilmProblem, FilmSolver, Held, film, film_space, loads, rectangle
from reynolds.equation.balance import without_inflow

ROUND = 2.0 * np.pi
SLIDING = (np.ones((1, 1)), ZERO)
GROOVE = np.pi / 2.0 - np.pi / 24.0, np.pi / 2.0 + np.pi / 24.0, 0.75


def _grooved(n: int, cell: Cell, side: float) -> tuple[float, float]:
    """Load of half a journal bearing, L/D = 1, eps = .6, and flow in at its groove; `side`: its film fraction."""
    space = film_space(rectangle((ROUND, 1.0), (n, n // 4), cell=cell, periodic_x=True))
    place = np.full((2, space.size), np.inf)
    np.minimum.at(place, (slice(None), space.vertex_dofs), space.vertices.T)
    x, y = place
    first, last, end = GROOVE
    groove = (x > first - 1e-9) & (x < last + 1e-9) & (y < end + 1e-9)
    posed = film(space.sample(lambda x, y: 1.0 + 0.6 * np.cos(x)), 1.0, velocity_moving=SLIDING)
    held = np.where(groove, 0.05, np.nan)
    solution = FilmSolver(space).solve(FilmProblem(space, posed, {"top": Held(0.0, side)}, held_nodes=held))
    found = loads(solution)
    assert found.mass_balance_error < 1e-11
    return found.load, -float(solution.outflow[groove].sum())


@pytest.mark.parametrize("cell", list(Cell))
def test_side_of_a_grooved_journal(cell, validation, refine):
    """Sides full and dry give one bearing: upwinding with the edge would feed or drain a third of the supply."""
    full, dry = (refine(lambda n, s=side: _grooved(n, cell, s), (48, 96, 192), 1.0) for side in (1.0, 0.0))
    for quantity, one, other in zip(("load", "flow in at the groove"), full, dry, strict=True):
        validation(
            case="Grooved journal bearing, sides full and dry",
            source="what lies downstream is of no matter",
            quantity=f"{quantity}, sides full over sides dry, {cell.value}",
            unit="1",
            expected=1.0,
            obtained=one.finest / other.finest,
            tolerance=(one.front_tolerance() + other.front_tolerance()) / other.finest,
        )
        assert one.finest == pytest.approx(other.finest, rel=0.01)
        assert one.values[0] == pytest.approx(one.finest, rel=0.1)


@pytest.mark.parametrize("cell", list(Cell))
def test_a_ring_that_nothing_feeds_has_a_level(cell):
    """A concentric journal at cavitation pressure all over: neither full nor empty by the balance, it is full."""
    space = film_space(rectangle((ROUND, 1.0), (64, 16), cell=cell, periodic_x=True))
    problem = FilmProblem(space, film(1.0, 1.0, velocity_moving=SLIDING), {"top": Held(0.0)})
    solution = FilmSolver(space).solve(problem)
    assert solution.film_fraction == pytest.approx(1.0, abs=1e-9)
    assert np.abs(solution.pressure).max() < 1e-9


@pytest.mark.parametrize("cell", list(Cell))
def test_edges_without_any_flow_of_the_walls_count_as_supplies(cell):
    """Walls at rest, and a held line inside the film, which walls carry oil over: no unknown loses its supply."""
    plain = rectangle((1.0, 1.0), (8, 4), cell=cell)
    line = plain.mesh.facets_satisfying(lambda x: np.isclose(x[0], 0.5))
    mesh = replace(plain, mesh=plain.mesh.with_boundaries({"line": line}, boundaries_only=False))
    space = film_space(mesh)
    problem = FilmProblem(
        space, film(1.0, 1.0, velocity_moving=SLIDING), {"right": Held(0.0), "line": Held(0.0)}, Cavitation.JFO
    )
    at_rest, sliding = (ZERO, ZERO), (np.ones((1, 1)), ZERO)
    assert not without_inflow(problem, at_rest).any()
    assert np.array_equal(np.flatnonzero(without_inflow(problem, sliding)), space.edge_dofs["right"])
