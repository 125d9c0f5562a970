"""The gaps: slipper.

A parallel slipper at rest is a disc land behind a capillary and has closed forms for everything; a tilted one has
the tables, and to first order of its tilt the closed form derived here.
"""

from __future__ import annotations

import numpy as np
import pytest

from gaps import (
    Active,
    GapFilm,
    PocketOrifice,
    SlipperDrive,
    SlipperFilm,
    SlipperLands,
    SlipperShape,
    constant,
    face_force,
    floating_slipper,
)
from gaps.films.slipper import hagen_poiseuille_conductance
from gaps.standing.conductances import slipper_conductance as conductance_of
from gaps.standing.gap_film import rest_from, standing_slipper_film
from reynolds import Array, FilmNotConverged, FilmSolver, FloatingStage, held_at
from system import floating_parts, load_pump, operating_point, rotor, slipper_conductance
from system.films.positions import instant_drives

INNER, OUTER, ORIFICE, ORIFICE_LENGTH = 8.2e-3, 14e-3, 0.9e-3, 5e-3
SHAPE = SlipperShape(SlipperLands(((INNER, OUTER),)), PocketOrifice(ORIFICE, ORIFICE_LENGTH))
TABLES = SlipperShape(SlipperLands(((5e-3, 10e-3),)), PocketOrifice(2e-3, 5e-3))
VISCOSITY, PRESSURE, CASE = 0.0258, 35e6, 0.15e6
LOG = np.log(OUTER / INNER)
EFFECTIVE_AREA = np.pi * (OUTER**2 - INNER**2) / (2.0 * LOG)
LAND_AREA = np.pi * (OUTER**2 - INNER**2)
MESHES = (8, 16, 32)
PARALLEL = np.array([10e-6, 0.0, 0.0])


def drive(
    chamber: float = PRESSURE, sliding: float = 0.0, load: tuple[float, float, float] = (1.0, 0.0, 0.0), **changed
) -> SlipperDrive:
    """A slipper at rest under 35 MPa; load: lift N and int p x, int p y N m that its film must give."""
    outer = face_force(OUTER, load[0], np.array(load[1:]))
    usual = {
        "shaft_speed": 220.0,
        "viscosity": VISCOSITY,
        "density": 860.0,
        "case_pressure": CASE,
        "cavitation_pressure": -1e5,
        "spin": 0.0,
        "chamber_pressure": constant(chamber),
        "sliding": constant(sliding, 0.0),
        "outer": constant(*outer),
    }
    return SlipperDrive(**(usual | changed))


def held(n: int, at: SlipperDrive, position: Array, shape: SlipperShape = SHAPE) -> tuple[SlipperFilm, FloatingStage]:
    film = SlipperFilm(shape, at, cells=(n, 6 * n))
    return film, held_at(FilmSolver(film.space), floating_slipper(film), 0.0, position)


def at_rest(n: int, at: SlipperDrive, start: Array = PARALLEL) -> GapFilm:
    film = SlipperFilm(SHAPE, at, cells=(n, 6 * n))
    return standing_slipper_film(film, rest_from(FilmSolver(film.space), floating_slipper(film), 0.0, start))


def land_conductance(thickness: float) -> float:
    return np.pi * thickness**3 / (6.0 * VISCOSITY * LOG)


