"""Film temperature: a large tilting pad thrust bearing, and another open code.

ROSS (petrobras/ross, test_thrust_pad.py) prints its own results for a hydro generator's bearing of 13.3 MN: finite
volumes on 10 x 10 cells, one temperature over the film thickness, adiabatic walls, oil entering at 40 degC.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from skfem import MeshQuad

from reynolds import (
    Adiabatic,
    Cavitation,
    FilmMesh,
    FilmProblem,
    FilmSolver,
    FilmSpace,
    Heat,
    Held,
    ThermalSolution,
    film,
    film_space,
    solve_thermal,
)
from reynolds.solve.loads import pressure_integrals

INNER, OUTER, PIVOT_RADIUS = 1.15, 1.725, 1.4425
ARC, PIVOT_ANGLE = np.radians(26.0), np.radians(15.0)  # both from the edge where the oil enters
PIVOT = PIVOT_RADIUS * np.array([np.cos(PIVOT_ANGLE), np.sin(PIVOT_ANGLE)])
PADS, LOAD, SPEED = 12, 13.32e6, 90.0 * np.pi / 30.0
SUPPLY = 313.15
DENSITY, SPECIFIC_HEAT, CONDUCTIVITY = 867.0, 1951.0, 0.15
AT_40, AT_100 = 0.0570722, 0.00766498


def viscosity(kelvin, pressure):
    """Exponential through 40 and 100 degC, as that code has it."""
    return AT_40 * np.exp(np.log(AT_100 / AT_40) / 60.0 * (kelvin - SUPPLY)) + 0.0 * pressure


def pad(cells: int) -> FilmMesh:
    """The sector, radial and along the motion `cells` each."""
    grid = MeshQuad.init_tensor(np.linspace(INNER, OUTER, cells + 1), np.linspace(0.0, ARC, cells + 1))
    names = {
        "inner": lambda x: np.abs(x[0] - INNER) < 1e-9,
        "outer": lambda x: np.abs(x[0] - OUTER) < 1e-9,
        "inlet": lambda x: np.abs(x[1]) < 1e-9,
        "outlet": lambda x: np.abs(x[1] - ARC) < 1e-9,
    }
    named = grid.with_boundaries(names)
    radius, angle = named.p
    return FilmMesh(replace(named, doflocs=np.vstack([radius * np.cos(angle), radius * np.sin(angle)])))


def problem(space: FilmSpace, place: np.ndarray) -> FilmProblem:
    """From the film thickness over the pivot (m) and the pad's slopes along x and y."""
    x, y = space.points
    thickness = place[0] + place[1] * (x - PIVOT[0]) + place[2] * (y - PIVOT[1])
    oil = film(thickness, AT_40, velocity_moving=(-SPEED * y, SPEED * x))
    held = {name: Held(0.0) for name in ("inner", "outer", "inlet", "outlet")}
    return FilmProblem(space, oil, held, cavitation=Cavitation.JFO)


def settled(cells: int) -> tuple[ThermalSolution, np.ndarray]:
    """Film, temperature and pad in balance about the pivot: Newton with slopes by differences."""
    space = film_space(pad(cells))
    solver = FilmSolver(space)
    heat = Heat(
        DENSITY, SPECIFIC_HEAT, CONDUCTIVITY, Adiabatic(), Adiabatic(),
        dict.fromkeys(("inner", "outer", "inlet", "outlet"), SUPPLY),
    )  # fmt: skip
    scale = np.array([1e-4, 1e-4, 1e-4])
    found = None

    def unbalance(place: np.ndarray) -> tuple[np.ndarray, ThermalSolution]:
        solution = solve_thermal(problem(space, place), heat, viscosity, count=5, solver=solver, start=found)
        load, about_x, about_y = pressure_integrals(solution.film)
        return np.array([load * PADS / LOAD - 1.0, about_x / load - PIVOT[1], -about_y / load - PIVOT[0]]), solution

    # A film closing along the motion, which at the pivot is nearly along y.
    place = np.array([1.3e-4, 0.0, -1.5e-4])
    for _ in range(25):
        rest, found = unbalance(place)
        if np.abs(rest).max() < 1e-5:
            return found, place
        slopes = np.column_stack([(unbalance(place + 1e-2 * scale * e)[0] - rest) / 1e-2 for e in np.eye(3)])
        step = -np.linalg.solve(slopes, rest)
        place = place + scale * step * min(1.0, 0.3 / np.abs(step).max())
    raise AssertionError(f"pad not in balance: {rest}")


def least_at_centres(place: np.ndarray) -> float:
    """Least film thickness at the centres of 10 x 10 cells, which is where the other code takes it."""
    middles = (np.arange(10) + 0.5) / 10.0
    radius, angle = np.meshgrid(INNER + (OUTER - INNER) * middles, ARC * middles)
    across = place[1] * (radius * np.cos(angle) - PIVOT[0]) + place[2] * (radius * np.sin(angle) - PIVOT[1])
    return float((place[0] + across).min())


def test_thrust_pad_of_ross(validation):
    """Within 5 %: that code has ten first-order cells along the pad, and one temperature across the film."""
    found, place = settled(16)
    assert found.heat.energy_balance_error < 1e-9
    for quantity, unit, expected, obtained in (
        ("largest pressure", "MPa", 6.957, found.film.pressure.max() * 1e-6),
        ("largest temperature, mean across the film", "degC", 70.4, found.heat.mean.max() - 273.15),
        ("film thickness over the pivot", "um", 131.0, place[0] * 1e6),
        ("least film thickness at 10 x 10 cell centres", "um", 82.0, least_at_centres(place) * 1e6),
    ):
        validation(
            case="Tilting pad thrust bearing, 12 pads, 13.32 MN",
            source="ROSS (petrobras/ross), test_thrust_pad.py",
            quantity=quantity,
            unit=unit,
            expected=expected,
            obtained=float(obtained),
            relative_tolerance=0.05,
            note="tolerance: first-order cells, 10 x 10, and one temperature across the film in that code",
        )
