"""The gaps: slipper.

A parallel slipper at rest is a disc land behind a capillary and has closed forms for everything; a tilted one has
the tables, and to first order of its tilt the closed form derived here.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gaps.result import SMALLEST_FILM, GapFilm, PositionSource
from gaps.slipper import (
    SlipperGap,
    SlipperGeometry,
    SlipperLoad,
    SlipperPosition,
    SlipperState,
    hagen_poiseuille_conductance,
)
from gaps.slipper_lands import SlipperLands
from system.instants import rotor, slipper_instant
from system.leakage import slipper_conductance
from system.operating import operating_point
from system.pump_file import load_pump

INNER, OUTER, ORIFICE, ORIFICE_LENGTH = 8.2e-3, 14e-3, 0.9e-3, 5e-3
GEOMETRY = SlipperGeometry(SlipperLands(((INNER, OUTER),)), ORIFICE, ORIFICE_LENGTH)
TABLES = SlipperGeometry(SlipperLands(((5e-3, 10e-3),)), 2e-3, 5e-3)
VISCOSITY, PRESSURE, CASE = 0.0258, 35e6, 0.15e6
LOG = np.log(OUTER / INNER)
EFFECTIVE_AREA = np.pi * (OUTER**2 - INNER**2) / (2.0 * LOG)
LAND_AREA = np.pi * (OUTER**2 - INNER**2)
MESHES = (8, 16, 32)
PARALLEL = SlipperPosition(10e-6, 0.0, 0.0)
NO_LOAD = SlipperLoad(1.0, 0.0, 0.0)
AT_REST = SlipperState(PRESSURE, CASE, -1e5, VISCOSITY, 0.0, 0.0)


def gap(n: int, geometry: SlipperGeometry = GEOMETRY) -> SlipperGap:
    return SlipperGap(geometry, (n, 6 * n))


def land_conductance(thickness: float) -> float:
    return np.pi * thickness**3 / (6.0 * VISCOSITY * LOG)


def test_parallel_slipper_at_rest(validation, refine):
    """Orifice and land in series share the pressure as their resistances; the land's profile is logarithmic."""
    orifice = hagen_poiseuille_conductance(ORIFICE, ORIFICE_LENGTH, VISCOSITY)
    series = slipper_conductance(LOG, 40e-6, ORIFICE, ORIFICE_LENGTH, VISCOSITY)
    flow = series * (PRESSURE - CASE)
    pocket = PRESSURE - flow / orifice
    assert (PRESSURE - pocket) / PRESSURE > 0.01  # thick enough a film for the orifice to count
    thick = SlipperPosition(40e-6, 0.0, 0.0)

    def solve(n: int) -> tuple[float, ...]:
        ring = gap(n)
        film = ring.at(AT_REST, NO_LOAD, thick)
        assert film.leakage_flow == pytest.approx(film.chamber_flow, rel=1e-9)
        return film.chamber_flow, film.conductance, ring.pocket_pressure(film.solution), film.carried_load

    quantities = (
        ("leakage", "m3/s", flow, "paper equation (16)"),
        ("conductance", "m3/(s Pa)", series, "paper equation (16)"),
        ("pocket pressure", "Pa", pocket, "closed form"),
        ("lift with the pocket", "N", EFFECTIVE_AREA * (pocket - CASE), "closed form, logarithmic profile"),
    )
    for (quantity, unit, expected, source), found in zip(quantities, refine(solve, MESHES), strict=True):
        validation(
            case="Slipper gap, parallel slipper behind its orifice",
            source=source,
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=found.finest,
            tolerance=found.tolerance(),
            order=found.order,
        )


def test_friction_of_sliding_and_spin(validation, refine):
    moving = replace(AT_REST, chamber_pressure=CASE, sliding_speed=9.9, spin=220.0)
    polar = np.pi / 2.0 * (OUTER**4 - INNER**4)

    def solve(n: int) -> tuple[float, float]:
        film = gap(n).at(moving, NO_LOAD, PARALLEL)
        return film.friction_power, -film.loads.friction_torque_moving

    shear = VISCOSITY / PARALLEL.film_thickness
    exact = (
        ("friction power", "W", shear * (LAND_AREA * 9.9**2 + polar * 220.0**2)),
        ("spin torque", "N m", shear * polar * 220.0),
    )
    for (quantity, unit, expected), found in zip(exact, refine(solve, MESHES), strict=True):
        validation(
            case="Slipper gap, friction of a parallel film",
            source="closed form, Newton's shear",
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=found.finest,
            tolerance=found.tolerance(),
            order=found.order,
        )


