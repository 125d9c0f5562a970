"""Film temperature with other physics: shear thinning, contact, elastic walls, thermal expansion, time."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_bvp
from scipy.optimize import brentq

from reynolds import (
    ISO_GRADES,
    ZERO,
    Adiabatic,
    Array,
    Asperities,
    Barus,
    Body as SolidBody,
    Carreau,
    Cavitation,
    Cell,
    Convecting,
    Elastic,
    FilmInputError,
    FilmNotConverged,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    Fluid,
    GivenTemperature,
    Heat,
    Held,
    Oil,
    Plane,
    Supports,
    Surface,
    block,
    body_wall,
    contact_pressure,
    film,
    film_space,
    heated_wall,
    loads,
    march_thermal,
    rectangle,
    solve_thermal,
    walther,
    winkler,
)
from reynolds.bodies.conduction import Convection, Thermal
from reynolds.laws.contact import boundary_shear
from reynolds.laws.viscosity import RoelandsIndex, barus
from reynolds.thermal.shear_thinning import newtonian
from reynolds.thermal.walls import ConductingBody, Wall

DENSITY, SPECIFIC_HEAT, CONDUCTIVITY = 860.0, 2000.0, 0.13
LENGTH, GAP, SPEED, VISCOSITY, INLET = 0.02, 1e-5, 10.0, 0.03, 313.15
SLIDING = (np.full((1, 1), SPEED), ZERO)
SIDES = ("left", "right", "bottom", "top")
CARREAU = Carreau(0.3, 1e-5, 0.6)
ROUGH = Surface(0.3e-6, 0.2e-6, 3.0, 1.0 / 3.0, lay_direction=0.4)
TOUCHING = Asperities(2e10, 5e-6, 0.3e-6, 100e9, 0.1, summit_height=0.3e-6)
BALANCE = 1e-9


def thinning(temperature, pressure):
    return barus(pressure, VISCOSITY * np.exp(-0.03 * (temperature - INLET)), 2e-8).value


def unheated(temperature, pressure):
    return barus(pressure, VISCOSITY + 0.0 * temperature, 2e-8).value


def constant(temperature, pressure):
    return VISCOSITY + 0.0 * temperature + 0.0 * pressure


def oil_heat(fixed: Wall, moving: Wall, names: tuple[str, ...] = SIDES, **more) -> Heat:
    return Heat(DENSITY, SPECIFIC_HEAT, CONDUCTIVITY, fixed, moving, dict.fromkeys(names, INLET), **more)


def square(cells: int) -> FilmSpace:
    return film_space(rectangle((LENGTH, LENGTH), (cells, cells), cell=Cell.QUADRILATERAL))


def wedge(space: FilmSpace, ratio: float = 2.0, outlet: float = GAP) -> FilmProblem:
    thickness = space.sample(lambda x, y: outlet * (ratio - (ratio - 1.0) * x / LENGTH))
    return FilmProblem(space, film(thickness, 1.0, velocity_moving=SLIDING), dict.fromkeys(SIDES, Held(0.0)))


def wave(space: FilmSpace, mean: float = GAP, speed: float = SPEED) -> FilmProblem:
    thickness = space.sample(lambda x, y: mean * (1.0 + 0.6 * np.cos(2.0 * np.pi * x / LENGTH)))
    sliding = (np.full((1, 1), speed), ZERO)
    return FilmProblem(space, film(thickness, 1.0, velocity_moving=sliding), dict.fromkeys(SIDES, Held(1e5)))


def endless() -> FilmSpace:
    """Sewn along the sliding: nothing varies in the plane."""
    return film_space(rectangle((LENGTH, LENGTH), (3, 3), cell=Cell.QUADRILATERAL, periodic_x=True))


def sheared(space: FilmSpace, thickness: float = GAP) -> FilmProblem:
    oil = film(thickness, 1.0, velocity_moving=SLIDING)
    return FilmProblem(space, oil, {"bottom": Held(0.0), "top": Held(0.0)}, cavitation=Cavitation.NONE)


def test_shear_and_temperature_across_couette(validation):
    """k T'' = -tau gamma with mu(T, gamma) gamma = tau between two given wall temperatures."""
    fixed, moving = INLET, INLET + 20.0

    def strain(stress, kelvin):
        low, high = np.zeros_like(kelvin), np.full_like(kelvin, 100.0 * SPEED / GAP)
        for _ in range(80):
            middle = 0.5 * (low + high)
            below = CARREAU(middle, thinning(kelvin, 0.0)) * middle < stress
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        return 0.5 * (low + high)

    def equations(zeta, y, free):
        gamma = strain(free[0], y[0])
        return np.vstack([y[1], -(GAP**2) * free[0] * gamma / CONDUCTIVITY, GAP * gamma])

    zeta = np.linspace(0.0, 1.0, 21)
    guess = np.vstack([fixed + (moving - fixed) * zeta, 20.0 + 0.0 * zeta, SPEED * zeta])
    exact = solve_bvp(
        equations,
        lambda a, b, free: np.array([a[0] - fixed, b[0] - moving, a[2], b[2] - SPEED]),
        zeta, guess, p=[0.3 * VISCOSITY * SPEED / GAP], tol=1e-8,
    )  # fmt: skip
    assert exact.success
    heat = oil_heat(GivenTemperature(fixed), GivenTemperature(moving), ("bottom", "top"))
    found = solve_thermal(sheared(endless()), heat, thinning, shear=CARREAU, count=10)
    done = loads(found.film)
    peak = found.heat.profile.levels.at(found.heat.temperature, np.linspace(0.0, 1.0, 401)).max()
    for quantity, unit, expected, obtained in (
        ("stress", "Pa", float(exact.p[0]), -done.friction_moving[0] / LENGTH**2),
        ("largest temperature", "K", float(exact.sol(np.linspace(0, 1, 401))[0].max()), float(peak)),
        ("heat into the moving wall", "W/m2", float(-CONDUCTIVITY / GAP * exact.y[1, -1]),
         found.heat.to_moving / LENGTH**2),
    ):  # fmt: skip
        validation(
            case="Couette flow of an oil thinning with shear and temperature",
            source="boundary value problem across the film (scipy.integrate.solve_bvp)",
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=obtained,
            relative_tolerance=2e-6,
            note="Carreau, mu0 falls with exp(-0.03 dT/K), 10 levels; tolerance: the rounds' own, 1e-6",
        )


@pytest.mark.parametrize("cavitation", list(Cavitation))
def test_pressure_law_is_the_films_own(cavitation):
    """An oil that pressure alone stiffens: the film of the same law in its fluid, between soft walls."""
    space = square(8)
    problem = replace(wedge(space), walls=winkler(space, 1e13), cavitation=cavitation)
    heat = oil_heat(GivenTemperature(INLET), GivenTemperature(INLET))
    plain = replace(problem, film=replace(problem.film, viscosity=np.full((1, 1), VISCOSITY)), fluid=Fluid(Barus(2e-8)))
    expected = FilmSolver(space).solve(plain).pressure
    found = solve_thermal(problem, heat, unheated, tolerance=1e-9)
    assert found.film.pressure == pytest.approx(expected, rel=1e-7, abs=1e-7 * expected.max())
    assert found.share == pytest.approx(np.ones_like(found.share), rel=1e-8)


def test_cold_oil_would_stiffen_without_bound():
    """A thin film whose cold oil has no solution under Roelands' law; the warm film is the same from elsewhere."""
    grade = ISO_GRADES["ISO VG 46"]
    oil = Oil(grade.kinematic_viscosity_40C, grade.kinematic_viscosity_100C, DENSITY, 1.6e9, SPECIFIC_HEAT)
    law = RoelandsIndex(0.6)

    def viscosity(temperature: Array, pressure: Array) -> Array:
        return law(pressure, walther(temperature, oil) * DENSITY).value

    space = square(8)
    heat = oil_heat(Adiabatic(), Adiabatic())
    faster = (np.full((1, 1), 2.0 * SPEED), ZERO)
    thin = wedge(space, outlet=5e-6)
    thin = replace(thin, film=replace(thin.film, velocity_moving=faster))
    cold = replace(
        thin,
        film=replace(thin.film, viscosity=np.full((1, 1), float(viscosity(np.array(INLET), np.array(0.0))))),
        fluid=Fluid(law),
    )
    with pytest.raises(FilmInputError, match="Roelands"):
        FilmSolver(space).solve(cold)
    found = solve_thermal(thin, heat, viscosity, tolerance=1e-8)
    start = None
    for outlet in (8e-6, 6.5e-6, 5e-6):
        film_there = replace(wedge(space, outlet=outlet).film, velocity_moving=faster)
        start = solve_thermal(replace(thin, film=film_there), heat, viscosity, tolerance=1e-8, start=start)
    assert found.film.pressure == pytest.approx(start.film.pressure, rel=1e-6)
    assert found.heat.temperature == pytest.approx(start.heat.temperature, rel=1e-7)


