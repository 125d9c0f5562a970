"""A film on a sphere, drawn in the plane by the stereographic map, which keeps angles.

From the pole opposite the film's middle, where the sphere touches the plane: the parallel at the polar angle t
becomes the circle of radius 2 R tan(t/2). A length on the map is `scale` times as long on the sphere, in every
direction, so that int k grad p . grad f is the same on both. Equations and fields are those of the sphere (m, m/s,
Pa/m along it); coordinates x, y are those of the map. Source: do Carmo 1976, conformal maps.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class Sphere:
    """Sphere of a fixed wall through the origin, normals out of that wall into the film.

    radius (m): positive where the wall bulges into the film, negative where it is concave, infinite for a plane.
    Raises FilmInputError for zero and for no number.
    """

    radius: float = np.inf

    def __post_init__(self) -> None:
        if not abs(self.radius) > 0.0:
            raise FilmInputError("sphere, radius", f"{self.radius:g} m", "a length other than zero")

    @property
    def is_plane(self) -> bool:
        """True for an infinite radius."""
        return bool(np.isinf(self.radius))

    def scale(self, x: Array, y: Array) -> Array:
        """Length on the sphere over length on the map at x, y (m): cos^2(t/2) = 1/(1 + (x^2 + y^2)/(4 R^2))."""
        return np.asarray(1.0 / (1.0 + (x / (2.0 * self.radius)) ** 2 + (y / (2.0 * self.radius)) ** 2))

    def place(self, x: Array, y: Array) -> tuple[Array, Array, Array]:
        """Place of a point of the map in space, m; z = 0 at the middle, along its normal."""
        if self.is_plane:
            return x, y, np.zeros_like(x)
        scale = self.scale(x, y)
        return scale * x, scale * y, -scale * (x**2 + y**2) / (2.0 * self.radius)

    def in_space(self, points: Array) -> Array:
        """Places (n, 3) m of points (n, 2) m of the map."""
        return np.column_stack(self.place(*points.T))

    def normal(self, x: Array, y: Array) -> tuple[Array, Array, Array]:
        """Unit normal at a point of the map."""
        scale = self.scale(x, y)
        return scale * x / self.radius, scale * y / self.radius, 2.0 * scale - 1.0

    def stretch(self, distance: ArrayLike) -> Array:
        """Distance on the map over distance from the axis r (m): 2/(1 + cos t), sin t = r/R.

        Raises FilmInputError for r beyond the sphere's radius.
        """
        sine = np.asarray(distance, dtype=float) / self.radius
        if not np.all(np.abs(sine) < 1.0):
            found = f"a point {np.max(distance):.4g} m off the axis"
            raise FilmInputError("film on a sphere", found, f"less than the sphere's radius, {self.radius:.4g} m")
        return np.asarray(2.0 / (1.0 + np.sqrt(1.0 - sine**2)))


PLANE = Sphere()
"""No sphere: the map is the film."""
