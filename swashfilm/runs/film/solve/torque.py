"""Friction torque of a free film."""

from __future__ import annotations

from reynolds.problem import FilmSolution
from reynolds.solve.bearing import radius_around
from reynolds.solve.loads import Loads
from swashfilm.case.tables.film import Geometry


def friction_torque(solution: FilmSolution, integrals: Loads, geometry: Geometry) -> float:
    """Return the torque of oil and contact on the moving wall, N m: about the origin, of a cylinder about its axis."""
    if geometry is Geometry.CYLINDER:
        return radius_around(solution.problem.space) * integrals.friction_moving[0]
    return integrals.friction_torque_moving
