"""Floating films that tear: a part with a pocket is pulled off, and flies.

Where all of a film and its pocket is at cavitation pressure nothing resists but mass: q = q0 + F t^2/(2 m). No oil
comes in, so that what film and pocket hold stays what it was.
"""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from reynolds import (
    ALEXANDER_2,
    ZERO,
    Boundary,
    Film,
    FilmInputError,
    FilmProblem,
    FilmSolver,
    Floating,
    Held,
    Pocket,
    advance,
    annulus,
    film_space,
    full_film,
    no_feed,
    solve_stage,
    started,
    steady,
)
from reynolds.floating.pockets import filled

INNER, OUTER, VISCOSITY = 7e-3, 12e-3, 0.03
PULL, MASS, START, END = 14.0, 0.139, 1e-5, 1e-3  # N, kg, m, s


def _pulled(pocket: Boundary) -> Floating:
    space = film_space(annulus(INNER, OUTER, (4, 16)), pockets=("inner",))
    oil = Film(ZERO, np.full((1, 1), VISCOSITY), (ZERO, ZERO), (ZERO, ZERO), ZERO)
    problem = FilmProblem(space, oil, {"inner": pocket, "outer": Held(0.0)})
    up, areas = np.ones((len(space.vertices), 1)), {"inner": np.array([np.pi * INNER**2])}
    pull = steady(np.array([PULL]))
    return Floating("part", lambda t: problem, lambda t: up, lambda t, q, rate: pull, 0.0, areas, np.diag([MASS]))


def test_flight_of_a_torn_film():
    """Steps of second order are exact for a constant acceleration; the pocket is a cavity with the oil it had."""
    floating = _pulled(Pocket(no_feed))
    space = floating.shape_at(0.0).space
    state = started(floating, 0.0, np.array([START]))
    inside = np.setdiff1d(np.arange(space.size), space.edge_dofs["outer"])  # the edge itself stays full
    before, node = state.held.copy(), space.edge_dofs["inner"][0]
    for _ in range(8):
        state = advance(ALEXANDER_2, partial(solve_stage, FilmSolver(space), floating), state, END / 8.0).state
    assert state.q[0] - START == pytest.approx(PULL * END**2 / (2.0 * MASS), rel=1e-8)
    assert state.held[inside] == pytest.approx(before[inside], rel=1e-9, abs=0.0)
    assert state.stage is not None
    grown = np.pi * INNER**2 * (state.q[0] - START)
    full = before[node] + grown + space.share[node] * (state.q[0] - START)
    assert state.stage.solution.film_fraction[node] == pytest.approx(before[node] / full, rel=1e-8)


def test_a_pocket_fills_what_its_supply_sends():
    """A supply of q m3/s at any pressure fills the torn pocket by q t; none of it reaches the torn film."""
    sent = 1e-7
    floating = _pulled(Pocket(lambda pressure: (sent, 0.0)))
    space = floating.shape_at(0.0).space
    state = started(floating, 0.0, np.array([START]))
    inside = np.setdiff1d(np.arange(space.size), space.edge_dofs["outer"])
    before = state.held[inside].sum()
    for _ in range(8):
        state = advance(ALEXANDER_2, partial(solve_stage, FilmSolver(space), floating), state, END / 8.0).state
    assert state.held[inside].sum() - before == pytest.approx(sent * END, rel=1e-6, abs=0.0)


def test_pockets_that_are_none():
    floating = _pulled(Held(0.0))
    with pytest.raises(FilmInputError, match="part, pockets: Held at boundary inner; expected a Pocket"):
        full_film(floating, 0.0, np.array([START]))
    free = _pulled(Pocket(no_feed))
    with pytest.raises(FilmInputError, match=r"part, pocket inner: -.* m3; expected a volume above"):
        filled(free, free.shape_at(0.0), np.array([-1e-4]))