def test_parallel_slipper_at_rest(validation, refine):
    """Orifice and land in series share the pressure as their resistances; the land's profile is logarithmic."""
    orifice = hagen_poiseuille_conductance(ORIFICE, ORIFICE_LENGTH, VISCOSITY)
    series = slipper_conductance(LOG, 40e-6, ORIFICE, ORIFICE_LENGTH, VISCOSITY)
    flow = series * (PRESSURE - CASE)
    pocket = PRESSURE - flow / orifice
    assert (PRESSURE - pocket) / PRESSURE > 0.01  # thick enough a film for the orifice to count

    def solve(n: int) -> tuple[float, ...]:
        film, stage = held(n, drive(), np.array([40e-6, 0.0, 0.0]))
        told = standing_slipper_film(film, stage)
        assert told.leakage_flow == pytest.approx(told.chamber_flow, rel=1e-9)
        conductance = conductance_of(FilmSolver(film.space), film, stage)
        return told.chamber_flow, conductance, film.supplied(stage)[0], told.carried_load

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
    moving = drive(CASE, 9.9, spin=220.0)
    polar = np.pi / 2.0 * (OUTER**4 - INNER**4)

    def solve(n: int) -> tuple[float, float]:
        told = standing_slipper_film(*held(n, moving, PARALLEL))
        return told.friction_power, -told.loads.friction_torque_moving

    shear = VISCOSITY / PARALLEL[0]
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
    orifice = hagen_poiseuille_conductance(TABLES.orifice.diameter, TABLES.orifice.length, 0.03)
    at = drive(20e6 + flow / orifice, speed, case_pressure=0.0, viscosity=0.03)
    tilted = np.array([10e-6, side * 0.5 * 10e-6, 0.0])

    def solve(n: int) -> tuple[float, float, float]:
        film, stage = held(n, at, tilted, TABLES)
        _, along_x, along_y = TABLES.outer_radius * stage.film_force
        assert abs(along_y) < 1e-9 * lift * OUTER
        told = standing_slipper_film(film, stage)
        return told.carried_load, along_x, told.chamber_flow

    quantities = (
        ("lift with the pocket", "N", lift, 0.5e-3),
        ("moment integral of p x", "N m", moment, 0.5e-5),
        ("flow out of the pocket", "m3/s", flow, 1e-12),
    )
    for (quantity, unit, expected, rounding), found in zip(quantities, refine(solve, MESHES), strict=True):
        validation(
            case="Slipper gap, tilted slipper",
            source="own converged polar solution",
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
    outward, inward = np.linalg.solve(np.column_stack([radius, 1.0 / radius]), -0.5 * source * radius * np.log(radius))
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
        film = at_rest(n, drive(load=(OVERBALANCED, 0.0, 0.0)))
        assert film.active == (Active.LIFT,)
        assert film.carried_fraction == pytest.approx(1.0, abs=1e-5)
        assert np.abs(film.position[1:]).max() < 1e-4 * film.position[0]
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


@pytest.mark.parametrize("thickness", [0.75e-6, 1e-3])
def test_any_start_leads_to_the_rest(thickness):
    """From a film far too thin or too thick, and tilted."""
    start = thickness * np.array([1.0, 0.2, -0.1])
    film = at_rest(8, drive(load=(OVERBALANCED, 0.0, 0.0)), start)
    usual = at_rest(8, drive(load=(OVERBALANCED, 0.0, 0.0)))
    assert film.position == pytest.approx(usual.position, abs=1e-4 * usual.position[0])


def _tilted_by(along_x: float, along_y: float, n: int = 16) -> GapFilm:
    return at_rest(n, drive(load=(OVERBALANCED, along_x, along_y)))


def test_moment_tilts_the_slipper(validation, refine):
    """A load that wants p x > 0 opens the film at -x; size from the closed form, first order of the tilt."""
    tilt = 1e-3
    moment = small_tilt_moment(OVERBALANCED / EFFECTIVE_AREA, tilt)
    assert moment < 0.0
    found = refine(lambda n: float(_tilted_by(moment, 0.0, n).position[1]) / OUTER, MESHES)
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
    moment = -0.01 * OVERBALANCED * OUTER
    ahead, behind, left = _tilted_by(moment, 0.0), _tilted_by(-moment, 0.0), _tilted_by(0.0, moment)
    thickness, rise, none = ahead.position
    assert rise > 0.0
    near = 1e-4 * thickness
    assert none == pytest.approx(0.0, abs=near)
    assert behind.position == pytest.approx([thickness, -rise, 0.0], abs=near)
    assert left.position == pytest.approx([thickness, 0.0, rise], abs=near)


def test_rest_balances_while_sliding():
    """Force and moments recomputed from a cold film are the load's."""
    load = (OVERBALANCED, 0.2, 0.3)
    at = drive(sliding=9.9, spin=20.0, load=load)
    film = at_rest(12, at)
    _, stage = held(12, at, film.position)
    wanted = np.array([load[0], 0.2 / OUTER, 0.3 / OUTER])
    assert stage.film_force == pytest.approx(wanted, abs=1e-5 * OVERBALANCED)


def test_ref90_is_underbalanced(validation):
    """Full chamber pressure under the parallel film holds 0.955 of the piston's push; no smooth film bears it."""
    pump = load_pump("ref90")
    area = np.pi / 4.0 * pump.pump.piston_diameter**2
    load = (area * (PRESSURE - CASE) / np.cos(pump.pump.swash_angle_max), 0.0, 0.0)
    validation(
        case="Slipper gap, hydrostatic balance of REF90",
        source="REF90, worked out by hand",
        quantity="carried share, 35 MPa, parallel film of 10 um at rest",
        unit="1",
        expected=0.955,
        obtained=standing_slipper_film(*held(32, drive(load=load), PARALLEL)).carried_fraction,
        tolerance=0.5e-3,
        note="rounding of the reference",
    )
    with pytest.raises(FilmNotConverged, match="no rest"):
        at_rest(8, drive(load=load))


def test_pulled_slipper_finds_no_rest():
    film, stage = held(8, drive(load=(-120.0, 0.0, 0.0)), PARALLEL)
    assert standing_slipper_film(film, stage).required_load == 0.0
    with pytest.raises(FilmNotConverged, match="no rest"):
        at_rest(8, drive(load=(-120.0, 0.0, 0.0)))


@pytest.mark.parametrize("shaft_angle", [0.5, 2.0, 4.0, 5.5])
def test_centrifugal_force_presses_the_inner_side(shaft_angle):
    """The centre of mass lies behind the ball as seen from the block: swung outwards it lifts the outer side.

    The outward side is to the right of the motion; without friction in the joint the film must hold more inwards.
    """
    pump = load_pump("ref90", {"friction.piston_slipper_socket": 0.0})
    point = operating_point(pump)
    group = rotor(pump, point)
    found = instant_drives(group, floating_parts(pump), shaft_angle, np.array([PRESSURE]))
    forward = found.slipper.sliding(shaft_angle)
    forward = forward / np.hypot(*forward)
    inward, pressed = np.array([-forward[1], forward[0]]), found.group.pressed[0]
    swing = pump.slipper.mass * pump.pump.pitch_radius * point.shaft_speed**2 * pump.slipper.centre_of_mass_to_ball
    assert pressed @ inward == pytest.approx(swing, rel=0.15)  # the path on the plate is an ellipse, not a circle
    assert abs(pressed @ forward) < 0.15 * swing
    film = at_rest(8, drive(load=(OVERBALANCED, *pressed)))
    assert film.position[1:] @ inward < 0.0  # thin on the inner side
