"""The oil in a pump's films where it is not the case's: its viscosity, and the temperature that goes with it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from gaps.films.physics import Physics
from gaps.shapes.valve_plate_ring import SEALED
from reynolds.laws.oil import WALTHER_SHIFT, walther_coefficients
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.loads import evaluate
from system.description.pump import PumpDescription

UNITS: Mapping[str, str] = {"film_viscosity": "Pa s", "film_temperature": "K"}


def oil_state(pump: PumpDescription, physics: Physics, solution: FilmSolution, resting: float) -> dict[str, Array]:
    """Fields of a film's oil at its vertices (vertices,), by name and in `UNITS`; none where it is as in the case.

    film_viscosity: by which the film flows, with what pressure and heat make of it; film_temperature: at which the
    oil under no pressure has what heat makes of it, a mean across the film (Walther's law). Webs over a port are
    no film: they have the case's oil, of viscosity `resting` (Pa s).
    """
    if not (physics.heat or physics.pressure_viscosity):
        return {}
    space, film = solution.problem.space, solution.problem.film
    under = evaluate(solution, solution.pressure)[0]
    own = np.broadcast_to(film.viscosity, under.shape)
    web = own > np.sqrt(SEALED) * resting
    viscosity = np.asarray(solution.problem.fluid.viscosity(under, own)[0])
    found = {"film_viscosity": space.to_vertices(np.where(web, resting, viscosity))}
    if physics.heat:
        unpressed = space.to_vertices(np.where(web, resting, own))
        intercept, slope = walther_coefficients(pump.oil.fluid)
        shifted = np.log10(np.log10(unpressed / pump.oil.density * 1e6 + WALTHER_SHIFT))
        found["film_temperature"] = 10.0 ** ((intercept - shifted) / slope)
    return found
