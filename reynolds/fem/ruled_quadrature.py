"""Formulas on meshes whose quadrature points lie in rows and columns: a function of x alone costs one row."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array

SAME = 1e-9  # of the film's length: coordinates nearer than this are one


@dataclass(frozen=True)
class Ruling:
    """Columns x (columns, 1) m and rows y (1, rows) m, and the column and row of each point, (cells, points)."""

    x: Array
    y: Array
    column: NDArray[np.intp]
    row: NDArray[np.intp]

    @cached_property
    def place(self) -> NDArray[np.intp]:
        """Index of each point in the rows and columns, flat."""
        return self.column * self.y.size + self.row

    def sample(self, field: Callable[[Array, Array], Array | float]) -> Array:
        """A formula at the points, (cells, points): numpy broadcasts the column x and the row y.

        Raises FilmInputError for values of another shape.
        """
        values, shape = np.asarray(field(self.x, self.y), dtype=float), (self.x.size, self.y.size)
        if values.shape == (shape[0], 1):  # as most films are: of the angle alone
            return values.ravel().take(self.column)
        try:
            whole = np.broadcast_to(values, shape)
        except ValueError:
            found = f"values of shape {values.shape}"
            raise FilmInputError("formula", found, f"{shape}, or one in place of either number") from None
        return whole.ravel().take(self.place)


def ruling_of(points: Array) -> Ruling | None:
    """The ruling of points (2, cells, points) m that fill all places of some rows and columns, else None."""
    (x, column), (y, row) = (_distinct(along, SAME * np.ptp(points)) for along in points)
    places = column * len(y) + row
    if len(x) * len(y) != places.size or not np.bincount(places.ravel(), minlength=places.size).all():
        return None
    return Ruling(x[:, None], y[None, :], column, row)


def _distinct(values: Array, near: float) -> tuple[Array, NDArray[np.intp]]:
    """Distinct values, and the index of each value's own."""
    order = np.argsort(values, axis=None)
    sorted_values = values.ravel()[order]
    new = np.concatenate([[True], np.diff(sorted_values) > near])
    number = np.empty(values.size, dtype=np.intp)
    number[order] = np.cumsum(new) - 1
    return sorted_values[new], number.reshape(values.shape)
