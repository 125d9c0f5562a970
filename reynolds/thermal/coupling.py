"""Coupling of a film and its oil: viscosity by shear, by temperature or by both, and walls that deform by heat.

The unknowns are the viscosity at the levels across the film, over that of the resting oil under the same pressure, and
the deformation of the film by its walls' heat. A round maps them through the generalised Reynolds equation, whose own
Newton method follows the pressure, temperatures and shear rates; Anderson's extrapolation replaces a relaxation factor.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Generic, NamedTuple, TypeVar

import numpy as np

from reynolds.errors import FilmInputError, FilmNotConverged, InputError
from reynolds.laws.fluid import Fluid, ViscosityLaw, isoviscous
from reynolds.numerics.anderson import History
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmProblem, FilmSolution, widened
from reynolds.solve.solver import FilmSolver
from reynolds.thermal.energy import FilmTemperature, Heat, solve_energy
from reynolds.thermal.film_profile import FilmLevels, FlowProfile, dowson, film_with, scaled, shear_rate
from reynolds.thermal.walls import deformation_by_heat

MAX_ROUNDS = 100
MOST_HALVINGS = 12
THINNEST = 1e-9  # of the viscosity of the oil at rest: less is a law far outside its range
ROUGHLY = 0.1  # a relative change: near enough to start from
CORRECTED = 0.1  # of the tolerance, over the range of temperature, may a temperature miss on the way
MOST_CLOSED = 0.5  # of its thickness, by which warm walls may close the film in one round

LocalLaw = Callable[[Array, Array, Array], Array]
"""(temperature K, pressure Pa, shear rate 1/s), arrays that broadcast -> viscosity Pa s; NaN K where none is."""

HeatOrNone = TypeVar("HeatOrNone", covariant=True)


@dataclass(frozen=True)
class Coupled(Generic[HeatOrNone]):
    """A film and its oil in agreement.

    `heat`: its temperature, None if not solved; profile: of the flow across the film; share (size, m):
    viscosity at the levels over that of the resting oil under the same pressure; growth (vertices,) m: deformation
    of the film by its walls' heat; change: the largest relative one of viscosity or thickness in one more round.
    """

    film: FilmSolution
    heat: HeatOrNone
    profile: FlowProfile = field(repr=False)
    share: Array = field(repr=False)
    growth: Array = field(repr=False)
    rounds: int
    change: float

    @property
    def holds(self) -> Array:
        """Oil of each unknown, m3 at reference density, (size,)."""
        return self.film.holds


@dataclass(frozen=True)
class ThermalCase:
    """A film of resting oil at one temperature, the oil's law, and its heat (None: the temperature stays).

    `before` (size, m + 2) K: the temperature one time step ago, where the film stores oil; `at_once`: it follows
    its film without delay instead.
    """

    problem: FilmProblem
    law: LocalLaw
    heat: Heat | None = None
    before: Array | None = None
    at_once: bool = False


class _Conditions(NamedTuple):
    """Arguments of the law: temperature at all levels (size, m + 2) K, shear rate (size, m) 1/s."""

    temperature: Array
    rate: Array


@dataclass(frozen=True)
class _Guess:
    """Viscosity over the resting oil's (size, m), and deformation by heat over the yardstick (vertices,)."""

    share: Array
    opened: Array

    @property
    def point(self) -> Array:
        return np.concatenate([np.log(self.share).ravel(), self.opened])

    def at(self, point: Array) -> _Guess:
        """The guess of this shape at a point; the film closes by half at most in one step."""
        count = self.share.size
        opened = np.maximum(point[count:], self.opened - MOST_CLOSED * np.maximum(1.0 + self.opened, 0.0))
        return _Guess(np.exp(point[:count]).reshape(self.share.shape), opened)


@dataclass(frozen=True)
class _Work:
    """Constants of the rounds: the case, levels, solver, and the yardstick (vertices,) m of deformation by heat."""

    posed: ThermalCase
    across: FilmLevels
    solver: FilmSolver
    yardstick: Array


