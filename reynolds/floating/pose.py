"""A floating film at a position, before it is solved: its shape there, and its distance from touching."""

from dataclasses import dataclass, replace

import numpy as np

from reynolds.equation.rough_overlap import film_between
from reynolds.floating.coordinates import ContactForce, Modes, SoftContact
from reynolds.laws.contact import LOWEST_RATIO, Asperities
from reynolds.laws.law import Tangent
from reynolds.numerics.arrays import Array
from reynolds.problem import Film, FilmProblem, FilmSolution

THINNEST = 1e-9  # m: of a film between walls without asperities, some molecules of oil
SOLID = 1.0 - 1e-6  # of the overlap at which the law of contact ends


@dataclass(frozen=True)
class PosedFilm:
    """A film at a position, before it is solved, and the asperities of its problem; see `Trial`."""

    film: Film
    asperities: Asperities | None
    gap: Array
    corner_gap: Array | None
    least: float
    thicker: Array


def posed(shape: FilmProblem, modes: Modes, q: Array) -> PosedFilm:
    """The film of a shape at a position (k,) m.

    Between rigid walls the problem has no contact, since the gap determines it; between elastic walls it has.
    """
    gap, corners = shape.film.thickness + modes.rise(q), shape.film.thickness_at_vertices
    if shape.walls is not None:
        corners = None if corners is None else corners + modes.at_vertices @ q
        film = replace(shape.film, thickness=gap, thickness_at_vertices=corners)
        return PosedFilm(film, shape.asperities, gap, corners, float(gap.min()), modes.at_points)
    between = film_between(shape, gap)
    gap, corners, least = rigid_gap(shape, modes, q)
    thicker = np.ascontiguousarray(between.slope[:, :, None] * modes.at_points)
    return PosedFilm(rigid_film(shape, modes, q, between), None, gap, corners, least, thicker)


def rigid_film(shape: FilmProblem, modes: Modes, q: Array, between: Tangent) -> Film:
    """The film between rigid walls at a position (k,) m, its thickness at the points (m) with the slope by the gap.

    It is squeezed as it grows with the gap, whose rate is the squeeze of the shape.
    """
    squeeze, corners = shape.film.squeeze, film_at_corners(shape, modes, q)
    squeeze = squeeze * between.slope if squeeze.any() else squeeze
    return replace(shape.film, thickness=between.value, thickness_at_vertices=corners, squeeze=squeeze)


def rigid_gap(shape: FilmProblem, modes: Modes, q: Array) -> tuple[Array, Array | None, float]:
    """Gap between rigid walls at the points (cells, points) and vertices (vertices,) m, and the least of both.

    Rough walls have no gap at the vertices: summits bear at the points, and a film is between them at any gap there.
    """
    gap, corners = shape.film.thickness + modes.rise(q), shape.film.thickness_at_vertices
    if corners is None or (shape.asperities is not None and shape.surface is not None):
        return gap, None, float(gap.min())
    corners = corners + modes.at_vertices @ q
    return gap, corners, min(float(gap.min()), float(corners.min()))


def film_at_corners(shape: FilmProblem, modes: Modes, q: Array) -> Array | None:
    """Film thickness (vertices,) m between rigid walls at a position (k,) m; None where the shape gives none."""
    given = shape.film.thickness_at_vertices
    return None if given is None else film_between(shape, given + modes.at_vertices @ q).value


def deformed_pose(at: PosedFilm, solution: FilmSolution, contact: ContactForce | None) -> PosedFilm:
    """The pose of the deformed walls: their gap, and its growth with the position."""
    gap = np.broadcast_to(solution.gap, solution.problem.space.area.shape)
    corners = None if at.corner_gap is None else at.corner_gap + solution.deformation
    thicker = at.thicker
    if isinstance(contact, SoftContact):
        space = solution.problem.space
        thicker = np.ascontiguousarray(space.reference.geometry_value @ contact.grown[space.cells])
    least = min(float(part.min()) for part in (gap, corners) if part is not None)
    return PosedFilm(at.film, at.asperities, gap, corners, least, thicker)


def lowest_gap(shape: FilmProblem) -> float:
    """The gap (m) above which there is a film: nearly zero, or the end of the law of contact.

    Smooth elastic walls keep any film open.
    """
    if shape.walls is not None and shape.asperities is None:
        return -np.inf
    if shape.asperities is None:
        return THINNEST
    return shape.asperities.summit_height + SOLID * LOWEST_RATIO * shape.asperities.height
