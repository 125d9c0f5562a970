"""Closed surfaces of simple bodies: bodies of revolution, rings with openings, rings with bores."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from reynolds.numerics.arrays import Array

TURN = 2.0 * np.pi
FINEST = np.radians(6.0)
"""Largest angle between neighbouring points of a circle."""
ALONG = 8
"""Edges on each of the four sides of a sector and of the bore in it."""

Height = Callable[[Array], Array]
"""Radius (n,) m -> height along the axis (n,) m."""


@dataclass(frozen=True)
class Surface:
    """Surface of a body: points (n, 3) m and cells (m, 4) of their numbers, counterclockwise from outside."""

    points: Array
    cells: NDArray[np.int64]

    def in_space(self, place: Callable[[Array], Array]) -> Surface:
        """The same body with its points at other places."""
        return Surface(place(self.points), self.cells)


def joined(surfaces: Sequence[Surface]) -> Surface:
    """Several surfaces as one."""
    starts = np.cumsum([0, *(len(one.points) for one in surfaces[:-1])])
    cells = [one.cells + start for one, start in zip(surfaces, starts, strict=True)]
    return Surface(np.concatenate([one.points for one in surfaces]), np.concatenate(cells))


def revolved(outline: Array, around: int = 48) -> Surface:
    """A body of revolution about z.

    outline (n, 2) m: radius and height, counterclockwise in that plane and closed from the last point to the first.
    """
    angle = TURN * np.arange(around) / around
    radius, height = outline.T
    x, y = (radius[:, None] * part for part in (np.cos(angle), np.sin(angle)))
    points = np.stack([x, y, np.broadcast_to(height[:, None], x.shape)], axis=-1).reshape(-1, 3)
    start = np.arange(len(outline))
    off_axis = np.maximum(radius, np.roll(radius, -1)) > 0.0
    here, there = (around * rows[off_axis, None] for rows in (start, np.roll(start, -1)))
    column = np.arange(around)
    after = (column + 1) % around
    corners = [here + column, here + after, there + after, there + column]
    return Surface(points, np.stack(np.broadcast_arrays(*corners), axis=-1).reshape(-1, 4))


def round_angles(edges: Sequence[float]) -> Array:
    """Rising angles (n,) rad over a turn with all `edges` among them, at most FINEST apart; its end is left out."""
    inside = np.unique(np.round(np.mod(np.append(edges, 0.0), TURN), 12))
    ends = np.append(inside, inside[0] + TURN)
    return np.concatenate([np.linspace(a, b, int(np.ceil((b - a) / FINEST)) + 1)[:-1] for a, b in pairwise(ends)])


def ring_with_openings(radii: Array, angles: Array, solid: NDArray[np.bool_], bottom: Height, top: Height) -> Surface:
    """A ring about z between two faces, open from face to face where a sector is not `solid`.

    radii (n + 1,) m and angles (k,) rad: edges of the sectors; solid (n, k).
    """
    columns = solid.shape[1]
    r, a = np.meshgrid(radii, angles, indexing="ij")
    faces = [np.stack([r * np.cos(a), r * np.sin(a), face(r)], axis=-1) for face in (bottom, top)]
    number = np.arange(2 * r.size).reshape(2, *r.shape)
    after = np.roll(number, -1, axis=2)
    below, above = number
    under, over = after

    def walls(corners: tuple[NDArray[np.int64], ...], there: NDArray[np.bool_]) -> NDArray[np.int64]:
        return np.stack(corners, axis=-1)[there]

    empty = np.zeros((1, columns), dtype=bool)
    inward = np.concatenate([solid, empty]) & ~np.concatenate([empty, solid])
    outward = np.concatenate([empty, solid]) & ~np.concatenate([solid, empty])
    begins, ends = solid & ~np.roll(solid, 1, axis=1), solid & ~np.roll(solid, -1, axis=1)
    cells = [
        walls((above[:-1], above[1:], over[1:], over[:-1]), solid),
        walls((below[:-1], under[:-1], under[1:], below[1:]), solid),
        walls((below, above, over, under), inward),
        walls((below, under, over, above), outward),
        walls((below[:-1], below[1:], above[1:], above[:-1]), begins),
        walls((under[:-1], over[:-1], over[1:], under[1:]), ends),
    ]
    return Surface(np.concatenate(faces).reshape(-1, 3), np.concatenate(cells))


@dataclass(frozen=True)
class Bores:
    """Cylindrical bores through a ring, evenly around z: their number and radius (m).

    Their axes lean outwards by `cone` (rad) and cut z = 0 at the distance `pitch_radius` (m) from z.
    """

    number: int
    radius: float
    cone: float
    pitch_radius: float


def ring_with_bores(radii: tuple[float, float], heights: tuple[float, float], bores: Bores) -> Surface:
    """A ring about z from inner to outer radius and from bottom to top height (m), with bores through both faces.

    The bores' walls are ellipses in both faces. The first bore lies towards x.
    """
    side = np.linspace(-1.0, 1.0, ALONG + 1)[:-1]
    one = np.ones(ALONG)
    u, v = np.concatenate([side, one, -side, -one]), np.concatenate([-one, side, one, -side])
    middle, half = 0.5 * (radii[0] + radii[1]), 0.5 * (radii[1] - radii[0])
    towards = np.arctan2(v, u)
    pitch = TURN / bores.number
    turned = pitch * np.arange(bores.number)[:, None]
    levels = []
    for height in heights:
        x = bores.pitch_radius + height * np.tan(bores.cone) + bores.radius / np.cos(bores.cone) * np.cos(towards)
        y = bores.radius * np.sin(towards)
        hole = np.hypot(x, y), turned + np.arctan2(y, x)
        rim = middle + half * u, turned + 0.5 * pitch * v
        levels += [_at(*hole, height), _at(*rim, height)]
    number = np.arange(4 * bores.number * len(u)).reshape(4, bores.number, len(u))
    (hole_0, rim_0, hole_1, rim_1), (next_hole_0, next_rim_0, next_hole_1, next_rim_1) = number, np.roll(number, -1, 2)
    round_face = np.abs(np.roll(u, -1) + u) == 2.0  # both ends of an edge on the inner or on the outer radius
    cells = [
        (hole_1, rim_1, next_rim_1, next_hole_1),
        (hole_0, next_hole_0, next_rim_0, rim_0),
        (hole_0, hole_1, next_hole_1, next_hole_0),
        tuple(part[:, round_face] for part in (rim_0, next_rim_0, next_rim_1, rim_1)),
    ]
    points = np.concatenate([level.reshape(-1, 3) for level in levels])
    return Surface(points, np.concatenate([np.stack(one, axis=-1).reshape(-1, 4) for one in cells]))


def _at(radius: Array, angle: Array, height: float) -> Array:
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    return np.stack([x, y, np.full_like(x, height)], axis=-1)
