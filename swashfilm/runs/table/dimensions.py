"""Dimensions of a pump as axes of its response table: option --vary of `swashfilm table`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from gaps.response import Axis
from swashfilm.console.levels import range_of
from system.description.drawing import drawing_of
from system.description.keys import PumpKey, pump_keys, unknown_key
from system.description.pump import PumpDescription
from system.inputs.faults import Fault, InputFaults
from system.points.table.build import Range, dimension_axis
from system.pump_file.file import Variant, varied
from system.variation.sampling import drawn_series
from system.variation.solving import beside_films

MOST_DIMENSIONS = 6
DRAWN, SEED = 10_000, 1
"""Pumps drawn to find the range that a tolerance spans."""
BEYOND = 0.05
"""Share of that range added beyond either end, for pumps of another seed."""


def varied_axes(texts: Sequence[str], pump: PumpDescription, faults: list[Fault]) -> tuple[Axis, ...]:
    """Return the axes of `KEY=A..B` texts, or of `KEY` alone over its tolerance; list the faults of the others.

    A corner of the box that no pump has is a fault of the dimension that is refused.
    """
    known = {path: key for path, key in pump_keys(pump).items() if not beside_films(path)}
    found: dict[str, Range] = {}
    for text in texts:
        path, equals, ends = (part.strip() for part in text.partition("="))
        where = f"--vary {path}"
        if path in found:
            faults.append(Fault(where, "a second time", "each dimension once"))
        elif beside_films(path):
            said = "acts beside the films: runs by any table follow it without an axis"
            faults.append(Fault(where, said, "a dimension that the films depend on", "piston.radial_clearance"))
        elif path not in known:
            faults.append(unknown_key("--vary", path, known))
        elif span := _stated(where, ends, known[path], faults) if equals else _drawn(where, pump, path, faults):
            found[path] = span
    if len(texts) > MOST_DIMENSIONS:
        faults.append(Fault("--vary", f"{len(texts)} dimensions", f"at most {MOST_DIMENSIONS}"))
    else:
        faults += _corner_faults(pump, found)
    return tuple(dimension_axis(path, *span) for path, span in found.items())


def _stated(where: str, text: str, key: PumpKey, faults: list[Fault]) -> Range | None:
    example = "..".join(key.shown(share * key.value, 3) for share in (0.9, 1.1))
    return range_of(faults, where, text, key.dimension, example)


def _drawn(where: str, pump: PumpDescription, path: str, faults: list[Fault]) -> Range | None:
    """Return the range that a dimension's tolerance spans; a fault without a tolerance."""
    drawing = drawing_of(pump)
    if path not in drawing.names:
        faults.append(Fault(where, "no range, and no tolerance of this dimension", f"a range, such as {path}=A..B"))
        return None
    values = drawn_series(drawing, DRAWN, SEED).values[:, drawing.names.index(path)]
    low, high = float(values.min()), float(values.max())
    return low - BEYOND * (high - low), high + BEYOND * (high - low)


def _corner_faults(pump: PumpDescription, spans: Mapping[str, Range]) -> Iterator[Fault]:
    """Yield the faults at the corners of the box, each place once."""
    told = set[str]()
    for corner in product(*spans.values()):
        variant: Variant = tuple(zip(spans, corner, strict=True))
        try:
            varied(pump, variant)
        except InputFaults as reason:
            for fault in reason.faults:
                if fault.path not in told:
                    told.add(fault.path)
                    yield _at_corner(pump, fault, variant)


def _at_corner(pump: PumpDescription, fault: Fault, variant: Variant) -> Fault:
    known = pump_keys(pump)
    place = ", ".join(f"{path} = {known[path].shown(value)}" for path, value in variant)
    named = fault.path in dict(variant)
    where, found = ("--vary " if named else "--vary, ") + fault.path, f"{fault.found}, at {place}"
    return Fault(where, found, fault.expected, fault.nearest)