class _FailsOnce(FilmSolver):
    """A solver whose second film has no solution; viscosities: the mean of each film that it was given."""

    def __init__(self, space: FilmSpace):
        super().__init__(space)
        self.viscosities: list[float] = []

    def solve(self, problem, start=None):
        self.viscosities.append(float(np.mean(problem.film.viscosity)))
        if len(self.viscosities) == 2:
            raise FilmNotConverged("no film", "another one")
        return super().solve(problem, start)


def test_a_film_without_a_solution_is_sought_half_way_to_the_last():
    def thinning_alone(temperature, pressure):
        return VISCOSITY * np.exp(-0.03 * (temperature - INLET)) + 0.0 * pressure

    problem, heat = wedge(square(8)), oil_heat(Adiabatic(), Adiabatic())
    solver = _FailsOnce(problem.space)
    found = solve_thermal(problem, heat, thinning_alone, tolerance=1e-8, solver=solver)
    first, failed, sought = solver.viscosities[:3]
    assert sought == pytest.approx(np.sqrt(first * failed), rel=0.03)  # half way in logarithms
    assert found.film.pressure == pytest.approx(
        solve_thermal(problem, heat, thinning_alone, tolerance=1e-8).film.pressure, rel=1e-6
    )


def test_friction_of_contact_is_heat(validation):
    """Two rough walls in sliding contact at rest in the plane: both walls take what oil and asperities make."""
    thickness = 0.6e-6
    problem = replace(sheared(endless(), thickness), asperities=TOUCHING)
    heat = oil_heat(GivenTemperature(INLET), GivenTemperature(INLET), ("bottom", "top"))
    found = solve_thermal(problem, heat, constant).heat
    bears = contact_pressure(TOUCHING, thickness).value
    rubs = float(boundary_shear(TOUCHING, bears).value) * SPEED
    expected = VISCOSITY * SPEED**2 / thickness + rubs
    assert rubs > 0.1 * expected
    validation(
        case="Heat of sliding contact",
        source="mu U^2/h + tau_c U, tau_c of the contact's law",
        quantity="heat into both walls",
        unit="W/m2",
        expected=expected,
        obtained=(found.to_fixed + found.to_moving) / LENGTH**2,
        relative_tolerance=BALANCE,
    )
    assert found.energy_balance_error < BALANCE


