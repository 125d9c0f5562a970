"""A map as CSV: a line for each point, every number in the unit that people read it in."""

import csv
import io

import numpy as np

from swashfilm.output.tables import harmless
from swashfilm.runs.export.content import Content
from swashfilm.runs.export.numbers import READING_UNITS, in_unit, numbers
from system.maps.data import MapData


def csv_files(data: MapData, name: str) -> Content:
    """Return the file by its ending: heads `name [unit]`, twelve digits; nan and the reason without a result."""
    shown = {}
    for axis in data.axes:
        unit = READING_UNITS[axis.input.unit]
        shown[f"{axis.input.value} [{unit}]"] = in_unit(data.grid[axis.input], axis.input.unit, unit)
    for number in numbers(data):
        unit = READING_UNITS[number.unit]
        shown[f"{number.name} [{unit}]"] = in_unit(number.values, number.unit, unit)
    text = io.StringIO(newline="")
    table = csv.writer(text)
    table.writerow([*shown, "status", "reason"])
    rows = zip(*(np.ravel(values) for values in shown.values()), strict=True)
    for row, status, reason in zip(rows, data.status.flat, data.reason.flat, strict=True):
        table.writerow([*(f"{value:.12g}" for value in row), harmless(status), harmless(reason)])
    return Content({".csv": text.getvalue().encode()})
