"""State of the oil in a pump's films: viscosity and the equivalent temperature, where they vary."""

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
    """Return fields of a film's oil at its vertices (vertices,), by name and in `UNITS`; none for uniform oil.

    film_viscosity: viscosity with the effects of pressure and heat; film_temperature: mean temperature across the
    film, at which oil at zero pressure has the viscosity due to heat alone (Walther's law). Webs over a port have
    no film: their oil has the viscosity `resting` (Pa s).
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
