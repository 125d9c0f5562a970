"""Film temperature: films of varying thickness.

The heat balance to round-off under every kind of wall, and a wedge against an answer that knows nothing of the
film's discretisation.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reynolds import (
    ZERO,
    Adiabatic,
    Cavitation,
    Cell,
    Convecting,
    FilmInputError,
    FilmNotConverged,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    FilmTemperature,
    GivenTemperature,
    Heat,
    Held,
    Storage,
    ThermalSolution,
    Turning,
    film,
    film_space,
    loads,
    rectangle,
    solve_energy,
    solve_thermal,
)
from reynolds.thermal.energy_system import solve_heat
from reynolds.thermal.film_profile import dowson, levels
from reynolds.thermal.walls import ConductingBody, Wall

DENSITY, SPECIFIC_HEAT, CONDUCTIVITY = 860.0, 2000.0, 0.13
LENGTH, OUTLET, SPEED, VISCOSITY, INLET = 0.02, 1e-5, 10.0, 0.03, 313.15
SLIDING = (np.full((1, 1), SPEED), ZERO)
SIDES = ("left", "right", "bottom", "top")
BALANCE = 1e-9


def thinning(temperature, pressure):
    return VISCOSITY * np.exp(-0.03 * (temperature - INLET)) + 0.0 * pressure


def constant(temperature, pressure):
    return VISCOSITY + 0.0 * temperature + 0.0 * pressure


def oil_heat(fixed: Wall, moving: Wall, names: tuple[str, ...] = SIDES, **more) -> Heat:
    return Heat(DENSITY, SPECIFIC_HEAT, CONDUCTIVITY, fixed, moving, dict.fromkeys(names, INLET), **more)


def wedge(space: FilmSpace, ratio: float, cavitation: Cavitation = Cavitation.JFO) -> FilmProblem:
    thickness = space.sample(lambda x, y: OUTLET * (ratio - (ratio - 1.0) * x / LENGTH))
    held = {name: Held(0.0) for name in SIDES if name in space.film_mesh.boundary_names}
    return FilmProblem(space, film(thickness, VISCOSITY, velocity_moving=SLIDING), held, cavitation=cavitation)


def square(cells: int, cell: Cell = Cell.QUADRILATERAL) -> FilmSpace:
    return film_space(rectangle((LENGTH, LENGTH), (cells, cells), cell=cell))


def missing(found: FilmTemperature) -> float:
    """The balance again, from its parts."""
    arises = found.dissipation + found.compression
    return abs(found.convected_out + found.stored + found.to_fixed + found.to_moving - arises) / arises


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize(("ratio", "count"), [(2.0, 6), (4.0, 4)])
def test_adiabatic_slider(cell, ratio, count, validation):
    """All the power of the slider leaves with the oil; at ratio 4 part of it first flows back along the pad."""
    found = solve_thermal(wedge(square(12, cell), ratio), oil_heat(Adiabatic(), Adiabatic()), thinning, count=count)
    done = loads(found.film)
    power = -done.friction_moving[0] * SPEED
    validation(
        case="Slider between adiabatic walls",
        source="balance: power of the moving wall = rho c times flow and rise",
        quantity=f"heat carried out by the oil, inlet/outlet {ratio:g}, {cell.value}, {count} levels",
        unit="W",
        expected=power,
        obtained=found.heat.convected_out,
        relative_tolerance=BALANCE,
    )
    assert found.heat.energy_balance_error < BALANCE
    assert missing(found.heat) < BALANCE
    assert found.heat.dissipation == pytest.approx(done.dissipation, rel=1e-12)
    assert found.heat.temperature.min() > INLET - 1e-9


def _walls(space: FilmSpace) -> dict[str, tuple[Wall, Wall]]:
    count = len(space.vertices)
    spread = 2e-3 / count + 3e-4 * np.eye(count)
    return {
        "given": (GivenTemperature(INLET - 5.0), GivenTemperature(INLET + 10.0)),
        "convecting": (Convecting(900.0, 300.0), Convecting(0.0, 250.0)),
        "body and shaft": (ConductingBody(np.full(count, 305.0), spread), Turning(20.0)),
        "shaft and body": (Turning(), ConductingBody(np.full(count, 305.0), spread)),
    }


@pytest.mark.parametrize("which", ["given", "convecting", "body and shaft", "shaft and body"])
def test_walls_take_what_they_are_told(which):
    """Each wall's own law holds at every place, and the balance closes."""
    space = square(10)
    fixed, moving = _walls(space)[which]
    found = solve_thermal(wedge(space, 2.5), oil_heat(fixed, moving, expansion=7e-4), thinning).heat
    assert found.energy_balance_error < BALANCE
    sides = ((fixed, found.fixed_wall, found.heat_flux[0]), (moving, found.moving_wall, found.heat_flux[1]))
    for number, (wall, temperature, flux) in enumerate(sides):
        match wall:
            case GivenTemperature(given):
                assert temperature == pytest.approx(np.full(space.size, given), abs=1e-8)
            case Convecting(coefficient, outer):
                assert flux == pytest.approx(coefficient * (temperature - outer), rel=1e-8, abs=1e-3)
            case ConductingBody(reference, matrix):
                expected = (reference + matrix @ flux[space.vertex_dofs])[np.argsort(space.vertex_dofs)]
                assert temperature == pytest.approx(expected, abs=1e-7)
            case Turning(heat):
                assert np.ptp(temperature) < 1e-7
                assert (found.to_fixed, found.to_moving)[number] == pytest.approx(heat, abs=1e-6)


