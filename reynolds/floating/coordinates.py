"""Generalised coordinates of a film: h = shape + sum_j q_j phi_j, and the force on each of them.

q_j in m, phi_j without unit (a tilt counts as the rise over a reference radius), so that every force
Q_j = int (p - p_reference + p_contact) phi_j dA is in N and Q_j dq_j is work.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from reynolds.equation import thickness_kernels as kernels
from reynolds.equation.deformation import Touch
from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.laws.contact import Asperities, contact_pressure
from reynolds.numerics.arrays import Array

NO_CONTACT = 8.0  # standard deviations from the summits' mean: beyond, less than 1e-15 of E' K is borne


@dataclass(frozen=True)
class Modes:
    """The modes phi_j of one space.

    at_vertices (vertices, k); at_points (cells, points, k), interpolated between the vertices; pockets (size, k) m2:
    growth of a pocket's volume with each coordinate beyond the film, at the pocket's unknown.
    """

    space: FilmSpace
    at_vertices: Array
    pockets: Array

    @cached_property
    def at_points(self) -> Array:
        """The modes at the quadrature points, (cells, points, k)."""
        return np.ascontiguousarray(self.space.reference.geometry_value @ self.at_vertices[self.space.cells])

    def rise(self, position: Array) -> Array:
        """Growth of the film by a position (k,) m at the quadrature points, (cells, points) m."""
        found: Array = kernels.mixed(self.at_points, np.ascontiguousarray(position).reshape(-1, 1))
        return found[:, :, 0]

    @cached_property
    def weights(self) -> Array:
        """int f_i phi_j and the pockets' areas, (size, k) m2: Q by nodal pressure."""
        return self.film_weights + self.pockets

    @cached_property
    def film_weights(self) -> Array:
        """int f_i phi_j over the film alone, (size, k) m2."""
        space, out = self.space, np.empty(self.pockets.shape)
        kernels.integrate(space.dofs, space.reference.value, space.area, self.at_points, *space.reference.loops, out)
        return out


def modes_on(space: FilmSpace, at_vertices: Array, pockets: Mapping[str, Array] | None = None) -> Modes:
    """Modes given at the vertices (vertices, k).

    `pockets` gives, by the name of a pocket of the space, the area (k,) m2 by which its volume grows with each
    coordinate: of a slipper's pocket pi r^2 for the lift. Raises FilmInputError for modes of another mesh or no
    numbers, and for a name that is no pocket.
    """
    if at_vertices.ndim != 2 or len(at_vertices) != len(space.vertices) or not np.isfinite(at_vertices).all():
        found = f"an array of shape {at_vertices.shape}"
        raise FilmInputError("modes", found, f"({len(space.vertices)} vertices, k) finite numbers")
    grown = np.zeros((space.size, at_vertices.shape[1]))
    for name, area in (pockets or {}).items():
        nodes = space.edge_dofs.get(name)
        if nodes is None or len(nodes) != 1:
            raise FilmInputError(f"pocket {name} of the modes", "no pocket of this space", "film_space(pockets=...)")
        grown[nodes[0]] += area
    return Modes(space, np.ascontiguousarray(at_vertices, dtype=float), grown)


def generalised_force(pressure: Array, modes: Modes, reference: float) -> Array:
    """Q_j = int (p - p_reference) phi_j dA with the pockets' force, (k,) N, of nodal pressures (size,) Pa.

    Positive where it opens the film along the mode; in a cavity p is the cavitation pressure.
    """
    return np.asarray((pressure - reference) @ modes.weights)


@dataclass(frozen=True)
class ContactForce:
    """Force of touching asperities (k,) N, its slopes by position (k, k) N/m, its magnitudes (k,) N.

    Slopes at constant film pressure, which deforms no rigid wall.
    """

    force: Array
    slopes: Array
    size: Array

    def by_pressure(self, changed: Array) -> Array:
        """Change of the force by changes (size, m) Pa of the film's pressure, (k, m) N."""
        return np.zeros((len(self.force), changed.shape[1]))

    def by_deformation(self, deformed: Array) -> Array:
        """The same by the deformation (vertices, m) m that these changes cause."""
        return np.zeros((len(self.force), deformed.shape[1]))


def contact_force(
    asperities: Asperities, gap: Array, modes: Modes, within: NDArray[np.bool_] | None = None
) -> ContactForce:
    """int p_c(gap) phi_j dA and its slopes int p_c' phi_i phi_j dA, the walls rigid.

    `gap` (cells, points) m is the distance of the mean planes, which may overlap down to the limit of
    `contact_pressure`; raises as that does. `within` (cells, 1): the cells that count, by default all.
    Source: Greenwood and Tripp 1970-71.
    """
    near = gap < asperities.summit_height + NO_CONTACT * asperities.height
    if within is not None:
        near &= within
    bears, phi, area = contact_pressure(asperities, gap[near]), modes.at_points[near], modes.space.area[near]
    weighted = area * bears.value
    return ContactForce(weighted @ phi, phi.T @ ((area * bears.slope)[:, None] * phi), weighted @ np.abs(phi))


@dataclass(frozen=True)
class SoftContact(ContactForce):
    """The same between elastic walls.

    touch: contact at the vertices; grown (vertices, k): growth of the gap by each coordinate at constant film
    pressure; lever (vertices, k) N/m: slopes of the force by the gap at the vertices.
    """

    touch: Touch
    grown: Array
    lever: Array

    def by_pressure(self, changed: Array) -> Array:
        """Change of the force by changes (size, m) Pa of film pressure, which deform the walls, (k, m) N."""
        return self.by_deformation(self.deformation(changed))

    def by_deformation(self, deformed: Array) -> Array:
        """The same by the deformation (vertices, m) m that these changes cause."""
        return np.asarray(self.lever.T @ deformed)

    def deformation(self, changed: Array) -> Array:
        """Deformation (vertices, m) m by changes (size, m) Pa of the film's pressure, against contact."""
        return self.touch.settled(np.asarray(self.touch.compliance @ changed))


def soft_contact(touch: Touch, modes: Modes) -> SoftContact:
    """int p_c phi_j dA between elastic walls: contact as a pressure of the film's unknowns.

    The gap grows by (I - C dp_c/dh)^-1 phi: contact stiffens the walls.
    """
    bears, weights = touch.on_unknowns, modes.film_weights
    lever = (touch.bears.slope * touch.meeting.shares)[:, None] * weights[touch.meeting.seats]
    grown = touch.settled(modes.at_vertices)
    return SoftContact(bears @ weights, lever.T @ grown, bears @ np.abs(weights), touch, grown, lever)
