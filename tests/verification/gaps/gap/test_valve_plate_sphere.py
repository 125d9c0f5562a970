"""The gaps: spherical valve plate.

Ports all round at one pressure leave two concentric spherical seats; a block that turns about the sphere's centre
meets the same film, and a large sphere is a plane.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from gaps import (
    BlockDrive,
    BlockFilm,
    FilmLaws,
    PlatePart,
    ValvePlateGeometry,
    constant,
    floating_block,
    part_wall,
    plate_body,
    standing_block,
    wall_shear,
)
from gaps.films.block import kidney_wrench
from gaps.loads.block_tipping import BlockBalance, land_lift
from gaps.standing.gap_film import standing_block_film
from reynolds import (
    Asperities,
    Elastic,
    FilmInputError,
    FilmSolution,
    FilmSolver,
    annulus,
    body_space,
    face_normals,
    film_space,
    full_film,
    generalised_force,
    held_at,
    loads,
    modes_on,
    solve_stage,
)
from reynolds.bodies.transfer import transfer
from reynolds.fem.sphere import Sphere
from system import InputFaults, check_pump, load_pump, operating_point, piston_motion, valve_plate_geometry
from system.pump.lumped import lumped_leaks

RADII, RADIUS = (26.5e-3, 31.5e-3, 40.5e-3, 45.7e-3), 90e-3
SPHERE, ARC = Sphere(RADIUS), float(np.radians(30.0))
ALL_ROUND = ValvePlateGeometry(RADII, 9, ARC, (0.0, np.pi), (np.pi, 2.0 * np.pi), sphere=SPHERE)
SUCTION, DELIVERY = (tuple(np.radians(arc).tolist()) for arc in ([25.0, 155.0], [205.0, 335.0]))
PORTS = ValvePlateGeometry(RADII, 9, ARC, SUCTION, DELIVERY, sphere=SPHERE)
PRESSURE, CASE, SPEED, VISCOSITY, THICKNESS = 35e6, 0.15e6, 220.0, 0.0258, 9e-6
PRESSED = (-60e3, 300.0, -1400.0)


def half_and_half(angle: float) -> float:
    rise = np.clip(np.sin(-angle) / np.sin(np.radians(30.0)), -1.0, 1.0)
    return float(2.5e6 + 32.5e6 * 0.5 * (1.0 + rise))


def drive(chamber=None, suction=PRESSURE, spline=0.0, press=(0.0, 0.0, 0.0)) -> BlockDrive:
    course = constant(PRESSURE) if chamber is None else chamber
    return BlockDrive(SPEED, VISCOSITY, suction, PRESSURE, CASE, -1e5, course, constant(*press), spline)


def running(spline: float = 0.0) -> BlockDrive:
    return drive(half_and_half, 2.5e6, spline, PRESSED)


def at(film: BlockFilm, position, time=0.0) -> tuple[np.ndarray, FilmSolution]:
    """Generalised forces (3,) N of film, kidneys and press, and the film."""
    problem, modes = film.problem_at(time), film.modes_at(time)
    opened = problem.film.thickness + problem.space.sample_vertices(modes @ np.asarray(position))
    oil = replace(problem.film, thickness=opened, thickness_at_vertices=None)
    solution = FilmSolver(film.space).solve(replace(problem, film=oil))
    force = generalised_force(solution.pressure, modes_on(problem.space, modes), CASE)
    return force + film.outer_at(time, np.asarray(position), np.zeros(3)).force, solution


def angles() -> np.ndarray:
    return np.arcsin(np.array(RADII) / RADIUS)


def seat(one: float, two: float) -> float:
    return float(np.log(np.tan(0.5 * two) / np.tan(0.5 * one)))


# Closed forms


def test_film_and_kidneys_lift_as_two_seats(validation, refine):
    """Force along the shaft, concentric: pi R^2 p (cos a - cos b)/L of the outer seat less the inner one's."""
    t1, t2, t3, t4 = angles()
    outer, inner = (np.cos(t3) - np.cos(t4)) / seat(t3, t4), (np.cos(t1) - np.cos(t2)) / seat(t1, t2)
    exact = float(np.pi * RADIUS**2 * (PRESSURE - CASE) * (outer - inner))

    def solve(n: int) -> float:
        film = BlockFilm(ALL_ROUND, drive(), cells=(n, 4 * n))
        problem = film.problem_at(0.0)
        oil = replace(problem.film, thickness=np.full((1, 1), THICKNESS), thickness_at_vertices=None)
        solution = FilmSolver(film.space).solve(replace(problem, film=oil))
        force = generalised_force(solution.pressure, modes_on(problem.space, film.modes_at(0.0)), CASE)
        return float((force + film.outer_at(0.0, np.zeros(3), np.zeros(3)).force)[0])

    got = refine(solve, (2, 4, 8))
    validation(
        case="spherical ring under one pressure", source="closed form (Pinkus and Sternlicht 1961)",
        quantity="lift of film and kidneys", unit="N", expected=exact, obtained=got.finest,
        tolerance=got.tolerance(), order=got.order,
    )  # fmt: skip


