"""Film problem and film solution: frozen data, grouped by lifetime.

`FilmSpace` outlives many `Film`s; a `FilmProblem` is one film with its boundary conditions, a `FilmSolution`
one pressure field with the evidence of its quality.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from reynolds.bodies.compliance import ElasticWalls
from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.laws.contact import Asperities
from reynolds.laws.fluid import CONSTANT, Fluid
from reynolds.laws.roughness import Surface
from reynolds.numerics.array_kernels import all_finite
from reynolds.numerics.arrays import Array


class Cavitation(Enum):
    """Cavitation model: treatment of pressures below the cavitation pressure.

    NONE: they stay. REYNOLDS: pressure and its gradient vanish where the film ruptures; creates and destroys oil
    in the cavity. JFO (Jakobsson and Floberg 1957, Olsson 1965): the cavity is filled in part, by a film fraction
    that moves with the walls; conserves mass where the film ruptures and where it reforms.
    """

    NONE = "none"
    REYNOLDS = "reynolds"
    JFO = "jfo"


@dataclass(frozen=True)
class Held:
    """Boundary at a given pressure (Pa), with the film fraction (0 .. 1) of its inflow.

    Less than one, a starved supply, goes with the cavitation pressure, since a film filled in part bears none.
    """

    pressure: float
    film_fraction: float = 1.0


@dataclass(frozen=True)
class Pocket:
    """Boundary of uniform unknown pressure, fed from outside.

    `feed(p)` gives the inflow (m3/s) into the film at pocket pressure p (Pa) and its derivative dq/dp <= 0.
    A groove without supply is fed by `no_feed`. `volume` (m3) counts in a film with storage, filled in
    part at cavitation pressure like the film. The boundary must be a pocket of the space.
    """

    feed: Callable[[float], tuple[float, float]]
    volume: float = 0.0


def no_feed(pressure: float) -> tuple[float, float]:
    """A groove without supply: inflow 0 at any pressure."""
    return 0.0, 0.0


Boundary = Held | Pocket


LEAST_FRACTION = -0.01
"""Film fraction that cells with obtuse angles may overshoot to; one further below zero is an error."""

ZERO = np.zeros((1, 1))
HALF = np.full((1, 1), 0.5)


@dataclass(frozen=True)
class Film:
    """Film thickness, oil and motion at the quadrature points of a space.

    Each array is (cells | 1, points | 1): a length of one means "everywhere". SI: thickness m, viscosity Pa s, wall
    velocities m/s (moving and fixed wall, x and y), squeeze = dh/dt at a fixed place, m/s. `thickness_at_vertices`
    (vertices,) m, for pictures and the least film: if None it is extrapolated from the quadrature points, which is
    exact for a smooth film and not valid for a step within a cell. Where viscosity varies across the film (Dowson
    1962), `viscosity` is that of pressure flow, `couette_viscosity` (Pa s; None: the same) that of sliding, and
    `moving_share` w the moving wall's share: mean velocity w U_moving + (1 - w) U_fixed, shear of the pressure gradient
    w h grad p on the moving wall and (1 - w) h grad p on the fixed one. Validity: thin (h much less than its length),
    laminar, inertia-free (rho U h^2/(mu L) << 1).
    """

    thickness: Array
    viscosity: Array
    velocity_moving: tuple[Array, Array]
    velocity_fixed: tuple[Array, Array]
    squeeze: Array
    thickness_at_vertices: Array | None = None
    couette_viscosity: Array | None = None
    moving_share: Array = field(default_factory=lambda: HALF)

    @property
    def sliding_viscosity(self) -> Array:
        """Viscosity of the stress of sliding, mu (U1 - U2)/h (Pa s)."""
        return self.viscosity if self.couette_viscosity is None else self.couette_viscosity

    @property
    def mean_velocity(self) -> tuple[Array, Array]:
        """Mean velocity of the Couette flow, w U_moving + (1 - w) U_fixed (m/s)."""
        w = self.moving_share
        x, y = (
            one if one is two else w * one + (1.0 - w) * two
            for one, two in zip(self.velocity_moving, self.velocity_fixed, strict=True)
        )
        return x, y


def film(
    thickness: float | Array,
    viscosity: float | Array,
    *,
    velocity_moving: tuple[Array, Array] = (ZERO, ZERO),
    velocity_fixed: tuple[Array, Array] = (ZERO, ZERO),
    squeeze: Array = ZERO,
) -> Film:
    """A film with its fields checked.

    Thickness (m) and viscosity (Pa s) are numbers or arrays as in `Film`. Raises FilmInputError where one is
    not positive, or an array of one axis, which could be cells or points.
    """
    if 1 in (np.ndim(thickness), np.ndim(viscosity)):
        raise FilmInputError("film", "an array of one axis", "a number, or (1 | cells, 1 | points)")
    thickness, mu = (
        np.atleast_2d(_numbers(*one)) for one in (("film thickness", thickness, "m"), ("viscosity", viscosity, "Pa s"))
    )
    for name, values, unit in (("film thickness", thickness, "m"), ("viscosity", mu, "Pa s")):
        if not _all_finite(values) or values.min() <= 0.0:
            raise FilmInputError(name, f"minimum {values.min():.4g} {unit}", "positive everywhere")
    return Film(thickness, mu, velocity_moving, velocity_fixed, squeeze)


def _numbers(name: str, given: object, unit: str) -> Array:
    """A number or numbers as an array; raises FilmInputError for anything else, such as a text with a unit."""
    try:
        return np.asarray(given, dtype=float)
    except (TypeError, ValueError):
        raise FilmInputError(name, repr(given), f"a number or an array, {unit}") from None


def widened(space: FilmSpace, film: Film, growth: Array) -> Film:
    """A film grown by (vertices,) m at the vertices, by other loads than its own pressure."""
    corners = film.thickness_at_vertices
    return replace(
        film,
        thickness=film.thickness + space.sample_vertices(growth),
        thickness_at_vertices=None if corners is None else corners + growth,
    )


def _all_finite(values: Array) -> bool:
    """True if every value is finite; a single value is tested without numpy's loops."""
    return isfinite(values.item()) if values.size == 1 else bool(all_finite(np.ravel(values)))


