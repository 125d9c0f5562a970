"""Bodies of a case's [elastic] table under the film: meshed by name and sizes, or read from a mesh file."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from reynolds.bodies.chart import Chart, Cylinder, Plane, Side
from reynolds.bodies.elasticity import Elastic
from reynolds.bodies.mesh import BodyMesh, block, disc, hollow_cylinder
from reynolds.bodies.mesh_file import body_from_file
from reynolds.bodies.supports import Supports
from reynolds.bodies.wall import Body
from reynolds.errors import InputError
from reynolds.numerics.arrays import Array
from system.description.parts import MeshUnit
from system.inputs.sections.fields import Elasticity, FaceName, FaceNames, Length, Limits, Several, Text
from system.inputs.units import Dimension, format_quantity

UPWARDS: Chart = Plane((0.0, 0.0, 1.0))
Cells = Annotated[tuple[int, int, int], Several(3), Limits(least=1)]


class BodyKind(Enum):
    """Bodies with a name and sizes.

    Under a plane film: plate (the film's own rectangle), disc, ring, about the origin. Of a film unrolled from a
    cylinder, x around and y along it: bush (the film within) and shaft (the film outside).
    """

    HALF_SPACE = "half_space"
    PLATE = "plate"
    DISC = "disc"
    RING = "ring"
    BUSH = "bush"
    SHAFT = "shaft"


class Support(Enum):
    """Faces of a body that are held."""

    BOTTOM = "bottom"
    EDGE = "edge"
    BACK = "back"
    ENDS = "ends"
    FREE = "free"


class Around(Enum):
    """Side of its cylinder on which a body of a file lies."""

    BORE = "bore"
    SHAFT = "shaft"


@dataclass(frozen=True, kw_only=True)
class _Kind:
    kind: BodyKind


@dataclass(frozen=True, kw_only=True)
class _Material:
    youngs_modulus: Elasticity
    poissons_ratio: Annotated[float, Limits(above=-1.0, below=0.5)]

    @property
    def elastic(self) -> Elastic:
        """The material."""
        return Elastic(self.youngs_modulus, self.poissons_ratio)


@dataclass(frozen=True, kw_only=True)
class HalfSpaceSection(_Material, _Kind):
    """A half-space, much larger than the film."""

    kind: Literal[BodyKind.HALF_SPACE]


@dataclass(frozen=True, kw_only=True)
class _Flat(_Material, _Kind):
    thickness: Length
    cells: Cells
    support: Literal[Support.BOTTOM, Support.EDGE, Support.FREE]


@dataclass(frozen=True, kw_only=True)
class PlateSection(_Flat):
    """A plate as wide as the film's rectangle; cells along x, y and its thickness."""

    kind: Literal[BodyKind.PLATE]


@dataclass(frozen=True, kw_only=True)
class DiscSection(_Flat):
    """A disc about the origin; cells across its core, in rings around it, along its axis."""

    kind: Literal[BodyKind.DISC]
    outer_radius: Length | None = None  # left out: the film's


@dataclass(frozen=True, kw_only=True)
class RingSection(_Flat):
    """An annular plate about the origin; cells across, around, along its axis."""

    kind: Literal[BodyKind.RING]
    outer_radius: Length | None = None  # left out: the film's
    inner_radius: Length | None = None  # left out: the film's


@dataclass(frozen=True, kw_only=True)
class _Round(_Material, _Kind):
    radius: Length  # of the film
    cells: Cells
    support: Literal[Support.BACK, Support.ENDS, Support.FREE]


@dataclass(frozen=True, kw_only=True)
class BushSection(_Round):
    """A bush around a film as long as itself; cells along its radius, around, along its axis."""

    kind: Literal[BodyKind.BUSH]
    outer_radius: Length


@dataclass(frozen=True, kw_only=True)
class ShaftSection(_Round):
    """A hollow shaft in a film as long as itself; cells along its radius, around, along its axis."""

    kind: Literal[BodyKind.SHAFT]
    inner_radius: Length


@dataclass(frozen=True, kw_only=True)
class _File:
    mesh: Annotated[Path, Text.FILE]
    unit: MeshUnit = MeshUnit.METRE  # of its coordinates


@dataclass(frozen=True, kw_only=True)
class FileBodySection(_Material, _File):
    """A body of a mesh file, its face at z = 0 or on a cylinder about z."""

    face: FaceName
    clamped: FaceNames = ()
    radius: Length | None = None  # of the cylinder
    side: Around = Around.BORE  # of the cylinder on which the body lies


BuiltForm = PlateSection | DiscSection | RingSection | BushSection | ShaftSection
BodyForm = HalfSpaceSection | BuiltForm | FileBodySection


def body_under(stated: BuiltForm | FileBodySection, film: Array) -> Body:
    """Return the body under the vertices of a film, (2, vertices) m; raise InputError at the key that is wrong."""
    if isinstance(stated, FileBodySection):
        return _of_file(stated)
    face, chart = "top", UPWARDS
    if isinstance(stated, _Round):
        is_bush = isinstance(stated, BushSection)
        face, side = ("inner", Side.BORE) if is_bush else ("outer", Side.SHAFT)
        chart = Cylinder(stated.radius, side)
    return Body(_meshed(stated, film), stated.elastic, Supports(clamped=_clamped(stated)), face, chart)


def _meshed(stated: BuiltForm, film: Array) -> BodyMesh:
    """Return the mesh of a body; raise InputError at the key that is wrong."""
    (x, y), (width, length), reach = film.min(axis=1).tolist(), np.ptp(film, axis=1).tolist(), np.hypot(*film)
    try:
        match stated:
            case PlateSection(thickness=deep, cells=cells):
                return block((width, length, deep), cells, origin=(x, y, -deep))
            case DiscSection(thickness=deep, cells=cells, outer_radius=outer):
                return disc(outer or float(reach.max()), deep, cells, bottom=-deep)
            case RingSection(thickness=deep, cells=cells, outer_radius=outer, inner_radius=inner):
                radii = inner or float(reach.min()), outer or float(reach.max())
                return hollow_cylinder(radii, deep, cells, bottom=-deep)
            case BushSection(cells=cells, radius=inner, outer_radius=outer):
                radii = inner, outer
            case ShaftSection(cells=cells, inner_radius=inner, radius=outer):
                radii = inner, outer
        if radii[0] < radii[1]:
            return hollow_cylinder(radii, length, cells, bottom=y)
    except InputError as reason:
        raise InputError("cells", reason.found, reason.expected) from None
    shown = format_quantity(stated.radius, Dimension.LENGTH, digits=4)
    raise InputError("radius", shown, "less than outer_radius, more than inner_radius")


def _clamped(stated: BuiltForm) -> tuple[str, ...]:
    """Return the faces of a support."""
    match stated.support:
        case Support.BOTTOM:
            return ("bottom",)
        case Support.EDGE:
            return ("left", "right", "front", "back") if isinstance(stated, PlateSection) else ("outer",)
        case Support.BACK:
            return ("outer",) if isinstance(stated, BushSection) else ("inner",)
        case Support.ENDS:
            return ("bottom", "top")
        case Support.FREE:
            return ()


def _of_file(stated: FileBodySection) -> Body:
    """Return the body of a file; raise InputError at the key of its fault."""
    try:
        mesh = body_from_file(stated.mesh, stated.unit.metres)
    except InputError as reason:
        raise InputError("mesh", reason.found, reason.expected) from None
    for key, names in (("face", (stated.face,)), ("clamped", stated.clamped)):
        if unknown := [name for name in names if name not in mesh.face_names]:
            raise InputError(key, repr(unknown[0]), f"one of {', '.join(mesh.face_names)}")
    side = Side.BORE if stated.side is Around.BORE else Side.SHAFT
    chart = UPWARDS if stated.radius is None else Cylinder(stated.radius, side)
    return Body(mesh, stated.elastic, Supports(clamped=stated.clamped), stated.face, chart)
