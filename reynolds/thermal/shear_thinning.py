"""An oil that thins with shear, in a film: the generalised Reynolds equation with its local shear rates.

At each unknown the shear rate follows from the profile across the film, (mu_c (U1 - U2)/h + (z - zbar) grad p)/mu,
a vector in the film plane whose magnitude counts; viscosity then varies across the film, and along it.
"""

from collections.abc import Callable
from typing import cast

import numpy as np

from reynolds.numerics.arrays import Array
from reynolds.problem import FilmProblem
from reynolds.solve.solver import FilmSolver
from reynolds.thermal.coupling import Coupled, ThermalCase, agree, resting_viscosity
from reynolds.thermal.film_profile import DEFAULT_LEVELS, levels

TOLERANCE = 1e-8

ShearLaw = Callable[[Array, Array], Array]
"""(shear rate 1/s, viscosity at rest Pa s), arrays that broadcast -> viscosity Pa s: `rheology` has such laws."""


def newtonian(shear_rate: Array, viscosity: Array) -> Array:
    """A viscosity independent of shear."""
    return np.broadcast_to(viscosity, np.broadcast_shapes(np.shape(shear_rate), np.shape(viscosity)))


def solve_shear(
    problem: FilmProblem,
    law: ShearLaw,
    *,
    count: int = DEFAULT_LEVELS,
    tolerance: float = TOLERANCE,
    solver: FilmSolver | None = None,
    start: Coupled[object] | None = None,
) -> Coupled[None]:
    """The film of `problem` with an oil that thins with shear, resolved by `count` levels across.

    The problem's own viscosity and pressure law are those of the oil at rest, from which `law(shear rate, mu)`
    gives the viscosity at each level. `start` is a first guess. Afterwards one more round would change no
    viscosity by more than `tolerance` of it. Raises FilmInputError as the laws do, and FilmNotConverged. Validity:
    an oil without memory (its relaxation time far below the time through the film). Source: Dowson 1962; Yang and
    Wen 1990, for oils that are not Newtonian.
    """

    def viscosity(temperature: Array, pressure: Array, rate: Array) -> Array:
        return law(rate, resting_viscosity(problem, pressure[:, 0])[:, None])

    found = agree(ThermalCase(problem, viscosity), levels(count), tolerance, solver, start)
    return cast("Coupled[None]", found)  # without a heat posed there is none
