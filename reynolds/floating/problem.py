"""A film with floating walls, as pure functions of time.

h(x, t; q) = shape(x, t) + sum_j q_j phi_j(x, t), q in m. At each instant

    Q_j(q, held before) + P_j(t, q, dq/dt) = sum_k M_jk d2q_k/dt2,
    Q_j = int (p - p_reference + p_contact) phi_j dA,

mostly with M = 0, and with the squeeze of the film in the oil that it stores. `floating.step` solves one implicit
step, `numerics.dirk` and `numerics.shooting` march with such steps.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from reynolds.numerics.arrays import Array
from reynolds.problem import FilmProblem


@dataclass(frozen=True)
class Outer:
    """Generalised forces from outside, positive along their coordinate.

    force (k,) N, its slopes by position (k, k) N/m and by rate dq/dt (k, k) N s/m: `by_position[i, j]` is
    dP_i/dq_j. `steady` gives forces without slopes.
    """

    force: Array
    by_position: Array
    by_rate: Array


def steady(force: Array) -> Outer:
    """Forces (k,) N that depend on neither position nor rate."""
    nothing = np.zeros((len(force), len(force)))
    return Outer(np.asarray(force, dtype=float), nothing, nothing)


@dataclass(frozen=True)
class Floating:
    """A film and the forces on its walls, as pure functions of time (s).

    name: of the part, for messages. shape_at(t): the film at q = 0, without storage, its squeeze only that of
    moving shapes, which no storage covers. Its thickness is then the distance of the mean planes and may have any
    sign (make it by `Film`, since `film` wants it positive). Its asperities bear where walls touch;
    `rough_overlap.film_between` treats an overlap of the mean planes. modes_at(t): phi at the vertices, (vertices,
    k); between them interpolated (`FilmSpace.sample_vertices`). outer_at(t, q, dq/dt): see `Outer`; a film that
    bears a load W along q has P = -W. reference: pressure (Pa) around the part, the zero of its forces. pockets:
    by name of a pocket, the area (k,) m2 by which its volume grows with each coordinate: its oil is stored and its
    pressure pushes accordingly; its feed is the supply alone. inertia: generalised masses M (k, k) kg, None: none.
    Where the mesh moves in time, wall velocities are those relative to the mesh.
    """

    name: str
    shape_at: Callable[[float], FilmProblem]
    modes_at: Callable[[float], Array]
    outer_at: Callable[[float, Array, Array], Outer]
    reference: float = 0.0
    pockets: Mapping[str, Array] = field(default_factory=dict)
    inertia: Array | None = None
