"""How a solved film answers to its thickness and to what it held: slopes on the solver's last factor.

The balance R(p, theta; h, held before) = 0 of every unknown, differentiated with the cavity as it is:
J d(p, theta) = - R_h dh + d(held before)/step, one right-hand side for each change.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from reynolds import generalised_kernels
from reynolds import kernels as film_kernels
from reynolds.balance import (
    Operators,
    State,
    cavity_density,
    density,
    operators,
    steep_gradient,
)
from reynolds.film import Cavitation, FilmSolution
from reynolds.mesh import Array
from reynolds.solve import FilmSolver
from reynolds.transport import along, at_points

DIFFERENCE = 1e-6  # of the film, for the slope of upwinding: next to linear in the thickness, so exact


@dataclass(frozen=True)
class Response:
    """Changes of pressure (size, m) Pa and of film fraction (size, m) per unit of each of m parameters."""

    pressure: Array
    film_fraction: Array


def thickness_slopes(solver: FilmSolver, solution: FilmSolution, thicker: Array) -> Response:
    """dp/dq_j and dtheta/dq_j of a film whose thickness grows by `thicker` (cells, points, k) per unit of q_j.

    Exact for the set of cavitated unknowns of the solution, all other things (boundaries, what was held before,
    wall speeds) as they are. `solver` is the one that gave the solution: its factor is used again.
    """
    return response(solver, solution, -thickness_load(solution, thicker))


def response(solver: FilmSolver, solution: FilmSolution, inflow: Array) -> Response:
    """What inflows (size, m) m3/s into the unknowns change; held ones keep their pressure."""
    return Response(*solver.response(solution, inflow))


def thickness_load(solution: FilmSolution, thicker: Array) -> Array:
    """dR/dq_j at constant pressures and film fractions, (size, k) m3/s per unit of q_j."""
    problem, state = solution.problem, _state(solution)
    parts = operators(problem, state)
    space, terms, tensors = problem.space, parts.transport, problem.space.tensors
    filling = state.film_fraction * density(problem, state.pressure)[0]
    driven = along(terms.conductance_slope, steep_gradient(space, state.pressure))
    full = at_points(space, filling)
    carried = (full * part for part in terms.flux_slope)
    per_second = 0.0 if problem.storage is None else terms.content_slope / problem.storage.step
    out = np.empty((space.size, thicker.shape[2]))
    generalised_kernels.thicken(
        space.dofs, tensors.shape, space.reference.value, tensors.steep_gradient, tensors.gradient, space.area,
        *(space.everywhere(part) for part in (*driven, *carried, np.atleast_2d(per_second))),
        filling, thicker, *space.reference.loops, out,
    )  # fmt: skip
    if problem.cavitation is Cavitation.JFO and bool(np.any(state.film_fraction != 1.0)):
        out += _mixing_load(solution, parts, thicker)
    return out


def _mixing_load(solution: FilmSolution, parts: Operators, thicker: Array) -> Array:
    """The share of upwinding, whose diffusion grows with the flow that the walls carry, (size, k)."""
    problem, pattern = solution.problem, solution.problem.space.pattern
    level = cavity_density(problem) * solution.film_fraction
    out = np.empty((problem.space.size, thicker.shape[2]))
    for j in range(thicker.shape[2]):
        mode = thicker[:, :, j]
        size = DIFFERENCE * float(np.abs(solution.film.thickness).min()) / max(float(np.abs(mode).max()), 1e-300)
        film = replace(problem.film, thickness=problem.film.thickness + size * mode)
        beside = operators(replace(problem, film=film), _state(solution))
        flow, met = np.zeros(problem.space.size), np.zeros(problem.space.size)
        grown = (beside.diffusion - parts.diffusion) / size
        film_kernels.exchange(pattern.indptr, pattern.indices, grown, level, flow, met)
        out[:, j] = flow
    return out


def oil_slopes(solution: FilmSolution, thicker: Array, changed: Response) -> Array:
    """Change of what each unknown holds, (size, k) m3 per unit of q_j at reference density.

    `thicker` as above; `changed` is what pressures and film fractions do meanwhile.
    """
    problem, space = solution.problem, solution.problem.space
    ratio, ratio_slope = density(problem, solution.pressure)
    terms = operators(problem, _state(solution)).transport
    grown = np.empty((space.size, thicker.shape[2]))
    wider = np.ascontiguousarray(terms.content_slope[:, :, None] * thicker)
    generalised_kernels.weigh(space.dofs, space.reference.value, space.area, wider, *space.reference.loops, grown)
    content, fraction = space.lumped(solution.content)[:, None], solution.film_fraction[:, None]
    ratio, ratio_slope = ratio[:, None], ratio_slope[:, None]
    return np.asarray(
        fraction * ratio * grown
        + content * (ratio * changed.film_fraction + fraction * ratio_slope * changed.pressure)
    )


def _state(solution: FilmSolution) -> State:
    return State(solution.pressure, solution.film_fraction, solution.opening)
