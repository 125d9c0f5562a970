"""Film equation: finite journal bearings, sliding and squeezed, with Reynolds' condition.

One half of the bearing: the midplane is a closed boundary. Radius, radial clearance, viscosity and surface
speed are one. Angles run from the largest film thickness in the direction of sliding.
"""

from __future__ import annotations

from dataclasses import dataclass

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
    film,
    film_space,
    loads,
    point_fields,
    rectangle,
)

ROUND = 2.0 * np.pi
MESHES = (60, 120, 240)  # cells round the bearing; a quarter of that over its half-width


def _space(aspect: float, n: int, periodic: bool) -> FilmSpace:
    """Half of a bearing of L/D = aspect; cells up to 2.5 times shorter at the smallest film than on average."""
    mesh = rectangle((1.0, aspect), (n, n // 4), cell=Cell.QUADRILATERAL, periodic_x=periodic)
    space = film_space(mesh)
    s, y = space.vertices.T
    return space.moved(np.column_stack([ROUND * s + 0.6 * np.sin(ROUND * s), y]))


def _force(solution: FilmSolution) -> tuple[float, float]:
    """Force on the whole journal along the line of centres (to the smallest film) and across it."""
    space = solution.problem.space
    p, angle = point_fields(solution).pressure, space.points[0]
    return (float(-2.0 * np.sum(p * np.cos(angle) * space.area)), float(2.0 * np.sum(p * np.sin(angle) * space.area)))


@dataclass(frozen=True)
class Bearing:
    """A row of the table: side flow, inflow at the largest film and friction as Q/(R C N L) and f R/C."""

    aspect: float
    eccentricity: float
    so: float
    attitude: float
    side_flow: float
    inflow: float
    mean_over_peak: float
    friction: float


TABLE = [
    Bearing(1, 0.1, 0.11969, 79.411, 0.5061, 3.3736, 0.5400, 26.430),
    Bearing(1, 0.2, 0.25192, 73.857, 1.0055, 3.5919, 0.5281, 12.824),
    Bearing(1, 0.5, 0.89103, 56.699, 2.4695, 4.1650, 0.4510, 4.2802),
    Bearing(1, 0.6, 1.31598, 50.529, 2.9483, 4.3287, 0.4145, 3.2157),
    Bearing(1, 0.8, 3.57189, 36.227, 3.8971, 4.6148, 0.3197, 1.7023),
    Bearing(1, 0.9, 8.45681, 26.472, 4.3697, 4.7371, 0.2481, 1.0528),
    Bearing(0.5, 0.1, 0.03679, 81.755, 0.5909, 3.4310, 0.5228, 85.87),
    Bearing(0.5, 0.2, 0.07833, 75.130, 1.1809, 3.7185, 0.5036, 41.03),
    Bearing(0.5, 0.4, 0.20263, 61.775, 2.3602, 4.2887, 0.4423, 17.092),
    Bearing(0.5, 0.5, 0.31250, 54.989, 2.9502, 4.5715, 0.4058, 11.813),
    Bearing(0.5, 0.6, 0.49847, 48.046, 3.5413, 4.8528, 0.3665, 8.1013),
    Bearing(0.5, 0.9, 5.09454, 23.560, 5.3371, 5.6879, 0.2090, 1.5946),
    Bearing(0.25, 0.1, 0.00981, 82.469, 0.6184, 3.4493, 0.5153, 321.9),
    Bearing(0.25, 0.2, 0.02100, 75.378, 1.2368, 3.7568, 0.4901, 152.8),
    Bearing(0.25, 0.4, 0.05602, 61.196, 2.4737, 4.3716, 0.4171, 61.37),
    Bearing(0.25, 0.5, 0.08885, 54.063, 3.0923, 4.6789, 0.3765, 41.03),
    Bearing(0.25, 0.8, 0.60449, 31.247, 4.9514, 5.6003, 0.2409, 8.869),
    Bearing(0.25, 0.9, 2.16082, 21.787, 5.5749, 5.9073, 0.1797, 3.5025),
]
ROUNDING = {  # half a unit of the last printed digit
    "so": 0.5e-5, "attitude": 0.5e-3, "side_flow": 0.5e-4, "inflow": 0.5e-4, "mean_over_peak": 0.5e-4,
}  # fmt: skip
WORDS = {
    "so": ("Sommerfeld number So", "1"),
    "attitude": ("attitude angle", "deg"),
    "side_flow": ("side flow Qs/(R C N L)", "1"),
    "inflow": ("inflow Q/(R C N L)", "1"),
    "mean_over_peak": ("mean over largest pressure", "1"),
    "friction": ("friction f R/C", "1"),
}


def _rotating(aspect: float, eccentricity: float, n: int) -> Bearing:
    space = _space(aspect, n, periodic=False)
    thickness = space.sample(lambda x, y: 1.0 + eccentricity * np.cos(x))
    posed = film(thickness, 1.0, velocity_moving=(np.ones((1, 1)), ZERO))
    held = {name: Held(0.0) for name in ("left", "right", "top")}
    solution = FilmSolver(space).solve(FilmProblem(space, posed, held, Cavitation.REYNOLDS))
    found = loads(solution)
    assert found.mass_balance_error < 1e-12
    along, across = _force(solution)
    force, width = np.hypot(along, across), 2.0 * aspect
    return Bearing(
        aspect,
        eccentricity,
        so=force / (2.0 * width),
        attitude=float(np.degrees(np.arctan2(across, along))),
        side_flow=2.0 * ROUND * found.flow["top"] / width,
        inflow=-2.0 * ROUND * found.flow["left"] / width,
        mean_over_peak=force / (2.0 * width) / found.pressure_max,
        friction=-2.0 * found.friction_moving[0] / force,
    )


def _refinement(values: tuple[float, ...]) -> str:
    return f"{'/'.join(map(str, MESHES))} cells: {', '.join(f'{value:.6g}' for value in values)}"


@pytest.mark.parametrize("row", TABLE, ids=lambda row: f"{row.aspect:g}-{row.eccentricity:g}")
def test_rotating(row, validation, refine):
    def solve(n: int) -> tuple[float, ...]:
        found = _rotating(row.aspect, row.eccentricity, n)
        return tuple(getattr(found, name) for name in WORDS)

    for (name, (quantity, unit)), found in zip(WORDS.items(), refine(solve, MESHES), strict=True):
        expected = getattr(row, name)
        # Friction is printed with four or five digits, depending on its size.
        rounding = ROUNDING.get(name, 0.5 * 10.0 ** (np.floor(np.log10(expected)) - 3.0))
        validation(
            case="Finite journal bearing",
            source="own converged solution (Raimondi and Boyd 1958; Butenschoen 1976)",
            quantity=f"{quantity}, L/D = {row.aspect:g}, eccentricity ratio {row.eccentricity:g}",
            unit=unit,
            expected=expected,
            obtained=found.finest,
            tolerance=found.front_tolerance(rounding),
            note=_refinement(found.values) if name in ("so", "side_flow") else "",
        )


@pytest.mark.parametrize(
    ("aspect", "eccentricity", "so", "rounding"),
    [
        (1.0, -0.8, 0.6293, 0.5e-4),
        (1.0, -0.4, 1.1392, 0.5e-4),
        (1.0, 0.0, 2.4084, 0.5e-4),
        (1.0, 0.4, 6.8553, 0.5e-4),
        (1.0, 0.8, 50.43, 0.5e-2),
        (0.5, 0.0, 0.7227, 0.5e-4),
        (0.5, 0.8, 26.699, 0.5e-3),
        (0.25, 0.8, 9.619, 0.5e-3),
    ],
)
def test_squeezed(aspect, eccentricity, so, rounding, validation, refine):
    """The journal moves along the line of centres: dh/dt = C (d eps/dt) cos(angle)."""

    def solve(n: int) -> float:
        space = _space(aspect, n, periodic=True)
        thickness = space.sample(lambda x, y: 1.0 + eccentricity * np.cos(x))
        posed = film(thickness, 1.0, squeeze=space.sample(lambda x, y: np.cos(x)))
        problem = FilmProblem(space, posed, {"top": Held(0.0)}, Cavitation.REYNOLDS)
        along, across = _force(FilmSolver(space).solve(problem))
        assert abs(across) < 1e-6 * along
        return along / (4.0 * aspect)

    found = refine(solve, MESHES)
    validation(
        case="Squeezed journal bearing",
        source="own converged solution (Butenschoen 1976)",
        quantity=f"Sommerfeld number So, L/D = {aspect:g}, eccentricity ratio {eccentricity:g}",
        unit="1",
        expected=so,
        obtained=found.finest,
        tolerance=found.front_tolerance(rounding),
        note=_refinement(found.values),
    )
