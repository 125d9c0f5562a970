"""Elastic table of a film case: walls that deform under the film's pressure."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from pathlib import Path

from reynolds.bodies.compliance import ElasticWalls
from reynolds.bodies.elasticity import Elastic
from reynolds.bodies.foundation import both, half_space, winkler
from reynolds.bodies.wall import Body, body_wall
from reynolds.errors import InputError
from reynolds.fem.space import FilmSpace
from swashfilm.case.fields.mesh import CaseMesh
from swashfilm.case.tables.bodies import BodyKind, built_body, file_body
from system.inputs.toml_table import Table, quoted
from system.inputs.units import Dimension, format_quantity


@dataclass(frozen=True)
class WallStatement:
    """A wall's body under the film (None: a half-space of `elastic`), and its entry as a case file writes it."""

    body: Body | None
    elastic: Elastic
    text: str

    def compliance(self, space: FilmSpace) -> ElasticWalls:
        """Return the compliance of the wall; raise InputError where it does not lie under the film."""
        return half_space(space, self.elastic) if self.body is None else body_wall(self.body, space)


@dataclass(frozen=True)
class ElasticStatement:
    """Springs under the film (Pa/m), body of the moving and of the fixed wall; None for a rigid one."""

    stiffness: float | None
    moving: WallStatement | None
    fixed: WallStatement | None

    def walls(self, space: FilmSpace) -> ElasticWalls:
        """Return the compliance of all walls; raise InputError as `WallStatement.compliance`."""
        parts: list[ElasticWalls] = [] if self.stiffness is None else [winkler(space, self.stiffness)]
        parts += [_under(wall, key, space) for key, wall in (("moving", self.moving), ("fixed", self.fixed)) if wall]
        return reduce(both, parts)


def _under(wall: WallStatement, key: str, space: FilmSpace) -> ElasticWalls:
    """Return the compliance of a wall; its fault is reported at `elastic.moving` or `elastic.fixed`."""
    try:
        return wall.compliance(space)
    except InputError as reason:
        raise InputError(f"elastic.{key}", f"{reason.where}: {reason.found}", reason.expected) from None


def read_elastic(top: Table, mesh: CaseMesh | None, folder: Path) -> ElasticStatement | None:
    """Return the [elastic] table; None where there is none, or with its faults listed."""
    table = top.table("elastic")
    if table is None:
        return None
    before = len(table.faults)
    stiffness = table.positive("winkler", Dimension.FOUNDATION) if table.get("winkler") is not None else None
    moving, fixed = (_wall(table, key, mesh, folder) for key in ("moving", "fixed"))
    table.close()
    if not table.values:
        top.fault("elastic", "an empty table", 'winkler = "1e13 Pa/m", or bodies: moving = {...}, fixed = {...}')
    return None if len(table.faults) > before else ElasticStatement(stiffness, moving, fixed)


def _wall(table: Table, key: str, mesh: CaseMesh | None, folder: Path) -> WallStatement | None:
    entry = table.table(key)
    if entry is None:
        return None
    elastic, text = _elastic(entry), _text(entry, folder)
    if "mesh" in entry.values:
        body = file_body(entry, elastic, folder)
        entry.close()
        return WallStatement(body, body.elastic, text) if body else None
    kind = entry.choice("kind", BodyKind)
    if kind is BodyKind.HALF_SPACE:
        entry.close()
        return WallStatement(None, elastic, text) if elastic else None
    if kind is None or mesh is None:
        return None
    body = built_body(entry, kind, elastic, mesh)
    entry.close()
    return WallStatement(body, body.elastic, text) if body else None


def _elastic(entry: Table) -> Elastic | None:
    modulus, poisson = entry.positive("youngs_modulus", Dimension.ELASTICITY), entry.number("poissons_ratio")
    if modulus is None or poisson is None:
        return None
    try:
        return Elastic(modulus, poisson)
    except InputError as reason:
        entry.fault("poissons_ratio", reason.found, reason.expected)
        return None


def _text(entry: Table, folder: Path) -> str:
    """Return the entry as written in the case file, with the absolute path of its mesh."""

    def shown(key: str, value: object) -> str:
        if isinstance(value, list):
            return f"[{', '.join(shown('', part) for part in value)}]"
        if key == "mesh":
            value = str((folder / str(value)).resolve())
        return quoted(value) if isinstance(value, str) else str(value)

    return "{ " + ", ".join(f"{key} = {shown(key, value)}" for key, value in entry.values.items()) + " }"


def elastic_rows(stated: ElasticStatement) -> list[str]:
    """Return the table as text of a case file."""
    rows = ["[elastic]"]
    if stated.stiffness is not None:
        rows.append(f'winkler = "{format_quantity(stated.stiffness, Dimension.FOUNDATION)}"')
    walls = (("moving", stated.moving), ("fixed", stated.fixed))
    return rows + [f"{key} = {wall.text}" for key, wall in walls if wall]
