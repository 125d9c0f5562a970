"""Film temperature: flow between parallel walls.

Closed forms of the energy equation with viscosity that falls with temperature, and what the profile across the
film must reproduce: Dowson's integrals, conduction, its own convergence with the number of levels.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from reynolds import (
    ZERO,
    Adiabatic,
    Cavitation,
    Cell,
    Film,
    FilmInputError,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    GivenTemperature,
    Heat,
    Held,
    ThermalSolution,
    film,
    film_space,
    rectangle,
    solve_energy,
    solve_thermal,
)
from reynolds.thermal.film_profile import dowson, film_with, levels, velocity
from reynolds.thermal.walls import Wall

DENSITY, SPECIFIC_HEAT, CONDUCTIVITY = 860.0, 2000.0, 0.14
LENGTH, THICKNESS, SPEED, VISCOSITY, THINNING = 0.02, 1e-5, 10.0, 0.03, 0.03
INLET = 313.15
SLIDING = (np.full((1, 1), SPEED), ZERO)


def thinning(rate: float = THINNING):
    """mu = mu0 exp(-rate (T - T_in)), at any pressure."""
    return lambda temperature, pressure: VISCOSITY * np.exp(-rate * (temperature - INLET)) + 0.0 * pressure


def couette(space: FilmSpace, held: dict[str, float], oil: Film | None = None) -> FilmProblem:
    oil = film(THICKNESS, VISCOSITY, velocity_moving=SLIDING) if oil is None else oil
    return FilmProblem(
        space, oil, {name: Held(pressure) for name, pressure in held.items()}, cavitation=Cavitation.NONE
    )


def strip(cells: int) -> FilmSpace:
    return film_space(rectangle((LENGTH, LENGTH / 4), (cells, 2), cell=Cell.QUADRILATERAL))


def endless() -> FilmSpace:
    return film_space(rectangle((LENGTH, LENGTH), (4, 2), periodic_x=True))


def oil_heat(fixed: Wall, moving: Wall, conductivity: float = CONDUCTIVITY, **more) -> Heat:
    return Heat(DENSITY, SPECIFIC_HEAT, conductivity, fixed, moving, **{"inflow": {}, **more})


def _adiabatic(cells: int, rate: float) -> ThermalSolution:
    """Conduction so strong that the temperature is even across: 0.0004 K of mu U^2/(8 k)."""
    heat = oil_heat(Adiabatic(), Adiabatic(), 1e3, inflow={"left": INLET})
    return solve_thermal(couette(strip(cells), {"left": 0.0, "right": 0.0}), heat, thinning(rate))


def _rise(found: ThermalSolution) -> float:
    flow = 0.5 * SPEED * THICKNESS * LENGTH / 4
    return found.heat.convected_out / (DENSITY * SPECIFIC_HEAT * flow)


def test_adiabatic_couette(validation, refine):
    heating = 2.0 * VISCOSITY * SPEED * LENGTH / (DENSITY * SPECIFIC_HEAT * THICKNESS**2)
    exact = np.log1p(THINNING * heating) / THINNING
    assert exact == pytest.approx(37.6383, abs=5e-5)
    found = refine(lambda cells: _rise(_adiabatic(cells, THINNING)), (8, 16, 32))
    validation(
        case="Adiabatic Couette flow",
        source="heat balance, closed form",
        quantity="temperature rise, mu falls with exp(-0.03 dT/K)",
        unit="K",
        expected=37.6383,
        obtained=found.finest,
        tolerance=found.tolerance(rounding=0.5e-4 + VISCOSITY * SPEED**2 / (8.0 * 1e3)),
        order=found.order,
    )


def test_isoviscous_couette(validation):
    """The balance alone gives the rise, on any mesh; rounded to the printed digits."""
    validation(
        case="Adiabatic Couette flow",
        source="heat balance, closed form",
        quantity="temperature rise, constant viscosity",
        unit="K",
        expected=69.7674,
        obtained=_rise(_adiabatic(8, 0.0)),
        tolerance=0.5e-4,
    )


@pytest.mark.parametrize("count", [2, 3, 4, 5, 6, 9, 12])
def test_the_highest_temperature_is_that_of_the_profile_at_any_number_of_levels(count):
    """Between walls at one temperature the middle is warmer by mu U^2/(8 k), whether or not a level lies there."""
    wall = GivenTemperature(INLET)
    problem = couette(endless(), {"bottom": 0.0, "top": 0.0})
    found = solve_thermal(problem, oil_heat(wall, wall), thinning(0.0), count=count)
    exact = VISCOSITY * SPEED**2 / (8.0 * CONDUCTIVITY)
    np.testing.assert_allclose(found.heat.highest - INLET, exact, rtol=1e-6)


@pytest.mark.parametrize("count", [4, 6, 9, 20])
def test_an_overshoot_beside_a_jump_is_no_temperature(count):
    """Uniform inflow between cold walls is as hot as it comes in, though its polynomial exceeds it by a fifth."""
    across = levels(count)
    field = np.ones((1, count + 2))
    field[0, [0, -1]] = 0.0
    assert across.at(field, np.linspace(0.0, 1.0, 500)).max() > 1.05
    assert across.highest(field) == pytest.approx(1.0)


def test_the_highest_place_may_lie_anywhere_across():
    across = levels(6)
    peaks = np.linspace(0.0, 1.0, 101)
    field = 3.0 - 8.0 * (across.place - peaks[:, None]) ** 2
    np.testing.assert_allclose(across.highest(field), 3.0, rtol=1e-6)


def _nahme(count: int) -> tuple[float, float]:
    """Stress over that of the cold oil, and beta times the largest rise, between walls at one temperature."""
    heat = oil_heat(GivenTemperature(INLET), GivenTemperature(INLET))
    problem = couette(endless(), {"bottom": 0.0, "top": 0.0})
    found = solve_thermal(problem, heat, thinning(), count=count, tolerance=1e-11)
    middle = levels(count).at(found.heat.temperature, 0.5)
    return found.heat.profile.couette_viscosity[0] / VISCOSITY, THINNING * float(middle.max() - INLET)


def test_nahme_couette(validation):
    number = THINNING * VISCOSITY * SPEED**2 / CONDUCTIVITY / 8.0
    root = np.sqrt(number)
    exact = {
        "stress over that of cold oil": (0.949651, np.arcsinh(root) / (root * np.sqrt(1.0 + number)), 0.5e-6),
        "beta (T_max - T_wall)": (0.0772917, np.log1p(number), 0.5e-7),
    }
    found, more = _nahme(6), _nahme(8)
    for (quantity, (printed, closed, rounding)), value, finer in zip(exact.items(), found, more, strict=True):
        assert closed == pytest.approx(printed, abs=rounding)
        validation(
            case="Nahme Couette flow, Na = 0.642857",
            source="Nahme 1940, closed form",
            quantity=f"{quantity}, 6 levels across",
            unit="1",
            expected=printed,
            obtained=value,
            tolerance=2.0 * abs(finer - value) + rounding,
            note="tolerance: the step to 8 levels",
        )


def test_levels_converge(validation):
    """Errors of the largest temperature fall by orders with each two levels (spectral)."""
    exact = np.log1p(THINNING * VISCOSITY * SPEED**2 / CONDUCTIVITY / 8.0)
    errors = [abs(_nahme(count)[1] - exact) for count in (2, 4, 6, 8)]
    assert all(after < 0.05 * before for before, after in pairwise(errors)), errors
    validation(
        case="Nahme Couette flow, Na = 0.642857",
        source="Nahme 1940, closed form",
        quantity="beta (T_max - T_wall), 8 levels across",
        unit="1",
        expected=exact,
        obtained=exact + errors[-1],
        tolerance=errors[-2] * 0.05,
        note="tolerance: 1/20 of the error of 6 levels",
    )


def test_conduction_only(validation):
    """No motion, no pressure: linear between the walls."""
    still = film(THICKNESS, VISCOSITY)
    heat = oil_heat(GivenTemperature(INLET + 20.0), GivenTemperature(INLET))
    found = solve_thermal(couette(endless(), {"bottom": 0.0, "top": 0.0}, still), heat, thinning()).heat
    line = INLET + 20.0 * (1.0 - found.profile.levels.place)
    assert np.abs(found.temperature - line).max() < 1e-9
    validation(
        case="Conduction through a film at rest",
        source="Fourier, closed form",
        quantity="heat flux k dT/h into the cold wall",
        unit="W/m2",
        expected=CONDUCTIVITY * 20.0 / THICKNESS,
        obtained=float(found.heat_flux[1].mean()),
        relative_tolerance=1e-9,
    )
    assert found.to_fixed == pytest.approx(-found.to_moving, rel=1e-9)


def test_wall_temperatures_over_the_face():
    """A field given at the vertices passes through the film place by place."""
    space = endless()
    given = INLET + 1e3 * space.vertices[:, 1]
    still = couette(space, {"bottom": 0.0, "top": 0.0}, film(THICKNESS, VISCOSITY))
    found = solve_thermal(still, oil_heat(Adiabatic(), GivenTemperature(given)), thinning()).heat
    expected = np.empty(space.size)
    expected[space.vertex_dofs] = given
    assert found.fixed_wall == pytest.approx(expected, abs=1e-8)
    assert np.abs(found.heat_flux).max() < 1e-4


def test_throttled_film(validation):
    """Pressure flow between adiabatic walls: rho c dT = (1 - beta T) dp, the film's Joule-Thomson effect."""
    drop, expansion = 2e7, 7e-4
    heat = oil_heat(Adiabatic(), Adiabatic(), 10.0, inflow={"left": INLET}, expansion=expansion)
    space = strip(128)
    still = film(THICKNESS, VISCOSITY)
    problem = couette(space, {"left": drop, "right": 0.0}, still)
    found = solve_thermal(problem, heat, thinning(0.0))
    flow = drop / LENGTH * THICKNESS**3 / (12.0 * VISCOSITY) * LENGTH / 4
    warming = (1.0 - expansion * INLET) / expansion * -np.expm1(-expansion * drop / (DENSITY * SPECIFIC_HEAT))
    validation(
        case="Throttling between adiabatic walls",
        source="rho c dT = (1 - beta T) dp, closed form",
        quantity="temperature rise over 200 bar, beta = 7e-4/K",
        unit="K",
        expected=warming,
        obtained=found.heat.convected_out / (DENSITY * SPECIFIC_HEAT * flow),
        tolerance=warming * expansion * drop / (DENSITY * SPECIFIC_HEAT) / 128,
        note="tolerance: one cell's share of beta dp/(rho c)",
    )
    assert found.heat.energy_balance_error < 1e-9