def test_balance_knows_the_sphere():
    """The closed force, and a moment that is the film's own: a sector pressed at its lever leaves nothing over."""
    t1, t2, t3, t4 = angles()
    exact = 0.5 * RADIUS**2 * ((np.cos(t3) - np.cos(t4)) / seat(t3, t4) - (np.cos(t1) - np.cos(t2)) / seat(t1, t2))
    lift = land_lift(RADII, SPHERE)
    assert lift.force == pytest.approx(exact, rel=1e-12)
    assert land_lift(RADII, Sphere(1e3)).moment == pytest.approx(land_lift(RADII).moment, rel=1e-8)
    balanced = BlockBalance(RADII, 9, 4e-4, lift.moment / lift.force * 1.5, SPHERE, 0.5 * RADIUS)
    assert balanced.moment_ratio == pytest.approx(balanced.force_ratio, rel=1e-12)
    lever = 2.0 / np.pi * lift.moment / lift.force  # of what is left, as of the half turn that presses
    assert balanced.pressed_at(20e6, 0.0, 0.0) == pytest.approx(lever / np.hypot(1.0, lever / RADIUS), rel=1e-9)


def test_force_that_presses_within_a_distance_turns_the_block_about_its_spline():
    """A pressure acts along the line through the sphere's centre: its moment by the cross product."""
    height, distance, force = 0.4 * RADIUS, 0.2 * RADIUS, 300.0
    normal = np.array([distance / RADIUS, 0.0, np.sqrt(1.0 - (distance / RADIUS) ** 2)])
    arm = np.array([0.0, 0.0, -RADIUS]) + RADIUS * normal - np.array([0.0, 0.0, height])
    moment = float(np.linalg.norm(np.cross(arm, force / normal[2] * normal)))
    balance = BlockBalance(RADII, 9, 4e-4, 45e-3, SPHERE, height)
    assert balance.force_within(distance, moment) == pytest.approx(force, rel=1e-12)
    assert balance.pressed_by(force, moment) == pytest.approx(distance, rel=1e-12)


def test_kidneys_turn_the_block_about_the_middle():
    """The area integral of p n x r over one kidney, at no angle in particular."""
    above = np.zeros(9)
    above[2] = 1e6
    one = 80.0 * np.pi / 180.0 + 0.3
    force, about_x, about_y = kidney_wrench(PORTS, 0.3, above)
    _, r2, r3, _ = RADII
    lever = quad(lambda r: r**2 / np.sqrt(1.0 - (r / RADIUS) ** 2), r2, r3)[0] * 2.0 * np.sin(0.5 * ARC)
    assert force == pytest.approx(1e6 * 0.5 * ARC * (r3**2 - r2**2), rel=1e-12)
    assert about_x == pytest.approx(1e6 * lever * np.sin(one), rel=1e-12)
    assert about_y == pytest.approx(-1e6 * lever * np.cos(one), rel=1e-12)


