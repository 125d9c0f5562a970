"""Pockets of a floating film: what they hold, and how it grows with the position.

A pocket's oil counts as the film's: where the pocket falls to cavitation pressure it is filled in part, so that a
part that takes off leaves a cavity behind and what its supply cannot send is missed.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reynolds.equation.balance import density
from reynolds.errors import FilmInputError
from reynolds.floating.coordinates import Modes
from reynolds.floating.problem import Floating
from reynolds.numerics.arrays import Array
from reynolds.problem import Boundary, FilmProblem, FilmSolution, Pocket

DEPTH = 5e-5  # m, at q = 0: what a pocket holds must stay above zero; how far above is of no matter


def filled(floating: Floating, shape: FilmProblem, q: Array) -> dict[str, Boundary]:
    """The boundaries of a shape, its pockets of the volume that they have at a position (k,) m.

    Raises FilmInputError for a name of `floating.pockets` that is no pocket of the shape, and where one is closed.
    """
    boundary = dict(shape.boundary)
    for name, area in floating.pockets.items():
        condition = boundary.get(name)
        if not isinstance(condition, Pocket):
            found = f"{type(condition).__name__} at boundary {name}"
            raise FilmInputError(f"{floating.name}, pockets", found, "a Pocket")
        volume = DEPTH * float(np.abs(area).max()) + float(area @ q)
        if not volume > 0.0:
            raise FilmInputError(f"{floating.name}, pocket {name}", f"{volume:.3g} m3", "a volume above zero")
        boundary[name] = replace(condition, volume=volume)
    return boundary


def pockets_grown(solution: FilmSolution, modes: Modes) -> Array:
    """Growth of the oil in the pockets, filled as they are, by each coordinate, (size, k) m2."""
    filling = solution.film_fraction * density(solution.problem, solution.pressure)[0]
    return np.asarray(filling[:, None] * modes.pockets)
