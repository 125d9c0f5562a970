"""Film equation: sliders with mass-conserving cavitation.

Films that depend on the sliding direction alone: starved, ruptured, and reformed in a second wedge, before an
outlet under pressure or within a pocket. Flow is one number along each of them, so that where it ruptures and
where it reforms follow by quadrature.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
import skfem
from scipy.spatial import Delaunay

from reynolds import (
    ZERO,
    Cell,
    FilmMesh,
    FilmProblem,
    FilmSolution,
    FilmSolver,
    FilmSpace,
    Held,
    Loads,
    at_points,
    film,
    film_space,
    loads,
    rectangle,
)
from reynolds.fem.mesh import box_names

MESHES = (400, 800, 1600)  # cells along the film, two across
Profile = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Slider:
    """Its length m, film thickness over x (m -> m), viscosity Pa s and sliding speed m/s."""

    length: float
    thickness: Profile
    viscosity: float
    speed: float


@dataclass(frozen=True)
class Found:
    """A solved strip: its width m, cavitated x m in rising order, and the integrals."""

    solution: FilmSolution
    width: float
    cavity: np.ndarray
    loads: Loads

    def cavities(self, cell: float) -> list[tuple[float, float]]:
        """First and last cavitated node of each cavity (m), where nodes along x are `cell` apart."""
        ends = np.flatnonzero(np.diff(self.cavity) > 1.5 * cell)
        parts = np.split(self.cavity, ends + 1)
        return [(float(part[0]), float(part[-1])) for part in parts if len(part)]


def _strip(length: float, n: int, cell: Cell) -> FilmSpace:
    """Two rows sewn into a ring: a closed side would tell the two orientations of triangles apart."""
    return film_space(rectangle((length, 2.0 * length / n), (n, 2), cell=cell, periodic_y=True))


def _solve(space: FilmSpace, slider: Slider, left: Held, right: Held, thickness: np.ndarray | None = None) -> Found:
    h = space.sample(lambda x, y: slider.thickness(x)) if thickness is None else thickness
    moving = (np.full((1, 1), slider.speed), ZERO)
    posed = film(h, slider.viscosity, velocity_moving=moving)
    solution = FilmSolver(space).solve(FilmProblem(space, posed, {"left": left, "right": right}))
    place = np.zeros(space.size)
    place[space.vertex_dofs] = space.vertices[:, 0]
    found = loads(solution)
    assert found.mass_balance_error < 1e-11
    assert found.flow["left"] == pytest.approx(-found.flow["right"], rel=1e-10, abs=0.0)
    return Found(solution, float(np.ptp(space.vertices[:, 1])), np.unique(place[solution.cavity]), found)


# ---- starved slider


WEDGE = Slider(0.01, lambda x: 1e-5 * (2.0 - x / 0.01), 0.03, 1.0)
WEDGE_PRESSURE = 0.03 * 1.0 * 0.01 / 1e-5**2
STARVED = [  # film fraction at the inlet, start of the film x/L, load and largest pressure as in 3.1
    (0.65, 0.142857, 0.114235, 0.207692),
    (0.60, 0.5, 0.032791, 0.1),
    (0.55, 0.777778, 0.004024, 0.027273),
]


def _starved(fraction: float, n: int, cell: Cell) -> tuple[float, ...]:
    found = _solve(_strip(WEDGE.length, n, cell), WEDGE, Held(0.0, fraction), Held(0.0))
    load = found.loads.load / (found.width * WEDGE.length * WEDGE_PRESSURE)
    flow = found.loads.flow["right"] / (found.width * WEDGE.speed * 1e-5)
    start = found.cavity.max(initial=0.0) / WEDGE.length
    return load, found.loads.pressure_max / WEDGE_PRESSURE, flow, start


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("row", STARVED, ids=lambda row: f"{row[0]:g}")
def test_starved_slider(row, cell, validation, refine):
    """The inflow is film fraction x U h/2; the film begins where a full one carries no less."""
    fraction, start, load, peak = row
    *found, front = refine(lambda n: _starved(fraction, n, cell), MESHES, 1.0)
    quantities = (
        ("load W h0^2/(mu U L^2)", load, 0.5e-6),
        ("largest pressure p h0^2/(mu U L)", peak, 0.5e-6),
        ("flow q/(U h0)", fraction, 0.0),
    )
    for (quantity, expected, rounding), column in zip(quantities, found, strict=True):
        validation(
            case="Starved slider",
            source="closed form along the film",
            quantity=f"{quantity}, film fraction {fraction:g} at the inlet, {cell.value}",
            unit="1",
            expected=expected,
            obtained=column.finest,
            tolerance=column.front_tolerance(rounding),
        )
    validation(
        case="Starved slider",
        source="closed form along the film",
        quantity=f"start of the film x/L, film fraction {fraction:g} at the inlet, {cell.value}",
        unit="1",
        expected=start,
        obtained=front.finest + 0.5 / MESHES[-1],
        tolerance=1.5 / MESHES[-1] + 0.5e-6,
        note="between the last node of the cavity and the next; tolerance 1.5 cells",
    )


@pytest.mark.parametrize("fraction", [0.7, 0.9])
def test_flooded_slider(fraction, validation, refine):
    """More than 2/3 is more than the full film takes: the rest is pushed back in the first cell."""
    load, *_ = refine(lambda n: _starved(fraction, n, Cell.QUADRILATERAL), MESHES, 1.0)
    validation(
        case="Starved slider",
        source="closed form along the film",
        quantity=f"load W h0^2/(mu U L^2), film fraction {fraction:g} at the inlet: fully flooded",
        unit="1",
        expected=0.15888308,
        obtained=load.finest,
        tolerance=load.front_tolerance(0.5e-8),
        order=load.order,
    )


# ---- parabolic sliders

THIN, THICK = 25.4e-6, 50.8e-6


def _parabola(u: np.ndarray) -> np.ndarray:
    return THIN + (THICK - THIN) * (2.0 * u - 1.0) ** 2


PARABOLIC = Slider(0.0762, lambda x: _parabola(x / 0.0762), 0.039, 4.57)
TWIN = replace(PARABOLIC, thickness=lambda x: _parabola((2.0 * x / 0.0762) % 1.0))

# Boundary pressures Pa, film fronts x/L in order (rupture, reformation, ...; the outlet is no front), then largest
# pressure Pa, load N/m and flow m2/s with their rounding, None where 3.4 gives none.
PARABOLIC_ROWS = [
    ("parabolic", PARABOLIC, 0.0, 0.0, (0.678934,), (3.591787e6, 0.5), (101349.5, 0.05), (6.547206e-5, 5e-12)),
    (
        "parabolic", PARABOLIC, 101325.0, 101325.0, (0.680228, 0.992661),
        (3.666656e6, 0.5), (104640.97, 0.005), (6.557989e-5, 5e-12),
    ),
    (
        "parabolic", PARABOLIC, 0.336e6, 0.0, (0.683178,),
        (3.841062e6, 0.5), (112185.77, 0.005), (6.582879e-5, 5e-12),
    ),
    ("twin", TWIN, 0.0, 0.0, (0.339467, 0.5, 0.839467), (1.7958936e6, 0.05), (50674.75, 0.005), None),
    (
        "twin", TWIN, 0.336e6, 0.0, (0.343649, 0.475911, 0.843649),
        (2.0465588e6, 0.05), (61843.79, 0.005), (6.618318e-5, 5e-12),
    ),
]  # fmt: skip


@pytest.mark.parametrize("cell", list(Cell))
@pytest.mark.parametrize("row", PARABOLIC_ROWS, ids=lambda row: f"{row[0]}-{row[2]:g}-{row[3]:g}")
def test_parabolic_slider(row, cell, validation, refine):
    kind, slider, left, right, fronts, *integrals = row
    where = f"{kind}, {left / 1e6:g} / {right / 1e6:g} MPa, {cell.value}"

    def solve(n: int) -> tuple[float, ...]:
        found = _solve(_strip(slider.length, n, cell), slider, Held(left), Held(right))
        ends = np.array(found.cavities(slider.length / n)).ravel() / slider.length
        # An end of a cavity lies half a cell from its last node: before it at a rupture, behind at a reformation.
        at = ends[: len(fronts)] + np.where(np.arange(len(fronts)) % 2 == 0, -0.5, 0.5) / n
        flow = found.loads.flow["right"] / found.width
        return found.loads.pressure_max, found.loads.load / found.width, flow, *at

    columns = refine(solve, MESHES, 1.0)
    names = (("largest pressure", "Pa"), ("load", "N/m"), ("flow", "m2/s"))
    for (name, unit), given, column in zip(names, integrals, columns, strict=False):
        if given is None:
            continue
        expected, rounding = given
        validation(
            case="Parabolic slider, film ruptured and reformed",
            source="quadrature; sliders of Vijayaraghavan and Keith 1989",
            quantity=f"{name}, {where}",
            unit=unit,
            expected=expected,
            obtained=column.finest,
            tolerance=column.front_tolerance(rounding),
        )
    for k, (expected, column) in enumerate(zip(fronts, columns[3:], strict=True)):
        validation(
            case="Parabolic slider, film ruptured and reformed",
            source="quadrature; sliders of Vijayaraghavan and Keith 1989",
            quantity=f"{'reformation' if k % 2 else 'rupture'} x/L, {where}",
            unit="1",
            expected=expected,
            obtained=column.finest,
            tolerance=1.5 / MESHES[-1] + 0.5e-6,
            note="between two nodes; tolerance 1.5 cells",
        )


def test_parabolic_slider_least_fraction(validation, refine):
    """Least film fraction and place of the largest pressure, under atmospheric pressure at both ends."""

    def solve(n: int) -> tuple[float, float]:
        space = _strip(PARABOLIC.length, n, Cell.QUADRILATERAL)
        found = _solve(space, PARABOLIC, Held(101325.0), Held(101325.0))
        return float(found.solution.film_fraction.min()), found.loads.pressure_max_at[0] / PARABOLIC.length

    least, place = refine(solve, MESHES, 1.0)
    validation(
        case="Parabolic slider, film ruptured and reformed",
        source="quadrature; sliders of Vijayaraghavan and Keith 1989",
        unit="1",
        quantity="least film fraction, parabolic, 0.101325 / 0.101325 MPa",
        expected=0.573318,
        obtained=least.finest,
        tolerance=least.front_tolerance(0.5e-6),
    )
    validation(
        case="Parabolic slider, film ruptured and reformed",
        source="quadrature; sliders of Vijayaraghavan and Keith 1989",
        unit="1",
        quantity="place of the largest pressure x/L, parabolic, 0.101325 / 0.101325 MPa",
        expected=0.31978,
        obtained=place.finest,
        tolerance=1.0 / MESHES[-1],
        note="the node with the largest pressure; tolerance one cell",
    )


def test_parabolic_slider_place_of_the_peak(validation):
    n = MESHES[-1]
    found = _solve(_strip(PARABOLIC.length, n, Cell.QUADRILATERAL), PARABOLIC, Held(0.0), Held(0.0))
    validation(
        case="Parabolic slider, film ruptured and reformed",
        source="quadrature; sliders of Vijayaraghavan and Keith 1989",
        unit="1",
        quantity="place of the largest pressure x/L, parabolic, 0 / 0 MPa",
        expected=0.321066,
        obtained=found.loads.pressure_max_at[0] / PARABOLIC.length,
        tolerance=1.0 / n,
        note="the node with the largest pressure; tolerance one cell",
    )


# ---- pocket slider

LAND, POCKET, LENGTH = 2e-3, 5e-3, 10e-3  # ends of the first land, of the pocket, of the film, m
FIRST, LAST = 2.5e-3, 3.5e-3  # well within the cavity, m
FOWELL = Slider(LENGTH, lambda x: 1e-6 * (1.05 - 0.05 * x / LENGTH), 0.01, 1.0)
# theta = hm/h in the cavity, hm = 2 q/U: its mean; theta runs from .512709 to .514742.
FRACTION = 1.045927004785 / 0.05 * LENGTH / (LAST - FIRST) * np.log((2.05 - 0.0125) / (2.05 - 0.0175))


def _unstructured(n: int) -> FilmMesh:
    """Delaunay triangles of shaken points that keep to the sides and to the ends of the pocket; four rows."""
    cell = LENGTH / n
    x, y = (a.ravel() for a in np.meshgrid(np.linspace(0.0, LENGTH, n + 1), np.arange(5) * cell, indexing="ij"))
    shake = np.random.default_rng(n).uniform(-0.2, 0.2, (2, len(x))) * cell
    lines = np.abs(x[:, None] - np.array([0.0, LAND, POCKET, LENGTH])).min(axis=1) < 0.1 * cell
    sides = (y < 0.1 * cell) | (y > 3.9 * cell)
    x, y = x + np.where(lines, 0.0, shake[0]), y + np.where(sides, 0.0, shake[1])
    triangles = Delaunay(np.column_stack([x, y])).simplices
    mesh = skfem.MeshTri(np.vstack([x, y]), np.ascontiguousarray(triangles.T))
    return FilmMesh(replace(mesh, _boundaries=box_names(mesh)))


def _pocket_slider(n: int, mesh: Callable[[int], FilmMesh]) -> tuple[float, ...]:
    space = film_space(mesh(n))
    centre = space.vertices[space.cells][:, :, 0].mean(axis=1)
    inside = (centre > LAND) & (centre < POCKET)
    h = space.sample(lambda x, y: FOWELL.thickness(x)) + 1e-6 * inside[:, None]
    found = _solve(space, FOWELL, Held(1e5), Held(1e5), h)
    x = space.points[0]
    within = np.where((x > FIRST) & (x < LAST), space.area, 0.0)
    fraction = float(np.sum(at_points(space, found.solution.film_fraction) * within) / within.sum())
    return (
        found.loads.pressure_max,
        found.loads.load / found.width,
        found.loads.flow["right"] / found.width,
        fraction,
        float(found.cavity.max()) + 0.5 * LENGTH / n,
    )


@pytest.mark.parametrize(
    ("kind", "meshes"), [("triangle", MESHES), ("quadrilateral", MESHES), ("unstructured", (200, 400, 800))]
)
def test_pocket_slider(kind, meshes, validation, refine):
    def regular(n: int) -> FilmMesh:
        return rectangle((LENGTH, 2.0 * LENGTH / n), (n, 2), cell=Cell(kind), periodic_y=True)

    *columns, front = refine(
        lambda n: _pocket_slider(n, _unstructured if kind == "unstructured" else regular), meshes, 1.0
    )
    quantities = (
        ("largest pressure", "Pa", 9.808819e6, 0.5),
        ("load", "N/m", 35165.70, 0.005),
        ("flow", "m2/s", 5.229635e-7, 5e-14),
        ("mean film fraction at x = 2.5 .. 3.5 mm", "1", FRACTION, 0.5e-6),
    )
    for (quantity, unit, expected, rounding), column in zip(quantities, columns, strict=True):
        validation(
            case="Pocket slider, film reformed within the pocket",
            source="Fowell et al. 2007, closed form",
            quantity=f"{quantity}, {kind}",
            unit=unit,
            expected=expected,
            obtained=column.finest,
            tolerance=column.front_tolerance(rounding),
        )
    validation(
        case="Pocket slider, film reformed within the pocket",
        source="Fowell et al. 2007, closed form",
        quantity=f"reformation x, {kind}",
        unit="m",
        expected=3.611263e-3,
        obtained=front.finest,
        tolerance=1.5 * LENGTH / meshes[-1],
        note="behind the last node of the cavity; tolerance 1.5 cells",
    )
