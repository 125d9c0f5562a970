"""Value and slope of a law of the oil or of the walls, and checks of its range.

The film solver is a Newton method, so that every law gives its derivative.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array


class Tangent(NamedTuple):
    """A law's value and its derivative with respect to the law's first argument, arrays of one shape."""

    value: Array
    slope: Array


def within(
    where: str, found: ArrayLike, lowest: float, highest: float, unit: str, remedy: str = "",
    kind: type[FilmInputError] = FilmInputError,
) -> Array:  # fmt: skip
    """The values as an array, all of them in [lowest, highest]: else an error of the kind, which a NaN raises too."""
    values = np.asarray(found, dtype=float)
    if not np.all((values >= lowest) & (values <= highest)):
        least, most = f"{np.min(values):.6g}", f"{np.max(values):.6g}"
        span = f"{least if least == most else f'{least} .. {most}'} {unit}"
        advice = f"; {remedy}" if remedy else ""
        raise kind(where, span, f"{lowest:.6g} .. {highest:.6g} {unit}{advice}")
    return values


def require_positive(where: str, **values: float) -> None:
    """Every value is a finite number above zero: else FilmInputError with its name."""
    for name, value in values.items():
        if not (np.isfinite(value) and value > 0.0):
            raise FilmInputError(f"{where}, {name}", f"{value:g}", "a positive number, SI")
