"""Floating films: one Newton's method on film and position, in compiled loops, against films in balance.

The general solver is the reference: both give the same film, position, oil and slopes, for smooth and rough walls, with
and without cavity, contact, pocket, inertia and oil under pressure.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import pytest
from floating_journal import CLEARANCE, OIL, STEP, SUMMITS, VISCOSITY, Journal, floating_journal, marched

from reynolds import (
    ZERO,
    Array,
    Cavitation,
    Cell,
    Film,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    Floating,
    FloatingStage,
    Held,
    Outer,
    Pocket,
    Surface,
    film_space,
    held_at,
    rectangle,
    ring,
    steady,
)
from reynolds.compiled.film import compiled_film
from reynolds.compiled.gap_table import gap_table
from reynolds.compiled.gap_table_kernels import Motion, coefficients
from reynolds.equation.rough_overlap import film_at
from reynolds.floating.joint import JointStage
from reynolds.floating.step import films_in_balance
from reynolds.floating.trial import instant_of
from reynolds.laws.contact import LOWEST_RATIO, contact_pressure
from reynolds.laws.roughness import flow_factors

STEPS = 10
HEIGHTS = Surface(4e-7, 3e-7)
SIDES = (0.0, 1e5)


@dataclass(frozen=True)
class Springs:
    """Walls of which each place opens by the pressure above it, with a weak lift of all by their mean."""

    matrix: Array


def springs(space: FilmSpace, softness: float) -> Springs:
    """Walls that open by `softness` (m/Pa) times the pressure above, and a tenth of the mean pressure."""
    matrix = np.full((len(space.vertices), space.size), 0.1 / space.size)
    matrix[np.arange(len(matrix)), space.vertex_dofs] += 1.0
    return Springs(softness * matrix)


SOFT = partial(springs, softness=2e-13)
CASES = {
    "full": Journal(2e2, SIDES, cavitation=Cavitation.NONE),
    "cavity": Journal(3e3, SIDES),
    "triangles": Journal(3e3, SIDES, cell=Cell.TRIANGLE),
    "inertia": Journal(3e3, SIDES, inertia=np.eye(2)),
    "oil": Journal(9e3, SIDES, OIL),
    "contact": Journal(3e5, SIDES, asperities=SUMMITS),
    "rough": Journal(3e4, SIDES, surface=HEIGHTS),
    "soft": Journal(2e2, SIDES, walls=partial(springs, softness=2e-12), cavitation=Cavitation.NONE),
    "soft cavity": Journal(3e3, SIDES, walls=SOFT),
    "soft contact": Journal(4e4, SIDES, asperities=SUMMITS, walls=SOFT),
    "soft rough oil": Journal(4e4, SIDES, OIL, HEIGHTS, SUMMITS, walls=SOFT),
    "rough contact": Journal(6e5, SIDES, surface=HEIGHTS, asperities=SUMMITS),
}


def pad() -> tuple[FilmSpace, Floating]:
    """A hydrostatic pad: a pocket fed behind an orifice whose flow follows the root of the pressure drop."""
    space = film_space(ring(np.linspace(0.008, 0.016, 7), 24), pockets=("inner",))
    rise = space.vertices / 0.016
    modes = np.column_stack([np.ones(len(rise)), rise])

    def feed(pressure: float) -> tuple[float, float]:
        drop = 200e5 - pressure
        flow = 1e-8 * np.sign(drop) * np.sqrt(abs(drop) + 1e3)
        return float(flow), float(-0.5e-8 / np.sqrt(abs(drop) + 1e3))

    oil = Film(np.full((1, 1), 0.0), np.full((1, 1), VISCOSITY), (ZERO, ZERO), (np.full((1, 1), 5.0), ZERO), ZERO)
    problem = FilmProblem(space, oil, {"inner": Pocket(feed), "outer": Held(0.0)})

    def press(time: float, q: Array, rate: Array) -> Outer:
        return steady(-np.array([6e3 * (1.0 + 0.5 * np.sin(300.0 * time)), 10.0, -200.0]))

    return space, Floating(
        "pad", lambda t: problem, lambda t: modes, press, pockets={"inner": np.array([np.pi * 0.008**2, 0.0, 0.0])}
    )


def same(floating: Floating, stage: FloatingStage, before: Array) -> None:
    """The stage is that of films in balance, from the same state."""
    assert isinstance(stage, JointStage)
    instant = instant_of(FilmSolver(stage.instant.shape.space), floating, stage.time, STEP, before)
    other = films_in_balance(instant, stage.q, None)
    scale = np.abs(other.solution.pressure).max()
    np.testing.assert_allclose(stage.solution.pressure, other.solution.pressure, atol=1e-6 * scale)
    np.testing.assert_allclose(stage.solution.film_fraction, other.solution.film_fraction, atol=1e-6)
    np.testing.assert_allclose(stage.q, other.q, atol=1e-6 * np.abs(other.q).max())
    oil = stage.instant.shape.space.size
    np.testing.assert_allclose(stage.holds[:oil], other.holds[:oil], atol=1e-6 * other.holds[:oil].max())
    flow = other.solution.flow_scale.max()
    np.testing.assert_allclose(stage.solution.outflow, other.solution.outflow, atol=1e-6 * flow)
    # Upwinding's change with the deformation of elastic walls is left out of both slopes, not in the same way.
    close = 1e-5 if stage.instant.shape.walls is None else 1e-3
    np.testing.assert_allclose(stage.force_slopes, other.force_slopes, atol=close * np.abs(other.force_slopes).max())
    changes = np.random.default_rng(1).normal(size=(len(before), 2)) * np.abs(before).max()
    for mine, reference in zip(stage.propagated(changes), other.propagated(changes), strict=True):
        np.testing.assert_allclose(mine, reference, atol=close * np.abs(reference).max())


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_film_and_position_together(case):
    space, floating = floating_journal(case)
    _, stage, before = marched(space, floating, np.array([0.5 * CLEARANCE, 0.0]), STEPS)
    assert stage.solution.cavity.any() == (case.cavitation is Cavitation.JFO)
    assert (np.abs(stage.contact_force).max() > 1.0) == (case.asperities is not None)
    same(floating, stage, before)


def test_imbalance_of_a_pocket_is_its_residual_over_the_flows_that_meet_there():
    """Far from balance: |film's flow - feed| over the film's flows and the feed."""
    space, floating = pad()
    size = space.size
    shape = compiled_film(floating.shape_at(0.0), np.zeros(size), 1.0, np.zeros(size))
    pressure = np.where(shape.setting.held, 0.0, 5e6)
    gap = space.everywhere(np.full((1, 1), 20e-6))
    balance = shape.at(gap, pressure, np.ones(size), np.zeros(size, dtype=bool))
    ((node, pocket),) = shape.setting.pockets
    fed, net = pocket.feed(pressure[node])[0], balance.flow.net
    assert abs(fed) > 0.1 * abs(net[node] - fed)
    shares = np.abs(net) / balance.flow.scale
    shares[node] = abs(net[node] - fed) / (balance.flow.scale[node] + abs(fed))
    assert balance.imbalance == pytest.approx(shares[~shape.setting.held].max(), rel=1e-5)


def test_pad_with_a_pocket():
    space, floating = pad()
    _, stage, before = marched(space, floating, np.array([20e-6, 0.0, 0.0]), STEPS)
    assert stage.solution.held.any()
    assert not stage.solution.cavity.any()
    same(floating, stage, before)


def test_what_is_not_in_balance_is_not_lost():
    """The oil of a stage is what its flows leave, to round-off, however loosely the film is solved."""
    space, floating = floating_journal(CASES["cavity"])
    _, stage, before = marched(space, floating, np.array([0.5 * CLEARANCE, 0.0]), STEPS)
    free = ~stage.solution.held
    through = stage.solution.outflow[stage.solution.held].sum() * STEP
    grown = stage.holds[: space.size].sum() - before[: space.size].sum()
    held = (stage.solution.storage_rate * STEP)[~free].sum()
    assert grown == pytest.approx(held - through - held, rel=1e-9, abs=0.0)


@pytest.mark.parametrize("elastic", [False, True])
@pytest.mark.parametrize(("surface", "asperities"), [(HEIGHTS, SUMMITS), (HEIGHTS, None), (None, SUMMITS)])
def test_table_of_the_gap(surface, asperities, elastic):
    """Film, flow factors and contact of the table are those of the laws, at any gap."""
    lowest = 1e-9 if asperities is None else asperities.summit_height + 0.999 * LOWEST_RATIO * asperities.height
    gap = np.sort(np.concatenate([np.linspace(lowest, 4e-6, 999), np.geomspace(1e-7, 1e-3, 401)])).reshape(-1, 4)
    one, nothing = np.ones(gap.shape), np.zeros(gap.shape)
    table = gap_table(surface, asperities, elastic=elastic)
    c = coefficients(table, gap, one, Motion(one, nothing, nothing, one))
    film = film_at(surface, asperities, elastic, gap)
    np.testing.assert_allclose(c.film, film.value, rtol=1e-6, atol=1e-15)
    if surface is not None:
        factors, sigma = flow_factors(surface, film.value), surface.composite_roughness
        np.testing.assert_allclose(c.conductance, film.value**3 * factors.pressure.x.value, rtol=1e-6)
        np.testing.assert_allclose(c.content, factors.content.value, rtol=1e-8)
        # Patir and Cheng's two formulas for phi_s differ by a thousandth where they meet, at five deviations.
        np.testing.assert_allclose(c.flux_y, 0.5 * sigma * factors.shear.x.value, atol=5e-5 * sigma)
    if asperities is not None:
        pressed = contact_pressure(asperities, gap)
        np.testing.assert_allclose(c.contact, pressed.value, atol=1e-9 * pressed.value.max())
        np.testing.assert_allclose(c.contact_slope, pressed.slope, atol=1e-8 * np.abs(pressed.slope).max())


def test_rough_walls_that_overlap_are_squeezed_as_their_film():
    """A tenth of a micrometre apart the film is an exponential of the gap, and so is what its closing presses out."""
    space, gap, closing = film_space(rectangle((4e-3, 3e-3), (4, 3))), 1e-7, np.full((1, 1), -1e-6)
    ends = dict.fromkeys(("left", "right"), Held(1e5))
    oil = Film(ZERO, np.full((1, 1), VISCOSITY), (ZERO, ZERO), (ZERO, ZERO), closing)
    shape = FilmProblem(space, oil, ends, Cavitation.NONE, surface=HEIGHTS, asperities=SUMMITS)
    one = np.ones((len(space.vertices), 1))
    plate = Floating("plate", lambda t: shape, lambda t: one, lambda *_: steady(np.zeros(1)))
    found = held_at(FilmSolver(space), plate, 0.0, np.array([gap])).solution
    film = film_at(HEIGHTS, SUMMITS, False, np.array([gap]))
    rate = flow_factors(HEIGHTS, film.value).content.slope * film.slope * closing[0]
    assert film.slope[0] < 0.6
    assert found.storage_rate.sum() == pytest.approx(float(rate[0]) * 12e-6, rel=1e-6, abs=0.0)


@pytest.mark.parametrize("summits", [0.0, 0.7, 5.0])
def test_a_table_begins_within_the_law_of_contact(summits):
    """Of any height of the asperities, and of their summits over the walls: the compiled film takes all of them."""
    for height in np.linspace(1e-7, 2e-6, 191):
        table = gap_table(None, replace(SUMMITS, height=height, summit_height=summits * height), elastic=False)
        assert table.start == pytest.approx((summits + LOWEST_RATIO) * height, rel=1e-11)
