"""Floating films at rest: positions of balance under a constant drive."""

from __future__ import annotations

from functools import partial

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
    Floating,
    Held,
    film,
    film_space,
    rectangle,
    solve_stage,
    started,
    steady,
)
from reynolds.floating.rest import come_to_rest

LENGTH, WIDTH, TAPER, SPEED, VISCOSITY = 0.01, 0.002, 1e-5, 2.0, 0.03


def _slider(space: FilmSpace, load: float) -> Floating:
    """A wide wedge h = q + TAPER (1 - x/L) under a load, its fixed wall below a wall that slides at SPEED."""
    x, _ = space.points
    shape = FilmProblem(
        space,
        Film(
            thickness=TAPER * (1.0 - x / LENGTH),
            viscosity=np.full((1, 1), VISCOSITY),
            velocity_moving=(np.full((1, 1), SPEED), ZERO),
            velocity_fixed=(ZERO, ZERO),
            squeeze=ZERO,
        ),
        {"left": Held(0.0), "right": Held(0.0)},
        Cavitation.NONE,
    )
    return Floating(
        "slider",
        lambda t: shape,
        lambda t: np.ones((len(space.vertices), 1)),
        lambda t, q, rate: steady(np.array([-load])),
    )


def _strip(cells: int) -> FilmSpace:
    return film_space(rectangle((LENGTH, WIDTH), (cells, 1), cell=Cell.QUADRILATERAL, periodic_y=True))


def _rayleigh(ratio: float) -> float:
    """Load (N) of the wide wedge at h1/h0 = ratio, with h1 - h0 = TAPER (Rayleigh 1918)."""
    number = 6.0 / (ratio - 1.0) ** 2 * (np.log(ratio) - 2.0 * (ratio - 1.0) / (ratio + 1.0))
    return number * VISCOSITY * SPEED * LENGTH**2 * WIDTH * ((ratio - 1.0) / TAPER) ** 2


@pytest.mark.parametrize(("ratio", "start"), [(2.0, 3e-5), (2.0, 2e-6), (1.2, 1e-5), (8.0, 1e-4)])
def test_slider_finds_its_film(ratio, start, validation, refine):
    """From far above and below, to the film that carries the load."""

    def rest(cells: int) -> float:
        space = _strip(cells)
        floating = _slider(space, _rayleigh(ratio))
        solve = partial(solve_stage, FilmSolver(space), floating)
        return float(come_to_rest(solve, started(floating, 0.0, np.array([start])), 1e-4, 1e-10).state.q[0])

    found = refine(rest, (20, 40, 80))
    validation(
        case="Wide wedge floating under its load",
        source="Rayleigh 1918, closed form",
        quantity=f"outlet film, h1/h0 = {ratio:g}, from {start * 1e6:g} um",
        unit="m",
        expected=TAPER / (ratio - 1.0),
        obtained=found.finest,
        tolerance=found.tolerance(1e-10),
        order=found.order,
    )


def test_sinks_without_end():
    """A plate that nothing bears: the steps outlast any time, and the film is gone."""
    space = _strip(8)
    flat = FilmProblem(space, film(1e-5, VISCOSITY), {"left": Held(0.0), "right": Held(0.0)}, Cavitation.NONE)
    floating = Floating(
        "plate",
        lambda t: flat,
        lambda t: np.ones((len(space.vertices), 1)),
        lambda t, q, rate: steady(np.array([-100.0])),
    )
    solve = partial(solve_stage, FilmSolver(space), floating)
    with pytest.raises(FilmNotConverged, match="no rest"):
        come_to_rest(solve, started(floating, 0.0, np.zeros(1)), 1e-4, 1e-12)


def test_refused():
    space = _strip(8)
    floating = _slider(space, 1.0)
    start = started(floating, 0.0, np.array([1e-5]))
    with pytest.raises(FilmInputError, match="rest: a step of 0 s"):
        come_to_rest(partial(solve_stage, FilmSolver(space), floating), start, 0.0, 1e-9)
