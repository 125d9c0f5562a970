"""Film meshes: plane triangles or quadrilaterals with named boundaries and periodic seams.

Boundary names are API. Built-in shapes: `rectangle` (left, right, bottom, top) and `annulus` (inner, outer).
A mesh from a file keeps its own names; other edges are named by their place.
"""

import contextlib
import io
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property
from operator import index
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np
import skfem
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from reynolds.errors import FilmInputError
from reynolds.fem.mesh_check import mesh_faults
from reynolds.numerics.arrays import Array
from reynolds.numerics.files import expect_regular, is_file

_Number = TypeVar("_Number", int, float)
FLAT = 1e-9
"""Largest height of a plane mesh, of its extent."""


class Cell(Enum):
    """Shape of a film element."""

    TRIANGLE = "triangle"
    QUADRILATERAL = "quadrilateral"


@dataclass(frozen=True)
class FilmMesh:
    """A plane film mesh (metres) and the pairs of boundaries that are one seam.

    `mesh` is a scikit-fem MeshTri or MeshQuad with named boundaries; each seam names two boundaries that a
    translation maps onto each other (periodic film: pressure and flow continue across).
    """

    mesh: skfem.Mesh
    seams: tuple[tuple[str, str], ...] = ()

    @property
    def boundary_names(self) -> tuple[str, ...]:
        """Names that may carry a boundary condition, sorted; a seam's two sides are not among them."""
        sewn = {name for pair in self.seams for name in pair}
        return tuple(sorted(set(self.mesh.boundaries or {}) - sewn))

    @cached_property
    def sharing(self) -> dict[str, frozenset[str]]:
        """Boundaries that share edges with each boundary, by its name."""
        boundaries = self.mesh.boundaries or {}
        return {
            name: frozenset(other for other, theirs in boundaries.items() if np.intersect1d(edges, theirs).size)
            for name, edges in boundaries.items()
        }


def rectangle(
    size: tuple[float, float],
    cells: tuple[int, int],
    *,
    origin: tuple[float, float] = (0.0, 0.0),
    cell: Cell = Cell.TRIANGLE,
    periodic_x: bool = False,
    periodic_y: bool = False,
) -> FilmMesh:
    """A regular nx x ny mesh of [x0, x0+Lx] x [y0, y0+Ly] with boundaries left, right, bottom, top (m).

    Raises FilmInputError for a size that is not positive, for cells that are no whole numbers, at least one each way,
    and for a cell that is no `Cell`.
    """
    size = _pair("rectangle, size", size, float, "two lengths, along x and y")
    cells = _pair("rectangle, cells", cells, index, "two whole numbers, along x and y")
    _check_cell("rectangle, cell", cell)
    if not all(0.0 < length < np.inf for length in size):
        raise FilmInputError("rectangle, size", f"{size[0]:g} x {size[1]:g} m", "positive lengths")
    if min(cells) < 1:
        raise FilmInputError("rectangle, cells", f"{cells[0]} x {cells[1]}", "at least one each way")
    x = origin[0] + np.linspace(0.0, size[0], cells[0] + 1)
    y = origin[1] + np.linspace(0.0, size[1], cells[1] + 1)
    mesh = MESH_CLASSES[cell].init_tensor(x, y)
    lowest, highest = mesh.p.min(axis=1), mesh.p.max(axis=1)
    midpoint = mesh.p[:, mesh.facets].mean(axis=1)
    near = 1e-9 * np.max(highest - lowest)
    sides = {
        "left": np.abs(midpoint[0] - lowest[0]) < near,
        "right": np.abs(midpoint[0] - highest[0]) < near,
        "bottom": np.abs(midpoint[1] - lowest[1]) < near,
        "top": np.abs(midpoint[1] - highest[1]) < near,
    }
    seams = ((("left", "right"),) if periodic_x else ()) + ((("bottom", "top"),) if periodic_y else ())
    return FilmMesh(_named(mesh, {name: np.flatnonzero(on) for name, on in sides.items()}), seams)


def _pair(where: str, given: object, number: Callable[[Any], _Number], expected: str) -> tuple[_Number, _Number]:
    """Two numbers; raises FilmInputError for anything else."""
    try:
        first, second = (number(one) for one in cast(Iterable[Any], given))
    except (TypeError, ValueError):
        raise FilmInputError(where, repr(given), expected) from None
    return first, second


def _check_cell(where: str, cell: object) -> None:
    if not isinstance(cell, Cell):
        raise FilmInputError(where, repr(cell), " or ".join(map(str, Cell)))


def annulus(
    inner_radius: float, outer_radius: float, cells: tuple[int, int], *, cell: Cell = Cell.QUADRILATERAL
) -> FilmMesh:
    """A full ring about the origin, cells = (radial, circumferential), boundaries inner and outer (m).

    Raises FilmInputError as `ring`, and where there is no radial cell.
    """
    cells = _pair("ring, cells", cells, index, "two whole numbers, radial and around")
    inner_radius, outer_radius = _pair("ring, radii", (inner_radius, outer_radius), float, "two lengths")
    if cells[0] < 1:
        raise FilmInputError("ring, radial cells", f"{cells[0]}", "at least one")
    return ring(np.linspace(inner_radius, outer_radius, cells[0] + 1), cells[1], cell=cell)


