"""Solution of a film with the oil of its case: temperature and shear thinning."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, cast

import numpy as np

from reynolds.errors import FilmNotConverged, InputError
from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmProblem, FilmSolution
from reynolds.solve.solver import FilmSolver
from reynolds.solve.transient import FilmInstant, march_with
from reynolds.solve.warm_start import from_last_or_anew
from reynolds.thermal.coupling import Coupled
from reynolds.thermal.energy import FilmTemperature, Heat
from reynolds.thermal.film import ThermalViscosity, march_thermal, solve_thermal
from reynolds.thermal.shear_thinning import newtonian, solve_shear
from swashfilm.case.fields.field import Uniform

if TYPE_CHECKING:
    from swashfilm.case.statement import FilmStatement

Found = FilmSolution | Coupled[FilmTemperature] | Coupled[None]
_OIL_REMEDY = "a thicker film, a lower speed or load, walls that take more heat, or an oil for that range"


def film_of(found: Found) -> FilmSolution:
    """Return the film of a solution."""
    return found.film if isinstance(found, Coupled) else found


def heat_of(found: Found) -> FilmTemperature | None:
    """Return the temperature of a solution; None where it is not solved."""
    return found.heat if isinstance(found, Coupled) else None


class _BeyondLaw(InputError):
    """A temperature or pressure of the film beyond the range of the oil's laws."""


@contextmanager
def _no_film() -> Iterator[None]:
    """Raise FilmNotConverged for a film beyond the range of its oil: the case is well stated, its film is not found."""
    try:
        yield
    except _BeyondLaw as reason:
        raise FilmNotConverged(str(reason), _OIL_REMEDY) from None


@dataclass(frozen=True)
class OilSolver:
    """Solver of films of one case on one space with its oil; `heat` None: isothermal."""

    stated: FilmStatement
    solver: FilmSolver
    heat: Heat | None

    def solve(self, problem: FilmProblem, start: Found | None = None) -> Found:
        """Return the film of `problem`, started from `start`.

        Raises FilmNotConverged, also where a warm film is beyond the range of its oil's laws.
        """
        with _no_film():
            return self._solved(problem, start)

    def _solved(self, problem: FilmProblem, start: Found | None) -> Found:
        stated, warm = self.stated, start if isinstance(start, Coupled) else None
        shear = stated.oil.shear_thinning if stated.oil else None
        if self.heat is not None:
            assert stated.thermal is not None
            return solve_thermal(
                problem, self.heat, _viscosity(stated), shear=shear or newtonian, count=stated.thermal.levels,
                solver=self.solver, start=warm,
            )  # fmt: skip
        if shear is not None:
            return solve_shear(problem, shear, solver=self.solver, start=warm)
        return self.solver.solve(problem, None if start is None else film_of(start))

    def march(
        self, problem_at: Callable[[float], FilmProblem], end: float, step: float, held: Array
    ) -> Iterator[FilmInstant[Found]]:
        """Yield the film in time, as `reynolds.solve.transient.march_with`; it starts at the inlet temperature."""
        if self.heat is None:
            yield from march_with(self._step, problem_at, end, step, held=held)
            return
        stated = self.stated
        assert stated.thermal is not None
        assert stated.oil is not None
        found = march_thermal(
            problem_at, self.heat, _viscosity(stated), end, step, temperature=stated.thermal.inlet(stated.oil),
            shear=stated.oil.shear_thinning or newtonian, count=stated.thermal.levels, solver=self.solver,
            held=held,
        )  # fmt: skip
        with _no_film():
            yield from cast("Iterator[FilmInstant[Found]]", found)

    def _step(self, problem: FilmProblem, last: Found | None) -> Found:
        return from_last_or_anew(partial(self.solve, problem), last)


def oil_solver(stated: FilmStatement, space: FilmSpace) -> OilSolver:
    """Return the solver of a case's films; raise InputError for a body that does not lie under the film."""
    heat = None
    if stated.thermal is not None:
        assert stated.oil is not None
        temperatures = {name: entry.temperature for name, entry in stated.boundary.items()}
        heat = stated.thermal.heat(stated.oil, temperatures, stated.elastic.bodies if stated.elastic else {}, space)
    return OilSolver(stated, FilmSolver(space), heat)


def _viscosity(stated: FilmStatement) -> ThermalViscosity:
    """Return the viscosity (Pa s) as function of temperature (K) and pressure (Pa) by the oil's laws."""
    oil = stated.oil
    assert oil is not None
    assert isinstance(stated.viscosity, Uniform)
    at_oil_temperature = stated.viscosity.value

    def viscosity(temperature: Array, pressure: Array) -> Array:
        try:
            cold = oil.at_temperature(temperature, at_oil_temperature)
            return np.asarray(oil.viscosity_over_pressure(pressure, cold)[0])
        except InputError as reason:
            raise _BeyondLaw(reason.where, reason.found, reason.expected) from None

    return viscosity
