"""Profiles of worn parts: points, or raw traces of a profilometer that are levelled and smoothed to points."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Annotated

import numpy as np

from gaps.shapes.traces import grid, levelled, smoothed
from reynolds.numerics.arrays import Array
from system.inputs.faults import Fault
from system.inputs.sections.fields import Check, FromTable, Length, Limits, Points
from system.inputs.units import Dimension, format_quantity

ALONG = Points(
    (Dimension.LENGTH, Dimension.LENGTH), ("place", "material taken off"), ("3 mm", "2 um"), opposite="height"
)
AROUND = Points(
    (Dimension.LENGTH, Dimension.ANGLE, Dimension.LENGTH),
    ("place", "angle", "material taken off"),
    ("3 mm", "90 deg", "2 um"),
    opposite="height",
)
Rows = tuple[tuple[float, ...], ...]
Trace = Annotated[Rows, ALONG, AROUND, Limits(fewest=2)]
Ranges = Annotated[
    tuple[tuple[float, float], ...],
    Points((Dimension.LENGTH, Dimension.LENGTH), ("start", "end"), ("30 mm", "44 mm")),
    Limits(fewest=1),
]
FINEST = 0.5
"""Largest distance of a trace's points in cutoffs."""
DIGITS = 12
"""Decimals of metres of the points that a trace gives: below a picometre they are noise of the arithmetic."""


class Levelling(Enum):
    """Correction of a trace before it is smoothed."""

    LINE = "line"
    NONE = "none"


@dataclass(frozen=True, kw_only=True)
class TraceSection:
    """[PART.profile]: a raw trace of a profilometer; with angles one trace each, levelled and smoothed by itself."""

    trace: Trace  # over the whole land
    level: Levelling  # offset and tilt of the trace: by a line through what is not worn, or left in
    unworn: Ranges | None = None  # ranges of places that the line of level goes through
    cutoff: Length  # wavelength of the Gaussian filter, of which half the amplitude remains


def profile_of_trace(section: TraceSection) -> Rows:
    """Rows of a profile (place, (angle,) material taken off) of a trace, a tenth of the cutoff apart.

    The section passes all `CHECKS`.
    """
    lines = _by_angle(section.trace)
    first = max(line[0][0] for line in lines.values())
    last = min(line[-1][0] for line in lines.values())
    places = np.round(grid(first, last, section.cutoff), DIGITS)
    depths = {angle: _depths(section, np.array(line), places) for angle, line in lines.items()}
    return tuple((float(place), *angle, float(depths[angle][k])) for k, place in enumerate(places) for angle in depths)


def _by_angle(rows: Rows) -> Mapping[tuple[float, ...], list[tuple[float, float]]]:
    """The (place, depth) of each angle, (); without angles, in the order of the rows."""
    found: dict[tuple[float, ...], list[tuple[float, float]]] = {}
    for place, *angle, depth in rows:
        found.setdefault(tuple(angle), []).append((place, depth))
    return found


def _depths(section: TraceSection, line: Array, at: Array) -> Array:
    places, depths = line.T
    if section.unworn is not None:
        depths = levelled(places, depths, section.unworn)
    return np.round(smoothed(places, depths, section.cutoff, at), DIGITS)


def _unworn_faults(section: TraceSection) -> Iterator[Fault]:
    """Yield a fault of ranges that are missing beside `line`, stated beside `none`, or that do not rise."""
    line = section.level is Levelling.LINE
    if line and section.unworn is None:
        expected = "ranges of places that are not worn, [['30 mm', '44 mm']], of which the line is taken"
        yield Fault("unworn", "missing beside level = 'line'", expected)
    elif section.unworn is not None and not line:
        yield Fault("unworn", "ranges beside level = 'none'", "level = 'line', or no ranges")
    for start, end in section.unworn or ():
        if not start < end:
            yield Fault("unworn", f"from {_length(start)} to {_length(end)}", "a start before the end")


def _order_faults(section: TraceSection) -> Iterator[Fault]:
    """Yield a fault of each trace whose places do not rise."""
    for where, places in _lines(section):
        if not _rising((where, places)):
            yield Fault("trace", *_order(places, where))


def _cutoff_faults(section: TraceSection) -> Iterator[Fault]:
    """Yield a fault of each trace with points too few for the cutoff, or shorter than it."""
    for where, places in filter(_rising, _lines(section)):
        steps = np.diff(places)
        widest = int(np.argmax(steps))
        if steps[widest] > FINEST * section.cutoff:
            apart = f"points up to {_length(steps[widest])} apart at {_length(places[widest])}"
            least = f"at least {_length(steps[widest] / FINEST)}, twice that distance"
            yield Fault("cutoff", f"{_length(section.cutoff)}, {apart}{where}", least)
        if section.cutoff > places[-1] - places[0]:
            found = f"{_length(section.cutoff)}, a trace{where} from {_length(places[0])} to {_length(places[-1])}"
            yield Fault("cutoff", found, f"at most the trace's length, {_length(places[-1] - places[0])}")


def _range_faults(section: TraceSection) -> Iterator[Fault]:
    """Yield a fault of each range in which a trace has fewer than two points for the line."""
    for where, places in filter(_rising, _lines(section)):
        for start, end in section.unworn or ():
            if start < end and np.count_nonzero((places >= start) & (places <= end)) < 2:
                found = f"{_length(start)} to {_length(end)}, a trace{where} from {_length(places[0])} to "
                yield Fault("unworn", found + _length(places[-1]), "a range with two points of the trace or more")


def _lines(section: TraceSection) -> Iterator[tuple[str, Array]]:
    """Yield the angle in words and the places (n,) m of each trace."""
    for angle, line in _by_angle(section.trace).items():
        where = f" at {format_quantity(angle[0], Dimension.ANGLE, digits=4)}" if angle else ""
        yield where, np.array(line)[:, 0]


def _rising(line: tuple[str, Array]) -> bool:
    """True for a trace of two places or more that rise."""
    steps = np.diff(line[1])
    return bool(steps.size and (steps > 0.0).all())


def _order(places: Array, where: str) -> tuple[str, str, str]:
    steps = np.diff(places)
    if len(places) < 2:
        return f"{len(places)} point{where}", "two or more", ""
    k = int(np.argmax(steps <= 0.0))
    reverse = "the rows in reverse order" if (steps < 0.0).all() else ""
    found = f"{_length(places[k + 1])} after {_length(places[k])}, point {k + 2}{where}"
    count = int(np.count_nonzero(steps <= 0.0))
    return found + (f"; {count} such points" if count > 1 else ""), "places that rise from point to point", reverse


def _length(value: float) -> str:
    return format_quantity(value, Dimension.LENGTH, digits=4)


CHECKS = (
    Check(("level", "unworn"), _unworn_faults),
    Check(("trace",), _order_faults),
    Check(("trace", "cutoff"), _cutoff_faults),
    Check(("trace", "unworn"), _range_faults),
)
"""Conditions between the keys of a trace; a fault of one key does not hide that of another."""
Profile = Annotated[Rows, ALONG, AROUND, Limits(fewest=2), FromTable(TraceSection, CHECKS, profile_of_trace)]
"""Of a part: rows of place, (angle,) material taken off, in SI, however its file states them."""
