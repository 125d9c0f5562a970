"""The gaps: block floating on the valve plate.

With all chambers and ports at one pressure the lands have closed forms, whose middle tells whether a block can
stand under its pistons; a block that wobbles or turns meets the same film whichever frame it is computed in.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from gaps import (
    BlockDrive,
    BlockFilm,
    DepthPoints,
    FilmLaws,
    Profile,
    ValvePlateGeometry,
    Waviness,
    constant,
    floating_block,
    standing_block,
    wall_shear,
)
from gaps.films.block import generalised, kidney_wrench, wrench_about
from gaps.loads.block_tipping import BlockBalance, land_lift
from gaps.shapes.bearing_pads import BearingPads
from reynolds import (
    Asperities,
    FilmInputError,
    FilmProblem,
    FilmSolver,
    Storage,
    full_film,
    generalised_force,
    held_at,
    modes_on,
    solve_stage,
)
from reynolds.floating.coordinates import contact_force
from reynolds.floating.start import places_of

RADII = (26.5e-3, 31.5e-3, 40.5e-3, 45.7e-3)
ARC, PISTONS, PITCH = np.radians(30.0), 9, np.radians(40.0)
ALL_ROUND = ValvePlateGeometry(RADII, PISTONS, ARC, (0.0, np.pi), (np.pi, 2.0 * np.pi))
SUCTION, DELIVERY = tuple(np.radians([25.0, 155.0])), tuple(np.radians([205.0, 335.0]))
PORTS = ValvePlateGeometry(RADII, PISTONS, ARC, SUCTION, DELIVERY)
PRESSURE, CASE, SPEED, VISCOSITY = 35e6, 0.15e6, 220.0, 0.0258
PISTON_AREA, PITCH_RADIUS = np.pi * 22e-3**2 / 4.0, 45e-3


def drive(press=(0.0, 0.0, 0.0), chamber=None, **changed) -> BlockDrive:
    """A block at 35 MPa everywhere, but for what is changed."""
    usual = {
        "shaft_speed": SPEED,
        "viscosity": VISCOSITY,
        "suction_pressure": PRESSURE,
        "delivery_pressure": PRESSURE,
        "case_pressure": CASE,
        "cavitation_pressure": -1e5,
        "chamber_pressure": constant(PRESSURE) if chamber is None else chamber,
        "press": constant(*press),
        "spline_height": 0.0,
    }
    return BlockDrive(**(usual | changed))


def half_and_half(angle: float) -> float:
    """Delivery pressure past the outer dead centre, a ramp of 30 deg on either side."""
    rise = np.clip(np.sin(-angle) / np.sin(np.radians(30.0)), -1.0, 1.0)
    return float(2.5e6 + 32.5e6 * 0.5 * (1.0 + rise))


RUNNING = {"suction_pressure": 2.5e6, "chamber": half_and_half}


def posed(film: BlockFilm, time: float, position: np.ndarray) -> FilmProblem:
    """The film at a position, without squeeze."""
    problem = film.problem_at(time)
    thick = problem.film.thickness + problem.space.sample_vertices(film.modes_at(time) @ position)
    return replace(problem, film=replace(problem.film, thickness=thick, thickness_at_vertices=None))


def lifted(film: BlockFilm, problem: FilmProblem, time: float, position: np.ndarray) -> np.ndarray:
    """Generalised forces of film, kidneys and press of a film posed at a position."""
    pressure = FilmSolver(film.space).solve(problem).pressure
    force = generalised_force(pressure, modes_on(problem.space, film.modes_at(time)), CASE)
    return np.asarray(force + film.outer_at(time, position, np.zeros(3)).force)


# Closed forms


def test_lands_under_one_pressure(validation):
    """Log profiles: the radial integrals against quadrature of the profile."""
    r1, r2, r3, r4 = RADII

    def pressure(r: float) -> float:
        if r < r2:
            return float(np.log(r / r1) / np.log(r2 / r1))
        return 1.0 if r < r3 else float(np.log(r4 / r) / np.log(r4 / r3))

    lift = land_lift(RADII)
    for name, power, got in (("force", 1, lift.force), ("moment", 2, lift.moment)):
        exact = sum(quad(lambda r, n=power: pressure(r) * r**n, a, b)[0] for a, b in pairwise(RADII))
        validation(
            case="lands at one pressure", source="closed form", quantity=f"{name} per angle and pressure",
            unit="m2" if power == 1 else "m3", expected=exact, obtained=got, relative_tolerance=1e-12,
        )  # fmt: skip


def test_film_and_kidneys_lift_as_the_lands_do(validation, refine):
    """The floating film's own force (design 8.12): ports all round, parallel film, whatever its thickness."""
    force = 2.0 * np.pi * land_lift(RADII).force * (PRESSURE - CASE)

    def solve(n: int) -> float:
        film, position = BlockFilm(ALL_ROUND, drive(), cells=(n, 4 * n)), np.array([9e-6, 0.0, 0.0])
        return float(lifted(film, posed(film, 0.01, position), 0.01, position)[0])

    got = refine(solve, (2, 4, 8))
    validation(
        case="parallel ring under one pressure", source="closed form", quantity="lift of film and kidneys",
        unit="N", expected=force, obtained=got.finest, tolerance=got.tolerance(), order=got.order,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("radii", "share", "middle", "moments"),
    [(RADII, 0.933, 36.5e-3, 0.757), ((37e-3, 40.5e-3, 48e-3, 52.5e-3), 0.939, 44.8e-3, 0.935)],
    ids=["ref90", "ref90"],
)
def test_balance_of_the_block(validation, radii, share, middle, moments):
    found = BlockBalance(radii, PISTONS, PISTON_AREA, PITCH_RADIUS)
    rows = (
        ("balance ratio", "1", share, found.force_ratio, 5e-4),
        ("middle of the lift", "m", middle, found.lift_radius, 5e-5),
        ("balance ratio of moments", "1", moments, found.moment_ratio, 5e-4),
    )
    for quantity, unit, expected, obtained, rounding in rows:
        validation(
            case="block under its pistons", source="REF90, closed form", quantity=f"{quantity}, R1 {radii[0]:g} m",
            unit=unit, expected=expected, obtained=obtained, tolerance=rounding,
        )  # fmt: skip


