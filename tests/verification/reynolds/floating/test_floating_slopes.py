"""Floating films: exact slopes.

A journal that floats on its film, with and without a cavity, under pressure-dependent oil, on rough walls that
touch: what Newton's method and the periodic motion take for slopes, against differences of the films themselves.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.sparse import csr_array

from reynolds import (
    ZERO,
    Array,
    Asperities,
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
    generalised_force,
    modes_on,
    rectangle,
    solve_stage,
)
from reynolds.equation.rough_overlap import film_between
from reynolds.floating.coordinates import contact_force
from reynolds.floating.sensitivity import oil_slopes, response, thickness_load
from reynolds.laws.roughness import mean_thickness

RADIUS, WIDTH, CLEARANCE, SPEED, VISCOSITY = 0.02, 0.02, 20e-6, 5.0, 0.03
STEP, STEPS = 2e-4, 12
NUDGE = 1e-6  # of the clearance: films of more or less cavitated unknowns would be another film
ROUGH = Asperities(density=1e10, radius=1e-5, height=4e-7, modulus=8e10, friction_coefficient=0.1)
ALPHA, BULK = 2e-8, 2e9
OIL = Fluid(
    viscosity=lambda p, mu: (mu * np.exp(ALPHA * p), ALPHA * mu * np.exp(ALPHA * p)),
    density=lambda p: (1.0 + p / BULK, np.full_like(p, 1.0 / BULK)),
)


@dataclass(frozen=True)
class Case:
    """A journal film: load N, pressure at both sides Pa, what its oil and walls are; whether it cavitates."""

    load: float
    sides: float = 0.0
    fluid: Fluid | None = None
    surface: Surface | None = None
    asperities: Asperities | None = None
    inertia: Array | None = None
    softness: float = 0.0  # opening of the walls by the pressure above them, m/Pa
    cell: Cell = Cell.QUADRILATERAL
    cavitates: bool = True


CASES = {
    "full": Case(2e2, 5e6, cavitates=False),
    "cavity": Case(3e3),
    "triangles": Case(3e3, cell=Cell.TRIANGLE),
    "inertia": Case(3e3, inertia=np.eye(2)),
    "oil": Case(9e3, fluid=OIL),
    "soft walls": Case(2e2, 5e6, softness=2e-12, cavitates=False),
    "contact": Case(3e5, asperities=ROUGH),
    "soft contact": Case(2e4, 5e6, softness=2e-13, asperities=ROUGH, cavitates=False),
    "soft rough": Case(
        2e4,
        5e6,
        softness=2e-13,
        surface=Surface(4e-7, 3e-7, 3.0, 1.0 / 3.0, 0.3),
        asperities=ROUGH,
        fluid=OIL,
        cavitates=False,
    ),
    "rough": Case(6e5, surface=Surface(4e-7, 3e-7, 3.0, 1.0 / 3.0, 0.3), asperities=ROUGH),
}


@dataclass(frozen=True)
class Springs:
    """Walls of which each place gives way to the pressure above it."""

    matrix: csr_array


def _own_pressure(space: FilmSpace) -> csr_array:
    count = len(space.vertices)
    places = (np.arange(count), space.vertex_dofs)
    return csr_array((np.ones(count), places), shape=(count, space.size))


def _journal(case: Case) -> tuple[FilmSpace, Floating]:
    """h = c - ex cos - ey sin, pressed by a load that turns to and fro, a spring and a damper."""
    space = film_space(rectangle((2.0 * np.pi * RADIUS, WIDTH), (32, 6), cell=case.cell, periodic_x=True))
    oil = Film(
        np.full((1, 1), CLEARANCE), np.full((1, 1), VISCOSITY), (np.full((1, 1), SPEED), ZERO), (ZERO, ZERO), ZERO,
        thickness_at_vertices=np.full(len(space.vertices), CLEARANCE),
    )  # fmt: skip
    held = {"bottom": Held(case.sides), "top": Held(case.sides)}
    problem = FilmProblem(space, oil, held, surface=case.surface, asperities=case.asperities)
    problem = problem if case.fluid is None else replace(problem, fluid=case.fluid)
    if case.softness:
        problem = replace(problem, walls=Springs(_own_pressure(space) * case.softness))
    angle = space.vertices[:, 0] / RADIUS
    modes = -np.column_stack([np.cos(angle), np.sin(angle)])
    spring, damper = np.array([[1e6, 2e5], [0.0, 1e6]]), np.array([[1e4, 0.0], [3e3, 1e4]])

    def outer(time: float, q: Array, rate: Array) -> Outer:
        load = case.load * np.array([1.0, 0.3 * np.sin(300.0 * time)])
        return Outer(load - spring @ q - damper @ rate, -spring, -damper)

    return space, Floating("journal", lambda t: problem, lambda t: modes, outer, case.sides, inertia=case.inertia)


def _marched(case: Case) -> tuple[Floating, FilmSolver, FloatingStage, Array]:
    """After some steps from rest: the last stage and what was held before it."""
    space, floating = _journal(case)
    solver, stage, q = FilmSolver(space), None, np.array([0.5 * CLEARANCE, 0.0])
    held, rate = full_film(floating, 0.0, q), np.zeros(2)
    for k in range(STEPS):
        before = held
        stage = solve_stage(solver, floating, STEP * (k + 1), before, STEP, q + STEP * rate, stage)
        held, q, rate = stage.holds, stage.q, stage.trial.rate
    assert stage is not None
    assert stage.solution.cavity.any() == case.cavitates
    assert (np.abs(stage.contact_force).max() > 1.0) == (case.asperities is not None)
    return floating, solver, stage, before


def _differences(of: Callable[[Array], Array], count: int, size: float) -> Array:
    """Central differences by each of `count` arguments around zero, as columns."""
    nudges = size * np.eye(count)
    return np.column_stack([(of(nudge) - of(-nudge)) / (2.0 * size) for nudge in nudges])


def _same(obtained: Array, expected: Array, share: float) -> None:
    """Within a share of the largest entry of each row's kind."""
    assert np.abs(obtained - expected).max() <= share * np.abs(expected).max()


