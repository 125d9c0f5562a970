"""Faults of the values of a duty cycle: times that fall or do not pass, inputs beyond the box of the map."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

import numpy as np

from reynolds.numerics.arrays import Array
from system.inputs.faults import Fault
from system.maps.interpolation import box_text, inside
from system.maps.plan import MapAxis

SHOWN = 5
"""Lines of a fault that are named; of more the number is told."""


def time_faults(lines: Sequence[int], time: Array) -> Iterator[Fault]:
    """Yield a fault of each time (s) that falls, and of times that do not pass; nan is a cell that is no number."""
    known = np.flatnonzero(np.isfinite(time)).tolist()
    for before, row in pairwise(known):
        if time[row] < time[before]:
            found = f"{time[row]:.6g} s after {time[before]:.6g} s in line {lines[before]}"
            yield Fault(f"time, line {lines[row]}", found, "rows in the order of their time; a step has one time twice")
    if len(known) == len(time) and np.ptp(time) == 0.0:
        yield Fault("time", f"{time[0]:.6g} s in all {len(time)} rows", "a time that passes: a last row later")


def box_faults(
    lines: Sequence[int], time: Array, values: Mapping[str, Array], axes: Mapping[str, MapAxis]
) -> Iterator[Fault]:
    """Yield a fault of each input, by the name of its column, with rows beyond the levels of its axis."""
    for name, axis in axes.items():
        own = values.get(name, np.array([]))
        rows = np.flatnonzero(np.isfinite(own) & ~inside(axis, own))
        if rows.size:
            first = rows[0]
            at = f" at {time[first]:.6g} s" if np.isfinite(time[first]) else ""
            found = f"{axis.input.text(float(own[first]))}{at}"
            yield Fault(f"{name}, {_lines(lines, rows)}", found, box_text([axis]))


def _lines(lines: Sequence[int], rows: np.ndarray) -> str:
    """Return the lines of rows, the first of them by number."""
    named = ", ".join(str(lines[row]) for row in rows[:SHOWN])
    more = f" and {rows.size - SHOWN} more" if rows.size > SHOWN else ""
    return f"line{'s' if rows.size > 1 else ''} {named}{more}"
