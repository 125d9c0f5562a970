"""The gaps: piston.

Small eccentricities have closed forms: with h = c - e(y) cos(angle) the pressure changes by f(y) cos or g(y) sin,
where f'' - f/R^2 is what tilt and motion put in. Derived here and not in `gaps`; the film takes them to first
order of e/c.
"""

from __future__ import annotations

import numpy as np
import pytest

from gaps.piston import PistonGap, PistonGeometry, PistonLoad, PistonState, eccentric
from gaps.result import SMALLEST_FILM, GapFilm, PositionSource

GEOMETRY = PistonGeometry(diameter=22e-3, radial_clearance=15e-6)
RADIUS, CLEARANCE = 11e-3, 15e-6
LENGTH, VISCOSITY, PRESSURE = 40e-3, 0.0258, 35e6
SMALL = 1e-4  # e/c of the first-order closed forms
NO_LOAD = PistonLoad((0.0, 0.0), 0.0)


def state(**changed: float) -> PistonState:
    """A piston at rest with 35 MPa in the chamber and 1 MPa in the case, but for what is changed."""
    at_rest = {
        "engaged_length": LENGTH,
        "chamber_pressure": PRESSURE,
        "case_pressure": 1e6,
        "cavitation_pressure": -1e5,
        "viscosity": VISCOSITY,
        "velocity": 0.0,
        "piston_spin": 0.0,
        "bore_spin": 0.0,
    }
    return PistonState(**(at_rest | changed))


def flooded(**changed: float) -> PistonState:
    """The same pressure at both ends, too high for a cavity."""
    return state(chamber_pressure=10e6, case_pressure=10e6, **changed)


def force(gap: PistonGap, at: PistonState, position: np.ndarray) -> np.ndarray:
    return gap.force(gap.solve(at, position))


def bulge() -> float:
    """Integral over the length of 1 - cosh(s/R)/cosh(l/2R): how far end leakage lets a pressure rise (m)."""
    return LENGTH - 2.0 * RADIUS * np.tanh(LENGTH / (2.0 * RADIUS))


