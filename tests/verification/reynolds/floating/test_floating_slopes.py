"""Floating films: exact slopes.

A journal that floats on its film, with and without a cavity, under pressure-dependent oil, on rough walls that
touch: what Newton's method and the periodic motion take for slopes, against differences of the films themselves.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import pytest
from floating_journal import CLEARANCE, OIL, RADIUS, STEP, SUMMITS, Journal, floating_journal, marched
from scipy.sparse import csr_array

from reynolds import (
    Array,
    Cell,
    FilmSolver,
    FilmSpace,
    Floating,
    FloatingStage,
    Surface,
    film_space,
    generalised_force,
    modes_on,
    rectangle,
    solve_stage,
)
from reynolds.equation.rough_overlap import film_between
from reynolds.floating.coordinates import contact_force
from reynolds.floating.sensitivity import oil_slopes, response, thickness_load
from reynolds.laws.roughness import mean_thickness

STEPS = 12
NUDGE = 1e-6  # of the clearance: films of more or less cavitated unknowns would be another film
HEIGHTS = Surface(4e-7, 3e-7, 3.0, 1.0 / 3.0, 0.3)
HIGH = (5e6, 5e6)  # Pa at the sides: the film does not cavitate


@dataclass(frozen=True)
class Springs:
    """Walls of which each place opens by the pressure above it."""

    matrix: csr_array


def springs(space: FilmSpace, softness: float) -> Springs:
    """Walls that open by `softness` (m/Pa) times the pressure above."""
    count = len(space.vertices)
    places = (np.arange(count), space.vertex_dofs)
    return Springs(csr_array((np.full(count, softness), places), shape=(count, space.size)))


CASES = {
    "full": Journal(2e2, HIGH),
    "cavity": Journal(3e3),
    "triangles": Journal(3e3, cell=Cell.TRIANGLE),
    "inertia": Journal(3e3, inertia=np.eye(2)),
    "oil": Journal(9e3, fluid=OIL),
    "soft walls": Journal(2e2, HIGH, walls=partial(springs, softness=2e-12)),
    "contact": Journal(3e5, asperities=SUMMITS),
    "soft contact": Journal(2e4, HIGH, asperities=SUMMITS, walls=partial(springs, softness=2e-13)),
    "soft rough": Journal(2e4, HIGH, OIL, HEIGHTS, SUMMITS, walls=partial(springs, softness=2e-13)),
    "rough": Journal(6e5, surface=HEIGHTS, asperities=SUMMITS),
}


def _marched(case: Journal) -> tuple[Floating, FilmSolver, FloatingStage, Array]:
    """After some steps from rest: the last stage and what was held before it."""
    space, floating = floating_journal(case)
    solver, stage, before = marched(space, floating, np.array([0.5 * CLEARANCE, 0.0]), STEPS)
    assert stage.solution.cavity.any() == (case.sides != HIGH)
    assert (np.abs(stage.contact_force).max() > 1.0) == (case.asperities is not None)
    return floating, solver, stage, before


def _differences(of: Callable[[Array], Array], count: int, size: float) -> Array:
    """Central differences by each of `count` arguments around zero, as columns."""
    nudges = size * np.eye(count)
    return np.column_stack([(of(nudge) - of(-nudge)) / (2.0 * size) for nudge in nudges])


def _apart(obtained: Array, expected: Array) -> float:
    """Largest difference, of the largest entry."""
    return float(np.abs(obtained - expected).max() / np.abs(expected).max())


@pytest.mark.parametrize("name", CASES)
def test_forces_by_position(name):
    """dQ/dq, what held before as it is. Differences lose 1e-12 of the pressures over the nudge: 1e-6."""
    _, _, stage, _ = _marched(CASES[name])
    slopes = stage.force_slopes

    def missing(nudge: Array) -> Array:
        return stage.instant.tried(stage.q + nudge, stage.solution).missing

    assert _apart(slopes, _differences(missing, 2, NUDGE * CLEARANCE)) <= (1e-6 if CASES[name].fluid is None else 3e-6)


@pytest.mark.parametrize("name", ["full", "contact"])
def test_forces_follow_a_shift_of_one_coordinate(name):
    """A stage that its film is not solved for anew: forces along its slopes, to the square of the shift."""
    _, _, stage, _ = _marched(CASES[name])
    shift = np.array([1e-4 * CLEARANCE, 0.0])
    here = replace(stage, trial=stage.instant.tried(stage.q, stage.solution), shift=np.zeros(2), known=None)
    shifted, there = replace(here, shift=shift), stage.instant.tried(stage.q + shift, stage.solution)
    moved = there.film_force - here.film_force
    assert np.abs(moved).max() > 1e-6 * np.abs(here.film_force).max()
    assert _apart(shifted.film_force - here.film_force, moved) <= 1e-2


def test_soft_walls_of_a_cavity():
    """Left out there: that a cavity's upwinding changes as the pressure beside it opens the film."""
    _, _, stage, _ = _marched(replace(CASES["cavity"], walls=partial(springs, softness=2e-12)))

    def missing(nudge: Array) -> Array:
        return stage.instant.tried(stage.q + nudge, stage.solution).missing

    expected = _differences(missing, 2, NUDGE * CLEARANCE)
    assert 1e-6 < _apart(stage.force_slopes, expected) <= 1e-3


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
        assert _apart(q[:, column], expected[:2, column]) <= 1e-4
        assert _apart(holds[:size, column], expected[2 : 2 + size, column]) <= 1e-4
        assert _apart(holds[size:, column], expected[2 + size :, column]) <= 1e-4


