"""A film with its temperature: from what a case states to the core's coupled solve."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.mesh import Array
from reynolds.thermal import ThermalSolution, ThermalViscosity, solve_thermal
from swashfilm.fields import Uniform

if TYPE_CHECKING:
    from reynolds.film import FilmProblem
    from swashfilm.film_statement import FilmStatement


def solve_with_temperature(
    stated: FilmStatement, problem: FilmProblem, start: ThermalSolution | None = None
) -> ThermalSolution:
    """Film and temperature that agree, warmed by `start`.

    Raises FilmNotConverged, also where the oil leaves the range of its law.
    """
    assert stated.thermal is not None
    assert stated.oil is not None
    temperatures = {name: entry.temperature for name, entry in stated.boundary.items()}
    heat = stated.thermal.heat(stated.oil, temperatures)
    try:
        return solve_thermal(problem, heat, _viscosity(stated), count=stated.thermal.levels, start=start)
    except FilmInputError as reason:
        remedy = f"{reason.expected}: a thicker film, a lower speed or walls that take more heat"
        raise FilmNotConverged(f"{reason.where}: {reason.found}", remedy) from None


def _viscosity(stated: FilmStatement) -> ThermalViscosity:
    """Viscosity (Pa s) at temperature (K) and pressure (Pa) by the oil's laws."""
    oil = stated.oil
    assert oil is not None
    assert isinstance(stated.viscosity, Uniform)
    at_oil_temperature = stated.viscosity.value

    def viscosity(temperature: Array, pressure: Array) -> Array:
        cold = oil.at_temperature(temperature, at_oil_temperature)
        return np.asarray(oil.viscosity_law(pressure, cold)[0])

    return viscosity
