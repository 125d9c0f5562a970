"""Fields of a case file: a quantity, a formula of x, y and t, or data of the mesh file."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from reynolds.fem.mesh import FilmMesh, read_mesh_file
from reynolds.fem.refine import RefinedMesh
from reynolds.fem.space import FilmSpace
from reynolds.numerics.arrays import Array
from swashfilm.case.fields.expressions import (
    CONSTANTS,
    FUNCTIONS,
    IN_TIME,
    NO_CONSTANTS,
    PLACE,
    Expression,
    ExpressionError,
    parse_expression,
)
from system.inputs.faults import nearest_choice
from system.inputs.units import Dimension, QuantityError, format_quantity, parse_quantity, with_point

_WITH_UNIT = re.compile(r"[+-]?(?>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*[A-Za-zµμ°].*")
_NAME = re.compile(r"[^\W\d]\w*")
_UNIT = re.compile(r"(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s+([^\W\d]\w*)")
"""A number, and the name behind it."""
_WORDS = ("and", "or", "not", "if", "else")


@dataclass(frozen=True)
class MeshData:
    """Scalar data of a mesh file by name: at points (vertices,) and in cells (cells,), in SI units.

    unfit: names of data of several numbers each, or of none.
    """

    point: Mapping[str, Array] = field(default_factory=dict)
    cell: Mapping[str, Array] = field(default_factory=dict)
    unfit: tuple[str, ...] = ()

    def refined(self, finer: RefinedMesh) -> MeshData:
        """Return the same data on a finer mesh: interpolated at points, inherited by cells."""
        return MeshData(
            {name: finer.point_data(values) for name, values in self.point.items()},
            {name: finer.cell_data(values) for name, values in self.cell.items()},
        )


@dataclass(frozen=True)
class Uniform:
    """The same value everywhere, SI."""

    value: float
    dimension: Dimension

    def sample(self, space: FilmSpace, t: float = 0.0) -> Array:
        """Return the value, (1, 1)."""
        return space.sample(self.value)

    def at_vertices(self, space: FilmSpace, t: float = 0.0) -> Array | None:
        """Return the value, (vertices,)."""
        return np.full(len(space.vertices), self.value)

    def at_time(self, t: float) -> float:
        """Return the value at any time."""
        return self.value

    def on(self, data: MeshData) -> Uniform:
        """Return the same field, valid on any mesh."""
        return self

    def __str__(self) -> str:
        """Return the entry of a case file."""
        return format_quantity(self.value, self.dimension)


@dataclass(frozen=True)
class Formula:
    """A formula of x, y and t, SI; a jump is exact along cell edges and smoothed over a cell that it crosses."""

    expression: Expression

    def sample(self, space: FilmSpace, t: float = 0.0) -> Array:
        """Return the values at the quadrature points, (cells, points)."""
        return space.sample_ruled(lambda x, y: self.expression(x, y, t))

    def at_vertices(self, space: FilmSpace, t: float = 0.0) -> Array | None:
        """Return the values at the vertices, (vertices,)."""
        x, y = space.vertices.T
        return self.expression(x, y, t)

    def at_time(self, t: float) -> float:
        """Return the value at a time (s) of a formula without position."""
        return float(self.expression(np.zeros(1), np.zeros(1), t)[0])

    def on(self, data: MeshData) -> Formula:
        """Return the same field, valid on any mesh."""
        return self

    def __str__(self) -> str:
        """Return the entry of a case file."""
        return self.expression.text


@dataclass(frozen=True)
class PointData:
    """Continuous data of the mesh file's points, SI."""

    name: str
    values: Array = field(repr=False)

    def sample(self, space: FilmSpace, t: float = 0.0) -> Array:
        """Return the values interpolated to the quadrature points, (cells, points)."""
        return space.sample_vertices(self.values)

    def at_vertices(self, space: FilmSpace, t: float = 0.0) -> Array | None:
        """Return the file's values, (vertices,)."""
        return self.values

    def on(self, data: MeshData) -> PointData:
        """Return the data of the same name on another mesh."""
        return PointData(self.name, data.point[self.name])

    def __str__(self) -> str:
        """Return the entry of a case file."""
        return self.name


@dataclass(frozen=True)
class CellData:
    """Data of the mesh file's cells, discontinuous between cells, SI."""

    name: str
    values: Array = field(repr=False)

    def sample(self, space: FilmSpace, t: float = 0.0) -> Array:
        """Return the values, (cells, 1)."""
        return space.sample_cells(self.values)

    def at_vertices(self, space: FilmSpace, t: float = 0.0) -> Array | None:
        """Return None: the value is not unique where cells meet."""
        return None

    def on(self, data: MeshData) -> CellData:
        """Return the data of the same name on another mesh."""
        return CellData(self.name, data.cell[self.name])

    def __str__(self) -> str:
        """Return the entry of a case file."""
        return self.name


Field = Uniform | Formula | PointData | CellData
InTime = Uniform | Formula


