"""Tables and data set of a tolerance's run folder."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from swashfilm.output.data.files import Column, write_columns, write_netcdf
from swashfilm.output.tables import write_csv
from swashfilm.runs.variation.case import VariedCase
from system.description.keys import PumpKey, pump_keys
from system.variation.measures import NUMBERS
from system.variation.tolerance import Tolerance

DATA, PUMPS_TABLE, SHARES_TABLE = "results.nc", "pumps.csv", "shares.csv"


def write_pumps(path: Path, case: VariedCase, found: Tolerance) -> None:
    """Write a row for each pump with a result: its dimensions and its numbers, in the units that people read."""
    known = pump_keys(case.pump)
    members = zip(found.series.drawing.members, found.series.values.T, strict=True)
    dimensions = [Column(one.name, values, si_unit(known[one.keys[0]])) for one, values in members]
    numbers = zip(found.measures, found.of_measures.T, strict=True)
    write_columns(path, [*dimensions, *(Column(one.name, values, one.unit) for one, values in numbers)])


def si_unit(key: PumpKey) -> str:
    """Return the SI unit of a number of a pump file."""
    return key.dimension.si_unit if key.dimension else "1"


def write_shares(path: Path, found: Tolerance) -> None:
    """Write a row for each measure and each group of dimensions: shares, and changes in the unit of the row."""
    parts = ("first", "total", "width", "mean")
    heads = ["measure", "unit", "dimensions", *(f"{part} {end}" for part in parts for end in ("value", "low", "high"))]
    rows = []
    for one, own in zip(found.measures, found.shares, strict=True):
        for share in own:
            scaled = zip(parts, (1.0, 1.0, one.scale, one.scale), strict=True)
            numbers = [scale * value for part, scale in scaled for value in asdict(getattr(share, part)).values()]
            rows.append([one.name, one.unit_of_change, " and ".join(share.names), *(f"{one:.6g}" for one in numbers)])
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
