"""Load of the full film of the journal bearing (`journal_case`) without finite elements.

The pressure is a cosine series over the half-width, sum of f_m(x) cos(k_m y) with k_m = (m - 1/2) pi, and each
coefficient solves (h^3 f')' - k^2 h^3 f = 6 h' c_m between the largest and the least film, where f = 0, by
Chebyshev collocation (Trefethen 2000).
"""

from __future__ import annotations

import math

import numpy as np
from journal_case import ECCENTRICITY

POINTS = 64
TERMS = 400


def force() -> tuple[float, float]:
    """Force of the positive pressures on the whole bearing, towards the largest film and along x there.

    The terms fall as 1/m^4: the remainder beyond the last is below 1e-8 of the force.
    """
    x, slope = _chebyshev(math.pi)
    film, wedge = 1.0 + ECCENTRICITY * np.cos(x), -ECCENTRICITY * np.sin(x)
    along = slope @ (film[:, None] ** 3 * slope)
    angles, weights = np.polynomial.legendre.leggauss(POINTS)
    angles, weights = 0.5 * math.pi * (angles + 1.0), 0.5 * math.pi * weights
    total = np.zeros(len(x))
    for m in range(1, TERMS + 1):
        wave = (m - 0.5) * math.pi
        part = 2.0 * (-1.0) ** (m + 1) / wave  # of one in cos(k y); its integral over the half-width is part/2
        operator = along - np.diag(film**3 * wave**2)
        coefficient = np.linalg.solve(operator[1:-1, 1:-1], 6.0 * wedge[1:-1] * part)
        total[1:-1] += coefficient * 0.5 * part
    pressure = np.polynomial.Chebyshev.fit(x, total, POINTS, domain=(0.0, math.pi))(angles)
    return (
        float(2.0 * np.sum(weights * pressure * np.cos(angles))),
        float(2.0 * np.sum(weights * pressure * np.sin(angles))),
    )


def _chebyshev(length: float) -> tuple[np.ndarray, np.ndarray]:
    """Nodes on [0, length] and the matrix that differentiates there."""
    x = np.cos(np.pi * np.arange(POINTS + 1) / POINTS)
    c = np.where((np.arange(POINTS + 1) % POINTS) == 0, 2.0, 1.0) * (-1.0) ** np.arange(POINTS + 1)
    apart = x[:, None] - x[None, :] + np.eye(POINTS + 1)
    slope = np.outer(c, 1.0 / c) / apart
    slope -= np.diag(slope.sum(axis=1))
    return 0.5 * length * (x + 1.0), 2.0 / length * slope
