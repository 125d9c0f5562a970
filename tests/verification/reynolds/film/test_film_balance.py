"""Film equation: balances, symmetry and similarity of random films.

What holds for every film, whatever its shape: oil and energy balance to round-off, forces on the two walls
that differ by the pressure's pull on the slope, mirror images, turned frames, dimensional similarity.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from reynolds import (
    Cavitation,
    Cell,
    Film,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    Held,
    Loads,
    annulus,
    film,
    film_space,
    loads,
    rectangle,
)

SIZE = (0.02, 0.013)
HELD = {"left": Held(3e6), "right": Held(1e6), "top": Held(2e6)}  # the bottom is closed
SPACES = {
    (cell, degree): film_space(rectangle(SIZE, (8, 6), cell=cell), degree=degree) for cell in Cell for degree in (1, 2)
}


def _random_film(space: FilmSpace, seed: int, jump: float) -> Film:
    """A tilted film with steps of `jump` in thickness, squeezed, both walls turning about any centre."""
    rng = np.random.default_rng(seed)
    x, y = space.points
    tilt = rng.uniform(-0.4, 0.4, 2)
    steps = np.where(rng.random((len(space.cells), 1)) < 0.5, 1.0, jump)
    thickness = 5e-6 * steps * (1.0 + tilt[0] * x / SIZE[0] + tilt[1] * y / SIZE[1])
    turning = rng.uniform(-200.0, 200.0, 2)
    centre = rng.uniform(-0.02, 0.02, (2, 2))
    walls = [(-w * (y - c[1]), w * (x - c[0])) for w, c in zip(turning, centre, strict=True)]
    return film(
        thickness,
        0.03 * rng.uniform(0.3, 3.0, (len(space.cells), 1)),
        velocity_moving=walls[0],
        velocity_fixed=walls[1],
        squeeze=rng.uniform(-1e-3, 1e-3) * (1.0 + tilt[0] * x / SIZE[0]),
    )


def _solve(space: FilmSpace, posed: Film, cavitation: Cavitation = Cavitation.NONE) -> FilmSolution:
    return FilmSolver(space).solve(FilmProblem(space, posed, HELD, cavitation))


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    kind=st.sampled_from(sorted(SPACES, key=str)),
    seed=st.integers(0, 2**31),
    jump=st.sampled_from([1.0, 3.0, 10.0 ** (4.0 / 3.0)]),
    cavitation=st.sampled_from(list(Cavitation)),
)
def test_what_enters_leaves(kind, seed, jump, cavitation):
    """Oil and energy balance at round-off, over steps of 1e4 in conductance, with and without a cavity.

    Quadratic elements are for full films; they balance all the same. Under JFO what the upwinding spends at the
    ends of a cavity counts as mixing.
    """
    space = SPACES[kind]
    found = loads(_solve(space, _random_film(space, seed, jump), cavitation if kind[1] == 1 else Cavitation.NONE))
    through = max(abs(q) for q in found.flow.values())
    # A film fraction that next to nothing carries is known to fewer digits than a pressure.
    rounding = 100.0 if cavitation is Cavitation.JFO else 1.0
    assert found.mass_balance_error < rounding * 1e-12
    assert found.energy_balance_error < 1e-11
    left_over = sum(found.flow.values()) + found.squeeze_flow - found.cavity_flow
    assert abs(left_over) < rounding * 1e-11 * (through + abs(found.squeeze_flow) + abs(found.cavity_flow))
    assert found.flow["bottom"] == 0.0


@pytest.mark.parametrize("cell", list(Cell))
def test_what_mixing_spends_falls_with_the_cells(cell):
    """Upwinding spends energy in the cells at the ends of a cavity alone: to the first order of their size."""
    shares = []
    for n in (24, 48, 96):
        space = film_space(rectangle(SIZE, (n, n), cell=cell))
        thickness = space.sample(lambda x, y: 1e-5 * (1.0 + 0.5 * np.cos(2.0 * np.pi * x / SIZE[0]) + 15.0 * y))
        posed = film(thickness, 0.03, velocity_moving=(np.full((1, 1), 30.0), np.zeros((1, 1))))
        edges = {name: Held(3e7) for name in ("left", "right", "top")}
        solution = FilmSolver(space).solve(FilmProblem(space, posed, edges))
        found = loads(solution)
        assert found.cavitated_area_fraction > 0.1
        assert found.energy_balance_error < 1e-11
        shares.append(float(np.sum(solution.pressure * solution.upwind_exchange)) / found.dissipation)
    assert np.log2(shares[-2] / shares[-1]) == pytest.approx(1.0, abs=0.25), shares
    assert 0.0 < shares[-1] < 1e-3


@pytest.mark.parametrize(("cell", "degree"), sorted(SPACES, key=str))
def test_wall_forces_differ_by_the_pull_on_the_slope(cell, degree):
    """F1 + F2 = -int h grad p = int p grad h where the edges carry no pressure (divergence theorem)."""
    space = SPACES[cell, degree]
    slope = np.array([-2e-4, 1e-4])
    thickness = space.sample(lambda x, y: 8e-6 + slope[0] * x + slope[1] * y)
    posed = film(thickness, 0.03, velocity_moving=(np.full((1, 1), 7.0), np.full((1, 1), -2.0)))
    edges = {name: Held(0.0) for name in ("left", "right", "bottom", "top")}
    found = loads(FilmSolver(space).solve(FilmProblem(space, posed, edges)))
    both = np.add(found.friction_moving, found.friction_fixed)
    np.testing.assert_allclose(both, found.load * slope, rtol=1e-9)


@pytest.mark.parametrize("cell", list(Cell))
def test_action_and_reaction_without_pressure(cell):
    """A parallel film between held edges: pure drag, mu U A / h on both walls, and all work becomes heat."""
    space = SPACES[cell, 1]
    posed = film(space.sample(1e-5), 0.03, velocity_moving=(np.full((1, 1), 4.0), np.zeros((1, 1))))
    edges = {name: Held(1e5) for name in ("left", "right", "bottom", "top")}
    found = loads(FilmSolver(space).solve(FilmProblem(space, posed, edges)))
    drag = 0.03 * 4.0 * SIZE[0] * SIZE[1] / 1e-5
    assert found.friction_moving[0] == pytest.approx(-drag, rel=1e-9)
    assert found.friction_fixed[0] == pytest.approx(drag, rel=1e-9)
    assert found.dissipation == pytest.approx(4.0 * drag, rel=1e-9)


def _bump(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return 1e-5 * (1.0 + 0.3 * x / SIZE[0] + 0.4 * np.sin(200.0 * y))


@pytest.mark.parametrize("cavitation", list(Cavitation))
def test_mirror_image(cavitation):
    """The film mirrored in y, its walls too, has the mirrored pressure, node by node."""
    space = film_space(rectangle(SIZE, (12, 10), cell=Cell.QUADRILATERAL))
    edges = {name: Held(1e5) for name in ("left", "right", "bottom", "top")}
    pressures = []
    for sign, thickness in ((1.0, _bump), (-1.0, lambda x, y: _bump(x, SIZE[1] - y))):
        walls = (np.full((1, 1), 5.0), np.full((1, 1), 3.0 * sign))
        posed = film(space.sample(thickness), 0.03, velocity_moving=walls)
        solution = FilmSolver(space).solve(FilmProblem(space, posed, edges, cavitation))
        pressures.append(solution.pressure[space.vertex_dofs])
    mirrored = np.column_stack([space.vertices[:, 0], SIZE[1] - space.vertices[:, 1]])
    partner = np.argmin(((space.vertices[:, None] - mirrored[None]) ** 2).sum(axis=2), axis=0)
    np.testing.assert_allclose(pressures[0], pressures[1][partner], rtol=1e-9)


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("turn", [0.3, 2.0])
def test_turned_frame(cell, turn):
    """Load, torque and flows do not depend on the axes; forces and moments turn with them."""

    def solve(angle: float) -> Loads:
        space = film_space(annulus(5e-3, 1e-2, (6, 24), cell=cell))
        c, s = np.cos(angle), np.sin(angle)
        space = space.moved(space.vertices @ np.array([[c, s], [-s, c]]))
        x, y = space.points
        thickness = 1e-5 * (1.0 + 0.4 * (c * x + s * y) / 1e-2)
        walls = (np.full((1, 1), 8.0 * c) - 90.0 * y, np.full((1, 1), 8.0 * s) + 90.0 * x)
        posed = film(thickness, 0.03, velocity_moving=walls)
        held = {"inner": Held(5e6), "outer": Held(0.0)}
        return loads(FilmSolver(space).solve(FilmProblem(space, posed, held, Cavitation.REYNOLDS)))

    still, turned = solve(0.0), solve(turn)
    assert turned.load == pytest.approx(still.load, rel=1e-9)
    assert turned.flow == pytest.approx(still.flow, rel=1e-9)
    assert turned.friction_torque_moving == pytest.approx(still.friction_torque_moving, rel=1e-9)
    c, s = np.cos(turn), np.sin(turn)
    rotation = np.array([[c, -s], [s, c]])
    size = np.hypot(*still.friction_moving)
    np.testing.assert_allclose(turned.friction_moving, rotation @ still.friction_moving, rtol=1e-9, atol=1e-9 * size)
    np.testing.assert_allclose(
        (turned.moment_x, turned.moment_y), rotation @ (still.moment_x, still.moment_y), rtol=1e-8
    )


@settings(max_examples=25, deadline=None, derandomize=True)
@given(
    length=st.floats(0.1, 10.0), thickness=st.floats(0.1, 10.0), viscosity=st.floats(0.1, 10.0),
    speed=st.floats(0.1, 10.0),
)  # fmt: skip
def test_similar_films(length, thickness, viscosity, speed):
    """Pressure scales as mu U L/h^2, load with that times L^2, friction as mu U L^2/h, flow as U h L."""

    def solve(a: float, b: float, c: float, d: float) -> Loads:
        space = SPACES[Cell.QUADRILATERAL, 1]
        space = space.moved(space.vertices * a)
        posed = film(
            b * 1e-5 * (1.0 + 0.5 * np.sin(300.0 * space.points[0] / a)),
            0.03 * c,
            velocity_moving=(np.full((1, 1), d), np.full((1, 1), 0.5 * d)),
        )
        edges = {name: Held(0.0) for name in ("left", "right", "bottom", "top")}
        return loads(FilmSolver(space).solve(FilmProblem(space, posed, edges, Cavitation.REYNOLDS)))

    one, other = solve(1.0, 1.0, 1.0, 1.0), solve(length, thickness, viscosity, speed)
    pressure = viscosity * speed * length / thickness**2
    assert other.pressure_max == pytest.approx(pressure * one.pressure_max, rel=1e-9)
    assert other.load == pytest.approx(pressure * length**2 * one.load, rel=1e-9)
    drag = viscosity * speed * length**2 / thickness
    assert other.friction_moving[0] == pytest.approx(drag * one.friction_moving[0], rel=1e-9)
    assert other.flow["right"] == pytest.approx(speed * thickness * length * one.flow["right"], rel=1e-8)


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("cavitation", list(Cavitation))
@pytest.mark.parametrize("level", [0.0, 3e7])
def test_a_film_at_one_pressure_everywhere_stays_there(cell, cavitation, level):
    # Nothing flows: what is left of the balance is round-off of cancelling terms, not of flows.
    space = film_space(rectangle((1e-2, 2e-2), (17, 9), cell=cell))
    oil = film(space.sample(lambda x, y: 1e-5 * (1.0 + 50.0 * x)), 0.03)
    edges = {name: Held(level) for name in space.film_mesh.boundary_names}
    solution = FilmSolver(space).solve(FilmProblem(space, oil, edges, cavitation))
    assert np.ptp(solution.pressure) <= 1e-12 * level
    integrals = loads(solution)
    assert max(map(abs, integrals.flow.values())) < 1e-20
    assert integrals.mass_balance_error < 1e-8
    assert integrals.energy_balance_error < 1e-8


def test_oil_that_only_goes_round_is_balanced():
    """A ring that turns lets nothing in or out: its balances are relative to what goes round in it."""
    space = film_space(annulus(5e-3, 1e-2, (6, 24)))
    x, y = space.points
    oil = film(np.full(x.shape, 1e-5), 0.03, velocity_moving=(-100.0 * y, 100.0 * x))
    edges = {"inner": Held(0.0), "outer": Held(0.0)}
    integrals = loads(FilmSolver(space).solve(FilmProblem(space, oil, edges)))
    assert integrals.throughput < 1e-18
    assert integrals.mass_balance_error < 1e-12
