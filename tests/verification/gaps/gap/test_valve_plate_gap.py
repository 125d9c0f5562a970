"""The gaps: valve plate.

With all chambers and ports at one pressure the ring has closed forms: a logarithmic profile over both lands and
the full pressure between them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

from gaps import BlockDrive, BlockFilm, GapFilm, PeriodicCurve, ValvePlateGeometry, constant, standing_block
from gaps.films.block import kidney_wrench
from gaps.standing.conductances import kidney_conductances
from gaps.standing.gap_film import standing_block_film
from reynolds import Array, FilmSolver, FloatingStage, held_at
from system import valve_plate_conductance

RADII = (26.5e-3, 31.5e-3, 40.5e-3, 45.7e-3)
PISTONS, PITCH = 9, np.radians(40.0)
SUCTION, DELIVERY = tuple(np.radians([25.0, 155.0])), tuple(np.radians([205.0, 335.0]))
GEOMETRY = ValvePlateGeometry(RADII, PISTONS, np.radians(30.0), SUCTION, DELIVERY)
ALL_PORT = replace(GEOMETRY, suction_arc=(0.0, np.pi), delivery_arc=(np.pi, 2.0 * np.pi))
NO_PORT = replace(GEOMETRY, suction_arc=(1.5, 1.5), delivery_arc=(4.5, 4.5))
THICKNESS, VISCOSITY, PRESSURE, CASE, SPEED = 8e-6, 0.0258, 35e6, 0.15e6, 220.0
PARALLEL = np.array([THICKNESS, 0.0, 0.0])
TILTED = np.array([THICKNESS, 4e-5 * RADII[3], -3e-5 * RADII[3]])
MESHES = (4, 8, 16)


@dataclass(frozen=True)
class Instant:
    """A block at a shaft angle (rad), chambers by their number."""

    angle: float
    drive: BlockDrive

    @property
    def chambers(self) -> Array:
        places = self.angle + PITCH * np.arange(PISTONS)
        return np.array([float(self.drive.chamber_pressure(place)) for place in places])


def state(*, angle: float = 0.0, chambers: Array | None = None, load: float = 1.0, **changed) -> Instant:
    """A block that hardly turns, every chamber and port at 35 MPa, but for what is changed."""
    at_rest = {
        "shaft_speed": 1e-9,
        "suction_pressure": PRESSURE,
        "delivery_pressure": PRESSURE,
        "case_pressure": CASE,
        "cavitation_pressure": -1e5,
        "viscosity": VISCOSITY,
        "press": constant(-load, 0.0, 0.0),
        "spline_height": 0.1,
    }
    pressures = np.full(PISTONS, PRESSURE) if chambers is None else chambers
    chamber = PeriodicCurve(angle + PITCH * np.arange(PISTONS), pressures)
    return Instant(angle, BlockDrive(**(at_rest | changed), chamber_pressure=chamber))


def running(*, angle: float = 0.0, chambers: Array | None = None, **changed) -> Instant:
    """Half the chambers at 35 MPa, half at 2.5, as the ports have them, turning, no two pressures alike."""
    place = (np.arange(PISTONS) * PITCH + angle) % (2.0 * np.pi)
    usual = np.where(place > np.pi, PRESSURE, 2.5e6) * (1.0 + 0.01 * np.cos(place))
    stated = {"suction_pressure": 2.5e6, "shaft_speed": SPEED}
    return state(angle=angle, chambers=usual if chambers is None else chambers, **(stated | changed))


def held(n: int, at: Instant, position: Array, geometry=GEOMETRY) -> tuple[BlockFilm, FloatingStage]:
    film = BlockFilm(geometry, at.drive, cells=(n, 4 * n))
    time = at.angle / at.drive.shaft_speed
    return film, held_at(FilmSolver(film.space), standing_block(film), time, position)


def told(n: int, at: Instant, position: Array, geometry=GEOMETRY) -> GapFilm:
    return standing_block_film(*held(n, at, position, geometry))


def separating(n: int, at: Instant, position: Array, geometry=GEOMETRY) -> tuple[float, Array]:
    """Force (N) of film and kidneys above case pressure, and their moments about x and y (N m)."""
    _, stage = held(n, at, position, geometry)
    kidneys = kidney_wrench(geometry, at.angle, at.chambers - at.drive.case_pressure)
    lift, along_x, along_y = stage.film_force
    return lift + kidneys[0], np.array([along_y, -along_x]) * RADII[3] + kidneys[1:]


def test_one_pressure_all_round(validation, refine):
    """Ports that reach all round hold the webs; what is left is two lands with closed forms."""
    conductance = PISTONS * valve_plate_conductance(RADII, THICKNESS, PISTONS, VISCOSITY)

    def solve(n: int) -> tuple[float, float]:
        force, moment = separating(n, state(), PARALLEL, ALL_PORT)
        assert np.abs(moment).max() < 1e-9 * force * RADII[3]
        found = told(n, state(), PARALLEL, ALL_PORT)
        assert found.friction_power < 1e-9
        return found.leakage_flow, force

    r1, r2, r3, r4 = RADII
    mean_squares = (r4**2 - r3**2) / np.log(r4 / r3) - (r2**2 - r1**2) / np.log(r2 / r1)
    exact = (
        ("leakage", "m3/s", conductance * (PRESSURE - CASE), "paper equation (17), all round"),
        ("separating force", "N", np.pi / 2.0 * mean_squares * (PRESSURE - CASE), "closed form, logarithmic profile"),
    )
    for (quantity, unit, expected, source), found in zip(exact, refine(solve, MESHES), strict=True):
        validation(
            case="Valve-plate gap, one pressure all round at rest",
            source=source,
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=found.finest,
            tolerance=found.tolerance(),
            order=found.order,
        )


@pytest.mark.parametrize("arc", [23.0, 31.2])
def test_kidney_of_any_arc(arc, refine):
    """Mesh lines follow the kidneys' edges: the force all round does not depend on where those are."""
    odd = replace(ALL_PORT, kidney_arc=np.radians(arc))
    force = refine(lambda n: separating(n, state(), PARALLEL, odd)[0], MESHES)
    r1, r2, r3, r4 = RADII
    mean_squares = (r4**2 - r3**2) / np.log(r4 / r3) - (r2**2 - r1**2) / np.log(r2 / r1)
    expected = np.pi / 2.0 * mean_squares * (PRESSURE - CASE)
    assert force.finest == pytest.approx(expected, abs=force.tolerance())


