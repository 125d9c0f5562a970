"""Film equation: the piston's annulus, eccentric, tapered and tilted.

The annulus is unwrapped: x runs round the piston and is sewn, y along it from the pressure side. The smallest
film of an eccentric piston is at angle 0.
"""

from __future__ import annotations

import numpy as np
import pytest

from reynolds import Cavitation, Cell, FilmProblem, FilmSolver, Held, film, film_space, loads, point_fields, rectangle

DIAMETER, LENGTH, CLEARANCE, PRESSURE, VISCOSITY = 20e-3, 30e-3, 10e-6, 30e6, 0.02
RADIUS = DIAMETER / 2
MESHES = (24, 48, 96)


def _solve(thickness, n: int) -> tuple[float, float, float]:
    """Side force, its moment about mid-length and leakage for a film given by angle and z/L."""
    space = film_space(rectangle((np.pi * DIAMETER, LENGTH), (2 * n, n), cell=Cell.QUADRILATERAL, periodic_x=True))
    posed = film(space.sample(lambda x, y: thickness(x / RADIUS, y / LENGTH)), VISCOSITY)
    held = {"bottom": Held(PRESSURE), "top": Held(0.0)}
    solution = FilmSolver(space).solve(FilmProblem(space, posed, held, Cavitation.NONE))
    pull = -point_fields(solution).pressure * np.cos(space.points[0] / RADIUS) * space.area
    return (float(np.sum(pull)), float(np.sum(pull * (space.points[1] - LENGTH / 2))), loads(solution).flow["top"])


@pytest.mark.parametrize("eccentricity", [0.0, 0.5, 0.9])
def test_eccentric(eccentricity, validation, refine):
    concentric = np.pi * DIAMETER * CLEARANCE**3 * PRESSURE / (12.0 * VISCOSITY * LENGTH)
    assert concentric == pytest.approx(2.617994e-7, rel=1e-6)
    force, _, leakage = refine(
        lambda n: _solve(lambda phi, z: CLEARANCE * (1.0 - eccentricity * np.cos(phi)), n), MESHES
    )
    assert abs(force.finest) < 1e-9 * PRESSURE * RADIUS * LENGTH  # a parallel film centres nothing
    validation(
        case="Eccentric piston",
        source="closed form, paper equation (15)",
        quantity=f"leakage, eccentricity ratio {eccentricity:g}",
        unit="m3/s",
        expected=concentric * (1.0 + 1.5 * eccentricity**2),
        obtained=leakage.finest,
        tolerance=leakage.tolerance(),
        order=leakage.order,
        note="pressure linear along the piston; quadrature of h^3 round it" if leakage.order is None else "",
    )


def _tapered(phi, z):
    return CLEARANCE * (1.0 - 0.5 * np.cos(phi)) + 5e-6 * (1.0 - z)


def _tilted(phi, z):
    return CLEARANCE * (1.0 - 0.5 * (2.0 * z - 1.0) * np.cos(phi))


@pytest.mark.parametrize(
    ("name", "thickness", "force", "moment", "leakage"),
    [
        ("tapered", _tapered, (-582.807, 0.5e-3), (-1.294073, 0.5e-6), (5.95936e-7, 0.5e-12)),
        ("tilted", _tilted, (-3722.951, 0.5e-3), (0.0, 0.0), (2.447253e-7, 0.5e-13)),
    ],
)
def test_hydraulic_lock(name, thickness, force, moment, leakage, validation, refine):
    quantities = (
        ("side force", "N", *force),
        ("moment about mid-length", "N m", *moment),
        ("leakage", "m3/s", *leakage),
    )
    found = refine(lambda n: _solve(thickness, n), MESHES)
    for (quantity, unit, expected, rounding), column in zip(quantities, found, strict=True):
        if expected == 0.0:
            assert abs(column.finest) < 1e-9 * abs(force[0]) * LENGTH
            continue
        validation(
            case="Tapered and tilted piston",
            source="own converged solution",
            quantity=f"{quantity}, {name}",
            unit=unit,
            expected=expected,
            obtained=column.finest,
            tolerance=column.tolerance(rounding),
            order=column.order,
        )