@pytest.mark.parametrize(
    ("speed", "side", "lift", "moment", "flow"),
    [
        (0.0, 1.0, 3456.681, -1.174660, 5.946517e-7),
        (10.0, 1.0, 4163.694, -4.07860, 1.62567e-7),
        (2.0, -1.0, 3315.278, 0.59387, 6.41799e-7 + 2.0 * 10e-6 * 0.5 * np.pi * 5e-3**2 / (2.0 * 10e-3)),
    ],
    ids=["at rest", "thick side ahead", "thick side behind"],
)
def test_tilted_slipper_of_the_tables(speed, side, lift, moment, flow, validation, refine):
    """The tables move the wall towards the larger film; here the slipper slides along +x over a wall at rest.

    The tables hold the pocket at 20 MPa: the chamber's pressure is higher by what the orifice takes (0.01 %).
    """
    orifice = hagen_poiseuille_conductance(TABLES.orifice_diameter, TABLES.orifice_length, 0.03)
    at = SlipperState(20e6 + flow / orifice, 0.0, -1e5, 0.03, speed, 0.0)
    tilted = SlipperPosition(10e-6, side * 0.5 * 10e-6 / 10e-3, 0.0)

    def solve(n: int) -> tuple[float, float, float]:
        ring = gap(n, TABLES)
        film = ring.at(at, NO_LOAD, tilted)
        _, about_x, about_y = ring.force(film.solution, at)
        assert abs(about_x) < 1e-9 * lift * OUTER
        return film.carried_load, -about_y, film.chamber_flow

    quantities = (
        ("lift with the pocket", "N", lift, 0.5e-3),
        ("moment integral of p x", "N m", moment, 0.5e-5),
        ("flow out of the pocket", "m3/s", flow, 1e-12),
    )
    for (quantity, unit, expected, rounding), found in zip(quantities, refine(solve, MESHES), strict=True):
        validation(
            case="Slipper gap, tilted slipper",
            source="verification cases 3.9, converged polar solution",
            quantity=f"{quantity}, a = {0.5 * side:g}, sliding {speed:g} m/s",
            unit=unit,
            expected=expected,
            obtained=found.finest,
            tolerance=found.tolerance(rounding),
            order=found.order,
        )


def small_tilt_moment(rise: float, tilt: float) -> float:
    """Integral of p x (N m) of h = h0 (1 + tilt x/r2), first order of the tilt; `rise` is the pocket's pressure.

    p' = f(r) cos: f'' + f'/r - f/r^2 = 3 tilt rise/(r2 ln(r2/r1) r), f zero at both radii.
    """
    source = 3.0 * tilt * rise / (OUTER * LOG)
    radius = np.array([INNER, OUTER])
    outward, inward = np.linalg.solve(
        np.column_stack([radius, 1.0 / radius]), -0.5 * source * radius * np.log(radius)
    )
    logarithmic = (radius**4 / 4.0) * (np.log(radius) - 0.25)
    integral = 0.5 * source * logarithmic + outward * radius**4 / 4.0 + inward * radius**2 / 2.0
    return float(np.pi * (integral[1] - integral[0]))


def balanced_thickness(load: float) -> float:
    """Where lift equals load: the pocket's pressure follows from the load, the film from the orifice's flow."""
    pocket = load / EFFECTIVE_AREA
    through = hagen_poiseuille_conductance(ORIFICE, ORIFICE_LENGTH, VISCOSITY) * (PRESSURE - CASE - pocket)
    return float((6.0 * VISCOSITY * LOG * through / (np.pi * pocket)) ** (1.0 / 3.0))


OVERBALANCED = 0.97 * EFFECTIVE_AREA * (PRESSURE - CASE)
"""A load (N) below what the slipper would hold with the whole chamber pressure in its pocket."""


