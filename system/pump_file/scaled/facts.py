"""Facts that a scant pump file states: its size and its oil."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any

from system.description.pump import PumpSection
from system.inputs.faults import Fault, nearest_choice
from system.inputs.sections.fields import AcuteAngle, Displacement, Length, Limits, fields_of
from system.inputs.sections.reader import Reading, read_entry, read_section
from system.inputs.toml_table import Table
from system.inputs.units import Dimension, QuantityError, parse_quantity

FEWEST, MOST = 5, 15  # pistons for which REF90's ports can be divided anew


@dataclass(frozen=True, kw_only=True)
class Facts:
    """[pump]: size of a pump."""

    displacement: Displacement  # also as a volume, "60 cm3"
    pistons: Annotated[int, Limits(least=FEWEST, most=MOST)]
    swash_angle_max: AcuteAngle | None = None
    piston_diameter: Length | None = None
    pitch_radius: Length | None = None


def facts_of(tables: Mapping[str, Any], faults: list[Fault]) -> Facts | None:
    """Return the size that the tables of a scant file state; None with the faults added, those of no oil too."""
    top = Table("", tables, faults)
    facts = _size(top)
    oil = tables.get("oil")
    if not (isinstance(oil, dict) and ("grade" in oil or "kinematic_viscosity_40C" in oil)):
        top.fault("oil.grade", "missing", "the oil's grade, such as 'ISO VG 46', or its two viscosities")
    return None if faults else facts


def _size(top: Table) -> Facts | None:
    """The size that a scant file states; None with its faults added."""
    table = top.table("pump", needed="with displacement and pistons")
    if table is None:
        return None
    own = {key: raw for key, raw in table.values.items() if key in fields_of(Facts)}
    facts = read_section(
        "pump", Facts, own, Reading(special={"pump.displacement": read_displacement}, faults=top.faults)
    )
    known = [*fields_of(PumpSection)]
    for key in table.values:
        if key not in known:
            table.fault(key, "no key of this table", f"one of {', '.join(known)}", nearest_choice(key, known))
    return None if top.faults else facts


def read_displacement(raw: object, _: Mapping[str, object], reading: Reading) -> Mapping[str, object]:
    """Return a displacement per revolution, also written "60 cm3"; None with its fault added."""
    try:
        return {"displacement": parse_quantity(raw, Dimension.VOLUME)}
    except QuantityError:
        return {"displacement": read_entry("pump.displacement", fields_of(Facts)["displacement"], raw, reading)}