def test_dowson_integrals(validation):
    """mu = a + b zeta and mu = a exp(b zeta), against closed forms of the integrals of 1/mu and zeta/mu."""
    across = levels(12)
    zeta = across.inner
    a, b = 0.05, -0.03
    log = np.log1p(b / a)
    linear = (log / b, 1.0 / b - a / b**2 * log, 0.5 / b - a / b**2 + a**2 / b**3 * log)
    s = 1.2
    fall = np.exp(-s)
    exponential = tuple(
        value / a
        for value in ((1.0 - fall) / s, (1.0 - fall * (1.0 + s)) / s**2, (2.0 - fall * (s**2 + 2.0 * s + 2.0)) / s**3)
    )
    for law, viscosity, (f0, f1, second) in (
        ("linear in z", a + b * zeta, linear),
        ("exponential in z", a * np.exp(s * zeta), exponential),
    ):
        found = dowson(across, viscosity[None, :])
        centre = f1 / f0
        for quantity, expected, obtained, unit in (
            ("couette viscosity 1/F0", 1.0 / f0, found.couette_viscosity, "Pa s"),
            ("moving wall's share 1 - F1/F0", 1.0 - centre, found.moving_share, "1"),
            ("viscosity of pressure flow 1/(12 F2)", 1.0 / (12.0 * (second - centre * f1)), found.viscosity, "Pa s"),
        ):
            validation(
                case="Viscosity that varies across the film",
                source="Dowson 1962, closed form of the integrals",
                quantity=f"{quantity}, {law}",
                unit=unit,
                expected=expected,
                obtained=float(obtained[0]),
                relative_tolerance=1e-9,
            )


