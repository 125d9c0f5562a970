"""Film equation: infinitely long journal bearings, full film and Reynolds' rupture.

Angles run from the largest film thickness in the direction of sliding. One strip of the unwrapped film, its
sides closed. Closed forms: Sommerfeld 1904; rupture: Swift 1932 and Stieber 1933, by quadrature.
"""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import (
    ZERO,
    Cavitation,
    Cell,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    Held,
    Loads,
    film,
    film_space,
    loads,
    point_fields,
    rectangle,
)

WIDTH = 0.1
ROUND = 2.0 * np.pi
MESHES = (128, 256, 512)


def _solve(eccentricity: float, n: int, cavitation: Cavitation) -> FilmSolution:
    """Radius, radial clearance, viscosity and surface speed one; pressure zero at the largest film thickness."""
    space = film_space(rectangle((ROUND, WIDTH), (n, 1), cell=Cell.QUADRILATERAL))
    posed = film(
        space.sample(lambda x, y: 1.0 + eccentricity * np.cos(x)), 1.0, velocity_moving=(np.ones((1, 1)), ZERO)
    )
    return FilmSolver(space).solve(FilmProblem(space, posed, {"left": Held(0.0), "right": Held(0.0)}, cavitation))


def _force(solution: FilmSolution) -> tuple[float, float]:
    """Load per width along the line of centres (from the axis to the smallest film) and across it."""
    space: FilmSpace = solution.problem.space
    p, angle = point_fields(solution).pressure, space.points[0]
    return (
        float(-np.sum(p * np.cos(angle) * space.area) / WIDTH),
        float(np.sum(p * np.sin(angle) * space.area) / WIDTH),
    )


@pytest.mark.parametrize(("eccentricity", "table"), [(0.2, 3.772205), (0.5, 9.673597)])
def test_sommerfeld(eccentricity, table, validation, refine):
    exact = 12.0 * np.pi * eccentricity / ((2.0 + eccentricity**2) * np.sqrt(1.0 - eccentricity**2))
    assert exact == pytest.approx(table, abs=0.5e-6)

    def solve(n: int) -> tuple[float, float]:
        along, across = _force(_solve(eccentricity, n, Cavitation.NONE))
        assert abs(along) < 1e-9 * across  # antisymmetric pressure: no load along the line of centres
        return across, 0.0

    found, _ = refine(solve, (64, 128, 256))
    validation(
        case="Long journal bearing, full film",
        source="Sommerfeld 1904, closed form",
        quantity=f"load w psi^2/(mu omega R), eccentricity ratio {eccentricity:g}",
        unit="1",
        expected=exact,
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


def _between_nodes(eccentricity: float, angle: float, n: int) -> float:
    """By how much the largest nodal pressure may miss the peak: |p''| cell^2/8, h^3 p'' = 6 h' at the peak."""
    h = 1.0 + eccentricity * np.cos(angle)
    return 6.0 * eccentricity * abs(np.sin(angle)) / h**3 * (ROUND / n) ** 2 / 8.0


@pytest.mark.parametrize(("eccentricity", "peak", "place"), [(0.2, 1.232046, 107.10), (0.5, 3.726780, 131.81)])
def test_sommerfeld_peak(eccentricity, peak, place, validation, refine):
    def solve(n: int) -> tuple[float, float]:
        found = loads(_solve(eccentricity, n, Cavitation.NONE))
        return found.pressure_max, float(np.degrees(found.pressure_max_at[0]))

    found, at = refine(solve, MESHES)
    angle = np.arccos(-3.0 * eccentricity / (2.0 + eccentricity**2))
    validation(
        case="Long journal bearing, full film",
        source="Sommerfeld 1904, closed form",
        quantity=f"largest pressure p psi^2/(mu omega), eccentricity ratio {eccentricity:g}",
        unit="1",
        expected=peak,
        obtained=found.finest,
        tolerance=found.front_tolerance(rounding=0.5e-6) + _between_nodes(eccentricity, angle, MESHES[-1]),
        note="largest nodal value; tolerance with what may lie between nodes",
    )
    validation(
        case="Long journal bearing, full film",
        source="Sommerfeld 1904, closed form",
        quantity=f"angle of the largest pressure, eccentricity ratio {eccentricity:g}",
        unit="deg",
        expected=place,
        obtained=at.finest,
        tolerance=360.0 / MESHES[-1],
        note="the node with the largest pressure; tolerance one cell",
    )


RUPTURE = [  # eccentricity ratio, rupture angle deg, So, attitude angle deg, largest pressure
    (0.1, 249.222, 0.659123, 69.030, 0.798362),
    (0.2, 241.326, 1.286280, 66.900, 1.581678),
    (0.4, 226.577, 2.530646, 61.638, 3.319865),
    (0.5, 219.694, 3.227778, 58.296, 4.474988),
    (0.6, 213.078, 4.086203, 54.234, 6.126457),
]


def _ruptured(eccentricity: float, n: int) -> tuple[float, ...]:
    solution = _solve(eccentricity, n, Cavitation.REYNOLDS)
    along, across = _force(solution)
    integrals: Loads = loads(solution)
    film_end = solution.problem.space.vertices[:, 0][solution.pressure > 0.0].max()
    return (
        0.5 * float(np.hypot(along, across)),
        float(np.degrees(np.arctan2(across, along))),
        integrals.pressure_max,
        -integrals.flow["left"] / WIDTH,
        float(np.degrees(film_end)),
    )


@pytest.mark.parametrize("row", RUPTURE, ids=lambda row: f"{row[0]:g}")
def test_swift_stieber(row, validation, refine):
    eccentricity, angle, so, attitude, peak = row
    flow = 0.5 * (1.0 + eccentricity * np.cos(np.radians(angle)))
    nodal = 0.5e-6 + _between_nodes(eccentricity, ROUND - np.radians(angle), MESHES[-1])
    *found, film_end = refine(lambda n: _ruptured(eccentricity, n), MESHES)
    quantities = (
        ("Sommerfeld number So", "1", so, 0.5e-6),
        ("attitude angle", "deg", attitude, 0.5e-3),
        ("largest pressure p psi^2/(mu omega)", "1", peak, nodal),
        ("flow q/(U C)", "1", flow, 0.5 * eccentricity * np.radians(0.5e-3)),
    )
    for (quantity, unit, expected, rounding), column in zip(quantities, found, strict=True):
        validation(
            case="Long journal bearing, Reynolds rupture",
            source="Swift 1932, Stieber 1933, by quadrature",
            quantity=f"{quantity}, eccentricity ratio {eccentricity:g}",
            unit=unit,
            expected=expected,
            obtained=column.finest,
            tolerance=column.front_tolerance(rounding),
        )
    cell = 360.0 / MESHES[-1]
    validation(
        case="Long journal bearing, Reynolds rupture",
        source="Swift 1932, Stieber 1933, by quadrature",
        quantity=f"rupture angle, eccentricity ratio {eccentricity:g}",
        unit="deg",
        expected=angle,
        obtained=film_end.finest + 0.5 * cell,
        tolerance=1.5 * cell,
        note="between the last node with film and the next; pressure rises with the square of the distance",
    )
