"""A body under a film: response of its face as operators on the film's unknowns.

Signs: positive opens the film. Every costly result is computed once per body and face and kept (`cache`); the film's
mesh may change freely after that.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.sparse import csr_array, vstack

from reynolds.bodies.chart import Chart, face_normals
from reynolds.bodies.compliance import LowRank
from reynolds.bodies.conduction import Surroundings, Thermal, face_expansion, face_temperature, heated_body
from reynolds.bodies.elasticity import (
    Elastic,
    centrifugal_forces,
    face_compliance,
    face_deformation,
    pressure_forces,
    structure,
)
from reynolds.bodies.mesh import BodyMesh
from reynolds.bodies.space import BodySpace, Face, body_space
from reynolds.bodies.supports import Supports
from reynolds.bodies.transfer import Transfer, transfer
from reynolds.errors import FilmInputError
from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array
from reynolds.numerics.cache import CacheOrigin, content_key, kept


@dataclass(frozen=True)
class Body:
    """An elastic body, its supports, the face that is under the film, and where the film's plane lies on it.

    Name a face no larger than the film needs: the cached operator has n^2 numbers for n face nodes.
    """

    mesh: BodyMesh
    elastic: Elastic
    supports: Supports
    face: str
    chart: Chart


@dataclass(frozen=True)
class FacePressure:
    """Load case: a uniform pressure (Pa) on a face, such as a chamber on the end of its bore."""

    face: str
    pressure: float


@dataclass(frozen=True)
class Spin:
    """Load case: rotation at `speed` (rad/s) about a line along z through `axis` (x, y) m; density in kg/m3."""

    density: float
    speed: float
    axis: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True)
class BodyWall:
    """Deformation = matrix (vertices, size) m/Pa @ nodal film pressure; and its origin in the cache."""

    matrix: Array
    origin: CacheOrigin


@dataclass(frozen=True)
class FaceWall:
    """As `BodyWall`, with a matrix of the rank of the face's nodes."""

    matrix: LowRank
    origin: CacheOrigin


@dataclass(frozen=True)
class FilmResponse:
    """At the film's vertices: reference (vertices,) + matrix (vertices, vertices) @ flux into the body (W/m2)."""

    reference: Array
    matrix: Array


@dataclass(frozen=True)
class HeatedWall:
    """Wall temperature (scale of the surroundings) and deformation (m) by the film's heat flux into the body."""

    temperature: FilmResponse
    deformation: FilmResponse
    origin: CacheOrigin


def body_wall(
    body: Body, film: FilmSpace, *, pockets: Mapping[str, str] | None = None, folder: Path | None = None
) -> BodyWall:
    """The elastic wall of a film: deformation = matrix @ pressure, symmetric in mean square (module `transfer`).

    `pockets` names, for a pocket of the film, the body's face that its pressure fills: it has no film cells of its own.
    Raises FilmInputError where the face does not lie under the film, or for an unknown name.
    """
    found = face_wall(body, film, pockets=pockets, folder=folder)
    return BodyWall(found.matrix.toarray(), found.origin)


def face_wall(
    body: Body, film: FilmSpace, *, pockets: Mapping[str, str] | None = None, folder: Path | None = None
) -> FaceWall:
    """The wall of `body_wall` by the nodes of the body's face: for films with more unknowns than it has nodes.

    Kept for each film too, since finding its points in the face takes as long as reading the body.
    """
    filled, inner = dict(pockets or {}), CacheOrigin.CACHE

    def compute() -> dict[str, Array]:
        nonlocal inner
        left, right, inner = _met(body, film, filled, folder)
        size = np.array(right.shape)
        return {"left": left, "data": right.data, "indices": right.indices, "indptr": right.indptr, "size": size}

    on_film = film.vertices, film.cells, film.dofs, film.degree, film.sphere, film.size
    seats = [(name, face, *film.edge_dofs.get(name, ())) for name, face in sorted(filled.items())]
    found = kept(_key("wall", body, *on_film, seats), compute, folder)
    at = found.arrays
    right = csr_array((at["data"], at["indices"], at["indptr"]), shape=tuple(at["size"]))
    return FaceWall(LowRank(at["left"], right), inner if found.origin is CacheOrigin.COMPUTED else found.origin)