@dataclass(frozen=True)
class Storage:
    """Oil of each unknown one time step ago, (size,) m3 at reference density, and the step (s)."""

    held_before: Array
    step: float


@dataclass(frozen=True)
class FilmProblem:
    """One film with its boundary conditions; a named boundary that is left out is closed (no flow).

    `held_nodes` (size,) may hold further unknowns at a pressure: NaN where the film is free (regions of the film plane
    that lie under a port). `fluid` gives viscosity and density over pressure, `surface` the roughness of the walls,
    `asperities` their contact, and `walls` their compliance. With `storage` the film is one step of a transient: it
    stores the change of its oil, beside `film.squeeze`. Pressures in Pa on one common reference, gauge or absolute.
    Where two held boundaries meet, their common unknowns are held by the later one. Raises FilmInputError for a field
    of another space, or with a value that is not finite or out of range.
    """

    space: FilmSpace
    film: Film
    boundary: Mapping[str, Boundary]
    cavitation: Cavitation = Cavitation.JFO
    cavitation_pressure: float = 0.0
    held_nodes: Array | None = None
    fluid: Fluid = CONSTANT
    surface: Surface | None = None
    asperities: Asperities | None = None
    walls: ElasticWalls | None = None
    storage: Storage | None = None

    def __post_init__(self) -> None:
        self._check_fields()
        self._check_nodal()
        for name, condition in self.boundary.items():
            if not isinstance(condition, (Held, Pocket)):
                raise FilmInputError(f"boundary {name}", repr(condition), f"Held or Pocket, such as {Held(0.0)}")
        if not isinstance(self.cavitation, Cavitation):
            raise FilmInputError("cavitation", repr(self.cavitation), "a member of Cavitation")
        if not np.isfinite(self.cavitation_pressure):
            raise FilmInputError("cavitation pressure", f"{self.cavitation_pressure:g} Pa", "a finite number")
        if self.storage is not None and not 0.0 < self.storage.step < np.inf:
            raise FilmInputError("storage", f"a step of {self.storage.step:g} s", "above zero, and finite")

    def _check_fields(self) -> None:
        """Check a field at the quadrature points."""
        cells, points = self.space.area.shape
        oil = self.film
        for name, field_values in (
            ("film thickness", oil.thickness), ("viscosity", oil.viscosity), ("squeeze", oil.squeeze),
            ("moving wall, x", oil.velocity_moving[0]), ("moving wall, y", oil.velocity_moving[1]),
            ("fixed wall, x", oil.velocity_fixed[0]), ("fixed wall, y", oil.velocity_fixed[1]),
            ("moving wall's share", oil.moving_share), ("sliding viscosity", oil.couette_viscosity),
        ):  # fmt: skip
            if field_values is None or field_values is ZERO or field_values is HALF:  # valid by construction
                continue
            # The compiled loops trust these shapes: another one would read beside the array.
            shape = np.shape(field_values)
            if len(shape) != 2 or shape[0] not in (1, cells) or shape[1] not in (1, points):
                expected = f"(1 or {cells} cells, 1 or {points} points), as `space.sample` gives it"
                raise FilmInputError(name, f"an array of shape {shape}", expected)
            if not _all_finite(field_values):
                raise FilmInputError(name, "a value that is not finite", "numbers")
        wanted = (len(self.space.vertices), self.space.size)
        if self.walls is not None and self.walls.matrix.shape != wanted:
            found = f"a compliance of shape {self.walls.matrix.shape}"
            raise FilmInputError("walls", found, f"{wanted}: {wanted[0]} vertices, {wanted[1]} unknowns")
        for name, viscosity in (("viscosity", oil.viscosity), ("sliding viscosity", oil.couette_viscosity)):
            if viscosity is not None and viscosity.min() <= 0.0:
                raise FilmInputError(name, f"{viscosity.min():.4g} Pa s", "positive everywhere")

    def _check_nodal(self) -> None:
        """Check a field at the unknowns or at the vertices."""
        held = None if self.storage is None else self.storage.held_before
        for name, values, size in (
            ("held nodes", self.held_nodes, self.space.size), ("storage", held, self.space.size),
            ("film thickness at the vertices", self.film.thickness_at_vertices, len(self.space.vertices)),
        ):  # fmt: skip
            if values is not None and np.shape(values) != (size,):
                raise FilmInputError(name, f"an array of shape {np.shape(values)}", f"({size},)")
        if held is not None and not holds_oil(self, held):
            raise FilmInputError("storage", f"{held.min():.3g} m3 of oil at an unknown", "none, or more than none")


