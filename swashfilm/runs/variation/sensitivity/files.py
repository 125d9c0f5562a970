"""Table and data set of a sensitivity's run folder."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from swashfilm.output.data.files import write_netcdf
from swashfilm.output.tables import write_csv
from swashfilm.runs.variation.case import VariedCase
from swashfilm.runs.variation.words import key_unit
from system.variation.differences import Verdict
from system.variation.measures import NUMBERS
from system.variation.sensitivity import Sensitivity

DATA, TABLE = "results.nc", "sensitivity.csv"


def write_table(path: Path, found: Sensitivity) -> None:
    """Write a row for each dimension: value, change and sigma in its unit, and the change of each measure by it."""
    heads = ["key", "unit", "value", "change", "side", "sigma"]
    heads += [f"{one.name} [{one.unit_of_change}]" for one in found.measures]
    heads += [f"{one.name} error [{one.unit_of_change}]" for one in found.measures]
    scale = np.array([one.scale for one in found.measures])
    rows = []
    for one in found.slopes:
        known = one.verdict != Verdict.NOT_SMOOTH
        changes = [
            f"{value:.8g}" if good else "" for value, good in zip(one.value * one.unit * scale, known, strict=True)
        ]
        errors = [
            f"{value:.3g}" if good else "" for value, good in zip(one.error * one.unit * scale, known, strict=True)
        ]
        unit, factor = key_unit(one.key)
        sigma = "" if one.sigma is None else f"{one.sigma * factor:.8g}"
        value, change = f"{one.key.value * factor:.8g}", f"{one.unit * factor:.8g}"
        rows.append([one.key.path, unit, value, change, one.stencil.side.value, sigma, *changes, *errors])
    write_csv(path, heads, rows)


def write_data(path: Path, case: VariedCase, found: Sensitivity) -> None:
    """Write derivatives over dimensions and measures, and of every number at every operating point; SI."""
    import xarray

    points = case.work.sites.points
    shapes = {"value": (len(found.measures),), "sites": (len(points), len(NUMBERS))}
    shapes |= {"error": shapes["value"], "verdict": shapes["value"], "sites_error": shapes["sites"]}

    def stacked(part: str) -> Any:
        return np.reshape([getattr(one, part) for one in found.slopes], (len(found.slopes), *shapes[part]))

    inputs: Mapping[str, Any] = {
        name: ("point", [getattr(point, name) for point in points]) for name in vars(points[0])
    }
    smooth, none = (stacked("verdict") == verdict for verdict in (Verdict.SMOOTH, Verdict.NO_EFFECT))
    data = xarray.Dataset(
        {
            "derivative": (("key", "measure"), np.where(smooth, stacked("value"), np.where(none, 0.0, np.nan))),
            "derivative_error": (("key", "measure"), np.where(smooth | none, stacked("error"), np.nan)),
            "middle": ("measure", found.middle),
            "derivative_at_point": (("key", "point", "number"), stacked("sites")),
            "derivative_at_point_error": (("key", "point", "number"), stacked("sites_error")),
            "value": ("key", [one.key.value for one in found.slopes]),
            "change": ("key", [one.unit for one in found.slopes]),
            "weight": ("point", case.work.sites.weights),
            **inputs,
        },
        coords={
            "key": [one.key.path for one in found.slopes],
            "measure": [one.name for one in found.measures],
            "number": list(NUMBERS),
        },
        attrs={"pump": case.pump.name, "units": "SI: number per SI unit of the key", "fidelity": case.fidelity.value},
    )
    for name in ("derivative", "derivative_error", "derivative_at_point", "derivative_at_point_error"):
        data[name].attrs["units"] = "SI of the number per SI of the dimension"
    for name in ("value", "change", "middle"):
        data[name].attrs["units"] = "SI of each"
    write_netcdf(data, path, "sensitivity")