@pytest.mark.parametrize("shear", [newtonian, CARREAU], ids=["Newtonian", "Carreau"])
@pytest.mark.parametrize("which", ["smooth", "rough", "soft", "touching", "all"])
def test_everything_at_once(which, shear):
    """A film with a cavity: whatever the walls do, the film's dissipation is the heat, and both balances close."""
    space = square(10)
    problem = wave(space, 3e-6, 1.0) if which in ("touching", "all") else wave(space)
    if which in ("rough", "touching", "all"):
        problem = replace(problem, surface=ROUGH)
    if which in ("soft", "all"):
        problem = replace(problem, walls=winkler(space, 2e13))
    if which in ("touching", "all"):
        problem = replace(problem, asperities=TOUCHING)
    heat = oil_heat(Convecting(2e4, INLET), GivenTemperature(INLET + 10.0), expansion=7e-4)
    found = solve_thermal(problem, heat, thinning, shear=shear)
    done = loads(found.film)
    assert found.film.cavity.any()
    assert done.mass_balance_error < BALANCE
    assert found.heat.dissipation == pytest.approx(done.dissipation, rel=1e-12)
    assert found.heat.energy_balance_error < BALANCE
    assert found.heat.temperature.min() > INLET - 1e-6


@dataclass(frozen=True)
class Grown:
    """Opening of a wall by its own flux alone, m by W/m2."""

    reference: Array
    matrix: Array