@pytest.mark.parametrize("name", CASES)
def test_forces_by_position(name):
    """dQ/dq, what held before as it is. Differences lose 1e-12 of the pressures over the nudge: 1e-6."""
    _, _, stage, _ = _marched(CASES[name])
    slopes = stage.force_slopes

    def missing(nudge: Array) -> Array:
        return stage.instant.tried(stage.q + nudge, stage.solution).missing

    _same(slopes, _differences(missing, 2, NUDGE * CLEARANCE), 1e-6 if CASES[name].fluid is None else 3e-6)


def test_soft_walls_of_a_cavity():
    """Left out there: that a cavity's upwinding changes as the pressure beside it opens the film."""
    _, _, stage, _ = _marched(replace(CASES["cavity"], softness=2e-12))

    def missing(nudge: Array) -> Array:
        return stage.instant.tried(stage.q + nudge, stage.solution).missing

    expected = _differences(missing, 2, NUDGE * CLEARANCE)
    _same(stage.force_slopes, expected, 1e-3)
    with pytest.raises(AssertionError):
        _same(stage.force_slopes, expected, 1e-6)


@pytest.mark.parametrize("name", CASES)
def test_stage_by_what_was_held(name):
    """The monodromy of a step: position and oil at its end by both before it; the balance is kept to 1e-8."""
    floating, solver, stage, before = _marched(CASES[name])
    size = len(stage.solution.pressure)
    rng = np.random.default_rng(1)
    changes = np.zeros((len(before), 2))
    changes[:size, 0] = before[:size] * rng.uniform(-1.0, 1.0, size)
    changes[size:, 1] = CLEARANCE
    q, holds = stage.propagated(changes)

    def end(nudge: Array) -> Array:
        other = solve_stage(solver, floating, stage.time, before + changes @ nudge, STEP, stage.q, stage)
        return np.concatenate([other.q, other.holds])

    expected = _differences(end, 2, 1e-5)
    for column in range(2):
        _same(q[:, column], expected[:2, column], 1e-4)
        _same(holds[:size, column], expected[2 : 2 + size, column], 1e-4)
        _same(holds[size:, column], expected[2 + size :, column], 1e-4)


def _thickened(solver, stage):
    return -thickness_load(stage.solution, stage.trial.thicker, solver.operators(stage.solution))