def agree(
    posed: ThermalCase, across: FilmLevels, tolerance: float, solver: FilmSolver | None, start: Coupled[object] | None
) -> Coupled[FilmTemperature | None]:
    """The film with the viscosity of its own temperature and shear rates at the levels across.

    Afterwards one more round would change no viscosity and no film thickness by more than `tolerance` of it.
    Raises FilmInputError, also where the oil's law does not hold at the answer, and FilmNotConverged.
    """
    problem = posed.problem
    work = _Work(posed, across, solver or FilmSolver(problem.space), _yardstick(problem))
    if start is None and problem.fluid.viscosity is not isoviscous:
        # An oil still cold or at rest may stiffen without bound under a pressure beyond the film's.
        start = agree(_unpressed(posed), across, ROUGHLY, work.solver, None)
    conditions, guess = _first(work, start)
    film, heat = (None, None) if start is None else (start.film, start.heat)
    history, solved = History(), None
    for rounds in range(1, MAX_ROUNDS + 1):
        film, guess = _film(work, guess, film, solved)
        solved = guess
        profile = scaled(dowson(across, guess.share), resting_viscosity(problem, film.pressure))
        heat = _heat(posed, film, profile, heat, CORRECTED * tolerance)
        image, conditions, fault = _image(work, film, profile, heat, conditions)
        change = float(np.abs(image.point - guess.point).max())
        if fault is None and change < tolerance:
            return Coupled(film, heat, profile, guess.share, guess.opened * work.yardstick, rounds, change)
        guess = guess.at(history.extrapolate(guess.point, image.point))
    if fault is not None:
        raise fault
    raise FilmNotConverged(
        f"film and oil do not agree after {MAX_ROUNDS} rounds (viscosity or film still change by {change:.2g})",
        "a start from a case near by (`start`), a thicker film, or a wall that takes more heat",
    )


def _unpressed(posed: ThermalCase) -> ThermalCase:
    """The same with an oil of constant viscosity in pressure."""
    problem = posed.problem

    def law(temperature: Array, pressure: Array, rate: Array) -> Array:
        return posed.law(temperature, np.zeros_like(pressure), rate)

    return replace(posed, problem=replace(problem, fluid=Fluid(isoviscous, problem.fluid.density)), law=law)


def _film(work: _Work, guess: _Guess, warm: FilmSolution | None, solved: _Guess | None) -> tuple[FilmSolution, _Guess]:
    """The film of a guess, or of one nearer to the last with a solution; without one, of a thinner oil."""
    problem = work.posed.problem
    fault: InputError | FilmNotConverged | None = None
    for _ in range(MOST_HALVINGS):
        posed = with_profile(problem, dowson(work.across, guess.share))
        if guess.opened.any():
            posed = replace(posed, film=widened(posed.space, posed.film, guess.opened * work.yardstick))
        try:
            return work.solver.solve(posed, warm), guess
        except (InputError, FilmNotConverged) as reason:
            fault = reason if fault is None else fault
        if solved is not None:
            guess = guess.at(0.5 * (guess.point + solved.point))
        elif problem.fluid.viscosity is not isoviscous:
            guess = replace(guess, share=0.5 * guess.share)
        else:
            break
    assert fault is not None
    raise fault


def resting_viscosity(problem: FilmProblem, pressure: Array) -> Array:
    """Viscosity (size,) Pa s of the problem itself at nodal pressures (size,) Pa."""
    given = problem.space.to_unknowns(problem.film.viscosity)[:, None]
    found, _ = problem.fluid.viscosity(pressure[:, None], given)
    return np.asarray(found[:, 0])


@dataclass(frozen=True)
class _Shared:
    """A pressure law with a share (cells, points) at each place, which the film's viscosity contains."""

    law: ViscosityLaw
    share: Array

    def __call__(self, pressure: Array, viscosity: Array) -> tuple[Array, Array]:
        value, slope = self.law(pressure, viscosity / self.share)
        return value * self.share, slope * self.share


def with_profile(problem: FilmProblem, shape: FlowProfile) -> FilmProblem:
    """The problem with the shares of its viscosity by a profile, the same under any pressure."""
    rest = problem.film
    film = film_with(rest, problem.space, shape)
    share = film.viscosity
    film = replace(film, viscosity=share * rest.viscosity, couette_viscosity=film.sliding_viscosity * rest.viscosity)
    if problem.fluid.viscosity is isoviscous:
        return replace(problem, film=film)
    return replace(problem, film=film, fluid=Fluid(_Shared(problem.fluid.viscosity, share), problem.fluid.density))