def _thickened(solver, stage):
    return -thickness_load(stage.solution, stage.trial.thicker, solver.operators(stage.solution))


def test_a_factor_that_is_not_the_last():
    """Slopes of a film after another one has been solved are those of before."""
    _, solver, stage, _ = _marched(CASES["cavity"])
    first = response(solver, stage.solution, _thickened(solver, stage))
    stage.instant.tried(0.9 * stage.q, None)
    again = response(solver, stage.solution, _thickened(solver, stage))
    assert _apart(first.pressure, again.pressure) <= 1e-9
    assert _apart(first.film_fraction, again.film_fraction) <= 1e-9


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
    space, _ = floating_journal(CASES["contact"])
    angle = space.vertices[:, 0] / RADIUS
    modes = modes_on(space, np.column_stack([np.ones_like(angle), np.cos(angle)]))

    gap = np.full(space.area.shape, 2e-7)

    def force(nudge: Array) -> Array:
        return contact_force(SUMMITS, gap + modes.at_points @ nudge, modes).force

    assert _apart(contact_force(SUMMITS, gap, modes).slopes, _differences(force, 2, 1e-12)) <= 1e-6


@pytest.mark.parametrize("surface", [None, Surface(4e-7, 3e-7), Surface(4e-7, 0.0, 3.0)])
def test_film_between_overlapping_walls(surface):
    """Positive, rising with the gap, with its slope; the gap itself where walls are far apart or do not touch."""
    _, floating = floating_journal(replace(CASES["contact"], surface=surface))
    problem = floating.shape_at(0.0)
    gap = np.linspace(-2e-6, 4e-6, 601)
    h, slope = film_between(problem, gap)
    assert h.min() > 0.0
    beyond = (film_between(problem, gap + 1e-12).value - film_between(problem, gap - 1e-12).value) / 2e-12
    assert slope == pytest.approx(beyond, rel=1e-5, abs=1e-6)
    assert slope.min() > 0.0
    assert h[-1] == pytest.approx(gap[-1], rel=1e-12)
    if surface is None:
        assert h == pytest.approx(mean_thickness(SUMMITS.height, gap).value)
    else:
        within = gap >= surface.lowest_ratio * surface.composite_roughness
        assert np.array_equal(h[within], gap[within])
    smooth = film_between(replace(problem, asperities=None), gap)
    assert np.array_equal(smooth.value, gap)
