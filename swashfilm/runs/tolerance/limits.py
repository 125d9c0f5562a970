"""Limits that every pump of a series has to keep, as text: `efficiency >= 88 %`, `case drain <= 1.5 L/min`."""

from __future__ import annotations

import re
from collections.abc import Sequence

from system.inputs.faults import Fault, nearest_choice
from system.inputs.units import Dimension, QuantityError, parse_quantity
from system.variation.measures import EFFICIENCY, MEASURES, Measure
from system.variation.scatter import Bound, Limit

_LIMIT = re.compile(r"\s*(.+?)\s*(>=|<=)\s*(.+?)\s*")
_DIMENSIONS = {
    "W": Dimension.POWER,
    "m3/s": Dimension.VOLUME_FLOW,
    "N m": Dimension.TORQUE,
    "Pa": Dimension.PRESSURE,
    "m": Dimension.LENGTH,
    "K": Dimension.TEMPERATURE,
}
EXAMPLE = "such as 'efficiency >= 88 %' or 'case drain <= 1.5 L/min'"


def limit_of(text: str, known: Sequence[Measure], faults: list[Fault]) -> Limit | None:
    """Return the limit of a text; None with its fault noted: no limit, an unknown quantity, a wrong unit.

    known: the measures of the fidelity. A quantity is named by its key or by its words.
    """
    match = _LIMIT.fullmatch(text)
    if match is None:
        faults.append(Fault("--limit", repr(text), f"a quantity, >= or <=, and a value, {EXAMPLE}"))
        return None
    named = _names(known)
    measure = named.get(match[1].lower())
    if measure is None:
        found = f"'{match[1]}', no quantity of a pump at this fidelity"
        expected = f"one of {'; '.join(dict.fromkeys(one.words for one in known))}"
        faults.append(Fault("--limit", found, expected, nearest_choice(match[1], named)))
        return None
    try:
        return Limit(measure, Bound(match[2]), _value(match[3], measure), text.strip())
    except QuantityError as reason:
        faults.append(Fault("--limit", f"{text!r}: {reason.found}", reason.expected, reason.nearest))
        return None


def _names(known: Sequence[Measure]) -> dict[str, Measure]:
    """Return the measures by every name that a limit may use."""
    found = {one.name.lower(): one for one in known} | {one.words.lower(): one for one in known}
    found |= {one.words.partition(",")[0].lower(): one for one in known if one.name.startswith("efficiency.")}
    found |= {one.name.replace(".", " ").replace("_", " "): one for one in known}
    return found | {"efficiency": MEASURES[EFFICIENCY], "loss": MEASURES["loss"]}


def _value(text: str, measure: Measure) -> float:
    if measure.unit in _DIMENSIONS:
        return parse_quantity(text, _DIMENSIONS[measure.unit])
    number, percent = text.removesuffix("%"), text.endswith("%")
    try:
        return float(number) * (0.01 if percent else 1.0)
    except ValueError:
        raise QuantityError(repr(text), "a share, such as '88 %'") from None
