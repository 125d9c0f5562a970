"""Body meshes from files: any meshio format with hexahedra or tetrahedra and named faces."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import skfem
from numpy.typing import NDArray

from reynolds.bodies.mesh import BodyMesh
from reynolds.errors import FilmInputError
from reynolds.fem.mesh import read_mesh_file
from reynolds.numerics.files import is_file

SOLID = ("hexahedron27", "hexahedron", "tetra10", "tetra")
SURFACE = {"hexahedron27": ("quad9", "quad"), "hexahedron": ("quad",), "tetra10": ("triangle6", "triangle"),
           "tetra": ("triangle",)}  # fmt: skip
CORNERS = {"quad9": 4, "quad": 4, "triangle6": 3, "triangle": 3}


def body_from_file(path: Path, unit: float = 1.0) -> BodyMesh:
    """The body of a mesh file whose length unit is `unit` (m): one kind of hexahedra (8 or 27 nodes) or tetrahedra (4
    or 10 nodes).

    Faces are the named surfaces of the file, cells of triangles or quadrilaterals: gmsh physical surfaces, cell sets,
    or, as in VTU, cell data that is one on a face and zero elsewhere. Displacements are quadratic for any geometry of
    the file. Raises FilmInputError for a file that is absent, holds no such cells or mixes them, or names no face.
    """
    if not is_file(path):
        raise FilmInputError("body mesh", f"no file {path}", "an existing mesh file in a format that meshio reads")
    from skfem.io.meshio import from_meshio

    raw = read_mesh_file(path)
    kinds = [kind for kind in SOLID if kind in raw.cells_dict]
    if len(kinds) != 1:
        found = f"{path} holds {', '.join(sorted({block.type for block in raw.cells}))}"
        raise FilmInputError("body mesh", found, f"one of {', '.join(SOLID)}")
    kind = kinds[0]
    named = _surfaces(raw, SURFACE[kind])
    if not named:
        raise FilmInputError("body mesh", f"{path} names no faces", "named surfaces (gmsh: Physical Surface)")
    raw.cell_sets, raw.cell_data = {}, {}
    raw.points = unit * np.asarray(raw.points, dtype=float)
    mesh = from_meshio(raw, force_meshio_type=kind)
    return BodyMesh(replace(mesh, _boundaries=_facets(mesh, named), _subdomains=None))


def _surfaces(raw: Any, kinds: tuple[str, ...]) -> dict[str, list[NDArray[np.int64]]]:
    """Corner points of the cells of each named surface: (cells, corners) arrays by name."""
    found: dict[str, list[NDArray[np.int64]]] = {}
    for name, members in raw.cell_sets.items():
        for block, chosen in zip(raw.cells, members, strict=True):
            if block.type in kinds and chosen is not None and len(chosen) and not name.startswith("gmsh:"):
                found.setdefault(name, []).append(block.data[np.asarray(chosen, dtype=int), : CORNERS[block.type]])
    for name, marks in raw.cell_data.items():
        if ":" not in name and all(_is_mark(part) for part in marks):
            for block, part in zip(raw.cells, marks, strict=True):
                if block.type in kinds and np.any(part):
                    found.setdefault(name, []).append(block.data[np.asarray(part) == 1, : CORNERS[block.type]])
    if found or "gmsh:physical" not in raw.cell_data:
        return found
    # gmsh 2.2 tells names by tag and dimension; tags of lines and surfaces are counted apart.
    names = {int(tag): name for name, (tag, dimension) in raw.field_data.items() if dimension == 2}
    for block, tags in zip(raw.cells, raw.cell_data["gmsh:physical"], strict=True):
        if block.type in kinds:
            for tag in np.unique(tags).tolist():
                if tag in names:
                    found.setdefault(names[tag], []).append(block.data[tags == tag][:, : CORNERS[block.type]])
    return found


def _is_mark(data: NDArray[np.generic]) -> bool:
    """True for whole numbers of zero and one, one a cell."""
    return data.ndim == 1 and data.dtype.kind in "iub" and bool(np.isin(data, (0, 1)).all())


def _facets(mesh: skfem.Mesh, named: dict[str, list[NDArray[np.int64]]]) -> dict[str, NDArray[np.int64]]:
    """Facet numbers of named surface cells; raises FilmInputError for cells that are no facet of the body."""
    number = {tuple(corners): k for k, corners in enumerate(np.sort(mesh.facets.T, axis=1).tolist())}
    faces = {}
    for name, parts in named.items():
        wanted = [tuple(corners) for part in parts for corners in np.sort(part, axis=1).tolist()]
        if lost := sum(corners not in number for corners in wanted):
            raise FilmInputError(f"body face {name}", f"{lost} cells that no solid cell has", "facets of the body")
        faces[name] = np.unique([number[corners] for corners in wanted])
    return faces
