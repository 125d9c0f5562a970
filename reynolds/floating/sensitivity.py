"""Sensitivity of a solved film to its thickness and to its oil before the step, by the solver's last factor.

The balance R(p, theta; h, held before) = 0 of every unknown, differentiated at constant cavity: J d(p, theta) = - R_h
dh + d(held before)/step, one right-hand side for each change. Exact between rigid walls; between elastic ones J leaves
out the change of a cavity's upwinding with the deformation (`balance.slopes`): some 1e-4 of dQ/dq.
"""

from dataclasses import dataclass

import numpy as np

from reynolds.equation.balance import FilmState, Operators, density
from reynolds.equation.deformation import deformation_slope
from reynolds.equation.thickness import ThicknessSlopes
from reynolds.equation.thickness_kernels import integrate
from reynolds.linear.factor import ITERATIVE_TOLERANCE
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution
from reynolds.solve.solver import FilmSolver


@dataclass(frozen=True)
class FilmSensitivity:
    """Changes of pressure (size, m) Pa and of film fraction (size, m) per unit of each of m parameters."""

    pressure: Array
    film_fraction: Array


def response(
    solver: FilmSolver, solution: FilmSolution, inflow: Array, tolerance: float = ITERATIVE_TOLERANCE
) -> FilmSensitivity:
    """Changes by inflows (size, m) m3/s into the unknowns, to a tolerance; held ones keep their pressure."""
    return FilmSensitivity(*solver.response(solution, inflow, tolerance))


def thickness_load(solution: FilmSolution, thicker: Array, parts: Operators) -> Array:
    """dR/dq_j at constant pressures and film fractions, (size, k) m3/s per unit of q_j.

    `parts`: the operators of the solution's balance (`FilmSolver.operators`).
    """
    state = FilmState(solution.pressure, solution.film_fraction, solution.deformation)
    return ThicknessSlopes(solution.problem, parts, state).load(thicker)


def oil_slopes(solution: FilmSolution, thicker: Array, changed: FilmSensitivity, parts: Operators) -> Array:
    """Change of each unknown's oil, (size, k) m3 per unit of q_j at reference density.

    `thicker` and `parts` as above; `changed`: the changes of pressures and film fractions, the pressures
    deforming elastic walls.
    """
    problem, space = solution.problem, solution.problem.space
    ratio, ratio_slope = density(problem, solution.pressure)
    terms = parts.transport
    grown = np.empty((space.size, thicker.shape[2]))
    if problem.walls is not None:
        opened = deformation_slope(problem, solution.deformation) @ changed.pressure
        thicker = thicker + space.reference.geometry_value @ opened[space.cells]
    wider = np.ascontiguousarray(terms.content_slope[:, :, None] * thicker)
    integrate(space.dofs, space.reference.value, space.area, wider, *space.reference.loops, grown)
    content, fraction = parts.content[:, None], solution.film_fraction[:, None]
    ratio, ratio_slope = ratio[:, None], ratio_slope[:, None]
    return np.asarray(
        fraction * ratio * grown + content * (ratio * changed.film_fraction + fraction * ratio_slope * changed.pressure)
    )
