"""Statement of a film case in SI: the film before its fields are sampled on the mesh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

from reynolds.floating.load_search import RigidLoad
from reynolds.problem import Cavitation
from swashfilm.case.fields.field import CellData, Field, Formula, MeshData, PointData, Uniform
from swashfilm.case.fields.mesh import CaseMesh
from swashfilm.case.tables.boundary import BoundaryStatement
from swashfilm.case.tables.elastic import ElasticStatement
from swashfilm.case.tables.oil import OilSection
from swashfilm.case.tables.roughness import RoughWalls
from swashfilm.case.tables.thermal import ThermalSection
from swashfilm.case.tables.time_steps import TimeSection

Velocity = tuple[Field, Field]


@dataclass(frozen=True)
class FilmStatement:
    """A free film as its case states it, every default filled in; `cavitation_pressure` in Pa.

    `viscosity` is that at the oil's temperature and zero pressure. `initial_film_fraction` belongs to a transient.
    Tables that a case does not have are None. With `load` the thickness is the shape only.
    """

    mesh: CaseMesh
    order: int
    thickness: Field
    velocity: Velocity
    velocity_fixed: Velocity
    squeeze: Field
    viscosity: Field
    cavitation: Cavitation
    cavitation_pressure: float
    boundary: Mapping[str, BoundaryStatement]
    initial_film_fraction: Field
    oil: OilSection | None = None
    thermal: ThermalSection | None = None
    elastic: ElasticStatement | None = None
    rough: RoughWalls | None = None
    time: TimeSection | None = None
    load: RigidLoad | None = None
    constants: Mapping[str, float] = field(default_factory=dict)

    def refined(self) -> FilmStatement:
        """Return the film on a mesh twice finer, with the data of a mesh file on it."""
        mesh = self.mesh.finer()
        moved = {part.name: _on(getattr(self, part.name), mesh.data) for part in fields(self)}
        return replace(self, **(moved | {"mesh": mesh}))


def _on(value: Any, data: MeshData) -> Any:
    if isinstance(value, tuple):
        return tuple(_on(part, data) for part in value)
    return value.on(data) if isinstance(value, (Uniform, Formula, PointData, CellData)) else value
