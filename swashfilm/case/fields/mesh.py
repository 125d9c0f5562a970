"""Mesh of a case file: a built-in shape, or a mesh file in the folder of the case."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from reynolds.errors import InputError
from reynolds.fem.mesh import Cell, FilmMesh, annulus, mesh_from_file, rectangle
from reynolds.fem.refine import refine_mesh
from swashfilm.case.fields.field import MeshData, mesh_data
from system.inputs.toml_table import Table, quoted
from system.inputs.units import Dimension, format_quantity

MESH_FILE = "the path of a mesh file in a format that meshio reads"
MOST_CELLS = 10_000_000  # about 10 GB of memory
Cells = tuple[int, int]


class BuiltInShape(Enum):
    """The built-in meshes."""

    RECTANGLE = "rectangle"
    ANNULUS = "annulus"


class PeriodicDirection(Enum):
    """Direction in which a rectangle is periodic."""

    NONE = "none"
    X = "x"
    Y = "y"


@dataclass(frozen=True)
class CaseMesh:
    """A mesh, its file's data, its entry in a case file, and a function that returns it twice finer."""

    film_mesh: FilmMesh
    data: MeshData
    text: str
    finer: Callable[[], CaseMesh]


def read_mesh(film: Table, folder: Path) -> CaseMesh | None:
    """Return the mesh of a [film] table; None with its faults listed. Paths are relative to `folder`."""
    raw = film.get("mesh")
    if isinstance(raw, str):
        return _from_file(film, folder)
    if isinstance(raw, dict):
        table = Table(film.name("mesh"), raw, film.faults)
        shape = table.choice("kind", BuiltInShape)
        built = {BuiltInShape.RECTANGLE: _rectangle, BuiltInShape.ANNULUS: _annulus}[shape](table) if shape else None
        if shape:
            table.close()
        return built
    found = "missing" if raw is None else repr(raw)
    film.fault("mesh", found, 'the path of a mesh file, or a table such as { kind = "rectangle", ... }')
    return None


def _from_file(film: Table, folder: Path) -> CaseMesh | None:
    path = film.file("mesh", folder, MESH_FILE)
    if path is None:
        return None
    try:
        film_mesh = mesh_from_file(path)
        data = mesh_data(path, film_mesh)
    except InputError as reason:
        film.fault("mesh", reason.found, reason.expected)
        return None
    return _of_file(film_mesh, data, quoted(str(path.resolve())))


def _of_file(film_mesh: FilmMesh, data: MeshData, text: str) -> CaseMesh:
    def finer() -> CaseMesh:
        refined = refine_mesh(film_mesh)
        return _of_file(refined.film_mesh, data.refined(refined), text)

    return CaseMesh(film_mesh, data, text, finer)


def _built_in(build: Callable[[Cells], FilmMesh], text: Callable[[Cells], str], cells: Cells) -> CaseMesh:
    def finer() -> CaseMesh:
        return _built_in(build, text, (2 * cells[0], 2 * cells[1]))

    return CaseMesh(build(cells), MeshData(), text(cells), finer)


def _rectangle(table: Table) -> CaseMesh | None:
    size = table.pair("size", Dimension.LENGTH)
    origin = table.pair("origin", Dimension.LENGTH, (0.0, 0.0))
    cells = _cells(table)
    cell = table.choice("cell", Cell, Cell.TRIANGLE)
    periodic = table.choice("periodic", PeriodicDirection, PeriodicDirection.NONE)
    if size is not None and min(size) <= 0.0:
        table.fault("size", str(table.values["size"]), "two lengths above zero")
        return None
    if size is None or origin is None or cells is None or cell is None or periodic is None:
        return None
    seams = {f"periodic_{way.value}": periodic is way for way in (PeriodicDirection.X, PeriodicDirection.Y)}
    return _built_in(
        lambda count: rectangle(size, count, origin=origin, cell=cell, **seams),
        lambda count: (
            f'{{ kind = "rectangle", size = [{_length(size[0])}, {_length(size[1])}], '
            f"origin = [{_length(origin[0])}, {_length(origin[1])}], cells = {list(count)}, "
            f'cell = "{cell.value}", periodic = "{periodic.value}" }}'
        ),
        cells,
    )


def _annulus(table: Table) -> CaseMesh | None:
    inner = table.positive("inner_radius", Dimension.LENGTH)
    outer = table.positive("outer_radius", Dimension.LENGTH)
    cells = _cells(table, least_around=3)
    cell = table.choice("cell", Cell, Cell.QUADRILATERAL)
    if inner is None or outer is None or cells is None or cell is None:
        return None
    if inner >= outer:
        table.fault(
            "outer_radius",
            str(table.values["outer_radius"]),
            f"more than inner_radius, {format_quantity(inner, Dimension.LENGTH, digits=4)}",
        )
        return None
    return _built_in(
        lambda count: annulus(inner, outer, count, cell=cell),
        lambda count: (
            f'{{ kind = "annulus", inner_radius = {_length(inner)}, outer_radius = {_length(outer)}, '
            f'cells = {list(count)}, cell = "{cell.value}" }}'
        ),
        cells,
    )


def _cells(table: Table, least_around: int = 1) -> Cells | None:
    raw = table.get("cells")
    wanted = f"two whole numbers from 1 on (the second from {least_around}), such as [24, 96]"
    if not isinstance(raw, list) or len(raw) != 2 or any(type(count) is not int for count in raw):
        table.fault("cells", "missing" if raw is None else repr(raw), wanted)
        return None
    first, second = raw
    if first < 1 or second < least_around:
        table.fault("cells", repr(raw), wanted)
        return None
    if first * second > MOST_CELLS:
        table.fault("cells", f"{first} x {second} cells", f"at most {MOST_CELLS} cells in all")
        return None
    return first, second


def _length(value: float) -> str:
    return quoted(format_quantity(value, Dimension.LENGTH))