def torque_of(film: BlockFilm, solution: FilmSolution) -> float:
    """Torque (N m) of the film against the block's turning."""
    return film.friction_torque(solution.problem.space, wall_shear(solution, None, solution.film.thickness))


def test_turning_block_rubs_as_its_shear_works():
    """Torque times speed is the walls' power; the closed form of concentric seats to the mesh's error."""
    film = BlockFilm(ALL_ROUND, drive(), cells=(8, 32))
    _, solution = at(film, (THICKNESS, 0.0, 0.0))
    torque = torque_of(film, solution)
    done = loads(solution, film.is_film(solution.problem.space))
    driven = (done.flow["inner"] + done.flow["outer"]) * (PRESSURE - CASE)
    assert torque * SPEED == pytest.approx(done.dissipation - driven, rel=1e-3)
    t1, t2, t3, t4 = angles()

    def seat_torque(one: float, two: float) -> float:
        return quad(lambda t: RADIUS**4 * np.sin(t) ** 3 / np.cos(t), one, two)[0]

    exact = 2.0 * np.pi * VISCOSITY * SPEED / THICKNESS * (seat_torque(t1, t2) + seat_torque(t3, t4))
    assert torque == pytest.approx(exact, rel=2e-3)


# Limits and motion


def test_a_large_sphere_is_a_plane():
    """Forces, leakage and friction of a tilted running block, to (R4/R)^2."""
    position = (THICKNESS, 2e-6, -1e-6)
    found = []
    for sphere in (Sphere(), Sphere(1e2), Sphere(-1e2)):
        film = BlockFilm(replace(PORTS, sphere=sphere), running())
        force, solution = at(film, position, 2e-4)
        edges = loads(solution).flow
        found.append([*force, edges["inner"], edges["outer"], torque_of(film, solution)])
    assert found[1] == pytest.approx(found[0], rel=1e-6)
    assert found[2] == pytest.approx(found[0], rel=1e-6)


def test_a_standing_block_turns_in_the_film_of_the_turning_mesh():
    """Concentric, the frame that stands and the one that turns with the block see one film: its torque is one."""
    film, position = BlockFilm(ALL_ROUND, drive()), np.array([THICKNESS, 0.0, 0.0])
    stage = held_at(FilmSolver(film.space), standing_block(film), 2e-4, position)
    force, turning = at(film, position, 2e-4)
    assert stage.film_force + stage.outer.force == pytest.approx(force, rel=1e-3, abs=1.0)
    told = standing_block_film(film, stage)
    assert told.friction_power == pytest.approx(SPEED * torque_of(film, turning), rel=1e-3)
    assert told.leakage_flow == pytest.approx(sum(loads(turning).flow[edge] for edge in ("inner", "outer")), rel=1e-3)


def test_the_spline_gives_tilts_their_leverage():
    """1 + s/R on film and kidneys alike; about the sphere's centre nothing opens."""
    flat, high = (BlockFilm(PORTS, running(spline)) for spline in (0.0, 45e-3))
    assert np.allclose(high.modes_at(0.0), flat.modes_at(0.0) * [1.0, 1.5, 1.5], rtol=1e-12)
    with pytest.raises(FilmInputError, match="turns without a film"):
        BlockFilm(replace(PORTS, sphere=Sphere(-90e-3)), running(90e-3))


def test_block_finds_its_place_on_the_sphere():
    """An implicit step under a little more than it bears: few films, so that the slopes are the sphere's."""
    laws = FilmLaws(asperities=Asperities(5e10, 10e-6, 0.4e-6, 120e9, 0.1))
    start, step = np.array([2e-6, 0.0, 0.0]), 1e-4
    borne = at(BlockFilm(PORTS, drive(half_and_half, 2.5e6, 90e-3), laws=laws), start)[0]
    press = (-borne[0] - 200.0, -borne[2] * RADII[3] - 5.0, borne[1] * RADII[3])
    film = BlockFilm(PORTS, drive(half_and_half, 2.5e6, 90e-3, press), laws=laws)
    floating = floating_block(film)
    before = full_film(floating, 0.0, start)
    stage = solve_stage(FilmSolver(film.space), floating, step, before, step, start, None)
    total = stage.film_force + stage.contact_force + stage.outer.force
    assert np.abs(total).max() < 1e-6 * abs(press[0])
    assert stage.steps <= 12