def test_stiff_convection_is_a_given_temperature():
    """Without bound the coefficient gives the outer temperature; in between lies k/h in series with H."""
    space = square(6)
    still = replace(wedge(space, 2.0), film=film(OUTLET, VISCOSITY))
    for coefficient in (1e12, 5e3):
        heat = oil_heat(Convecting(coefficient, 300.0), GivenTemperature(330.0))
        found = solve_thermal(still, heat, constant).heat
        expected = 30.0 / (1.0 / coefficient + OUTLET / CONDUCTIVITY)
        assert found.heat_flux[0] == pytest.approx(np.full(space.size, expected), rel=1e-8)


def _marched(ratio: float, degree: int = 24) -> tuple[float, float]:
    """Heat carried out of and into the moving wall of a wide isoviscous wedge, per width (W/m).

    rho c (h u T_x + W T_zeta) = k/h T_zetazeta + h mu u_z^2 marched in x at Chebyshev points across, with u and
    W = U h' zeta^2 (1 - zeta) of the closed form: the pad adiabatic, the moving wall at the inlet temperature.
    """
    from scipy.integrate import solve_ivp

    angle = np.pi * np.arange(degree + 1) / degree
    z = 0.5 * (1.0 - np.cos(angle))
    c = np.where(np.arange(degree + 1) % degree == 0, 2.0, 1.0) * (-1.0) ** np.arange(degree + 1)
    d = np.outer(c, 1.0 / c) / (z[:, None] - z[None, :] + np.eye(degree + 1))
    d -= np.diag(d.sum(axis=1))
    slope, flow = -(ratio - 1.0) * OUTLET / LENGTH, SPEED * OUTLET * ratio / (ratio + 1.0)
    inner = slice(1, degree)

    def full(t):
        """With the pad's value from a vanishing slope and the moving wall's given."""
        return np.concatenate([[-(d[0, inner] @ t) / d[0, 0]], t, [0.0]])

    def shape(x):
        h = OUTLET * ratio + slope * x
        driven = 6.0 * (flow / h - 0.5 * SPEED)
        u = SPEED * z + driven * z * (1.0 - z)
        return h, u, VISCOSITY / h * (SPEED + driven * (1.0 - 2.0 * z)) ** 2

    def march(x, t):
        h, u, heating = shape(x)
        t = full(t)
        through = SPEED * slope * z**2 * (1.0 - z)
        rate = (CONDUCTIVITY / h * (d @ (d @ t)) + heating) / (DENSITY * SPECIFIC_HEAT) - through * (d @ t)
        return (rate / (h * np.where(u > 0.0, u, 1.0)))[inner]

    end = solve_ivp(march, (0.0, LENGTH), np.zeros(degree - 1), method="BDF", rtol=1e-8, atol=1e-8).y[:, -1]
    h, u, _ = shape(LENGTH)
    weights = np.polynomial.chebyshev.Chebyshev.fit(z, h * u * full(end), degree, domain=(0.0, 1.0)).integ()
    carried = DENSITY * SPECIFIC_HEAT * float(weights(1.0) - weights(0.0))
    spent = VISCOSITY * SPEED**2 * LENGTH / OUTLET * (4.0 * np.log(ratio) / (ratio - 1.0) - 6.0 / (ratio + 1.0))
    return carried, spent - carried


