"""Film at the position that supports its load: sliders, squeeze, contact on springs, pivots."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reynolds import (
    ZERO,
    Asperities,
    Cavitation,
    FilmInputError,
    FilmNotConverged,
    FilmProblem,
    FilmSolver,
    Held,
    RigidLoad,
    Surface,
    carry_load,
    contact_pressure,
    film,
    film_space,
    loads,
    rectangle,
    winkler,
)
from reynolds.equation.rough_overlap import film_between
from reynolds.solve import load_search

LENGTH, WIDTH, VISCOSITY, SPEED = 0.01, 0.002, 0.03, 1.0
SLIDING = (np.full((1, 1), SPEED), ZERO)
ENDS = {"left": Held(0.0), "right": Held(0.0)}
ASPERITIES = Asperities(2e10, 5e-6, 0.5e-6, 1e11, 0.1)


def _space(cells=32):
    return film_space(rectangle((LENGTH, WIDTH), (cells, 1), periodic_y=True))


def _problem(space, shape, **motion):
    given = film(1.0, VISCOSITY, **motion)
    thickness = space.sample(shape)
    corners = np.broadcast_to(shape(*space.vertices.T), len(space.vertices))
    return FilmProblem(space, replace(given, thickness=thickness, thickness_at_vertices=corners), ENDS)


def _slider_load(outlet, rise):
    """Rayleigh 1918, N."""
    n = 1.0 + rise / outlet
    scale = 6.0 / (n - 1.0) ** 2 * (np.log(n) - 2.0 * (n - 1.0) / (n + 1.0))
    return scale * VISCOSITY * SPEED * LENGTH**2 / outlet**2 * WIDTH


@pytest.mark.parametrize("outlet", [2e-6, 1e-5, 8e-5])
def test_a_slider_settles_where_it_bears_its_load(outlet, validation, refine):
    rise = 1e-5

    def found(cells):
        problem = _problem(_space(cells), lambda x, y: rise * (1.0 - x / LENGTH), velocity_moving=SLIDING)
        return carry_load(problem, RigidLoad(_slider_load(outlet, rise))).position.separation * 1e6

    (column,) = refine(lambda cells: (found(cells),), (16, 32, 64))
    validation(
        case="Wide slider under a given load", source="Rayleigh 1918, inverted",
        quantity=f"outlet film thickness, n = {1.0 + rise / outlet:.4g}", unit="um", expected=outlet * 1e6,
        obtained=column.finest, tolerance=column.tolerance() + 1e-6 * outlet * 1e6, order=column.order,
    )  # fmt: skip


def test_a_squeezed_film_settles_where_it_bears_its_load(validation, refine):
    """Infinitely long strip: W = mu V L^3 B/h^3."""
    approach, h = 1e-4, 7e-6
    load = VISCOSITY * approach * LENGTH**3 * WIDTH / h**3

    def found(cells):
        problem = _problem(_space(cells), lambda x, y: 0.0 * x, squeeze=np.full((1, 1), -approach))
        return carry_load(problem, RigidLoad(load)).position.separation * 1e6

    (column,) = refine(lambda cells: (found(cells),), (8, 16, 32))
    validation(
        case="Squeezed strip under a given load", source="closed form", quantity="film thickness", unit="um",
        expected=h * 1e6, obtained=column.finest, tolerance=column.tolerance() + 1e-6 * h * 1e6,
        order=column.order,
    )  # fmt: skip


@pytest.mark.parametrize("stiffness", [None, 1e13, 1e15])
@pytest.mark.parametrize("h", [0.2e-6, 1e-6])
def test_rough_walls_settle_where_their_contact_bears_the_load(h, stiffness, validation):
    """No film pressure: F = A p_c(h), and springs deform by p_c/k."""
    space = _space(8)
    bears = float(contact_pressure(ASPERITIES, h).value)
    problem = replace(
        _problem(space, lambda x, y: 0.0 * x),
        surface=Surface(0.3e-6, 0.4e-6, 1.0, 1.0, 0.0), asperities=ASPERITIES,
        walls=None if stiffness is None else winkler(space, stiffness), cavitation=Cavitation.NONE,
    )  # fmt: skip
    found = carry_load(problem, RigidLoad(bears * LENGTH * WIDTH))
    slope = abs(float(contact_pressure(ASPERITIES, h).slope)) / bears
    validation(
        case="Rough walls under a given load", source="Greenwood and Tripp 1970-71, inverted",
        quantity=f"separation, h = {h * 1e6:g} um, " + ("rigid" if stiffness is None else "Winkler's springs"),
        unit="um", expected=(h - (bears / stiffness if stiffness else 0.0)) * 1e6,
        obtained=found.position.separation * 1e6,
        tolerance=1e6 * (1e-6 / slope + (1e-6 * bears / stiffness if stiffness else 0.0)),
        note="1e-6 of the load over the contact's stiffness",
    )  # fmt: skip
    # Below the range of the flow factors elastic walls keep a film of their own between the summits.
    film = h if stiffness is None else float(film_between(problem, np.array(h)).value)
    assert found.solution.film.thickness.min() == pytest.approx(film, rel=1e-4)


@pytest.mark.parametrize("n", [1.5, 2.1887, 4.0])
def test_a_flat_pad_on_a_pivot_finds_film_and_tilt(n, validation):
    """A pad of the film and tilt of a slider is asked to bear that slider's own load and moment."""
    space, outlet = _space(), 1e-5
    rise = (n - 1.0) * outlet
    slider = _problem(space, lambda x, y: outlet + rise * (1.0 - x / LENGTH), velocity_moving=SLIDING)
    asked = loads(carry_load(slider, RigidLoad(_slider_load(outlet, rise))).solution)
    flat = _problem(space, lambda x, y: 0.0 * x, velocity_moving=SLIDING)
    found = carry_load(flat, RigidLoad(asked.load, moment_y=asked.moment_y))
    reached = loads(found.solution)
    assert reached.load == pytest.approx(asked.load, rel=2e-6)
    assert reached.moment_y == pytest.approx(asked.moment_y, abs=2e-6 * asked.load * LENGTH)
    assert found.position.slope_y == 0.0
    obtained = reached.film_thickness_min - found.position.slope_x * LENGTH
    centre = -asked.moment_y / asked.load / LENGTH
    validation(
        case="Flat pad on a pivot", source="Rayleigh 1918, inverted",
        quantity=f"inlet over outlet film, pivot at x/L = {centre:.4f}", unit="1", expected=n,
        obtained=obtained / reached.film_thickness_min, tolerance=5e-3 * n,
        note="load and moment of 32 cells: within 0.2 % of the closed form",
    )  # fmt: skip