@dataclass(frozen=True, repr=False)
class FilmSolution:
    """Solution of a film problem, and its quality.

    pressure (size,) Pa; film_fraction (size,), 1 in the film; film: under this pressure, with the walls'
    deformation (vertices,) m in its thickness and the oil's law in its viscosity; flux, m2/s, and content, m:
    Couette flow and oil per area at the quadrature points of a full film. Of each unknown (size,), at reference
    density: outflow, m3/s out of the film at held nodes and pockets; storage_rate, rate of its oil in m3/s;
    upwind_exchange, flow by upwinding in a cavity and at its ends, m3/s; flow_scale, sum of the magnitudes of its
    flows, m3/s. `cavity` marks unknowns at cavitation pressure; `path` is the imbalance after each step.
    """

    problem: FilmProblem
    pressure: Array
    film_fraction: Array
    film: Film
    deformation: Array
    flux: tuple[Array, Array]
    content: Array
    outflow: Array
    storage_rate: Array
    upwind_exchange: Array
    flow_scale: Array
    held: NDArray[np.bool_]
    cavity: NDArray[np.bool_]
    path: tuple[float, ...]

    def __repr__(self) -> str:
        """Size, pressures, film, cavity and quality in a line."""
        thickness = self.film.thickness
        return (
            f"FilmSolution({len(self.pressure)} unknowns, {np.count_nonzero(self.cavity)} of them in a cavity: "
            f"pressure {self.pressure.min():.4g} to {self.pressure.max():.4g} Pa, "
            f"film {thickness.min():.4g} to {thickness.max():.4g} m, "
            f"imbalance {self.imbalance:.2g} after {self.iterations} steps)"
        )

    @cached_property
    def holds(self) -> Array:
        """Oil of each unknown, (size,) m3 at reference density."""
        ratio = self.problem.fluid.density(self.pressure)[0]
        return contents(self.problem, self.content) * self.film_fraction * ratio

    @property
    def gap(self) -> Array:
        """Distance of the mean planes at the quadrature points, (cells | 1, points | 1) m, which decides contact.

        Equal to the film's thickness except for rough walls that overlap (`rough_overlap`).
        """
        given = self.problem.film.thickness
        return given if self.problem.walls is None else given + self.problem.space.sample_vertices(self.deformation)

    @property
    def imbalance(self) -> float:
        """Largest residual of a free unknown relative to `flow_scale` (round-off when converged)."""
        return self.path[-1]

    @property
    def iterations(self) -> int:
        """Steps that the solver took."""
        return len(self.path)


def contents(problem: FilmProblem, content: Array) -> Array:
    """Oil of each unknown of a full film, (size,) m3 at reference density: film content (m), and pockets."""
    held = problem.space.lumped(content)
    for name, condition in problem.boundary.items():
        if isinstance(condition, Pocket) and condition.volume:
            held[problem.space.edge_dofs[name]] += condition.volume
    return held


def holds_oil(problem: FilmProblem, held: Array) -> bool:
    """True if no unknown has negative oil (size,) m3, except for the overshoot of cells with obtuse angles."""
    film = np.ones(problem.space.size, dtype=bool)
    for name, condition in problem.boundary.items():
        if isinstance(condition, Pocket) and name in problem.space.edge_dofs:
            film[problem.space.edge_dofs[name]] = False
    return bool(held.min() >= LEAST_FRACTION * held[film].max(initial=0.0))
