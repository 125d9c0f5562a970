"""Load and torque of a film unrolled from a full turn of a cylinder: those of a journal bearing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reynolds.fem.space import FilmSpace
from reynolds.problem import FilmSolution
from reynolds.solve.loads import point_fields


@dataclass(frozen=True)
class BearingLoad:
    """Load of a bearing: size, N, and attitude angle, rad, 0 to pi.

    The attitude angle lies between the load and the line of centres towards the narrowest place.
    """

    size: float
    attitude: float


def radius_around(space: FilmSpace) -> float:
    """Radius, m, of the cylinder around which the x of a film runs once."""
    return float(np.ptp(space.vertices[:, 0])) / (2.0 * np.pi)


def directions(space: FilmSpace) -> NDArray[np.complex128]:
    """Directions exp(2 pi i x/L) at the points (cells, points) of a film of length L whose x runs once around."""
    return np.asarray(np.exp(1j * space.points[0] / radius_around(space)))


def bearing_load(solution: FilmSolution) -> BearingLoad:
    """The load of a film whose x runs once around: W = int (p + p_c) exp(2 pi i x/L) dA as a vector.

    p_c is the pressure of the contact. The line of centres is the first harmonic of the film thickness.
    """
    space, fields = solution.problem.space, point_fields(solution)
    around = directions(space) * space.area
    load = complex(np.sum((fields.pressure + fields.contact_pressure) * around))
    widest = complex(np.sum(solution.film.thickness * around))
    return BearingLoad(abs(load), float(abs(np.angle(-load * widest.conjugate()))))