@pytest.mark.parametrize("pivot", [0.51, 0.56, 0.58, 0.62])
@pytest.mark.parametrize("load", [2.5, 25.0, 250.0])
def test_a_pad_finds_the_same_film_whatever_its_own_slope(pivot, load):
    """A slope of the shape is only another start: tilt and film are those of a flat pad."""
    asked = RigidLoad(load, moment_y=-load * pivot * LENGTH)
    flat, sloped = (
        carry_load(
            _problem(_space(), lambda x, y, rise=rise: rise * (1.0 - x / LENGTH), velocity_moving=SLIDING), asked
        )
        for rise in (0.0, 2e-6)
    )
    assert max(flat.rest, sloped.rest) < 1e-6
    assert max(flat.films, sloped.films) < 60
    thinnest = loads(flat.solution).film_thickness_min
    assert loads(sloped.solution).film_thickness_min == pytest.approx(thinnest, rel=1e-4)
    assert sloped.position.slope_x - 2e-6 / LENGTH == pytest.approx(flat.position.slope_x, abs=1e-4 * thinnest / LENGTH)


@pytest.mark.parametrize("aside", [0.0, 0.02])
def test_a_square_pad_finds_both_tilts(aside):
    """The force acts beside the middle of the motion, and across it: both tilts are large beside the film."""
    space = film_space(rectangle((LENGTH, LENGTH), (16, 16), origin=(-LENGTH / 2, -LENGTH / 2)))
    every = {name: Held(0.0) for name in ("left", "right", "bottom", "top")}
    shape = _problem(space, lambda x, y: 2e-6 * (0.5 - x / LENGTH), velocity_moving=SLIDING)
    moments = (50.0 * aside * LENGTH, -50.0 * 0.07 * LENGTH)
    found = carry_load(replace(shape, boundary=every), RigidLoad(50.0, *moments))
    assert found.rest < 1e-6
    assert (found.moment_x, found.moment_y) == pytest.approx(moments, abs=1e-5 * 50.0 * LENGTH)
    assert found.films < 60


