"""The gaps: piston.

Small eccentricities have closed forms: with h = c - e(y) cos(angle) the pressure changes by f(y) cos or g(y) sin,
where f'' - f/R^2 is what tilt and motion put in. Derived here and not in `gaps`; the film takes them to first
order of e/c.
"""

from __future__ import annotations

import numpy as np
import pytest

from gaps import FilmLaws, GapFilm, PistonDrive, PistonFilm, PistonShape, Profile, constant, standing_piston
from gaps.loads.ball_joint import lateral_force
from gaps.shapes.profiles import Barrel
from gaps.standing.conductances import piston_conductance
from gaps.standing.gap_film import rest_from, standing_piston_film
from reynolds import Array, FilmNotConverged, FilmSolver, FloatingStage, Surface, held_at
from system.films.positions import eccentric

RADIUS, CLEARANCE = 11e-3, 15e-6
LENGTH, VISCOSITY, PRESSURE = 40e-3, 0.0258, 35e6
SHAPE = PistonShape(2.0 * RADIUS, CLEARANCE, LENGTH)
SMALL = 1e-4  # e/c of the first-order closed forms
CELLS = (48, 12)
NO_LOAD = np.zeros(4)


def drive(*, reach: float = LENGTH, chamber: float = PRESSURE, velocity: float = 0.0, outer=NO_LOAD, **changed):
    """A piston at rest with 35 MPa in the chamber and 1 MPa in the case, but for what is changed."""
    at_rest = {
        "shaft_speed": 220.0,
        "viscosity": VISCOSITY,
        "case_pressure": 1e6,
        "cavitation_pressure": -1e5,
        "piston_spin": 0.0,
        "bore_spin": 0.0,
    }
    courses = (constant(chamber), constant(reach), constant(velocity), constant(*outer))
    return PistonDrive(**(at_rest | changed), **dict(zip(COURSES, courses, strict=True)))


COURSES = ("chamber_pressure", "reach", "velocity", "outer")


def flooded(**changed) -> PistonDrive:
    """The same pressure at both ends, too high for a cavity."""
    return drive(chamber=10e6, case_pressure=10e6, **changed)


def held(at: PistonDrive, position: Array, cells=CELLS, shape: PistonShape = SHAPE) -> tuple[PistonFilm, FloatingStage]:
    film = PistonFilm(shape, at, cells=cells)
    return film, held_at(FilmSolver(film.space_at(0.0)), standing_piston(film), 0.0, position)


def told(at: PistonDrive, position: Array, cells=CELLS, shape: PistonShape = SHAPE) -> GapFilm:
    return standing_piston_film(*held(at, position, cells, shape))


def force(at: PistonDrive, position: Array, cells=CELLS, shape: PistonShape = SHAPE) -> Array:
    """Force on the piston and its moment about mid-length of a guide that it fills: (Fx, Fy, Mx, My)."""
    inner, case = held(at, position, cells, shape)[1].film_force.reshape(2, 2)
    return np.concatenate([inner + case, 0.5 * shape.guide_length * (case - inner)])


def pushed(ratio: float, direction: tuple[float, float]) -> Array:
    return eccentric(CLEARANCE, ratio, np.array([*direction, 0.0, 0.0]))


def bulge() -> float:
    """Integral over the length of 1 - cosh(s/R)/cosh(l/2R): how far end leakage lets a pressure rise (m)."""
    return LENGTH - 2.0 * RADIUS * np.tanh(LENGTH / (2.0 * RADIUS))


