"""Units as heads of tables write them: °C, U/min, bar(a), lpm."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from diagnosis.recording.channel_form import PressureReference
from diagnosis.recording.units import OTHER_UNITS
from system.inputs.sections.values import PURE_UNITS
from system.inputs.units import Dimension, QuantityError, unit_scale

DIMENSIONS = (*OTHER_UNITS, Dimension.POWER, Dimension.TIME)
"""Of the channels of a steady table, and of its time."""
_DEGREES = {
    **dict.fromkeys(("°c", "° c", "℃", "grad c", "deg c", "deg. c", "c", "celsius"), "degC"),
    **dict.fromkeys(("°f", "° f", "℉", "deg f", "deg. f", "f", "fahrenheit"), "degF"),
}
_SPELT: Mapping[str, str] = {
    **dict.fromkeys(("u/min", "tr/min", "t/min", "tours/min", "min⁻¹", "об/мин", "转/分"), "rpm"),
    **dict.fromkeys(("lpm", "l/mn", "l/m", "lt/min", "ltr/min", "liter/min", "л/мин", "升/分"), "L/min"),
    **dict.fromkeys(("gpm", "us gpm", "usgpm", "us gal/min", "usgal/min", "gal/mn"), "gallon/min"),
    **dict.fromkeys(("cc/mn", "ccm/min"), "mL/min"),
    **dict.fromkeys(("cu.in/min", "cu in/min", "cipm", "cim"), "in3/min"),
    **dict.fromkeys(("kp/cm2", "kp/cm²", "kg/cm2", "kg/cm²", "кгс/см2"), "kgf/cm2"),
    **dict.fromkeys(("nm", "n-m", "newton m", "н м", "нм"), "N m"),
    **dict.fromkeys(("kpm", "kgm", "kgfm"), "kgf m"),
    **dict.fromkeys(("percent", "pct", "prozent", "pour cent", "v.h."), "%"),
    "mpa": "MPa", "kpa": "kPa", "hpa": "hPa", "knm": "kN m", "kw": "kW",
}  # fmt: skip
"""Units in small letters as benches write them, where they are not the names of files."""
_TIMES = (
    "s",
    "sec",
    "second",
    "seconds",
    "ms",
    "us",
    "µs",
    "min",
    "h",
    "hr",
    "hrs",
    "hour",
    "hours",
    "d",
    "day",
    "days",
)
"""Of a recording; others are letters that mean another quantity: mA, PS."""
_INCH_POUNDS = re.compile(r"(?:(in|inch|ft|foot)[\s.·*-]*(?:lbs?f?)|(?:lbs?f?)[\s.·*-]*(in|inch|ft|foot))\.?")
"""A torque, whatever comes first: in-lbf, ft lb, lbf·in."""
_REFERENCED = re.compile(r"(bar|psi|mpa|kpa|pa)[\s_.(]*(abs|a|gauge|g|rel|ü)\)?\.?", re.IGNORECASE)
_GAUGE = ("g", "gauge", "rel", "ü")


@dataclass(frozen=True)
class ReadUnit:
    """A unit of a table: its quantity (None: a pure number), its name in files, the zero of a pressure if stated."""

    dimension: Dimension | None
    unit: str
    reference: PressureReference | None = None


def read_unit(text: str) -> ReadUnit | None:
    """Return the unit of a text as a bench writes it; None for a text that is no unit of a channel.

    A text that only resembles a unit is none: US gal/min is not L/min.
    """
    bare = text.strip()
    if bare in PURE_UNITS or bare == "-":
        return ReadUnit(None, "1" if bare == "-" else bare)
    if told := _REFERENCED.fullmatch(bare):
        reference = PressureReference.GAUGE if told[2].lower() in _GAUGE else PressureReference.ABSOLUTE
        found = read_unit(told[1])
        return found and ReadUnit(found.dimension, found.unit, reference)
    small = bare.lower()
    known = _known(_DEGREES.get(small, bare))
    if known is None and small in _SPELT:
        return read_unit(_SPELT[small])
    if known is None and (pounds := _INCH_POUNDS.fullmatch(small)):
        return read_unit(f"lbf {'ft' if (pounds[1] or pounds[2]).startswith('f') else 'inch'}")
    return known or _known(small)


def _known(text: str) -> ReadUnit | None:
    """Return a unit by its name in files; None for other texts."""
    for dimension in DIMENSIONS:
        try:
            unit_scale(text, dimension)
        except QuantityError:
            continue
        return ReadUnit(dimension, text) if dimension is not Dimension.TIME or text.lower() in _TIMES else None
    return None