def read_field(
    raw: object,
    dimension: Dimension,
    data: MeshData,
    variables: Sequence[str] = PLACE,
    constants: Mapping[str, float] = NO_CONSTANTS,
) -> Field:
    """Return the field of an entry of a case file.

    A number with a unit is a quantity, a name of data of the mesh file selects these data, any other text is a
    formula of `variables` and `constants` with its value in the SI unit of `dimension`. Raises QuantityError.
    """
    expected = (
        f"{dimension.noun} with its unit, such as '{dimension.example}', a formula of "
        f"{', '.join(variables) or 'constants'} in "
        f"{dimension.si_unit} (text in quotes), or the name of data in the mesh file"
    )
    if isinstance(raw, bool) or not isinstance(raw, str):
        raise QuantityError(repr(raw), expected, _quantity_meant(raw, dimension))
    text = raw.strip()
    if not text:
        raise QuantityError("empty text", expected)
    meanings = [
        what
        for what, names in (
            ("point data of the mesh file", data.point),
            ("cell data of the mesh file", data.cell),
            ("a constant", constants),
        )
        if text in names
    ]
    if len(meanings) > 1:
        raise QuantityError(f"'{text}', which is {' and '.join(meanings)}", "a unique name", "rename one")
    if text in data.point:
        return PointData(text, data.point[text])
    if text in data.cell:
        return CellData(text, data.cell[text])
    if _WITH_UNIT.fullmatch(text):
        try:
            return Uniform(parse_quantity(text, dimension), dimension)
        except QuantityError:
            _refuse_units(text, dimension, (*variables, *constants))
            raise
    if may_be_data(text) and text not in constants:
        raise _no_such_data(text, data, constants)
    try:
        return Formula(parse_expression(text, variables, constants))
    except ExpressionError as reason:
        _refuse_units(text, dimension, (*variables, *constants))
        _refuse_data(text, data)
        raise QuantityError(reason.found, reason.expected, reason.nearest or with_point(text)) from None


def _quantity_meant(raw: object, dimension: Dimension) -> str:
    """Return a bare number with the unit that it may lack; empty for anything else."""
    if isinstance(raw, bool) or not isinstance(raw, (int, float)):
        return ""
    try:
        parse_quantity(raw, dimension)
    except QuantityError as reason:
        return reason.nearest.replace("'", '"')  # as a case file has it
    return ""


def _refuse_data(text: str, data: MeshData) -> None:
    """Raise QuantityError for a formula of data of the mesh file."""
    for name in _NAME.findall(text):
        if name in (*data.point, *data.cell):
            found = f"'{text}', a formula of {name}, which is data of the mesh file"
            raise QuantityError(found, "a formula without it, or its name alone: other data belong into the file", name)


def _refuse_units(text: str, dimension: Dimension, names: Sequence[str]) -> None:
    """Raise QuantityError for a formula, of names or of several numbers, with a unit behind a number."""
    units = [match[1] for match in _UNIT.finditer(text) if match[1] not in (*names, *_WORDS)]
    others = {*_NAME.findall(_UNIT.sub(" ", text))} & {*names, *CONSTANTS, *FUNCTIONS}
    if units and (others or len(units) > 1):
        found = f"'{text}', a formula with the unit {units[0]}"
        raise QuantityError(found, f"a formula in SI without units, its value in {dimension.si_unit}")


def may_be_data(raw: object) -> bool:
    """Return True for a text that can only be the name of data in a mesh file."""
    return isinstance(raw, str) and bool(_NAME.fullmatch(raw.strip())) and raw.strip() not in (*IN_TIME, *CONSTANTS)


def mesh_data(path: Path, film_mesh: FilmMesh) -> MeshData:
    """Return the scalar data of a mesh file that `reynolds.fem.mesh.mesh_from_file` has read."""
    raw = read_mesh_file(path)
    mesh = film_mesh.mesh
    kind = "triangle" if mesh.t.shape[0] == 3 else "quad"
    blocks = [index for index, block in enumerate(raw.cells) if block.type == kind]
    cells = {name: np.concatenate([parts[index] for index in blocks]) for name, parts in raw.cell_data.items()}
    point, cell = (
        {name: scalar for name, values in of.items() if (scalar := _scalar(values)) is not None}
        for of in (raw.point_data, cells)
    )
    return MeshData(point, cell, tuple(sorted({*raw.point_data, *cells} - {*point, *cell})))


def _scalar(values: Array) -> Array | None:
    flat = np.asarray(values)
    if flat.ndim == 2 and flat.shape[1] == 1:
        flat = flat[:, 0]
    return flat.astype(float) if flat.ndim == 1 and np.issubdtype(flat.dtype, np.number) else None


def _no_such_data(name: str, data: MeshData, constants: Mapping[str, float]) -> QuantityError:
    if name in data.unfit:
        found = f"'{name}', data of the mesh file that are not one number a point or cell"
        return QuantityError(found, "data of one number each, such as a component under a name of its own")
    names = [*data.point, *data.cell]
    known = (*PLACE, *CONSTANTS, *constants)
    if not names:
        return QuantityError(
            f"unknown name {name}",
            f"{', '.join(known)}, or data of the mesh (this mesh has none)",
            nearest_choice(name, list(constants)),
        )
    return QuantityError(
        f"'{name}', which the data of the mesh file do not contain",
        f"point data ({', '.join(data.point) or 'none'}) or cell data ({', '.join(data.cell) or 'none'}) of it",
        nearest_choice(name, [*names, *constants]),
    )