def test_what_is_not_lifted_presses_at_one_place():
    """Pistons, lift and spring as forces at their places: their resultant is where `pressed_at` says."""
    block = BlockBalance(RADII, PISTONS, PISTON_AREA, PITCH_RADIUS)
    high, low, spring = 34.85e6, 2.35e6, 1080.0
    angle = np.linspace(0.0, 2.0 * np.pi, 7200, endpoint=False) + 1e-4
    force = PISTONS * PISTON_AREA * np.where(angle > np.pi, high, low) / angle.size
    down = force.sum() * (1.0 - block.force_ratio) + spring
    moment = np.sum(force * np.sin(angle) * (PITCH_RADIUS - block.force_ratio * block.lift_radius))
    assert block.pressed_at(high, low, spring) == pytest.approx(abs(moment) / down, rel=1e-5)
    assert (
        block.pressed_at(high, low, spring)
        > RADII[3]
        > BlockBalance((37e-3, 40.5e-3, 48e-3, 52.5e-3), PISTONS, PISTON_AREA, PITCH_RADIUS).pressed_at(
            high, low, spring
        )
    )


def test_kidneys_against_quadrature():
    """Force and moments of sectors by the midpoint rule."""
    above = np.linspace(1e6, 30e6, PISTONS)
    angle = 0.3
    r = RADII[1] + (RADII[2] - RADII[1]) * (np.arange(400) + 0.5) / 400
    t = ARC * ((np.arange(400) + 0.5) / 400 - 0.5)
    area = r[:, None] * (RADII[2] - RADII[1]) / 400 * ARC / 400
    total = np.zeros(3)
    for k, p in enumerate(above):
        x, y = (r[:, None] * f(angle + k * PITCH + t) for f in (np.cos, np.sin))
        total += p * np.array([np.sum(area * np.ones_like(x)), np.sum(area * y), -np.sum(area * x)])
    assert kidney_wrench(PORTS, angle, above) == pytest.approx(total, rel=1e-5)


# Work


def test_generalised_forces_do_the_work_of_the_wrench():
    """Forces at places of a body that rises and tilts about the spline's point do as much work as P dq."""
    rng = np.random.default_rng(1)
    places, forces = rng.normal(size=(2, 7, 3))
    height, radius, moved = 0.08, RADII[3], rng.normal(size=3)
    turn = np.array([moved[2] / radius, -moved[1] / radius, 0.0])
    way = np.array([0.0, 0.0, moved[0]]) + np.cross(turn, places - np.array([0.0, 0.0, height]))
    outer = generalised(wrench_about(places, forces, height), radius)
    assert outer @ moved == pytest.approx(np.sum(forces * way), rel=1e-12)


