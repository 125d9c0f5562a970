"""Profile of a piston by the adjoint: the least power that its film takes, at a side load that it must carry.

    python examples/optimisations/piston_profile.py

A parallel piston off its bore's axis carries no side load by pressure: the pressure falls alike on all sides. A piston
that is thinner towards the chamber keeps more pressure where its film is thin. The ten heights that are taken off
along the piston are found by SLSQP of SciPy, with derivatives by one transposed solve for each of the two outputs.
"""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from scipy.optimize import minimize

from reynolds import (
    ZERO,
    Cell,
    DissipationOutput,
    FilmProblem,
    FilmSolver,
    Held,
    OutputSlopes,
    SolvedFilm,
    film,
    film_gradients,
    film_space,
    rectangle,
    slopes_of,
)

DIAMETER, LENGTH, CLEARANCE, ECCENTRICITY = 0.022, 0.045, 15e-6, 0.6  # m, m, m, of the clearance
PRESSURE, SPEED, VISCOSITY = 35e6, 3.0, 0.025  # Pa, m/s out of the bore, Pa s
WANTED, DEEPEST = 3000.0, 20e-6  # N, m
PLACES = np.linspace(0.0, LENGTH, 10)  # of the profile, from the chamber's end


@dataclass(frozen=True)
class SideLoad:
    """Force of the film on the piston away from the thinnest film, N: - integral of p cos(angle from there)."""

    unit: ClassVar[str] = "N"

    def slopes(self, film: SolvedFilm) -> OutputSlopes:
        """Value and slopes: the output depends on the film by its pressure alone."""
        lever = film.space.area * np.cos(film.space.points[0] / (0.5 * DIAMETER))
        value = float(np.sum(film.pressure[0] * lever))
        return slopes_of(film, value, by_pressure=film.on_unknowns(lever))


space = film_space(rectangle((np.pi * DIAMETER, LENGTH), (32, 36), cell=Cell.QUADRILATERAL, periodic_x=True))
angle, along = space.points[0] / (0.5 * DIAMETER), space.points[1]
parallel = CLEARANCE * (1.0 - ECCENTRICITY * np.cos(angle))
hats = [np.interp(along, PLACES, np.eye(len(PLACES))[k]) for k in range(len(PLACES))]
oil = film(parallel, VISCOSITY, velocity_moving=(ZERO, np.full((1, 1), SPEED)))
problem = FilmProblem(space, oil, {"bottom": Held(PRESSURE), "top": Held(0.0)})
solver, outputs = FilmSolver(space), [DissipationOutput(), SideLoad()]
solved: dict[bytes, tuple[np.ndarray, np.ndarray]] = {}


def numbers(heights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return power (W) and side load (N) of a profile in units of the deepest one, and their slopes (2, 10)."""
    if heights.tobytes() not in solved:
        thickness = parallel + DEEPEST * sum(height * hat for height, hat in zip(heights, hats, strict=True))
        solution = solver.solve(replace(problem, film=replace(oil, thickness=thickness)))
        found = film_gradients(solver, solution, outputs)
        slopes = [[one.along(DEEPEST * hat) for hat in hats] for one in found]
        solved[heights.tobytes()] = np.array([one.value for one in found]), np.array(slopes)
    return solved[heights.tobytes()]


taper = 1.0 - PLACES / LENGTH
at, change = numbers(0.5 * taper), 1e-4 * np.ones(len(PLACES))
ahead, behind = numbers(0.5 * taper + change)[0], numbers(0.5 * taper - change)[0]
ratio = (ahead - behind) / (2.0 * at[1] @ change)
print(f"differences over slopes by the adjoint: power {ratio[0]:.5f}, side load {ratio[1]:.5f}")
power, load = numbers(0.0 * taper)[0]
print(f"parallel piston: {power:.1f} W, side load {abs(load):.1f} N")
steepest = next(k for k in np.linspace(0.0, 1.0, 201) if numbers(k * taper)[0][1] >= WANTED)
power, load = numbers(steepest * taper)[0]
print(f"straight taper of {1e6 * DEEPEST * steepest:.1f} um: {power:.1f} W, side load {load:.1f} N")

scale = numbers(steepest * taper)[0][0]
before = len(solved)
carries = {"type": "ineq", "fun": lambda x: numbers(x)[0][1] / WANTED - 1.0, "jac": lambda x: numbers(x)[1][1] / WANTED}
best = minimize(
    lambda x: numbers(x)[0][0] / scale,
    steepest * taper,
    jac=lambda x: numbers(x)[1][0] / scale,
    method="SLSQP",
    bounds=[(0.0, 1.0)] * len(PLACES),
    options={"maxiter": 60, "ftol": 1e-7},
    constraints=carries,
)
power, load = numbers(best.x)[0]
print(f"profile by the gradient, {len(solved) - before} films: {power:.1f} W, side load {load:.1f} N")
print("taken off, um:", np.round(1e6 * DEEPEST * best.x, 1))
