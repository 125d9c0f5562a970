"""Statement of a film case in SI: the film before its fields are sampled on the mesh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from swashfilm.case.fields.field import Field, MeshData, Uniform
from swashfilm.case.tables.bodies import FileBodySection
from swashfilm.case.tables.boundary import BoundarySection
from swashfilm.case.tables.elastic import ElasticStatement
from swashfilm.case.tables.film import FilmSection
from swashfilm.case.tables.oil import FilmOilSection
from swashfilm.case.tables.roughness import ContactSection, RoughnessSection
from swashfilm.case.tables.thermal import ThermalSection
from swashfilm.case.tables.time_steps import TimeStepsSection
from system.inputs.sections.fields import fields_of
from system.inputs.units import Dimension


@dataclass(frozen=True)
class FilmStatement:
    """A free film as its case states it, every default filled in; tables that a case does not have are None."""

    film: FilmSection
    boundary: Mapping[str, BoundarySection]
    oil: FilmOilSection | None
    thermal: ThermalSection | None
    elastic: ElasticStatement | None
    roughness: RoughnessSection | None
    contact: ContactSection | None
    time: TimeStepsSection | None
    constants: Mapping[str, float]

    @property
    def viscosity(self) -> Field:
        """Viscosity at the oil's temperature and zero pressure."""
        if self.film.viscosity is not None:
            return self.film.viscosity
        assert self.oil is not None
        return Uniform(self.oil.dynamic_viscosity, Dimension.DYNAMIC_VISCOSITY)

    @property
    def files(self) -> tuple[Path, ...]:
        """Files that the case names: of the film's mesh and of bodies."""
        walls = self.elastic.stated.walls.values() if self.elastic else ()
        return (*self.film.mesh.files, *(wall.mesh for wall in walls if isinstance(wall, FileBodySection)))

    def refined(self) -> FilmStatement:
        """Return the film on a mesh twice finer, with a file's data on it, half its time step and more levels."""
        mesh = self.film.mesh.finer()
        keys = [key for key, own in fields_of(FilmSection).items() if own.formula]
        moved = {key: _on(getattr(self.film, key), mesh.data) for key in keys}
        film, time = replace(self.film, mesh=mesh, **moved), self.time and self.time.halved
        return replace(self, film=film, time=time, thermal=self.thermal and self.thermal.finer)


def _on(value: Any, data: MeshData) -> Any:
    if isinstance(value, tuple):
        return tuple(_on(part, data) for part in value)
    return None if value is None else value.on(data)