def test_a_cylindrical_block_is_pressed_in_closed_form():
    """Plate forces A p/cos(g) along the normal at balls in a plane through S: A p (-1, -y, x/cos(g)^2)."""
    swash, spline = np.radians(16.2), 0.09
    angle = 0.2 + PITCH * np.arange(PISTONS)
    press = PISTON_AREA * np.linspace(0.0, 35e6, PISTONS)
    x, y = PITCH_RADIUS * np.cos(angle), PITCH_RADIUS * np.sin(angle)
    places = np.column_stack([x, y, spline - x * np.tan(swash)])
    forces = -np.outer(press / np.cos(swash), [np.sin(swash), 0.0, np.cos(swash)])
    closed = press @ np.column_stack([-np.ones(PISTONS), -y, x / np.cos(swash) ** 2])
    assert wrench_about(places, forces, spline) == pytest.approx(closed, rel=1e-12)


def test_asperities_do_not_touch_over_ports():
    """Ports all round leave contact on the two lands alone."""
    rough = Asperities(1.6e9, 50e-6, 0.5e-6, 80e9, 0.1)
    film = BlockFilm(ALL_ROUND, drive(), laws=FilmLaws(asperities=rough), cells=(4, 16))
    q = np.array([0.8e-6, 0.1e-6, 0.0])
    problem = film.problem_at(0.0)
    modes = modes_on(problem.space, film.modes_at(0.0))
    gap = modes.at_points @ q
    radius = np.hypot(*problem.space.points).mean(axis=1, keepdims=True)
    land = np.where((radius < RADII[1]) | (radius > RADII[2]), gap, 1.0)
    whole, lands = contact_force(rough, gap, modes), contact_force(rough, land, modes)
    bare = BlockFilm(ALL_ROUND, drive(), cells=(4, 16)).outer_at(0.0, q, np.zeros(3))
    touched = film.outer_at(0.0, q, np.zeros(3))
    round_off = 1e-12 * np.abs(lands.force).max()
    assert whole.force + touched.force - bare.force == pytest.approx(lands.force, rel=1e-9, abs=round_off)
    assert whole.slopes + touched.by_position == pytest.approx(lands.slopes, rel=1e-9, abs=1.0)
    step = 1e-10 * np.eye(3)[1]
    ahead, behind = (film.outer_at(0.0, q + d, np.zeros(3)).force for d in (step, -step))
    assert (ahead - behind) / 2e-10 == pytest.approx(touched.by_position[:, 1], rel=1e-4, abs=1e-3)


# Frames


def test_a_tilt_that_stands_in_space_is_the_film_of_the_standing_frame(validation, refine):
    """Oil stored on the mesh that turns with the block against the same film with a block that slides past."""
    position = np.array([9e-6, 3e-6, -2e-6])
    film = BlockFilm(PORTS, drive(**RUNNING), cells=(3, 12))
    floating, time = floating_block(film), 0.3 / SPEED
    steady = held_at(FilmSolver(film.space), standing_block(film), time, position)
    expected = steady.film_force + steady.outer.force

    def solve(steps: int) -> tuple[float, ...]:
        step = 0.02 / SPEED / steps
        problem = posed(film, time, position)
        oil = full_film(floating, time - step, position)[: problem.space.size]
        stored = replace(problem, storage=Storage(oil, step))
        return tuple(lifted(film, stored, time, position))

    for name, got, want in zip(("lift", "x", "y"), refine(solve, (1, 2, 4), order=1.0), expected, strict=True):
        validation(
            case="tilted block, turning mesh", source="the film in the frame that stands", quantity=name, unit="N",
            expected=want, obtained=got.finest, tolerance=got.tolerance(), order=got.order,
        )  # fmt: skip


def test_a_pitch_on_every_unknown_meets_its_like():
    """The block's mesh after a pitch, renumbered, has its nodes where they stood."""
    film = BlockFilm(PORTS, drive(**RUNNING), cells=(2, 8))
    ring, period = film.ring, PITCH / SPEED
    later = ring.turned(PITCH)
    behind = places_of(ring.space, later).unknowns
    assert later.vertices[behind] == pytest.approx(ring.space.vertices, abs=1e-12)
    first, then = film.problem_at(0.1 * period), film.problem_at(1.1 * period)
    assert then.held_nodes is not None
    assert np.array_equal(then.held_nodes[behind], first.held_nodes, equal_nan=True)
    after, before = ([one.boundary[f"kidney_{k}"] for k in range(1, PISTONS + 1)] for one in (then, first))
    assert after[:-1] == before[1:]


# Floating


