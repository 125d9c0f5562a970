"""Polygons in place of circles in a mesh of straight cells."""

import numpy as np

from reynolds.numerics.arrays import Array


def round_scale(sectors: Array) -> float:
    """Factor on the corners' radius by which a polygon has the area of its circle.

    sectors: angles (n,) rad between the corners, over the whole turn. The load of a film between lands goes with its
    area: a ring of 20 corners on its circles has 1.6 % too little.

    >>> round(round_scale(np.full(4, np.pi / 2.0)), 4)
    1.2533
    """
    return float(np.sqrt(2.0 * np.pi / np.sum(np.sin(sectors))))
