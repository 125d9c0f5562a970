"""Floating films: elastic walls and contact.

Plates that float over springs side by side (Winkler 1867) have closed forms at rest; over a closed turn springs
give back what they took.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from gaps import Accuracy, evenly, run_revolution
from reynolds import (
    ZERO,
    Array,
    Asperities,
    Cell,
    Compliance,
    Elastic,
    Film,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    Floating,
    FloatingStage,
    Held,
    Surface,
    contact_pressure,
    film_space,
    full_film,
    half_space,
    rectangle,
    solve_stage,
    steady,
    winkler,
)
from reynolds.bodies.compliance import ElasticWalls
from reynolds.equation.rough_overlap import as_shaped, vertex_thickness
from reynolds.errors import FilmInputError
from reynolds.floating.step import InitialFilm

LENGTH, WIDE, VISCOSITY, STIFFNESS = 10e-3, 2.5e-3, 0.03, 1e13
HIGH, LOW = 30e6, 5e6
ROUGH = Asperities(density=3.2e9, radius=2.5e-5, height=5e-7, modulus=8e10, friction_coefficient=0.1)


def channel(cells: int = 16) -> FilmSpace:
    """A strip of the infinitely wide film, its sides sewn together."""
    return film_space(rectangle((LENGTH, WIDE), (cells, 2), cell=Cell.QUADRILATERAL, periodic_y=True))


def plate(
    space: FilmSpace, walls: ElasticWalls, ends: tuple[float, float], load: Callable[[float], float],
    asperities: Asperities | None = None, surface: Surface | None = None,
) -> Floating:  # fmt: skip
    """A plane plate that one coordinate lifts, pressed by a load (N) in time (s)."""
    flat = np.zeros((1, 1))
    oil = Film(
        np.zeros(space.area.shape), np.full((1, 1), VISCOSITY), (flat, flat), (ZERO, ZERO), ZERO,
        thickness_at_vertices=np.zeros(len(space.vertices)),
    )  # fmt: skip
    held = {"left": Held(ends[0]), "right": Held(ends[1])}
    film = FilmProblem(space, oil, held, surface=surface, asperities=asperities, walls=walls)
    lift = np.ones((len(space.vertices), 1))
    return Floating("plate", lambda t: film, lambda t: lift, lambda t, q, rate: steady(np.array([-load(t)])))


def at_rest(floating: Floating, space: FilmSpace, start: float, step: float = 1.0, steps: int = 3) -> FloatingStage:
    """The plate after steps that leave no squeeze."""
    solver, stage, q = FilmSolver(space), None, np.array([start])
    held = full_film(floating, 0.0, q)
    for k in range(steps):
        stage = solve_stage(solver, floating, step * (k + 1), held, step, q, stage)
        held, q = stage.holds, stage.q
    assert stage is not None
    return stage


def test_an_initial_film_under_pressure_holds_the_oil_of_its_open_walls():
    """On springs k, V = theta (h0 + p/k) A: half filled, under the pressure of the initial film."""
    space = channel(8)
    floating = plate(space, winkler(space, STIFFNESS), (HIGH, LOW), lambda t: 0.0)
    inner = np.ones(space.size, dtype=bool)
    inner[[*space.edge_dofs["left"], *space.edge_dofs["right"]]] = False
    initial = InitialFilm(np.where(inner, 8e6, 0.0), np.where(inner, 0.5, 1.0))
    oil = full_film(floating, 0.0, np.array([3e-6]), initial=initial)[: space.size]
    area = space.lumped(np.ones((1, 1)))
    along = np.array([space.place(unknown)[0] for unknown in range(space.size)])
    far = np.abs(along - 0.5 * LENGTH) < 0.3 * LENGTH  # of no edge's cells
    assert far.sum() > 4
    assert oil[far] == pytest.approx(0.5 * (3e-6 + 8e6 / STIFFNESS) * area[far], rel=1e-12, abs=0.0)
    with pytest.raises(FilmInputError, match="pressure"):
        full_film(floating, 0.0, np.array([3e-6]), initial=InitialFilm(np.zeros(3), np.ones(space.size)))


@pytest.mark.parametrize("dense", [False, True])
def test_plate_floats_on_springs(dense, validation, refine):
    """(h0 + p/k)^4 is linear along the channel: mean p = k [4/5 (a^5 - b^5)/(a^4 - b^4) - h0] = W/A."""

    def mean(h0: float) -> float:
        a, b = h0 + HIGH / STIFFNESS, h0 + LOW / STIFFNESS
        return STIFFNESS * (0.8 * (a**5 - b**5) / (a**4 - b**4) - h0)

    exact = 1e6 * brentq(lambda h0: mean(h0) - 19e6, 0.2e-6, 50e-6, xtol=1e-18)

    def solve(n: int) -> float:
        space = channel(n)
        walls = winkler(space, STIFFNESS)
        walls = Compliance(walls.matrix.toarray()) if dense else walls
        floating = plate(space, walls, (HIGH, LOW), lambda t: 19e6 * LENGTH * WIDE)
        return 1e6 * float(at_rest(floating, space, 3e-6).q[0])

    found = refine(solve, (8, 16, 32), 2.0)
    validation(
        case="Plate that floats on Winkler's foundation",
        source="closed form, integrated in time",
        quantity=f"film without pressure at rest, {'dense' if dense else 'sparse'} walls",
        unit="um",
        expected=exact,
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


@pytest.mark.parametrize("surface", [None, Surface(3e-7, 4e-7)])
def test_rough_plate_rests_on_springs(surface, validation):
    """Without pressure contact bears all, and presses the springs: W/A = p_c(h0 + p_c/k), on any mesh."""
    pressed = 20e6
    gap = brentq(lambda h: float(contact_pressure(ROUGH, h).value) - pressed, -1e-6, 2e-6, xtol=1e-18)
    space = channel(6)
    floating = plate(space, winkler(space, STIFFNESS), (0.0, 0.0), lambda t: pressed * LENGTH * WIDE, ROUGH, surface)
    stage = at_rest(floating, space, 1e-6, step=1e5)
    validation(
        case="Rough plate at rest on Winkler's foundation",
        source="Greenwood and Tripp 1970-71 in series with a spring",
        quantity=f"gap between the undeformed planes at 20 MPa, {'smooth' if surface is None else 'rough'} flow",
        unit="um",
        expected=1e6 * (gap - pressed / STIFFNESS),
        obtained=1e6 * float(stage.q[0]),
        relative_tolerance=1e-6,
        note="the rest of the film's pressure",
    )
    assert stage.gap == pytest.approx(gap, rel=1e-6)
    assert stage.contact_force[0] == pytest.approx(pressed * LENGTH * WIDE, rel=1e-6)
    assert stage.solution.problem.walls is None
    assert stage.solution.film.thickness.min() > 0.0


def test_a_stage_tells_how_its_walls_deform():
    """Independent springs deform by p/k, which its film of that shape between rigid walls already has."""
    space = channel(16)
    stage = at_rest(plate(space, winkler(space, STIFFNESS), (HIGH, LOW), lambda t: 19e6 * LENGTH * WIDE), space, 3e-6)
    gives = stage.solution.pressure[space.vertex_dofs] / STIFFNESS
    assert stage.deformation == pytest.approx(gives, rel=1e-6)
    assert vertex_thickness(stage.solution) == pytest.approx(stage.q[0] + gives, rel=1e-6)
    assert not stage.solution.deformation.any()


def turned(load: float, asperities: Asperities | None) -> tuple[FilmSpace, list[FloatingStage]]:
    """The stages of a closed turn of a plate under a mean pressure that comes and goes, at even steps."""
    space, speed = channel(8), 2.0 * np.pi / 0.05

    def pressed(time: float) -> float:
        return load * LENGTH * WIDE * (1.0 + 0.05 * np.cos(speed * time))

    surface = None if asperities is None else Surface(3e-7, 4e-7)
    floating = plate(space, winkler(space, STIFFNESS), (HIGH, LOW), pressed, asperities, surface)
    found = run_revolution(
        FilmSolver(space), floating, evenly(speed, 24, keep=1), np.array([4e-6]), lambda stage: (stage,),
        accuracy=Accuracy(step=1.0, floor=1.0, balance=1e-12, closed=1e-7),
    )  # fmt: skip
    assert found.closing.changes[-1] < 1e-7 * 5e-6
    stages = [instant.report[0] for instant in found.turn.instants]
    return space, [stages[-1], *stages]


@pytest.mark.parametrize(
    ("load", "asperities"),
    [(19e6, None), pytest.param(19e6, replace(ROUGH, summit_height=7e-6), marks=pytest.mark.long)],
)
def test_springs_give_back_what_they_took(load, asperities):
    """Over a closed turn the work of all pressure on the walls' deformation vanishes, contact's included.

    Sums of the mean of two pressures times the change of the deformation telescope where the walls are symmetric.
    """
    space, stages = turned(load, asperities)
    assert (max(stage.contact_force[0] for stage in stages) > 1.0) == (asperities is not None)
    weight = stages[0].instant.modes.film_weights[:, 0]
    opened = np.zeros((len(stages), space.size))
    opened[:, space.vertex_dofs] = [stage.trial.solution.deformation for stage in stages]
    pressure = STIFFNESS * opened  # of oil and contact together, by the springs' own law
    assert pressure @ weight == pytest.approx([-stage.outer.force[0] for stage in stages], rel=1e-4)
    taken = 0.5 * (pressure[1:] + pressure[:-1]) * np.diff(opened, axis=0) @ weight
    assert abs(taken.sum()) < 1e-5 * np.abs(taken).sum()


def test_what_is_seen_of_a_soft_film_is_its_shape():
    """A film between elastic walls and one between rigid walls of that shape have the same flows."""
    space = channel()
    floating = plate(space, winkler(space, STIFFNESS), (HIGH, LOW), lambda t: 19e6 * LENGTH * WIDE)
    stage = at_rest(floating, space, 3e-6)
    shaped = as_shaped(stage.trial.solution)
    again = FilmSolver(space).solve(replace(shaped.problem, storage=stage.trial.solution.problem.storage))
    assert again.pressure == pytest.approx(stage.trial.solution.pressure, rel=1e-9)
    assert again.outflow == pytest.approx(stage.trial.solution.outflow, rel=1e-9, abs=1e-18)


def test_half_space_under_a_floating_plate(tmp_path):
    """Slopes by differences between dense walls of a half-space whose rough faces touch."""
    space = film_space(rectangle((LENGTH, LENGTH), (6, 6), cell=Cell.QUADRILATERAL))
    walls = half_space(space, Elastic(110e9, 0.34))
    floating = plate(space, walls, (2e6, 2e6), lambda t: 1e3, ROUGH, Surface(3e-7, 4e-7))
    stage = at_rest(floating, space, 1e-6, step=1e-4, steps=4)
    assert stage.contact_force[0] > 10.0

    def missing(nudge: float) -> Array:
        return stage.instant.tried(stage.q + nudge, stage.trial.solution).missing

    slope = (missing(1e-12) - missing(-1e-12)) / 2e-12
    assert stage.force_slopes[0] == pytest.approx(slope, rel=1e-5)