def test_leakage_with_half_the_ring_at_pressure(validation):
    """Mean over a pitch; the lands between the ports stand at neither pressure, which equation (17) ignores."""
    leakage = []
    for shaft_angle in np.radians([0.0, 10.0, 20.0, 30.0]):
        place = (np.arange(PISTONS) * PITCH + shaft_angle) % (2.0 * np.pi)
        chambers = PRESSURE * np.where(np.isclose(np.sin(place), 0.0), 0.5, np.where(place > np.pi, 1.0, 0.0))
        still = state(angle=shaft_angle, chambers=chambers, suction_pressure=0.0, case_pressure=0.0)
        leakage.append(told(8, still, PARALLEL).leakage_flow)
    half = 0.5 * PISTONS * valve_plate_conductance(RADII, THICKNESS, PISTONS, VISCOSITY) * PRESSURE
    validation(
        case="Valve-plate gap, half the ring at pressure, at rest",
        source="paper equation (17), half of it",
        quantity="leakage, mean over a pitch",
        unit="m3/s",
        expected=half,
        obtained=float(np.mean(leakage)),
        relative_tolerance=0.05,
        note="the two lands between the ports are 50 deg each: the law has none",
    )


@pytest.mark.parametrize("shaft_angle", [0.0, 0.3, 1.0])
def test_what_enters_leaves(shaft_angle):
    """Chambers and ports give what the case gets, in a tilted film of a turning block too."""
    film = told(8, running(angle=shaft_angle), TILTED)
    given = film.report.flow.sum() + film.report.suction_draw + film.report.delivery_draw
    assert film.loads.cavity_flow == 0.0
    assert given == pytest.approx(film.leakage_flow, abs=1e-10 * np.abs(film.report.flow).max())


