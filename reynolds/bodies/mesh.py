"""Body meshes from parameters: block, ring (shell, thick cylinder, annular plate), disc, and an (r, z) section.

Hexahedra whose edges are parabolas through the true arcs; face names are API.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import skfem
from numpy.typing import NDArray

from reynolds.errors import FilmInputError
from reynolds.numerics.arrays import Array

FULL_TURN = (0.0, 2.0 * np.pi)
NEAR = 1e-9  # of the body's size: on a face or not


@dataclass(frozen=True)
class BodyMesh:
    """A body (metres) with named faces, in 3D (x, y, z), or the section (r, z) of a body of revolution about z.

    `mesh` is a scikit-fem mesh of hexahedra or tetrahedra; of quadrilaterals or triangles where `axisymmetric`.
    """

    mesh: skfem.Mesh
    axisymmetric: bool = False

    @property
    def face_names(self) -> tuple[str, ...]:
        """Names of the mesh's faces, in order."""
        return tuple(sorted(self.mesh.boundaries or {}))


def scaled(body: BodyMesh, unit: float) -> BodyMesh:
    """Return the body with its places times `unit`, the length unit of the mesh in metres: the mesh in metres."""
    return replace(body, mesh=replace(body.mesh, doflocs=unit * body.mesh.doflocs))


