"""Slopes of the flow through a boundary: of the nodal outflows, and of the walls' flow where boundaries meet."""

import numpy as np

from reynolds.adjoint.solved import OutputSlopes, SolvedFilm, slopes_of
from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array
from reynolds.problem import Cavitation, Pocket
from reynolds.solve.loads import boundary_flows


def flow_slopes(film: SolvedFilm, boundary: str) -> OutputSlopes:
    """Flow (m3/s) out through a named boundary, as `boundary_flows` divides it, and its slopes.

    sum_i (m_i s_i outflow_i + theta_i flux_i . v_i), of a pocket its feed in place of the outflow: s the boundary's
    share of an unknown by length, m zero where a boundary supplies a cavity under Reynolds' condition, and v the
    normals of the walls' flow that is not in the first term. Raises FilmInputError for a boundary that is closed or
    not of the mesh.
    """
    solution, space = film.solution, film.space
    open_ones = [name for name in space.edge_dofs if name in film.problem.boundary]
    if boundary not in open_ones:
        found = "a closed boundary, whose flow is zero" if boundary in space.edge_dofs else "no boundary of this mesh"
        raise FilmInputError(f"flow through {boundary}", found, f"one of {', '.join(open_ones)}")
    length = np.zeros(space.size)
    for name in open_ones:
        length[space.edge_dofs[name]] += space.edge_share[name]
    nodes, share = space.edge_dofs[boundary], np.zeros(space.size)
    share[nodes] = space.edge_share[boundary] / length[nodes]
    flux = np.column_stack([space.to_unknowns(part) for part in solution.flux])
    share[_drawn(film, open_ones, length, flux)] = 0.0
    normal = np.zeros((space.size, 2))
    normal[nodes] += space.edge_normal[boundary]
    for name in open_ones:
        normal[space.edge_dofs[name]] -= share[space.edge_dofs[name], None] * space.edge_normal[name]
    by_gap = sum(
        _from_unknowns(film, solution.film_fraction * part) * slope
        for part, slope in zip(normal.T, film.parts.transport.flux_slope, strict=True)
    )
    return slopes_of(
        film,
        boundary_flows(solution)[boundary],
        by_pressure=-share * _feed_slopes(film),
        by_fraction=np.sum(flux * normal, axis=1),
        by_gap=np.asarray(by_gap),
        through=np.where(solution.held, share, 0.0),
    )


def _feed_slopes(film: SolvedFilm) -> Array:
    """Slopes of the feeds of pockets by their pressure, (size,): the flow from a pocket into the film is its feed."""
    found = np.zeros(film.space.size)
    for name, condition in film.problem.boundary.items():
        if isinstance(condition, Pocket):
            (node,) = film.space.edge_dofs[name]
            found[node] = condition.feed(float(film.solution.pressure[node]))[1]
    return found


def _drawn(film: SolvedFilm, open_ones: list[str], length: Array, flux: Array) -> Array:
    """Unknowns at which a boundary supplies a cavity under Reynolds' condition, (size,): no flow through it."""
    solution, space = film.solution, film.space
    if film.problem.cavitation is not Cavitation.REYNOLDS:
        return np.zeros(space.size, dtype=bool)
    rest = solution.outflow.copy()
    for name in open_ones:
        at = space.edge_dofs[name]
        rest[at] -= np.sum((solution.film_fraction[:, None] * flux)[at] * space.edge_normal[name], axis=1)
    level = solution.held & (length > 0.0) & (solution.pressure <= film.problem.cavitation_pressure)
    return np.asarray(level & (rest < 0.0))


def _from_unknowns(film: SolvedFilm, nodal: Array) -> Array:
    """The transpose of `FilmSpace.to_unknowns`: slopes (size,) by the unknowns as slopes by the points' values."""
    space = film.space
    count = np.maximum(np.bincount(space.dofs.ravel(), minlength=space.size), 1)
    return np.asarray((nodal / count)[space.dofs] @ space.reference.to_basis)
