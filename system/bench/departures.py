"""Departures of a pump's laws from the simulation's: smooth factors over the map on leakage and friction.

Leakage and friction of a pump of another make follow laws of another form. With y0 the reading, D the contribution of
each part of the pump and Phi smooth shapes of the map:

    y = y0 + sum over parts of D (w Phi beta),   beta ~ N(0, 1)

w: one sigma of the factor. The columns w D Phi, many and alike, are reduced to their principal ones in units of the
readings' noise.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from reynolds.numerics.arrays import Array
from system.bench.components import FRICTION, LEAKAGE
from system.effects.components import Component
from system.estimation.parameters import Parameter, Role, Scale

FORM = "form."
"""Names of the parameters begin with it."""
LEAST = 1.0
"""Norm of a principal column in sigma of the readings, below which it is left out."""
MOST = 20
"""Principal columns."""
FARTHEST = 5.0
"""Bound of a size, in units of its prior."""


def departures(
    contributions: Mapping[Component, Array], shapes: Array, sigma: Array, width: float, apart: Array
) -> Array:
    """Principal columns (N, C, k) of the departures, SI per unit of beta; k at most `MOST`.

    contributions: (N, C) of each part in SI; shapes: (N, m); sigma: (N, C), one sigma of the readings in SI; apart:
    (N, C, n) in SI, further departures.
    """
    parts = [contributions[part] for part in (*LEAKAGE, *FRICTION) if part in contributions]
    columns = np.concatenate([*(width * part[:, :, None] * shapes[:, None, :] for part in parts), apart], axis=2)
    known = np.isfinite(sigma) & (sigma > 0.0)
    scaled = np.where(known[:, :, None], columns / np.where(known, sigma, 1.0)[:, :, None], 0.0)
    rows = scaled.reshape(-1, scaled.shape[-1])
    left, size, _ = np.linalg.svd(rows, full_matrices=False)
    kept = int(min((size > LEAST).sum(), MOST))
    principal = (left[:, :kept] * size[:kept]).reshape(*sigma.shape, kept)
    return np.asarray(principal * np.where(known, sigma, 0.0)[:, :, None])


def departure_parameters(count: int, first: int = 1) -> tuple[Parameter, ...]:
    """form.first and so on: size of each of `count` departures in units of its prior."""
    return tuple(
        Parameter(
            f"{FORM}{first + k}",
            Role.BASE,
            Scale.NORMAL,
            0.0,
            1.0,
            -FARTHEST,
            FARTHEST,
            None,
            "laws of another make",
            True,
        )
        for k in range(count)
    )
