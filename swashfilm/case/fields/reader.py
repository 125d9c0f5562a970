"""Reader of the fields in a case's tables; each field has a value everywhere on the mesh."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from reynolds.fem.space import FilmSpace
from swashfilm.case.fields.expressions import PLACE
from swashfilm.case.fields.field import Field, MeshData, may_be_data, read_field
from swashfilm.case.fields.mesh import CaseMesh
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, QuantityError


@dataclass(frozen=True)
class FieldReader:
    """Reader of fields on one mesh (None where the mesh has a fault itself).

    Formulas may contain `variables` and `constants`.
    """

    mesh: CaseMesh | None
    space: FilmSpace | None
    variables: Sequence[str] = PLACE
    constants: Mapping[str, float] = field(default_factory=dict)

    def field(
        self, table: Table, key: str, dimension: Dimension, default: str | None = None, *, positive: bool = False
    ) -> Field | None:
        """Return the field under a key, SI; None with its fault listed."""
        raw = table.get(key)
        return self.entry(table, key, default if raw is None else raw, dimension, positive=positive)

    def vector(self, table: Table, key: str, dimension: Dimension, default: str) -> tuple[Field, Field] | None:
        """Return two fields, along x and y, SI; None with the faults listed."""
        raw = table.get(key)
        parts = [default, default] if raw is None else raw
        if not isinstance(parts, list) or len(parts) != 2:
            noun = "velocities" if dimension is Dimension.VELOCITY else "values"
            table.fault(key, repr(raw), f'two {noun}, in x and y, such as ["1 m/s", "0 m/s"]')
            return None
        x, y = (self.entry(table, f"{key}[{index}]", part, dimension) for index, part in enumerate(parts))
        return None if x is None or y is None else (x, y)

    def entry(
        self, table: Table, key: str, raw: object, dimension: Dimension, *, positive: bool = False
    ) -> Field | None:
        """Return the field of an entry, SI; None with its fault listed."""
        if raw is None:
            formula = f"a formula of {', '.join(self.variables)}"
            table.fault(key, "missing", f"{dimension.noun}, such as '{dimension.example}', or {formula}")
            return None
        if self.mesh is None and may_be_data(raw) and str(raw).strip() not in self.constants:
            return None  # the fault of the mesh is listed already
        try:
            data = self.mesh.data if self.mesh else MeshData()
            found = read_field(raw, dimension, data, self.variables, self.constants)
        except QuantityError as reason:
            table.fault(key, reason.found, reason.expected, reason.nearest)
            return None
        if self.space and (fault := field_fault(found, self.space, positive=positive)):
            table.fault(key, *fault)
            return None
        return found


def field_fault(field: Field, space: FilmSpace, t: float = 0.0, *, positive: bool = False) -> tuple[str, str] | None:
    """Return (found, expected) where a field is not finite, or not above zero if `positive`; else None."""
    x, y = (np.broadcast_to(part, space.area.shape) for part in space.points)
    full = np.broadcast_to(field.sample(space, t), space.area.shape)
    if (corners := field.at_vertices(space, t)) is not None:  # a film may end at zero right at the edge
        x, y = (np.append(part, space.vertices[:, axis]) for axis, part in enumerate((x, y)))
        full = np.append(full, corners)
    bad = ~np.isfinite(full) | ((full <= 0.0) if positive else np.zeros(full.shape, dtype=bool))
    if not bad.any():
        return None
    worst = int(np.argmin(np.where(bad, np.nan_to_num(full, nan=-np.inf, posinf=-np.inf), np.inf)))
    at = f"x = {x.flat[worst]:.4g} m, y = {y.flat[worst]:.4g} m" + (f", t = {t:.4g} s" if t else "")
    found = f"'{field}' is {full.flat[worst]:.4g} at {at}"
    return found, "a value above zero everywhere" if positive else "a value everywhere"
