"""Units as heads of tables write them: °C, U/min, bar(a), lpm."""

from __future__ import annotations

import re
from dataclasses import dataclass

from diagnosis.recording.channel_form import PressureReference
from diagnosis.recording.units import OTHER_UNITS
from system.inputs.sections.values import PURE_UNITS
from system.inputs.units import Dimension, QuantityError, unit_scale

DIMENSIONS = (*OTHER_UNITS, Dimension.POWER, Dimension.TIME)
"""Of the channels of a steady table, and of its time."""
_DEGREES = {"°c": "degC", "° c": "degC", "grad c": "degC", "deg c": "degC", "°f": "degF", "deg f": "degF"}
_REFERENCED = re.compile(r"(bar|psi|mpa|kpa|pa)[\s_.(]*(abs|a|gauge|g|rel|ü)\)?\.?", re.IGNORECASE)
_GAUGE = ("g", "gauge", "rel", "ü")


@dataclass(frozen=True)
class ReadUnit:
    """A unit of a table: its quantity (None: a pure number), its name in files, the zero of a pressure if stated."""

    dimension: Dimension | None
    unit: str
    reference: PressureReference | None = None


def read_unit(text: str) -> ReadUnit | None:
    """Return the unit of a text as a bench writes it; None for a text that is no unit of a channel."""
    bare = text.strip()
    if bare in PURE_UNITS or bare == "-":
        return ReadUnit(None, "1" if bare == "-" else bare)
    if told := _REFERENCED.fullmatch(bare):
        reference = PressureReference.GAUGE if told[2].lower() in _GAUGE else PressureReference.ABSOLUTE
        found = read_unit(told[1])
        return found and ReadUnit(found.dimension, found.unit, reference)
    bare = _DEGREES.get(bare.lower(), bare)
    meant: ReadUnit | None = None
    for dimension in DIMENSIONS:
        try:
            unit_scale(bare, dimension)
        except QuantityError as reason:
            near = reason.nearest.strip("'")
            meant = meant or (ReadUnit(dimension, near) if near else None)
        else:
            return ReadUnit(dimension, bare)
    return meant