# The pump


def test_key_of_the_pump():
    """Geometry and lumped leakage take it, a small sphere is a fault, and what takes lands as plane is told."""
    pump = load_pump("ref90", {"valve_plate.sphere_radius": "90 mm"})
    assert valve_plate_geometry(pump).sphere == SPHERE
    plane = load_pump("ref90")
    assert valve_plate_geometry(plane).sphere.is_plane
    leaks = []
    for one in (pump, plane):
        point = operating_point(one)
        leaks.append(lumped_leaks(one, point, piston_motion(one, point)).conductance[2, 0])
    h, mu = plane.valve_plate.film_thickness, operating_point(plane).viscosity
    t1, t2, t3, t4 = np.arcsin(np.array(valve_plate_geometry(plane).land_radii) / RADIUS)
    exact = 2.0 * np.pi / 9.0 * h**3 / (12.0 * mu) * (1.0 / seat(t1, t2) + 1.0 / seat(t3, t4))
    assert leaks[0] == pytest.approx(exact, rel=1e-12, abs=0.0)
    assert leaks[0] < 0.99 * leaks[1]
    assert "bulges into a hollow block" in " ".join(str(warning) for warning in check_pump(pump).warnings)
    with pytest.raises(InputFaults) as raised:
        load_pump("ref90", {"valve_plate.sphere_radius": "45 mm"})
    (fault,) = raised.value.faults
    assert (fault.path, fault.found) == ("valve_plate.sphere_radius", "45 mm")


def test_elastic_plates_under_a_sphere(validation, tmp_path):
    """Pressure on a spherical face pushes along the shaft as on the ring that is seen there."""
    radius, inner, outer = 80e-3, 30e-3, 50e-3
    sphere = Sphere(radius)
    stretch = [float(r * sphere.stretch(r)) for r in (inner, outer)]
    film = replace(film_space(annulus(*stretch, (3, 48))), sphere=sphere)
    polygon = 0.5 * 48 * np.sin(2.0 * np.pi / 48)
    cells = (3, 16, 1)
    flat = PlatePart(0.9 * inner, 1.1 * outer, 10e-3, Elastic(210e9, 0.3))
    for over in (False, True):
        body = plate_body(replace(flat, over_film=over, sphere=sphere), cells)
        face = body_space(body.mesh).face(body.face)
        into = transfer(film, face, body.chart).force @ np.ones(film.size)
        forces = face_normals(body.chart, face.places) * into[:, None]
        assert np.abs(forces[:, :2].sum(axis=0)).max() < 1e-9 * forces[:, 2].sum()
        validation(
            case="Elastic plates under a spherical film",
            source="projected area",
            quantity=f"force along the shaft at 1 MPa, {'block' if over else 'valve plate'}",
            unit="N",
            expected=1e6 * polygon * (outer**2 - inner**2),
            obtained=1e6 * float(forces[:, 2].sum()),
            relative_tolerance=1e-3,
            note="edges of 7.5 degrees are chords on the map, no circles' arcs",
        )
    plane = film_space(annulus(inner, outer, (3, 16)))
    far = Sphere(100.0)
    nearly = replace(plane, sphere=far)
    ball = replace(flat, sphere=far)
    one, two = (
        part_wall(plate_body(part, cells), film, folder=tmp_path).matrix @ np.ones(film.size)
        for part, film in ((flat, plane), (ball, nearly))
    )
    assert two == pytest.approx(one, rel=1e-3, abs=0.0)
