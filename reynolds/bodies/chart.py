"""Charts of a film on its wall: from the film plane (x, y) to points and outward normals of the body."""

from dataclasses import dataclass
from enum import Enum
from typing import Protocol

import numpy as np

from reynolds.errors import FilmInputError
from reynolds.fem.sphere import Sphere
from reynolds.numerics.arrays import Array

Vector = tuple[float, float, float]


class Side(Enum):
    """Side of a cylinder's surface on which the body lies; its film lies on the other."""

    BORE = -1  # the body lies outside the radius, its film within
    SHAFT = 1  # the body lies within, its film outside


class Chart(Protocol):
    """A film plane on a body's surface, isometric except for a sphere's, whose stretch is in the film's space."""

    def places(self, film_points: Array) -> Array:
        """Points (n, 3) m of the wall at points (n, 2) m of the film plane."""

    def normals(self, body_points: Array) -> Array:
        """Unit normals (n, 3) out of the body, into the film, at points (n, 3) of the wall."""


@dataclass(frozen=True)
class Plane:
    """A plane film: point = origin + x along_x + y along_y; `outward` is the body's normal towards the film.

    Raises FilmInputError unless the three directions are unit vectors at right angles.
    """

    outward: Vector
    origin: Vector = (0.0, 0.0, 0.0)
    along_x: Vector = (1.0, 0.0, 0.0)
    along_y: Vector = (0.0, 1.0, 0.0)

    def __post_init__(self) -> None:
        frame = np.array([self.along_x, self.along_y, self.outward])
        if not np.allclose(frame @ frame.T, np.eye(3), atol=1e-9):
            found = f"{self.along_x}, {self.along_y}, {self.outward}"
            raise FilmInputError("film plane", found, "three unit vectors at right angles")

    def places(self, film_points: Array) -> Array:
        """As `Chart.places`."""
        return np.asarray(self.origin) + film_points @ np.array([self.along_x, self.along_y])

    def normals(self, body_points: Array) -> Array:
        """As `Chart.normals`."""
        return np.broadcast_to(np.asarray(self.outward), (len(body_points), 3))


@dataclass(frozen=True)
class Cylinder:
    """A film unrolled from a cylinder about the body's z axis: x = radius (angle - zero_angle), y = z - base."""

    radius: float
    side: Side
    zero_angle: float = 0.0
    base: float = 0.0

    def places(self, film_points: Array) -> Array:
        """As `Chart.places`."""
        angle = self.zero_angle + film_points[:, 0] / self.radius
        return np.column_stack(
            [self.radius * np.cos(angle), self.radius * np.sin(angle), self.base + film_points[:, 1]]
        )

    def normals(self, body_points: Array) -> Array:
        """As `Chart.normals`."""
        flat = body_points * np.array([1.0, 1.0, 0.0])
        return self.side.value * flat / np.linalg.norm(flat, axis=1)[:, None]


@dataclass(frozen=True)
class OnSphere:
    """A film on a sphere through the origin (`reynolds.fem.sphere`), which may be a plane.

    The body lies under it, at z < 0, or over it.
    """

    sphere: Sphere
    over: bool = False

    def places(self, film_points: Array) -> Array:
        """As `Chart.places`."""
        return self.sphere.in_space(film_points)

    def normals(self, body_points: Array) -> Array:
        """As `Chart.normals`."""
        side = -1.0 if self.over else 1.0
        if self.sphere.is_plane:
            return np.broadcast_to(np.array([0.0, 0.0, side]), (len(body_points), 3))
        out = body_points + np.array([0.0, 0.0, self.sphere.radius])
        return side * np.sign(self.sphere.radius) * out / np.linalg.norm(out, axis=1)[:, None]


def on_section(points: Array, normals: Array) -> tuple[Array, Array]:
    """Points and normals in 3D as (r, z) of a body of revolution about z, (n, 2) each."""
    radius = np.hypot(points[:, 0], points[:, 1])
    out = points[:, :2] / np.maximum(radius, np.finfo(float).tiny)[:, None]
    radial = (normals[:, :2] * out).sum(axis=1)
    return np.column_stack([radius, points[:, 2]]), np.column_stack([radial, normals[:, 2]])


def face_normals(chart: Chart, places: Array) -> Array:
    """The film's normals at nodes (n, 3 | 2) of a body or of a section, (n, 3 | 2)."""
    if places.shape[1] == 3:
        return chart.normals(places)
    # In a section's half plane the nodes lie at angle zero.
    solid = np.column_stack([places[:, 0], np.zeros(len(places)), places[:, 1]])
    return on_section(solid, chart.normals(solid))[1]
