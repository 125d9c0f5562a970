"""Film equation: sliders and the Rayleigh step.

One wall slides over a wedge or a step. Closed forms of the infinitely wide ones: Rayleigh 1918.
"""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import (
    ZERO,
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
    rectangle,
)

LENGTH, OUTLET, VISCOSITY, SPEED = 0.01, 1e-5, 0.03, 1.0
PRESSURE_SCALE = VISCOSITY * SPEED * LENGTH / OUTLET**2
SLIDING = (np.full((1, 1), SPEED), ZERO)
WIDE = LENGTH / 4  # strip of the infinitely wide slider, its sides sewn together


def _solve(space: FilmSpace, thickness: np.ndarray, held: tuple[str, ...]) -> FilmSolution:
    problem = FilmProblem(
        space, film(thickness, VISCOSITY, velocity_moving=SLIDING), {name: Held(0.0) for name in held}
    )
    return FilmSolver(space).solve(problem)


def _wedge(space: FilmSpace, ratio: float) -> np.ndarray:
    return space.sample(lambda x, y: OUTLET * (ratio - (ratio - 1.0) * x / LENGTH))


def _wide_slider(ratio: float, n: int, degree: int) -> Loads:
    space = film_space(rectangle((LENGTH, WIDE), (n, 2), periodic_y=True), degree=degree)
    return loads(_solve(space, _wedge(space, ratio), ("left", "right")))


def _scaled(found: Loads, width: float) -> tuple[float, ...]:
    return (
        found.load / (PRESSURE_SCALE * LENGTH * width),
        found.flow["right"] / (SPEED * OUTLET * width),
        -found.friction_moving[0] * OUTLET / (VISCOSITY * SPEED * LENGTH * width),
        -found.moment_y / found.load / LENGTH,
    )