def _yardstick(problem: FilmProblem) -> Array:
    """Thickness (vertices,) m of which deformation by heat is a share: the given film's.

    Elastic walls may overlap without their oil: then its largest magnitude, everywhere.
    """
    known = problem.film.thickness_at_vertices
    given = problem.space.to_vertices(problem.film.thickness) if known is None else known
    if given.min() > 0.0:
        return given
    largest = np.abs(given).max()
    if largest == 0.0:
        raise FilmInputError("film thickness of a film with its temperature", "0 m everywhere", "a film somewhere")
    return np.full_like(given, largest)


def _first(work: _Work, start: Coupled[object] | None) -> tuple[_Conditions, _Guess]:
    """The oil at rest at the lowest temperature given, or that of a start."""
    posed, space, m = work.posed, work.posed.problem.space, len(work.across.weights)
    lowest = np.nan if posed.heat is None else posed.heat.datum
    conditions = _Conditions(np.full((space.size, m + 2), lowest), np.zeros((space.size, m)))
    if start is None:
        growth = _growth(posed.heat, posed.problem, np.zeros((2, space.size)))
        return conditions, _Guess(_share(posed, conditions, np.zeros(space.size)), growth / work.yardstick)
    if start.share.shape != (space.size, m) or len(start.growth) != len(work.yardstick):
        expected = f"({space.size}, {m}): the same space and levels"
        raise FilmInputError("viscosity to start from", f"a start of shape {start.share.shape}", expected)
    if isinstance(start.heat, FilmTemperature) and posed.heat is not None:
        conditions = conditions._replace(temperature=start.heat.temperature)
    return conditions, _Guess(start.share, start.growth / work.yardstick)


def _heat(
    posed: ThermalCase, film: FilmSolution, profile: FlowProfile, last: object, corrected: float
) -> FilmTemperature | None:
    if posed.heat is None:
        return None
    warm = last.temperature if isinstance(last, FilmTemperature) else None
    return solve_energy(
        film, posed.heat, profile, start=warm, before=posed.before, at_once=posed.at_once, corrected=corrected
    )


def _image(
    work: _Work, film: FilmSolution, profile: FlowProfile, heat: FilmTemperature | None, last: _Conditions
) -> tuple[_Guess, _Conditions, InputError | None]:
    """The oil's viscosity in a film; where the law does not hold, a point on the way from the last conditions.

    An oil still too stiff heats more than at the solution: the fault is then returned too.
    """
    posed = work.posed
    temperature = last.temperature if heat is None else heat.temperature
    flux = np.zeros((2, posed.problem.space.size)) if heat is None else heat.heat_flux
    opened = _growth(posed.heat, posed.problem, flux) / work.yardstick
    reached = _Conditions(temperature, shear_rate(film, profile))
    fault: InputError | None = None
    for halvings in range(MOST_HALVINGS):
        part = 0.5**halvings
        there = _Conditions(*(old + part * (new - old) for old, new in zip(last, reached, strict=True)))
        try:
            return _Guess(_share(posed, there, film.pressure), opened), there, fault
        except InputError as reason:
            fault = reason if fault is None else fault
    assert fault is not None
    raise fault


def _share(posed: ThermalCase, conditions: _Conditions, pressure: Array) -> Array:
    """Viscosity by the law over that of the resting oil, (size, m). Raises FilmInputError where that is not defined."""
    found = posed.law(conditions.temperature[:, 1:-1], pressure[:, None], conditions.rate)
    share = np.broadcast_to(found / resting_viscosity(posed.problem, pressure)[:, None], conditions.rate.shape)
    if not (share.min() > THINNEST and share.max() < 1.0 / THINNEST):
        warmest, coldest = np.max(conditions.temperature), np.min(conditions.temperature)
        raise FilmInputError(
            "viscosity across the film",
            f"{np.min(found):.3g} to {np.max(found):.3g} Pa s at {coldest:.4g} to {warmest:.4g} K",
            f"at least {THINNEST:g} of the resting oil's: a law that holds there, or a film that stays cooler",
        )
    return share


def _growth(heat: Heat | None, problem: FilmProblem, flux: Array) -> Array:
    """Deformation (vertices,) m by both walls' heat."""
    growth = np.zeros(len(problem.space.vertices))
    if heat is not None:
        for wall, into in zip((heat.fixed_wall, heat.moving_wall), flux, strict=True):
            growth = growth + deformation_by_heat(wall, problem.space, into)
    return growth
