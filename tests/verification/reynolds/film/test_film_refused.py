"""Requests without an answer are refused in words: never a number, never another library's error."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reynolds import (
    ZERO,
    Cavitation,
    FilmInputError,
    FilmNotConverged,
    FilmProblem,
    FilmSolver,
    Held,
    Pocket,
    Storage,
    annulus,
    film,
    film_space,
    loads,
    march,
    rectangle,
)
from reynolds.solve.boundary import check_pressures
from reynolds.solve.transient import oil_held

SPACE = film_space(rectangle((0.01, 0.01), (8, 8)))
FED = film_space(rectangle((0.01, 0.01), (8, 8)), pockets=["bottom"])
EDGES = {name: Held(0.0) for name in ("left", "right", "bottom", "top")}
SLIDING = (np.ones((1, 1)), ZERO)
CLOSING = film(SPACE.sample(lambda x, y: 1e-5 * (2.0 - x / 0.01)), 0.03, velocity_moving=SLIDING)
OPENING = film(FED.sample(lambda x, y: 1e-5 * (1.0 + x / 0.01)), 0.03, velocity_moving=SLIDING)


def constant(inflow: float) -> Pocket:
    return Pocket(lambda pressure: (inflow, 0.0))


def throttle(supply: float) -> Pocket:
    return Pocket(lambda pressure: (1e-13 * (supply - pressure), -1e-13))


@pytest.mark.parametrize(
    ("size", "cells"),
    [((-0.01, 0.01), (4, 4)), ((0.0, 0.01), (4, 4)), ((0.01, np.nan), (4, 4)), ((0.01, 0.01), (0, 4))],
)
def test_a_rectangle_without_area(size, cells):
    with pytest.raises(FilmInputError, match="rectangle"):
        rectangle(size, cells)


@pytest.mark.parametrize(
    ("inner", "outer", "cells"),
    [
        (-0.005, 0.01, (4, 8)), (0.0, 0.01, (4, 8)), (0.01, 0.005, (4, 8)), (0.005, np.nan, (4, 8)),
        (0.005, 0.01, (0, 8)), (0.005, 0.01, (4, 2)),
    ],
)  # fmt: skip
def test_a_ring_without_area(inner, outer, cells):
    with pytest.raises(FilmInputError, match="ring"):
        annulus(inner, outer, cells)


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"cavitation": "none"}, "member of Cavitation"),
        ({"cavitation": Cavitation.NONE, "cavitation_pressure": np.nan}, "cavitation pressure"),
        ({"held_nodes": np.array(1.0)}, "held nodes"),
        ({"held_nodes": np.zeros(3)}, "held nodes"),
        ({"storage": Storage(np.zeros(SPACE.size), 0.0)}, "step"),
        ({"storage": Storage(np.zeros(SPACE.size), -1e-3)}, "step"),
        ({"storage": Storage(np.zeros(1), 1e-3)}, "storage"),
        ({"storage": Storage(np.full(SPACE.size, -1e-12), 1e-3)}, "-1e-12 m3 of oil"),
        ({"storage": Storage(np.full(SPACE.size, np.nan), 1e-3)}, "storage"),
        ({"film": replace(CLOSING, viscosity=-CLOSING.viscosity, thickness=-CLOSING.thickness)}, "viscosity"),
        ({"film": replace(CLOSING, couette_viscosity=ZERO)}, "sliding viscosity"),
        ({"film": replace(CLOSING, thickness_at_vertices=np.ones(3))}, "at the vertices"),
    ],
    ids=str,
)
def test_problems_that_mean_nothing(changed, words):
    with pytest.raises(FilmInputError, match=words):
        replace(FilmProblem(SPACE, CLOSING, EDGES), **changed)


def test_a_field_of_one_axis():
    """Three points a triangle: three numbers would pass for them."""
    with pytest.raises(FilmInputError, match="one axis"):
        film(np.full(3, 1e-5), 0.03)


def test_a_space_that_is_none():
    with pytest.raises(FilmInputError, match="degree 3"):
        film_space(rectangle((0.01, 0.01), (2, 2)), degree=3)
    for vertices in (SPACE.vertices[:5], np.full_like(SPACE.vertices, np.nan)):
        with pytest.raises(FilmInputError, match="a place for each vertex"):
            SPACE.moved(vertices)


def test_a_start_from_another_mesh():
    other = film_space(rectangle((0.01, 0.01), (9, 9)))
    start = FilmSolver(other).solve(FilmProblem(other, film(1e-5, 0.03), {"left": Held(0.0)}))
    with pytest.raises(FilmInputError, match="start"):
        FilmSolver(SPACE).solve(FilmProblem(SPACE, CLOSING, EDGES), start)


def test_pockets_that_touch():
    """Held nodes would give a pocket their pressure, and count its flow twice."""
    oil = film(1e-5, 0.03)
    with pytest.raises(FilmInputError, match="touches a held"):
        check_pressures(FilmProblem(FED, oil, {"right": Held(0.0), "bottom": throttle(1e6)}))
    space = film_space(rectangle((0.01, 0.01), (8, 8)), pockets=["bottom", "left"])
    with pytest.raises(FilmInputError, match="touch each other"):
        check_pressures(FilmProblem(space, oil, {"bottom": throttle(1e6), "left": throttle(2e6)}))
    solution = FilmSolver(FED).solve(FilmProblem(FED, oil, {"top": Held(0.0), "bottom": throttle(1e6)}))
    assert loads(solution).mass_balance_error < 1e-12


@pytest.mark.parametrize("pocket", [constant(-1e-8), constant(-1e-6), throttle(-1e6)], ids=["1e-8", "1e-6", "-1 MPa"])
def test_a_pocket_that_draws_more_than_a_cavity_has(pocket):
    """At cavitation pressure nothing drives oil there: the balance alone would take film fractions of -1e13."""
    problem = FilmProblem(FED, OPENING, {"top": Held(0.0), "bottom": pocket})
    with pytest.raises(FilmNotConverged, match="drawn from a cavity"):
        FilmSolver(FED).solve(problem)
    pulled = FilmSolver(FED).solve(replace(problem, cavitation=Cavitation.NONE))
    assert pulled.pressure.min() < -1e6


def test_a_feed_that_is_no_number():
    with pytest.raises(FilmInputError, match="feed of a pocket"):
        FilmSolver(FED).solve(FilmProblem(FED, OPENING, {"top": Held(0.0), "bottom": constant(np.nan)}))


@pytest.mark.parametrize("cavitation", list(Cavitation))
def test_a_film_that_is_all_pocket(cavitation):
    space = film_space(rectangle((0.01, 0.01), (1, 1)), pockets=["left", "right"])
    posed = FilmProblem(space, film(1e-5, 0.03), {"left": throttle(1e6), "right": throttle(0.0)}, cavitation)
    solution = FilmSolver(space).solve(posed)
    # Through the film and both throttles one flow: 1e-13 (1e6 - p) = h^3/(12 mu) (p - q) = 1e-13 q.
    conductance = 1e-15 / (12.0 * 0.03)
    flow = 1e6 / (2e13 + 1.0 / conductance)
    assert loads(solution).flow["right"] == pytest.approx(flow, rel=1e-9, abs=0.0)
    whole = film_space(rectangle((0.01, 0.01), (1, 1)), pockets=["left", "right", "bottom", "top"])
    alone = FilmSolver(whole).solve(FilmProblem(whole, film(1e-5, 0.03), {"left": throttle(1e6)}, cavitation))
    assert alone.pressure == pytest.approx(1e6)


def test_what_a_march_starts_from_is_of_the_mesh():
    problem = FilmProblem(SPACE, CLOSING, EDGES)
    with pytest.raises(FilmInputError, match="storage"):
        list(march(FilmSolver(SPACE), lambda t: problem, 1e-3, 1e-3, held=np.zeros(1)))
    with pytest.raises(FilmInputError, match="film fraction"):
        oil_held(problem, np.ones(3))


def test_a_march_on_a_mesh_that_moves():
    """Its motion would carry oil through the film's edges, which no term counts."""

    def at(time: float) -> FilmProblem:
        return FilmProblem(SPACE.moved(SPACE.vertices * (1.0 + time)), film(1e-5, 0.03), EDGES)

    with pytest.raises(FilmInputError, match="have moved"):
        list(march(FilmSolver(SPACE), at, 1e-3, 1e-3))
