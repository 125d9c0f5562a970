"""The flow of a solved film between neighbouring unknowns, spread across the film.

The balance of the film is one of flows between unknowns: pressure drives K_ij (p_j - p_i) along the edge i j, and
the walls' flow off each corner of a cell passes between its corners (on a triangle through the median dual
faces). So unknowns are control volumes whose flows are antisymmetric and sum to the film's own balance to
round-off, without a further approximation. Each part of it, driven by pressure or dragged
by a wall, has its own shape across the film, of mean one, so that mass is conserved for any shapes.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reynolds.equation.balance import FilmState, cavity_density, density, operators
from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmSolution, Pocket
from reynolds.thermal import energy_kernels
from reynolds.thermal.film_profile import FlowProfile


@dataclass(frozen=True)
class Neighbours:
    """Neighbours of each unknown by rows: start (size + 1,); neighbour, edge and sign of its flow, (2 edges,).

    A flow counts from the edge's lower unknown to its higher one; sign is +1 at the lower.
    """

    start: NDArray[np.int64]
    neighbour: NDArray[np.int64]
    edge: NDArray[np.int64]
    sign: Array


@dataclass(frozen=True)
class EdgeFlow:
    """Flows of oil (m3/s at reference density) at the Gauss points across the film, per zeta.

    flow (edges, m) between neighbours, leaving (size, m) through the boundary, positive out; storage_rate (size,):
    stored at the unknown (squeeze, storage, Reynolds' cavity), the same at each level; up (size, m): through
    the levels, in zeta's direction; working (size, m) W: flow times pressure rise.
    """

    neighbours: Neighbours
    flow: Array
    leaving: Array
    storage_rate: Array
    up: Array
    working: Array


def edge_flow(solution: FilmSolution, profile: FlowProfile) -> EdgeFlow:
    """The flows of a solution whose film has this profile.

    Afterwards flows off each unknown, outflow and storage sum to zero at every level together with
    the flow through the levels, which is zero at both walls. Raises FilmInputError for a space of degree 2.
    """
    space, across = solution.problem.space, profile.levels
    if space.degree != 1:
        raise FilmInputError("film space", f"degree {space.degree}", "degree 1 where the film's heat is carried")
    slots, lower, higher = _edges(space)
    parts = _parts(solution)[:, slots]
    shapes = (profile.driven, profile.sliding, profile.fixed)
    flow = sum(p[:, None] * 0.5 * (s[lower] + s[higher]) for p, s in zip(parts, shapes, strict=True))
    flow = np.ascontiguousarray(flow)
    neighbours = _neighbours(lower, higher, space.size)
    off, working = np.empty((2, space.size, len(across.weights)))
    energy_kernels.gather(
        neighbours.start, neighbours.neighbour, neighbours.edge, neighbours.sign, flow, solution.pressure,
        off, working,
    )  # fmt: skip
    leaving = _leaving(solution, profile)
    storage_rate = -(off + leaving) @ across.weights
    up = -(off + leaving + storage_rate[:, None]) @ across.integral.T
    return EdgeFlow(neighbours, flow, leaving, storage_rate, up, working)


def _edges(space: FilmSpace) -> tuple[NDArray[np.int64], NDArray[np.int32], NDArray[np.int32]]:
    """Places in the pattern of the pairs of unknowns, with the lower and the higher unknown of each."""
    row, column = space.pattern.indices, space.pattern.columns
    slots = np.flatnonzero(row != column)
    return slots, row[slots], column[slots]


def _parts(solution: FilmSolution) -> Array:
    """Flows in the pattern's places (3, entries): driven by pressure, with the moving wall, with the fixed one."""
    problem, space = solution.problem, solution.problem.space
    operator = operators(problem, FilmState(solution.pressure, solution.film_fraction, solution.deformation))
    row, column = space.pattern.indices, space.pattern.columns
    driven = operator.stiffness * (solution.pressure[column] - solution.pressure[row])
    dragged = _with_walls(solution)
    added = cavity_density(problem) * operator.diffusion
    added *= solution.film_fraction[column] - solution.film_fraction[row]
    return np.stack([driven, *(dragged + added * _shares(dragged))])


def _with_walls(solution: FilmSolution) -> Array:
    """Flows with the moving and with the fixed wall (2, entries)."""
    space, reference = solution.problem.space, solution.problem.space.reference
    moving, fixed = _wall_fluxes(solution)
    # Flow over a line of the map: what crosses a length of the film, times their ratio.
    flows = [np.asarray(part * space.scale) for part in (*moving, *fixed)]
    out = np.empty((2, len(space.pattern.indices)))
    energy_kernels.wall_flows(
        space.vertices, space.cells, space.dofs, space.pattern.slots, reference.value, reference.gradient,
        reference.geometry_gradient, reference.weights, _split(space.cells.shape[1]), *flows,
        _filling(solution), out,
    )  # fmt: skip
    return out


def _shares(dragged: Array) -> Array:
    """Share of each wall in the flow of both; the upwinding of a cavity is divided in this proportion."""
    size = np.abs(dragged)
    total = size.sum(axis=0)
    share = np.where(total > 0.0, size[0] / np.where(total > 0.0, total, 1.0), 1.0)
    return np.stack([share, 1.0 - share])


def _wall_fluxes(solution: FilmSolution) -> tuple[list[Array], list[Array]]:
    """Flow per width with either wall's motion in a full film along x and y (m2/s): of the moving one, of the fixed.

    With the fixed one h (1 - w) U_fixed, with the moving one the rest.
    """
    film = solution.film
    fixed = [film.thickness * (1.0 - film.moving_share) * along for along in film.velocity_fixed]
    return [whole - part for whole, part in zip(solution.flux, fixed, strict=True)], fixed


def _filling(solution: FilmSolution) -> Array:
    """Oil in the film over that of a full one at reference density, (size,)."""
    return np.asarray(solution.film_fraction * density(solution.problem, solution.pressure)[0])


def _split(corners: int) -> Array:
    """Least flows between a cell's corners with given outflow of each, (pairs i <= j, corners).

    None along a quadrilateral's diagonals.
    """
    pairs = [(i, j) for i in range(corners) for j in range(i, corners)]
    incidence = np.zeros((corners, len(pairs)))
    for k, (i, j) in enumerate(pairs):
        if j - i in (1, corners - 1):
            incidence[i, k], incidence[j, k] = 1.0, -1.0
    return np.ascontiguousarray(np.linalg.pinv(incidence))


def _neighbours(lower: NDArray[np.int32], higher: NDArray[np.int32], size: int) -> Neighbours:
    edges = len(lower)
    here = np.concatenate([lower, higher]).astype(np.int64)
    order = np.argsort(here, kind="stable")
    start = np.concatenate([[0], np.cumsum(np.bincount(here, minlength=size))])
    there = np.concatenate([higher, lower]).astype(np.int64)[order]
    edge = np.tile(np.arange(edges), 2)[order]
    return Neighbours(start, there, edge, np.repeat([1.0, -1.0], edges)[order])


def _leaving(solution: FilmSolution, profile: FlowProfile) -> Array:
    """Flow out of the film at each held unknown and pocket, at the Gauss points (size, m) m3/s.

    The walls' part follows their direction at the boundary; the rest is driven by pressure.
    """
    problem, space = solution.problem, solution.problem.space
    filling = _filling(solution)
    dragged = np.zeros((2, space.size))
    for name in problem.boundary:
        nodes = space.edge_dofs[name]
        for part, along in enumerate(_wall_fluxes(solution)):
            nodal = np.column_stack([space.to_unknowns(flux)[nodes] for flux in along])
            dragged[part, nodes] += filling[nodes] * np.sum(nodal * space.edge_normal[name], axis=1)
    out = np.where(open_unknowns(solution), solution.outflow, 0.0)
    driven = out - dragged.sum(axis=0)
    parts = ((driven, profile.driven), (dragged[0], profile.sliding), (dragged[1], profile.fixed))
    return np.asarray(sum(flow[:, None] * shape for flow, shape in parts))


def open_unknowns(solution: FilmSolution) -> NDArray[np.bool_]:
    """Unknowns at which oil enters or leaves the film: held ones and pockets (size,)."""
    found = solution.held.copy()
    for name, condition in solution.problem.boundary.items():
        if isinstance(condition, Pocket):
            found[solution.problem.space.edge_dofs[name]] = True
    return found