def _centre_of_pressure(n: float) -> float:
    """x/L from the inlet, by quadrature of the closed-form pressure p* = 6 (h-1)(n-h)/((n^2-1) h^2)."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    x = 0.5 * (nodes + 1.0)
    h = n - (n - 1.0) * x
    p = (h - 1.0) * (n - h) / h**2
    return float(np.sum(weights * p * x) / np.sum(weights * p))


@pytest.mark.parametrize("n", [1.5, 2.0, 2.1887048, 3.0, 5.0])
def test_wide_slider(n, validation, refine):
    load = 6.0 / (n - 1.0) ** 2 * (np.log(n) - 2.0 * (n - 1.0) / (n + 1.0))
    friction = 4.0 * np.log(n) / (n - 1.0) - 6.0 / (n + 1.0)
    exact = {
        "load W h0^2/(mu U L^2)": load,
        "flow q/(U h0)": n / (n + 1.0),
        "friction F h0/(mu U L)": friction,
        "centre of pressure x/L": _centre_of_pressure(n),
    }
    found = refine(lambda cells: _scaled(_wide_slider(n, cells, 1), WIDE), (16, 32, 64))
    for (quantity, value), column in zip(exact.items(), found, strict=True):
        validation(
            case="Infinitely wide linear slider",
            source="Rayleigh 1918, closed form",
            quantity=f"{quantity}, n = {n:.7g}, P1",
            unit="1",
            expected=value,
            obtained=column.finest,
            tolerance=column.tolerance(),
            order=column.order,
        )


def test_wide_slider_table(validation, refine):
    """The printed digits, with P2: its load converges with the fourth order."""
    table = {1.5: 0.13116259, 2.0: 0.15888308, 2.1887048: 0.16024314, 3.0: 0.14791843, 5.0: 0.10353922}
    for n, load in table.items():
        found, *_ = refine(lambda cells, n=n: _scaled(_wide_slider(n, cells, 2), WIDE), (16, 32, 64), 4.0)
        validation(
            case="Infinitely wide linear slider",
            source="Rayleigh 1918, closed form",
            quantity=f"load W h0^2/(mu U L^2), n = {n:.7g}, P2",
            unit="1",
            expected=load,
            obtained=found.finest,
            tolerance=found.tolerance(rounding=0.5e-8),
            order=found.order,
        )


@pytest.mark.parametrize("n", [1.5, 2.0, 2.1887048, 3.0, 5.0])
def test_wide_slider_peak(n, validation, refine):
    """The largest nodal pressure misses the peak by at most |p''| (cell/2)^2/2, with p'' from the equation."""
    cells = 64

    def solve(cells: int) -> tuple[float, float]:
        peak = _wide_slider(n, cells, 1)
        return peak.pressure_max / PRESSURE_SCALE, peak.pressure_max_at[0] / LENGTH

    found, place = refine(solve, (16, 32, cells))
    curvature = 6.0 * (n - 1.0) / (2.0 * n / (n + 1.0)) ** 3
    between_nodes = curvature * (0.5 / cells) ** 2 / 2.0
    nodal = curvature / (8.0 * cells**2)  # nodal values of P1 are interpolants up to the same order
    validation(
        case="Infinitely wide linear slider",
        source="Rayleigh 1918, closed form",
        quantity=f"largest pressure p h0^2/(mu U L), n = {n:.7g}, P1",
        unit="1",
        expected=1.5 * (n - 1.0) / (n * (n + 1.0)),
        obtained=found.finest,
        tolerance=2.0 * (between_nodes + nodal),
        note="tolerance: curvature at the peak x cell^2/2",
    )
    validation(
        case="Infinitely wide linear slider",
        source="Rayleigh 1918, closed form",
        quantity=f"place of the largest pressure x/L, n = {n:.7g}, P1",
        unit="1",
        expected=n / (n + 1.0),
        obtained=place.finest,
        tolerance=1.0 / cells,
        note="the node with the largest pressure; tolerance one cell",
    )


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize(("n", "s"), [(1.0 + np.sqrt(3.0) / 2.0, 0.7182335), (2.0, 0.5)])
def test_rayleigh_step(cell, n, s, validation):
    """Pressure is linear on either side of the step: P1 and Q1 are exact on a mesh with a node line there."""
    space = film_space(rectangle((LENGTH, WIDE), (6, 2), cell=cell, periodic_y=True))
    x, y = space.vertices.T
    split = np.where(x <= LENGTH / 2, 2.0 * s * x, LENGTH * s + (2.0 * x - LENGTH) * (1.0 - s))
    space = space.moved(np.column_stack([split, y]))
    centre = space.points[0].mean(axis=1)
    solution = _solve(space, space.sample_cells(np.where(centre < s * LENGTH, n, 1.0) * OUTLET), ("left", "right"))
    found = loads(solution)
    peak = 6.0 * (n - 1.0) / (n**3 / s + 1.0 / (1.0 - s))
    obtained = {
        "step pressure p h0^2/(mu U L)": (peak, found.pressure_max / PRESSURE_SCALE),
        "load W h0^2/(mu U L^2)": (0.5 * peak, found.load / (PRESSURE_SCALE * LENGTH * WIDE)),
        "flow q/(U h0)": (0.5 + peak / (12.0 * (1.0 - s)), found.flow["right"] / (SPEED * OUTLET * WIDE)),
    }
    for quantity, (expected, value) in obtained.items():
        validation(
            case="Rayleigh step",
            source="Rayleigh 1918, closed form",
            quantity=f"{quantity}, n = {n:.5g}, s = {s:.5g}, {cell.value}",
            unit="1",
            expected=expected,
            obtained=value,
            relative_tolerance=1e-10,
            note="exact on an aligned mesh",
        )


def _chebyshev(points: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes on [0, 1] and the differentiation matrix (Trefethen 2000)."""
    x = np.cos(np.pi * np.arange(points + 1) / points)
    c = np.where((np.arange(points + 1) % points) == 0, 2.0, 1.0) * (-1.0) ** np.arange(points + 1)
    apart = x[:, None] - x[None, :] + np.eye(points + 1)
    d = np.outer(c, 1.0 / c) / apart
    d -= np.diag(d.sum(axis=1))
    return 0.5 * (x + 1.0), 2.0 * d