def test_a_factor_that_is_not_the_last():
    """Slopes of a film after another one has been solved are those of before."""
    _, solver, stage, _ = _marched(CASES["cavity"])
    first = response(solver, stage.solution, _thickened(solver, stage))
    stage.instant.tried(0.9 * stage.q, None)
    again = response(solver, stage.solution, _thickened(solver, stage))
    _same(first.pressure, again.pressure, 1e-9)
    _same(first.film_fraction, again.film_fraction, 1e-9)


def test_what_flows_in_is_stored_or_leaves():
    """An inflow everywhere: what held nodes let out and what the unknowns then hold more is all of it."""
    _, solver, stage, _ = _marched(CASES["oil"])
    solution, storage = stage.solution, stage.solution.problem.storage
    assert storage is not None
    free = ~solution.held
    inflow = np.where(free, 1e-9, 0.0)[:, None]
    changed = response(solver, solution, inflow)
    still = np.zeros((*solution.problem.space.area.shape, 1))
    stored = oil_slopes(solution, still, changed, solver.operators(solution))[:, 0].sum() / storage.step
    more = replace(solution.problem, storage=replace(storage, held_before=storage.held_before + 1e-4 * inflow[:, 0]))
    less = replace(solution.problem, storage=replace(storage, held_before=storage.held_before - 1e-4 * inflow[:, 0]))
    out = [float(solver.solve(p, solution).outflow[solution.held].sum()) for p in (more, less)]
    leaves = (out[0] - out[1]) / 2e-4 * storage.step
    assert stored + leaves == pytest.approx(inflow.sum(), rel=1e-5)


def test_generalised_force_is_work():
    """Of a uniform pressure on lift and tilts of a rectangle: its area, and nothing about the middle."""
    space = film_space(rectangle((0.02, 0.01), (5, 4), origin=(-0.01, -0.005)))
    x, y = space.vertices.T
    modes = modes_on(space, np.column_stack([np.ones_like(x), x / 0.01, y / 0.01]))
    force = generalised_force(np.full(space.size, 3e6), modes, 1e6)
    assert force == pytest.approx([2e6 * 2e-4, 0.0, 0.0], abs=1e-9)
    linear = np.zeros(space.size)
    linear[space.vertex_dofs] = 1e6 + 1e8 * x
    moment = 1e8 * 0.02**3 * 0.01 / 12.0 / 0.01
    assert generalised_force(linear, modes, 1e6)[1] == pytest.approx(moment, rel=0.05)


def test_contact_slopes():
    space, _ = _journal(CASES["contact"])
    angle = space.vertices[:, 0] / RADIUS
    modes = modes_on(space, np.column_stack([np.ones_like(angle), np.cos(angle)]))

    gap = np.full(space.area.shape, 2e-7)

    def force(nudge: Array) -> Array:
        return contact_force(ROUGH, gap + modes.at_points @ nudge, modes).force

    _same(contact_force(ROUGH, gap, modes).slopes, _differences(force, 2, 1e-12), 1e-6)


@pytest.mark.parametrize("surface", [None, Surface(4e-7, 3e-7), Surface(4e-7, 0.0, 3.0)])
def test_film_between_overlapping_walls(surface):
    """Positive, rising with the gap, with its slope; the gap itself where walls are far apart or do not touch."""
    _, floating = _journal(replace(CASES["contact"], surface=surface))
    problem = floating.shape_at(0.0)
    gap = np.linspace(-2e-6, 4e-6, 601)
    h, slope = film_between(problem, gap)
    assert h.min() > 0.0
    beyond = (film_between(problem, gap + 1e-12).value - film_between(problem, gap - 1e-12).value) / 2e-12
    assert slope == pytest.approx(beyond, rel=1e-5, abs=1e-6)
    assert slope.min() > 0.0
    assert h[-1] == pytest.approx(gap[-1], rel=1e-12)
    if surface is None:
        assert h == pytest.approx(mean_thickness(ROUGH.height, gap).value)
    else:
        within = gap >= surface.lowest_ratio * surface.composite_roughness
        assert np.array_equal(h[within], gap[within])
    smooth = film_between(replace(problem, asperities=None), gap)
    assert np.array_equal(smooth.value, gap)
