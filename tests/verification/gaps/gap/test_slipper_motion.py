"""The floating slipper: lands and pockets by generalised forces, hydrostatic equilibrium, orifice and retainer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from gaps import (
    DepthPoints,
    EdgeRelief,
    Effect,
    FilmLaws,
    Physics,
    PocketOrifice,
    Profile,
    SlipperDrive,
    SlipperFilm,
    SlipperLands,
    SlipperShape,
    Waviness,
    constant,
    face_force,
    floating_slipper,
    slipper_mesh,
)
from gaps.films.slipper import Retainer, orifice_and_capillary, retainer_force, supply
from gaps.shapes.slipper_lands import lands_between
from reynolds import (
    Asperities,
    FilmInputError,
    FilmSolution,
    FilmSolver,
    FloatingStage,
    Held,
    generalised_force,
    loads,
    modes_on,
    solve_stage,
    started,
)

INNER, OUTER, VISCOSITY, PRESSURE, HEIGHT = 5e-3, 10e-3, 0.03, 20e6, 10e-6
FULL = Physics().without(Effect.CAVITATION)
WIDE = PocketOrifice(4e-3, 1e-4)  # lets the pocket have the chamber's pressure but for 1e-8
SHAPE = SlipperShape(SlipperLands(((INNER, OUTER),)), WIDE)


def _drive(**changed) -> SlipperDrive:
    drive = SlipperDrive(
        shaft_speed=1.0,
        viscosity=VISCOSITY,
        density=870.0,
        case_pressure=0.0,
        cavitation_pressure=-1e5,
        spin=0.0,
        chamber_pressure=constant(PRESSURE),
        sliding=constant(0.0, 0.0),
        outer=constant(0.0, 0.0, 0.0),
    )
    return replace(drive, **changed)


def _forces(shape: SlipperShape, drive: SlipperDrive, position, cells) -> tuple[np.ndarray, FilmSolution]:
    """Generalised forces (3,) N of film and pockets at a position, and the film."""
    film = SlipperFilm(shape, drive, physics=FULL, cells=cells)
    problem, modes = film.problem_at(0.0), film.modes_at(0.0)
    opened = problem.film.thickness + problem.space.sample_vertices(modes @ np.asarray(position))
    oil = replace(problem.film, thickness=opened, thickness_at_vertices=None)
    solution = FilmSolver(film.space).solve(replace(problem, film=oil))
    every = modes_on(film.space, modes, film.pockets)
    return generalised_force(solution.pressure, every, drive.case_pressure), solution


@pytest.mark.parametrize(
    ("tilt", "speed", "force", "moment"),
    [
        (0.0, 0.0, 3399.270, 0.0),
        (0.5, 0.0, 3456.681, -1.174660),
        (0.5, -10.0, 4163.694, -4.07860),
        (0.5, 2.0, 3315.278, -0.59387),
    ],
)
def test_tilted_slipper(tilt, speed, force, moment, validation, refine):
    """The reference has -(U/2) dh/dx, of a plate that moves with U: the slipper slides over it with -U."""
    drive = _drive(sliding=constant(-speed, 0.0))
    position = HEIGHT * np.array([1.0, tilt, 0.0])

    def solve(n: int) -> tuple[float, float]:
        found, _ = _forces(SHAPE, drive, position, (n, 4 * n))
        assert abs(found[2]) < 1e-9 * force
        return float(found[0]), float(found[1] * OUTER)

    lift, turning = refine(solve, (12, 24, 48))
    rows = [("lift with the pocket's", "N", force, lift, 0.5e-3), ("int p x dA", "N m", moment, turning, 0.5e-5)]
    for quantity, unit, expected, obtained, rounding in rows:
        if expected == 0.0:
            assert abs(obtained.finest) < 1e-9 * force * OUTER
            continue
        validation(
            case="Floating slipper, tilted and held",
            source="closed form and own converged solution",
            quantity=f"{quantity}, tilt {tilt:g}, U = {speed:g} m/s, by generalised forces",
            unit=unit,
            expected=expected,
            obtained=obtained.finest,
            tolerance=obtained.tolerance(rounding),
            order=obtained.order,
        )


def test_a_slipper_that_rides_on_its_leading_edge_drags_oil_from_the_case_into_its_pocket():
    """pi U q c^2/(2 r2), c^2 = (r2^2 - r1^2)/(2 ln(r2/r1)): Couette flow over a small rise q at the rim.

    The wedge makes oil evenly over the land; what of it runs inwards, and what is carried over the inner edge,
    enters the pocket. A wide orifice lets it go on into a chamber at case pressure.
    """
    speed, rise, lands = 10.0, 0.01 * HEIGHT, SHAPE.lands
    drive = _drive(sliding=constant(speed, 0.0), chamber_pressure=constant(0.0))
    _, solution = _forces(SHAPE, drive, (HEIGHT, rise, 0.0), (12, 96))
    flow = loads(solution).flow
    middle = (OUTER**2 - INNER**2) / (2.0 * np.log(OUTER / INNER))
    expected = np.pi * speed * rise * middle / (2.0 * OUTER)
    # The mesh's sectors are straight, each (pi/96)^2/2 short of the circle; the film answers to the rise squared.
    assert sum(flow[edge] for edge in lands.open) == pytest.approx(-expected, rel=3e-3)
    assert flow["pocket"] == pytest.approx(expected, rel=3e-3)


def test_grooved_slipper(validation, refine):
    lands = ((5e-3, 7.43e-3), (7.83e-3, 10.26e-3))
    shape = SlipperShape(SlipperLands(lands), WIDE)

    def solve(n: int) -> tuple[float, float, float]:
        found, solution = _forces(shape, _drive(), (HEIGHT, 0.0, 0.0), (n, 8 * n))
        groove = solution.problem.space.edge_dofs["groove_1"]
        assert len(groove) == 1
        return float(found[0]), loads(solution).flow["case"], float(solution.pressure[groove[0]]) / PRESSURE

    rows = (
        ("lift", "N", 3496.390, 0.5e-3),
        ("leakage", "m3/s", 5.238254e-7, 0.5e-13),
        ("pressure of the groove over the pocket's", "1", 0.405611, 0.5e-6),
    )
    for (quantity, unit, expected, rounding), column in zip(rows, refine(solve, (6, 12, 24)), strict=True):
        validation(
            case="Floating slipper with two lands and a groove",
            source="closed form",
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=column.finest,
            tolerance=column.tolerance(rounding),
            order=column.order,
        )


def _stepped(film: SlipperFilm, start: float, *steps: float) -> list[FloatingStage]:
    """The slipper under its load, let go parallel at a film thickness, after each of some steps."""
    floating, solver, stages = floating_slipper(film), FilmSolver(film.space), []
    first = started(floating, 0.0, np.array([start, 0.0, 0.0]))
    held, q = first.held, first.q
    for step in steps:
        stages.append(solve_stage(solver, floating, 0.0, held, step, q, stages[-1] if stages else None))
        held, q = stages[-1].holds, stages[-1].q
    return stages


TO_REST = 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0


def test_hydrostatic_slipper(validation, refine):
    """A capillary and a land in series, load W: film and rate at which it comes back, case 8.4 of the design."""
    orifice, load = PocketOrifice(0.4e-3, 20e-3), 2800.0
    log = np.log(OUTER / INNER)
    pocket = load * 2.0 * log / (np.pi * (OUTER**2 - INNER**2))
    capillary = np.pi * orifice.diameter**4 / (128.0 * VISCOSITY * orifice.length)
    film = np.cbrt(6.0 * VISCOSITY * log * capillary * (PRESSURE - pocket) / (np.pi * pocket))
    stiffness = 3.0 * load / film * (1.0 - pocket / PRESSURE)
    area, k = np.pi * (OUTER**2 - INNER**2) / (2.0 * log), INNER / OUTER
    squeeze = 1.5 * np.pi * VISCOSITY * OUTER**4 / film**3 * (1.0 - k**4 + (1.0 - k**2) ** 2 / np.log(k))
    damping = squeeze + area**2 / (capillary + np.pi * film**3 / (6.0 * VISCOSITY * log))
    shape = SlipperShape(SlipperLands(((INNER, OUTER),)), orifice)
    drive = _drive(outer=constant(*face_force(OUTER, load, np.zeros(2))))

    def solve(n: int) -> tuple[float, float]:
        # A step so long that nothing squeezes, and a short one.
        rest, after = _stepped(SlipperFilm(shape, drive, physics=FULL, cells=(n, 4 * n)), 1.3 * film, 1e6, 1e-4)
        slow, fast = rest.force_slopes[0, 0], after.force_slopes[0, 0]
        return float(rest.q[0]), -float(slow / ((slow - fast) * 1e-4))

    rows = (("film thickness", "m", film), ("rate of return", "1/s", stiffness / damping))
    for (quantity, unit, expected), column in zip(rows, refine(solve, (6, 12, 24)), strict=True):
        validation(
            case="Hydrostatic slipper with a capillary",
            source="closed form, capillary and land in series; squeeze of film and pocket",
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=column.finest,
            tolerance=column.tolerance() + 1e-8 * expected,
            order=column.order,
        )


def test_pocket_feeds_by_its_orifice():
    shape = replace(SHAPE, orifice=PocketOrifice(0.9e-3, 5e-3, 0.7))
    film = SlipperFilm(shape, _drive(case_pressure=1e5), cells=(4, 12))
    boundary = film.problem_at(0.0).boundary
    assert boundary["case"] == Held(1e5)
    flow, slope = boundary["pocket"].feed(5e6)
    area, viscous = np.pi * 0.45e-3**2, 128.0 * VISCOSITY * 5e-3 / (np.pi * 0.9e-3**4)
    assert viscous * flow + 0.5 * 870.0 * (flow / (0.7 * area)) ** 2 == pytest.approx(PRESSURE - 5e6, rel=1e-12)
    beside = boundary["pocket"].feed(5e6 + 10.0)[0], boundary["pocket"].feed(5e6 - 10.0)[0]
    assert slope == pytest.approx((beside[0] - beside[1]) / 20.0, rel=1e-6, abs=0.0)


@pytest.mark.parametrize("drop", [-3e6, 0.0, 2e7])
def test_orifice_law(drop):
    conductance, loss = 1.25e-10, 3e15
    flow, slope = orifice_and_capillary(drop, conductance, loss)
    assert flow / conductance + loss * flow * abs(flow) == pytest.approx(drop, rel=1e-12)
    assert 1.0 / slope == pytest.approx(1.0 / conductance + 2.0 * loss * abs(flow), rel=1e-12)
    assert orifice_and_capillary(drop, conductance, 0.0).value == pytest.approx(conductance * drop)
    with pytest.raises(FilmInputError, match="slipper orifice, diameter"):
        supply(PocketOrifice(0.0, 5e-3), VISCOSITY, 870.0)


@pytest.mark.parametrize(("limit", "rate"), [(np.inf, 0.0), (60.0, 2e7), (60.0, 0.0)])
def test_retainer_has_a_potential(limit, rate):
    """Force and slopes against differences of k/2 mean <rise - clearance - u>^2 + limit u + rate/2 u^2, least over
    the deflection u of the plate; nothing below the clearance."""
    retainer = Retainer(30e-6, 1e8, limit, rate)
    angle = 2.0 * np.pi * np.arange(48) / 48

    def energy(q: np.ndarray) -> float:
        over = q[0] + q[1] * np.cos(angle) + q[2] * np.sin(angle) - 30e-6

        def with_plate(lifted: float) -> float:
            spent = limit * lifted if lifted > 0.0 else 0.0
            return 0.5e8 * float(np.mean(np.maximum(over - lifted, 0.0) ** 2)) + spent + 0.5 * rate * lifted**2

        if np.isinf(limit):
            return with_plate(0.0)
        return float(minimize_scalar(with_plate, bounds=(0.0, 1e-5), options={"xatol": 1e-12}).fun)

    at, step = np.array([25e-6, 8e-6, -6e-6]), 1e-8
    found = retainer_force(retainer, at)
    assert -110.0 < found.force[0] < -59.9
    for j, e in enumerate(step * np.eye(3)):
        assert found.force[j] == pytest.approx(-(energy(at + e) - energy(at - e)) / (2.0 * step), rel=1e-4)
        beside = retainer_force(retainer, at + 0.1 * e).force - retainer_force(retainer, at - 0.1 * e).force
        slope = beside / (0.2 * step)
        assert found.by_position[:, j] == pytest.approx(slope, abs=1e-6 * retainer.stiffness)
    level = retainer_force(retainer, np.array([30.5e-6, 0.0, 0.0]))
    assert level.force == pytest.approx([-50.0, 0.0, 0.0], abs=1e-11)
    assert np.array_equal(retainer_force(retainer, np.array([20e-6, 6e-6, 0.0])).force, np.zeros(3))


def test_a_retainer_that_a_spring_presses_gives_way():
    """Level, 40 um beyond the clearance: 100 N/um, from 250 N on in series with 20 N/um."""
    found = retainer_force(Retainer(30e-6, 1e8, 250.0, 2e7), np.array([70e-6, 0.0, 0.0]))
    lifted = (1e8 * 40e-6 - 250.0) / (1e8 + 2e7)
    assert found.force[0] == pytest.approx(-(250.0 + 2e7 * lifted))
    assert found.by_position[0, 0] == pytest.approx(-1.0 / (1e-8 + 5e-8))


def test_retainer_holds_a_slipper_that_is_pulled():
    """500 N away from the plate, and what little the pocket adds: the slipper rests 5 um beyond the clearance."""
    low = constant(1e5)
    drive = _drive(outer=constant(500.0, 0.0, 0.0), chamber_pressure=low, retainer=Retainer(30e-6, 1e8))
    rest = _stepped(SlipperFilm(SHAPE, drive, physics=FULL, cells=(6, 24)), 33e-6, *TO_REST)[-1]
    assert 16.0 < rest.film_force[0] < 17.5
    assert rest.q[0] == pytest.approx(30e-6 + (500.0 + rest.film_force[0]) / 1e8, rel=1e-6)


def test_friction(validation, refine):
    """A parallel film shears with mu v/h and spins with mu w r/h; touching asperities add their own."""
    drive = _drive(sliding=constant(3.0, 4.0), spin=100.0, outer=constant(-2e4, 0.0, 0.0))

    def solve(n: int) -> tuple[float, float]:
        film = SlipperFilm(SHAPE, drive, physics=FULL, cells=(n, 4 * n))
        (pressed,) = _stepped(film, HEIGHT, 1e-9)
        found = film.friction(pressed, film.wall_shear(pressed))
        shear = VISCOSITY / pressed.q[0] * float(film.space.area.sum())
        assert found.force == pytest.approx([-3.0 * shear, -4.0 * shear], rel=1e-9)
        assert found.power == pytest.approx(25.0 * shear - 100.0 * found.torque, rel=1e-9)
        return (-found.torque * float(pressed.q[0]) / HEIGHT,)

    (torque,) = refine(solve, (12, 24, 48))
    validation(
        case="Floating slipper that spins",
        source="closed form",
        quantity="spin torque, w = 100 rad/s",
        unit="N m",
        expected=0.00441786,
        obtained=torque.finest,
        tolerance=torque.tolerance(0.5e-8),
        order=torque.order,
    )


def test_friction_of_contact():
    rough = Asperities(density=1e10, radius=1e-5, height=4e-7, modulus=8e10, friction_coefficient=0.1)
    drive = _drive(sliding=constant(3.0, 4.0), outer=constant(-2e4, 0.0, 0.0), chamber_pressure=constant(1e5))
    film = SlipperFilm(SHAPE, drive, FilmLaws(asperities=rough), FULL, (6, 24))
    rest = _stepped(film, 1e-6, *TO_REST)[-1]
    bears = float(rest.contact_force[0])
    assert bears == pytest.approx(2e4 - rest.film_force[0], rel=1e-6)
    found = film.friction(rest, film.wall_shear(rest)).force
    oil = VISCOSITY * float((film.space.area / rest.solution.film.thickness).sum())
    assert found == pytest.approx([-0.6 * (0.1 * bears + 5.0 * oil), -0.8 * (0.1 * bears + 5.0 * oil)], rel=1e-6)


def test_face_turns_with_the_slipper():
    face = Profile((EdgeRelief(OUTER, 8e-3, 2e-6), Waviness(2, 1e-6)))
    film = SlipperFilm(replace(SHAPE, face=face), _drive(spin=10.0), cells=(4, 32))
    x, y = film.space.vertices.T
    radius = np.hypot(x, y)
    rim = radius > 0.999 * OUTER
    assert np.count_nonzero(rim) == 32
    for time in (0.0, 0.02):
        found = film.problem_at(time).film.thickness_at_vertices[rim]
        relief = 2e-6 * ((radius[rim] - 8e-3) / (OUTER - 8e-3)) ** 2
        wanted = relief + 1e-6 * np.cos(2.0 * (np.arctan2(y, x)[rim] - 10.0 * time))
        assert found == pytest.approx(wanted, abs=1e-15)


def test_a_face_is_measured_over_its_land_alone():
    """The corners of a mesh lie a little beyond the rim, the middles of its edges within the pocket's."""
    rising = Profile((DepthPoints((INNER, OUTER), (1e-6, 3e-6)),))
    found = SlipperFilm(replace(SHAPE, face=rising), _drive(), cells=(4, 32)).problem_at(0.0).film
    assert found.thickness_at_vertices.max() == 3e-6
    assert 1e-6 < found.thickness.min() < 1.3e-6
    short = Profile((DepthPoints((INNER, 0.99 * OUTER), (1e-6, 3e-6)),))
    with pytest.raises(FilmInputError, match="profile, place"):
        SlipperFilm(replace(SHAPE, face=short), _drive(), cells=(4, 32)).problem_at(0.0)


