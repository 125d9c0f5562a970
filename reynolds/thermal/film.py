"""Film and temperature together, steady or in time; the oil may thin with shear too."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from reynolds.errors import FilmInputError
from reynolds.laws.fluid import Fluid, ViscosityLaw, isoviscous
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmProblem
from reynolds.solve.solver import FilmSolver
from reynolds.solve.transient import FilmInstant, march_with
from reynolds.solve.warm_start import from_last_or_anew
from reynolds.thermal.coupling import Coupled, ThermalCase, agree
from reynolds.thermal.energy import FilmTemperature, Heat
from reynolds.thermal.film_profile import DEFAULT_LEVELS, levels
from reynolds.thermal.shear_thinning import ShearLaw, newtonian

TOLERANCE = 1e-6
PRESSURE_STEP = 1e4  # Pa, over which Newton's method takes the slope of a viscosity: 1e-4 of it is lost

ThermalViscosity = Callable[[Array, Array], Array]
"""(temperature K, pressure Pa), arrays that broadcast -> viscosity Pa s."""

ThermalSolution = Coupled[FilmTemperature]


def solve_thermal(
    problem: FilmProblem,
    heat: Heat,
    viscosity: ThermalViscosity,
    *,
    shear: ShearLaw = newtonian,
    count: int = DEFAULT_LEVELS,
    tolerance: float = TOLERANCE,
    solver: FilmSolver | None = None,
    start: Coupled[object] | None = None,
    before: Array | None = None,
) -> ThermalSolution:
    """The film of `problem` with the viscosity of its own temperature, resolved by `count` levels across.

    The viscosity of `problem.film` is not used; its fluid may change density with pressure, but not viscosity,
    which is given here; `shear` thins that of the oil at rest. Elastic and rough walls, a cavity and a storage of
    the problem count, and a wall of `heat` that expands deforms the film. `start` is a first guess; `before`
    (size, count + 2) K is the temperature one time step ago. Afterwards one more round would change no viscosity
    and no thickness by more than `tolerance` of it. Raises FilmInputError, FilmNotConverged.
    """
    if problem.fluid.viscosity is not isoviscous:
        raise FilmInputError(
            "fluid", "a law of viscosity over pressure", "that law in viscosity(temperature, pressure)"
        )

    def thinned(temperature: Array, pressure: Array, rate: Array) -> Array:
        return shear(rate, np.asarray(viscosity(temperature, pressure), dtype=float))

    posed = ThermalCase(_resting(problem, heat.datum, viscosity), thinned, heat, before)
    found = agree(posed, levels(count), tolerance, solver, start)
    return cast("ThermalSolution", found)  # with a heat posed there is one


@dataclass(frozen=True)
class _AtTemperature:
    """The viscosity law at one temperature (K), for the film's Newton method: its slope by a difference."""

    viscosity: ThermalViscosity
    temperature: Array
    resting: float

    def __call__(self, pressure: Array, viscosity: Array) -> tuple[Array, Array]:
        here, ahead = (np.asarray(self.viscosity(self.temperature, p)) for p in (pressure, pressure + PRESSURE_STEP))
        share = viscosity / self.resting
        return share * here, share * (ahead - here) / PRESSURE_STEP


def _resting(problem: FilmProblem, temperature: float, viscosity: ThermalViscosity) -> FilmProblem:
    """The problem with the oil at rest at one temperature (K): it varies with pressure there as anywhere."""
    at = np.full((1, 1), temperature)
    without, under = (float(np.asarray(viscosity(at, np.full((1, 1), p))).item()) for p in (0.0, PRESSURE_STEP))
    if not (np.isfinite(without) and without > 0.0):
        raise FilmInputError("viscosity", f"{without:.4g} Pa s at {temperature:g} K", "positive")
    law: ViscosityLaw = isoviscous if under == without else _AtTemperature(viscosity, at, without)
    # An oil of constant viscosity and density stays CONSTANT, for which the film is linear.
    fluid = problem.fluid if law is isoviscous else Fluid(law, problem.fluid.density)
    return replace(problem, film=replace(problem.film, viscosity=np.full((1, 1), without)), fluid=fluid)


def march_thermal(
    problem_at: Callable[[float], FilmProblem],
    heat: Heat,
    viscosity: ThermalViscosity,
    end: float,
    step: float,
    *,
    temperature: float | Array,
    shear: ShearLaw = newtonian,
    count: int = DEFAULT_LEVELS,
    tolerance: float = TOLERANCE,
    solver: FilmSolver | None = None,
    start: float = 0.0,
    held: Array | None = None,
) -> Iterator[FilmInstant[ThermalSolution]]:
    """A film and its temperature in time, see `transient.march_with` and `solve_thermal`.

    `temperature` (K, one number or (size, count + 2)) and `held` are those at `start`. Heat and oil are balanced
    at each step. A body responds as if steady: give the temperature of one slower than the film.
    """
    space = problem_at(start).space
    used = FilmSolver(space) if solver is None else solver
    first = np.broadcast_to(np.asarray(temperature, dtype=float), (space.size, count + 2))

    def solve(problem: FilmProblem, last: ThermalSolution | None) -> ThermalSolution:
        before = first if last is None else last.heat.temperature

        def from_(warm: ThermalSolution | None) -> ThermalSolution:
            return solve_thermal(
                problem, heat, viscosity, shear=shear, count=count, tolerance=tolerance, solver=used, start=warm,
                before=before,
            )  # fmt: skip

        return from_last_or_anew(from_, last)

    return march_with(solve, problem_at, end, step, start=start, held=held)
