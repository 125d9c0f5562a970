"""Load of a film unrolled from a full turn of a cylinder, as a vector: that of a journal bearing."""

from __future__ import annotations

import numpy as np

from reynolds.problem import FilmSolution
from reynolds.solve.loads import point_fields


def bearing_summary(solution: FilmSolution) -> dict[str, float]:
    """Return load (N) and attitude angle (deg, 0 to 180) of a film whose x runs once around.

    The load is the vector integral of the pressures of film and contact. The attitude angle lies between it and the
    line of centres towards the narrowest place, which is the first harmonic of the film's thickness.
    """
    space, fields = solution.problem.space, point_fields(solution)
    around = np.exp(2j * np.pi * space.points[0] / np.ptp(space.vertices[:, 0])) * space.area
    load = complex(np.sum((fields.pressure + fields.contact_pressure) * around))
    widest = complex(np.sum(solution.film.thickness * around))
    return {
        "bearing_load_N": abs(load),
        "attitude_angle_deg": float(np.degrees(abs(np.angle(-load * widest.conjugate())))),
    }