def test_overbalanced_slipper_floats(validation, refine):
    def solve(n: int) -> float:
        film = gap(n).balanced(AT_REST, SlipperLoad(OVERBALANCED, 0.0, 0.0), PARALLEL)
        assert film.source is PositionSource.BALANCE
        assert film.carried_fraction == pytest.approx(1.0, abs=1e-5)
        assert np.abs(film.position[1:]).max() * OUTER < 1e-4 * film.position[0]
        return float(film.position[0])

    found = refine(solve, MESHES)
    validation(
        case="Slipper gap, floating film of an overbalanced slipper",
        source="closed form, lift = load and orifice flow = land flow",
        quantity="film thickness",
        unit="m",
        expected=balanced_thickness(OVERBALANCED),
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


@pytest.mark.parametrize("thickness", [0.5 * SMALLEST_FILM, SMALLEST_FILM, 1e-3])
def test_given_film_out_of_range_is_a_start_like_any_other(thickness):
    """A given film too thin or too thick for a balance, and tilted, does not keep the balance from being found."""
    given = SlipperPosition(thickness, 0.2 * thickness / OUTER, -0.1 * thickness / OUTER)
    film = gap(8).balanced(AT_REST, SlipperLoad(OVERBALANCED, 0.0, 0.0), given)
    assert film.source is PositionSource.BALANCE
    assert film.position[0] == pytest.approx(balanced_thickness(OVERBALANCED), rel=0.01)


def _tilted_by(moment_x: float, moment_y: float, n: int = 16) -> GapFilm:
    film = gap(n).balanced(AT_REST, SlipperLoad(OVERBALANCED, moment_x, moment_y), PARALLEL)
    assert film.source is PositionSource.BALANCE
    return film


def test_moment_tilts_the_slipper(validation, refine):
    """A load that wants p x > 0 opens the film at -x; size from the closed form, first order of the tilt."""
    tilt = 1e-3
    moment = small_tilt_moment(OVERBALANCED / EFFECTIVE_AREA, tilt)
    assert moment < 0.0
    found = refine(lambda n: float(_tilted_by(0.0, -moment, n).position[1]), MESHES)
    expected = tilt * balanced_thickness(OVERBALANCED) / OUTER
    validation(
        case="Slipper gap, tilt under a small moment",
        source="closed form, first order of the tilt",
        quantity="slope dh/dx",
        unit="rad",
        expected=expected,
        obtained=found.finest,
        tolerance=found.tolerance(rounding=10.0 * tilt**2 * expected)
        + 1e-6 * OUTER * OVERBALANCED / abs(moment) * expected,
        order=found.order,
    )


def test_tilt_is_symmetric_and_turns_with_the_moment():
    moment = 0.01 * OVERBALANCED * OUTER
    ahead, behind, left = _tilted_by(0.0, moment), _tilted_by(0.0, -moment), _tilted_by(-moment, 0.0)
    thickness, slope, none = ahead.position
    assert slope > 0.0
    near = 1e-4 * thickness / OUTER
    assert none == pytest.approx(0.0, abs=near)
    assert behind.position == pytest.approx([thickness, -slope, 0.0], abs=near)
    assert left.position == pytest.approx([thickness, 0.0, slope], abs=near)


def test_found_position_balances_while_sliding():
    """Force and moments recomputed from a cold film are the load's."""
    sliding = replace(AT_REST, sliding_speed=9.9, spin=20.0)
    load = SlipperLoad(OVERBALANCED, 0.3, -0.2)
    film = gap(12).balanced(sliding, load, PARALLEL)
    assert film.source is PositionSource.BALANCE
    cold = gap(12)
    found = cold.force(cold.solve(sliding, SlipperPosition(*film.position)), sliding)
    scale = load.force * np.array([1.0, OUTER, OUTER])
    assert found / scale == pytest.approx(np.array([load.force, 0.3, -0.2]) / scale, abs=2e-6)


def test_ref90_is_underbalanced(validation):
    """Full chamber pressure under the parallel film holds 0.955 of the piston's push; no film holds it all."""
    pump = load_pump("ref90")
    area = np.pi / 4.0 * pump.pump.piston_diameter**2
    load = SlipperLoad(area * (PRESSURE - CASE) / np.cos(pump.pump.swash_angle_max), 0.0, 0.0)
    film = gap(16).balanced(AT_REST, load, PARALLEL)
    assert film.source is PositionSource.GIVEN
    assert "no film" in film.verdict
    assert film.position == pytest.approx([10e-6, 0.0, 0.0])
    validation(
        case="Slipper gap, hydrostatic balance of REF90",
        source="physics/ref90.md",
        quantity="carried share, 35 MPa, parallel film of 10 um at rest",
        unit="1",
        expected=0.955,
        obtained=film.carried_fraction,
        tolerance=0.5e-3,
        note="rounding of the reference",
    )


def test_pulled_slipper_is_no_film():
    film = gap(8).balanced(AT_REST, SlipperLoad(-120.0, 0.0, 0.0), PARALLEL)
    assert film.source is PositionSource.GIVEN
    assert "pulled off the plate (120 N" in film.verdict
    assert film.required_load == 0.0


@pytest.mark.parametrize("shaft_angle", [0.5, 2.0, 4.0, 5.5])
def test_centrifugal_force_presses_the_inner_side(shaft_angle):
    """The centre of mass lies behind the ball as seen from the block: swung outwards it lifts the outer side.

    The outward side is to the right of the motion, at -y; the film must therefore hold more at +y.
    """
    pump = load_pump("ref90")
    point = operating_point(pump)
    group = rotor(pump, point)
    _, load, _ = slipper_instant(group, shaft_angle, PRESSURE)
    radius, speed = pump.pump.pitch_radius, point.shaft_speed
    swing = pump.slipper.mass * radius * speed**2 * pump.slipper.centre_of_mass_to_ball
    assert load.moment_x == pytest.approx(swing, rel=0.15)  # the path on the plate is an ellipse, not a circle
    assert abs(load.moment_y) < 0.15 * swing
    floating = SlipperLoad(OVERBALANCED, load.moment_x, load.moment_y)
    film = gap(8).balanced(AT_REST, floating, PARALLEL)
    assert film.source is PositionSource.BALANCE
    assert film.position[2] < 0.0  # thin on the inner side, +y