def ring(
    radii: Array, around: int, *, cell: Cell = Cell.QUADRILATERAL, keep: NDArray[np.bool_] | None = None
) -> FilmMesh:
    """A full ring with given radial lines (m) and `around` equal sectors; boundaries inner and outer.

    `keep` (radial cells x sectors) leaves cells out: each hole that arises is a boundary of its own, named
    hole_0, hole_1, ... in the order of the angle of its centre. Raises FilmInputError for radii that do not rise
    from above zero and for fewer than three sectors.
    """
    if not (radii[0] > 0.0 and np.isfinite(radii).all() and (np.diff(radii) > 0.0).all()):
        raise FilmInputError("ring, radii", f"{radii[0]:g} .. {radii[-1]:g} m", "rising, from above zero")
    _check_cell("ring, cell", cell)
    if around < 3:
        raise FilmInputError("ring, sectors", f"{around}", "at least three")
    radial = len(radii) - 1
    angle = 2.0 * np.pi * np.arange(around) / around
    points = np.vstack([np.outer(radii, np.cos(angle)).ravel(), np.outer(radii, np.sin(angle)).ravel()])
    kept = np.ones((radial, around), dtype=bool) if keep is None else keep
    i, j = np.nonzero(kept)
    after = (j + 1) % around
    quads = np.vstack([i * around + j, (i + 1) * around + j, (i + 1) * around + after, i * around + after])
    used, quads = np.unique(quads, return_inverse=True)
    mesh = skfem.MeshQuad(np.ascontiguousarray(points[:, used]), quads.reshape(4, -1))
    if cell is Cell.TRIANGLE:
        mesh = mesh.to_meshtri()
    return FilmMesh(_named(mesh, loop_names(mesh)))


def mesh_from_file(path: Path) -> FilmMesh:
    """The film mesh of any meshio file: triangles or quadrilaterals in a plane of constant z (metres).

    Names come from gmsh physical groups or scikit-fem tags; edges lying on the bounding box are named left,
    right, bottom, top, and closed edge loops outer, inner (or hole_0, ... if several), where the file has not
    given that name to something else. Raises FilmInputError for a file that is absent or holds no such mesh,
    and for invalid cells (`mesh_check`).
    """
    if not is_file(path):
        raise FilmInputError("mesh", f"no file {path}", "an existing mesh file in a format that meshio reads")
    from skfem.io.meshio import from_meshio

    raw = read_mesh_file(path)
    kinds = {block.type for block in raw.cells}
    if not kinds & {"triangle", "quad"}:
        curved = any(kind.startswith(("triangle", "quad")) for kind in kinds)
        hint = " of straight edges (gmsh: Mesh.ElementOrder = 1)" if curved else ""
        raise FilmInputError("mesh", f"{path} holds {', '.join(sorted(kinds))}", f"triangle or quad cells{hint}")
    if {"triangle", "quad"} <= kinds:
        raise FilmInputError("mesh", f"{path} mixes triangles and quads", "one kind of cell")
    if raw.points.shape[1] == 3:
        if fault := _plane_fault(np.asarray(raw.points, dtype=float)):
            raise FilmInputError("mesh", f"{path} {fault}", "a film in the plane of x and y, z constant")
        raw.points = np.ascontiguousarray(raw.points[:, :2])
    cells = np.concatenate([block.data for block in raw.cells if block.type in ("triangle", "quad")])
    if faults := mesh_faults(raw.points[:, :2], cells):
        raise FilmInputError("mesh", f"{path}: {'; '.join(faults)}", "cells side by side that share their points")
    mesh = from_meshio(raw)
    own = {name: np.asarray(facets) for name, facets in (mesh.boundaries or {}).items()}
    if raw.field_data and "gmsh:physical" in raw.cell_data and not raw.cell_sets:
        own = _physical_lines(raw, mesh)
    return FilmMesh(_named(mesh, {**box_names(mesh), **loop_names(mesh), **own}))


def _plane_fault(points: Array) -> str:
    """Reason why points (n, 3) do not lie in a plane of constant z; empty if they do."""
    spans = np.ptp(points, axis=0)
    near = FLAT * spans.max()
    if not spans[2] > near:  # points without coordinates are told by `mesh_faults`
        return ""
    for normal, axis in enumerate("xy"):
        if spans[normal] <= near:
            return f"lies in a plane of constant {axis}, that of {'yz' if axis == 'x' else 'xz'}: turn it"
    away = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return "lies in a tilted plane (z varies): turn it" if away[2] <= near else "is not plane (z varies)"


