"""A journal that floats on its film: h = c - ex cos - ey sin, pressed by a turning load, a spring and a damper."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from reynolds import (
    ZERO,
    Array,
    Asperities,
    Cavitation,
    Cell,
    Film,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    Floating,
    FloatingStage,
    Fluid,
    Held,
    Outer,
    Surface,
    film_space,
    full_film,
    rectangle,
    solve_stage,
)
from reynolds.laws.fluid import CONSTANT

RADIUS, WIDTH, CLEARANCE, SPEED, VISCOSITY = 0.02, 0.02, 20e-6, 5.0, 0.03
STEP = 2e-4
SUMMITS = Asperities(density=1e10, radius=1e-5, height=4e-7, modulus=8e10, friction_coefficient=0.1)
ALPHA, BULK = 2e-8, 2e9
OIL = Fluid(
    viscosity=lambda p, mu: (mu * np.exp(ALPHA * p), ALPHA * mu * np.exp(ALPHA * p)),
    density=lambda p: (1.0 + p / BULK, np.full_like(p, 1.0 / BULK)),
)


@dataclass(frozen=True)
class Journal:
    """A journal film: load N, pressure at both sides Pa, its oil and walls, cavitation and cells.

    walls: the elastic walls on a space, None for rigid ones.
    """

    load: float
    sides: tuple[float, float] = (0.0, 0.0)
    fluid: Fluid = CONSTANT
    surface: Surface | None = None
    asperities: Asperities | None = None
    inertia: Array | None = None
    walls: Callable[[FilmSpace], Any] | None = None
    cell: Cell = Cell.QUADRILATERAL
    cavitation: Cavitation = Cavitation.JFO


def floating_journal(case: Journal) -> tuple[FilmSpace, Floating]:
    """Return the space of the film, and the journal that floats on it."""
    space = film_space(rectangle((2.0 * np.pi * RADIUS, WIDTH), (32, 6), cell=case.cell, periodic_x=True))
    oil = Film(
        np.full((1, 1), CLEARANCE), np.full((1, 1), VISCOSITY), (np.full((1, 1), SPEED), ZERO), (ZERO, ZERO), ZERO,
        thickness_at_vertices=np.full(len(space.vertices), CLEARANCE),
    )  # fmt: skip
    held = {"bottom": Held(case.sides[0]), "top": Held(case.sides[1])}
    walls = None if case.walls is None else case.walls(space)
    problem = FilmProblem(
        space, oil, held, case.cavitation, fluid=case.fluid, surface=case.surface, asperities=case.asperities,
        walls=walls,
    )  # fmt: skip
    angle = space.vertices[:, 0] / RADIUS
    modes = -np.column_stack([np.cos(angle), np.sin(angle)])
    spring, damper = np.array([[1e6, 2e5], [0.0, 1e6]]), np.array([[1e4, 0.0], [3e3, 1e4]])

    def outer(time: float, q: Array, rate: Array) -> Outer:
        load = case.load * np.array([1.0, 0.3 * np.sin(300.0 * time)])
        return Outer(load - spring @ q - damper @ rate, -spring, -damper)

    return space, Floating("journal", lambda t: problem, lambda t: modes, outer, case.sides[0], inertia=case.inertia)


def marched(space: FilmSpace, floating: Floating, start: Array, steps: int) -> tuple[FilmSolver, FloatingStage, Array]:
    """Return solver and last stage after some steps from rest, and what was held before that stage."""
    solver, stage, q = FilmSolver(space), None, start
    held, rate = full_film(floating, 0.0, q), np.zeros(len(q))
    for k in range(steps):
        before = held
        stage = solve_stage(solver, floating, STEP * (k + 1), before, STEP, q + STEP * rate, stage)
        held, q, rate = stage.holds, stage.q, stage.trial.rate
    assert stage is not None
    return solver, stage, before
