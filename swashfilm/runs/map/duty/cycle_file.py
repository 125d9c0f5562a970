"""Duty cycle of a CSV file: time and operating point of the pump, one column each, units in the head."""

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np

from reynolds.numerics.arrays import Array
from swashfilm.runs.map.duty.cycle_faults import box_faults, time_faults
from system.inputs.csv_table import Line, head_columns, read_csv_text
from system.inputs.faults import Fault, InputFaults, nearest_choice
from system.inputs.units import LARGEST, Dimension, QuantityError, largest, unit_scale, with_point
from system.maps.duty import Cycle
from system.maps.plan import MapAxis, MapInput

TIME = "time"
HEADS = {
    "speed": MapInput.SPEED,
    "pressure": MapInput.PRESSURE,
    "displacement ratio": MapInput.RATIO,
    "temperature": MapInput.TEMPERATURE,
    "inlet pressure": MapInput.INLET_PRESSURE,
}
UNITS = {
    TIME: "s",
    "speed": "rpm",
    "pressure": "bar",
    "displacement ratio": "1",
    "temperature": "degC",
    "inlet pressure": "bar",
}
"""Example unit of each column, for messages."""
DIMENSIONS = {TIME: Dimension.TIME, **{name: given.dimension for name, given in HEADS.items()}}
"""Dimension of each column, None for a bare number."""
EXAMPLE = "time [s], speed [rpm], pressure [bar], displacement ratio [1]"
_RATIO_UNITS = {"1": 1.0, "-": 1.0, "%": 0.01}


def read_cycle(path: Path, axes: tuple[MapAxis, ...], *, within: bool = True) -> Cycle:
    """Return the cycle of a file for a map of these axes: columns in any order and unit, `#` begins a comment.

    Columns are parted by commas, or by semicolons or tabs, where numbers may have a decimal comma. Inputs with one
    level in the map may be left out. within: the cycle stays in the box of the axes. Raises InputFaults with every
    fault.
    """
    try:
        text = read_csv_text(path, f"a CSV file with columns {EXAMPLE}")
    except QuantityError as reason:
        raise InputFaults("command line", [Fault("cycle", reason.found, reason.expected, reason.nearest)]) from None
    if len(text.rows) < 2:
        raise InputFaults(str(path), [Fault("rows", str(len(text.rows)), f"at least two, under {EXAMPLE}")])
    faults: list[Fault] = []
    columns = dict(input_columns(text.head, DIMENSIONS, EXAMPLE, faults))
    needed = [TIME, *(head for head, given in HEADS.items() if _levels(axes, given) > 1)]
    lacking = [name for name in needed if name not in columns]
    if lacking and not faults:
        found = ", ".join(columns)
        heads = ", ".join(f"{name} [{UNITS[name]}]" for name in lacking)
        faults.append(Fault("head", found, f"columns {heads} too: a cycle has a time, and the inputs of its map"))
    if faults:
        raise InputFaults(str(path), faults)
    lines, values = column_values(text.rows, len(text.head), columns, faults)
    time, inputs = values[TIME], {name: array for name, array in values.items() if name != TIME}
    if len(lines) > 1:
        faults += time_faults(lines, time)
    boxes = {name: axis for name, given in HEADS.items() for axis in axes if within and axis.input is given}
    faults += box_faults(lines, time, inputs, boxes)
    if faults:
        raise InputFaults(str(path), faults)
    return Cycle(time, {HEADS[name]: array for name, array in inputs.items()})


def _levels(axes: tuple[MapAxis, ...], given: MapInput) -> int:
    return next(len(axis.values) for axis in axes if axis.input is given)


def input_columns(
    head: list[str],
    dimensions: Mapping[str, Dimension | None],
    example: str,
    faults: list[Fault],
    words: Collection[str] = (),
) -> Iterator[tuple[str, tuple[int, float, float]]]:
    """Yield the name of each column, its index, and factor and offset to SI; columns of `words` are skipped.

    dimensions: of the names that a column may have, None for a bare number.
    """
    known, named = list(dimensions), set[str]()
    if all(column.unit is None for column in head_columns(head)):
        meant = dict.fromkeys(nearest_choice(cell.strip().lower(), known) for cell in head)
        units = ", ".join(f"{name} [{UNITS.get(name, '1')}]" for name in meant if name)
        faults.append(Fault("head", f"'{','.join(head)}', without units", example, units))
        return
    for place, (cell, column) in enumerate(zip(head, head_columns(head), strict=True)):
        name, unit = column.name, column.unit
        if name in words:
            continue
        if unit is None or name not in known:
            near = nearest_choice(name.lower(), known)
            nearest = f"{near} [{UNITS.get(near, '1')}]" if near else ""
            faults.append(Fault("head", f"'{cell.strip()}'", example, nearest))
            continue
        if name in named:
            faults.append(Fault(f"head {name}", "twice", "each column once"))
            continue
        named.add(name)
        try:
            yield name, (place, *_scale(unit, dimensions[name]))
        except QuantityError as reason:
            faults.append(Fault(f"head {name}", reason.found, reason.expected, reason.nearest))


def _scale(unit: str, dimension: Dimension | None) -> tuple[float, float]:
    if dimension is not None:
        return unit_scale(unit, dimension)
    if unit not in _RATIO_UNITS:
        raise QuantityError(repr(unit), f"one of {', '.join(_RATIO_UNITS)}")
    return _RATIO_UNITS[unit], 0.0


def column_values(
    rows: Sequence[Line], width: int, columns: Mapping[str, tuple[int, float, float]], faults: list[Fault]
) -> tuple[tuple[int, ...], dict[str, Array]]:
    """Return the numbers of the rows' lines, and each column in SI; nan, with its fault, for a cell that is no number.

    Rows with another number of cells than the head are left out, with their fault.
    """
    uneven = [(number, len(cells)) for number, cells in rows if len(cells) != width]
    if uneven:
        found = f"{uneven[0][1]} cells, so in {len(uneven)} rows" if len(uneven) > 1 else f"{uneven[0][1]} cells"
        remedy = "decimals with a point: 1.5"
        faults.append(Fault(f"line {uneven[0][0]}", found, f"{width}, the number of columns in the head", remedy))
    whole = [(number, cells) for number, cells in rows if len(cells) == width]
    values = {name: _column(name, whole, own, faults) for name, own in columns.items()}
    return tuple(number for number, _ in whole), values


def _column(name: str, rows: Sequence[Line], own: tuple[int, float, float], faults: list[Fault]) -> Array:
    place, factor, offset = own
    most = LARGEST if (kind := DIMENSIONS.get(name)) is None else largest(kind)
    numbers = []
    for number, cells in rows:
        text = cells[place].strip()
        try:
            numbers.append(_within(factor * _finite(text) + offset, most))
        except ValueError:
            numbers.append(math.nan)
            faults.append(Fault(f"{name}, line {number}", repr(text), "a number", with_point(text)))
    return np.array(numbers)


def _within(number: float, most: Fraction) -> float:
    """Return a number of at most a size; raise ValueError for any other."""
    if abs(number) > most:
        raise ValueError
    return number


def _finite(text: str) -> float:
    """Return the number of a text; raise ValueError for any other text, nan and inf."""
    if not math.isfinite(number := float(text)):
        raise ValueError
    return number