def test_wall_that_opens_by_its_heat(validation):
    """An endless film heats a wall that expands away from it by g q: q = mu U^2/(h0 + g q), a quadratic in q."""
    space = endless()
    count = len(space.vertices)
    gain = 0.5 * GAP / (VISCOSITY * SPEED**2 / GAP)
    grown = Grown(np.full(count, -0.1 * GAP), gain * np.eye(count))
    heat = oil_heat(ConductingBody(np.full(count, INLET), 1e-6 * np.eye(count), grown), Adiabatic(), ("bottom", "top"))
    found = solve_thermal(sheared(space), heat, constant, tolerance=1e-9)
    rest = 0.9 * GAP
    flux = (-rest + np.sqrt(rest**2 + 4.0 * gain * VISCOSITY * SPEED**2)) / (2.0 * gain)
    validation(
        case="Film opened by the heat of its wall",
        source="q = mu U^2/(h0 + g q), closed form",
        quantity="film thickness",
        unit="um",
        expected=1e6 * (rest + gain * flux),
        obtained=1e6 * float(found.film.film.thickness.mean()),
        relative_tolerance=1e-8,
    )
    wrong = replace(
        heat, fixed_wall=ConductingBody(np.full(count, INLET), np.eye(count), Grown(np.zeros(2), np.eye(2)))
    )
    with pytest.raises(FilmInputError, match="deformation of a warm body"):
        solve_thermal(sheared(space), wrong, constant)


@pytest.mark.parametrize("given", [-0.1 * GAP, -2.0 * GAP])
def test_heat_opens_walls_that_overlap_without_their_oil(given):
    """Springs that oil opens to GAP: their growth by heat g q is that of the rigid film, q = mu U^2/(GAP + g q)."""
    space = endless()
    count, stiff = len(space.vertices), 1e12
    gain = 0.5 * GAP / (VISCOSITY * SPEED**2 / GAP)
    grown = Grown(np.full(count, -0.1 * GAP), gain * np.eye(count))
    heat = oil_heat(ConductingBody(np.full(count, INLET), 1e-6 * np.eye(count), grown), Adiabatic(), ("bottom", "top"))
    pressed = dict.fromkeys(("bottom", "top"), Held(stiff * (GAP - given)))
    rigid = sheared(space)
    soft = replace(
        rigid, film=replace(rigid.film, thickness=np.full((1, 1), given)), boundary=pressed, walls=winkler(space, stiff)
    )
    found = solve_thermal(soft, heat, constant, tolerance=1e-9)
    expected = solve_thermal(rigid, heat, constant, tolerance=1e-9).film.film.thickness.mean()
    assert found.film.film.thickness.mean() == pytest.approx(expected, rel=1e-7)
    meeting = replace(soft, film=replace(rigid.film, thickness=np.zeros((1, 1))))
    with pytest.raises(FilmInputError, match="0 m everywhere"):
        solve_thermal(meeting, heat, constant)