def _met(
    body: Body, film: FilmSpace, pockets: Mapping[str, str], folder: Path | None
) -> tuple[Array, csr_array, CacheOrigin]:
    """Deformation of a film by the forces at the face's nodes and in pockets, and these by the film's pressure."""
    space = body_space(body.mesh)
    face = space.face(body.face)
    normals = face_normals(body.chart, face.places)

    def compute() -> dict[str, Array]:
        return {"compliance": face_compliance(structure(space, body.elastic, body.supports), face, normals)}

    found = kept(_key("compliance", body), compute, folder)
    meeting = transfer(film, face, body.chart)
    left, right = meeting.deformation(found.arrays["compliance"]), meeting.force
    for name, filled in pockets.items():
        if name not in film.edge_dofs or len(film.edge_dofs[name]) != 1:
            raise FilmInputError(f"pocket {name}", "no such pocket of the film", "a boundary that is one unknown")
        nodal = _load_case(body, space, face, FacePressure(filled, 1.0), folder)
        alone = csr_array(([1.0], ([0], [film.edge_dofs[name][0]])), shape=(1, film.size))
        left, right = np.column_stack([left, meeting.deformation(nodal)]), csr_array(vstack([right, alone]))
    return left, right, found.origin


def load_deformation(body: Body, film: FilmSpace, load: FacePressure | Spin, *, folder: Path | None = None) -> Array:
    """Deformation (vertices,) m by a load case beside the film's pressure; linear in pressure, in speed^2."""
    space = body_space(body.mesh)
    face = space.face(body.face)
    return transfer(film, face, body.chart).deformation(_load_case(body, space, face, load, folder))


def heated_wall(
    body: Body, film: FilmSpace, thermal: Thermal, surroundings: Surroundings, *, folder: Path | None = None
) -> HeatedWall:
    """The wall's temperature and thermal deformation by the film's heat flux at its vertices (steady, linear).

    The deformation counts from the body at its unstrained temperature. Raises FilmInputError where no heat can leave.
    """
    space = body_space(body.mesh)
    face = space.face(body.face)
    normals = face_normals(body.chart, face.places)

    def compute() -> dict[str, Array]:
        heated = heated_body(space, thermal, surroundings)
        warm = face_temperature(heated, face)
        grown = face_expansion(heated, structure(space, body.elastic, body.supports), face, normals)
        return {
            "temperature": warm.reference, "resistance": warm.matrix,
            "opening": grown.reference, "expansion": grown.matrix,
        }  # fmt: skip

    found = kept(_key("heat", body, thermal, sorted(surroundings.items())), compute, folder)
    nodal, meeting = found.arrays, transfer(film, face, body.chart)
    return HeatedWall(
        _on_film(meeting, meeting.temperature, nodal["temperature"], nodal["resistance"]),
        _on_film(meeting, meeting.deformation, nodal["opening"], nodal["expansion"]),
        found.origin,
    )


def _on_film(meeting: Transfer, back: Callable[[Array], Array], reference: Array, matrix: Array) -> FilmResponse:
    """A response of the face nodes to heat at them, as one of the film's vertices to flux there."""
    return FilmResponse(back(reference), back((meeting.heat.T @ matrix.T).T))


def _load_case(body: Body, space: BodySpace, face: Face, load: FacePressure | Spin, folder: Path | None) -> Array:
    """Displacement into the body (face nodes,) m; the cache holds that of a unit load."""
    unit: FacePressure | Spin
    if isinstance(load, FacePressure):
        unit, size = FacePressure(load.face, 1.0), load.pressure
        forces = pressure_forces(space, space.face(load.face), 1.0)
    else:
        unit, size = Spin(1.0, 1.0, load.axis), load.density * load.speed**2
        forces = centrifugal_forces(space, 1.0, 1.0, load.axis)

    def compute() -> dict[str, Array]:
        normals = face_normals(body.chart, face.places)
        held = structure(space, body.elastic, body.supports)
        return {"opening": face_deformation(held, face, normals, forces)}

    return size * kept(_key("load", body, unit), compute, folder).arrays["opening"]


def _key(*parts: object) -> str:
    """Cache key: content of a body and of the quantity computed."""
    spelled: list[object] = []
    for part in parts:
        if not isinstance(part, Body):
            spelled.append(part)
            continue
        mesh = part.mesh.mesh
        spelled += [part.mesh.axisymmetric, type(mesh).__name__, mesh.doflocs, mesh.t]
        spelled += [part.elastic, part.supports, part.face, part.chart]
        for name in part.mesh.face_names:
            spelled += [name, np.asarray(mesh.boundaries[name])]
    return content_key(*spelled)