@pytest.mark.parametrize("ratio", [0.0, 0.6, 0.9])
def test_leakage_of_a_parallel_piston(ratio, validation, refine):
    concentric = np.pi * 22e-3 * CLEARANCE**3 / (12.0 * VISCOSITY * LENGTH)

    def solve(n: int) -> tuple[float, float, float]:
        film, stage = held(drive(), pushed(ratio, (1.0, 0.0)), (n, n // 4))
        found = standing_piston_film(film, stage)
        return found.chamber_flow, found.leakage_flow, piston_conductance(FilmSolver(film.space_at(0.0)), stage)

    chamber, case, conductance = refine(solve, (24, 48, 96))
    assert case.finest == pytest.approx(chamber.finest, rel=1e-10)
    assert conductance.finest == pytest.approx(chamber.finest / (PRESSURE - 1e6), rel=1e-10, abs=0.0)
    validation(
        case="Piston gap, parallel piston at rest",
        source="paper equation (15), first term",
        quantity=f"leakage, eccentricity ratio {ratio:g}",
        unit="m3/s",
        expected=concentric * (1.0 + 1.5 * ratio**2) * (PRESSURE - 1e6),
        obtained=chamber.finest,
        tolerance=chamber.tolerance(),
        order=chamber.order,
    )


def test_rough_walls_conduct_what_they_leak():
    """In a centred film of three deviations Patir and Cheng's factor is 1 - 0.9 exp(-0.56 x 3)."""
    film = PistonFilm(SHAPE, drive(), FilmLaws(surface=Surface(CLEARANCE / 3.0, 0.0)), cells=CELLS)
    solver = FilmSolver(film.space_at(0.0))
    stage = held_at(solver, standing_piston(film), 0.0, np.zeros(4))
    conductance = piston_conductance(solver, stage)
    smooth = np.pi * 22e-3 * CLEARANCE**3 / (12.0 * VISCOSITY * LENGTH)
    assert conductance == pytest.approx((1.0 - 0.9 * np.exp(-0.56 * 3.0)) * smooth, rel=1e-12, abs=0.0)
    leaked = standing_piston_film(film, stage).chamber_flow
    assert leaked == pytest.approx(conductance * (PRESSURE - 1e6), rel=1e-12)


@pytest.mark.parametrize("ratio", [0.0, 0.6])
def test_oil_carried_by_the_piston(ratio, validation):
    """At one pressure a parallel piston drags pi d c v/2 out with it, whatever its eccentricity."""
    film = told(flooded(velocity=2.89), pushed(ratio, (0.6, 0.8)))
    validation(
        case="Piston gap, drag flow of the moving wall",
        source="paper equation (15), second term, sign corrected",
        quantity=f"flow out of the chamber, eccentricity ratio {ratio:g}",
        unit="m3/s",
        expected=np.pi * 22e-3 * CLEARANCE * 2.89 / 2.0,
        obtained=film.chamber_flow,
        relative_tolerance=1e-9,
        note="exact on any mesh",
    )
    assert film.leakage_flow == pytest.approx(film.chamber_flow, rel=1e-9)


def test_tilted_piston_of_the_tables(validation, refine):
    diameter, clearance, length = 20e-3, 10e-6, 30e-3
    tilted = 0.5 * clearance * np.array([-1.0, 0.0, 1.0, 0.0])
    at = drive(reach=length, chamber=30e6, case_pressure=0.0, viscosity=0.02)
    shape = PistonShape(diameter, clearance, length)

    def solve(n: int) -> tuple[float, ...]:
        cells = (2 * n, n)
        return (*force(at, tilted, cells, shape), told(at, tilted, cells, shape).chamber_flow)

    fx, fy, mx, my, flow = refine(solve, (24, 48, 96))
    assert np.abs([fy.finest, mx.finest / length, my.finest / length]).max() < 1e-9 * abs(fx.finest)
    for quantity, unit, expected, obtained, rounding in (
        ("side force", "N", -3722.951, fx, 0.5e-3),
        ("leakage", "m3/s", 2.447253e-7, flow, 0.5e-13),
    ):
        validation(
            case="Piston gap, tilted piston",
            source="own converged solution",
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=obtained.finest,
            tolerance=obtained.tolerance(rounding),
            order=obtained.order,
        )


def _pressure_on_tilt() -> float:
    """-pi R (3 (e1 - e0) dp/(c l^2)) R^2 bulge for e1 - e0 = 2 SMALL c: away from the side that narrows."""
    return -np.pi * RADIUS**3 * 3.0 * 2.0 * SMALL * (PRESSURE - 1e6) / LENGTH**2 * bulge()


def _sliding_on_tilt() -> float:
    return -np.pi * RADIUS**3 * 6.0 * VISCOSITY * 2.89 * 2.0 * SMALL / (CLEARANCE**2 * LENGTH) * bulge()


def _spin_on_offset() -> float:
    """6 pi mu (U1 + U2) (e/c) R^2/c^2 bulge: a journal's first-order force, square to its offset."""
    return 6.0 * np.pi * VISCOSITY * RADIUS * (220.0 + 180.0) * SMALL * RADIUS**2 / CLEARANCE**2 * bulge()


def _spin_on_tilt() -> float:
    """The same for an offset that changes sign at mid-length: the moment about it."""
    half = LENGTH / (2.0 * RADIUS)
    antisymmetric = LENGTH**3 / 12.0 - LENGTH * (LENGTH / 2.0 * RADIUS / np.tanh(half) - RADIUS**2)
    slope = 12.0 * np.pi * VISCOSITY * RADIUS * (220.0 + 180.0) * SMALL / (CLEARANCE**2 * LENGTH)
    return slope * RADIUS**2 * antisymmetric


SPINNING = flooded(piston_spin=220.0, bore_spin=180.0)
TILT = np.array([-1.0, 0.0, 1.0, 0.0])
OFFSET = np.array([1.0, 0.0, 1.0, 0.0])


@pytest.mark.parametrize(
    ("name", "unit", "at", "shape", "component", "expected"),
    [
        ("Fx, tilt under pressure", "N", drive(), TILT, 0, _pressure_on_tilt()),
        ("Fx, tilt, piston sliding", "N", flooded(velocity=2.89), TILT, 0, _sliding_on_tilt()),
        ("Fy, offset, both walls spin", "N", SPINNING, OFFSET, 1, _spin_on_offset()),
        ("My, tilt, both walls spin", "N m", SPINNING, TILT, 3, _spin_on_tilt()),
    ],
    ids=["pressure", "sliding", "spin", "spin moment"],
)  # fmt: skip
def test_force_of_a_small_displacement(name, unit, at, shape, component, expected, validation, refine):
    """The four ways in which a displaced piston feels a force, with their signs; the others are zero."""
    found = refine(lambda n: tuple(force(at, SMALL * CLEARANCE * shape, (2 * n, n))), (16, 32, 64))
    one = found[component]
    validation(
        case="Piston gap, small displacement",
        source="closed form, first order of e/c",
        quantity=name,
        unit=unit,
        expected=expected,
        obtained=one.finest,
        tolerance=one.tolerance(rounding=10.0 * SMALL**2 * abs(expected)),
        order=one.order,
    )
    lever = np.array([1.0, 1.0, LENGTH, LENGTH])
    sizes = np.abs([f.finest for f in found]) / lever
    assert np.delete(sizes, component).max() < 10.0 * SMALL * sizes[component]


def test_force_follows_the_displacement_round_the_bore():
    """A displacement turned by a quarter turns the force and moment with it, sense of rotation included."""
    at = drive(velocity=2.0, piston_spin=220.0, bore_spin=200.0)
    position = 1e-6 * np.array([5.0, 2.0, -3.0, 6.0])
    turned = np.array([-position[1], position[0], -position[3], position[2]])
    fx, fy, mx, my = force(at, position)
    assert force(at, turned) == pytest.approx([-fy, fx, -my, mx], rel=1e-8)


def test_petroff_friction(validation):
    spinning = flooded(piston_spin=300.0, bore_spin=220.0, velocity=2.0)
    film = told(spinning, np.zeros(4))
    slip = (80.0 * RADIUS) ** 2 + 2.0**2
    validation(
        case="Piston gap, friction of a concentric piston",
        source="Petroff 1883",
        quantity="friction power, spin and sliding",
        unit="W",
        expected=VISCOSITY * slip * 2.0 * np.pi * RADIUS * LENGTH / CLEARANCE,
        obtained=film.friction_power,
        relative_tolerance=1e-9,
        note="exact on any mesh",
    )


def test_wall_power_under_pressure():
    """Moving with the pressure flow the piston is pulled by half the gap's pressure force, pi d c/2 dp v."""
    shear = VISCOSITY * 2.0**2 * 2.0 * np.pi * RADIUS * LENGTH / CLEARANCE
    pull = np.pi * 22e-3 * CLEARANCE / 2.0 * (PRESSURE - 1e6) * 2.0
    film = told(drive(velocity=2.0), np.zeros(4))
    assert film.friction_power == pytest.approx(shear - pull, rel=1e-9)


def test_leakage_over_what_is_engaged():
    """Flow falls as the engaged length grows; where the piston passes the guide's end, the guide counts."""
    position = pushed(0.6, (1.0, 0.0))
    lengths = (18.7e-3, 30e-3, 40e-3)
    flows = [told(drive(reach=length), position).leakage_flow * length for length in lengths]
    assert flows == pytest.approx([flows[0]] * 3, rel=1e-9)
    assert told(drive(reach=50e-3), position).leakage_flow * 40e-3 == pytest.approx(flows[0], rel=1e-9)


@pytest.mark.parametrize("velocity", [2.0, -2.0])
def test_a_barrel_that_passes_squeezes_the_oil_before_it(velocity, refine):
    """A concentric barrel sliding in its bore is, seen from itself, a fixed shape over a wall that slides.

    Long beside its clearance it is a plane slider: p' = 12 mu (-h v/2 - q)/h^3 between two ends at one pressure.
    """
    shape = PistonShape(2.0 * RADIUS, CLEARANCE, LENGTH, piston=Profile((Barrel(LENGTH, 6e-6),)))
    y = (np.arange(20000) + 0.5) * LENGTH / 20000
    h = CLEARANCE + 6e-6 * (2.0 * y / LENGTH - 1.0) ** 2
    past = -0.5 * velocity * np.mean(h**-2) / np.mean(h**-3)  # the barrel, of its perimeter
    slope = 12.0 * VISCOSITY * (-0.5 * velocity * h - past) / h**3
    pressure = 10e6 + np.cumsum(slope) * LENGTH / 20000

    def solve(n: int) -> float:
        found = told(flooded(velocity=velocity), np.zeros(4), (12, 2 * n), shape).loads
        assert found.pressure_max_at[1] == pytest.approx(y[pressure.argmax()], abs=LENGTH / n)
        return found.pressure_max

    found = refine(solve, (16, 32, 64))
    assert found.finest == pytest.approx(pressure.max(), abs=found.tolerance(1e-3 * np.ptp(pressure)))
    assert np.ptp(pressure) > 1e5


# At rest

DEPTH = 0.5 * LENGTH - 4e-3
SIDE = np.array([-800.0, 0.0])
RUNNING = {"chamber": 20e6, "velocity": 1.5, "piston_spin": 220.0, "bore_spin": 220.0}


def at_rest(at: PistonDrive, start: Array = NO_LOAD) -> GapFilm:
    film = PistonFilm(SHAPE, at, cells=(32, 8))
    return standing_piston_film(film, rest_from(FilmSolver(film.space_at(0.0)), standing_piston(film), 0.0, start))


def _turned(position: Array) -> Array:
    return np.array([-position[1], position[0], -position[3], position[2]])


@pytest.fixture(scope="module")
def carried() -> GapFilm:
    return at_rest(drive(**RUNNING, outer=lateral_force(LENGTH, DEPTH, SIDE)))


def test_found_position_balances(carried):
    """Force and moment recomputed from a cold film are the opposite of the load's."""
    assert carried.carried_fraction == pytest.approx(1.0, abs=1e-5)
    found = force(drive(**RUNNING), carried.position, (32, 8))
    arm = 0.5 * LENGTH - DEPTH
    assert found == pytest.approx([800.0, 0.0, 800.0 * arm, 0.0], abs=1e-4 * 800.0)


def test_rest_turns_with_the_load(carried):
    answer = at_rest(drive(**RUNNING, outer=lateral_force(LENGTH, DEPTH, np.array([0.0, -800.0]))))
    assert answer.position == pytest.approx(_turned(carried.position), abs=1e-4 * CLEARANCE)


def test_load_at_mid_length_leaves_the_piston_parallel():
    """With one pressure at both ends and no sliding nothing tells the ends apart."""
    middle = lateral_force(LENGTH, 0.5 * LENGTH, SIDE)
    answer = at_rest(flooded(piston_spin=220.0, bore_spin=220.0, outer=middle))
    assert answer.position[2:] == pytest.approx(answer.position[:2], abs=1e-4 * CLEARANCE)


@pytest.mark.parametrize("ratio", [0.6, 0.97])
def test_rest_does_not_depend_on_the_start(ratio, carried):
    start = pushed(ratio, tuple(SIDE))
    answer = at_rest(drive(**RUNNING, outer=lateral_force(LENGTH, DEPTH, SIDE)), start)
    assert answer.position == pytest.approx(carried.position, abs=1e-3 * CLEARANCE)


def test_smooth_walls_do_not_bear_what_the_film_does_not():
    """A side force far outside the bore presses the piston on its bore: told, not a number."""
    outside = lateral_force(LENGTH, -30e-3, np.array([-4000.0, 0.0]))
    with pytest.raises(FilmNotConverged, match="no rest"):
        at_rest(drive(**RUNNING, outer=outside))