def test_profile_of_constant_viscosity():
    """The parabola and the line."""
    across = levels(5)
    profile = dowson(across, np.full((1, 5), VISCOSITY))
    h, slope, one, two = (np.array([value]) for value in (2e-5, 3e8, 4.0, -1.0))
    z = h * across.inner
    expected = slope / (2.0 * VISCOSITY) * z * (z - h) + two + (one - two) * z / h
    assert velocity(profile, h, one, two, slope)[0] == pytest.approx(expected, rel=1e-12)
    with pytest.raises(FilmInputError, match="viscosity across the film"):
        dowson(across, np.zeros((1, 5)))
    with pytest.raises(FilmInputError, match="levels"):
        levels(1)


@pytest.mark.parametrize("cell", list(Cell))
def test_uniform_temperature_stays(cell):
    """Without dissipation, in a wedge with side flow, backflow and a law of mu across: nothing may arise."""
    space = film_space(rectangle((LENGTH, LENGTH), (9, 7), cell=cell))
    wedge = space.sample(lambda x, y: THICKNESS * (4.0 - 3.0 * x / LENGTH))
    profile = dowson(levels(6), np.broadcast_to(1e-12 * np.exp(2.0 * levels(6).inner), (space.size, 6)))
    oil = film_with(film(wedge, 1.0, velocity_moving=SLIDING), space, profile)
    problem = couette(space, dict.fromkeys(("left", "right", "bottom", "top"), 0.0), oil)
    heat = oil_heat(
        Adiabatic(), GivenTemperature(INLET), inflow=dict.fromkeys(("left", "right", "bottom", "top"), INLET)
    )
    found = solve_energy(FilmSolver(space).solve(problem), heat, profile)
    assert np.abs(found.temperature - INLET).max() < 1e-8