def _physical_lines(raw: Any, mesh: skfem.Mesh) -> dict[str, NDArray[np.int64]]:
    """Facets of each named physical line of a gmsh 2.2 file, inner ones too.

    scikit-fem reads these files by tag alone; gmsh counts the tags of lines and of surfaces apart.
    """
    names = {int(tag): name for name, (tag, dimension) in raw.field_data.items() if dimension == 1}
    facet_of = {tuple(ends): number for number, ends in enumerate(np.sort(mesh.facets.T, axis=1).tolist())}
    found: dict[str, list[int]] = {}
    blocks = zip(raw.cells, raw.cell_data["gmsh:physical"], strict=True)
    for block, tags in ((block, tags) for block, tags in blocks if block.type == "line"):
        for ends, tag in zip(np.sort(block.data, axis=1).tolist(), tags, strict=True):
            if int(tag) in names and tuple(ends) in facet_of:
                found.setdefault(names[int(tag)], []).append(facet_of[tuple(ends)])
    return {name: np.unique(facets) for name, facets in found.items()}


def read_mesh_file(path: Path) -> Any:
    """The meshio.Mesh of a file, as it is; raises FilmInputError for one that cannot be read, and prints nothing.

    Readers of meshio that print, exit, or fail inside a format raise the same error.
    """
    import meshio

    said = io.StringIO()
    try:
        expect_regular(path)
        if path.stat().st_size == 0:  # some readers wait indefinitely for a line
            raise FilmInputError("mesh", f"{path} is empty", "a file that meshio reads")
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            return meshio.read(path)
    except FilmInputError:
        raise
    except (Exception, SystemExit) as fault:  # of a broken file, or for want of a package
        reason = " ".join(said.getvalue().split()) or str(fault) or type(fault).__name__
        raise FilmInputError("mesh", f"{path} cannot be read ({reason})", "a file that meshio reads") from fault


def box_names(mesh: skfem.Mesh) -> dict[str, NDArray[np.int64]]:
    """Boundary facets that lie on a side of the bounding box, by side: left, right, bottom, top."""
    facets = mesh.boundary_facets()
    ends = mesh.p[:, mesh.facets[:, facets]]
    lowest, highest = mesh.p.min(axis=1), mesh.p.max(axis=1)
    near = 1e-9 * np.max(highest - lowest)
    found = {}
    for name, axis, at in (
        ("left", 0, lowest[0]), ("right", 0, highest[0]), ("bottom", 1, lowest[1]), ("top", 1, highest[1]),
    ):  # fmt: skip
        on = (np.abs(ends[axis] - at) < near).all(axis=0)
        if on.any():
            found[name] = facets[on]
    return found


def loop_names(mesh: skfem.Mesh) -> dict[str, NDArray[np.int64]]:
    """Closed boundary loops: outer (the longest reach), inner if there is one more, else inner and hole_k.

    The inner loop is the one around the origin, if any; other holes are numbered by the angle
    of their centre, from the x axis on.
    """
    facets = mesh.boundary_facets()
    ends = mesh.facets[:, facets]
    graph = coo_array((np.ones(ends.shape[1]), (ends[0], ends[1])), shape=(mesh.nvertices,) * 2)
    label = connected_components(graph, directed=False)[1][ends[0]]
    loops = [facets[label == k] for k in np.unique(label)]
    reach = [np.ptp(mesh.p[0, mesh.facets[:, loop]]) + np.ptp(mesh.p[1, mesh.facets[:, loop]]) for loop in loops]
    named = {"outer": loops.pop(int(np.argmax(reach)))}
    middle = mesh.p[:, mesh.facets[:, named["outer"]]].mean(axis=(1, 2))
    centre = [mesh.p[:, mesh.facets[:, loop]].mean(axis=(1, 2)) - middle for loop in loops]
    scale = max(reach)
    if loops and (len(loops) == 1 or min(map(np.linalg.norm, centre)) < 1e-6 * scale):
        k = int(np.argmin([np.linalg.norm(c) for c in centre]))
        named["inner"] = loops.pop(k)
        centre.pop(k)
    order = np.argsort([(np.arctan2(c[1], c[0]) + 1e-9) % (2.0 * np.pi) for c in centre])
    return named | {f"hole_{n}": loops[k] for n, k in enumerate(order)}


def rename(film_mesh: FilmMesh, names: Mapping[str, str]) -> FilmMesh:
    """The same mesh with boundaries renamed old -> new."""
    boundaries = {names.get(name, name): facets for name, facets in film_mesh.mesh.boundaries.items()}
    return replace(film_mesh, mesh=_named(film_mesh.mesh, boundaries))


def _named(mesh: skfem.Mesh, boundaries: Mapping[str, NDArray[np.int64]]) -> skfem.Mesh:
    return replace(mesh, _boundaries=dict(boundaries))


MESH_CLASSES = {Cell.TRIANGLE: skfem.MeshTri, Cell.QUADRILATERAL: skfem.MeshQuad}
