"""Planned points of a CSV file: a column for each input with its unit in the head, and the readings at each point."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from swashfilm.runs.map.duty.cycle_file import HEADS, column_values, input_columns
from system.description.pump import PumpDescription
from system.inputs.csv_table import read_csv_text
from system.inputs.faults import Fault, InputFaults
from system.inputs.units import QuantityError
from system.maps.plan import MapInput
from system.pump.operating import OperatingPoint, operating_point

REPEATS = "repeats"
DIMENSIONS = {**{name: given.dimension for name, given in HEADS.items()}, REPEATS: None}
EXAMPLE = "speed [rpm], pressure [bar], displacement ratio [1], temperature [degC], inlet pressure [bar], repeats [1]"
OF_A_PLAN = ("order", "for")
"""Columns of a plan's own points.csv that are no input."""
MOST_REPEATS = 100


@dataclass(frozen=True)
class CampaignFile:
    """Planned points in the order of the file, the readings at each, and the line of each."""

    points: tuple[OperatingPoint, ...]
    repeats: NDArray[np.int64]
    lines: tuple[int, ...]


def read_campaign(path: Path, pump: PumpDescription) -> CampaignFile:
    """Return the points of a file; inputs without a column are the pump's own. Raises InputFaults with every fault."""
    try:
        text = read_csv_text(path, f"a CSV file with columns {EXAMPLE}")
    except QuantityError as reason:
        raise InputFaults(
            "command line", [Fault("--campaign", reason.found, reason.expected, reason.nearest)]
        ) from None
    faults: list[Fault] = []
    columns = dict(input_columns(text.head, DIMENSIONS, EXAMPLE, faults, OF_A_PLAN))
    if not faults and not set(columns) & set(HEADS):
        faults.append(Fault("head", f"'{','.join(text.head)}'", EXAMPLE))
    if not text.rows:
        faults.append(Fault("rows", "none", f"one point at least, under {EXAMPLE}"))
    lines, values = column_values(text.rows, len(text.head), columns, faults) if not faults else ((), {})
    if faults:
        raise InputFaults(str(path), faults)
    repeats = values.pop(REPEATS, np.ones(len(lines)))
    bad = [(line, one) for line, one in zip(lines, repeats, strict=True) if not _is_count(one)]
    faults += [
        Fault(f"{REPEATS}, line {line}", f"{one:g}", f"a whole number, 1 to {MOST_REPEATS}") for line, one in bad
    ]
    names = {name: HEADS[name] for name in values}
    points = []
    for at, line in enumerate(lines):
        try:
            points.append(
                operating_point(pump, **{given.value: float(values[name][at]) for name, given in names.items()})
            )
        except ValueError as void:
            faults.append(Fault(f"line {line}", str(void), "a point at which the oil's law holds"))
    if faults:
        raise InputFaults(str(path), faults)
    return CampaignFile(tuple(points), repeats.astype(np.int64), lines)


def axis_values(points: tuple[OperatingPoint, ...], axes: tuple[MapInput, ...]) -> list[list[float]]:
    """Return the values of points along some axes."""
    return [[float(getattr(point, axis.value)) for point in points] for axis in axes]


def _is_count(value: float) -> bool:
    return value == int(value) and 1 <= value <= MOST_REPEATS