def block(
    size: tuple[float, float, float],
    cells: tuple[int, int, int],
    *,
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> BodyMesh:
    """A block w x l x t (m) along x, y, z with faces left, right (x), front, back (y), bottom, top (z)."""
    _positive("block", size, cells)
    at = [start + np.linspace(0.0, length, n + 1) for start, length, n in zip(origin, size, cells, strict=True)]
    mesh = skfem.MeshHex2.from_mesh(skfem.MeshHex1.init_tensor(*at))
    middle = _facet_middles(mesh)
    names = (("left", "right"), ("front", "back"), ("bottom", "top"))
    faces = {
        name: np.abs(middle[axis] - at[axis][end]) < NEAR * max(size)
        for axis, pair in enumerate(names)
        for end, name in zip((0, -1), pair, strict=True)
    }
    return BodyMesh(_with_faces(mesh, faces))


def hollow_cylinder(
    radii: tuple[float, float],
    height: float,
    cells: tuple[int, int, int],
    *,
    angles: tuple[float, float] = FULL_TURN,
    bottom: float = 0.0,
) -> BodyMesh:
    """Between two radii about z, over `angles` (rad) and z from `bottom` up to bottom + height (m).

    `cells` is (radial, around, along z). A shell, a thick-walled cylinder, a sector of one, or an annular plate. Faces:
    inner, outer, bottom, top, and of a sector start and end. Raises FilmInputError unless the sectors of the cells are
    below 120 degrees (the parabola through three points of an arc deviates by more than 1 % there).
    """
    turn = angles[1] - angles[0]
    _positive("ring", (radii[0], radii[1] - radii[0], height, turn), cells)
    if turn > 2.0 * np.pi * (1.0 + NEAR):
        raise FilmInputError("ring", f"angles over {np.rad2deg(turn):.6g} deg", "at most a full turn")
    if turn / cells[1] > 2.0 * np.pi / 3.0:
        raise FilmInputError("ring", f"{cells[1]} cells around", "cells of at most 120 deg each")
    closed = turn > 2.0 * np.pi * (1.0 - NEAR)
    around = cells[1]
    angle = np.linspace(*angles, around + 1)[: around if closed else None]
    radius = np.linspace(*radii, cells[0] + 1)
    points = np.vstack([np.outer(radius, np.cos(angle)).ravel(), np.outer(radius, np.sin(angle)).ravel()])
    i, j = (index.ravel() for index in np.meshgrid(np.arange(cells[0]), np.arange(around), indexing="ij"))
    lines, after = len(angle), (j + 1) % len(angle)
    quads = np.vstack([i * lines + j, (i + 1) * lines + j, (i + 1) * lines + after, i * lines + after])
    mesh = _extruded(points, quads, bottom + np.linspace(0.0, height, cells[2] + 1), arcs_from=0.5 * radii[0])
    faces = _round_faces(mesh, (bottom, bottom + height), {"inner": radii[0], "outer": radii[1]})
    if not closed:
        middle = _facet_middles(mesh)
        for name, side in zip(("start", "end"), angles, strict=True):
            across = middle[1] * np.cos(side) - middle[0] * np.sin(side)
            ahead = middle[0] * np.cos(side) + middle[1] * np.sin(side) > 0.0
            faces[name] = (np.abs(across) < NEAR * radii[1]) & ahead
    return BodyMesh(_with_faces(mesh, faces))


def disc(radius: float, height: float, cells: tuple[int, int, int], *, bottom: float = 0.0) -> BodyMesh:
    """A solid cylinder about z (m); faces outer, bottom, top.

    `cells` is (across the square core, rings around it, along z); a quarter of a ring has as many cells as the
    core is wide. The core is a rounded square of half the radius.
    """
    _positive("disc", (radius, height), cells)
    core, number = _core(0.5 * radius, cells[0])
    rim = np.concatenate([number[:-1, 0], number[-1, :-1], number[:0:-1, -1], number[0, :0:-1]])
    quarter = np.arctan(np.linspace(-1.0, 1.0, cells[0] + 1))[:-1]
    angle = np.concatenate([quarter + turn * np.pi / 2.0 for turn in (-1, 0, 1, 2)])
    edge = radius * np.vstack([np.cos(angle), np.sin(angle)])
    steps = np.arange(1, cells[1] + 1) / cells[1]
    points = np.hstack([core, *(core[:, rim] + step * (edge - core[:, rim]) for step in steps)])
    layers = [rim, *(core.shape[1] + k * len(rim) + np.arange(len(rim)) for k in range(cells[1]))]
    quads = [np.array([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]).reshape(4, -1)]
    quads += [np.vstack([low, high, np.roll(high, -1), np.roll(low, -1)]) for low, high in pairwise(layers)]
    heights = bottom + np.linspace(0.0, height, cells[2] + 1)
    mesh = _extruded(points, np.hstack(quads), heights, arcs_from=radius * (1.0 - 1e-6))
    return BodyMesh(_with_faces(mesh, _round_faces(mesh, (bottom, bottom + height), {"outer": radius})))


def _core(reach: float, cells: int) -> tuple[Array, NDArray[np.int64]]:
    """Points (2, n) of a square about the origin rounded half way to a circle, and their numbers on the grid.

    The rounding keeps the ring's cells at its corners from straight angles; a corner lies at `reach`.
    """
    x, y = np.meshgrid(*(np.linspace(-1.0, 1.0, cells + 1),) * 2, indexing="ij")
    longest = np.maximum(np.abs(x), np.abs(y))
    round_share = np.where(longest > 0.0, longest / np.maximum(np.hypot(x, y), NEAR), 1.0)
    scale = reach / (0.5 * (np.sqrt(2.0) + 1.0))
    points = scale * 0.5 * (1.0 + round_share) * np.array([x, y])
    return points.reshape(2, -1), np.arange(x.size).reshape(x.shape)


def section(radii: tuple[float, float], height: float, cells: tuple[int, int], *, bottom: float = 0.0) -> BodyMesh:
    """The (r, z) section of a body of revolution, cells = (radial, along z); faces inner, outer, bottom, top.

    An inner radius of zero is a solid body; its axis then is no face.
    """
    _positive("section", (radii[1] - radii[0], height), cells)
    if radii[0] < 0.0:
        raise FilmInputError("section", f"inner radius {radii[0]:.4g} m", "zero or more")
    z = bottom + np.linspace(0.0, height, cells[1] + 1)
    mesh = skfem.MeshQuad1.init_tensor(np.linspace(*radii, cells[0] + 1), z)
    middle = _facet_middles(mesh)
    near = NEAR * max(radii[1], height)
    faces = {
        "inner": np.abs(middle[0] - radii[0]) < near, "outer": np.abs(middle[0] - radii[1]) < near,
        "bottom": np.abs(middle[1] - z[0]) < near, "top": np.abs(middle[1] - z[-1]) < near,
    }  # fmt: skip
    if radii[0] == 0.0:
        del faces["inner"]
    return BodyMesh(_with_faces(mesh, faces), axisymmetric=True)


def _positive(what: str, sizes: tuple[float, ...], cells: tuple[int, ...]) -> None:
    if not all(np.isfinite(size) and size > 0.0 for size in sizes) or min(cells) < 1:
        raise FilmInputError(what, f"sizes {sizes} m, cells {cells}", "sizes above zero, one cell or more each way")


def _extruded(points: Array, quads: NDArray[np.int64], heights: Array, *, arcs_from: float) -> skfem.MeshHex2:
    """Hexahedra over a plane quadrilateral mesh; edges between points of one radius >= arcs_from are arcs."""
    layers, count = len(heights), points.shape[1]
    solid = np.vstack([np.tile(points, layers), np.repeat(heights, count)])
    low = (quads[:, None, :] + count * np.arange(layers - 1)[None, :, None]).reshape(4, -1)
    high = low + count
    # scikit-fem numbers the corners of the reference cube from (1, 1, 1) down to (0, 0, 0).
    corners = np.vstack([high[2], low[2], high[1], high[3], low[1], low[3], high[0], low[0]])
    mesh = skfem.MeshHex2.from_mesh(skfem.MeshHex1(solid, corners))
    places = mesh.doflocs.copy()
    radius = np.hypot(*mesh.p[:2])[mesh.edges]
    arc = (np.abs(radius[0] - radius[1]) < NEAR * radius.max()) & (radius[0] >= arcs_from)
    nodes = mesh.dofs.edge_dofs[0, arc]
    places[:2, nodes] *= radius[0, arc] / np.hypot(*places[:2, nodes])
    _fill_serendipity(mesh, places)
    return replace(mesh, doflocs=places)


def _fill_serendipity(mesh: skfem.MeshHex2, places: Array) -> None:
    """Middles of faces and cells half way between their edges, which alone are curved."""
    reference, cells = mesh.elem.refdom, mesh.dofs.element_dofs
    edge_of = {frozenset(pair): 8 + k for k, pair in enumerate(reference.edges)}
    for k, corners in enumerate(reference.facets):
        pairs = [frozenset(p) for p in zip(corners, [*corners[1:], corners[0]], strict=True)]
        edges = [edge_of[pair] for pair in pairs]
        places[:, cells[20 + k]] = 0.5 * places[:, cells[edges]].sum(axis=1) - 0.25 * places[:, cells[corners]].sum(
            axis=1
        )
    places[:, cells[26]] = 0.25 * (places[:, cells[8:20]].sum(axis=1) - places[:, cells[:8]].sum(axis=1))


def _facet_middles(mesh: skfem.Mesh) -> Array:
    return np.asarray(mesh.p[:, mesh.facets].mean(axis=1))


def _round_faces(
    mesh: skfem.Mesh, ends: tuple[float, float], radii: Mapping[str, float]
) -> dict[str, NDArray[np.bool_]]:
    """Facets on the flat ends, and those all of whose corners lie at a radius."""
    size = max(*radii.values(), ends[1] - ends[0])
    height = _facet_middles(mesh)[2]
    faces = {name: np.abs(height - at) < NEAR * size for name, at in zip(("bottom", "top"), ends, strict=True)}
    corner = np.hypot(*mesh.p[:2])[mesh.facets]
    return faces | {name: (np.abs(corner - r) < NEAR * size).all(axis=0) for name, r in radii.items()}


def _with_faces(mesh: skfem.Mesh, faces: Mapping[str, NDArray[np.bool_]]) -> skfem.Mesh:
    return replace(mesh, _boundaries={name: np.flatnonzero(on) for name, on in faces.items()})
