"""Heat balance of `film_heating` against films solved with heat: REF90's slipper and valve plate."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from bench_pump import BENCH

from gaps import floating_slipper, standing_block
from gaps.revolution.film_heat import GapHeat, local_law, wall_image
from gaps.standing.conductances import kidney_conductances, slipper_land_conductance
from reynolds import FilmSolver, dynamic_viscosity, held_at
from reynolds.problem import HALF
from reynolds.thermal.coupling import ThermalCase, agree
from reynolds.thermal.film_profile import levels
from system import SMOOTH, BenchState, Gap, GapCourse, Rotor, floating_parts, load_pump, operating_point, rotor
from system.effects.laws.film import THROTTLING_HEAT, HeatShares, film_rise
from system.effects.state import warmed
from system.films.heat import block_heat, slipper_heat
from system.films.instant import chambers_at
from system.films.positions import given_block, given_slipper, instant_drives
from system.films.problems import block_film, slipper_film

RPM = np.pi / 30
REF90 = load_pump(BENCH)
PARTS = floating_parts(REF90)
RESISTANCE = 6.6e-5  # m2 K/W, one for all: fitted to 18 films a gap, docs/theory.md
ANGLE = {Gap.SLIPPER: 1.5 * np.pi, Gap.VALVE_PLATE: 0.1}
WALLS, SETTLED = 30, 0.05  # rounds, K


def running(rpm: float, pressure: float, celsius: float) -> Rotor:
    kelvin = celsius + 273.15
    point = replace(
        operating_point(REF90), shaft_speed=rpm * RPM, displacement_ratio=1.0, delivery_pressure=pressure,
        inlet_pressure=0.0, case_pressure=0.0, temperature=kelvin,
        viscosity=float(dynamic_viscosity(REF90.oil.fluid, kelvin)),
    )  # fmt: skip
    return rotor(REF90, point)


def standing(gap: Gap, at: Rotor, pressure: float):
    """Film, solver, stage, conductance (m3/(s Pa)) of a film, heat of the gap."""
    angle = ANGLE[gap]
    if gap is Gap.SLIPPER:
        drive = instant_drives(at, PARTS, angle, np.array([pressure])).slipper
        film = slipper_film(at, PARTS, drive, SMOOTH, (8, 32))
        solver, heat = FilmSolver(film.space), slipper_heat(at, PARTS)
        stage = held_at(solver, floating_slipper(film), angle / drive.shaft_speed, given_slipper(at, angle))
        return film, solver, stage, lambda one: slipper_land_conductance(solver, film, one), heat
    drive = instant_drives(at, PARTS, angle, chambers_at(at, angle, pressure)).block
    film = block_film(at, PARTS, drive, SMOOTH, (6, 24))
    solver, heat = FilmSolver(film.space), block_heat(at, PARTS)
    stage = held_at(solver, standing_block(film), angle / drive.shaft_speed, given_block(REF90))
    return film, solver, stage, lambda one: float(kidney_conductances(solver, film, one).sum()), heat


def warm(solver: FilmSolver, cold, heat: GapHeat):
    """The film of the viscosity that its own temperature makes, walls as warm as their resistances let them be."""
    given = cold.solution.problem
    problem = replace(given, film=replace(given.film, couette_viscosity=None, moving_share=HALF))
    walls, found = heat.outside, None
    area = problem.space.area
    passing = float(np.sum(heat.conductivity / problem.film.thickness * area) / area.sum())
    for _ in range(WALLS):
        posed = ThermalCase(problem, local_law(problem, heat), heat.of(problem, walls), at_once=True)
        found = agree(posed, levels(), 1e-3, solver, found)
        taken = np.array([found.heat.to_fixed, found.heat.to_moving]) / area.sum()
        before, walls = walls, wall_image(heat, walls, taken, passing)
        if np.abs(walls - before).max() < SETTLED:
            return found
    raise AssertionError("walls have not settled")


def law_of(gap: Gap, at: Rotor, pressure: float, leakage: float, shear: float, area: float):
    """Film's rise by the law; the film's heat knows no compression: throttling warms by dp/(rho c)."""
    plate, slipper = REF90.valve_plate, REF90.slipper
    width, speed, film = {
        Gap.SLIPPER: (
            2 * slipper.land_outer_radius, at.point.shaft_speed * REF90.pump.pitch_radius, slipper.film_thickness
        ),
        Gap.VALVE_PLATE: (
            plate.land_radius_4 - plate.land_radius_1, at.point.shaft_speed * plate.kidney_pitch_radius,
            plate.film_thickness,
        ),
    }[gap]  # fmt: skip
    plain = pressure / THROTTLING_HEAT
    one = np.ones((1, 1))
    course = GapCourse(
        pressure=plain * one, sliding_speed=speed * one, film=film * one, normal_force=one, coulomb=0 * one,
        viscous=shear * one, leakage=leakage * one, width=np.array([width]), land_area=np.array([area]),
    )  # fmt: skip
    nothing = np.zeros(1)
    kelvin, viscosity = np.array([at.point.temperature]), np.array([at.point.viscosity])
    state = BenchState(*([nothing] * 5), viscosity, kelvin, nothing, REF90)
    return state, float(film_rise(RESISTANCE, HeatShares(), course, state)[0])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("gap", "rpm", "pressure", "celsius", "tolerance"),
    [
        (Gap.SLIPPER, 500, 35e6, 35, 0.1), (Gap.SLIPPER, 2100, 5e6, 35, 0.1), (Gap.SLIPPER, 2100, 35e6, 35, 0.1),
        (Gap.SLIPPER, 1200, 20e6, 70, 0.1), (Gap.SLIPPER, 500, 35e6, 70, 0.1),
        (Gap.VALVE_PLATE, 2100, 20e6, 35, 0.2), (Gap.VALVE_PLATE, 1200, 35e6, 70, 0.2),
    ],
)  # fmt: skip
def test_a_warm_film_leaks_as_its_heat_balance_says(validation, gap, rpm, pressure, celsius, tolerance):
    """One resistance for both gaps; three times the scatter of 18 films, .03 and .07, is allowed."""
    at = running(rpm, pressure, celsius)
    film, solver, cold, conductance, heat = standing(gap, at, pressure)
    found = warm(solver, cold, heat)
    thinned = conductance(SimpleNamespace(solution=found.film)) / conductance(cold)
    half = 1.0 if gap is Gap.SLIPPER else 0.5  # of the ring's kidneys under pressure
    rubbed = film.wall_shear(cold)
    shear = (rubbed.heat() if gap is Gap.SLIPPER else rubbed.heat(film.is_film(cold.solution.problem.space))).shear
    area = float(found.film.problem.space.area.sum())
    state, rise = law_of(gap, at, pressure, half * conductance(cold) * pressure, shear, area)
    validation(
        case="Warm film at a given position",
        source="film solved with heat across and along it, walls of their parts' resistance",
        quantity=f"ln of leakage over cold, {gap.value}, {rpm} rpm, {pressure / 1e6:g} MPa, {celsius} degC",
        unit="-",
        expected=float(np.log(thinned)),
        obtained=float(-np.log(warmed(state, np.array([rise]))[0])),
        relative_tolerance=tolerance,
    )
