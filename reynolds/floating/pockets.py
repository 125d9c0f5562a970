"""Pockets of a floating film: their oil, and its growth with the position.

A pocket's oil counts as the film's: where the pocket falls to cavitation pressure it is filled in part, so that a part
that lifts off leaves a cavity where its supply is too small.
"""

from dataclasses import replace

import numpy as np

from reynolds.equation.balance import density
from reynolds.errors import FilmInputError
from reynolds.floating.coordinates import Modes
from reynolds.floating.problem import Floating
from reynolds.numerics.arrays import Array
from reynolds.problem import Boundary, FilmProblem, FilmSolution, Pocket

DEPTH = 5e-5  # m, at q = 0: keeps a pocket's volume above zero; its size has no effect


def filled(floating: Floating, shape: FilmProblem, q: Array) -> dict[str, Boundary]:
    """The boundaries of a shape, its pockets with their volume at a position (k,) m.

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
    """Growth of the oil in the pockets at constant filling, by each coordinate, (size, k) m2."""
    filling = solution.film_fraction * density(solution.problem, solution.pressure)[0]
    return np.asarray(filling[:, None] * modes.pockets)
