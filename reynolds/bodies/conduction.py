"""Steady heat in a body, and the deformation of the film as the body expands.

    - div(k grad T) = 0;  k dT/dn = q on the film's face, h (T_ambient - T) on cooled faces; T given on held ones
    sigma = lambda div u I + 2 mu eps(u) - (3 lambda + 2 mu) alpha (T - T_0) I

Both are linear, so that their effect on the film is a `FaceResponse`: reference + matrix @ (heat at the face nodes).
Transient heat is neglected: a body's own time L^2 rho c/k is seconds to minutes, a revolution's milliseconds.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from reynolds.bodies.elasticity import BLOCK, Structure, divergence, normal_forces
from reynolds.bodies.space import BodySpace, Face, assembled
from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array


@dataclass(frozen=True)
class Thermal:
    """Conductivity (W/(m K)), linear expansion (1/K) and temperature without strain (K, or degC like all others).

    Raises FilmInputError unless the conductivity is above zero.
    """

    conductivity: float
    expansion: float
    unstrained_temperature: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.conductivity) and self.conductivity > 0.0):
            raise FilmInputError("conductivity", f"{self.conductivity:.4g} W/(m K)", "above zero")


@dataclass(frozen=True)
class Convection:
    """A face cooled (or heated) by its surroundings: coefficient h (W/(m2 K)), ambient temperature."""

    coefficient: float
    ambient: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.coefficient) and self.coefficient > 0.0):
            raise FilmInputError("convection", f"coefficient {self.coefficient:.4g} W/(m2 K)", "above zero")


@dataclass(frozen=True)
class HeldTemperature:
    """A face at a given temperature."""

    temperature: float


Surroundings = Mapping[str, Convection | HeldTemperature]


@dataclass(frozen=True)
class FaceResponse:
    """Response of the face nodes: reference (nodes,) + matrix (nodes, nodes) @ input at the nodes (N or W)."""

    reference: Array
    matrix: Array


@dataclass(frozen=True)
class HeatedBody:
    """A body's steady conduction, factorised. `reference` (nodes,) is its temperature without the film's heat."""

    space: BodySpace
    thermal: Thermal
    reference: Array
    free: Any
    factor: Any

    def warmed(self, heat: Array) -> Array:
        """Rise of temperature (nodes, k) by heat (nodes, k) W; held nodes absorb theirs without a rise."""
        rise = np.zeros(heat.shape)
        rise[self.free] = self.factor.solve(np.ascontiguousarray(heat[self.free]))
        return rise


def heated_body(space: BodySpace, thermal: Thermal, surroundings: Surroundings) -> HeatedBody:
    """A body in its surroundings; a face that is not named passes no heat but the film's.

    Raises FilmInputError where no face or surroundings remove heat: no steady temperature exists.
    """
    if not surroundings:
        raise FilmInputError("body's surroundings", "no face that heat leaves by", "convection or a held temperature")
    size = len(space.places)
    matrix = _conductance(space, thermal.conductivity)
    source, temperature = np.zeros(size), np.zeros(size)
    held = np.zeros(size, dtype=bool)
    for name, around in surroundings.items():
        face = space.face(name)
        if isinstance(around, HeldTemperature):
            held[face.nodes] = True
            temperature[face.nodes] = around.temperature
            continue
        np.add.at(source, face.nodes, around.coefficient * around.ambient * face.gathered(1.0))
        entries = (around.coefficient * face.mass).tocoo()
        rows, columns = (face.nodes[part] for part in entries.coords)
        matrix = matrix + csc_array((entries.data, (rows, columns)), shape=matrix.shape)
    free = np.flatnonzero(~held)
    inner = csc_array(matrix[free][:, free])
    factor = splu(inner, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    temperature[free] = factor.solve((source - matrix @ temperature)[free])
    return HeatedBody(space, thermal, temperature, free, factor)


def face_temperature(body: HeatedBody, face: Face) -> FaceResponse:
    """Temperature at the face nodes by heat (W) into each: reference + matrix @ heat, matrix symmetric, K/W."""
    count = len(face.nodes)
    matrix = np.empty((count, count))
    for columns, heat in _unit_heat(body.space, face):
        matrix[:, columns] = body.warmed(heat)[face.nodes]
    return FaceResponse(body.reference[face.nodes], 0.5 * (matrix + matrix.T))


def face_expansion(heated: HeatedBody, body: Structure, face: Face, normals: Array) -> FaceResponse:
    """Displacement into the body at the face nodes (m) by heat (W) into each: reference + matrix @ heat.

    The reference is that of the surroundings alone. Of a body free to move the rigid part is removed as for forces
    (`elasticity`), so that a uniformly warm one expands freely about its middle.
    """
    into = normal_forces(body.space, face, normals)
    coupling = expansion_forces(body, heated.thermal.expansion)
    matrix = np.empty((into.shape[1],) * 2)
    # By symmetry the rows: displacement at a node by a temperature anywhere is that temperature's work on the
    # node's unit force, and its heat anywhere that of the adjoint temperature.
    for start in range(0, into.shape[1], BLOCK):
        rows = slice(start, start + BLOCK)
        work = coupling.T @ body.displaced(into[:, rows].toarray())
        matrix[rows] = heated.warmed(np.asarray(work))[face.nodes].T
    warm = heated.reference - heated.thermal.unstrained_temperature
    return FaceResponse(temperature_deformation(body, face, normals, heated.thermal.expansion, warm), matrix)


def temperature_deformation(body: Structure, face: Face, normals: Array, expansion: float, rise: Array) -> Array:
    """Displacement into the body (face nodes,) m by a rise (nodes,) K above the temperature without strain."""
    forces = expansion_forces(body, expansion) @ rise
    return np.asarray(normal_forces(body.space, face, normals).T @ body.displaced(forces[:, None])[:, 0])


def expansion_forces(body: Structure, expansion: float) -> csc_array:
    """Nodal forces (dofs, nodes) N/K by nodal temperature: integral of (3 lambda + 2 mu) alpha T div v."""
    space = body.space
    lam, mu = body.elastic.lame
    spread = divergence(space).reshape(len(space.cells), -1, space.volume.shape[1])
    local = (3.0 * lam + 2.0 * mu) * expansion * ((spread * space.volume[:, None, :]) @ space.value.T)
    return assembled(space.dofs, space.cells, local, (space.places.size, len(space.places)))


def _conductance(space: BodySpace, conductivity: float) -> csc_array:
    local = np.einsum("eakq,ebkq,eq->eab", space.gradient, space.gradient, conductivity * space.volume, optimize=True)
    return assembled(space.cells, space.cells, local, (len(space.places),) * 2)


def _unit_heat(space: BodySpace, face: Face) -> Any:
    """Blocks of columns and the heat (nodes, block) of one watt at each of their face nodes."""
    for start in range(0, len(face.nodes), BLOCK):
        nodes = face.nodes[start : start + BLOCK]
        heat = np.zeros((len(space.places), len(nodes)))
        heat[nodes, np.arange(len(nodes))] = 1.0
        yield slice(start, start + BLOCK), heat
