"""Film and temperature together: pressure and heat solved in turn until the viscosity no longer changes.

A round takes temperatures across the film to viscosities, to the generalised Reynolds equation, to the energy
equation, to temperatures; Anderson's extrapolation takes the place of a relaxation factor.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from reynolds.across import DEFAULT_LEVELS, Levels, Profile, dowson, film_with, levels
from reynolds.anderson import History
from reynolds.energy import FilmTemperature, Heat, solve_energy
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.film import FilmProblem, FilmSolution
from reynolds.fluid import isoviscous
from reynolds.mesh import Array
from reynolds.solve import FilmSolver

TOLERANCE = 1e-6
MAX_ROUNDS = 60

ThermalViscosity = Callable[[Array, Array], Array]
"""(temperature K, pressure Pa), arrays that broadcast -> viscosity Pa s."""


@dataclass(frozen=True)
class ThermalSolution:
    """A film and its temperature that agree; `change`: the largest relative change of viscosity at the end."""

    film: FilmSolution
    heat: FilmTemperature
    rounds: int
    change: float


def solve_thermal(
    problem: FilmProblem,
    heat: Heat,
    viscosity: ThermalViscosity,
    *,
    count: int = DEFAULT_LEVELS,
    tolerance: float = TOLERANCE,
    solver: FilmSolver | None = None,
    start: ThermalSolution | None = None,
    before: Array | None = None,
) -> ThermalSolution:
    """The film of `problem` with the viscosity of its own temperature, resolved by `count` levels across.

    The viscosity of `problem.film` is not used; its fluid may change density with pressure, but not viscosity,
    which is here. `start` warms; `before` (size, count + 2) K is the temperature one time step ago. Afterwards one
    more round would change no viscosity by more than `tolerance` of it. Raises FilmInputError, FilmNotConverged.
    """
    if problem.fluid.viscosity is not isoviscous:
        raise FilmInputError(
            "fluid", "a law of viscosity over pressure", "that law in viscosity(temperature, pressure)"
        )
    across = levels(count)
    solver = FilmSolver(problem.space) if solver is None else solver
    temperature = _first_temperature(problem, heat, across, start)
    film, energy = (None, None) if start is None else (start.film, start.heat)
    pressure = np.zeros(problem.space.size) if film is None else film.pressure
    history = History()
    for round_number in range(1, MAX_ROUNDS + 1):
        profile = _profile(across, viscosity, temperature, pressure)
        film = solver.solve(replace(problem, film=film_with(problem.film, problem.space, profile)), film)
        warm = None if energy is None else energy.temperature
        energy = solve_energy(film, heat, profile, start=warm, before=before)
        used = viscosity(temperature[:, 1:-1], pressure[:, None])
        change = _change(used, viscosity(energy.temperature[:, 1:-1], film.pressure[:, None]))
        if change < tolerance:
            return ThermalSolution(film, energy, round_number, change)
        temperature, pressure = history.extrapolate(temperature, energy.temperature), film.pressure
    raise FilmNotConverged(
        f"film and temperature do not agree after {MAX_ROUNDS} rounds (viscosity still changes by {change:.2g})",
        "a start from a case near by (`start`), a thicker film, or a wall that takes more heat",
    )


def _profile(across: Levels, viscosity: ThermalViscosity, temperature: Array, pressure: Array) -> Profile:
    found = np.asarray(viscosity(temperature[:, 1:-1], pressure[:, None]), dtype=float)
    return dowson(across, np.broadcast_to(found, (len(temperature), len(across.weights))))


def _change(before: Array, after: Array) -> float:
    return float(np.max(np.abs(np.log(after / before)), initial=0.0))


def _first_temperature(problem: FilmProblem, heat: Heat, across: Levels, start: ThermalSolution | None) -> Array:
    shape = (problem.space.size, len(across.place))
    if start is not None:
        if start.heat.temperature.shape != shape:
            found = f"a start of shape {start.heat.temperature.shape}"
            raise FilmInputError("temperature to start from", found, f"{shape}: the same space and levels")
        return start.heat.temperature
    return np.full(shape, heat.datum)