@pytest.mark.parametrize("shaft_angle", [0.0, 0.3])
def test_power_of_walls_and_pressure_becomes_heat(shaft_angle):
    """Shear work of the block plus flow work of chambers and ports is the film's dissipation, webs left out.

    The chambers stand 1 % off the ports' pressure: a web over a port that passed oil between them would show.
    """
    at = running(angle=shaft_angle)
    film = told(8, at, TILTED)
    inflow = np.array([*film.report.flow, film.report.suction_draw, film.report.delivery_draw])
    above = np.array([*at.chambers, at.drive.suction_pressure, at.drive.delivery_pressure]) - CASE
    heat = film.loads.dissipation
    assert film.friction_power + inflow @ above == pytest.approx(heat, rel=1e-6)


def test_conductance_is_that_of_the_lands(refine):
    """A web over a port passes no oil: the sum for all kidneys stays near equation (17) on any mesh."""
    law = PISTONS * valve_plate_conductance(RADII, THICKNESS, PISTONS, VISCOSITY)
    coarse, middle, fine = (_conductances(n) for n in MESHES)
    assert coarse.sum() == pytest.approx(law, rel=0.25, abs=0.0)
    # Kidney and web side by side at two pressures: the land's corner gives a logarithm of the mesh, no more.
    assert middle == pytest.approx(coarse, rel=0.07, abs=0.0)
    assert fine == pytest.approx(middle, rel=0.07, abs=0.0)


def _conductances(n: int) -> Array:
    film, stage = held(n, running(), PARALLEL)
    return kidney_conductances(FilmSolver(film.space), film, stage)


def test_one_pitch_on_is_the_same_film():
    """The next chamber takes the place of the last: same film, flows by one place."""
    first = running(angle=0.1)
    after = running(angle=0.1 + PITCH, chambers=np.roll(first.chambers, -1))
    one, two = told(8, first, TILTED), told(8, after, TILTED)
    assert np.roll(one.report.flow, -1) == pytest.approx(two.report.flow, rel=1e-6)
    assert one.friction_power == pytest.approx(two.friction_power, rel=1e-9)
    assert one.leakage_flow == pytest.approx(two.leakage_flow, rel=1e-9)
    force, moment = separating(8, first, TILTED)
    assert separating(8, after, TILTED)[0] == pytest.approx(force, rel=1e-9)
    assert separating(8, after, TILTED)[1] == pytest.approx(moment, rel=1e-6)


def test_kidneys_stand_where_the_chambers_are():
    """kidney_k is the hole at shaft angle + (k - 1) pitch: its edge carries chamber k's pressure."""
    at = running(angle=0.3, chambers=1e6 * np.arange(1.0, 10.0))
    solution = told(4, at, PARALLEL).solution
    space = solution.problem.space
    for k in range(PISTONS):
        nodes = space.edge_dofs[f"kidney_{k + 1}"]
        assert solution.pressure[nodes] == pytest.approx(1e6 * (k + 1))
        place = space.vertices[np.isin(space.vertex_dofs, nodes)].mean(axis=0)
        angle = np.arctan2(place[1], place[0]) - 0.3 - k * PITCH
        assert np.sin(angle) == pytest.approx(0.0, abs=1e-9)
        assert np.cos(angle) > 0.0


