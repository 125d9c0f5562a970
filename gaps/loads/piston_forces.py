"""Generalised forces of what pushes a piston across its bore, by the eccentricities of `gaps.films.piston`."""

from __future__ import annotations

import numpy as np

from reynolds.numerics.arrays import Array


def lateral_force(guide_length: float, depth: float, force: Array) -> Array:
    """Generalised forces (4,) N of a force (2,) N across the bore on the piston, `depth` (m) inside the case edge.

    P0 = G s/Lg, P1 = G (1 - s/Lg): a force outside the guide (s < 0) pulls its ends opposite ways.
    """
    share = depth / guide_length
    return np.concatenate([share * np.asarray(force), (1.0 - share) * np.asarray(force)])


def lateral_moment(guide_length: float, moment: Array) -> Array:
    """Generalised forces (4,) N of a moment (2,) N m on the piston, about axes across the bore.

    P0 = a x M/Lg = -P1, a the bore's axis out of the block.
    """
    couple = np.array([-moment[1], moment[0]]) / guide_length
    return np.concatenate([couple, -couple])
