"""The film between rough walls whose mean planes touch or overlap: its thickness stays positive.

The gap between mean planes may have either sign where asperities are pressed together; the oil there flows, shears
and is stored between the summits.
"""

from dataclasses import replace

import numpy as np

from reynolds.laws.contact import Asperities
from reynolds.laws.law import Tangent
from reynolds.laws.roughness import Surface, mean_thickness
from reynolds.numerics.arrays import Array
from reynolds.problem import FilmProblem, FilmSolution


def film_between(problem: FilmProblem, gap: Array) -> Tangent:
    """Film thickness (m) at a gap between mean planes (m), of any shape, and its slope by the gap.

    The gap itself without asperities. With asperities alone: hT = sigma [H N(H) + n(H)], the mean distance of walls of
    Gaussian height, H = gap/sigma, with the summits' sigma; but the gap itself between elastic walls, which keep it
    open. With a `Surface`, whose flow factors are functions of the gap: the gap down to the range of Patir and Cheng
    (half a standard deviation or one), from there on an exponential with the same value and slope. That continuation is
    assumed, not measured: it keeps the film positive.
    """
    return film_at(problem.surface, problem.asperities, problem.walls is not None, gap)


def film_at(surface: Surface | None, asperities: Asperities | None, elastic: bool, gap: Array) -> Tangent:
    """The same by roughness and summits of the walls, and whether they are elastic."""
    if asperities is None or (surface is None and elastic):
        return Tangent(gap, np.ones((1,) * gap.ndim))
    if surface is None:
        return mean_thickness(asperities.height, gap)
    least = surface.lowest_ratio * surface.composite_roughness
    below = least * np.exp(np.minimum(gap / least, 1.0) - 1.0)
    return Tangent(np.where(gap < least, below, gap), np.where(gap < least, below / least, 1.0))


def vertex_thickness(solution: FilmSolution) -> Array:
    """Film thickness at the vertices (vertices,) m: as known, else extrapolated; jumps are averaged (plots)."""
    given = solution.problem.film
    if given.thickness_at_vertices is None:
        return solution.problem.space.to_vertices(solution.film.thickness)
    if solution.problem.walls is None:
        return given.thickness_at_vertices
    return film_between(solution.problem, given.thickness_at_vertices + solution.deformation).value


def as_shaped(solution: FilmSolution) -> FilmSolution:
    """The same film between rigid walls of its present shape, without contact."""
    problem = solution.problem
    if problem.walls is None and problem.asperities is None:
        return solution
    shaped = replace(problem.film, thickness=solution.film.thickness)
    if shaped.thickness_at_vertices is not None:
        shaped = replace(shaped, thickness_at_vertices=vertex_thickness(solution))
    rigid = replace(problem, film=shaped, walls=None, asperities=None)
    return replace(solution, problem=rigid, deformation=np.zeros_like(solution.deformation))
