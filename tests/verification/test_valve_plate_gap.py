"""The gaps: valve plate.

With all chambers and ports at one pressure the ring has closed forms: a logarithmic profile over both lands and
the full pressure between them.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gaps.valve_plate import ValvePlateFilm, ValvePlateGap, ValvePlateGeometry, ValvePlatePosition, ValvePlateState
from system.leakage import valve_plate_conductance

RADII = (26.5e-3, 31.5e-3, 40.5e-3, 45.7e-3)
PISTONS, PITCH = 9, np.radians(40.0)
SUCTION, DELIVERY = tuple(np.radians([25.0, 155.0])), tuple(np.radians([205.0, 335.0]))
GEOMETRY = ValvePlateGeometry(RADII, PISTONS, np.radians(30.0), SUCTION, DELIVERY)
ALL_PORT = replace(GEOMETRY, suction_arc=(0.0, np.pi), delivery_arc=(np.pi, 2.0 * np.pi))
NO_PORT = replace(GEOMETRY, suction_arc=(1.5, 1.5), delivery_arc=(4.5, 4.5))
THICKNESS, VISCOSITY, PRESSURE, CASE, SPEED = 8e-6, 0.0258, 35e6, 0.15e6, 220.0
PARALLEL = ValvePlatePosition(THICKNESS, 0.0, 0.0)
MESHES = (4, 8, 16)


def state(**changed) -> ValvePlateState:
    """A block at rest, every chamber and port at 35 MPa, but for what is changed."""
    at_rest = {
        "shaft_angle": 0.0,
        "chamber_pressure": np.full(PISTONS, PRESSURE),
        "suction_pressure": PRESSURE,
        "delivery_pressure": PRESSURE,
        "case_pressure": CASE,
        "cavitation_pressure": -1e5,
        "viscosity": VISCOSITY,
        "shaft_speed": 0.0,
    }
    return ValvePlateState(**(at_rest | changed))


def running(**changed) -> ValvePlateState:
    """Half the chambers at 35 MPa, half at 2.5, as the ports have them, turning, no two pressures alike."""
    place = (np.arange(PISTONS) * PITCH + changed.get("shaft_angle", 0.0)) % (2.0 * np.pi)
    chambers = np.where(place > np.pi, PRESSURE, 2.5e6) * (1.0 + 0.01 * np.cos(place))
    usual = {"chamber_pressure": chambers, "suction_pressure": 2.5e6, "shaft_speed": SPEED}
    return state(**(usual | changed))


def ring(n: int, geometry: ValvePlateGeometry = GEOMETRY) -> ValvePlateGap:
    return ValvePlateGap(geometry, (n, 4 * n))


def test_one_pressure_all_round(validation, refine):
    """Ports that reach all round hold the webs; what is left is two lands with closed forms."""
    conductance = PISTONS * valve_plate_conductance(RADII, THICKNESS, PISTONS, VISCOSITY)

    def solve(n: int) -> tuple[float, float]:
        film = ring(n, ALL_PORT).at(state(), PARALLEL, 1.0)
        assert np.abs(film.separating_moment).max() < 1e-9 * film.separating_force * RADII[3]
        assert film.gap.friction_power == 0.0
        return film.gap.leakage_flow, film.separating_force

    r1, r2, r3, r4 = RADII
    mean_squares = (r4**2 - r3**2) / np.log(r4 / r3) - (r2**2 - r1**2) / np.log(r2 / r1)
    exact = (
        ("leakage", "m3/s", conductance * (PRESSURE - CASE), "paper equation (17), all round"),
        (
            "separating force",
            "N",
            np.pi / 2.0 * mean_squares * (PRESSURE - CASE),
            "closed form, logarithmic profile",
        ),
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
    force = refine(lambda n: ring(n, odd).at(state(), PARALLEL, 1.0).separating_force, MESHES)
    r1, r2, r3, r4 = RADII
    mean_squares = (r4**2 - r3**2) / np.log(r4 / r3) - (r2**2 - r1**2) / np.log(r2 / r1)
    expected = np.pi / 2.0 * mean_squares * (PRESSURE - CASE)
    assert force.finest == pytest.approx(expected, abs=force.tolerance())


def test_leakage_with_half_the_ring_at_pressure(validation):
    """Mean over a pitch; the lands between the ports stand at neither pressure, which equation (17) ignores."""
    gap, leakage = ring(8), []
    for shaft_angle in np.radians([0.0, 10.0, 20.0, 30.0]):
        place = (np.arange(PISTONS) * PITCH + shaft_angle) % (2.0 * np.pi)
        chambers = PRESSURE * np.where(np.isclose(np.sin(place), 0.0), 0.5, np.where(place > np.pi, 1.0, 0.0))
        still = state(shaft_angle=shaft_angle, chamber_pressure=chambers, suction_pressure=0.0, case_pressure=0.0)
        leakage.append(gap.at(still, PARALLEL, 1.0).gap.leakage_flow)
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
    tilted = ValvePlatePosition(THICKNESS, 4e-5, -3e-5)
    film = ring(8).at(running(shaft_angle=shaft_angle), tilted, 1.0)
    given = film.chamber_flows.sum() + film.suction_flow + film.delivery_flow
    assert film.gap.loads.cavity_flow == 0.0
    assert given == pytest.approx(film.gap.leakage_flow, abs=1e-10 * np.abs(film.chamber_flows).max())


@pytest.mark.parametrize("shaft_angle", [0.0, 0.3])
def test_power_of_walls_and_pressure_becomes_heat(shaft_angle):
    """Shear work of the block plus flow work of chambers and ports is the film's dissipation, webs left out.

    The chambers stand 1 % off the ports' pressure: a web over a port that passed oil between them would show.
    """
    at = running(shaft_angle=shaft_angle)
    film = ring(8).at(at, ValvePlatePosition(THICKNESS, 4e-5, -3e-5), 1.0)
    inflow = np.array([*film.chamber_flows, film.suction_flow, film.delivery_flow])
    above = np.array([*at.chamber_pressure, at.suction_pressure, at.delivery_pressure]) - CASE
    heat = film.gap.loads.dissipation
    assert film.gap.friction_power + inflow @ above == pytest.approx(heat, rel=1e-6)


def test_conductance_is_that_of_the_lands(refine):
    """A web over a port passes no oil: the sum for all kidneys stays near equation (17) on any mesh."""
    law = PISTONS * valve_plate_conductance(RADII, THICKNESS, PISTONS, VISCOSITY)
    coarse, middle, fine = (ring(n).at(running(), PARALLEL, 1.0).conductances for n in MESHES)
    assert coarse.sum() == pytest.approx(law, rel=0.25)
    # Kidney and web side by side at two pressures: the land's corner gives a logarithm of the mesh, no more.
    assert middle == pytest.approx(coarse, rel=0.07)
    assert fine == pytest.approx(middle, rel=0.07)


def test_one_pitch_on_is_the_same_film():
    """The next chamber takes the place of the last: same film, flows by one place."""
    gap = ring(8)
    first = running(shaft_angle=0.1)
    after = replace(first, shaft_angle=0.1 + PITCH, chamber_pressure=np.roll(first.chamber_pressure, -1))
    tilted = ValvePlatePosition(THICKNESS, 4e-5, -3e-5)
    one, two = gap.at(first, tilted, 1.0), gap.at(after, tilted, 1.0)
    assert np.roll(one.chamber_flows, -1) == pytest.approx(two.chamber_flows, rel=1e-6)
    assert one.separating_force == pytest.approx(two.separating_force, rel=1e-9)
    assert one.separating_moment == pytest.approx(two.separating_moment, rel=1e-6)
    assert one.gap.friction_power == pytest.approx(two.gap.friction_power, rel=1e-9)
    assert one.gap.leakage_flow == pytest.approx(two.gap.leakage_flow, rel=1e-9)


def test_kidneys_stand_where_the_chambers_are():
    """kidney_k is the hole at shaft angle + (k - 1) pitch: its edge carries chamber k's pressure."""
    at = running(shaft_angle=0.3, chamber_pressure=1e6 * np.arange(1.0, 10.0))
    solution = (gap := ring(4)).at(at, PARALLEL, 1.0).gap.solution
    space = solution.problem.space
    for k in range(PISTONS):
        nodes = space.edge_dofs[f"kidney_{k + 1}"]
        assert solution.pressure[nodes] == pytest.approx(1e6 * (k + 1))
        place = space.vertices[np.isin(space.vertex_dofs, nodes)].mean(axis=0)
        angle = np.arctan2(place[1], place[0]) - 0.3 - k * PITCH
        assert np.sin(angle) == pytest.approx(0.0, abs=1e-9)
        assert np.cos(angle) > 0.0
    assert gap.geometry.pistons == PISTONS


