"""A map as CSV: a line for each point, every number in the unit that people read it in."""

import csv
import io
from collections.abc import Mapping

import numpy as np

from swashfilm.runs.export.numbers import PERCENT, in_unit, numbers
from system.maps.data import MapData

UNITS = {
    "rad/s": "r/min", "Pa": "bar", "K": "degC", "m": "um", "N m": "N m", "m3/s": "L/min", "W": "W",
    "m3/rev": "cm3/rev", "1": PERCENT,
}  # fmt: skip
"""Unit in the file by SI unit."""


def csv_files(data: MapData, name: str) -> Mapping[str, bytes]:
    """Return the file by its ending: heads `name [unit]`, twelve digits; nan and the reason where a point has none."""
    shown = {}
    for axis in data.axes:
        unit = UNITS[axis.input.unit]
        shown[f"{axis.input.value} [{unit}]"] = in_unit(data.grid[axis.input], axis.input.unit, unit)
    for number in numbers(data):
        unit = UNITS[number.unit]
        shown[f"{number.name} [{unit}]"] = in_unit(number.values, number.unit, unit)
    text = io.StringIO(newline="")
    table = csv.writer(text)
    table.writerow([*shown, "status", "reason"])
    rows = zip(*(np.ravel(values) for values in shown.values()), strict=True)
    for row, status, reason in zip(rows, data.status.flat, data.reason.flat, strict=True):
        table.writerow([*(f"{value:.12g}" for value in row), status, reason])
    return {".csv": text.getvalue().encode()}
