"""A duty cycle from a CSV file: time and what the pump does, a column each, its unit in the head."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from reynolds.errors import FilmInputError
from system.duty import Cycle
from system.faults import Fault, InputFaults, nearest_choice, nearest_path
from system.kinematics import Array
from system.map_plan import MapAxis, MapInput
from system.units import Dimension, QuantityError, unit_scale, with_point

TIME = "time"
HEADS = {
    "speed": MapInput.SPEED,
    "pressure": MapInput.PRESSURE,
    "displacement ratio": MapInput.RATIO,
    "temperature": MapInput.TEMPERATURE,
    "inlet pressure": MapInput.INLET_PRESSURE,
}
EXAMPLE = "time [s], speed [rpm], pressure [bar], displacement ratio [1]"
_HEAD = re.compile(r"\s*(.+?)\s*\[(.+)\]\s*")
_RATIO_UNITS = {"1": 1.0, "-": 1.0, "%": 0.01}


def read_cycle(path: Path, axes: tuple[MapAxis, ...]) -> Cycle:
    """The cycle of a file for a map of these axes: columns in any order and fitting unit, `#` begins a remark.

    What the map holds at one level may be left out. Raises InputFaults with everything that is wrong.
    """
    try:
        lines = path.read_text("utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as reason:
        fault = Fault("cycle", f"'{path}', which cannot be read: {reason}", "a CSV file", nearest_path(path))
        raise InputFaults("command line", [fault]) from None
    rows = [(number, cells) for number, cells in enumerate(csv.reader(lines), start=1) if _counts(cells)]
    if len(rows) < 3:
        raise InputFaults(str(path), [Fault("rows", str(max(0, len(rows) - 1)), f"two at least, under {EXAMPLE}")])
    faults: list[Fault] = []
    columns = dict(_columns(rows[0][1], faults))
    needed = [TIME, *(head for head, given in HEADS.items() if _levels(axes, given) > 1)]
    lacking = [name for name in needed if name not in columns]
    if lacking and not faults:
        found = ", ".join(columns)
        faults.append(Fault("head", found, f"columns {', '.join(lacking)} too: the map is over them, {EXAMPLE}"))
    if faults:
        raise InputFaults(str(path), faults)
    values = dict(_values(rows[1:], columns, faults))
    if faults:
        raise InputFaults(str(path), faults)
    try:
        return Cycle(values[TIME], {HEADS[name]: array for name, array in values.items() if name != TIME})
    except FilmInputError as reason:
        raise InputFaults(str(path), [Fault(TIME, reason.found, reason.expected)]) from None


def _counts(cells: list[str]) -> bool:
    return bool("".join(cells).strip()) and not cells[0].lstrip().startswith("#")


def _levels(axes: tuple[MapAxis, ...], given: MapInput) -> int:
    return next(len(axis.values) for axis in axes if axis.input is given)


def _columns(head: list[str], faults: list[Fault]) -> Iterator[tuple[str, tuple[int, float, float]]]:
    """Name of each column, its place, and factor and offset to SI."""
    known = [TIME, *HEADS]
    for place, cell in enumerate(head):
        match = _HEAD.fullmatch(cell)
        name = (match[1] if match else cell).strip().replace("_", " ").lower()
        if match is None or name not in known:
            faults.append(Fault("head", f"'{cell.strip()}'", EXAMPLE, nearest_choice(name, known)))
            continue
        dimension = Dimension.TIME if name == TIME else HEADS[name].dimension
        try:
            yield name, (place, *_scale(match[2].strip(), dimension))
        except QuantityError as reason:
            faults.append(Fault(f"head {name}", reason.found, reason.expected, reason.nearest))


def _scale(unit: str, dimension: Dimension | None) -> tuple[float, float]:
    if dimension is not None:
        return unit_scale(unit, dimension)
    if unit not in _RATIO_UNITS:
        raise QuantityError(repr(unit), f"one of {', '.join(_RATIO_UNITS)}")
    return _RATIO_UNITS[unit], 0.0


def _values(
    rows: list[tuple[int, list[str]]], columns: Mapping[str, tuple[int, float, float]], faults: list[Fault]
) -> Iterator[tuple[str, Array]]:
    """Each column in SI."""
    for name, (place, factor, offset) in columns.items():
        found = []
        for number, cells in rows:
            text = cells[place].strip() if place < len(cells) else ""
            try:
                found.append(factor * float(text) + offset)
            except ValueError:
                faults.append(Fault(f"{name}, line {number}", repr(text), "a number", with_point(text)))
        yield name, np.array(found)
