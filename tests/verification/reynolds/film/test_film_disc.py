"""Film equation: discs and annuli, hydrostatic, squeezed and spinning."""

from __future__ import annotations

import numpy as np
import pytest
import skfem

from reynolds import Cell, FilmMesh, FilmProblem, FilmSolver, FilmSpace, Held, Loads, annulus, film, film_space, loads
from reynolds.fem.mesh import loop_names

VISCOSITY, THICKNESS = 0.03, 1e-5
INNER, OUTER = 5e-3, 10e-3
DROP = 20e6
APPROACH = 1e-3
SPIN = 100.0


def _disc(refinements: int) -> FilmSpace:
    mesh = skfem.MeshTri.init_circle(refinements).scaled(OUTER)
    return film_space(FilmMesh(mesh.with_boundaries(loop_names(mesh))))


def _annulus_loads(cell: Cell, n: int, *, inner: float = 0.0, squeeze: float = 0.0, spin: float = 0.0) -> Loads:
    space = film_space(annulus(INNER, OUTER, (n, 6 * n), cell=cell))
    x, y = space.points
    posed = film(
        space.sample(THICKNESS), VISCOSITY, velocity_moving=(-spin * y, spin * x), squeeze=space.sample(squeeze)
    )
    problem = FilmProblem(space, posed, {"inner": Held(inner), "outer": Held(0.0)})
    return loads(FilmSolver(space).solve(problem))


def test_squeezed_disc(validation, refine):
    def load(refinements: int) -> float:
        space = _disc(refinements)
        posed = film(space.sample(THICKNESS), VISCOSITY, squeeze=space.sample(-APPROACH))
        return loads(FilmSolver(space).solve(FilmProblem(space, posed, {"outer": Held(0.0)}))).load

    found = refine(lambda n: load(int(np.log2(n))), (8, 16, 32))
    validation(
        case="Squeezed disc",
        source="Reynolds 1886, closed form",
        quantity="load",
        unit="N",
        expected=3.0 * np.pi * VISCOSITY * OUTER**4 * APPROACH / (2.0 * THICKNESS**3),
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


@pytest.mark.parametrize("cell", list(Cell))
def test_hydrostatic_annulus(cell, validation, refine):
    def solve(n: int) -> tuple[float, float]:
        found = _annulus_loads(cell, n, inner=DROP)
        return found.flow["outer"], found.load + np.pi * INNER**2 * DROP

    resistance = 6.0 * VISCOSITY * np.log(OUTER / INNER) / (np.pi * THICKNESS**3)
    lift = np.pi * DROP * (OUTER**2 - INNER**2) / (2.0 * np.log(OUTER / INNER))
    flow, load = refine(solve, (8, 16, 32))
    for quantity, unit, expected, found in (
        ("flow", "m3/s", DROP / resistance, flow),
        ("lift with the pocket", "N", lift, load),
    ):
        validation(
            case="Hydrostatic annulus",
            source="closed form",
            quantity=f"{quantity}, {cell.value}",
            unit=unit,
            expected=expected,
            obtained=found.finest,
            tolerance=found.tolerance(),
            order=found.order,
        )


@pytest.mark.parametrize("cell", list(Cell))
def test_squeezed_annulus(cell, validation, refine):
    k = INNER / OUTER
    exact = 1.5 * np.pi * VISCOSITY * APPROACH * OUTER**4 / THICKNESS**3
    exact *= 1.0 - k**4 + (1.0 - k**2) ** 2 / np.log(k)
    found = refine(lambda n: _annulus_loads(cell, n, squeeze=-APPROACH).load, (8, 16, 32))
    validation(
        case="Squeezed annulus",
        source="closed form",
        quantity=f"load, {cell.value}",
        unit="N",
        expected=exact,
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )


@pytest.mark.parametrize("cell", list(Cell))
def test_spinning_annulus(cell, validation, refine):
    found = refine(lambda n: -_annulus_loads(cell, n, spin=SPIN).friction_torque_moving, (8, 16, 32))
    validation(
        case="Spinning annulus",
        source="closed form",
        quantity=f"friction torque, {cell.value}",
        unit="N m",
        expected=np.pi * VISCOSITY * SPIN * (OUTER**4 - INNER**4) / (2.0 * THICKNESS),
        obtained=found.finest,
        tolerance=found.tolerance(),
        order=found.order,
    )
    assert _annulus_loads(cell, 8, spin=SPIN).load == pytest.approx(0.0, abs=1e-9)
