"""What a film problem is, and what its solution holds. Frozen data, grouped by lifetime.

`FilmSpace` outlives many `Film`s; a `FilmProblem` is one film with its boundary conditions, a `FilmSolution`
one pressure field with the evidence that it is one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from reynolds.errors import FilmInputError
from reynolds.mesh import Array
from reynolds.space import FilmSpace


class Cavitation(Enum):
    """What a film does that cannot be pulled: none (negative pressure stands) or Reynolds' condition."""

    NONE = "none"
    REYNOLDS = "reynolds"


@dataclass(frozen=True)
class Held:
    """Boundary at a given pressure (Pa)."""

    pressure: float


@dataclass(frozen=True)
class Pocket:
    """Boundary of uniform unknown pressure, fed from outside.

    `feed(p)` gives the inflow (m3/s) into the film at pocket pressure p (Pa) and its derivative dq/dp <= 0.
    A groove without supply is fed by `no_feed`. The boundary must be a pocket of the space.
    """

    feed: Callable[[float], tuple[float, float]]


def no_feed(pressure: float) -> tuple[float, float]:
    """A groove that nothing enters from outside: inflow 0 at any pressure."""
    return 0.0, 0.0


Boundary = Held | Pocket


@dataclass(frozen=True)
class Film:
    """Film thickness, oil and motion at the quadrature points of a space.

    Each array is (cells | 1, points | 1): a length of one means "everywhere". SI: thickness m, viscosity Pa s,
    wall velocities m/s (moving and fixed wall, x and y), squeeze = dh/dt at a fixed place, m/s.
    `thickness_at_vertices` (vertices,) m, for pictures and the least film: where it is not known it is
    extrapolated from the quadrature points, which is exact for a smooth film and void for a step within a cell.
    Validity: thin (h much less than its length), laminar, inertia-free (rho U h^2/(mu L) << 1).
    """

    thickness: Array
    viscosity: Array
    velocity_moving: tuple[Array, Array]
    velocity_fixed: tuple[Array, Array]
    squeeze: Array
    thickness_at_vertices: Array | None = None


ZERO = np.zeros((1, 1))


def film(
    thickness: float | Array,
    viscosity: float | Array,
    *,
    velocity_moving: tuple[Array, Array] = (ZERO, ZERO),
    velocity_fixed: tuple[Array, Array] = (ZERO, ZERO),
    squeeze: Array = ZERO,
) -> Film:
    """A film with its fields checked: raises FilmInputError where thickness or viscosity is not positive."""
    thickness, mu = (np.atleast_2d(np.asarray(field, dtype=float)) for field in (thickness, viscosity))
    for name, values, unit in (("film thickness", thickness, "m"), ("viscosity", mu, "Pa s")):
        if not np.all(np.isfinite(values)) or values.min() <= 0.0:
            raise FilmInputError(name, f"minimum {values.min():.4g} {unit}", "positive everywhere")
    return Film(thickness, mu, velocity_moving, velocity_fixed, squeeze)


@dataclass(frozen=True)
class FilmProblem:
    """One film with its boundary conditions; a named boundary that is left out is closed (no flow).

    `held_nodes` (size,) may hold further unknowns at a pressure: NaN where the film is free (regions of the
    film plane that lie under a port). Pressures in Pa on one common reference, gauge or absolute.
    Raises FilmInputError for a field that is not of the space, or of which a value is no number.
    """

    space: FilmSpace
    film: Film
    boundary: Mapping[str, Boundary]
    cavitation: Cavitation = Cavitation.NONE
    cavitation_pressure: float = 0.0
    held_nodes: Array | None = None

    def __post_init__(self) -> None:
        cells, points = self.space.area.shape
        oil = self.film
        for name, field_values in (
            ("film thickness", oil.thickness), ("viscosity", oil.viscosity), ("squeeze", oil.squeeze),
            ("moving wall, x", oil.velocity_moving[0]), ("moving wall, y", oil.velocity_moving[1]),
            ("fixed wall, x", oil.velocity_fixed[0]), ("fixed wall, y", oil.velocity_fixed[1]),
        ):  # fmt: skip
            # The compiled loops trust these shapes: another one would read beside the array.
            shape = np.shape(field_values)
            if len(shape) != 2 or shape[0] not in (1, cells) or shape[1] not in (1, points):
                expected = f"(1 or {cells} cells, 1 or {points} points), as `space.sample` gives it"
                raise FilmInputError(name, f"an array of shape {shape}", expected)
            if not np.isfinite(field_values).all():
                raise FilmInputError(name, "a value that is not finite", "numbers")


def vertex_thickness(problem: FilmProblem) -> Array:
    """Film thickness at the vertices (vertices,) m: as known, else extrapolated; jumps are averaged (plots)."""
    known = problem.film.thickness_at_vertices
    return problem.space.to_vertices(problem.film.thickness) if known is None else known


@dataclass(frozen=True)
class FilmSolution:
    """A pressure field and its quality.

    pressure (size,) Pa; outflow: nodal residual fluxes (size,), m3/s, positive out of the film at held nodes
    and pockets; cavity marks unknowns at cavitation pressure; `imbalance` is the largest residual of a free
    unknown relative to the flows that meet there (round-off when converged).
    """

    problem: FilmProblem = field(repr=False)
    pressure: Array
    outflow: Array
    held: NDArray[np.bool_]
    cavity: NDArray[np.bool_]
    imbalance: float
    iterations: int