def test_mirrored_pressures_mirror_the_film_at_rest():
    gap = ring(8)
    one = running(shaft_speed=0.0)
    mirrored = replace(
        one,
        chamber_pressure=np.roll(one.chamber_pressure[::-1], 1),
        suction_pressure=one.delivery_pressure,
        delivery_pressure=one.suction_pressure,
    )
    left = gap.at(one, ValvePlatePosition(THICKNESS, 2e-5, 5e-5), 1.0)
    right = gap.at(mirrored, ValvePlatePosition(THICKNESS, 2e-5, -5e-5), 1.0)
    assert right.separating_force == pytest.approx(left.separating_force, rel=1e-9)
    assert right.separating_moment[0] == pytest.approx(-left.separating_moment[0], rel=1e-9)
    assert right.separating_moment[1] == pytest.approx(left.separating_moment[1], rel=1e-9)
    assert right.chamber_flows == pytest.approx(np.roll(left.chamber_flows[::-1], 1), rel=1e-8)


def test_tilt_is_pushed_back():
    """Where the film is thicker the pressure over the lands falls: less p x on that side."""
    tilt = 5e-5
    gap = ring(8, NO_PORT)
    _, about_y = gap.at(state(), ValvePlatePosition(THICKNESS, tilt, 0.0), 1.0).separating_moment
    about_x, _ = gap.at(state(), ValvePlatePosition(THICKNESS, 0.0, tilt), 1.0).separating_moment
    assert about_y > 0.0  # integral of -p x
    assert about_x == pytest.approx(-about_y, rel=1e-2)  # nine kidneys are nearly round


def test_friction_of_a_parallel_film(validation, refine):
    """mu w^2/h integral of r^2 over the film: both lands, and no webs under ports that reach all round."""
    r1, r2, r3, r4 = RADII
    turning = state(shaft_speed=2100.0 * np.pi / 30.0)
    shear = VISCOSITY * turning.shaft_speed**2 / THICKNESS
    lands = np.pi / 2.0 * (r2**4 - r1**4 + r4**4 - r3**4)
    webs = PISTONS / 4.0 * (PITCH - np.radians(30.0)) * (r3**4 - r2**4)
    for name, geometry, polar in (("both lands", ALL_PORT, lands), ("lands and webs", NO_PORT, lands + webs)):
        found = refine(lambda n, g=geometry: ring(n, g).at(turning, PARALLEL, 1.0).gap.friction_power, MESHES)
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
    film: ValvePlateFilm = ring(4).at(running(), PARALLEL, 50e3)
    assert film.gap.required_load == 50e3
    assert film.gap.carried_fraction == pytest.approx(film.separating_force / 50e3)
