"""Names and values of measures as people write them, and limits of them: `efficiency >= 88 %`."""

from __future__ import annotations

import re
from collections.abc import Sequence

from system.inputs.faults import Fault, nearest_choice
from system.inputs.units import Dimension, QuantityError, parse_quantity, parse_share
from system.variation.measures import EFFICIENCY, MEASURES, Measure
from system.variation.scatter import Bound, Limit

_LIMIT = re.compile(r"\s*(.+?)\s*(>=|<=)\s*(.+?)\s*")
_RATE = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,2})?)\s*(\S+)\s*")
_DIMENSIONS = {
    "W": Dimension.POWER,
    "m3/s": Dimension.VOLUME_FLOW,
    "N m": Dimension.TORQUE,
    "Pa": Dimension.PRESSURE,
    "m": Dimension.LENGTH,
    "K": Dimension.TEMPERATURE,
}
_RATES = {"GPa/s": 1e9, "MPa/ms": 1e9, "bar/ms": 1e8, "MPa/s": 1e6, "Pa/s": 1.0}
EXAMPLE = "such as 'efficiency >= 88 %' or 'case drain <= 1.5 L/min'"


def limit_of(text: str, known: Sequence[Measure], faults: list[Fault]) -> Limit | None:
    """Return the limit of a text; None with its fault noted: no limit, an unknown quantity, a wrong unit.

    known: the measures of the fidelity. A quantity is named by its key or by its words.
    """
    match = _LIMIT.fullmatch(text)
    if match is None:
        faults.append(Fault("--limit", repr(text), f"a quantity, >= or <=, and a value, {EXAMPLE}"))
        return None
    measure = measure_of(match[1], known)
    if measure is None:
        beyond = measure_of(match[1], [*MEASURES.values()]) is not None
        found = f"'{match[1]}', {'which this fidelity does not know' if beyond else 'no quantity of a pump'}"
        expected = f"one of {'; '.join(dict.fromkeys(one.words for one in known))}"
        near = "--fidelity floating" if beyond else nearest_choice(match[1], _names(known))
        faults.append(Fault("--limit", found, expected, near))
        return None
    try:
        return Limit(measure, Bound(match[2]), measure_value(match[3], measure), text.strip())
    except QuantityError as reason:
        near = f"{match[1]} {match[2]} {reason.nearest}" if reason.nearest else ""
        faults.append(Fault("--limit", f"{text!r}: {reason.found}", reason.expected, near))
        return None


def measure_of(name: str, known: Sequence[Measure]) -> Measure | None:
    """Return the measure of a name or of its words, in any case; None for an unknown one."""
    return _names(known).get(name.strip().lower())


def nearest_measure(name: str, known: Sequence[Measure]) -> str:
    """Return the name of the measure that is spelt most like a name, empty without a similar one."""
    near = nearest_choice(name, _names(known))
    return _names(known)[near].name if near else ""


def _names(known: Sequence[Measure]) -> dict[str, Measure]:
    """Return the measures by every name that a limit may use."""
    found = {one.name.lower(): one for one in known} | {one.words.lower(): one for one in known}
    found |= {one.words.partition(",")[0].lower(): one for one in known if one.name.startswith("efficiency.")}
    found |= {one.name.replace(".", " ").replace("_", " "): one for one in known}
    return found | {"efficiency": MEASURES[EFFICIENCY], "loss": MEASURES["loss"]}


def measure_value(text: str, measure: Measure) -> float:
    """Return a value (SI) of a measure as text; raise QuantityError for one without a unit, or of another one."""
    if measure.unit != "1" and _bare(text):
        meant = f"{text.strip()} {measure.shown}"
        raise QuantityError(f"{text!r}, without a unit", f"a value with its unit, such as '{meant}'", meant)
    if measure.unit in _DIMENSIONS:
        return parse_quantity(text, _DIMENSIONS[measure.unit])
    if measure.unit == "Pa/s":
        return _rate(text)
    return _share(text, measure)


def _share(text: str, measure: Measure) -> float:
    """Return a share; one of a measure that none has above 1 is a percentage whose sign was forgotten."""
    value = parse_share(text)
    if value > 1.0 and "%" not in text and measure.within_one:
        meant = f"{text.strip()} %"
        raise QuantityError(f"{text!r}, {100.0 * value:g} %", f"a share of at most 100 %, such as '{meant}'", meant)
    return value


def _bare(text: str) -> bool:
    """True for a number without a unit."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def _rate(text: str) -> float:
    """Return a rate of pressure, Pa/s."""
    match = _RATE.fullmatch(text)
    if match is None or match[2] not in _RATES:
        raise QuantityError(repr(text), f"a rate of pressure, such as '50 GPa/s', in {', '.join(_RATES)}")
    return float(match[1]) * _RATES[match[2]]
