"""Units as benches, loggers and catalogues write them, with their names in the program's files."""

import re
from collections.abc import Mapping

_SPELLINGS: Mapping[str, str] = {
    **dict.fromkeys(("°c", "° c", "℃", "grad c", "deg c", "deg. c", "c", "celsius"), "degC"),
    **dict.fromkeys(("°f", "° f", "℉", "deg f", "deg. f", "f", "fahrenheit"), "degF"),
    **dict.fromkeys(("u/min", "tr/min", "t/min", "tours/min", "min⁻¹", "об/мин", "转/分"), "rpm"),
    **dict.fromkeys(("lpm", "l/mn", "l/m", "lt/min", "ltr/min", "liter/min", "л/мин", "升/分"), "L/min"),
    **dict.fromkeys(("gpm", "us gpm", "usgpm", "us gal/min", "usgal/min", "gal/mn"), "gallon/min"),
    **dict.fromkeys(("cc/mn", "ccm/min"), "mL/min"),
    **dict.fromkeys(("cu.in/min", "cu in/min", "cipm", "cim"), "in3/min"),
    **dict.fromkeys(("ccm", "ccm/u", "cm3/u"), "cm3/rev"),
    **dict.fromkeys(("kp/cm2", "kp/cm²", "kg/cm2", "kg/cm²", "кгс/см2"), "kgf/cm2"),
    **dict.fromkeys(("nm", "n-m", "newton m", "н м", "нм"), "N m"),
    **dict.fromkeys(("kpm", "kgm", "kgfm"), "kgf m"),
    **dict.fromkeys(("percent", "pct", "prozent", "pour cent", "v.h."), "%"),
    "mpa": "MPa", "kpa": "kPa", "hpa": "hPa", "psig": "psi", "barg": "bar", "knm": "kN m", "kw": "kW",
}  # fmt: skip
"""By small letters."""
_INCH_POUNDS = re.compile(r"(?:(in|inch|ft|foot)[\s.·*-]*(?:lbs?f?)|(?:lbs?f?)[\s.·*-]*(in|inch|ft|foot))\.?")
"""A torque, whatever comes first: in-lbf, ft lb, lbf·in."""


def spelt_unit(text: str) -> str:
    """Return the name in files of a unit as benches write it; empty for other texts.

    >>> spelt_unit("in-lbf"), spelt_unit("US gal/min"), spelt_unit("bar")
    ('lbf inch', 'gallon/min', '')
    """
    small = text.lower()
    if pounds := _INCH_POUNDS.fullmatch(small):
        return f"lbf {'ft' if (pounds[1] or pounds[2]).startswith('f') else 'inch'}"
    return _SPELLINGS.get(small, "")
