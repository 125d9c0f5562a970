"""Tables and data set of a tolerance's run folder."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.output.data.files import write_netcdf
from swashfilm.output.tables import write_csv
from swashfilm.runs.variation.case import VariedCase
from system.variation.measures import NUMBERS
from system.variation.tolerance import Tolerance

DATA, PUMPS_TABLE, SHARES_TABLE = "results.nc", "pumps.csv", "shares.csv"


def write_pumps(path: Path, found: Tolerance) -> None:
    """Write a row for each pump with a result: its dimensions (SI), and its numbers in the units that people read."""
    heads = [
        *(f"{name} [SI]" for name in found.series.drawing.names),
        *(f"{one.name} [{one.shown}]" for one in found.measures),
    ]
    numbers = [one.read(values) for one, values in zip(found.measures, found.of_measures.T, strict=True)]
    rows = np.column_stack([found.series.values, *numbers])
    write_csv(path, heads, ([f"{value:.8g}" for value in row] for row in rows))


def write_shares(path: Path, found: Tolerance) -> None:
    """Write a row for each measure and each group of dimensions."""
    parts = ("first", "total", "width", "mean")
    heads = ["measure", "unit", "dimensions", *(f"{part} {end}" for part in parts for end in ("value", "low", "high"))]
    rows = []
    for one, own in zip(found.measures, found.shares, strict=True):
        for share in own:
            numbers: list[float] = [value for part in parts for value in asdict(getattr(share, part)).values()]
            rows.append([one.name, one.unit, " and ".join(share.names), *(f"{value:.6g}" for value in numbers)])
    write_csv(path, heads, rows)


def write_data(path: Path, case: VariedCase, found: Tolerance) -> None:
    """Write dimensions and numbers of every pump at every operating point, and the measures; SI."""
    import xarray

    points = case.work.sites.points
    inputs: Mapping[str, Any] = {
        name: ("point", [getattr(point, name) for point in points]) for name in vars(points[0])
    }
    data = xarray.Dataset(
        {
            "dimension": (("pump", "key"), found.series.values),
            "number": (("pump", "point", "name"), found.numbers),
            "value": (("pump", "measure"), found.of_measures),
            "weight": ("point", case.work.sites.weights),
            **inputs,
        },
        coords={
            "key": list(found.series.drawing.names),
            "name": list(NUMBERS),
            "measure": [one.name for one in found.measures],
        },
        attrs={"pump": case.pump.name, "units": "SI", "fidelity": case.fidelity.value},
    )
    for name in ("dimension", "number", "value"):
        data[name].attrs["units"] = "SI of each"
    write_netcdf(data, path, "tolerance")