def test_mirrored_pressures_mirror_the_film_at_rest():
    one = running(shaft_speed=1e-9)
    mirrored = running(
        shaft_speed=1e-9,
        chambers=np.roll(one.chambers[::-1], 1),
        suction_pressure=one.drive.delivery_pressure,
        delivery_pressure=one.drive.suction_pressure,
    )
    place, other = (np.array([THICKNESS, 2e-5 * RADII[3], side * 5e-5 * RADII[3]]) for side in (1.0, -1.0))
    (left, moment), (right, turned) = separating(8, one, place), separating(8, mirrored, other)
    assert right == pytest.approx(left, rel=1e-9)
    assert turned == pytest.approx([-moment[0], moment[1]], rel=1e-9)
    flows = told(8, one, place).report.flow
    assert told(8, mirrored, other).report.flow == pytest.approx(np.roll(flows[::-1], 1), rel=1e-8)


def test_tilt_is_pushed_back():
    """Where the film is thicker the pressure over the lands falls: less p x on that side."""
    rise = 5e-5 * RADII[3]
    _, (_, about_y) = separating(8, state(), np.array([THICKNESS, rise, 0.0]), NO_PORT)
    _, (about_x, _) = separating(8, state(), np.array([THICKNESS, 0.0, rise]), NO_PORT)
    assert about_y > 0.0  # integral of -p x
    assert about_x == pytest.approx(-about_y, rel=1e-2)  # nine kidneys are nearly round


def test_friction_of_a_parallel_film(validation, refine):
    """mu w^2/h integral of r^2 over the film: both lands, and no webs under ports that reach all round."""
    r1, r2, r3, r4 = RADII
    turning = state(shaft_speed=2100.0 * np.pi / 30.0)
    shear = VISCOSITY * turning.drive.shaft_speed**2 / THICKNESS
    lands = np.pi / 2.0 * (r2**4 - r1**4 + r4**4 - r3**4)
    webs = PISTONS / 4.0 * (PITCH - np.radians(30.0)) * (r3**4 - r2**4)
    for name, geometry, polar in (("both lands", ALL_PORT, lands), ("lands and webs", NO_PORT, lands + webs)):
        found = refine(lambda n, g=geometry: told(n, turning, PARALLEL, g).friction_power, MESHES)
        validation(
            case="Valve-plate gap, friction of a parallel film",
            source="closed form, Newton's shear",
            quantity=name,
            unit="W",
            expected=shear * polar,
            obtained=found.finest,
            tolerance=found.tolerance(),
            order=found.order,
        )


def test_carried_load_is_the_separating_force():
    at = running(load=50e3)
    found = told(4, at, PARALLEL)
    assert found.required_load == pytest.approx(50e3)
    assert found.carried_load == pytest.approx(separating(4, at, PARALLEL)[0])


def test_a_tilted_block_turns_as_its_plate_is_turned(validation, refine):
    """Oil of film and kidneys passes all torque on: a plain plate feels shear alone, a tilted block pressure too."""

    def torques(n: int) -> tuple[float, float]:
        at = running()
        lift, moments = separating(n, at, TILTED, NO_PORT)
        balanced = replace(at, drive=replace(at.drive, press=constant(-lift, *-moments)))
        film, stage = held(n, balanced, TILTED, NO_PORT)
        space, by = stage.solution.problem.space, film.wall_shear(stage)
        x, y, _ = space.points_in_space
        along_x, along_y = by.on_fixed
        plate = float(np.sum((x * along_y - y * along_x) * space.area * film.is_film(space)))
        pressed = film.tilted_torque(stage)
        assert abs(pressed) > 1e-3 * plate
        return (film.friction_torque(space, by) + pressed - plate) / pressed, plate

    missing, _ = refine(torques, MESHES)
    validation(
        case="Valve plate, torque of pressure on a tilted block",
        source="torque of shear on a plain plate",
        quantity="torque on block less that on plate, of that of the pressure",
        unit="-",
        expected=0.0,
        obtained=missing.finest,
        tolerance=missing.tolerance(),
        order=missing.order,
    )