def test_wide_wedge_against_marching(validation, refine):
    """Convection along and through the levels, conduction and dissipation at once."""
    wide = LENGTH / 4

    def solve(cells: int) -> tuple[float, float]:
        mesh = rectangle((LENGTH, wide), (cells, 2), cell=Cell.QUADRILATERAL, periodic_y=True)
        problem = wedge(film_space(mesh), 1.5)
        heat = oil_heat(Adiabatic(), GivenTemperature(INLET), ("left", "right"))
        found = solve_thermal(problem, heat, constant, count=8).heat
        return found.convected_out / wide, found.to_moving / wide

    columns = refine(solve, (20, 40, 80))
    for quantity, expected, column in zip(("oil", "moving wall"), _marched(1.5), columns, strict=True):
        validation(
            case="Wide wedge, adiabatic pad, moving wall at the inlet temperature",
            source="marched in x with the closed form of the flow (Chebyshev points, BDF)",
            quantity=f"heat that leaves with the {quantity}, inlet/outlet 1.5",
            unit="W/m",
            expected=expected,
            obtained=column.finest,
            tolerance=column.tolerance(),
            order=column.order,
        )


def _journal(cavitation: Cavitation) -> ThermalSolution:
    """A 360 degree bearing with an axial groove; its cavity is carried round by the shaft."""
    around, width, clearance = 2.0 * np.pi * 0.05, 0.04, 80e-6
    space = film_space(rectangle((around, width), (48, 8), cell=Cell.TRIANGLE))
    thickness = space.sample(lambda x, y: clearance * (1.0 + 0.6 * np.cos(x / 0.05)))
    held = {"left": Held(7e4), "right": Held(7e4), "bottom": Held(0.0), "top": Held(0.0)}
    problem = FilmProblem(space, film(thickness, VISCOSITY, velocity_moving=SLIDING), held, cavitation=cavitation)
    return solve_thermal(problem, oil_heat(Convecting(500.0, 300.0), Turning(), tuple(held)), thinning)


@pytest.mark.parametrize("cavitation", [Cavitation.JFO, Cavitation.REYNOLDS])
def test_journal_with_cavity(cavitation):
    found = _journal(cavitation)
    assert found.film.cavity.any()
    assert found.heat.energy_balance_error < BALANCE
    assert found.heat.dissipation == pytest.approx(loads(found.film).dissipation, rel=1e-12)
    # Under JFO nothing is stored; Reynolds' cavity makes and swallows oil, at the temperature there.
    if cavitation is Cavitation.JFO:
        assert abs(found.heat.stored) < 1e-8 * found.heat.dissipation
    assert found.heat.temperature.min() > 300.0
    assert found.heat.temperature.max() < 400.0


