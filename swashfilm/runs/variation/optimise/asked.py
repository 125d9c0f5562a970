"""Tables [vary], [objectives], [constraints] of an optimisation: dimensions, aims and limits as people write them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from swashfilm.console.fidelity import Fidelity
from swashfilm.console.levels import dashed_range, with_units
from swashfilm.runs.variation.limits import measure_of, measure_value, nearest_measure
from system.description.keys import PumpKey, pump_keys, unknown_key
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, nearest_choice, stated
from system.inputs.sections.fields import fields_of
from system.inputs.toml_table import Table
from system.inputs.units import QuantityError, parse_quantity, parse_share, reading_unit
from system.points.table.response_table import ResponseTable
from system.variation.measures import MEASURES, Measure
from system.variation.optimisation.problem import Aim, Constraint, Objective, Varied
from system.variation.scatter import Bound

RANGE, WITH = "range", "with"
"""Keys of a dimension that others are tied to."""
RANGE_EXAMPLE = '"0..8 deg", or {range = "0..8 deg", with = ["another.key"]}'
LIMIT_EXAMPLE = 'a limit, such as "<= 38.5 MPa" or "<= 1.02 start"'
_LIMIT = re.compile(r"\s*(<=|>=|<|>)\s*(.+?)\s*")
_START = re.compile(r"(.*?)\s*start")


def varied_of(top: Table, pump: PumpDescription, known: Mapping[str, PumpKey]) -> tuple[Varied, ...]:
    """Return the dimensions of [vary]; list the fault of each unknown one, and of bounds that are no range.

    known: those that the fidelity can vary.
    """
    table, found = top.table("vary", needed="of dimensions with their bounds"), []
    stated_keys = pump_keys(pump)
    for path, raw in _entries(table.values) if table else ():
        where = f"vary.{path}"
        if path not in known:
            top.faults.append(_no_dimension(where, path, pump, known, stated_keys))
            continue
        own = raw if isinstance(raw, dict) else {RANGE: raw}
        try:
            low, high = _bounds(known[path], own.get(RANGE))
        except QuantityError as reason:
            top.faults.append(Fault(where, reason.found, reason.expected, reason.nearest))
            continue
        tied = [*_tied(where, own, known[path], known, top.faults)]
        found.append(Varied(known[path], low, high, tuple(tied)))
    if table and not table.values:
        top.fault("vary", "an empty table", f'dimensions, such as "ports.groove_start" = {RANGE_EXAMPLE}')
    top.faults += _twice(found)
    return tuple(found)


def beyond_box(table: ResponseTable | None, one: Varied) -> tuple[str, str] | None:
    """Return found and expected values where the bounds of a dimension lie beyond a response table's box."""
    axes = {} if table is None else {axis.name: axis for axis in table.response.axes}
    if (axis := axes.get(one.name)) is None or axis.lower <= one.low < one.high <= axis.upper:
        return None
    bounds, box = (f"{one.key.shown(low)} .. {one.key.shown(high)}" for low, high in
                   ((one.low, one.high), (axis.lower, axis.upper)))  # fmt: skip
    return bounds, f"bounds in the box of the response table, {box}"


def objectives_of(top: Table, known: Sequence[Measure], fidelity: Fidelity) -> tuple[Objective, ...]:
    """Return the objectives; list the fault of each that the fidelity lacks, and of each other word."""
    table, found = top.table("objectives", needed='such as loss = "least"'), []
    for name, raw in _entries(table.values) if table else ():
        where, words = f"objectives.{name}", [one.value for one in Aim]
        measure = _measure(where, name, known, fidelity, top.faults)
        if raw not in words:
            top.faults.append(Fault(where, stated(raw), "least or most", _nearest_aim(raw)))
        elif measure is not None:
            found.append(Objective(measure, Aim(raw)))
    if table and not table.values:
        top.fault("objectives", "an empty table", 'an objective, such as loss = "least"')
    return tuple(found)


def _nearest_aim(raw: object) -> str:
    """Return the aim of a word."""
    beginnings = {"min": Aim.LEAST, "max": Aim.MOST}
    meant = beginnings.get(str(raw)[:3].lower())
    return meant.value if meant else nearest_choice(str(raw), [one.value for one in Aim])


def constraints_of(top: Table, known: Sequence[Measure], fidelity: Fidelity) -> tuple[Constraint, ...]:
    """Return the constraints, of a list each; list the fault of each unknown one."""
    table, found = top.table("constraints"), []
    for name, raw in _entries(table.values) if table else ():
        where = f"constraints.{name}"
        measure = _measure(where, name, known, fidelity, top.faults)
        for text in raw if isinstance(raw, list) else [raw]:
            try:
                if measure is not None:
                    found.append(_constraint(measure, text))
            except QuantityError as reason:
                top.faults.append(Fault(where, reason.found, reason.expected, reason.nearest))
    return tuple(found)


