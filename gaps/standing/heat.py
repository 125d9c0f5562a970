"""Temperatures of a part that stands still at every angle of a turn, by its films' own heat.

Heat crosses a film in less than a millisecond, so that films of a turn are warmed one by one; walls need minutes, so
that each has one temperature, at which it conducts the heat of all films of the turn.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from gaps.revolution.film_heat import MOST_WALL_ROUNDS, SETTLED, GapHeat, local_law, wall_image
from reynolds.errors import FilmNotConverged
from reynolds.floating.problem import Floating
from reynolds.floating.rest import held_at
from reynolds.floating.stage import FloatingStage
from reynolds.numerics.anderson import History
from reynolds.numerics.arrays import Array
from reynolds.solve.solver import FilmSolver
from reynolds.thermal.coupling import Coupled, ThermalCase, agree, with_profile
from reynolds.thermal.energy import FilmTemperature
from reynolds.thermal.film_profile import dowson, levels

Warm = Coupled[FilmTemperature | None]


def warm_turn(
    solver: FilmSolver, floating: Floating, cold: Sequence[FloatingStage], heat: GapHeat, rubbing: float
) -> list[FloatingStage]:
    """The films of a turn at evenly spaced angles, warmed, between walls that conduct their heat.

    cold: the part held at its positions (`held_at`) in isothermal films between rigid walls. `rubbing` (W): mean loss
    of contact over the turn, half of it into each wall. Raises FilmInputError where the oil's law ends,
    FilmNotConverged where films, temperatures or walls do not converge.
    """
    area, conductance = _means(cold, heat)
    walls, history = heat.outside, History()
    found: list[Warm | None] = [None] * len(cold)
    for _ in range(MOST_WALL_ROUNDS):
        pairs = zip(cold, found, strict=True)
        warm = [_agreed(solver, each, heat, walls, before) for each, before in pairs]
        taken = np.mean([_to_walls(one) for one in warm], axis=0) + 0.5 * rubbing
        image = wall_image(heat, walls, taken / area, conductance)
        if np.abs(image - walls).max() < SETTLED.walls:
            return [_held_warm(solver, floating, one, of) for one, of in zip(cold, warm, strict=True)]
        walls, found = history.extrapolate(walls, image), list(warm)
    raise FilmNotConverged(
        f"{floating.name}: temperature of the walls not settled after {MOST_WALL_ROUNDS} rounds",
        "walls that take more heat",
    )


def _agreed(solver: FilmSolver, cold: FloatingStage, heat: GapHeat, walls: Array, before: Warm | None) -> Warm:
    """Film and temperature in agreement, started from a film warmed before."""
    problem = cold.solution.problem
    posed = ThermalCase(problem, local_law(problem, heat), heat.of(problem, walls), at_once=True)
    return agree(posed, levels(), SETTLED.viscosity, solver, before)


def _held_warm(solver: FilmSolver, floating: Floating, cold: FloatingStage, found: Warm) -> FloatingStage:
    profile = dowson(levels(), found.share)
    warm = replace(floating, shape_at=lambda time: with_profile(floating.shape_at(time), profile))
    return held_at(solver, warm, cold.time, cold.q, found.film)


def _to_walls(found: Warm) -> Array:
    assert found.heat is not None  # one was posed
    return np.array([found.heat.to_fixed, found.heat.to_moving])


def _means(films: Sequence[FloatingStage], heat: GapHeat) -> tuple[float, float]:
    """Area (m2) of the films and their conductance to heat (W/(m2 K)), means over the turn."""
    spaces = [stage.solution.problem.space for stage in films]
    areas = [float(space.area.sum()) for space in spaces]
    passing = [
        float(np.sum(heat.conductivity / stage.solution.film.thickness * space.area))
        for stage, space in zip(films, spaces, strict=True)
    ]
    return float(np.mean(areas)), float(np.mean(passing) / np.mean(areas))
