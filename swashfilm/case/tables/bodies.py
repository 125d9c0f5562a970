"""Bodies of a case's [elastic] table under the film: meshed by name and sizes, or read from a mesh file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import Enum
from pathlib import Path

import numpy as np

from reynolds.bodies.chart import Chart, Cylinder, Plane, Side
from reynolds.bodies.elasticity import Elastic
from reynolds.bodies.mesh import BodyMesh, block, disc, hollow_cylinder
from reynolds.bodies.mesh_file import body_from_file
from reynolds.bodies.supports import Supports
from reynolds.bodies.wall import Body
from reynolds.errors import InputError
from swashfilm.case.fields.mesh import MESH_FILE, CaseMesh
from system.description.parts import MeshUnit
from system.inputs.toml_table import Table
from system.inputs.units import Dimension

UPWARDS = Plane((0.0, 0.0, 1.0))
Cells = tuple[int, int, int]
Faces = tuple[str, ...]


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


class Around(Enum):
    """Side of its cylinder on which a body of a file lies."""

    BORE = "bore"
    SHAFT = "shaft"


def built_body(entry: Table, kind: BodyKind, elastic: Elastic | None, mesh: CaseMesh) -> Body | None:
    """Return a body of one of the named kinds under the film of `mesh`; None, its faults listed."""
    points = mesh.film_mesh.mesh.p
    if kind is BodyKind.PLATE:
        return _plate(entry, elastic, points)
    return (_flat if kind in (BodyKind.DISC, BodyKind.RING) else _round)(entry, kind, elastic, points)


def _plate(entry: Table, elastic: Elastic | None, points: np.ndarray) -> Body | None:
    cells, thickness = _cells(entry), entry.positive("thickness", Dimension.LENGTH)
    faces = _support(entry, {"bottom": ("bottom",), "edge": ("left", "right", "front", "back"), "free": ()})
    if cells is None or thickness is None or faces is None:
        return None
    (x, y), (width, length) = points.min(axis=1).tolist(), np.ptp(points, axis=1).tolist()
    return _body(
        entry, lambda: block((width, length, thickness), cells, origin=(x, y, -thickness)), elastic, faces, "top"
    )


def _flat(entry: Table, kind: BodyKind, elastic: Elastic | None, points: np.ndarray) -> Body | None:
    """Return a disc or an annular plate about the origin, by default with the film's radii."""
    reach = np.hypot(*points)
    cells, thickness = _cells(entry), entry.positive("thickness", Dimension.LENGTH)
    outer = entry.positive("outer_radius", Dimension.LENGTH, float(reach.max()))
    is_ring = kind is BodyKind.RING
    inner = entry.positive("inner_radius", Dimension.LENGTH, float(reach.min())) if is_ring else 0.0
    faces = _support(entry, {"bottom": ("bottom",), "edge": ("outer",), "free": ()})
    if cells is None or thickness is None or outer is None or inner is None or faces is None:
        return None

    def build() -> BodyMesh:
        if is_ring:
            return hollow_cylinder((inner, outer), thickness, cells, bottom=-thickness)
        return disc(outer, thickness, cells, bottom=-thickness)

    return _body(entry, build, elastic, faces, "top")


def _round(entry: Table, kind: BodyKind, elastic: Elastic | None, points: np.ndarray) -> Body | None:
    """Return a bush or a hollow shaft as long as the film."""
    bush = kind is BodyKind.BUSH
    cells, radius = _cells(entry), entry.positive("radius", Dimension.LENGTH)
    other = entry.positive("outer_radius" if bush else "inner_radius", Dimension.LENGTH)
    faces = _support(entry, {"back": ("outer" if bush else "inner",), "ends": ("bottom", "top"), "free": ()})
    if cells is None or radius is None or other is None or faces is None:
        return None
    radii = (radius, other) if bush else (other, radius)
    if radii[0] >= radii[1]:
        expected = f"{'less' if bush else 'more'} than {'outer' if bush else 'inner'}_radius"
        entry.fault("radius", str(entry.values["radius"]), expected)
        return None
    base, length = float(points[1].min()), float(np.ptp(points[1]))
    chart = Cylinder(radius, Side.BORE if bush else Side.SHAFT)
    face = "inner" if bush else "outer"
    return _body(entry, lambda: hollow_cylinder(radii, length, cells, bottom=base), elastic, faces, face, chart)


def file_body(entry: Table, elastic: Elastic | None, folder: Path) -> Body | None:
    """Return a body of a mesh file, its named face at z = 0 or on a cylinder about z; None, faults listed."""
    face, clamped = entry.get("face"), entry.get("clamped") or []
    radius = entry.positive("radius", Dimension.LENGTH) if entry.get("radius") is not None else None
    around = entry.choice("side", Around, Around.BORE)
    unit = entry.choice("unit", MeshUnit, MeshUnit.METRE)
    path = entry.file("mesh", folder, MESH_FILE)
    if unit is None or path is None:
        return None
    try:
        mesh = body_from_file(path, unit.metres)
    except InputError as reason:
        entry.fault("mesh", reason.found, reason.expected)
        return None
    for key, wanted in (("face", [face]), ("clamped", clamped if isinstance(clamped, list) else [clamped])):
        if unknown := [name for name in wanted if name not in mesh.face_names]:
            entry.fault(key, repr(unknown[0]), f"one of {', '.join(mesh.face_names)}")
            return None
    chart: Chart = UPWARDS
    if radius is not None:
        chart = Cylinder(radius, Side.BORE if around is Around.BORE else Side.SHAFT)
    return _body(entry, lambda: mesh, elastic, tuple(clamped), str(face), chart)


def _body(
    entry: Table, build: Callable[[], BodyMesh], elastic: Elastic | None, clamped: Faces, face: str,
    chart: Chart = UPWARDS,
) -> Body | None:  # fmt: skip
    if elastic is None:
        return None
    try:
        return Body(build(), elastic, Supports(clamped=clamped), face, chart)
    except InputError as reason:
        entry.fault("cells", reason.found, reason.expected)
        return None


def _cells(entry: Table) -> Cells | None:
    raw = entry.get("cells")
    if not isinstance(raw, list) or len(raw) != 3 or any(type(count) is not int or count < 1 for count in raw):
        found = "missing" if raw is None else repr(raw)
        entry.fault("cells", found, "three whole numbers from 1 on, such as [8, 8, 2]")
        return None
    return raw[0], raw[1], raw[2]


def _support(entry: Table, known: Mapping[str, Faces]) -> Faces | None:
    """Return the held faces, by the name of a support."""
    raw = entry.get("support")
    if raw not in known:
        entry.fault("support", "missing" if raw is None else repr(raw), f"one of {', '.join(known)}")
        return None
    return known[str(raw)]
