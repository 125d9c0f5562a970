"""Elastic table of a film case: walls that deform under the film's pressure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce
from pathlib import Path
from typing import Annotated

from reynolds.bodies.compliance import ElasticWalls
from reynolds.bodies.foundation import both, half_space, winkler
from reynolds.bodies.wall import Body, body_wall
from reynolds.errors import InputError
from reynolds.fem.mesh import FilmMesh
from reynolds.fem.space import FilmSpace
from swashfilm.case.tables.bodies import BodyForm, HalfSpaceSection, body_under
from system.inputs.sections.fields import Positive
from system.inputs.sections.reader import table_section
from system.inputs.toml_table import Table
from system.inputs.units import Dimension


@dataclass(frozen=True, kw_only=True)
class ElasticSection:
    """[elastic]: walls that deform under the film's pressure; a body left out is rigid."""

    winkler: Annotated[float, Dimension.FOUNDATION, Positive] | None = None  # springs side by side
    moving: BodyForm | None = None
    fixed: BodyForm | None = None

    def __post_init__(self) -> None:
        if self.winkler is None and not self.walls:
            raise ValueError('winkler = "1e13 Pa/m", or bodies: moving = {...}, fixed = {...}')

    @property
    def walls(self) -> Mapping[str, BodyForm]:
        """The walls that are bodies, by name."""
        return {key: wall for key, wall in (("moving", self.moving), ("fixed", self.fixed)) if wall is not None}


@dataclass(frozen=True)
class ElasticStatement:
    """The table, and its bodies under the film by wall; half-spaces are not among them."""

    stated: ElasticSection
    bodies: Mapping[str, Body]

    @property
    def has_half_space(self) -> bool:
        """True where a wall is a half-space, whose influences are dense."""
        return any(isinstance(wall, HalfSpaceSection) for wall in self.stated.walls.values())

    def walls(self, space: FilmSpace) -> ElasticWalls:
        """Return the compliance of all walls; raise InputError where a body does not lie under the film."""
        stiffness = self.stated.winkler
        parts: list[ElasticWalls] = [] if stiffness is None else [winkler(space, stiffness)]
        for key, wall in self.stated.walls.items():
            try:
                is_endless = isinstance(wall, HalfSpaceSection)
                parts.append(half_space(space, wall.elastic) if is_endless else body_wall(self.bodies[key], space))
            except InputError as reason:
                raise InputError(f"elastic.{key}", f"{reason.where}: {reason.found}", reason.expected) from None
        return reduce(both, parts)


def read_elastic(top: Table, film: FilmMesh | None, folder: Path) -> ElasticStatement | None:
    """Return the [elastic] table with its bodies under a film; None if it is absent, or with its faults listed."""
    stated = table_section(top, "elastic", ElasticSection, folder)
    if stated is None or film is None:
        return None
    bodies, faults = {}, len(top.faults)
    for key, wall in stated.walls.items():
        try:
            if not isinstance(wall, HalfSpaceSection):
                bodies[key] = body_under(wall, film.mesh.p)
        except InputError as reason:
            top.fault(f"elastic.{key}.{reason.where}", reason.found, reason.expected)
    return ElasticStatement(stated, bodies) if len(top.faults) == faults else None
