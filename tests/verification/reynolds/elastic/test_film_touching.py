"""Film equation: elastic, rough walls in contact.

All that answers to pressure at once: springs or a half-space, roughness, contact, and the oil. A spring under film
and contact pressure leaves one equation of one unknown.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from reynolds import (
    ZERO,
    Asperities,
    Cavitation,
    Cell,
    Compliance,
    Elastic,
    FilmInputError,
    FilmNotConverged,
    FilmProblem,
    FilmSolver,
    Fluid,
    Held,
    Surface,
    contact_pressure,
    film,
    film_space,
    half_space,
    loads,
    march,
    rectangle,
    winkler,
)
from reynolds.equation.deformation import MOST_HALVINGS, settled_deformation
from reynolds.solve import solver as solve
from reynolds.solve.loads import evaluate

LENGTH, WIDE, VISCOSITY = 10e-3, 2.5e-3, 0.03
SLIDING = (np.full((1, 1), 5.0), ZERO)


def _barus(pressure, viscosity):
    thicker = viscosity * np.exp(2e-8 * pressure)
    return thicker, 2e-8 * thicker


def _dowson_higginson(pressure):
    return (0.59e9 + 1.34 * pressure) / (0.59e9 + pressure), 0.34 * 0.59e9 / (0.59e9 + pressure) ** 2


ROUGH = Surface(0.3e-6, 0.2e-6, 3.0, 1.0 / 3.0, lay_direction=0.4)
TOUCHING = Asperities(2e10, 5e-6, 0.3e-6, 100e9, 0.1, summit_height=0.3e-6)
PHYSICS: dict[str, Callable[[FilmProblem], FilmProblem]] = {
    "springs": lambda p: p,
    "half-space": lambda p: replace(p, walls=half_space(p.space, Elastic(20e9, 0.3))),
    "rough walls": lambda p: replace(p, surface=ROUGH),
    "oil of pressure": lambda p: replace(p, fluid=Fluid(_barus, _dowson_higginson)),
    "contact": lambda p: replace(p, asperities=TOUCHING),
    "all": lambda p: replace(p, surface=ROUGH, asperities=TOUCHING, fluid=Fluid(_barus, _dowson_higginson)),
}


@pytest.mark.parametrize("name", list(PHYSICS))
@pytest.mark.parametrize("cavitation", [Cavitation.NONE, Cavitation.JFO])
def test_newton_converges_quadratically(name, cavitation, monkeypatch):
    """Every slope is in the matrix: near the solution digits double. A slope left out makes the gain linear."""
    monkeypatch.setattr(solve, "KEPT", 0.0)  # each step by a linearisation of its own
    space = film_space(rectangle((LENGTH, LENGTH), (10, 10), cell=Cell.QUADRILATERAL))
    thickness = space.sample(lambda x, y: 1e-6 * (2.0 - x / LENGTH))
    ends = dict.fromkeys(("left", "right", "top", "bottom"), Held(0.0))
    posed = film(thickness, VISCOSITY, velocity_moving=(np.full((1, 1), 1.0), ZERO))
    soft = FilmProblem(space, posed, ends, cavitation, walls=winkler(space, 2e13))
    solver = FilmSolver(space)
    base = solver.solve(soft)
    found = solver.solve(replace(PHYSICS[name](soft), film=replace(posed, thickness=1.02 * thickness)), base)
    assert found.iterations <= 10
    near = [k for k in range(len(found.path) - 1) if 1e-11 < found.path[k] < 1e-2]
    assert near, found.path
    for k in near:
        assert found.path[k + 1] < max(10.0 * found.path[k] ** 2, found.path[k] ** 1.6, 1e-12), found.path


@pytest.mark.parametrize("cavitation", list(Cavitation))
@pytest.mark.parametrize("physics", ["springs", "half-space", "all"])
def test_mass_per_step_between_soft_walls(cavitation, physics):
    """The inflow equals the growth of the content, d(p/k)/dt included, to round-off at steps of every size."""
    space = film_space(rectangle((LENGTH, LENGTH), (8, 8), cell=Cell.QUADRILATERAL))
    ends = dict.fromkeys(("left", "right", "top", "bottom"), Held(1e5))

    def problem(t: float) -> FilmProblem:
        gap = 3e-6 + 1e-6 * np.sin(2.0 * np.pi * t / 0.1)
        thickness = space.sample(lambda x, y: gap * (1.2 - 0.4 * x / LENGTH))
        posed = FilmProblem(space, film(thickness, VISCOSITY), ends, cavitation, walls=winkler(space, 1e13))
        return PHYSICS[physics](posed)

    before = None
    for instant in march(FilmSolver(space), problem, 0.1, 0.01):
        found = instant.solution
        if before is not None:
            entered = -found.outflow[found.held].sum()
            if cavitation is Cavitation.REYNOLDS:  # makes and swallows oil in the cavity
                entered -= found.outflow[found.cavity].sum()
            grown = (found.holds.sum() - before.holds.sum()) / instant.step
            volume = np.sum((found.film.thickness - before.film.thickness) * space.area) / instant.step
            assert entered == pytest.approx(grown, abs=1e-13 * np.abs(found.flow_scale).sum())
            assert loads(found).mass_balance_error < 1e-12
            if physics != "all" and not found.cavity.any() and not before.cavity.any():
                assert grown == pytest.approx(volume, rel=1e-9, abs=0.0)
        before = found


def _contact_pressure(asperities: Asperities, h: float) -> float:
    """Greenwood and Tripp's pressure by quadrature of its own."""
    ratio = (h - asperities.summit_height) / asperities.height

    def density(s):
        return (s - ratio) ** 2.5 * np.exp(-0.5 * s**2) / np.sqrt(2.0 * np.pi)

    moment, _ = quad(density, ratio, ratio + 12.0, epsabs=0.0, epsrel=1e-12, limit=200)
    product = asperities.density * asperities.radius * asperities.height
    factor = 16.0 * np.sqrt(2.0) / 15.0 * np.pi * product**2 * np.sqrt(asperities.height / asperities.radius)
    return factor * asperities.modulus * moment