def test_plate_that_bends_and_warms(tmp_path):
    """A steel pad, elastic and heated by its film: temperature and both openings are its own equations'."""
    size = (LENGTH, LENGTH, 8e-3)
    pad = SolidBody(
        block(size, (3, 3, 2)), Elastic(210e9, 0.3), Supports(clamped=("bottom",)), "top",
        Plane((0.0, 0.0, 1.0), origin=(0.0, 0.0, size[2])),
    )  # fmt: skip
    space = square(9)
    warm = heated_wall(pad, space, Thermal(45.0, 12e-6, INLET), {"bottom": Convection(500.0, INLET)}, folder=tmp_path)
    elastic = body_wall(pad, space, folder=tmp_path)
    problem = replace(wedge(space), walls=elastic)
    body = ConductingBody(warm.temperature.reference, warm.temperature.matrix, warm.deformation)
    found = solve_thermal(problem, oil_heat(body, Adiabatic()), thinning, tolerance=1e-8)
    flux = found.heat.heat_flux[0][space.vertex_dofs]
    kelvin = warm.temperature.reference + warm.temperature.matrix @ flux
    growth = warm.deformation.reference + warm.deformation.matrix @ flux
    assert found.heat.fixed_wall[space.vertex_dofs] == pytest.approx(kelvin, abs=1e-6)
    assert found.growth == pytest.approx(growth, abs=1e-7 * GAP)
    assert found.growth.max() < 0.0  # warm steel grows into the film
    gap = problem.film.thickness + space.sample_vertices(growth + elastic.matrix @ found.film.pressure)
    assert found.film.film.thickness == pytest.approx(gap, rel=1e-6)
    assert found.heat.energy_balance_error < BALANCE
    cold = solve_thermal(problem, oil_heat(ConductingBody(body.reference, body.matrix), Adiabatic()), thinning)
    assert loads(found.film).film_thickness_min < loads(cold.film).film_thickness_min


def test_heating_in_time(validation):
    """An endless film between adiabatic walls: implicit Euler on rho c h dT/dt = mu(T) U^2/h."""
    space, step, steps = endless(), 1e-4, 5
    heat = oil_heat(Adiabatic(), Adiabatic(), ("bottom", "top"))
    expected = INLET
    gain = step / (DENSITY * SPECIFIC_HEAT) * (SPEED / GAP) ** 2
    for _ in range(steps):
        expected = brentq(lambda t, b: t - b - gain * thinning(t, 0.0), expected, expected + 200.0, args=(expected,))
    *_, last = march_thermal(
        lambda time: sheared(space), heat, thinning, steps * step, step, temperature=INLET, tolerance=1e-9
    )
    validation(
        case="Heating of a sheared film in time",
        source="rho c h dT/dt = mu(T) U^2/h, implicit Euler's own steps",
        quantity="temperature after 0.5 ms",
        unit="K",
        expected=expected,
        obtained=float(last.solution.heat.mean.mean()),
        relative_tolerance=1e-8,
    )


@pytest.mark.parametrize("walls", [False, True], ids=["rigid", "soft"])
def test_film_in_time_with_everything(walls):
    """A cavity that moves as the film breathes: heat and oil balance at each step, and what is stored adds up."""
    space = square(8)
    period, steps = 4e-3, 8

    def problem(time: float) -> FilmProblem:
        breath = 1.0 + 0.3 * np.sin(2.0 * np.pi * time / period)
        posed = replace(wave(space, breath * GAP), surface=ROUGH)
        return replace(posed, walls=winkler(space, 2e13)) if walls else posed

    heat = oil_heat(Convecting(2e4, INLET), GivenTemperature(INLET + 10.0))
    instants = list(march_thermal(problem, heat, thinning, period, period / steps, temperature=INLET, shear=CARREAU))
    assert len(instants) >= steps
    for instant in instants:
        found = instant.solution
        done = loads(found.film)
        assert done.mass_balance_error < BALANCE
        assert found.heat.energy_balance_error < BALANCE
        assert found.heat.dissipation == pytest.approx(done.dissipation, rel=1e-12)
    # What is stored step by step is the change of the heat that the oil holds.
    held = [_heat_held(instant.solution) for instant in instants]
    for (before, after), instant in zip(pairwise(held), instants[1:], strict=True):
        stored = instant.solution.heat.stored * instant.step
        assert stored == pytest.approx(after - before, abs=1e-9 * max(held))


def _heat_held(found) -> float:
    """J above the datum in all the oil of the film."""
    rise = found.heat.mean - found.heat.datum
    return DENSITY * SPECIFIC_HEAT * float(found.holds @ rise)