def test_mesh():
    mesh = slipper_mesh(((5e-3, 7e-3), (7.5e-3, 9e-3), (9.5e-3, 11e-3)), (3, 12))
    assert mesh.boundary_names == ("case", "groove_1", "groove_2", "pocket")
    counts = {name: len(facets) for name, facets in mesh.mesh.boundaries.items()}
    assert counts == {"pocket": 12, "groove_1": 24, "groove_2": 24, "case": 12}
    with pytest.raises(FilmInputError, match="slipper, lands"):
        SlipperLands(((5e-3, 7e-3), (6e-3, 9e-3)))


def test_grooves_cut_lands_into_the_face():
    face = lands_between(5e-3, 12e-3, grooves=[(9.5e-3, 10e-3)], vented=[(7e-3, 8e-3)])
    assert face == SlipperLands(((5e-3, 7e-3), (8e-3, 9.5e-3), (10e-3, 12e-3)), vented=(1,))
    assert face.sealing == ((5e-3, 7e-3),)
    assert face.closed == ("pocket", "groove_2")
    assert face.open == ("groove_1", "case")
    with pytest.raises(FilmInputError, match=r"vented grooves: \[3\]; expected numbers of grooves, 1 to 2"):
        SlipperLands(face.radii, vented=(3,))


@pytest.mark.parametrize("vented", [False, True], ids=["closed", "vented"])
def test_lift_and_leakage_of_a_grooved_slipper_by_closed_form(vented):
    """Lift: effective area; leakage: pi h^3 p/(6 mu sum ln). Beyond a vented groove nothing is borne."""
    ring = [(7e-3, 7.4e-3)]
    lands = lands_between(5e-3, 10e-3, *(((), ring) if vented else (ring, ())))
    found, solution = _forces(SlipperShape(lands, WIDE), _drive(), (HEIGHT, 0.0, 0.0), (16, 96))
    case = sum(loads(solution).flow[name] for name in lands.open)
    # Polygons of 96 sides have 7e-4 less area and 3.6e-4 less of either radius' circumference; cells add as much.
    assert found[0] == pytest.approx(PRESSURE * lands.effective_area, rel=1.5e-3)
    leak = np.pi * HEIGHT**3 * PRESSURE / (6.0 * VISCOSITY * lands.log_ratio)
    assert case == pytest.approx(leak, rel=1.5e-3)
    assert lands.effective_area < np.pi * (7e-3**2 if vented else 10e-3**2)