@pytest.mark.parametrize("seed", range(3))
def test_a_pad_is_found_again_from_any_shape_of_its_own(seed):
    """A film of random gap, slope, crown and tilt bears a load; a pad of the same crown, with another slope, is asked
    to bear it: closing, flat or opening by up to twice the film."""
    random = np.random.default_rng(seed)
    space = film_space(rectangle((LENGTH, LENGTH), (16, 8), origin=(-LENGTH / 2, -LENGTH / 2)))
    every = {name: Held(0.0) for name in ("left", "right", "bottom", "top")}
    for _ in range(10):
        least, rise, across = 10.0 ** random.uniform(-6, -4), random.uniform(0.05, 4.0), random.uniform(0.0, 0.6)
        crown, own = random.uniform(0.0, 3.0) * random.integers(0, 2), random.uniform(-2.0, 4.0)

        def film_of(slope, tilt, least=least, crown=crown):
            def thickness(x, y):
                return least * (
                    1.0 + slope * (0.5 - x / LENGTH) + tilt * (y / LENGTH + 0.5) + crown * (2 * x / LENGTH) ** 2
                )

            return replace(_problem(space, thickness, velocity_moving=SLIDING), boundary=every)

        bears = loads(FilmSolver(space).solve(film_of(rise, across)))
        found = carry_load(film_of(own, 0.0), RigidLoad(bears.load, bears.moment_x, bears.moment_y))
        assert found.rest < 1e-6
        assert found.films < 100


def test_a_square_pad_stays_level_across_its_motion():
    space = film_space(rectangle((LENGTH, LENGTH), (16, 16), origin=(-LENGTH / 2, -LENGTH / 2)))
    every = {name: Held(0.0) for name in ("left", "right", "bottom", "top")}
    problem = replace(_problem(space, lambda x, y: 0.0 * x, velocity_moving=SLIDING), boundary=every)
    found = carry_load(problem, RigidLoad(50.0, moment_x=0.0, moment_y=-50.0 * 0.08 * LENGTH))
    assert abs(found.position.slope_y) < 1e-3 * abs(found.position.slope_x)
    assert found.position.slope_x < 0.0
    assert found.rest < 1e-6


def test_what_no_position_bears_is_told_with_the_nearest():
    space = _space(16)
    level = _problem(space, lambda x, y: 0.0 * x, velocity_moving=SLIDING)
    with pytest.raises(FilmNotConverged, match="no position of the walls bears 10 N; nearest after"):
        carry_load(level, RigidLoad(10.0))
    pressed = replace(level, boundary={"left": Held(1e6), "right": Held(1e6)}, cavitation=Cavitation.NONE)
    with pytest.raises(FilmNotConverged, match=r"bears 10 N; nearest after .* films: 20 N") as raised:
        carry_load(pressed, RigidLoad(10.0))
    assert "a load above that" in str(raised.value)
    with pytest.raises(FilmInputError, match="above zero"):
        RigidLoad(-1.0)


def test_a_search_that_ends_by_its_films_does_not_deny_a_position(monkeypatch):
    monkeypatch.setattr(load_search, "MOST_FILMS", 5)
    problem = _problem(_space(16), lambda x, y: 1e-5 * (1.0 - x / LENGTH), velocity_moving=SLIDING)
    with pytest.raises(FilmNotConverged, match="no position of the walls found that bears 1 N; nearest after 5 films"):
        carry_load(problem, RigidLoad(1.0))


def test_the_search_reaches_its_limits_and_tells_them():
    """A load of a gap near the film's extent is found; of a smaller and of a huge load the limits are told."""
    problem = _problem(_space(16), lambda x, y: 1e-5 * (1.0 - x / LENGTH), velocity_moving=SLIDING)
    widest = np.sqrt(LENGTH * WIDTH)
    at_widest = replace(problem, film=replace(problem.film, thickness=problem.film.thickness + 0.99 * widest))
    least = loads(FilmSolver(problem.space).solve(at_widest)).load
    found = carry_load(problem, RigidLoad(1.5 * least))
    assert 0.5 * widest < found.position.separation < widest
    with pytest.raises(FilmNotConverged, match="were open to the search") as raised:
        carry_load(problem, RigidLoad(0.1 * least))
    assert f"to {widest:.3g} m" in str(raised.value)
    assert "a load above that" in str(raised.value)
    with pytest.raises(
        FilmNotConverged, match="below 1e-09 m, the size of an oil's molecules, there is no film"
    ) as raised:
        carry_load(problem, RigidLoad(1e9))
    assert "a load below that" in str(raised.value)


def test_a_film_without_a_solution_is_solved_cold_once(monkeypatch):
    """Without a film before, a cold start is the only one: it is not tried twice."""
    solved = []

    def fails(self, problem, start=None):
        solved.append((problem.film.thickness.min(), start))
        raise FilmNotConverged("made to fail", "nothing")

    monkeypatch.setattr(FilmSolver, "solve", fails)
    problem = _problem(_space(), lambda x, y: 1e-5 * (1.0 - x / LENGTH), velocity_moving=SLIDING)
    with pytest.raises(FilmNotConverged, match="made to fail"):
        carry_load(problem, RigidLoad(1.0))
    assert len(solved) == len({thickness for thickness, _ in solved}) > 0