def test_a_parallel_block_sinks_as_two_lands(validation, refine):
    """Ports all round and one pressure: each land's squeeze film alone bears the excess load, at any shaft speed.

    p = 6 mu V/h^3 (r^2 - a^2 - (b^2 - a^2) ln(r/a)/ln(b/a)), whose integral is
    -(3 pi mu V/(2 h^3)) (b^4 - a^4 - (b^2 - a^2)^2/ln(b/a)) for V = dh/dt.
    """
    excess, film_thickness = 500.0, 9e-6
    lands = ((RADII[0], RADII[1]), (RADII[2], RADII[3]))
    damping = sum(1.5 * np.pi * VISCOSITY * (b**4 - a**4 - (b**2 - a**2) ** 2 / np.log(b / a)) for a, b in lands)

    def solve(n: int) -> float:
        start, step = np.array([film_thickness, 0.0, 0.0]), 1e-8
        free = BlockFilm(ALL_ROUND, drive(), cells=(n, 4 * n))
        lift = lifted(free, posed(free, 0.0, start), 0.0, start)[0]
        film = BlockFilm(ALL_ROUND, drive(press=(-lift - excess, 0.0, 0.0)), cells=(n, 4 * n))
        floating = floating_block(film)
        before = full_film(floating, 0.0, start)
        stage = solve_stage(FilmSolver(film.space), floating, step, before, step, start, None)
        return float(stage.q[0] - film_thickness) / step

    got = refine(solve, (4, 8, 16))
    validation(
        case="parallel ring sinking under its load", source="closed form", quantity="rate of the film", unit="m/s",
        expected=-excess * film_thickness**3 / damping, obtained=got.finest, tolerance=got.tolerance(),
        order=got.order,
    )  # fmt: skip


def test_a_parallel_block_rubs_as_two_rings(validation, refine):
    """Ports all round: shear of the lands alone, mu w^2 pi (b^4 - a^4)/(2 h) each; webs over ports rub nowhere."""
    position = np.array([9e-6, 0.0, 0.0])
    fourth = np.array(RADII) ** 4
    power = 0.5 * np.pi * VISCOSITY * SPEED**2 / position[0] * (fourth[1] - fourth[0] + fourth[3] - fourth[2])

    def solve(n: int) -> float:
        film = BlockFilm(ALL_ROUND, drive(), cells=(n, 4 * n))
        solution = FilmSolver(film.space).solve(posed(film, 0.0, position))
        return film.friction_torque(solution.problem.space, wall_shear(solution, None, solution.film.thickness)) * SPEED

    got = refine(solve, (2, 4, 8))
    validation(
        case="parallel ring turning", source="closed form", quantity="power of shear", unit="W",
        expected=power, obtained=got.finest, tolerance=got.tolerance(), order=got.order,
    )  # fmt: skip


def test_waves_of_the_plate_carry_the_block():
    """A wavy plate has wedges, whose cavities leave a lift while the block turns; a flat one has none."""
    still = {"suction_pressure": CASE, "delivery_pressure": CASE, "chamber": constant(CASE)}
    position = np.array([3e-6, 0.0, 0.0])

    def lift(face: Profile, speed: float) -> float:
        film = BlockFilm(ALL_ROUND, drive(shaft_speed=speed, **still), face, cells=(3, 16))
        return float(lifted(film, posed(film, 0.0, position), 0.0, position)[0])

    wavy = Profile((Waviness(3, 1e-6),))
    assert lift(wavy, 0.0) == pytest.approx(0.0, abs=1e-3)
    assert lift(Profile(), SPEED) == pytest.approx(0.0, abs=1e-3)
    assert lift(wavy, SPEED) > 1e3


def test_a_plate_is_measured_over_its_lands_and_pads_alone():
    """The corners of a mesh lie a little beyond the circles, the middles of its edges a little within."""
    pads = BearingPads(1.1 * RADII[3], 1.2 * RADII[3], 0.4, 6)
    for geometry, outermost in ((ALL_ROUND, RADII[3]), (replace(ALL_ROUND, pads=(pads,)), 1.2 * RADII[3])):
        rising = Profile((DepthPoints((RADII[0], outermost), (1e-6, 3e-6)),))
        found = BlockFilm(geometry, drive(), rising, cells=(3, 16)).problem_at(0.0).film
        assert found.thickness_at_vertices.max() == pytest.approx(3e-6, abs=1e-15)
        assert 1e-6 <= found.thickness.min() < 1.2e-6
        short = Profile((DepthPoints((RADII[0], 0.99 * outermost), (1e-6, 3e-6)),))
        with pytest.raises(FilmInputError, match="profile, place"):
            BlockFilm(geometry, drive(), short, cells=(3, 16)).problem_at(0.0)