def _entries(values: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    """Yield (dotted name, value) of a table: quoted names and dotted keys are the same."""
    for key, value in values.items():
        if isinstance(value, dict) and RANGE not in value:
            yield from _entries(value, f"{above}{key}.")
        else:
            yield above + key, value


def _bounds(key: PumpKey, raw: object) -> tuple[float, float]:
    """Return the bounds (SI) of a text `0..8 deg` or of a list of two; raise QuantityError."""
    ends = raw if isinstance(raw, list) else with_units([raw])[0].split("..") if isinstance(raw, str) else []
    if len(ends) != 2:
        remedy = dashed_range(raw) if isinstance(raw, str) else ""
        raise QuantityError(stated(raw), f"two bounds, {RANGE_EXAMPLE}", remedy)
    if key.dimension is not None and all(_bare(end) for end in ends):
        remedy = f"{ends[0]}..{ends[1]} {reading_unit(key.value, key.dimension)}"
        raise QuantityError(f"{stated(raw)}, without a unit", "bounds with their unit", remedy)
    low, high = (_value(key, end) for end in ends)
    if not low < high:
        raise QuantityError(f"{key.shown(low)} to {key.shown(high)}", "a lower bound, then a higher one")
    return low, high


def _bare(end: object) -> bool:
    """True for a number without a unit."""
    try:
        float(str(end))
    except ValueError:
        return False
    return True


def _value(key: PumpKey, raw: object) -> float:
    if key.dimension is not None:
        return parse_quantity(raw.strip() if isinstance(raw, str) else raw, key.dimension)
    return parse_share(str(raw))


def _tied(
    where: str, own: Mapping[str, Any], key: PumpKey, known: Mapping[str, PumpKey], faults: list[Fault]
) -> Iterator[PumpKey]:
    """Yield the dimensions that are tied to one."""
    for word in own.keys() - {RANGE, WITH}:
        faults.append(
            Fault(f"{where}.{word}", "unknown key", f"{RANGE} or {WITH}", nearest_choice(word, (RANGE, WITH)))
        )
    named = own.get(WITH, [])
    for path in named if isinstance(named, list) else [named]:
        if path not in known:
            faults.append(unknown_key(f"{where}.{WITH}", str(path), known))
        elif known[path].dimension is not key.dimension:
            faults.append(Fault(f"{where}.{WITH}", f"'{path}', of another kind", f"a dimension like {key.path}"))
        else:
            yield known[path]


def _twice(found: Sequence[Varied]) -> Iterator[Fault]:
    """Yield a fault for each path that two dimensions set."""
    seen = set[str]()
    for one in found:
        for path in one.paths:
            if path in seen:
                yield Fault(f"vary.{one.name}", f"'{path}' a second time", "each dimension once")
            seen.add(path)


def _no_dimension(
    where: str, path: str, pump: PumpDescription, known: Mapping[str, PumpKey], stated_keys: Mapping[str, PumpKey]
) -> Fault:
    """Return the fault of a path that cannot vary: held by a table, left out by the file, or unknown."""
    if path in stated_keys:
        found = f"'{path}', on which the films depend, but no axis of this response table"
        expected = f"a table with it (swashfilm table --vary {path}), or another fidelity"
        return Fault(where, found, expected, 'fidelity = "lumped", "fixed" or "floating"')
    section, _, key = path.partition(".")
    own = fields_of(PumpDescription).get(section)
    if own is not None and own.table is not None and key in fields_of(own.table):
        found = f"'{path}', which neither the pump file nor the case states"
        return Fault(where, found, "a number to start from", f"a table [pump.{section}] in this case with {key} = ..")
    fault = unknown_key(where, path, known)
    return replace(fault, expected="table and key of a number of the pump file")


def _measure(
    where: str, name: str, known: Sequence[Measure], fidelity: Fidelity, faults: list[Fault]
) -> Measure | None:
    """Return the measure of a name; None with its fault, which lists the fidelities with this measure."""
    if (measure := measure_of(name, known)) is not None:
        return measure
    if other := measure_of(name, [*MEASURES.values()]):
        found = f"'{name}', which the fidelity {fidelity.value} does not know: it solves no {_solved(other)}"
        faults.append(Fault(where, found, f"one of {', '.join(one.name for one in known)}", 'fidelity = "floating"'))
    else:
        found = f"'{name}', no measure of a pump"
        expected = f"one of {', '.join(one.name for one in known)}"
        faults.append(Fault(where, found, expected, nearest_measure(name, [*MEASURES.values()])))
    return None


def _solved(measure: Measure) -> str:
    return "forces of films" if measure.name.startswith("load_carried") else "films"


def _constraint(measure: Measure, raw: object) -> Constraint:
    """Return the constraint of a text; raise QuantityError for another one."""
    match = _LIMIT.fullmatch(raw) if isinstance(raw, str) else None
    if match is None:
        raise QuantityError(stated(raw), LIMIT_EXAMPLE, f"<= {raw}" if isinstance(raw, str) else "")
    bound = Bound.MOST if match[1].startswith("<") else Bound.LEAST
    text = f"{measure.name} {bound.value} {match[2]}"
    try:
        if start := _START.fullmatch(match[2]):
            return Constraint(measure, bound, 0.0, text, parse_share(start[1] or "1"))
        return Constraint(measure, bound, measure_value(match[2], measure), text)
    except QuantityError as reason:
        near = f"{bound.value} {reason.nearest}" if reason.nearest else ""
        raise QuantityError(reason.found, reason.expected, near) from None