def test_support_land_squeezes_but_does_not_seal():
    """Closing at V, edges at one pressure: 1.5 pi mu V r2^4/h^3 [1 - k^4 + (1 - k^2)^2/ln k] of each land."""
    lands = lands_between(5e-3, 10e-3, vented=[(7e-3, 8e-3)])
    film = SlipperFilm(SlipperShape(lands, WIDE), _drive(chamber_pressure=constant(0.0)), physics=FULL, cells=(32, 192))
    problem, rate = film.problem_at(0.0), -1e-4
    oil = replace(
        problem.film,
        thickness=problem.film.thickness + HEIGHT,
        thickness_at_vertices=None,
        squeeze=np.full((1, 1), rate),
    )
    held = dict.fromkeys(problem.boundary, Held(0.0))
    solution = FilmSolver(film.space).solve(replace(problem, film=oil, boundary=held))
    force = generalised_force(solution.pressure, modes_on(film.space, film.modes_at(0.0), {}), 0.0)[0]
    wanted = 0.0
    for inner, outer in lands.radii:
        k = inner / outer
        shape = 1.0 - k**4 + (1.0 - k**2) ** 2 / np.log(k)
        wanted += 1.5 * np.pi * VISCOSITY * -rate * outer**4 / HEIGHT**3 * shape
    assert force == pytest.approx(wanted, rel=2e-3)
