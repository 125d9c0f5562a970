"""The oil in a pump's films where it is not the case's: its viscosity, and the temperature that goes with it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from gaps.physics import Physics
from reynolds.film import FilmSolution
from reynolds.loads import evaluate
from reynolds.mesh import Array
from reynolds.oil import WALTHER_SHIFT, walther_coefficients
from system.description import PumpDescription

UNITS: Mapping[str, str] = {"film_viscosity": "Pa s", "film_temperature": "K"}


def oil_state(pump: PumpDescription, physics: Physics, solution: FilmSolution) -> dict[str, Array]:
    """Fields of a film's oil at its vertices (vertices,), by name and in `UNITS`; none where it is as in the case.

    film_viscosity: by which the film flows, with what pressure and heat make of it; film_temperature: at which the
    oil under no pressure has what heat makes of it, a mean across the film (Walther's law).
    """
    if not (physics.heat or physics.pressure_viscosity):
        return {}
    space, film = solution.problem.space, solution.problem.film
    under = evaluate(solution, solution.pressure)[0]
    viscosity = np.asarray(solution.problem.fluid.viscosity(under, film.viscosity)[0])
    found = {"film_viscosity": space.to_vertices(viscosity)}
    if physics.heat:
        unpressed = space.to_vertices(film.viscosity)
        intercept, slope = walther_coefficients(pump.oil.fluid)
        shifted = np.log10(np.log10(unpressed / pump.oil.density * 1e6 + WALTHER_SHIFT))
        found["film_temperature"] = 10.0 ** ((intercept - shifted) / slope)
    return found