@pytest.mark.parametrize("dense", [False, True])
@pytest.mark.parametrize("given", [1.5e-6, 0.6e-6, -0.5e-6])
@pytest.mark.parametrize("pressure", [0.0, 5e6])
def test_walls_pressed_together_on_springs(dense, given, pressure, validation):
    """k g = p + p_c(h + g) at each spring, the film at one pressure; friction is mu_b p_c on the whole area."""
    stiff = 2e13
    mesh = rectangle((LENGTH, WIDE), (4, 2), periodic_x=True)
    space = film_space(mesh)
    ends = {"top": Held(pressure), "bottom": Held(pressure)}
    posed = replace(film(1.0, 1e-9, velocity_moving=SLIDING), thickness=np.full((1, 1), given))
    walls = winkler(space, stiff)
    if dense:
        walls = Compliance(walls.matrix.toarray())
    problem = FilmProblem(space, posed, ends, walls=walls, asperities=TOUCHING)
    found = FilmSolver(space).solve(problem)
    opened = brentq(
        lambda g: stiff * g - pressure - _contact_pressure(TOUCHING, given + g), 0.0, 5e-6, xtol=1e-20, rtol=1e-14
    )
    assert found.deformation == pytest.approx(opened, rel=1e-8, abs=1e-9 * abs(given))
    area, got = LENGTH * WIDE, loads(found)
    bears = _contact_pressure(TOUCHING, given + opened)
    assert got.load == pytest.approx(pressure * area, rel=1e-12, abs=1e-12)
    rubbing = TOUCHING.friction_coefficient * bears * area + 1e-9 * 5.0 / (given + opened) * area
    assert -got.friction_moving[0] == pytest.approx(rubbing, rel=1e-8)
    assert got.friction_moving[1] == pytest.approx(0.0, abs=1e-12)
    if dense:
        return
    validation(
        case="Rough walls pressed together on springs",
        source="balance of spring, film and contact by quadrature",
        quantity=f"contact load at h = {1e6 * given:g} um, film at {1e-6 * pressure:g} MPa",
        unit="N",
        expected=bears * area,
        obtained=got.contact_load,
        relative_tolerance=1e-7,
    )


def test_contact_takes_linear_pressure():
    quadratic = film_space(rectangle((LENGTH, WIDE), (4, 2)), degree=2)
    ends = {"left": Held(1e6), "right": Held(0.0)}
    soft = FilmProblem(quadratic, film(1e-6, VISCOSITY), ends, Cavitation.NONE, walls=winkler(quadratic, 1e13))
    with pytest.raises(FilmInputError, match=r"quadratic pressure between walls that touch.*degree 1"):
        FilmSolver(quadratic).solve(replace(soft, asperities=TOUCHING))


def test_moments_count_the_pressure_of_contact():
    """A rough, tilted film: load by the film's pressure, moments int (p + p_c) y and -int (p + p_c) x."""
    space = film_space(rectangle((LENGTH, WIDE), (8, 4), cell=Cell.QUADRILATERAL))
    thickness = space.sample(lambda x, y: 1e-6 * (1.2 - 0.5 * x / LENGTH - 0.3 * y / WIDE))
    posed = film(thickness, VISCOSITY, velocity_moving=SLIDING)
    ends = dict.fromkeys(("left", "right", "top", "bottom"), Held(0.0))
    solution = FilmSolver(space).solve(FilmProblem(space, posed, ends, surface=ROUGH, asperities=TOUCHING))
    found, (x, y) = loads(solution), space.points
    borne = contact_pressure(TOUCHING, thickness).value
    total = evaluate(solution, solution.pressure)[0] + borne
    assert found.contact_load == pytest.approx(float(np.sum(borne * space.area)), rel=1e-12)
    assert found.contact_load > 0.05 * found.load
    assert found.moment_x == pytest.approx(float(np.sum(total * y * space.area)), rel=1e-12)
    assert found.moment_y == pytest.approx(-float(np.sum(total * x * space.area)), rel=1e-12)


def test_a_step_that_gains_nothing_goes_on_from_the_place_last_tried():
    """Contact and imbalance are those of the place of the next step."""
    tried, begun = [], []

    def settled(rest):
        begun.append(tried[-1])
        return np.array([-1e-6])  # away from balance

    def at(gap):
        tried.append(gap[0])
        return SimpleNamespace(on_unknowns=np.zeros(1), settled=settled)

    meeting = SimpleNamespace(asperities=TOUCHING, compliance=np.zeros((1, 1)), at=at)
    with pytest.raises(FilmNotConverged):
        settled_deformation(meeting, np.array([1e-5]), np.zeros(1), np.array([1e-6]))
    first_tries = tried[1::MOST_HALVINGS]
    np.testing.assert_allclose(first_tries, np.array(begun) + 1e-6, rtol=1e-12)