def test_heating_up_in_time(validation):
    """An endless film between adiabatic walls at rest in the plane: rho c h dT/dt = mu U^2/h, step by step."""
    space = film_space(rectangle((LENGTH, LENGTH), (3, 3), periodic_x=True))
    solver, step = FilmSolver(space), 1e-4
    oil = film(OUTLET, VISCOSITY, velocity_moving=SLIDING)
    problem = FilmProblem(space, oil, {"bottom": Held(0.0), "top": Held(0.0)}, cavitation=Cavitation.NONE)
    holds = solver.solve(problem).holds
    profile = dowson(levels(4), np.full((space.size, 4), VISCOSITY))
    temperature = np.full((space.size, 6), INLET)
    for _ in range(5):
        solution = solver.solve(replace(problem, storage=Storage(holds, step)))
        heat = oil_heat(Adiabatic(), Adiabatic(), ("bottom", "top"))
        found = solve_energy(solution, heat, profile, before=temperature)
        assert found.energy_balance_error < BALANCE
        temperature, holds = found.temperature, solution.holds
    validation(
        case="Heating of a sheared film",
        source="rho c h dT/dt = mu U^2/h, closed form",
        quantity="temperature rise after 0.5 ms",
        unit="K",
        expected=VISCOSITY * (SPEED / OUTLET) ** 2 / (DENSITY * SPECIFIC_HEAT) * 5 * step,
        obtained=float(found.mean.mean() - INLET),
        relative_tolerance=1e-9,
    )


def test_what_cannot_be_posed():
    """Each fault says where it is."""
    space = square(4)
    problem = wedge(space, 2.0)
    good = oil_heat(Adiabatic(), Adiabatic())
    with pytest.raises(FilmInputError, match="inflow temperature at left"):
        solve_thermal(problem, replace(good, inflow={"right": INLET}), constant)
    with pytest.raises(FilmInputError, match="inflow temperature at inlet"):
        solve_thermal(problem, replace(good, inflow={"inlet": INLET}), constant)
    with pytest.raises(FilmInputError, match="no temperature anywhere"):
        solve_thermal(problem, replace(good, inflow={}), constant)
    with pytest.raises(FilmInputError, match="wall temperature"):
        solve_thermal(problem, replace(good, fixed_wall=GivenTemperature(np.zeros(3))), constant)
    with pytest.raises(FilmInputError, match="body matrix"):
        solve_thermal(problem, replace(good, fixed_wall=ConductingBody(np.full(25, 300.0), np.eye(3))), constant)
    with pytest.raises(FilmInputError, match="conductivity"):
        replace(good, conductivity=0.0)
    quadratic = film_space(rectangle((LENGTH, LENGTH), (4, 4)), degree=2)
    with pytest.raises(FilmInputError, match="degree 2"):
        solve_thermal(wedge(quadratic, 2.0, Cavitation.NONE), good, constant)


def test_no_heat_at_all_is_in_balance():
    """A film at rest between walls of one temperature, warmer than what might enter: round-off is no error."""
    space = square(6)
    still = FilmProblem(space, film(OUTLET, VISCOSITY), dict.fromkeys(SIDES, Held(0.0)))
    warm = GivenTemperature(INLET + 26.0)
    found = solve_thermal(still, oil_heat(warm, warm), thinning)
    assert found.heat.energy_balance_error < 1e-3


def test_heat_without_a_way_out():
    """An endless film between adiabatic walls has no steady temperature."""
    space = film_space(rectangle((LENGTH, LENGTH), (3, 3), periodic_x=True))
    oil = film(OUTLET, VISCOSITY, velocity_moving=SLIDING)
    problem = FilmProblem(space, oil, {"bottom": Held(0.0), "top": Held(0.0)})
    with pytest.raises(FilmNotConverged):
        solve_thermal(problem, oil_heat(Adiabatic(), Adiabatic(), ("bottom", "top")), constant)


def test_all_sweeps_are_counted(monkeypatch):
    """From nothing and from the field itself: upwind solves and those of every correction."""
    counted = []

    def counting(*given):
        found, sweeps = solve_heat(*given)
        counted.append(sweeps)
        return found, sweeps

    monkeypatch.setattr("reynolds.thermal.energy.solve_heat", counting)
    space = square(8)
    solution = FilmSolver(space).solve(wedge(space, 2.0))
    profile = dowson(levels(4), np.full((space.size, 4), VISCOSITY))
    first = solve_energy(solution, oil_heat(Adiabatic(), Adiabatic()), profile)
    assert len(counted) > 2
    assert first.iterations == sum(counted)
    counted.clear()
    again = solve_energy(solution, oil_heat(Adiabatic(), Adiabatic()), profile, start=first.temperature)
    assert again.iterations == sum(counted) > 0
