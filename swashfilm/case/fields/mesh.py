"""Mesh of a case file: a built-in shape, or a mesh file in the folder of the case."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property
from pathlib import Path
from typing import Annotated, ClassVar, Literal

from reynolds.errors import InputError
from reynolds.fem.mesh import Cell, FilmMesh, annulus, mesh_from_file, rectangle
from reynolds.fem.refine import refine_mesh
from reynolds.fem.seam import sewn
from swashfilm.case.fields.field import MeshData, mesh_data
from system.description.parts import MeshUnit
from system.inputs.sections.fields import FromFile, Length, Limits, Positive, Several
from system.inputs.units import Dimension, QuantityError, format_quantity

MOST_CELLS = 10_000_000  # about 10 GB of memory
FEWEST_AROUND = 3
Cells = Annotated[tuple[int, int], Several(2), Limits(least=1)]


class BuiltInShape(Enum):
    """The built-in meshes."""

    RECTANGLE = "rectangle"
    ANNULUS = "annulus"


class PeriodicDirection(Enum):
    """Direction in which a mesh is periodic."""

    NONE = "none"
    X = "x"
    Y = "y"


@dataclass(frozen=True)
class FileMesh:
    """Mesh and data of a mesh file."""

    path: Path
    film_mesh: FilmMesh
    data: MeshData

    @property
    def files(self) -> tuple[Path, ...]:
        """The file."""
        return (self.path,)

    def finer(self) -> FileMesh:
        """Return the mesh twice finer, with its data."""
        refined = refine_mesh(self.film_mesh)
        return FileMesh(self.path, refined.film_mesh, self.data.refined(refined))


def read_film_mesh(path: Path) -> FileMesh:
    """Return the mesh of a file; raise QuantityError for a file without a mesh."""
    try:
        film_mesh = mesh_from_file(path)
        return FileMesh(path, film_mesh, mesh_data(path, film_mesh))
    except InputError as reason:
        raise QuantityError(reason.found, reason.expected) from None


MeshOfFile = Annotated[FileMesh, FromFile(read_film_mesh)]


@dataclass(frozen=True, kw_only=True)
class FileMeshSection:
    """A mesh file with the unit of its coordinates, and its seam; its data are in SI."""

    file: MeshOfFile
    unit: MeshUnit = MeshUnit.METRE  # of its coordinates
    periodic: PeriodicDirection = PeriodicDirection.NONE  # its first and last edges along this axis are one seam

    def __post_init__(self) -> None:
        self._sewn()

    @property
    def data(self) -> MeshData:
        """Data of the file."""
        return self.file.data

    @property
    def files(self) -> tuple[Path, ...]:
        """The file."""
        return self.file.files

    @cached_property
    def film_mesh(self) -> FilmMesh:
        """The mesh, m."""
        own = self._sewn()
        return replace(own, mesh=replace(own.mesh, doflocs=self.unit.metres * own.mesh.doflocs))

    def _sewn(self) -> FilmMesh:
        """Return the mesh in the unit of its file; raise InputError where the sides of its seam do not match."""
        if self.periodic is PeriodicDirection.NONE:
            return self.file.film_mesh
        return sewn(self.file.film_mesh, 0 if self.periodic is PeriodicDirection.X else 1)

    def finer(self) -> FileMeshSection:
        """Return the mesh twice finer, with its data."""
        return replace(self, file=self.file.finer())


@dataclass(frozen=True, kw_only=True)
class RectangleSection:
    """A rectangle; its boundaries are left, right, bottom and top."""

    data: ClassVar[MeshData] = MeshData()
    files: ClassVar[tuple[Path, ...]] = ()

    kind: Literal[BuiltInShape.RECTANGLE]
    size: Annotated[tuple[float, float], Several(2), Dimension.LENGTH, Positive]  # along x and y
    origin: Annotated[tuple[float, float], Several(2), Dimension.LENGTH] = (0.0, 0.0)  # along x and y
    cells: Cells  # along x and y
    cell: Cell = Cell.TRIANGLE
    periodic: PeriodicDirection = PeriodicDirection.NONE

    def __post_init__(self) -> None:
        _check_count(self.cells)

    @cached_property
    def film_mesh(self) -> FilmMesh:
        """The mesh."""
        seams = {f"periodic_{way.value}": self.periodic is way for way in (PeriodicDirection.X, PeriodicDirection.Y)}
        return rectangle(self.size, self.cells, origin=self.origin, cell=self.cell, **seams)

    def finer(self) -> RectangleSection:
        """Return the mesh twice finer."""
        return replace(self, cells=(2 * self.cells[0], 2 * self.cells[1]))


@dataclass(frozen=True, kw_only=True)
class AnnulusSection:
    """A ring about the origin; its boundaries are inner and outer."""

    data: ClassVar[MeshData] = MeshData()
    files: ClassVar[tuple[Path, ...]] = ()

    kind: Literal[BuiltInShape.ANNULUS]
    inner_radius: Length
    outer_radius: Length
    cells: Cells  # across and around
    cell: Cell = Cell.QUADRILATERAL

    def __post_init__(self) -> None:
        _check_count(self.cells)
        if self.cells[1] < FEWEST_AROUND:
            raise InputError("cells", f"{self.cells[1]} cells around", f"at least {FEWEST_AROUND}")
        if self.inner_radius >= self.outer_radius:
            radii = self.inner_radius, self.outer_radius
            inner, outer = (format_quantity(radius, Dimension.LENGTH, digits=4) for radius in radii)
            raise InputError("outer_radius", outer, f"more than inner_radius, {inner}")

    @cached_property
    def film_mesh(self) -> FilmMesh:
        """The mesh."""
        return annulus(self.inner_radius, self.outer_radius, self.cells, cell=self.cell)

    def finer(self) -> AnnulusSection:
        """Return the mesh twice finer."""
        return replace(self, cells=(2 * self.cells[0], 2 * self.cells[1]))


CaseMesh = FileMesh | FileMeshSection | RectangleSection | AnnulusSection
MeshForm = MeshOfFile | FileMeshSection | RectangleSection | AnnulusSection


def _check_count(cells: tuple[int, int]) -> None:
    if cells[0] * cells[1] > MOST_CELLS:
        raise InputError("cells", f"{cells[0]} x {cells[1]} cells", f"at most {MOST_CELLS} cells in all")