@pytest.mark.parametrize("ratio", [0.0, 0.6, 0.9])
def test_leakage_of_a_parallel_piston(ratio, validation, refine):
    pushed = eccentric(GEOMETRY, ratio, (1.0, 0.0))
    concentric = np.pi * 22e-3 * CLEARANCE**3 / (12.0 * VISCOSITY * LENGTH)

    def solve(n: int) -> tuple[float, float, float]:
        film = PistonGap(GEOMETRY, (n, n // 4)).at(state(), NO_LOAD, pushed)
        return film.chamber_flow, film.leakage_flow, film.conductance

    chamber, case, conductance = refine(solve, (24, 48, 96))
    assert case.finest == pytest.approx(chamber.finest, rel=1e-10)
    assert conductance.finest == pytest.approx(chamber.finest / (PRESSURE - 1e6), rel=1e-10)
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


@pytest.mark.parametrize("ratio", [0.0, 0.6])
def test_oil_carried_by_the_piston(ratio, validation):
    """At one pressure a parallel piston drags pi d c v/2 out with it, whatever its eccentricity."""
    moving = flooded(velocity=2.89)
    film = PistonGap(GEOMETRY).at(moving, NO_LOAD, eccentric(GEOMETRY, ratio, (0.6, 0.8)))
    validation(
        case="Piston gap, oil carried by the moving wall",
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
    at = state(
        engaged_length=length,
        chamber_pressure=30e6,
        case_pressure=0.0,
        viscosity=0.02,
    )

    def solve(n: int) -> tuple[float, ...]:
        gap = PistonGap(PistonGeometry(diameter, clearance), (2 * n, n))
        solution = gap.solve(at, tilted)
        return (*gap.force(solution), gap.at(at, NO_LOAD, tilted).chamber_flow)

    fx, fy, mx, my, flow = refine(solve, (24, 48, 96))
    assert np.abs([fy.finest, mx.finest / length, my.finest / length]).max() < 1e-9 * abs(fx.finest)
    for quantity, unit, expected, obtained, rounding in (
        ("side force", "N", -3722.951, fx, 0.5e-3),
        ("leakage", "m3/s", 2.447253e-7, flow, 0.5e-13),
    ):
        validation(
            case="Piston gap, tilted piston",
            source="verification cases 3.9, converged 2D",
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
        ("Fx, tilt under pressure", "N", state(), TILT, 0, _pressure_on_tilt()),
        ("Fx, tilt, piston sliding", "N", flooded(velocity=2.89), TILT, 0, _sliding_on_tilt()),
        ("Fy, offset, both walls spin", "N", SPINNING, OFFSET, 1, _spin_on_offset()),
        ("My, tilt, both walls spin", "N m", SPINNING, TILT, 3, _spin_on_tilt()),
    ],
    ids=["pressure", "sliding", "spin", "spin moment"],
)  # fmt: skip
def test_force_of_a_small_displacement(name, unit, at, shape, component, expected, validation, refine):
    """The four ways in which a displaced piston feels a force, with their signs; the others are zero."""
    found = refine(
        lambda n: tuple(force(PistonGap(GEOMETRY, (2 * n, n)), at, SMALL * CLEARANCE * shape)), (16, 32, 64)
    )
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
    gap = PistonGap(GEOMETRY)
    at = state(velocity=2.0, piston_spin=220.0, bore_spin=200.0)
    position = 1e-6 * np.array([5.0, 2.0, -3.0, 6.0])
    turned = np.array([-position[1], position[0], -position[3], position[2]])
    fx, fy, mx, my = force(gap, at, position)
    assert force(gap, at, turned) == pytest.approx([-fy, fx, -my, mx], rel=1e-8)


def test_petroff_friction(validation):
    spinning = flooded(piston_spin=300.0, bore_spin=220.0, velocity=2.0)
    film = PistonGap(GEOMETRY).at(spinning, NO_LOAD, np.zeros(4))
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
    film = PistonGap(GEOMETRY).at(state(velocity=2.0), NO_LOAD, np.zeros(4))
    assert film.friction_power == pytest.approx(shear - pull, rel=1e-9)


def test_engaged_length_needs_no_new_mesh():
    gap = PistonGap(GEOMETRY)
    pushed = eccentric(GEOMETRY, 0.6, (1.0, 0.0))
    films = [gap.at(state(engaged_length=length), NO_LOAD, pushed) for length in (45e-3, 30e-3, 18.7e-3, 45e-3)]
    products = [f.conductance * length for f, length in zip(films, (45e-3, 30e-3, 18.7e-3, 45e-3), strict=True)]
    assert products == pytest.approx([products[0]] * 4, rel=1e-9)
    assert all(f.solution.problem.space.dofs is films[0].solution.problem.space.dofs for f in films)


LOAD = PistonLoad((-800.0, 0.0), -0.5 * LENGTH + 4e-3)
RUNNING = state(chamber_pressure=20e6, velocity=1.5, piston_spin=220.0, bore_spin=220.0)


def _turned(position: np.ndarray) -> np.ndarray:
    return np.array([-position[1], position[0], -position[3], position[2]])


@pytest.fixture(scope="module")
def carried() -> GapFilm:
    return PistonGap(GEOMETRY).balanced(RUNNING, LOAD, np.zeros(4))


def test_found_position_balances(carried):
    """Force and moment recomputed from a cold film are the opposite of the load's."""
    assert carried.source is PositionSource.BALANCE
    assert carried.carried_fraction == pytest.approx(1.0, abs=1e-5)
    found = force(PistonGap(GEOMETRY), RUNNING, carried.position)
    arm = 0.5 * LENGTH + LOAD.arm
    expected = -np.array([-800.0, 0.0, -800.0 * arm, 0.0])
    assert found == pytest.approx(expected, abs=2e-6 * 800.0)
    assert carried.loads.film_thickness_min >= SMALLEST_FILM


def test_balance_turns_with_the_load(carried):
    sideways = PistonLoad((0.0, -800.0), LOAD.arm)
    answer = PistonGap(GEOMETRY).balanced(RUNNING, sideways, np.zeros(4))
    assert answer.source is PositionSource.BALANCE
    assert answer.position == pytest.approx(_turned(carried.position), abs=1e-4 * CLEARANCE)


def test_load_at_mid_length_leaves_the_piston_parallel():
    """With one pressure at both ends and no sliding nothing tells the ends apart."""
    spinning = flooded(piston_spin=220.0, bore_spin=220.0)
    answer = PistonGap(GEOMETRY).balanced(spinning, PistonLoad((-800.0, 0.0), -0.5 * LENGTH), np.zeros(4))
    assert answer.source is PositionSource.BALANCE
    assert answer.position[2:] == pytest.approx(answer.position[:2], abs=1e-4 * CLEARANCE)


def test_load_that_no_film_carries():
    """A side force far outside the bore stays where the description puts the piston, and says so."""
    given = eccentric(GEOMETRY, 0.6, (-1.0, 0.0))
    load = PistonLoad((-4000.0, 0.0), 30e-3)
    answer = PistonGap(GEOMETRY).balanced(RUNNING, load, given)
    assert answer.source is PositionSource.GIVEN
    assert answer.position == pytest.approx(given)
    assert "no film" in answer.verdict
    assert "4000 N" in answer.verdict
    assert answer.required_load == pytest.approx(4000.0)
    assert answer.carried_fraction != pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("ratio", [0.91, 0.97])
def test_given_position_at_the_wall_is_a_start_like_any_other(ratio, carried):
    """A given position that leaves less than the smallest film does not keep the balance from being found."""
    given = eccentric(GEOMETRY, ratio, LOAD.force)
    assert (1.0 - ratio) * CLEARANCE < SMALLEST_FILM
    found = PistonGap(GEOMETRY).balanced(RUNNING, LOAD, given)
    assert found.source is PositionSource.BALANCE
    assert found.position == pytest.approx(carried.position, abs=1e-3 * CLEARANCE)


def test_clearance_without_room_for_a_film():
    tight = PistonGeometry(diameter=22e-3, radial_clearance=SMALLEST_FILM)
    film = PistonGap(tight).balanced(state(), PistonLoad((10.0, 0.0), 0.0), eccentric(tight, 0.5, (1.0, 0.0)))
    assert film.source is PositionSource.GIVEN
    assert "no room" in film.verdict
