"""Units as heads of tables write them: °C, U/min, bar(a), lpm."""

from __future__ import annotations

import re
from dataclasses import dataclass

from diagnosis.recording.channel_form import PressureReference
from diagnosis.recording.units import OTHER_UNITS
from system.inputs.sections.values import PURE_UNITS
from system.inputs.unit_spellings import spelt_unit
from system.inputs.units import Dimension, QuantityError, unit_scale

DIMENSIONS = (*OTHER_UNITS, Dimension.POWER, Dimension.TIME)
"""Of the channels of a steady table, and of its time."""
_TIMES = frozenset(
    ["s", "sec", "second", "seconds", "ms", "us", "µs", "min", "h", "hr", "hrs", "hour", "hours", "d", "day", "days"]
)
"""Of a recording; other letters mean another quantity: mA, PS."""
_REFERENCED = re.compile(r"(bar|psi|mpa|kpa|pa)[\s_.(]*(abs|a|gauge|g|rel|ü)\)?\.?", re.IGNORECASE)
_GAUGE = ("g", "gauge", "rel", "ü")


@dataclass(frozen=True)
class ReadUnit:
    """A unit of a table: its quantity (None: a pure number), its name in files, the zero of a pressure if stated."""

    dimension: Dimension | None
    unit: str
    reference: PressureReference | None = None


def read_unit(text: str) -> ReadUnit | None:
    """Return the unit of a text as a bench writes it; None for other texts, also those that only resemble a unit."""
    bare = text.strip()
    if bare in PURE_UNITS or bare == "-":
        return ReadUnit(None, "1" if bare == "-" else bare)
    if told := _REFERENCED.fullmatch(bare):
        reference = PressureReference.GAUGE if told[2].lower() in _GAUGE else PressureReference.ABSOLUTE
        found = read_unit(told[1])
        return found and ReadUnit(found.dimension, found.unit, reference)
    if spelt := spelt_unit(bare):
        return ReadUnit(None, spelt) if spelt in PURE_UNITS else _known(spelt)
    return _known(bare) or _known(bare.lower())


def _known(text: str) -> ReadUnit | None:
    """Return a unit by its name in files; None for other texts."""
    for dimension in DIMENSIONS:
        try:
            unit_scale(text, dimension)
        except QuantityError:
            continue
        return ReadUnit(dimension, text) if dimension is not Dimension.TIME or text.lower() in _TIMES else None
    return None
