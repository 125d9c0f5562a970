"""Reader of the fields in a case's tables, and their check on a mesh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from reynolds.fem.space import FilmSpace
from swashfilm.case.fields.expressions import PLACE, ExpressionError, parse_expression
from swashfilm.case.fields.field import Field, Formula, MeshData, Uniform, may_be_data, read_field
from system.inputs.sections.fields import FormulaOf
from system.inputs.units import QuantityError, parse_quantity


@dataclass(frozen=True)
class FieldReader:
    """Reader of fields with the data of one mesh (None where the mesh has a fault itself).

    Formulas may contain place, `constants` and, `in_time`, t.
    """

    data: MeshData | None
    in_time: bool
    constants: Mapping[str, float]

    def __call__(self, of: FormulaOf, raw: object) -> Field | None:
        """Return the field of an entry, SI; None where the mesh may have had its data. Raises QuantityError."""
        names = (*(PLACE if of.place else ()), *(("t",) if of.time and self.in_time else ()))
        if of.dimension is None:
            try:
                return Formula(parse_expression(str(raw), names, self.constants))
            except ExpressionError as reason:
                raise QuantityError(reason.found, reason.expected, reason.nearest) from None
        if not names and not self.constants:
            return Uniform(parse_quantity(raw, of.dimension), of.dimension)
        if of.place and self.data is None and may_be_data(raw) and str(raw).strip() not in self.constants:
            return None  # the fault of the mesh is listed already
        data = self.data if of.place and self.data else MeshData()
        return read_field(raw, of.dimension, data, names, self.constants)


LEAST = 1e-12
"""SI; as a film in m it is less than an atom, and no oil has such a viscosity."""


def field_fault(field: Field, space: FilmSpace, t: float = 0.0, *, positive: bool = False) -> tuple[str, str] | None:
    """Return (found, expected) where a field is not finite, or not above zero if `positive`; else None."""
    x, y = (np.broadcast_to(part, space.area.shape) for part in space.points)
    full = np.broadcast_to(field.sample(space, t), space.area.shape)
    if (corners := field.at_vertices(space, t)) is not None:  # a film may end at zero right at the edge
        x, y = (np.append(part, space.vertices[:, axis]) for axis, part in enumerate((x, y)))
        full = np.append(full, corners)
    bad = ~np.isfinite(full) | ((full < LEAST) if positive else np.zeros(full.shape, dtype=bool))
    if not bad.any():
        return None
    worst = int(np.argmin(np.where(bad, np.nan_to_num(full, nan=-np.inf, posinf=-np.inf), np.inf)))
    at = f"x = {x.flat[worst]:.4g} m, y = {y.flat[worst]:.4g} m" + (f", t = {t:.4g} s" if t else "")
    found = f"'{field}' is {full.flat[worst]:.4g} at {at}"
    least = f", at least {LEAST:g}" if full.flat[worst] > 0.0 else ""
    return found, f"a value above zero everywhere{least}" if positive else "a value everywhere"
