"""What a film case states, read and in SI: the film before it has a mesh's quadrature points."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

from reynolds.film import Cavitation
from swashfilm.fields import CellData, Field, Formula, MeshData, PointData, Uniform
from swashfilm.mesh_case import CaseMesh

Velocity = tuple[Field, Field]


@dataclass(frozen=True)
class BoundaryStatement:
    """What a case states of one boundary: pressure (Pa) and the film fraction of what it may send in."""

    pressure: float
    film_fraction: float = 1.0


@dataclass(frozen=True)
class FilmStatement:
    """A free film as its case states it, every default filled in; `cavitation_pressure` in Pa."""

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

    def refined(self) -> FilmStatement:
        """The same film on a mesh twice finer, data of a mesh file carried along."""
        mesh = self.mesh.finer()
        moved = {part.name: _on(getattr(self, part.name), mesh.data) for part in fields(self)}
        return replace(self, **(moved | {"mesh": mesh}))


def _on(value: Any, data: MeshData) -> Any:
    if isinstance(value, tuple):
        return tuple(_on(part, data) for part in value)
    return value.on(data) if isinstance(value, (Uniform, Formula, PointData, CellData)) else value
