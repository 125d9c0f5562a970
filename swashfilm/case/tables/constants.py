"""Constants table of a film case: names that its formulas may use."""

from __future__ import annotations

import keyword
import math

from swashfilm.case.fields.expressions import CONSTANTS, FUNCTIONS, IN_TIME
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, QuantityError, parse_quantity

_EXAMPLE = "a bare number, or a quantity with its unit, such as '10 um'"


def read_constants(top: Table) -> dict[str, float]:
    """Return the constants by name, quantities in SI, without those at fault; faults are listed."""
    table = top.table("constants")
    found = {}
    for name in table.values if table else ():
        assert table is not None
        if not name.isidentifier() or keyword.iskeyword(name):
            table.fault(name, f"the name '{name}'", "letters, digits and _, a letter first")
        elif name in (*IN_TIME, *CONSTANTS, *FUNCTIONS):
            table.fault(name, f"the name '{name}', which formulas define already", "another name", f"{name}_0")
        elif (value := _value(table, name)) is not None:
            found[name] = value
    return found


def _value(table: Table, name: str) -> float | None:
    raw = table.get(name)
    if isinstance(raw, (int, float)) and not isinstance(raw, bool) and math.isfinite(raw):
        return float(raw)
    for dimension in Dimension if isinstance(raw, str) else ():
        try:
            return parse_quantity(raw, dimension)
        except QuantityError:
            continue
    table.fault(name, repr(raw), _EXAMPLE)
    return None
