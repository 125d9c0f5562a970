"""Limits of a bench by a command line: `speed <= 1800 rpm`, `temperature >= 40 degC`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from diagnosis.next_point.operating_box import BenchBox
from system.inputs.faults import Fault, nearest_choice
from system.inputs.units import QuantityError, parse_quantity, parse_share
from system.maps.plan import MapInput

OPTION = "--limit"
AXES = {
    "speed": MapInput.SPEED, "pressure": MapInput.PRESSURE, "displacement ratio": MapInput.RATIO,
    "temperature": MapInput.TEMPERATURE, "inlet pressure": MapInput.INLET_PRESSURE,
}  # fmt: skip
"""Axes of a box in their order, by the name that a limit uses."""
INLET = "inlet pressure"
"""The axis that is held unless a limit or the planned points vary it."""
RATED = ("speed", "pressure")
"""Axes whose upper end is a rating of the pump."""
_LIMIT = re.compile(r"\s*(.+?)\s*(>=|<=)\s*(.+?)\s*")
EXAMPLE = "a quantity, >= or <=, and a value, such as 'speed <= 1800 rpm'"


def limited(box: BenchBox, texts: Sequence[str], faults: list[Fault]) -> BenchBox:
    """Return the box within the stated limits, which may also lie beyond its ends; add faults to `faults`."""
    ends = dict(zip(AXES, box.ends, strict=False))
    for text in texts:
        match = _LIMIT.fullmatch(text)
        if match is None:
            faults.append(Fault(OPTION, repr(text), EXAMPLE))
            continue
        name = match[1].lower().replace("_", " ")
        if name not in AXES:
            expected = f"one of {', '.join(AXES)}"
            faults.append(Fault(OPTION, f"'{match[1]}', no input that a bench sets", expected, _nearest(name)))
            continue
        try:
            value = _value(match[3], AXES[name])
        except QuantityError as reason:
            faults.append(Fault(OPTION, f"{text!r}: {reason.found}", reason.expected, reason.nearest))
            continue
        lower, upper = ends.get(name, (box.inlet_pressure, box.inlet_pressure))
        ends[name] = (value, upper) if match[2] == ">=" else (lower, value)
    faults += [
        Fault(OPTION, f"{name} from {AXES[name].text(lower)} to {AXES[name].text(upper)}", "a range that rises")
        for name, (lower, upper) in ends.items()
        if lower > upper
    ]
    return replace(box, ends=tuple(ends.values()))


def widened(box: BenchBox, stated: Sequence[str], points: Sequence[Sequence[float]]) -> BenchBox:
    """Return the box with the planned points in it, along the axes whose ends no limit states.

    points: the values of each axis. Speed and pressure stay below the rating, unless a limit allows more. Planned
    points of several inlet pressures make it an axis.
    """
    named = {match[1].lower().replace("_", " ") for one in stated if (match := _LIMIT.fullmatch(one))}
    known = dict(zip(AXES, box.ends, strict=False))
    if INLET not in known and len(set(points[-1])) > 1:
        known[INLET] = (min(points[-1]), max(points[-1]))
    ends = tuple(
        own if name in named else (min(own[0], *values), own[1] if name in RATED else max(own[1], *values))
        for (name, own), values in zip(known.items(), points, strict=False)
    )
    return replace(box, ends=ends)


def beyond(box: BenchBox, points: Sequence[Sequence[float]], what: str) -> list[Fault]:
    """Return a fault for each axis along which planned points lie beyond the bench's limits, with the nearest value."""
    found = []
    for (name, given), (lower, upper), values in zip(AXES.items(), box.ends, points, strict=False):
        slack = 1e-9 * max(abs(lower), abs(upper))
        outside = sorted({one for one in values if one < lower - slack or one > upper + slack})
        if outside:
            shown = ", ".join(given.text(one) for one in outside[:6]) + (" .." if len(outside) > 6 else "")
            nearest = ", ".join(dict.fromkeys(given.text(min(max(one, lower), upper)) for one in outside))
            limits = f"{given.text(lower)} to {given.text(upper)}, the limits of pump and bench"
            found.append(Fault(what, f"{name} {shown}", limits, nearest))
    return found


def _nearest(name: str) -> str:
    return nearest_choice(name, AXES)


def _value(text: str, given: MapInput) -> float:
    if given.dimension is not None:
        return parse_quantity(text, given.dimension)
    return parse_share(text)
