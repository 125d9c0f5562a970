"""How far walls that give way open under a film's pressure and, where they touch, under their contact."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csc_array, csr_array, eye_array, issparse
from scipy.sparse.linalg import splu

from reynolds.compliant import singular
from reynolds.contact import contact_pressure
from reynolds.errors import FilmInputError, FilmNotConverged
from reynolds.film import FilmProblem
from reynolds.mesh import Array
from reynolds.space import FilmSpace
from reynolds.walls import LowRank, WallMatrix, full

MAX_STEPS = 30
TOLERANCE = 1e-12  # of film thickness and asperities' height
DEEPEST = 5.0  # standard deviations of the summits by which a step may press them into each other


def opening(problem: FilmProblem, pressure: Array, start: Array | None = None) -> Array:
    """Opening of the film at the vertices (vertices,) m under nodal pressures (size,) Pa.

    Solves g = C (p + p_c(h + g)) by Newton's method from `start`: contact closes as the film opens. Raises
    FilmNotConverged where that does not settle, and FilmInputError as the contact's law does.
    """
    if problem.walls is None:
        return np.zeros(len(problem.space.vertices))
    compliance = problem.walls.matrix
    alone = np.asarray(compliance @ pressure)
    if not np.isfinite(alone).all():
        raise FilmInputError("walls", "a compliance that is not finite", "numbers, m/Pa")
    if problem.asperities is None:
        return alone
    given = _given_thickness(problem)
    # Contact closes as the film opens, without bound: from where it barely resists, Newton's steps lead up.
    deepest = problem.asperities.summit_height - DEEPEST * problem.asperities.height
    found = np.maximum(alone if start is None else start, deepest - given)
    for _ in range(MAX_STEPS):
        bears = contact_pressure(problem.asperities, given + found)
        rest = found - alone - compliance @ _to_unknowns(problem.space, bears.value)
        if np.max(np.abs(rest)) < TOLERANCE * (np.max(np.abs(given)) + problem.asperities.height):
            return found
        found = np.maximum(found - _settled(problem, bears.slope, rest), deepest - given)
    raise FilmNotConverged(
        f"the opening of walls in contact not settled after {MAX_STEPS} steps", "a thicker film, or stiffer walls"
    )


def opening_slope(problem: FilmProblem, found: Array) -> WallMatrix:
    """dg/dp at an opening (vertices,) m: (vertices, size) m/Pa, the compliance where nothing touches."""
    assert problem.walls is not None
    compliance = problem.walls.matrix
    if problem.asperities is None:
        return compliance
    bears = contact_pressure(problem.asperities, _given_thickness(problem) + found)
    if isinstance(compliance, LowRank):
        stiffer = _within_rank(compliance, _spread(problem.space, bears.slope))
        return LowRank(compliance.left, solved(stiffer, full(compliance.right)))
    system = _with_contact(problem.space, compliance, bears.slope)
    if not isinstance(compliance, np.ndarray):
        return csr_array(solved(system, compliance.toarray()))
    return solved(system, compliance)


def _settled(problem: FilmProblem, slope: Array, rest: Array) -> Array:
    """(I - C dp_c/dh)^-1 times what is missing (vertices,)."""
    assert problem.walls is not None
    compliance = problem.walls.matrix
    if isinstance(compliance, LowRank):
        spread = _spread(problem.space, slope)
        pressed = compliance.right @ (spread @ rest)
        return np.asarray(rest + compliance.left @ solved(_within_rank(compliance, spread), pressed))
    return solved(_with_contact(problem.space, compliance, slope), rest)


def _given_thickness(problem: FilmProblem) -> Array:
    if problem.space.degree != 1:
        raise FilmInputError("film_space", "quadratic pressure between walls that touch", "degree 1")
    known = problem.film.thickness_at_vertices
    return problem.space.to_vertices(problem.film.thickness) if known is None else known


def _with_contact(space: FilmSpace, compliance: Array | csr_array, slope: Array) -> Array | csr_array:
    """I - C dp_c/dh over the vertices."""
    change = compliance @ _spread(space, slope)
    if issparse(compliance):
        return csr_array(eye_array(len(slope)) - change)
    return np.asarray(np.eye(len(slope)) - change)


def _within_rank(compliance: LowRank, spread: csr_array) -> Array:
    """I - R dp_c/dh L, (rank, rank): (I - L R S)^-1 L R = L (I - R S L)^-1 R (Woodbury 1950)."""
    return np.asarray(np.eye(compliance.rank) - compliance.right @ (spread @ compliance.left))


def _spread(space: FilmSpace, slope: Array) -> csr_array:
    """dp_c/dh of the vertices (vertices,) Pa/m as pressure of the unknowns by the opening, (size, vertices)."""
    shared = np.bincount(space.vertex_dofs)[space.vertex_dofs]
    entries = (slope / shared, (space.vertex_dofs, np.arange(len(slope))))
    return csr_array(entries, shape=(space.size, len(slope)))


def solved(system: Array | csr_array, load: Array) -> Array:
    """x with A x = load for a dense or sparse A; raises FilmNotConverged for a singular one."""
    try:
        if issparse(system):
            return np.asarray(splu(csc_array(system)).solve(load))
        return np.asarray(np.linalg.solve(system, load))
    except (np.linalg.LinAlgError, RuntimeError) as reason:  # SuperLU: "Factor is exactly singular"
        raise singular(str(reason)) from None


def _to_unknowns(space: FilmSpace, at_vertices: Array) -> Array:
    total = np.bincount(space.vertex_dofs, weights=at_vertices, minlength=space.size)
    return total / np.maximum(np.bincount(space.vertex_dofs, minlength=space.size), 1)