def _finite_slider(n: float, aspect: float, terms: int = 60) -> tuple[float, float, float]:
    """Load, largest pressure and its second derivative along x: an answer without finite elements.

    Sine series across the width; each coefficient solves (h^3 f')' - h^3 k^2 f = 6 h' s, by collocation.
    """
    x, d = _chebyshev(64)
    h = n - (n - 1.0) * x
    load, middle = 0.0, np.zeros_like(x)
    nodes, weights = np.polynomial.legendre.leggauss(40)
    for m in range(1, 2 * terms, 2):
        wave = m * np.pi / aspect
        operator = d @ np.diag(h**3) @ d - np.diag(h**3 * wave**2)
        source = np.full_like(x, -6.0 * (n - 1.0) * 4.0 / (m * np.pi))
        f = np.zeros_like(x)
        f[1:-1] = np.linalg.solve(operator[1:-1, 1:-1], source[1:-1])
        along = np.polynomial.Chebyshev.fit(x, f, 64, domain=(0.0, 1.0))
        load += 0.5 * float(np.sum(weights * along(0.5 * (nodes + 1.0)))) * 2.0 / (m * np.pi)
        middle += f * np.sin(0.5 * m * np.pi)
    profile = np.polynomial.Chebyshev.fit(x, middle, 64, domain=(0.0, 1.0))
    fine = np.linspace(0.0, 1.0, 20001)
    top = int(np.argmax(profile(fine)))
    return load, float(profile(fine[top])), float(profile.deriv(2)(fine[top]))


@pytest.mark.parametrize("aspect", [0.25, 0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("n", [2.0, 3.0])
def test_finite_slider(n, aspect, validation, refine):
    """B/L = aspect, pressure zero on all edges. Half of it: the midplane is a closed boundary."""

    def solve(cells: int) -> tuple[float, float]:
        half = 0.5 * aspect * LENGTH
        space = film_space(rectangle((LENGTH, half), (cells, cells), cell=Cell.QUADRILATERAL))
        found = loads(_solve(space, _wedge(space, n), ("left", "right", "top")))
        return found.load / (PRESSURE_SCALE * LENGTH * half), found.pressure_max / PRESSURE_SCALE

    meshes = (24, 48, 96)
    load, peak, curvature = _finite_slider(n, aspect)
    loads_found, peaks = refine(solve, meshes)
    validation(
        case="Finite slider",
        source="sine series over the width, collocation along the length",
        quantity=f"load W h0^2/(mu U L^2 B), n = {n:g}, B/L = {aspect:g}",
        unit="1",
        expected=load,
        obtained=loads_found.finest,
        tolerance=loads_found.tolerance(),
        order=loads_found.order,
    )
    validation(
        case="Finite slider",
        source="sine series over the width, collocation along the length",
        quantity=f"largest pressure p h0^2/(mu U L), n = {n:g}, B/L = {aspect:g}",
        unit="1",
        expected=peak,
        obtained=peaks.finest,
        tolerance=peaks.front_tolerance() + abs(curvature) / (8.0 * meshes[-1] ** 2),
        note="largest nodal value; tolerance with what may lie between nodes",
    )


PRINTED = {  # B/L: load for n = 2 and n = 3, largest pressure for n = 2
    0.25: (0.00929, 0.01001, 0.0252),
    0.5: (0.02916, 0.02981, 0.0709),
    1.0: (0.06929, 0.06751, 0.1574),
    2.0: (0.11048, 0.10476, 0.2306),
    4.0: (0.13462, 0.12629, 0.2492),
}


@pytest.mark.parametrize("aspect", PRINTED)
def test_finite_slider_table(aspect, validation):
    """A printed table against the series: to two units of its last digit, not to half a unit."""
    (two, peak, _), (three, _, _) = _finite_slider(2.0, aspect), _finite_slider(3.0, aspect)
    rows = (
        ("load W h0^2/(mu U L^2 B), n = 2", two, 2e-5), ("load W h0^2/(mu U L^2 B), n = 3", three, 2e-5),
        ("largest pressure p h0^2/(mu U L), n = 2", peak, 2e-4),
    )  # fmt: skip
    for (quantity, series, digits), expected in zip(rows, PRINTED[aspect], strict=True):
        validation(
            case="Finite slider, printed table against the series",
            source="own converged solution",
            quantity=f"{quantity}, B/L = {aspect:g}",
            unit="1",
            expected=expected,
            obtained=series,
            tolerance=digits,
            note="two units of the last printed digit; the films above are held to the series",
        )
